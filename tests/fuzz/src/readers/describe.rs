use opcua_configurator::pki::{Description, describe};

use super::{PASSWORD, assert_printable};

/// [`describe`]: the description of any file goes to JSON and back, without a control character or a private key.
pub fn description(bytes: &[u8]) {
    let Ok(things) = describe(bytes, Some(PASSWORD)) else { return };
    assert!(!things.is_empty());
    let json = serde_json::to_string(&things).expect("it can be written");
    assert_eq!(serde_json::from_str::<Vec<Description>>(&json).expect("and read"), things);
    for thing in &things {
        match thing {
            Description::Certificate(told) => {
                assert_printable(&told.subject);
                assert_printable(&told.issuer);
                told.alternative_names.iter().for_each(|name| assert_printable(&name.to_string()));
                told.not_understood.iter().for_each(|why| assert_printable(why));
            }
            Description::Crl(told) => {
                assert_printable(&told.issuer);
                told.unusable.iter().for_each(|why| assert_printable(why));
            }
            Description::Csr(told) => assert_printable(&told.subject),
            Description::PrivateKey(told) | Description::PublicKey(told) => assert_printable(&told.algorithm),
        }
    }
}
