use super::*;
use crate::jobs::client_certificates::samples::{
    application, authority, issuing_application, listed, listed_crl, now, rejected, snapshot,
};
use crate::model::FirmwareGeneration;

fn file(name: &str, certificates: &[&Certificate], crls: &[&Crl]) -> TrustFile {
    let certificates = certificates.iter().copied().cloned().collect();
    TrustFile {
        file_name: name.to_owned(),
        bundle: Bundle { certificates, crls: crls.iter().copied().cloned().collect() },
    }
}

fn plan(files: &[TrustFile], destination: Destination, generation: FirmwareGeneration) -> TrustPlan {
    TrustPlan::for_controller(files, destination, &snapshot(generation))
}

fn planned_actions(plan: &TrustPlan) -> Vec<PlannedAction> {
    plan.items.iter().map(|item| item.action.clone()).collect()
}

fn goes(to: TargetList, notes: &[TrustNote]) -> PlannedAction {
    PlannedAction::Send { to, notes: notes.to_vec() }
}

use FirmwareGeneration::{Current, Legacy};
use PlannedAction::Skipped;

#[test]
fn a_chain_with_its_crl_is_sorted_by_kind() {
    let (ca, client) = (authority("Plant CA"), application("client"));
    let files = [file("chain.p7b", &[&client, &ca.certificate], &[&ca.crl(1)])];
    for destination in [Destination::ByKind, Destination::Trusted] {
        let current = plan(&files, destination, Current);
        let note: &[TrustNote] =
            if destination == Destination::ByKind { &[] } else { &[TrustNote::OnlyCompletesAChain] };
        let crl = goes(TargetList::Crls, &[TrustNote::CrlAmongCertificates]);
        assert_eq!(planned_actions(&current), [goes(TargetList::Trusted, &[]), goes(TargetList::Issuers, note), crl]);
        assert_eq!(current.check(), Ok(()));
        let names: Vec<&str> = current.items.iter().map(|item| item.shown_as.as_str()).collect();
        assert_eq!(names, ["chain_1.der", "chain_2.der", "chain_3.crl"]);
        assert_eq!(current.steps().len(), 3);

        let legacy = plan(&files, destination, Legacy);
        assert_eq!(planned_actions(&legacy)[1], goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues]));
        assert!(legacy.needs_a_look());
    }
}

#[test]
fn what_issued_a_certificate_at_hand_is_an_authority_whatever_it_says() {
    let (plain, issuing) = (application("plain"), issuing_application("signer"));
    let files = [file("signer.der", &[&issuing.certificate], &[])];
    let alone = plan(&files, Destination::ByKind, Current);
    assert_eq!(planned_actions(&alone), [goes(TargetList::Trusted, &[])]);
    let below = issuing.client("client");
    let with_client = [files[0].clone(), file("client.der", &[&below], &[])];
    let planned = plan(&with_client, Destination::ByKind, Current);
    assert_eq!(planned_actions(&planned), [goes(TargetList::Issuers, &[]), goes(TargetList::Trusted, &[])]);
    for held_somewhere in [true, false] {
        let mut held = snapshot(Current);
        if held_somewhere {
            held.trusted.push(listed(&below));
        } else {
            held.rejected.push(rejected(&below));
        }
        held.trusted.push(listed(&plain));
        let planned = TrustPlan::for_controller(&files, Destination::Trusted, &held);
        assert_eq!(planned_actions(&planned), [goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues])]);
    }
}

#[test]
fn an_authority_alone_becomes_trusted_only_where_that_was_asked_for() {
    let ca = authority("Plant CA");
    let files = [file("ca.der", &[&ca.certificate], &[])];
    assert_eq!(planned_actions(&plan(&files, Destination::ByKind, Current)), [goes(TargetList::Issuers, &[])]);
    assert!(!plan(&files, Destination::ByKind, Current).needs_a_look());
    let trusted = plan(&files, Destination::Trusted, Current);
    assert_eq!(planned_actions(&trusted), [goes(TargetList::Trusted, &[TrustNote::TrustsAllItIssues])]);
    assert_eq!(trusted.items[0].shown_as, "ca.der");
    assert!(trusted.needs_a_look());
}

