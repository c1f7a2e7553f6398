//! What the OPC UA server of one controller shows, as it changes (manual 3.2, 3.4).
//!
//! | file | contents |
//! |---|---|
//! | `form` | [`LiveForm`]: the dialog with the last value of each variable |
//! | `section` | [`LiveSection`]: the tabs, and which variables each shows |
//! | `watch` | connecting, asking for values, and what is reported |
//! | `browser` | `NodeBrowser`: the address space as a tree |
//! | `plot` | `LivePlot`: values over time |
//! | `io` | the bits of I/O nodes |
//! | `pose` | positions of the tool center point |
//! | `edit` | [`EditValue`]: writing a value |

mod browser;
mod edit;
mod form;
mod io;
mod plot;
mod pose;
mod section;
mod view;
mod watch;

use egui::{Key, Modifiers, Ui};

use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};

pub use browser::BrowserMove;
pub use edit::EditValue;
pub use form::{LiveConnection, LiveForm};
pub use section::LiveSection;

impl UiCommand {
    /// Shows the values of one OPC UA server.
    pub const LIVE_VALUES: Self = Self::new(T::LiveValues, T::LiveValuesTip, |model, rows| {
        rows.first().map(|row| model.open_live_values(*row)).unwrap_or_default()
    })
    .in_menu(T::MenuTools)
    .key(Modifiers::COMMAND, Key::L)
    .for_controllers()
    .disabled_if(|model, targets| (model.target_count(targets) > 1).then_some(T::WhyOne));
}

impl Dialog for LiveForm {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.on_top, model, messages)
    }

    /// Enter connects while the login is typed.
    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.put_back(self);
        model.reconnect_live()
    }

    fn close(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.close_live_values(&self)
    }

    fn enter_submits(&self, _model: &Model) -> bool {
        self.asks_for_login && self.typed_login().is_ok()
    }

    fn stays_after_failure(&mut self) -> bool {
        true
    }
}

impl Dialog for EditValue {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::edit(ui, self, place.focus, model)
    }

    fn submit(self: Box<Self>, model: &mut Model) -> Vec<BackendCommand> {
        model.write_live_value(self)
    }
}
