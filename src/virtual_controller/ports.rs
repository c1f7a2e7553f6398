use std::io;
use std::net::{IpAddr, TcpListener};
use std::sync::atomic::{AtomicU32, Ordering};

/// Below what operating systems give to outgoing connections, so that a port is still free when its controller starts
/// hours later, and above what services usually take.
const FIRST: u32 = 12_000;
const COUNT: u32 = 20_000;

/// Where this process looks next. It never gives the same port twice until it has been all the way round.
static NEXT: AtomicU32 = AtomicU32::new(u32::MAX);

/// A free TCP port at `bind`, for later use. Processes begin at different places.
pub fn free_port(bind: IpAddr) -> io::Result<u16> {
    let start = std::process::id().wrapping_mul(7919) % COUNT;
    // Fails when the place is set already, which is as good.
    let _ = NEXT.compare_exchange(u32::MAX, start, Ordering::Relaxed, Ordering::Relaxed);
    for _ in 0..COUNT {
        let place = NEXT.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |next| Some((next + 1) % COUNT));
        let place = place.unwrap_or_default();
        let Ok(port) = u16::try_from(FIRST + place) else { continue };
        match TcpListener::bind((bind, port)) {
            Ok(_) => return Ok(port),
            Err(error) if error.kind() == io::ErrorKind::AddrInUse => {}
            Err(error) => return Err(error),
        }
    }
    Err(io::ErrorKind::AddrInUse.into())
}

/// Whether a TCP port of `bind` is free at this moment.
pub fn is_free(bind: IpAddr, port: u16) -> bool {
    TcpListener::bind((bind, port)).is_ok()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn no_port_is_given_twice() {
        let loopback = "127.0.0.1".parse().unwrap();
        let ports: BTreeSet<u16> = (0..100).map(|_| free_port(loopback).unwrap()).collect();
        assert_eq!(ports.len(), 100);
    }
}
