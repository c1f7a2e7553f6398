use super::execute::ExecuteBox;
use super::io::IoPanel;
use super::log::ExchangeLog;
use super::section::RemoteSection;
use super::variables::VariableTable;
use super::why_not::WhyNot;
use crate::jobs::RemoteConnection;
use crate::model::{Language, Problem};
use crate::remote::client::{ControllerIdentity, RemoteError, RemoteTarget};
use crate::remote::{Command, MessageLanguage, Password, RemoteStatus, Reply, Request, RobotNumber};
use crate::texts::TextKey as T;
use crate::ui::model::{JobId, RowId, SecretInput};

/// Whether what is shown is what the controller says now.
#[derive(Debug, Clone, PartialEq)]
pub enum RemoteLink {
    /// Nobody has connected yet.
    Off,
    /// Nothing has come yet.
    Connecting,
    /// The state is read twice a second.
    Live,
    /// It is connected again by itself.
    Lost(Problem),
    /// It is not connected again by itself.
    Ended(Problem),
}

/// One controller through its remote commands.
#[derive(Debug)]
pub struct RemoteForm {
    /// The row of the controller.
    pub row: RowId,
    /// The name of the controller.
    pub name: String,
    /// Where to connect, as it is typed: a text of [`RemoteTarget`].
    pub target: String,
    /// As it is typed; wiped when it was used.
    pub password: SecretInput,
    /// The password is shown in clear.
    pub show_password: bool,
    /// The fields for the connection are shown.
    pub edits_connection: bool,
    /// Whether what is shown is current.
    pub link: RemoteLink,
    /// The open tab.
    pub section: RemoteSection,
    /// The state that was read last.
    pub status: Option<RemoteStatus>,
    /// The text of the error or warning in it, where the firmware has one.
    pub message: Option<String>,
    /// What the controller says about itself; `None` until it was read.
    pub identity: Option<Box<ControllerIdentity>>,
    /// The robot that Execute acts on, or why it is not known.
    pub current_robot: Option<Result<u8, RemoteError>>,
    /// The function that Start runs, 0–63.
    pub function: u8,
    /// The robot for motors and Home; 0: all.
    pub robot: RobotNumber,
    /// Inputs, outputs and memory I/O.
    pub io: IoPanel,
    /// The variables that are read in each cycle.
    pub variables: VariableTable,
    /// Commands of SPEL+.
    pub execute: ExecuteBox,
    /// The alarms that were read last, or why they are not known.
    pub alarms: Option<Result<Vec<u8>, RemoteError>>,
    /// What went over the line.
    pub log: ExchangeLog,
    /// What became of the last command that was sent.
    pub outcome: Option<(Command, Result<Reply, RemoteError>)>,
    /// The switch.
    pub(super) may_act: bool,
    /// The commands whose answers are outstanding: one, or an Execute and one that is accepted meanwhile.
    pub(super) pending: Vec<Command>,
    /// Used for the last connection.
    pub(super) used: Option<RemoteConnection>,
    /// The running watch.
    pub(super) watch: Option<JobId>,
    /// What the watch was asked to read last.
    pub(super) asked: Vec<Request>,
}

impl RemoteForm {
    /// The dialog before it is connected.
    pub fn new(row: RowId, name: String, target: String) -> Self {
        Self {
            row,
            name,
            target,
            password: SecretInput::default(),
            show_password: false,
            edits_connection: true,
            link: RemoteLink::Off,
            section: RemoteSection::Control,
            status: None,
            message: None,
            identity: None,
            current_robot: None,
            function: 0,
            robot: RobotNumber::ALL,
            io: IoPanel::default(),
            variables: VariableTable::default(),
            execute: ExecuteBox::default(),
            alarms: None,
            log: ExchangeLog::default(),
            outcome: None,
            may_act: false,
            pending: Vec::new(),
            used: None,
            watch: None,
            asked: Vec::new(),
        }
    }

    /// Whether what is shown is what the controller says now.
    pub fn is_live(&self) -> bool {
        self.link == RemoteLink::Live
    }

    /// Whether commands that act are allowed.
    pub const fn may_act(&self) -> bool {
        self.may_act
    }

    /// The commands whose answers are outstanding: one, or an Execute and one that is accepted meanwhile.
    pub fn pending(&self) -> &[Command] {
        &self.pending
    }

    /// Where to connect with what is typed; why not.
    pub fn typed_connection(&self) -> Result<(RemoteTarget, Password), T> {
        let target: RemoteTarget = self.target.parse().map_err(|_| T::RemoteTargetRule)?;
        // The password is wiped once it was used.
        let again = self.used.as_ref().filter(|used| used.target == target && self.password.0.is_empty());
        let password = match again {
            Some(used) => used.password.clone(),
            None => Password::new(&self.password.0).ok_or(T::RemotePasswordRule)?,
        };
        Ok((target, password))
    }

    /// Why this command cannot be sent now. The conditions of the controller are judged by the state that was read last.
    pub fn why_not(&self, command: Command) -> Option<WhyNot> {
        let Some(status) = self.status.filter(|_| self.is_live()) else { return Some(WhyNot::NotConnected) };
        if !self.may_act {
            return Some(WhyNot::MonitoringOnly);
        }
        let blocks = |pending: &&Command| **pending != Command::Execute || !command.is_accepted_during_execute();
        if let Some(pending) = self.pending.iter().find(blocks) {
            return Some(WhyNot::Waiting(*pending));
        }
        let unmet: Vec<_> = command.unmet(status.flags).collect();
        (!unmet.is_empty()).then_some(WhyNot::Unmet(unmet))
    }

    /// Why the command of SPEL+ that is typed cannot be sent now.
    pub fn why_not_execute(&self) -> Option<WhyNot> {
        self.why_not(Command::Execute).or_else(|| self.execute.typed().err().map(WhyNot::Incomplete))
    }

    /// Why nothing can be done with the one robot that is chosen.
    pub fn why_not_one_robot(&self, command: Command) -> Option<WhyNot> {
        let is_one = self.robot != RobotNumber::ALL;
        self.why_not(command).or((!is_one).then_some(WhyNot::Incomplete(T::RemoteOneRobot)))
    }

    /// What the watch is to read in each cycle, beside the state of the controller: what the open tab shows.
    pub fn wanted(&self) -> Vec<Request> {
        match self.section {
            RemoteSection::Control => vec![Request::GetCurRobot],
            RemoteSection::Io => self.io.reads(),
            RemoteSection::Variables => self.variables.reads(),
            RemoteSection::Alarms => vec![Request::GetAlm],
            RemoteSection::Execute | RemoteSection::Log => vec![],
        }
    }
}

/// The language in which a controller is asked for the text of its error.
pub(super) fn message_language(language: Language) -> Option<MessageLanguage> {
    MessageLanguage::new(match language {
        Language::En => 0,
        Language::Ja => 1,
        Language::Zh => 4,
    })
}
