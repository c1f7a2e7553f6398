//! Revocation lists about some certificates only, and lists that another key of the issuer signed.

use super::*;

/// A name in a distribution point: a URI.
fn uri(text: &str) -> Vec<u8> {
    tlv(0x86, &[text.as_bytes()])
}

/// The same: the name of a directory entry.
fn directory(name: &[u8]) -> Vec<u8> {
    tlv(0xa4, &[name])
}

fn full_name(names: &[Vec<u8>]) -> Vec<u8> {
    let names: Vec<&[u8]> = names.iter().map(Vec::as_slice).collect();
    tlv(0xa0, &names)
}

/// IssuingDistributionPoint.
fn scope(fields: &[Vec<u8>]) -> Extension {
    let fields: Vec<&[u8]> = fields.iter().map(Vec::as_slice).collect();
    Extension::new(DISTRIBUTION_POINT, true, seq(&fields))
}

/// The field of an IssuingDistributionPoint, or of a distribution point.
fn named(names: &[Vec<u8>]) -> Vec<u8> {
    tlv(0xa0, &[&full_name(names)])
}

/// cRLDistributionPoints with one point.
fn points(fields: &[Vec<u8>]) -> Extension {
    let fields: Vec<&[u8]> = fields.iter().map(Vec::as_slice).collect();
    Extension::new("2.5.29.31", false, seq(&[&seq(&fields)]))
}

const ONLY_USERS: [u8; 3] = [0x81, 1, 0xff];
const ONLY_AUTHORITIES: [u8; 3] = [0x82, 1, 0xff];
const ONLY_ATTRIBUTES: [u8; 3] = [0x85, 1, 0xff];
const INDIRECT: [u8; 3] = [0x84, 1, 0xff];
/// keyCompromise and cACompromise; the others.
const COMPROMISES: [u8; 4] = [0x83, 2, 5, 0x60];
const OTHER_REASONS: [u8; 5] = [0x83, 3, 7, 0x9f, 0x80];
const HERE: &str = "http://plant.example/1.crl";

