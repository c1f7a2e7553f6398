/// Lets this process open [`ENOUGH`] files, or as many as the system allows it to. Many systems begin with 1024, and each controller
/// of a fleet listens with one, besides its connections. If it cannot be raised, large fleets say so by themselves.
#[cfg(unix)]
pub fn raise_file_limit() {
    let mut limit = libc::rlimit { rlim_cur: 0, rlim_max: 0 };
    // SAFETY: both calls only read or write the one structure they are given, which outlives them.
    let raised = unsafe {
        libc::getrlimit(libc::RLIMIT_NOFILE, &raw mut limit) == 0 && {
            limit.rlim_cur = limit.rlim_cur.max(limit.rlim_max.min(ENOUGH));
            libc::setrlimit(libc::RLIMIT_NOFILE, &raw const limit) == 0
        }
    };
    if !raised {
        tracing::debug!("the limit of open files stays as it is");
    }
}

#[cfg(unix)]
const ENOUGH: libc::rlim_t = 65_536;

#[cfg(not(unix))]
pub fn raise_file_limit() {}
