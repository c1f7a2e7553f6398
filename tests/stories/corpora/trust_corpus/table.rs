//! Every case: what is wrong, what OPC UA says of it, and what OpenSSL says.

mod chain_cases;
mod constraint_cases;
mod name_cases;
mod revocation_cases;
mod scope_cases;
mod trust_cases;
mod usage_cases;

use chrono::{Duration, NaiveDate};
use opcua_configurator::model::CertificateStatus::{self as Status, *};
use opcua_configurator::model::SecurityPolicy as Policy;
use opcua_configurator::pki::{PeerRole, TrustPolicy};

use super::der::{boolean, int, oid, seq, set, tlv};
use super::forge::{Algorithm, *};
use super::openssl::Version;
use super::world::{APPLICATION_URI, Ask, World, authority, issue, world};

pub struct Case {
    pub name: String,
    pub world: World,
    /// `None` is Good.
    pub expected: Option<Status>,
    pub peer: Peer,
}

/// What OpenSSL says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Peer {
    /// Good is good and bad is bad.
    Agrees,
    /// The opposite, rightly.
    Differs(&'static str),
    /// It depends on the version: a change is in every release, of any branch, made after it was merged.
    Changed { merged: NaiveDate, before: &'static Peer, after: &'static Peer },
}
use Peer::{Agrees, Changed, Differs};

impl Peer {
    /// What this version says: [`Peer::Agrees`] or [`Peer::Differs`]. `None`: the version does not tell.
    pub fn of(self, version: &Version) -> Option<Self> {
        match self {
            Agrees | Differs(_) => Some(self),
            Changed { merged, before, after } => {
                if version.released? > merged {
                    after.of(version)
                } else {
                    before.of(version)
                }
            }
        }
    }
}

/// Since then OpenSSL takes no delta list for a whole one (openssl/openssl#31044); first released on 2026-08-25, in
/// 3.0.22.
const NO_DELTA_AS_A_WHOLE: NaiveDate = NaiveDate::from_ymd_opt(2026, 6, 17).expect("a date");
const OLD_DELTAS: Peer = Differs("OpenSSL takes a delta list for a whole one, unless it is told about them");
const NEW_DELTAS: Peer = Differs("OpenSSL ignores a delta list, and what it revokes, unless it is told about them");

#[derive(Default)]
struct Table(Vec<Case>);

impl Table {
    fn add(&mut self, name: impl Into<String>, world: World, expected: Option<Status>, peer: Peer) {
        self.0.push(Case { name: name.into(), world, expected, peer });
    }

    /// The same change to the world of every length at every position it makes sense at.
    fn everywhere(
        &mut self,
        what: &str,
        lengths: std::ops::RangeInclusive<usize>,
        change: impl Fn(&mut World, usize),
        expected: impl Fn(usize) -> Option<Status>,
        peer: impl Fn(&World, usize) -> Peer,
    ) {
        for length in lengths {
            for at in 0..length {
                let mut world = world(length);
                change(&mut world, at);
                let peer = peer(&world, at);
                self.add(format!("{what}, at {at} of {length}"), world, expected(at), peer);
            }
        }
    }

    fn one(&mut self, what: &str, length: usize, expected: Option<Status>, peer: Peer, change: impl Fn(&mut World)) {
        let mut world = world(length);
        change(&mut world);
        self.add(format!("{what} (of {length})"), world, expected, peer);
    }
}

const NOT_A_ROOTS: Peer = Differs("OpenSSL does not look at the signature a trusted root makes for itself");
const NO_OPC_UA: Peer = Differs("OpenSSL does not know what OPC UA asks of an application");

pub fn cases() -> Vec<Case> {
    let mut table = Table::default();
    chain_cases::good(&mut table);
    chain_cases::dates(&mut table);
    chain_cases::signatures(&mut table);
    chain_cases::strength(&mut table);
    chain_cases::structure(&mut table);
    constraint_cases::names(&mut table);
    constraint_cases::certificate_policies(&mut table);
    name_cases::names_and_serials(&mut table);
    trust_cases::trust(&mut table);
    trust_cases::several_chains(&mut table);
    usage_cases::usages(&mut table);
    usage_cases::hosts_and_uris(&mut table);
    revocation_cases::revocations(&mut table);
    revocation_cases::missing_lists(&mut table);
    revocation_cases::bad_lists(&mut table);
    scope_cases::scopes(&mut table);
    scope_cases::new_keys(&mut table);
    table.0
}

fn by_depth(leaf: Status, issuer: Status) -> impl Fn(usize) -> Option<Status> {
    move |at| Some(if at == 0 { leaf } else { issuer })
}

fn agrees(_: &World, _: usize) -> Peer {
    Agrees
}

fn except_root(world: &World, at: usize) -> Peer {
    if at == world.root() { NOT_A_ROOTS } else { Agrees }
}
