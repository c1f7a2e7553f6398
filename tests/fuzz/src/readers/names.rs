use std::fmt::{Debug, Display};
use std::str::FromStr;

use opcua_configurator::model::activation::{ActivationKey, LicenceKey};
use opcua_configurator::model::{
    Address, ControllerName, ControllerSeries, FirmwareVersion, SecurityPolicy, SerialNumber, ServerPort, UserName,
};
use opcua_configurator::pki::Fingerprint;

/// Every type that a text becomes: shown and read again, it is the same.
pub fn names(bytes: &[u8]) {
    let Ok(text) = std::str::from_utf8(bytes) else { return };
    if let Some(address) = same_again::<Address>(text) {
        assert!(address.port() != 0 && address.host().len() <= 253);
        assert_eq!(address.authority().parse(), Ok(address.clone()), "{text:?}");
    }
    if let Some(name) = same_again::<ControllerName>(text) {
        assert!((1..=ControllerName::MAX_CHARS).contains(&name.as_str().chars().count()));
        super::assert_printable(name.as_str());
    }
    if let Some(serial) = same_again::<SerialNumber>(text) {
        let file_name = std::path::Path::new(serial.as_str());
        assert!(file_name.components().count() == 1 && file_name.file_name().is_some(), "{text:?}");
    }
    same_again::<ControllerSeries>(text);
    same_again::<FirmwareVersion>(text);
    same_again::<SecurityPolicy>(text);
    same_again::<ServerPort>(text).inspect(|port| assert!(port.get() >= ServerPort::MIN));
    same_again::<UserName>(text).inspect(|name| assert!((8..=32).contains(&name.as_str().len())));
    same_again::<Fingerprint>(text).inspect(|fingerprint| assert_eq!(fingerprint.grouped().parse(), Ok(*fingerprint)));
    same_again::<LicenceKey>(text);
    same_again::<ActivationKey>(text);
}

/// `None` for a text that is none, whose mistake can be told all the same.
fn same_again<T>(text: &str) -> Option<T>
where
    T: FromStr<Err: Display + PartialEq + Debug> + Display + Debug + PartialEq,
{
    match text.parse::<T>() {
        Ok(value) => {
            assert_eq!(value.to_string().parse::<T>().as_ref(), Ok(&value), "{text:?}");
            Some(value)
        }
        Err(error) => {
            drop(error.to_string());
            None
        }
    }
}