pub(super) fn scopes(table: &mut Table) {
    let needs_extended = Differs("OpenSSL is not told about lists with reasons");
    for length in 2..=3 {
        for at in 0..length - 1 {
            let unknown = by_depth(RevocationUnknown, IssuerRevocationUnknown)(at);
            let revoked = by_depth(Revoked, IssuerRevoked)(at);
            // OpenSSL asks the root's list about the root as well.
            let of_root = at + 1 == length - 1;
            let mut list =
                |what: &str, expected: Option<Status>, peer, point: Option<Extension>, fields: &[Vec<u8>]| {
                    for is_revoked in [false, true] {
                        // What a list says of a certificate is so, even if the list need not have said it.
                        let expected = if is_revoked { revoked } else { expected };
                        let peer = if is_revoked { Agrees } else { peer };
                        let what = format!("{what} for {at}{}", if is_revoked { ", which revokes it" } else { "" });
                        table.one(&what, length, expected, peer, |world| {
                            if let Some(point) = &point {
                                world.certs[at].set(point.clone());
                                if of_root {
                                    world.certs[at + 1].set(point.clone());
                                }
                            }
                            let serial = world.certs[at].serial.clone();
                            let list = &mut world.lists[at];
                            list.extensions.push(scope(fields));
                            if is_revoked {
                                list.entries.push(Entry::new(&serial));
                            }
                        });
                    }
                };
            let root_too = Differs("OpenSSL asks the list about the root, which is no application");
            let (users, peer) = match at {
                0 if of_root => (None, root_too),
                0 => (None, Agrees),
                _ => (unknown, Agrees),
            };
            list("a list only about applications", users, peer, None, &[ONLY_USERS.to_vec()]);
            let authorities = if at == 0 { unknown } else { None };
            list("a list only about CAs", authorities, Agrees, None, &[ONLY_AUTHORITIES.to_vec()]);
            list("a list only about attribute certificates", unknown, Agrees, None, &[ONLY_ATTRIBUTES.to_vec()]);
            list("a list about nothing", unknown, Agrees, None, &[ONLY_USERS.to_vec(), ONLY_AUTHORITIES.to_vec()]);
            list("a list only about some reasons", unknown, Agrees, None, &[COMPROMISES.to_vec()]);

            let here = named(&[uri(HERE)]);
            let point = |fields: &[Vec<u8>]| Some(points(fields));
            list("a list of one distribution point", unknown, Agrees, None, std::slice::from_ref(&here));
            list(
                "a list of the distribution point",
                None,
                Agrees,
                point(std::slice::from_ref(&here)),
                std::slice::from_ref(&here),
            );
            let both = named(&[uri("ldap://plant.example"), uri(HERE)]);
            list(
                "a list of two points, one the certificate's",
                None,
                Agrees,
                point(std::slice::from_ref(&here)),
                std::slice::from_ref(&both),
            );
            list(
                "a list of one of the certificate's points",
                None,
                Agrees,
                point(&[both]),
                std::slice::from_ref(&here),
            );
            let elsewhere = named(&[uri("http://plant.example/2.crl")]);
            list("a list of another point", unknown, Agrees, point(&[elsewhere]), std::slice::from_ref(&here));
            let shouted = named(&[uri("HTTP://PLANT.example/1.crl")]);
            let by_letter = Differs("OpenSSL compares schemes and hosts letter by letter");
            list(
                "a list of the point, its host in capitals",
                None,
                by_letter,
                point(&[shouted]),
                std::slice::from_ref(&here),
            );
            let small = named(&[uri("http://plant.example/1.CRL")]);
            list("a list of a point in other letters", unknown, Agrees, point(&[small]), std::slice::from_ref(&here));
            let of_another = tlv(0xa2, &[&directory(&name("Another CA"))]);
            let theirs = point(&[here.clone(), of_another]);
            list(
                "a list of a point where another CA's lists are",
                unknown,
                Agrees,
                theirs,
                std::slice::from_ref(&here),
            );
            let few = point(&[here.clone(), vec![0x81, 2, 5, 0x60]]);
            list("a list of a point for some reasons", unknown, Agrees, few, std::slice::from_ref(&here));

            table.one(
                &format!("the list of the issuer's own name, for {at}"),
                length,
                None,
                Differs("OpenSSL wants the name among the certificate's distribution points"),
                |world| {
                    let issuer = world.certs[at + 1].subject.clone();
                    world.lists[at].extensions.push(scope(&[named(&[directory(&issuer)])]));
                },
            );
            table.one(&format!("a list of a point relative to the issuer, for {at}"), length, None, Agrees, |world| {
                let last = seq(&[&oid(COMMON_NAME), &tlv(UTF8, &[b"Lists"])]);
                let relative = tlv(0xa0, &[&tlv(0xa1, &[&last])]);
                world.certs[at].set(points(std::slice::from_ref(&relative)));
                let issuer = world.certs[at + 1].subject.clone();
                if of_root {
                    world.certs[at + 1].set(points(std::slice::from_ref(&relative)));
                }
                // A name is a SEQUENCE with one byte of length here.
                let whole = tlv(0x30, &[&issuer[2..], &set(&[&last])]);
                world.lists[at].extensions.push(scope(&[named(&[directory(&whole)])]));
            });
            for (what, expected, peer, reasons) in [
                ("all reasons", None, needs_extended, [COMPROMISES.to_vec(), OTHER_REASONS.to_vec()]),
                ("the same reasons", unknown, Agrees, [COMPROMISES.to_vec(), COMPROMISES.to_vec()]),
            ] {
                table.one(&format!("two lists about {what} for {at}"), length, expected, peer, |world| {
                    let mut second = world.lists[at].clone();
                    world.lists[at].extensions.push(scope(&reasons[..1]));
                    second.extensions.push(scope(&reasons[1..]));
                    world.more_lists.push(second.der());
                });
            }
            table.one(&format!("lists of applications and of CAs for {at}"), length, None, Agrees, |world| {
                let mut second = world.lists[at].clone();
                world.lists[at].extensions.push(scope(&[ONLY_USERS.to_vec()]));
                second.extensions.push(scope(&[ONLY_AUTHORITIES.to_vec()]));
                world.more_lists.push(second.der());
            });
            table.one(&format!("an indirect list for {at}"), length, unknown, Agrees, |world| {
                world.lists[at].extensions.push(scope(&[INDIRECT.to_vec()]));
            });
            table.one(&format!("an unfinished scope for {at}"), length, unknown, Agrees, |world| {
                world.lists[at].extensions.push(scope(&[here.clone(), INDIRECT.to_vec()]));
            });
        }
    }
}

