//! A small PKI around one application, all good until a case breaks something.

use chrono::Duration;
use opcua_configurator::model::{CertificateStatus, SecurityPolicy};
use opcua_configurator::pki::{Certificate, Crl, PeerRole, PresentedCertificate, TrustLists, TrustPolicy};

use super::forge::{
    Algorithm, CLIENT_AUTH, Cert, DNS, IP, Key, List, SERVER_AUTH, URI, alternative_names, authority_key_id,
    basic_constraints, extended_key_usage, key_usage, keys, name, now, subject_key_id,
};

pub const APPLICATION_URI: &str = "urn:plant:application";

#[derive(Clone)]
pub struct World {
    /// The application first, the root last.
    pub certs: Vec<Cert>,
    /// Of the CA one above: `lists[i]` is about `certs[i]`; and the root's about itself is the last one before it.
    pub lists: Vec<List>,
    /// Positions in `certs`.
    pub trusted: Vec<usize>,
    pub issuers: Vec<usize>,
    pub sent: Vec<usize>,
    /// Further ones, in DER; those that are trusted or issuers stand before the others.
    pub more_trusted: Vec<Vec<u8>>,
    pub more_issuers: Vec<Vec<u8>>,
    pub more_sent: Vec<Vec<u8>>,
    pub more_lists: Vec<Vec<u8>>,
    pub uri: Option<&'static str>,
    pub host: Option<&'static str>,
    pub security_policy: Option<SecurityPolicy>,
    pub role: PeerRole,
    pub policy: TrustPolicy,
    pub damage_leaf: Option<fn(&mut Vec<u8>)>,
    pub ask: Ask,
    /// OpenSSL looks at certificate policies only if it is told to.
    pub check_policies: bool,
    /// Whether OpenSSL looks for other keys that sign lists.
    pub extended_lists: bool,
}

/// How OpenSSL is asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ask {
    /// Every revocation list, up to the root.
    AllLists,
    /// A trusted certificate in the middle ends the chain; only the application's revocation list.
    PartialChain,
    /// No revocation lists.
    NoLists,
}

/// A chain of that many certificates, whose root is trusted and whose other CAs are issuers.
pub fn world(length: usize) -> World {
    let keys = keys();
    let mut certs: Vec<Cert> = Vec::new();
    for at in 0..length {
        let key: &'static Key = match at {
            0 => &keys.leaf,
            _ if at == length - 1 => &keys.root,
            middle => &keys.middle[(middle - 1) % 2],
        };
        let label = match at {
            0 => "Application".to_owned(),
            _ if at == length - 1 => "Root CA".to_owned(),
            middle => format!("CA {middle}"),
        };
        certs.push(if at == 0 { application(&name(&label), key) } else { authority(&name(&label), key) });
    }
    for at in 0..length {
        let issuer = certs[(at + 1).min(length - 1)].clone();
        issue(&mut certs[at], &issuer);
    }
    let lists = (1..length).map(|ca| List::of(&certs[ca])).collect();
    World {
        certs,
        lists,
        trusted: vec![length - 1],
        issuers: (1..length.saturating_sub(1)).collect(),
        sent: Vec::new(),
        more_trusted: Vec::new(),
        more_issuers: Vec::new(),
        more_sent: Vec::new(),
        more_lists: Vec::new(),
        uri: None,
        host: None,
        security_policy: None,
        role: PeerRole::Either,
        policy: TrustPolicy::default(),
        damage_leaf: None,
        // No authority could revoke a self-signed application; OpenSSL would want a list of its own.
        ask: if length == 1 { Ask::NoLists } else { Ask::AllLists },
        check_policies: false,
        extended_lists: false,
    }
}

