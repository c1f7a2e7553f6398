//! What every dialog of the window does.

use std::any::Any;
use std::fmt::Debug;

use chrono::{DateTime, Utc};
use egui::Ui;

use super::{Commands, FileForm, Message, Model};
use crate::model::Problem;

/// What the engineer decided in a dialog, if anything.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DialogAnswer {
    /// Nothing was decided in this frame.
    None,
    /// The main button.
    Submit,
    /// Cancel, Close or Esc.
    Close,
}

/// Where a dialog is among the open ones.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DialogPlace {
    /// No other dialog is in front of it.
    pub on_top: bool,
    /// It has just been opened and takes the keyboard.
    pub focus: bool,
}

/// A dialog with what is typed into it. A feature implements this, and opens it with [`Model::open`].
///
/// Drawing changes nothing but the dialog's own fields; everything else happens in the other methods, which the reducer
/// calls.
pub trait Dialog: Any + Debug {
    /// Draws it, and says what was pressed. Further actions go into `messages`.
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer;

    /// The main button was pressed. The dialog is taken out of the list of open ones and puts itself back with
    /// [`Model::put_back`] where it stays open. Default: the main button is Close.
    fn submit(self: Box<Self>, model: &mut Model) -> Commands {
        self.close(model)
    }

    /// Cancel, Close or Esc was pressed; taken out as for [`Dialog::submit`]. Default: it is gone.
    fn close(self: Box<Self>, _model: &mut Model) -> Commands {
        vec![]
    }

    /// Whether Enter presses the main button. Default: it does.
    fn enter_submits(&self, _model: &Model) -> bool {
        true
    }

    /// A form whose work is done once what it asks for was agreed to: the confirmation closes it. Default: it stays.
    fn is_done_by_confirming(&self) -> bool {
        false
    }

    /// What it waited for could not be read. Returns whether it stays open with what it has. Default: it does not.
    fn stays_after_failure(&mut self) -> bool {
        false
    }

    /// The file it asks for, if it does.
    fn file(&mut self) -> Option<&mut FileForm> {
        None
    }

    /// Takes in the content of that file.
    fn take_in_file(&mut self, _bytes: &[u8], _model: &Model) -> Result<(), Problem> {
        Ok(())
    }

    /// Brings words that depend on the time up to date. Called each frame.
    fn refresh(&mut self, _now: DateTime<Utc>) {}
}

fn as_any(dialog: &dyn Dialog) -> &dyn Any {
    dialog
}

fn as_any_mut(dialog: &mut dyn Dialog) -> &mut dyn Any {
    dialog
}

/// The open dialogs, by their type. A dialog that a result is for may have been closed meanwhile: then there is none.
impl Model {
    /// Opens a dialog on top of the others.
    pub fn open(&mut self, dialog: impl Dialog) {
        self.dialogs.push(Box::new(dialog));
    }

    /// Keeps a dialog open that was taken out to be submitted or closed.
    pub fn put_back(&mut self, dialog: Box<dyn Dialog>) {
        self.dialogs.push(dialog);
    }

    /// Takes a dialog away from the window while its work goes on. [`Model::show_hidden`] brings it back.
    pub fn hide(&mut self, dialog: Box<dyn Dialog>) {
        self.hidden.push(dialog);
    }

    /// Opens the hidden dialog of this type again. Returns whether there was one.
    pub fn show_hidden<D: Dialog>(&mut self) -> bool {
        let position = self.hidden.iter().position(|dialog| as_any(dialog.as_ref()).is::<D>());
        let found = position.map(|at| self.hidden.remove(at));
        let was_hidden = found.is_some();
        self.dialogs.extend(found);
        was_hidden
    }

    /// The hidden dialog of this type.
    pub fn hidden<D: Dialog>(&self) -> Option<&D> {
        self.hidden.iter().find_map(|dialog| as_any(dialog.as_ref()).downcast_ref())
    }

    /// The dialog of this type, open or hidden.
    pub fn working<D: Dialog>(&self) -> Option<&D> {
        self.dialogs.iter().chain(&self.hidden).find_map(|dialog| as_any(dialog.as_ref()).downcast_ref())
    }

    /// The dialog of this type, open or hidden.
    pub fn working_mut<D: Dialog>(&mut self) -> Option<&mut D> {
        let mut dialogs = self.dialogs.iter_mut().chain(&mut self.hidden);
        dialogs.find_map(|dialog| as_any_mut(dialog.as_mut()).downcast_mut())
    }

    /// The dialog of this type, the uppermost of several.
    pub fn dialog<D: Dialog>(&mut self) -> Option<&mut D> {
        self.dialogs.iter_mut().rev().find_map(|dialog| as_any_mut(dialog.as_mut()).downcast_mut())
    }

    /// The dialog on top, if it is of this type.
    pub fn top<D: Dialog>(&self) -> Option<&D> {
        self.dialogs.last().and_then(|dialog| as_any(dialog.as_ref()).downcast_ref())
    }

    /// The dialog on top, if it is of this type.
    pub fn top_mut<D: Dialog>(&mut self) -> Option<&mut D> {
        self.dialogs.last_mut().and_then(|dialog| as_any_mut(dialog.as_mut()).downcast_mut())
    }

    /// Takes out the dialog of this type that fits.
    pub fn take_out<D: Dialog>(&mut self, fits: impl Fn(&D) -> bool) -> Option<Box<D>> {
        let is_it = |dialog: &dyn Dialog| as_any(dialog).downcast_ref().is_some_and(&fits);
        let index = self.dialogs.iter().position(|dialog| is_it(dialog.as_ref()))?;
        let dialog: Box<dyn Any> = self.dialogs.remove(index);
        dialog.downcast().ok()
    }

    /// Closes every dialog of this type.
    pub fn close_all<D: Dialog>(&mut self) {
        self.dialogs.retain(|dialog| !as_any(dialog.as_ref()).is::<D>());
    }

    /// Closes the dialog of this type after a failure, unless it stays open.
    pub fn close_after_failure<D: Dialog>(&mut self) {
        self.dialogs.retain_mut(|dialog| !as_any(dialog.as_ref()).is::<D>() || dialog.stays_after_failure());
    }

    /// Whether a dialog of this type is open and no other.
    pub fn is_only<D: Dialog>(&self) -> bool {
        self.dialogs.len() == 1 && self.top::<D>().is_some()
    }

    /// Whether a dialog is open that is not of this type.
    pub fn is_other_open<D: Dialog>(&self) -> bool {
        self.dialogs.iter().any(|dialog| !as_any(dialog.as_ref()).is::<D>())
    }
}
