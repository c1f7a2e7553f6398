//! One controller through its remote commands: state, program, motors, I/O, variables, Execute, alarms (SPEL+ guide, remote
//! Ethernet and remote RS232).
//!
//! The dialog opens without a connection, and a connection begins with monitoring only: what acts is allowed by a switch,
//! which is off again after every change of the connection.
//!
//! | file | contents |
//! |---|---|
//! | `form` | [`RemoteForm`]: the dialog with what was read last |
//! | `why_not` | [`WhyNot`]: why a command cannot be sent now |
//! | `section` | [`RemoteSection`]: the tabs |
//! | `connect` | connecting, and what the watch reports |
//! | `act` | the switch, sending commands, and what came of them |
//! | `io` | [`IoPanel`]: I/O as bits, bytes and words |
//! | `variables` | [`VariableTable`] |
//! | `execute` | [`ExecuteBox`]: commands of SPEL+ with their results |
//! | `log` | [`ExchangeLog`]: what went over the line |

mod act;
mod connect;
mod execute;
mod form;
mod io;
mod log;
mod section;
mod variables;
mod view;
mod why_not;

use egui::{Key, Modifiers, Ui};

use crate::jobs::IoLabels;
use crate::model::Problem;
use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, FileForm, Message, Model, UiCommand};

pub use act::AllowActing;
pub use form::{RemoteForm, RemoteLink};
pub use io::IoView;
pub use log::{LogForm, SaveExchanges};
pub use section::RemoteSection;
pub use variables::VariableLine;
pub use why_not::WhyNot;

impl UiCommand {
    /// Watches and controls one controller with remote commands.
    pub const REMOTE_CONTROL: Self = Self::new(T::RemoteControl, T::RemoteControlTip, |model, rows| {
        rows.first().map(|row| model.open_remote_control(*row)).unwrap_or_default()
    })
    .in_menu(T::MenuTools)
    .key(Modifiers::COMMAND, Key::M)
    .for_controllers()
    .disabled_if(|model, targets| (model.target_count(targets) > 1).then_some(T::WhyOne));
}

impl Dialog for RemoteForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place, model, messages)
    }

    /// Enter connects while the connection is typed, and executes a command of SPEL+ that is typed.
    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        let connects = self.edits_connection;
        model.put_back(self);
        if connects { model.connect_remote() } else { model.execute_remote() }
    }

    fn close(self: Box<Self>, _model: &mut Model) -> Vec<BackendCommand> {
        self.watch.map(BackendCommand::Cancel).into_iter().collect()
    }

    fn enter_submits(&self, _model: &Model) -> bool {
        match self.edits_connection {
            true => self.typed_connection().is_ok(),
            false => self.section == RemoteSection::Execute && self.why_not_execute().is_none(),
        }
    }

    fn stays_after_failure(&mut self) -> bool {
        true
    }

    /// The labels of I/O bits.
    fn file(&mut self) -> Option<&mut FileForm> {
        Some(&mut self.io.labels_file)
    }

    fn take_in_file(&mut self, bytes: &[u8], _model: &Model) -> Result<(), Problem> {
        self.io.labels = IoLabels::read(bytes)?;
        Ok(())
    }
}

impl Dialog for AllowActing {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::allow(ui, self, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.allow_remote_commands(self.watch);
        vec![]
    }

    /// A key that is pressed by mistake lets nothing move.
    fn enter_submits(&self, _model: &Model) -> bool {
        false
    }
}

impl Dialog for SaveExchanges {
    fn show(&mut self, ui: &Ui, _place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::save(ui, self, model, messages)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.save_exchanges(self)
    }
}
