//! The licences of everything linked in.

mod view;

use egui::Ui;

use crate::licences::{Component, Licences};
use crate::texts::TextKey as T;
use crate::ui::model::{Dialog, DialogAnswer, DialogPlace, Message, Model, UiCommand};

/// The licences of what is linked in: a list to search, and the texts of one component.
#[derive(Debug)]
pub struct LicencesView {
    pub filter: String,
    /// Indices of the components that the filter lets through.
    shown: Vec<usize>,
    selected: usize,
}

impl Default for LicencesView {
    fn default() -> Self {
        let mut view = Self { filter: String::new(), shown: Vec::new(), selected: 0 };
        view.find();
        view
    }
}

impl LicencesView {
    /// Applies the filter to names and licences; to be called when it has changed.
    pub fn find(&mut self) {
        let needle = self.filter.trim().to_lowercase();
        let matches = |component: &Component| {
            component.name.to_lowercase().contains(&needle) || component.licence.to_lowercase().contains(&needle)
        };
        let components = Licences::get().components();
        self.shown = (0..components.len()).filter(|at| matches(&components[*at])).collect();
        if !self.shown.contains(&self.selected) {
            self.selected = self.shown.first().copied().unwrap_or(self.selected);
        }
    }

    pub fn shown(&self) -> &[usize] {
        &self.shown
    }

    pub fn select(&mut self, component: usize) {
        self.selected = component;
    }

    pub fn is_selected(&self, component: usize) -> bool {
        self.selected == component
    }

    pub fn selected(&self) -> Option<&'static Component> {
        Licences::get().components().get(self.selected)
    }
}

impl UiCommand {
    /// Shows the licences.
    pub const LICENCES: Self = Self::new(T::Licences, T::LicencesTip, |model, _| {
        model.open(LicencesView::default());
        vec![]
    })
    .in_menu(T::MenuHelp);
}

impl Dialog for LicencesView {
    fn show(&mut self, ui: &Ui, place: DialogPlace, model: &Model, _messages: &mut Vec<Message>) -> DialogAnswer {
        view::show(ui, self, place.focus, model)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_filter_finds_names_and_licences_and_selects_the_first() {
        let mut view = LicencesView::default();
        assert_eq!(view.shown().len(), Licences::get().components().len());
        view.filter = "mpl-2".to_owned();
        view.find();
        assert!(view.selected().unwrap().licence.contains("MPL"));
        view.filter = " EGUI ".to_owned();
        view.find();
        assert!(view.shown().iter().all(|at| Licences::get().components()[*at].name.contains("egui")));
        view.filter = "no such thing".to_owned();
        view.find();
        assert!(view.shown().is_empty());
    }
}
