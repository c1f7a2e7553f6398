use std::collections::BTreeSet;

use opcua::crypto::SecurityPolicy as WirePolicy;
use opcua::server::authenticator::user_pass_security_policy_id;
use opcua::server::{ANONYMOUS_USER_TOKEN_ID, Limits, ServerEndpoint, SubscriptionLimits};
use opcua::types::{MessageSecurityMode, UAString, UserTokenPolicy as WireTokenPolicy, UserTokenType};

use crate::model::{SecurityPolicy, UserTokenPolicy};

/// One endpoint a policy and mode. `key_bits` is the length of the server's key.
pub(super) fn endpoints(
    policies: &BTreeSet<SecurityPolicy>,
    key_bits: usize,
) -> impl Iterator<Item = (String, ServerEndpoint)> {
    policies.iter().copied().flat_map(modes).map(move |(policy, mode)| {
        // Who may log in is for `Users` to say; the crate wants some token named here.
        let mut endpoint = ServerEndpoint::new("/", wire(policy), mode, &[ANONYMOUS_USER_TOKEN_ID.to_owned()]);
        if policy == SecurityPolicy::None {
            // Without security the channel does not protect the password, so the client must encrypt it itself.
            endpoint.password_security_policy = Some(password_policy(key_bits).to_str().to_owned());
        }
        (format!("{policy}-{mode}"), endpoint)
    })
}

fn modes(policy: SecurityPolicy) -> Vec<(SecurityPolicy, MessageSecurityMode)> {
    match policy {
        SecurityPolicy::None => vec![(policy, MessageSecurityMode::None)],
        _ => vec![(policy, MessageSecurityMode::Sign), (policy, MessageSecurityMode::SignAndEncrypt)],
    }
}

pub(super) fn wire(policy: SecurityPolicy) -> WirePolicy {
    match policy {
        SecurityPolicy::None => WirePolicy::None,
        SecurityPolicy::Basic128Rsa15 => WirePolicy::Basic128Rsa15,
        SecurityPolicy::Basic256 => WirePolicy::Basic256,
        SecurityPolicy::Basic256Sha256 => WirePolicy::Basic256Sha256,
        SecurityPolicy::Aes128Sha256RsaOaep => WirePolicy::Aes128Sha256RsaOaep,
        SecurityPolicy::Aes256Sha256RsaPss => WirePolicy::Aes256Sha256RsaPss,
    }
}

/// Both encrypt with RSA-OAEP; clients refuse the newer one for keys shorter than 2048 bits (OPC 10000-7).
fn password_policy(key_bits: usize) -> WirePolicy {
    if key_bits < 2048 { WirePolicy::Basic256 } else { WirePolicy::Basic256Sha256 }
}

/// The ticked user token policies.
#[derive(Debug, Clone)]
pub(super) struct UserTokens(BTreeSet<UserTokenPolicy>);

impl UserTokens {
    pub(super) fn new(tokens: BTreeSet<UserTokenPolicy>) -> Self {
        Self(tokens)
    }

    pub(super) fn anonymous(&self) -> bool {
        self.0.contains(&UserTokenPolicy::Anonymous)
    }

    pub(super) fn user_name(&self) -> bool {
        self.0.contains(&UserTokenPolicy::UserName)
    }

    /// What an endpoint's description says about logging in (OPC 10000-4, 7.37 UserTokenPolicy).
    pub(super) fn policies(&self, endpoint: &ServerEndpoint) -> Vec<WireTokenPolicy> {
        let policy = |token: &UserTokenPolicy| match token {
            UserTokenPolicy::Anonymous => WireTokenPolicy {
                policy_id: "anonymous".into(),
                token_type: UserTokenType::Anonymous,
                ..Default::default()
            },
            UserTokenPolicy::UserName => WireTokenPolicy {
                policy_id: user_pass_security_policy_id(endpoint),
                token_type: UserTokenType::UserName,
                // Null means the channel's own policy.
                security_policy_uri: match endpoint.security_policy() {
                    WirePolicy::None => endpoint.password_security_policy().to_uri().into(),
                    _ => UAString::null(),
                },
                ..Default::default()
            },
        };
        self.0.iter().map(policy).collect()
    }
}

/// What one client may ask of a controller. The longest answer is a read of 200 motion log blocks, about 0.5 MB.
pub(super) fn limits() -> Limits {
    Limits {
        max_sessions: super::admission::SESSIONS_BEHIND_THE_GATE,
        max_message_size: 2 << 20,
        max_chunk_count: 32,
        send_buffer_size: 65_535,
        receive_buffer_size: 65_535,
        max_array_length: 65_536,
        max_string_length: 65_535,
        max_byte_string_length: 1 << 20,
        max_browse_continuation_points: 100,
        max_history_continuation_points: 1,
        max_query_continuation_points: 1,
        subscriptions: SubscriptionLimits {
            max_subscriptions_per_session: 20,
            min_publishing_interval_ms: MIN_INTERVAL_MS,
            min_sampling_interval_ms: MIN_INTERVAL_MS,
            max_monitored_items_per_sub: 1_000,
            max_monitored_item_queue_size: 100,
            max_queued_notifications: 100,
            ..Default::default()
        },
        ..Default::default()
    }
}

/// Manual 3.1.
const MIN_INTERVAL_MS: f64 = 100.0;
pub(super) const SUBSCRIPTION_TICK_MS: u64 = 100;

/// The secure channel's token is renewed by the client when it chooses to, at the latest after a day: the crate may
/// drop a connection whose request is under way while the token changes, so it should change seldom.
pub(super) const TOKEN_LIFETIME_MS: u32 = 24 * 60 * 60 * 1000;
/// A session its client forgot holds one of the few places for at most this long.
pub(super) const SESSION_TIMEOUT_MS: u64 = 2 * 60 * 1000;
pub(super) const HELLO_TIMEOUT_SECS: u32 = 5;
