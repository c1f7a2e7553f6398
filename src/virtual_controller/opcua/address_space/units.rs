use opcua::types::{EUInformation, ExtensionObject, LocalizedText, Range, Variant};

/// A unit of the UNECE Recommendation No. 20, as the companion specification shows it (OPC 10000-8 §5.6.3.3).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Unit {
    /// The UNECE common code.
    code: &'static str,
    symbol: &'static str,
    name: &'static str,
}

/// Degree of angle.
pub(super) const DEGREE: Unit = Unit { code: "DD", symbol: "°", name: "degree [unit of angle]" };
/// Millimetre.
pub(super) const MILLIMETRE: Unit = Unit { code: "MMT", symbol: "mm", name: "millimetre" };
/// Degree Celsius.
pub(super) const CELSIUS: Unit = Unit { code: "CEL", symbol: "°C", name: "degree Celsius" };

impl Unit {
    /// The value of a property EngineeringUnits.
    pub(super) fn variant(self) -> Variant {
        Variant::ExtensionObject(ExtensionObject::from_message(EUInformation {
            namespace_uri: UNECE.into(),
            unit_id: self.id(),
            display_name: LocalizedText::from(self.symbol),
            description: LocalizedText::new("en", self.name),
        }))
    }

    /// The common code's characters as the bytes of a number.
    const fn id(self) -> i32 {
        let code = self.code.as_bytes();
        let (mut id, mut at) = (0, 0);
        while at < code.len() {
            id = id << 8 | code[at] as i32;
            at += 1;
        }
        id
    }
}

/// The value of a property EURange.
pub(super) fn range(low: f64, high: f64) -> Variant {
    Variant::ExtensionObject(ExtensionObject::from_message(Range { low, high }))
}

const UNECE: &str = "http://www.opcfoundation.org/UA/units/un/cefact";

#[cfg(test)]
mod tests {
    use super::*;

    /// The ids of the table that the OPC Foundation publishes, UNECE_to_OPCUA.csv.
    #[test]
    fn the_ids_are_those_of_the_published_table() {
        assert_eq!([DEGREE, MILLIMETRE, CELSIUS].map(Unit::id), [17_476, 5_066_068, 4_408_652]);
    }
}
