use chrono::{Duration, Utc};

use super::*;
use crate::model::CertificateStatus as Status;
use crate::pki::{Certificate, samples};

fn presented(certificate: &Certificate) -> Presented<'_> {
    Presented {
        certificate,
        chain: &[],
        role: Role::Client,
        now: samples::now(),
        application_uri: None,
        host: None,
        security_policy: None,
    }
}

fn status(lists: &TrustLists, presented: &Presented<'_>) -> Option<Status> {
    lists.validate(presented, &TrustPolicy::default()).err().map(|rejection| rejection.status)
}

#[test]
fn a_self_signed_certificate_is_trusted_only_if_it_is_in_the_list_itself() {
    let certificate = samples::certificate();
    let empty = TrustLists::default();
    assert_eq!(status(&empty, &presented(certificate)), Some(Status::Untrusted));
    let as_issuer = TrustLists::new(vec![], vec![certificate.clone()], vec![]);
    assert_eq!(status(&as_issuer, &presented(certificate)), Some(Status::Untrusted));
    let lists = TrustLists::new(vec![certificate.clone()], vec![], vec![]);
    let chain = lists.validate(&presented(certificate), &TrustPolicy::default()).unwrap();
    assert_eq!(chain, std::slice::from_ref(certificate));
    let later = Presented { now: samples::now() + Duration::days(3660), ..presented(certificate) };
    assert_eq!(status(&lists, &later), Some(Status::TimeInvalid));
    let now = Presented { now: Utc::now(), ..presented(certificate) };
    assert_eq!(status(&lists, &now), Some(Status::TimeInvalid), "made for the year 2030");
}
