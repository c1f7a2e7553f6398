/// The most passwords a vault holds: twice as many as a connection list has controllers.
pub const MAX_VAULT_PASSWORDS: usize = 20_000;

/// The longest password a vault takes, in bytes of UTF-8.
pub const MAX_VAULT_PASSWORD_BYTES: usize = 1024;
