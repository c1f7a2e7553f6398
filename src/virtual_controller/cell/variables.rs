use std::sync::Arc;

use thiserror::Error;

use super::spel_declaration::{MAX_SPEL_VARIABLES, SpelDeclaration};
use crate::model::{SpelType, SpelValue};

/// The backup variables of the project, with their values. The address space shows some of them, see
/// [`Variables::declarations`].
#[derive(Debug)]
pub(super) struct Variables {
    /// First those that the address space shows.
    all: Vec<Variable>,
    shown: Arc<[SpelDeclaration]>,
    /// The values of `shown` as a snapshot shows them, until one of them changes.
    shared: Option<Arc<[SpelValue]>>,
}

#[derive(Debug)]
struct Variable {
    declaration: SpelDeclaration,
    /// One value a scalar; the elements of an array by [`SpelDeclaration::place`].
    values: Vec<SpelValue>,
}

/// Why a variable is not read or written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum VariableError {
    /// No backup variable has this name, or it has another type.
    #[error("there is no backup variable with this name and type")]
    Unknown,
    /// Element numbers for a scalar, none for an array, or not one for each dimension.
    #[error("the variable has another number of dimensions")]
    Dimensions,
    /// An element number is beyond its bound, or fewer elements follow than were asked for.
    #[error("the array has no such element")]
    Element,
    /// The value is not of the variable's type, or a text is longer than 255 bytes.
    #[error("the variable cannot hold this value")]
    Value,
}

/// The longest text of a String variable, in bytes.
const MAX_STRING: usize = 255;

impl Variables {
    /// No variable.
    pub fn new() -> Self {
        Self { all: Vec::new(), shown: [].into(), shared: None }
    }

    /// Replaces the declarations. A variable with the same name, type and dimensions keeps its values, as a backup variable
    /// does. The first 256 of those that [`SpelDeclaration::is_shown`] names are shown.
    pub fn declare(&mut self, declarations: Vec<SpelDeclaration>) {
        let mut old = std::mem::take(&mut self.all);
        let (mut shown, mut others): (Vec<_>, Vec<_>) = declarations.into_iter().partition(SpelDeclaration::is_shown);
        let beyond = shown.split_off(shown.len().min(MAX_SPEL_VARIABLES));
        self.shown = shown.iter().cloned().collect();
        shown.extend(beyond);
        shown.append(&mut others);
        self.all = shown
            .into_iter()
            .map(|declaration| {
                let known = old.iter().position(|known| known.declaration == declaration);
                let values = match known {
                    Some(known) => old.swap_remove(known).values,
                    None => vec![declaration.kind.zero(); declaration.elements()],
                };
                Variable { declaration, values }
            })
            .collect();
        self.shared = None;
    }

    /// Those that the address space shows: scalars.
    pub fn declarations(&self) -> Arc<[SpelDeclaration]> {
        Arc::clone(&self.shown)
    }

    /// The values of [`Variables::declarations`], in their order.
    pub fn values(&mut self) -> Arc<[SpelValue]> {
        let shown = &self.all[..self.shown.len()];
        Arc::clone(self.shared.get_or_insert_with(|| shown.iter().flat_map(|it| it.values.iter().cloned()).collect()))
    }

    /// `count` values from an element on, or the value of a scalar, whose `element` is empty. With a type, the variable must
    /// have been declared with it.
    pub fn read(
        &self,
        name: &str,
        kind: Option<SpelType>,
        element: &[u16],
        count: usize,
    ) -> Result<&[SpelValue], VariableError> {
        let at = self.find(name, kind)?;
        let Variable { declaration, values } = &self.all[at];
        let first = place(declaration, element)?;
        values.get(first..first.saturating_add(count)).ok_or(VariableError::Element)
    }

