use crate::texts::TextKey as T;

/// A tab of the dialog.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum RemoteSection {
    /// Program, motors, and what the controller is.
    Control,
    /// Inputs, outputs and memory I/O.
    Io,
    /// Variables.
    Variables,
    /// Commands of SPEL+.
    Execute,
    /// Alarms of parts that wear.
    Alarms,
    /// What went over the line.
    Log,
}

impl RemoteSection {
    /// In the order they are shown.
    pub const ALL: [Self; 6] = [Self::Control, Self::Io, Self::Variables, Self::Execute, Self::Alarms, Self::Log];

    /// What the tab says.
    pub const fn title(self) -> T {
        match self {
            Self::Control => T::RemoteTabControl,
            Self::Io => T::RemoteTabIo,
            Self::Variables => T::RemoteTabVariables,
            Self::Execute => T::RemoteTabExecute,
            Self::Alarms => T::RemoteTabAlarms,
            Self::Log => T::RemoteTabLog,
        }
    }

    /// The tab so many tabs further, around the ends.
    pub fn turned(self, by: isize) -> Self {
        let at = Self::ALL.iter().position(|section| *section == self).unwrap_or_default();
        Self::ALL[(at as isize + by).rem_euclid(Self::ALL.len() as isize) as usize]
    }
}