/// The CA in the middle got a new key, with which it signs its lists; the application's certificate is of the old one.
pub(super) fn new_keys(table: &mut Table) {
    /// Lets the new key sign the list about the application.
    fn signed_by_new_key(world: &mut World) {
        let new = &keys().stranger;
        let list = &mut world.lists[0];
        list.signer = new;
        list.drop(AUTHORITY_KEY_ID);
        list.extensions.push(authority_key_id(&new.id));
        world.extended_lists = true;
    }
    /// The CA's own certificate for its new key, issued by what stands at `issuer`.
    fn new_certificate(world: &World, issuer: &Cert) -> Cert {
        let mut new = authority(&world.certs[1].subject, &keys().stranger);
        new.serial = vec![0x55];
        issue(&mut new, issuer);
        new
    }
    let mut case = |what: &str, expected: Option<Status>, peer, change: &dyn Fn(&mut World)| {
        table.one(&format!("a list of a new key, {what}"), 3, expected, peer, |world| {
            signed_by_new_key(world);
            change(world);
        });
    };
    let unknown = Some(RevocationUnknown);
    case("of which nothing is held", unknown, Agrees, &|_| {});
    case("which the root certified", None, Agrees, &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.more_issuers.push(new.der());
    });
    case("which revokes the certificate", Some(Revoked), Agrees, &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.more_issuers.push(new.der());
        let serial = world.certs[0].serial.clone();
        world.lists[0].entries.push(Entry::new(&serial));
    });
    case("which only signs lists", None, Agrees, &|world| {
        let mut new = new_certificate(world, &world.certs[2]);
        new.set(key_usage(&[6]));
        new.set(basic_constraints(false, None));
        world.more_issuers.push(new.der());
    });
    case("which signs no lists", unknown, Agrees, &|world| {
        let mut new = new_certificate(world, &world.certs[2]);
        new.set(key_usage(&[5]));
        world.more_issuers.push(new.der());
    });
    case("which the old key certified", None, Agrees, &|world| {
        let new = new_certificate(world, &world.certs[1]);
        world.more_issuers.push(new.der());
        let mut of_cas = List::of(&world.certs[1]);
        of_cas.extensions.push(scope(&[ONLY_AUTHORITIES.to_vec()]));
        world.more_lists.push(of_cas.der());
    });
    case("which says of itself that it was not revoked", unknown, Agrees, &|world| {
        let new = new_certificate(world, &world.certs[1]);
        world.more_issuers.push(new.der());
    });
    case("which is trusted", None, Differs("OpenSSL takes no key's word for itself"), &|world| {
        let new = new_certificate(world, &world.certs[1]);
        world.more_trusted.push(new.der());
    });
    case("which was revoked", unknown, Agrees, &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.lists[1].entries.push(Entry::new(&new.serial));
        world.more_issuers.push(new.der());
    });
    case("which expired", unknown, Differs("openssl verify goes on after an expired certificate"), &|world| {
        let mut new = new_certificate(world, &world.certs[2]);
        new.not_after = now() - Duration::days(1);
        world.more_issuers.push(new.der());
    });
    case("which nobody certified", unknown, Agrees, &|world| {
        let mut new = new_certificate(world, &world.certs[2]);
        new.signer = &keys().middle[1];
        world.more_issuers.push(new.der());
    });
    for trusted in [false, true] {
        case(&format!("which another root certified, trusted: {trusted}"), unknown, Agrees, &|world| {
            let other = authority(&name("Other Root"), &keys().middle[1]);
            let new = new_certificate(world, &other);
            let place = if trusted { &mut world.more_trusted } else { &mut world.more_issuers };
            place.push(new.der());
            world.more_trusted.push(other.der());
            world.more_lists.push(List::of(&other).der());
        });
    }
    case("which is a namesake's and trusted", unknown, Agrees, &|world| {
        let namesake = authority(&world.certs[1].subject, &keys().stranger);
        world.more_trusted.push(namesake.der());
    });
    case("which was sent, not held", unknown, Differs("OpenSSL does not ask where a certificate is from"), &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.more_sent.push(new.der());
    });
    case("and an expired one of the old key", None, Agrees, &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.more_issuers.push(new.der());
        let mut old = List::of(&world.certs[1]);
        old.this_update = now() - Duration::days(60);
        old.next_update = Some(now() - Duration::days(30));
        world.more_lists.push(old.der());
    });
    case("and an older one of the old key that revokes it", Some(Revoked), Agrees, &|world| {
        let new = new_certificate(world, &world.certs[2]);
        world.more_issuers.push(new.der());
        let mut old = List::of(&world.certs[1]);
        old.this_update = now() - Duration::days(2);
        old.entries.push(Entry::new(&world.certs[0].serial));
        world.more_lists.push(old.der());
    });
}