    /// Assigns a value to a scalar, whose `element` is empty, or to an element.
    pub fn write(
        &mut self,
        name: &str,
        kind: Option<SpelType>,
        element: &[u16],
        value: SpelValue,
    ) -> Result<(), VariableError> {
        let at = self.find(name, kind)?;
        let declaration = &self.all[at].declaration;
        let place = place(declaration, element)?;
        let is_too_long = matches!(&value, SpelValue::String(text) if text.len() > MAX_STRING);
        if is_too_long || !holds(declaration.kind, &value) {
            return Err(VariableError::Value);
        }
        self.put(at, place, value);
        Ok(())
    }

    /// The declared type of a variable.
    pub fn kind(&self, name: &str) -> Result<SpelType, VariableError> {
        self.find(name, None).map(|at| self.all[at].declaration.kind)
    }

    /// Every variable with its values, the elements of an array in their order.
    pub fn all(&self) -> impl Iterator<Item = (&SpelDeclaration, &[SpelValue])> {
        self.all.iter().map(|it| (&it.declaration, it.values.as_slice()))
    }

    /// Takes all values of one variable back, if it still has this type and this many of them.
    pub fn restore(&mut self, name: &str, kind: SpelType, values: Vec<SpelValue>) {
        if let Ok(at) = self.find(name, Some(kind))
            && self.all[at].values.len() == values.len()
            && values.iter().all(|value| holds(kind, value))
        {
            self.all[at].values = values;
            self.shared = None;
        }
    }

    /// Assigns a number to a scalar, as the declared type holds it. Without such a variable nothing happens.
    pub fn set_number(&mut self, name: &str, number: f64) {
        self.set(name, |kind| Some(kind.of_number(number)));
    }

    /// Assigns a text to a String. Without such a variable nothing happens.
    pub fn set_text(&mut self, name: &str, text: impl FnOnce() -> String) {
        self.set(name, |kind| (kind == SpelType::String).then(|| SpelValue::String(text())));
    }

    fn set(&mut self, name: &str, value: impl FnOnce(SpelType) -> Option<SpelValue>) {
        let Ok(at) = self.find(name, None) else { return };
        let declaration = &self.all[at].declaration;
        if declaration.bounds.is_empty()
            && let Some(value) = value(declaration.kind)
        {
            self.put(at, 0, value);
        }
    }

    fn put(&mut self, at: usize, place: usize, value: SpelValue) {
        let held = &mut self.all[at].values[place];
        if *held != value {
            *held = value;
            if at < self.shown.len() {
                self.shared = None;
            }
        }
    }

    fn find(&self, name: &str, kind: Option<SpelType>) -> Result<usize, VariableError> {
        let at = self.all.iter().position(|known| known.declaration.name.eq_ignore_ascii_case(name));
        at.filter(|at| kind.is_none_or(|kind| self.all[*at].declaration.kind == kind)).ok_or(VariableError::Unknown)
    }
}

/// Whether a variable of this type can hold the value, which is so for exactly one kind of [`SpelValue`].
fn holds(kind: SpelType, value: &SpelValue) -> bool {
    std::mem::discriminant(&kind.zero()) == std::mem::discriminant(value)
}

