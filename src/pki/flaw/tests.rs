use super::*;

#[test]
fn a_flaw_of_a_list_is_told_by_name() {
    let json = r#"{"flaw":"revocation-unknown","authority":"CN=Plant CA","crl":{"flaw":"key-not-accepted",
        "subject":"CN=New","because":{"flaw":"not-an-authority"}}}"#;
    let because = Box::new(CertificateFlaw::NotAnAuthority);
    let crl = CrlFlaw::KeyNotAccepted { subject: "CN=New".to_owned(), because };
    let flaw = CertificateFlaw::RevocationUnknown { authority: "CN=Plant CA".to_owned(), crl };
    assert_eq!(serde_json::from_str::<RefusalCause>(json).unwrap(), RefusalCause { flaw, at_fault: None });
    let before = r#"{"flaw":"revocation-unknown","why":"there is no revocation list"}"#;
    let before = RefusalCause::if_known(&mut serde_json::Deserializer::from_str(before)).unwrap();
    assert_eq!(before, None, "as controllers said it before");
}

#[test]
fn a_cause_is_told_by_name_and_one_that_is_not_known_is_none() {
    let json = r#"{"flaw":"key-too-short","bits":1024,"least":2048}"#;
    let flaw = CertificateFlaw::KeyTooShort { bits: 1024, least: 2048 };
    assert_eq!(serde_json::from_str::<RefusalCause>(json).unwrap(), RefusalCause { flaw, at_fault: None });
    let of = |json: &str| RefusalCause::if_known(&mut serde_json::Deserializer::from_str(json)).unwrap();
    assert!(of(json).is_some());
    for unknown in
        [r#"{"flaw":"made-up","x":1}"#, r#"{"flaw":"untrusted","at_fault":7}"#, "null", "[]", "\"untrusted\""]
    {
        assert_eq!(of(unknown), None, "{unknown}");
    }
}

#[test]
fn texts_of_strangers_are_short_and_command_no_terminal() {
    let long = quoted(&"\u{1b}[2J".repeat(100));
    assert_eq!(long.chars().count(), 201);
    assert!(!long.contains(char::is_control) && long.ends_with('…'));
    assert_eq!(quoted("CN=Plant CA"), "CN=Plant CA");
}
