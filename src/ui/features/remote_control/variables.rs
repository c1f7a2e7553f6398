use crate::model::{SpelType, SpelValue};
use crate::remote::client::RemoteError;
use crate::remote::{
    Element, ElementRange, Reply, Request, VariableName, VariableRead, VariableWrite, value_from_text, value_text,
};
use crate::texts::TextKey as T;

/// The variables of the tab.
#[derive(Debug)]
pub struct VariableTable {
    /// In the order in which they were added.
    pub lines: Vec<VariableLine>,
    /// The name of the next one, as it is typed.
    pub name: String,
    /// Its type.
    pub kind: SpelType,
    /// The indices of its first element, as they are typed; empty: it is no array.
    pub indices: String,
    /// How many elements of an array, as it is typed.
    pub count: String,
}

/// A variable that is read in each cycle.
#[derive(Debug)]
pub struct VariableLine {
    /// Which.
    pub read: VariableRead,
    /// What was read last, or why it could not be; `None` before that.
    pub value: Option<Result<Vec<SpelValue>, RemoteError>>,
    /// What it is to be set to, as it is typed.
    pub typed: String,
}

/// Each is one more command in every cycle.
const MAX_LINES: usize = 40;

impl Default for VariableTable {
    fn default() -> Self {
        Self {
            lines: Vec::new(),
            name: String::new(),
            kind: SpelType::Integer,
            indices: String::new(),
            count: "1".to_owned(),
        }
    }
}

impl VariableTable {
    /// The variable that is typed; why it cannot be added.
    pub fn typed(&self) -> Result<VariableRead, T> {
        if self.lines.len() >= MAX_LINES {
            return Err(T::RemoteVariablesFull);
        }
        let name: VariableName = self.name.trim().parse().map_err(|_| T::RemoteVariableNameRule)?;
        let read = if self.indices.trim().is_empty() {
            VariableRead::scalar(name, self.kind)
        } else {
            let indices: Result<Vec<u16>, _> =
                self.indices.split(',').map(|index| index.trim().parse::<u16>()).collect();
            let first = indices.ok().and_then(|indices| Element::new(&indices)).ok_or(T::RemoteIndicesRule)?;
            let count = self.count.trim().parse().ok().and_then(|count| ElementRange::new(first, count));
            let range = count.ok_or(T::RemoteCountRule)?;
            VariableRead::elements(name, self.kind, range).ok_or(T::RemoteNoStringArrays)?
        };
        let is_known = self.lines.iter().any(|line| line.read == read);
        if is_known { Err(T::RemoteVariableKnown) } else { Ok(read) }
    }

    /// Adds the variable that is typed.
    pub fn add(&mut self) {
        if let Ok(read) = self.typed() {
            self.lines.push(VariableLine { read, value: None, typed: String::new() });
            self.name.clear();
        }
    }

    /// What is read in each cycle.
    pub fn reads(&self) -> Vec<Request> {
        self.lines.iter().map(|line| Request::GetVariable { variable: line.read.clone() }).collect()
    }

    /// Takes in what the controller answered to a command of [`VariableTable::reads`].
    pub fn take_in(&mut self, request: &Request, result: Result<Reply, RemoteError>) {
        let Request::GetVariable { variable } = request else { return };
        let Some(line) = self.lines.iter_mut().find(|line| line.read == *variable) else { return };
        line.value = match result {
            Ok(Reply::Values(values)) => Some(Ok(values)),
            Ok(_) => None,
            Err(error) => Some(Err(error)),
        };
    }
}

impl VariableLine {
    /// Name and indices as SPEL+ writes them: `g_array(3,0)`, `g_array(3,0) × 5` for several elements.
    pub fn title(&self) -> String {
        let name = &self.read.name;
        let Some(range) = self.read.range() else { return name.to_string() };
        let indices: Vec<String> = range.first.indices().iter().map(ToString::to_string).collect();
        let element = format!("{name}({})", indices.join(","));
        if range.count() == 1 { element } else { format!("{element} × {}", range.count()) }
    }