fn place(declaration: &SpelDeclaration, element: &[u16]) -> Result<usize, VariableError> {
    if element.len() != declaration.bounds.len() {
        return Err(VariableError::Dimensions);
    }
    declaration.place(element).ok_or(VariableError::Element)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn declared(kind: SpelType, name: &str) -> SpelDeclaration {
        SpelDeclaration::scalar(name, kind)
    }

    fn array(kind: SpelType, name: &str, bounds: &[u16]) -> SpelDeclaration {
        SpelDeclaration { bounds: bounds.to_vec(), ..declared(kind, name) }
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
    fn the_first_256_scalars_with_the_prefix_are_shown_and_all_are_reached() {
        let mut variables = Variables::new();
        let mut declarations = vec![declared(SpelType::Byte, "g_Status"), array(SpelType::Byte, "OPCUA_List", &[1])];
        declarations.extend((0..300).map(|at| declared(SpelType::Byte, &format!("OPCUA_{at}"))));
        variables.declare(declarations);
        assert_eq!((variables.values().len(), variables.declarations().len()), (256, 256));
        assert_eq!(variables.declarations()[0].name, "OPCUA_0");
        for (name, element) in [("g_status", &[][..]), ("OPCUA_List", &[1]), ("OPCUA_299", &[])] {
            variables.write(name, Some(SpelType::Byte), element, SpelValue::Int8(5)).unwrap();
            assert_eq!(variables.read(name, None, element, 1), Ok(&[SpelValue::Int8(5)][..]));
        }
        assert!(variables.values().iter().all(|value| *value == SpelValue::Int8(0)));
    }

    #[test]
    fn elements_are_read_in_a_row_as_far_as_the_array_goes() {
        let mut variables = Variables::new();
        variables.declare(vec![
            array(SpelType::Integer, "g_int3Array", &[10, 10, 10]),
            declared(SpelType::Integer, "g_Status"),
        ]);
        for (at, element) in [[3, 5, 9], [3, 5, 10], [3, 6, 0]].iter().enumerate() {
            let value = SpelValue::Int16(i16::try_from(at).unwrap() + 1);
            variables.write("g_int3Array", None, element, value).unwrap();
        }
        let read = |element: &[u16], count| variables.read("G_INT3ARRAY", Some(SpelType::Integer), element, count);
        let row = read(&[3, 5, 8], 4).unwrap();
        assert_eq!(row, [0, 1, 2, 3].map(SpelValue::Int16));
        assert_eq!(read(&[10, 10, 9], 2).unwrap().len(), 2);
        assert_eq!(read(&[10, 10, 9], 3), Err(VariableError::Element));
        assert_eq!(read(&[0, 0, 11], 1), Err(VariableError::Element));
        assert_eq!(read(&[0, 0], 1), Err(VariableError::Dimensions));
        assert_eq!(read(&[], 1), Err(VariableError::Dimensions));
        assert_eq!(variables.read("g_Status", None, &[0], 1), Err(VariableError::Dimensions));
    }

    #[test]
    fn a_variable_is_named_with_its_own_type() {
        let mut variables = Variables::new();
        variables.declare(vec![declared(SpelType::Integer, "g_Status"), declared(SpelType::String, "g_Name$")]);
        let one = SpelValue::Int16(1);
        for (name, kind) in [("g_Status", SpelType::Short), ("g_status2", SpelType::Integer)] {
            assert_eq!(variables.read(name, Some(kind), &[], 1), Err(VariableError::Unknown));
            assert_eq!(variables.write(name, Some(kind), &[], one.clone()), Err(VariableError::Unknown));
        }
        for (name, value) in
            [("g_Status", SpelValue::Int32(1)), ("g_Name$", one), ("g_Name$", SpelValue::String("x".repeat(256)))]
        {
            assert_eq!(variables.write(name, None, &[], value), Err(VariableError::Value));
        }
        assert_eq!(variables.kind("G_NAME$"), Ok(SpelType::String));
        variables.write("g_Name$", None, &[], SpelValue::String("x".repeat(255))).unwrap();
    }

    #[test]
    fn what_was_kept_is_restored_where_it_still_fits() {
        let mut variables = Variables::new();
        variables.declare(vec![array(SpelType::Byte, "g_List", &[1]), declared(SpelType::Long, "OPCUA_Count")]);
        variables.restore("g_list", SpelType::Byte, vec![SpelValue::Int8(1), SpelValue::Int8(2)]);
        variables.restore("OPCUA_Count", SpelType::Int32, vec![SpelValue::Int32(3)]);
        variables.restore("OPCUA_Count", SpelType::Long, vec![]);
        variables.restore("OPCUA_Count", SpelType::Long, vec![SpelValue::Int8(3)]);
        variables.restore("gone", SpelType::Long, vec![SpelValue::Int32(3)]);
        assert_eq!(variables.read("g_List", None, &[0], 2), Ok(&[1, 2].map(SpelValue::Int8)[..]));
        assert_eq!(*variables.values(), [SpelValue::Int32(0)]);
        variables.restore("OPCUA_Count", SpelType::Long, vec![SpelValue::Int32(3)]);
        assert_eq!(*variables.values(), [SpelValue::Int32(3)]);
    }
}
