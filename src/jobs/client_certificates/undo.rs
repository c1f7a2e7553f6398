use super::TrustSnapshot;
use crate::model::{Base64Bytes, ClientList, TrustStep};

/// What puts the lists and CRLs of one controller back to what they were before a change.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TrustUndo(pub(super) Vec<TrustStep>);

/// What makes `before` of `after` again; `None` if they are the same, or nothing can.
pub(super) fn undo(before: &TrustSnapshot, after: &TrustSnapshot) -> Option<TrustUndo> {
    let mut steps = Vec::new();
    let gone_crls = difference(ids(after), ids(before));
    if !gone_crls.is_empty() {
        steps.push(TrustStep::RemoveCrls { ids: gone_crls });
    }
    // What was put into a list goes back where it came from, before anything is put there: a full list has room then.
    for list in LISTS {
        let came = difference(after.thumbprints(list), before.thumbprints(list));
        let origin = |thumbprint: &String| {
            [other(list), ClientList::Rejected].into_iter().find(|from| left(before, after, *from, thumbprint))
        };
        for from in [Some(ClientList::Rejected), Some(other(list)), None] {
            let thumbprints: Vec<String> = came.iter().filter(|t| origin(t) == from).cloned().collect();
            match from {
                _ if thumbprints.is_empty() => {}
                Some(from) => steps.push(TrustStep::Move { from: list, to: from, thumbprints }),
                None => steps.push(TrustStep::Remove { list, thumbprints }),
            }
        }
    }
    for list in LISTS {
        let lost: Vec<(String, Base64Bytes)> = before
            .listed(list)
            .iter()
            .filter(|was| {
                let thumbprint = &was.summary.thumbprint;
                !after.holds(list, thumbprint) && !arrived(before, after, other(list), thumbprint)
            })
            .map(|was| (was.file_name.clone(), was.certificate.clone()))
            .collect();
        if !lost.is_empty() {
            steps.push(TrustStep::Add { list, certificates: lost });
        }
    }
    let lost: Vec<(String, Base64Bytes)> = before
        .crls
        .iter()
        .filter(|was| !after.holds_crl(&was.summary.id))
        .filter_map(|was| Some((was.file_name.clone(), was.crl.clone()?)))
        .collect();
    if !lost.is_empty() {
        steps.push(TrustStep::AddCrls { crls: lost });
    }
    (!steps.is_empty()).then_some(TrustUndo(steps))
}

const LISTS: [ClientList; 2] = [ClientList::Trusted, ClientList::Issuers];

const fn other(list: ClientList) -> ClientList {
    match list {
        ClientList::Issuers => ClientList::Trusted,
        ClientList::Trusted | ClientList::Rejected => ClientList::Issuers,
    }
}

fn left(before: &TrustSnapshot, after: &TrustSnapshot, list: ClientList, thumbprint: &str) -> bool {
    before.holds(list, thumbprint) && !after.holds(list, thumbprint)
}

fn arrived(before: &TrustSnapshot, after: &TrustSnapshot, list: ClientList, thumbprint: &str) -> bool {
    left(after, before, list, thumbprint)
}

fn ids(lists: &TrustSnapshot) -> impl Iterator<Item = &str> {
    lists.crls.iter().map(|crl| crl.summary.id.as_str())
}

/// What is in `these` but not in `those`.
fn difference<'a>(these: impl Iterator<Item = &'a str>, those: impl Iterator<Item = &'a str>) -> Vec<String> {
    let those: Vec<&str> = those.collect();
    these.filter(|this| !those.contains(this)).map(ToOwned::to_owned).collect()
}

#[cfg(test)]
mod tests {
    use super::super::samples::{application, authority, listed, listed_crl, rejected, snapshot};
    use super::*;
    use crate::model::FirmwareGeneration::Current;

    fn steps(before: &TrustSnapshot, after: &TrustSnapshot) -> Vec<TrustStep> {
        undo(before, after).expect("something to take back").0
    }

    #[test]
    fn what_was_removed_is_added_again_under_its_name() {
        let client = application("client");
        let after = snapshot(Current);
        let mut before = after.clone();
        before.trusted.push(listed(&client));
        let certificates = vec![("client.der".to_owned(), Base64Bytes(client.der().to_vec()))];
        let again = TrustStep::Add { list: ClientList::Trusted, certificates };
        assert_eq!(steps(&before, &after), std::slice::from_ref(&again));
        // Also if it went to the rejected ones: it would come back from there without its name.
        let mut moved = after.clone();
        moved.rejected.push(rejected(&client));
        assert_eq!(steps(&before, &moved), [again]);
    }

    #[test]
    fn what_was_added_is_removed_and_what_was_moved_goes_back() {
        let (one, two, three) = (application("one"), application("two"), authority("three").certificate);
        let mut before = snapshot(Current);
        before.rejected.push(rejected(&two));
        before.trusted.push(listed(&three));
        let mut after = snapshot(Current);
        after.trusted = vec![listed(&one), listed(&two)];
        after.issuers.push(listed(&three));
        let prints = |certificate: &crate::pki::Certificate| vec![certificate.thumbprint_sha1()];
        assert_eq!(
            steps(&before, &after),
            [
                TrustStep::Move { from: ClientList::Trusted, to: ClientList::Rejected, thumbprints: prints(&two) },
                TrustStep::Remove { list: ClientList::Trusted, thumbprints: prints(&one) },
                TrustStep::Move { from: ClientList::Issuers, to: ClientList::Trusted, thumbprints: prints(&three) },
            ]
        );
    }

    #[test]
    fn a_crl_that_was_replaced_takes_its_place_again() {
        let ca = authority("Plant CA");
        let (old, new) = (ca.crl(1), ca.crl(2));
        let (mut before, mut after) = (snapshot(Current), snapshot(Current));
        before.crls.push(listed_crl(&old));
        after.crls.push(listed_crl(&new));
        let crls = vec![("plant.crl".to_owned(), Base64Bytes(old.der().to_vec()))];
        let back = [TrustStep::RemoveCrls { ids: vec![new.id()] }, TrustStep::AddCrls { crls }];
        assert_eq!(steps(&before, &after), back);
    }

    #[test]
    fn what_the_controller_forgot_for_good_cannot_be_taken_back() {
        let mut before = snapshot(Current);
        before.rejected.push(rejected(&application("client")));
        assert_eq!(undo(&before, &snapshot(Current)), None);
        assert_eq!(undo(&before, &before), None);
    }
}