/// Not signed by anybody yet.
fn application(subject: &[u8], key: &'static Key) -> Cert {
    Cert {
        extensions: vec![
            basic_constraints(false, None),
            key_usage(&[0, 1, 2, 3]),
            extended_key_usage(&[CLIENT_AUTH, SERVER_AUTH]),
            alternative_names(&[
                (URI, APPLICATION_URI.as_bytes()),
                (DNS, b"robot.plant.example"),
                (IP, &[192, 168, 10, 1]),
                (IP, &[0xfe, 0x80, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
            ]),
            subject_key_id(&key.id),
        ],
        ..authority(subject, key)
    }
}

/// Not signed by anybody yet.
pub fn authority(subject: &[u8], key: &'static Key) -> Cert {
    Cert {
        version: 2,
        serial: [&[0x11], &key.id[..8]].concat(),
        algorithm: Algorithm::Sha256,
        other_algorithm: None,
        subject: subject.to_vec(),
        issuer: subject.to_vec(),
        not_before: now() - Duration::days(365),
        not_after: now() + Duration::days(365),
        generalized: false,
        key,
        info: None,
        extensions: vec![basic_constraints(true, None), key_usage(&[5, 6]), subject_key_id(&key.id)],
        signer: key,
        damage: None,
    }
}

/// Lets `issuer` sign it.
pub fn issue(cert: &mut Cert, issuer: &Cert) {
    cert.issuer.clone_from(&issuer.subject);
    cert.signer = issuer.key;
    cert.set(authority_key_id(&issuer.key.id));
}

impl World {
    pub fn root(&self) -> usize {
        self.certs.len() - 1
    }

    /// Gives the certificate another key, with everything that follows from it.
    pub fn rekey(&mut self, at: usize, key: &'static Key) {
        let is_self_signed = at == self.root();
        self.certs[at].key = key;
        self.certs[at].set(subject_key_id(&key.id));
        let issuer = self.certs[at].clone();
        if is_self_signed {
            issue(&mut self.certs[at], &issuer);
        }
        if at > 0 {
            let below = at - 1;
            issue(&mut self.certs[below], &issuer);
            let entries = std::mem::take(&mut self.lists[below].entries);
            self.lists[below] = List { entries, ..List::of(&issuer) };
        }
    }

    /// Gives the CA another name, with everything that follows from it.
    pub fn rename(&mut self, at: usize, subject: &[u8]) {
        self.certs[at].subject = subject.to_vec();
        if at == self.root() {
            self.certs[at].issuer = subject.to_vec();
        }
        if at > 0 {
            self.certs[at - 1].issuer = subject.to_vec();
            self.lists[at - 1].issuer = subject.to_vec();
        }
    }

    pub fn built(&self) -> Built {
        let ders: Vec<Vec<u8>> = self.certs.iter().map(Cert::der).collect();
        let mut leaf = ders[0].clone();
        if let Some(damage) = self.damage_leaf {
            damage(&mut leaf);
        }
        let pick = |positions: &[usize], more: &[Vec<u8>]| -> Vec<Vec<u8>> {
            more.iter().cloned().chain(positions.iter().map(|at| ders[*at].clone())).collect()
        };
        Built {
            trusted: pick(&self.trusted, &self.more_trusted),
            issuers: pick(&self.issuers, &self.more_issuers),
            sent: pick(&self.sent, &self.more_sent),
            lists: self.lists.iter().map(List::der).chain(self.more_lists.iter().cloned()).collect(),
            leaf,
        }
    }
}

/// The files of a case.
pub struct Built {
    pub leaf: Vec<u8>,
    pub trusted: Vec<Vec<u8>>,
    pub issuers: Vec<Vec<u8>>,
    pub sent: Vec<Vec<u8>>,
    pub lists: Vec<Vec<u8>>,
}

/// What this program says. `None` is Good.
pub fn judge(world: &World, built: &Built) -> Result<Option<CertificateStatus>, String> {
    // What cannot be read fails at the first step: its structure.
    let Ok(certificate) = Certificate::from_der(&built.leaf) else {
        return Ok(Some(CertificateStatus::CertificateInvalid));
    };
    let parse = |ders: &[Vec<u8>]| -> Result<Vec<Certificate>, String> {
        ders.iter().map(|der| Certificate::from_der(der).map_err(|error| error.to_string())).collect()
    };
    let crls: Result<Vec<Crl>, _> = built.lists.iter().map(|der| Crl::from_der(der)).collect();
    let lists = TrustLists::new(parse(&built.trusted)?, parse(&built.issuers)?, crls.map_err(|e| e.to_string())?);
    let presented = PresentedCertificate {
        certificate: &certificate,
        chain: &parse(&built.sent)?,
        role: world.role,
        now: now(),
        application_uri: world.uri,
        host: world.host,
        security_policy: world.security_policy,
    };
    let first = lists.validate(&presented, &world.policy);
    let second = lists.validate(&presented, &world.policy);
    if first != second {
        return Err(format!("asked twice, it says {first:?} and {second:?}"));
    }
    if let Err(rejection) = &first
        && rejection.to_string().contains(char::is_control)
    {
        return Err(format!("control characters in {rejection:?}"));
    }
    Ok(first.err().map(|rejection| rejection.status()))
}
