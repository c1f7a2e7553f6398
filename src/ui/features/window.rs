//! Commands of the window itself, which belong to no dialog. That of the command palette stands beside the palette.

use egui::{Key, Modifiers};

use crate::texts::TextKey as T;
use crate::ui::model::{BackendCommand, UiCommand};

impl UiCommand {
    /// Closes the window.
    pub const QUIT: Self = Self::new(T::Quit, T::QuitTip, |_, _| vec![BackendCommand::Quit])
        .in_menu(T::MenuController)
        .key(Modifiers::COMMAND, Key::Q);

    /// Shows or hides the details of the row under the cursor.
    pub const ROW_DETAILS: Self = Self::new(T::RowDetails, T::RowDetailsTip, |model, _| {
        model.show_details(!model.options.window.details);
        vec![]
    })
    .in_menu(T::MenuController)
    .key(Modifiers::COMMAND, Key::D)
    .disabled_if(|model, _| model.rows.is_empty().then_some(T::WhyEmpty));

    /// Ticks all rows that the search shows, or takes away their ticks if all have one.
    pub const TICK_ALL: Self = Self::new(T::TickAll, T::TickAllTip, |model, _| {
        model.rows.tick_shown(!model.rows.all_shown_ticked());
        vec![]
    })
    .key(Modifiers::COMMAND, Key::A)
    .disabled_if(|model, _| model.rows.is_empty().then_some(T::WhyEmpty));

    /// The search field of the toolbar takes the keyboard, which only the window can give it: the views do this.
    pub const SEARCH: Self = Self::new(T::Search, T::SearchTip, |_, _| vec![])
        .key(Modifiers::COMMAND, Key::F)
        .disabled_if(|model, _| model.rows.is_empty().then_some(T::WhyEmpty));
}
