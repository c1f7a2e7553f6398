//! What an engineer can ask the window to do. Menus, buttons, keys and the command palette all read this.

use std::fmt;

use egui::{Key, KeyboardShortcut, Modifiers};

use super::{Commands, Model, RowId, Targets};
use crate::model::Language;
use crate::texts::TextKey as T;

/// Says why a command cannot be done to these controllers now; `None` if it can.
type WhyDisabled = fn(&Model, Targets) -> Option<T>;
/// Opens the dialog of a command or starts its job. Gets the ticked controllers.
type Invoke = fn(&mut Model, Vec<RowId>) -> Commands;

/// A command of the main window: its words, its key, when it is disabled, and what it does.
///
/// Each feature declares its commands as constants of this type, such as `UiCommand::VERIFY`. `ui/features/mod.rs` puts
/// them into the menus.
#[derive(Clone, Copy)]
pub struct UiCommand {
    text: T,
    tooltip: T,
    menu: Option<T>,
    shortcut: Option<KeyboardShortcut>,
    needs_controllers: bool,
    why_disabled: WhyDisabled,
    invoke: Invoke,
}

impl UiCommand {
    /// A command that is in no menu, has no key and can always be invoked. No two commands have the same text.
    pub const fn new(text: T, tooltip: T, invoke: Invoke) -> Self {
        Self { text, tooltip, menu: None, shortcut: None, needs_controllers: false, why_disabled: |_, _| None, invoke }
    }

    /// It is in the menu of this name.
    pub const fn in_menu(self, menu: T) -> Self {
        Self { menu: Some(menu), ..self }
    }

    /// This key invokes it.
    pub const fn key(self, modifiers: Modifiers, key: Key) -> Self {
        Self { shortcut: Some(KeyboardShortcut::new(modifiers, key)), ..self }
    }

    /// It is done to controllers: disabled as long as none is ticked.
    pub const fn for_controllers(self) -> Self {
        Self { needs_controllers: true, ..self }
    }

    /// It is disabled as well where this gives a reason.
    pub const fn disabled_if(self, why_disabled: WhyDisabled) -> Self {
        Self { why_disabled, ..self }
    }

    /// What its menu entry and its button say.
    pub const fn text(self) -> T {
        self.text
    }

    /// What it does, in a few words.
    pub const fn tooltip(self) -> T {
        self.tooltip
    }

    /// The menu it is in; `None` for a command that is in no menu.
    pub const fn menu(self) -> Option<T> {
        self.menu
    }

    /// The key that invokes it.
    pub const fn shortcut(self) -> Option<KeyboardShortcut> {
        self.shortcut
    }

    /// Its name with the menu it is in: "Server settings: Users…".
    pub fn full_name(self, language: Language) -> String {
        let name = self.text.text(language);
        self.menu.map_or_else(|| name.to_owned(), |menu| format!("{}: {name}", menu.text(language)))
    }

    /// Why it cannot be done to the ticked controllers now; what a disabled item says on hover.
    pub fn why_disabled(self, model: &Model) -> Option<T> {
        self.why_disabled_for(model, Targets::Ticked)
    }

    /// Why it cannot be done to these controllers now.
    pub fn why_disabled_for(self, model: &Model, targets: Targets) -> Option<T> {
        if self.needs_controllers && model.target_count(targets) == 0 {
            return Some(T::WhyTick);
        }
        (self.why_disabled)(model, targets)
    }

    /// Does it to the ticked controllers: opens its dialog, or starts its job. It must not be disabled.
    pub(in crate::ui) fn invoke(self, model: &mut Model) -> Commands {
        let ticked = model.rows.ticked();
        (self.invoke)(model, ticked)
    }
}

impl PartialEq for UiCommand {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl Eq for UiCommand {}

impl fmt::Debug for UiCommand {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("UiCommand").field(&self.text).finish()
    }
}
