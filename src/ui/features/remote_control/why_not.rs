use crate::model::Language;
use crate::remote::{Command, Condition};
use crate::texts::{self, TextKey as T};

/// Why a command that acts cannot be sent now.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum WhyNot {
    /// There is no connection, or the state of the controller was not read yet.
    NotConnected,
    /// The switch is off.
    MonitoringOnly,
    /// The answer to this command is outstanding.
    Waiting(Command),
    /// The controller would refuse it in its present state: these conditions are not met.
    Unmet(Vec<Condition>),
    /// What is typed or chosen for it is not complete.
    Incomplete(T),
}

impl WhyNot {
    /// The reason, and what to do; one line for each condition.
    pub fn text(&self, language: Language) -> String {
        match self {
            Self::NotConnected => T::RemoteWhyNotConnected.text(language).to_owned(),
            Self::MonitoringOnly => T::RemoteWhyMonitoring.text(language).to_owned(),
            Self::Waiting(command) => texts::remote_waiting(language, command.name()),
            Self::Unmet(conditions) => {
                let lines: Vec<&str> = conditions.iter().map(|one| one.unmet_text().text(language)).collect();
                lines.join("\n")
            }
            Self::Incomplete(why) => why.text(language).to_owned(),
        }
    }
}