#[test]
fn the_issuers_list_takes_authorities_only() {
    let (ca, client) = (authority("Plant CA"), application("client"));
    let chain = [file("chain.pem", &[&client, &ca.certificate], &[])];
    let sorted = plan(&chain, Destination::Issuers, Current);
    assert_eq!(planned_actions(&sorted), [Skipped(SkipReason::NotAskedFor), goes(TargetList::Issuers, &[])]);
    let alone = plan(&[file("client.der", &[&client], &[])], Destination::Issuers, Current);
    assert_eq!(alone.check().unwrap_err().code, ErrorCode::NotAnAuthority);
    assert_eq!(plan(&chain, Destination::Issuers, Legacy).check().unwrap_err().code, ErrorCode::FirmwareTooOld);
}

#[test]
fn what_is_there_already_is_left_out() {
    let (one, two) = (application("one"), application("two"));
    let mut held = snapshot(Current);
    held.trusted.push(listed(&one));
    let files = [file("one.der", &[&one], &[]), file("two.der", &[&two], &[]), file("again.der", &[&two], &[])];
    let both = TrustPlan::for_controller(&files, Destination::Trusted, &held);
    let left_out = [Skipped(SkipReason::AlreadyHeld), goes(TargetList::Trusted, &[]), Skipped(SkipReason::Repeated)];
    assert_eq!(planned_actions(&both), left_out);
    assert_eq!(both.check(), Ok(()));
    let nothing = TrustPlan::for_controller(&files[..1], Destination::Trusted, &held);
    assert_eq!(nothing.check(), Err(ErrorCode::DuplicateCertificate.into()));
    assert_eq!(plan(&[], Destination::Trusted, Current).check(), Err(ErrorCode::BadCertificate.into()));
}

#[test]
fn an_older_crl_never_takes_the_place_of_a_newer_one() {
    let ca = authority("Plant CA");
    let (old, held, new) = (ca.crl(1), ca.crl(2), ca.crl(3));
    let mut lists = snapshot(Current);
    lists.crls.push(listed_crl(&held));
    let planned = |files: &[TrustFile], to| TrustPlan::for_controller(files, to, &lists);
    let newer = planned(&[file("3.crl", &[], &[&new])], Destination::Crls);
    assert_eq!(planned_actions(&newer), [goes(TargetList::Crls, &[TrustNote::ReplacesOlder])]);
    let same = planned(&[file("2.crl", &[], &[&held])], Destination::Crls);
    assert_eq!(same.check(), Err(ErrorCode::DuplicateCrl.into()));
    let older = planned(&[file("1.crl", &[], &[&old])], Destination::Crls);
    assert_eq!(older.check().unwrap_err().code, ErrorCode::CrlOutdated);
    // One that came along with certificates is no reason to refuse those.
    let along = planned(&[file("chain.p7b", &[&ca.certificate], &[&old])], Destination::ByKind);
    assert_eq!(planned_actions(&along), [goes(TargetList::Issuers, &[]), Skipped(SkipReason::Outdated)]);
    let both = planned(&[file("1.crl", &[], &[&old]), file("3.crl", &[], &[&new])], Destination::Crls);
    assert_eq!(
        planned_actions(&both),
        [Skipped(SkipReason::Outdated), goes(TargetList::Crls, &[TrustNote::ReplacesOlder])]
    );
}