    /// What was read last; `None`: nothing was, or it could not be.
    pub fn shown(&self) -> Option<String> {
        let values = self.value.as_ref()?.as_ref().ok()?;
        let values: Vec<String> = values.iter().map(value_text).collect();
        Some(values.join(", "))
    }

    /// The command that sets the variable to what is typed; why there is none.
    pub fn set_typed(&self) -> Result<Request, T> {
        if self.read.range().is_some() {
            return Err(T::RemoteArrayReadOnly);
        }
        let kind = self.read.kind();
        // An empty text is a value of a String.
        let value = value_from_text(kind, &self.typed).map_err(|_| T::RemoteValueRule)?;
        let variable = VariableWrite::new(self.read.name.clone(), kind, value).ok_or(T::RemoteValueRule)?;
        Ok(Request::SetVariable { variable })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn table(name: &str, kind: SpelType, indices: &str, count: &str) -> VariableTable {
        VariableTable {
            name: name.into(),
            kind,
            indices: indices.into(),
            count: count.into(),
            ..VariableTable::default()
        }
    }

    #[test]
    fn variables_and_elements_are_added_once() {
        let mut table = table("g_Status", SpelType::Integer, "", "1");
        table.add();
        assert_eq!((table.lines[0].title().as_str(), table.name.as_str()), ("g_Status", ""));
        table.name = "g_Status".into();
        assert_eq!(table.typed(), Err(T::RemoteVariableKnown));
        table.indices = "3, 0".into();
        table.count = "5".into();
        table.add();
        assert_eq!(table.lines[1].title(), "g_Status(3,0) × 5");
        assert_eq!(table.reads().len(), 2);
    }

    #[test]
    fn what_cannot_be_read_is_not_added() {
        for (name, kind, indices, count, why) in [
            ("", SpelType::Integer, "", "1", T::RemoteVariableNameRule),
            ("2x", SpelType::Integer, "", "1", T::RemoteVariableNameRule),
            ("x", SpelType::Integer, "a", "1", T::RemoteIndicesRule),
            ("x", SpelType::Integer, "1,2,3,4", "1", T::RemoteIndicesRule),
            ("x", SpelType::Integer, "0", "101", T::RemoteCountRule),
            ("x$", SpelType::String, "0", "1", T::RemoteNoStringArrays),
        ] {
            assert_eq!(table(name, kind, indices, count).typed(), Err(why), "{name} {indices}");
        }
    }

    #[test]
    fn a_value_has_to_be_of_the_type_and_elements_are_not_set() {
        let mut table = table("g_Count", SpelType::Byte, "", "1");
        table.add();
        let line = &mut table.lines[0];
        line.typed = "128".into();
        assert_eq!(line.set_typed(), Err(T::RemoteValueRule));
        line.typed = "-5".into();
        let name: VariableName = "g_Count".parse().unwrap();
        let variable = VariableWrite::new(name, SpelType::Byte, SpelValue::Int8(-5)).unwrap();
        assert_eq!(line.set_typed(), Ok(Request::SetVariable { variable }));
        table.name = "g_Count".into();
        table.indices = "0".into();
        table.add();
        table.lines[1].typed = "1".into();
        assert_eq!(table.lines[1].set_typed(), Err(T::RemoteArrayReadOnly));
    }

    #[test]
    fn values_are_shown_and_a_refusal_replaces_them() {
        let mut table = table("x", SpelType::Real, "0", "2");
        table.add();
        let request = table.reads().remove(0);
        table.take_in(&request, Ok(Reply::Values(vec![SpelValue::Float(0.5), SpelValue::Float(-2.0)])));
        assert_eq!(table.lines[0].shown().as_deref(), Some("0.5, -2"));
        let refused =
            RemoteError::Refused { command: request.command(), code: crate::remote::RefusalCode::NoSuchVariable };
        table.take_in(&request, Err(refused));
        assert_eq!(table.lines[0].shown(), None);
    }
}
