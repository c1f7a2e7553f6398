//! The licences of everything that is linked into the program: crates, fonts, NodeSet, standard library.
//!
//! The list is made by `assets/licences/licences.py` and checked for being current by `.ci/run`.

use std::sync::OnceLock;

use serde::Deserialize;

/// Components with their licence texts, each text once.
#[derive(Debug, Deserialize)]
pub struct Licences {
    components: Vec<Component>,
    texts: Vec<String>,
}

/// Something that is linked in.
#[derive(Debug, Deserialize)]
pub struct Component {
    /// Name of the crate, font or data set.
    pub name: String,
    /// Empty where the version is that of the compiler.
    pub version: String,
    /// SPDX expression, as its authors state it.
    pub licence: String,
    texts: Vec<usize>,
}

impl Licences {
    /// The list of this build. Parsed at the first call, which takes some milliseconds.
    pub fn get() -> &'static Self {
        static LICENCES: OnceLock<Licences> = OnceLock::new();
        LICENCES.get_or_init(|| {
            serde_json::from_str(include_str!("../assets/licences/licences.json"))
                .expect("a test reads the bundled file")
        })
    }

    /// In alphabetical order.
    pub fn components(&self) -> &[Component] {
        &self.components
    }

    /// The licence texts of a component.
    pub fn texts_of<'a>(&'a self, component: &'a Component) -> impl Iterator<Item = &'a str> {
        component.texts.iter().filter_map(|index| self.texts.get(*index)).map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_component_has_a_licence_and_its_text() {
        let licences = Licences::get();
        for name in ["async-opcua-server", "aws-lc-sys", "egui", "Noto Sans CJK SC (subset)", "OPC UA Devices NodeSet"]
        {
            assert!(licences.components().iter().any(|component| component.name == name), "{name}");
        }
        for component in licences.components() {
            assert!(!component.licence.is_empty(), "{component:?}");
            assert_eq!(licences.texts_of(component).count(), component.texts.len(), "{component:?}");
            assert!(licences.texts_of(component).any(|text| text.len() > 200), "{component:?}");
        }
    }

    /// Licences whose terms ask for their text to be handed on.
    #[test]
    fn the_terms_of_weak_copyleft_and_fonts_are_there() {
        let licences = Licences::get();
        for (name, words) in [
            ("async-opcua-server", "Mozilla Public License"),
            ("Noto Sans CJK SC (subset)", "SIL OPEN FONT LICENSE"),
            ("Noto Sans CJK JP (subset)", "SIL OPEN FONT LICENSE"),
            ("epaint_default_fonts", "UBUNTU FONT LICENCE"),
        ] {
            let component = licences.components().iter().find(|component| component.name == name).unwrap();
            let found = licences.texts_of(component).any(|text| text.to_uppercase().contains(&words.to_uppercase()));
            assert!(found, "{name}: {words}");
        }
    }
}
