use std::sync::Arc;

use super::spel_value::{MAX_SPEL_VARIABLES, SpelDeclaration, SpelType, SpelValue};

/// The SPEL variables that the address space shows, with their values.
#[derive(Debug)]
pub(super) struct Variables {
    declarations: Arc<[SpelDeclaration]>,
    values: Vec<SpelValue>,
    /// `values` as a snapshot shows them, until they change.
    shared: Option<Arc<[SpelValue]>>,
}

impl Variables {
    /// No variable.
    pub fn new() -> Self {
        Self { declarations: [].into(), values: Vec::new(), shared: None }
    }

    /// Replaces the declarations. A variable with the same name and type keeps its value, as a backup variable does. Those
    /// beyond 256 are not taken.
    pub fn declare(&mut self, mut declarations: Vec<SpelDeclaration>) {
        declarations.truncate(MAX_SPEL_VARIABLES);
        let kept = |wanted: &SpelDeclaration| {
            let known = self.declarations.iter().position(|known| known == wanted);
            known.and_then(|at| self.values.get(at).cloned()).unwrap_or_else(|| wanted.kind.zero())
        };
        self.values = declarations.iter().map(kept).collect();
        self.declarations = declarations.into();
        self.shared = None;
    }

    pub fn declarations(&self) -> Arc<[SpelDeclaration]> {
        Arc::clone(&self.declarations)
    }

    /// The values, in the order of the declarations.
    pub fn values(&mut self) -> Arc<[SpelValue]> {
        let values = &self.values;
        Arc::clone(self.shared.get_or_insert_with(|| values.as_slice().into()))
    }

    /// Assigns a number, as the declared type holds it. Without such a variable nothing happens.
    pub fn set_number(&mut self, name: &str, number: f64) {
        self.set(name, |kind| Some(kind.of_number(number)));
    }

    /// Assigns a text to a String. Without such a variable nothing happens.
    pub fn set_text(&mut self, name: &str, text: impl FnOnce() -> String) {
        self.set(name, |kind| (kind == SpelType::String).then(|| SpelValue::String(text())));
    }

    fn set(&mut self, name: &str, value: impl FnOnce(SpelType) -> Option<SpelValue>) {
        let Some(at) = self.declarations.iter().position(|known| known.name.eq_ignore_ascii_case(name)) else { return };
        if let Some(value) = value(self.declarations[at].kind)
            && self.values[at] != value
        {
            self.values[at] = value;
            self.shared = None;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn declared(kind: SpelType, name: &str) -> SpelDeclaration {
        SpelDeclaration { name: name.to_owned(), kind }
    }

    #[test]
    fn values_are_assigned_by_name_and_kept_over_a_new_declaration() {
        let mut variables = Variables::new();
        let produced = declared(SpelType::UInt32, "OPCUA_Produced");
        variables.declare(vec![produced.clone(), declared(SpelType::String, "OPCUA_Recipe")]);
        variables.set_number("opcua_PRODUCED", 7.0);
        variables.set_text("OPCUA_Recipe", || "A".to_owned());
        variables.set_text("OPCUA_Produced", || "A".to_owned());
        variables.set_number("OPCUA_Missing", 1.0);
        assert_eq!(*variables.values(), [SpelValue::UInt32(7), SpelValue::String("A".to_owned())]);
        variables.declare(vec![declared(SpelType::Real, "OPCUA_Recipe"), produced]);
        assert_eq!(*variables.values(), [SpelValue::Float(0.0), SpelValue::UInt32(7)]);
    }

    #[test]
    fn there_are_256_at_most() {
        let mut variables = Variables::new();
        variables.declare((0..300).map(|at| declared(SpelType::Byte, &format!("OPCUA_{at}"))).collect());
        assert_eq!((variables.values().len(), variables.declarations().len()), (256, 256));
    }
}