/// Made by OpenSSL; the authority was set up anew with the same key.
#[test]
fn a_crl_whose_number_starts_again_is_taken_with_both_numbers_and_dates() {
    let read = |der: &[u8]| Crl::from_der(der).unwrap();
    let before = read(include_bytes!("../../../../tests/cases/12-crl-number-reset/crls/0.crl"));
    let after = read(include_bytes!("../../../../tests/cases/12-crl-number-reset/crls/1.crl"));
    let note = TrustNote::NumberStartsAgain {
        number: "1".to_owned(),
        date: after.this_update(),
        before: "500".to_owned(),
        date_before: before.this_update(),
    };
    let mut held = snapshot(Current);
    held.clock = "2026-11-27T12:00:00Z".parse().unwrap();
    held.crls.push(listed_crl(&before));
    let planned = TrustPlan::for_controller(&[file("1.crl", &[], &[&after])], Destination::Crls, &held);
    assert_eq!(planned_actions(&planned), [goes(TargetList::Crls, &[TrustNote::ReplacesOlder, note.clone()])]);
    assert!(planned.needs_a_look());
    assert_eq!(planned.check(), Ok(()));
    for language in crate::model::Language::ALL {
        let said = note.text(language);
        for date in ["2026-10-18T15:16:44Z", "2026-11-26T15:16:44Z"] {
            assert!(said.contains(date), "no {date} in {said}");
        }
        let numbers: Vec<&str> = said.split(|c: char| !c.is_ascii_digit()).collect();
        assert!(numbers.contains(&"500") && numbers.contains(&"1"), "{said}");
    }
    held.crls.clear();
    let files = [file("0.crl", &[], &[&before]), file("1.crl", &[], &[&after])];
    let planned = TrustPlan::for_controller(&files, Destination::Crls, &held);
    assert_eq!(
        planned_actions(&planned),
        [Skipped(SkipReason::Outdated), goes(TargetList::Crls, &[note])],
        "both come at once"
    );
    held.crls = vec![listed_crl(&after)];
    let planned = TrustPlan::for_controller(&files[..1], Destination::Crls, &held);
    let [PlannedAction::Refused(problem)] = &planned_actions(&planned)[..] else { panic!("{planned:?}") };
    assert_eq!(problem.code, ErrorCode::CrlOutdated);
}

#[test]
fn limits_hold_before_anything_is_sent() {
    let certificates: Vec<Certificate> = (0..11).map(|i| application(&format!("client{i}"))).collect();
    let files: Vec<TrustFile> = certificates.iter().map(|c| file("c.der", &[c], &[])).collect();
    assert_eq!(plan(&files[..10], Destination::Trusted, Legacy).check(), Ok(()));
    assert_eq!(plan(&files, Destination::Trusted, Legacy).check().unwrap_err().code, ErrorCode::ListFull);
    let mut held = snapshot(Legacy);
    held.trusted = certificates[..10].iter().map(listed).collect();
    let over = TrustPlan::for_controller(&files[10..], Destination::Trusted, &held);
    assert_eq!(over.check().unwrap_err().code, ErrorCode::ListFull);

    let authorities: Vec<_> = (0..11).map(|i| authority(&format!("CA {i}"))).collect();
    let mut full = snapshot(Legacy);
    full.crls = authorities[..10].iter().map(|ca| listed_crl(&ca.crl(1))).collect();
    let replacing = [file("new.crl", &[], &[&authorities[3].crl(2)])];
    assert_eq!(TrustPlan::for_controller(&replacing, Destination::Crls, &full).check(), Ok(()));
    let another = [file("more.crl", &[], &[&authorities[10].crl(1)])];
    let over = TrustPlan::for_controller(&another, Destination::Crls, &full);
    assert_eq!(over.check().unwrap_err().code, ErrorCode::TooManyCrls);
}

#[test]
fn dates_are_those_of_the_controllers_clock() {
    let files = [file("client.der", &[&application("client")], &[])];
    let at = |now: &str| {
        let mut held = snapshot(Current);
        held.clock = now.parse().unwrap();
        planned_actions(&TrustPlan::for_controller(&files, Destination::Trusted, &held))
    };
    assert_eq!(at("2035-01-01T00:00:00Z"), [goes(TargetList::Trusted, &[TrustNote::Expired])]);
    assert_eq!(at("2020-01-01T00:00:00Z"), [goes(TargetList::Trusted, &[TrustNote::NotYetValid])]);
    assert_eq!(at(&now().to_rfc3339()), [goes(TargetList::Trusted, &[])]);
}

#[test]
fn a_file_name_is_made_harmless_and_short() {
    assert_eq!(shown_as("a/b\\c\n.der", None), "a_b_c_.der");
    let long = format!("{}.der", "长".repeat(200));
    let shown = shown_as(&long, Some((12, "crl")));
    assert!(shown.len() <= 255 && shown.ends_with("长_12.crl"), "{shown}");
    assert_eq!(shown_as("noname", None), "noname");
    assert!(shown_as(&format!("x.{}", "y".repeat(300)), None).len() <= 255);
}
