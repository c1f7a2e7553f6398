use egui::{Align, Button, Frame, Label, Layout, RichText, ScrollArea, Stroke, TextEdit, Ui, vec2};

use crate::jobs::{Destination, ItemContent, PlannedAction, PlannedItem, TargetList};
use crate::texts::{self, TextKey as T};
use crate::ui::features::client_certificates::{AddTrustForm, PaneKind, ShownLists, TrustAction};
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, palette};
use crate::ui::widgets::{Buttons, dialog, list_title, note, small_note, word};

/// Files, and where what is in them goes (manual 2.7.3.3, 2.7.3.6).
pub fn show(ui: &Ui, form: &mut AddTrustForm, focus: bool, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let (submit, why) = if form.reads_file() {
        (T::TrustReadFile, form.reading.map(|_| text(T::Reading)))
    } else {
        let refused = form.refused.as_ref().map(|problem| problem.code.explain(model.language).message);
        (T::Add, form.incomplete().map(text).or(refused))
    };
    let title = if form.shows == ShownLists::Crls { T::CrlAddTitle } else { T::TrustAddTitle };
    let title = texts::title_for(model.language, title, &form.names);
    let buttons = Buttons { submit: Some((text(submit), why)), close: Some(text(T::Cancel)) };
    dialog(ui, "add trust", &title, theme::DIALOG_WIDE, buttons, |ui| {
        if form.shows == ShownLists::Clients {
            destination(ui, form, model, messages);
        }
        choose(ui, form, focus, model, messages);
        files(ui, form, model, messages);
        plans(ui, form, model);
    })
}

fn destination(ui: &mut Ui, form: &mut AddTrustForm, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    let none_has_issuers = !form.plans.is_empty() && form.plans.iter().all(|(has_issuers_list, _)| !has_issuers_list);
    ui.horizontal(|ui| {
        ui.label(RichText::new(text(T::TrustGoesTo)).color(palette(ui).weak));
        for (destination, label, tip) in [
            (Destination::Trusted, T::TrustTrusted, T::TrustTrustedTip),
            (Destination::Issuers, T::TrustIssuers, T::TrustIssuersTip),
            (Destination::ByKind, T::TrustByKind, T::TrustByKindTip),
        ] {
            let possible = destination != Destination::Issuers || !none_has_issuers;
            let radio = egui::RadioButton::new(form.destination == destination, text(label));
            let response = ui.add_enabled(possible, radio).on_disabled_hover_text(text(T::TrustIssuersWhy));
            if response.on_hover_text(text(tip)).clicked() {
                form.destination = destination;
                messages.push(super::act(TrustAction::Replan));
            }
        }
    });
    let tip = match form.destination {
        Destination::Issuers => T::TrustIssuersTip,
        Destination::ByKind => T::TrustByKindTip,
        Destination::Trusted | Destination::Crls => T::TrustTrustedTip,
    };
    small_note(ui, text(tip));
    ui.add_space(theme::SPACE);
}

/// The desktop's dialog, or a path, or files that are dropped.
fn choose(ui: &mut Ui, form: &mut AddTrustForm, focus: bool, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.horizontal(|ui| {
        let room = 110.0;
        let edit = TextEdit::singleline(&mut form.path)
            .hint_text(text(T::FileHint))
            .desired_width(ui.available_width() - room)
            .margin(theme::SEARCH_MARGIN);
        let edit = ui.add_enabled(form.reading.is_none(), edit).accessible_name(text(T::TrustAddFiles));
        if focus {
            edit.request_focus();
        }
        let button = Button::new(text(T::ChooseFile)).min_size(vec2(room - theme::SPACE, theme::BUTTON_HEIGHT));
        if ui.add_enabled(form.picking.is_none() && form.reading.is_none(), button).clicked() {
            messages.push(super::act(TrustAction::ChooseFiles));
        }
    });
    small_note(ui, text(if form.shows == ShownLists::Crls { T::CrlAddText } else { T::TrustAddText }));
    if let Some(problem) = &form.problem {
        let explained = problem.code.explain(model.language);
        ui.add_space(theme::SPACE);
        note(ui, palette(ui).error, |ui| {
            ui.label(RichText::new(explained.message).strong());
            ui.label(explained.remedy);
        });
    }
    if form.too_many {
        word(ui, text(T::TrustTooMany), palette(ui).error);
    }
    if form.reading.is_some() {
        word(ui, text(T::Reading), palette(ui).weak);
    }
}

/// Lines of the list of files before it scrolls.
const MOST_FILES: usize = 4;

fn files(ui: &mut Ui, form: &AddTrustForm, model: &Model, messages: &mut Vec<Message>) {
    if form.files.is_empty() {
        return;
    }
    let (language, palette) = (model.language, palette(ui));
    list_title(ui, T::TrustAddFiles.text(language));
    crate::ui::widgets::list(ui, "files", form.files.len(), MOST_FILES, |ui, index| {
        let file = &form.files[index];
        let size = vec2(ui.available_width(), theme::LIST_ROW);
        ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
            ui.push_id(index, |ui| {
                let name = format!("{}: {}", T::TrustLeaveOut.text(language), file.name);
                let button = Button::new(
                    RichText::new(T::TrustLeaveOut.text(language)).size(theme::SMALL_TEXT).color(palette.accent),
                )
                .frame(false);
                if ui.add(button).accessible_name(name).clicked() {
                    messages.push(super::act(TrustAction::LeaveOut(index)));
                }
            });
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                ui.scope(|ui| {
                    ui.set_max_width(ui.available_width() * 0.5);
                    ui.add(Label::new(&file.name).truncate()).on_hover_text(file.path.display().to_string());
                });
                match &file.problem {
                    Some(problem) => {
                        let said = problem.code.explain(language).message;
                        let said = RichText::new(said).size(theme::SMALL_TEXT).color(palette.error);
                        let response = ui.add(Label::new(said).truncate());
                        if let Some(detail) = &problem.detail {
                            response.on_hover_text(detail);
                        }
                    }
                    None => {
                        let (certificates, crls) = file.counts();
                        word(ui, &texts::file_holds(language, certificates, crls), palette.weak);
                    }
                }
            });
        });
    });
}

fn plans(ui: &mut Ui, form: &AddTrustForm, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let Some((_, plan)) = form.plans.first().filter(|(_, plan)| !plan.items.is_empty()) else { return };
    list_title(ui, T::TrustWhereGoes.text(language));
    items(ui, &plan.items, model);
    if form.plans.len() > 1 {
        for (has_issuers_list, plan) in &form.plans {
            let firmware = if *has_issuers_list { T::TrustOnCurrent } else { T::TrustOnLegacy };
            if let Err(problem) = plan.check() {
                let said = texts::on_firmware(language, firmware, problem.code);
                ui.add(Label::new(RichText::new(said).color(palette.warning)).wrap());
            }
        }
        let differs = form.plans.iter().any(|(_, other)| differs(&other.items, &plan.items));
        if differs && form.destination != Destination::Issuers {
            small_note(ui, T::TrustLegacyTrusted.text(language));
        }
    } else if let Some(problem) = &form.refused {
        let explained = problem.code.explain(language);
        ui.add_space(theme::SPACE);
        note(ui, palette.error, |ui| {
            ui.add(Label::new(RichText::new(explained.message).strong()).wrap());
            ui.add(Label::new(explained.remedy).wrap());
            if let Some(detail) = &problem.detail {
                small_note(ui, detail);
            }
        });
    }
    let revokes = plan.count(TargetList::Crls) > 0;
    if revokes {
        ui.add_space(theme::SPACE);
        note(ui, palette.warning, |ui| drop(ui.add(Label::new(T::TrustRevokesAtOnce.text(language)).wrap())));
    }
}

fn differs(one: &[PlannedItem], other: &[PlannedItem]) -> bool {
    let to = |item: &PlannedItem| match item.action {
        PlannedAction::Send { to, .. } => Some(to),
        _ => None,
    };
    one.iter().map(to).ne(other.iter().map(to))
}

/// Height of a line: what it is, and below it where it comes from and what to think about.
const ITEM: f32 = 42.0;
/// Lines before the list scrolls.
const MOST_ITEMS: usize = 5;

fn items(ui: &mut Ui, items: &[PlannedItem], model: &Model) {
    let stroke = Stroke::new(1.0, palette(ui).line);
    Frame::new().stroke(stroke).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        ui.spacing_mut().item_spacing.y = 0.0;
        let height = ITEM * items.len().min(MOST_ITEMS) as f32;
        let area = ScrollArea::vertical().id_salt("items").max_height(height).min_scrolled_height(height);
        area.auto_shrink([false, true]).show_rows(ui, ITEM, items.len(), |ui, range| {
            for item in &items[range] {
                let size = vec2(ui.available_width(), ITEM);
                ui.allocate_ui_with_layout(size, Layout::right_to_left(Align::Center), |ui| {
                    ui.set_min_size(size);
                    ui.spacing_mut().interact_size.y = 17.0;
                    one(ui, item, model);
                });
            }
        });
    });
}

fn one(ui: &mut Ui, item: &PlannedItem, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let (name, kind) = match &item.content {
        ItemContent::Certificate { summary, authority: true, .. } => (&summary.issued_to, T::TrustKindAuthority),
        ItemContent::Certificate { summary, .. } => (&summary.issued_to, T::TrustKindClient),
        ItemContent::Crl { summary, .. } => (&summary.issuer, T::TrustKindCrl),
    };
    let (to, color, notes) = match &item.action {
        PlannedAction::Send { to, notes } => {
            let notes: Vec<_> = notes.iter().map(|note| note.text(language)).collect();
            (PaneKind::of(*to).title(), palette.ok, notes)
        }
        PlannedAction::Skipped(reason) => {
            (T::TrustNothing, palette.off, vec![texts::skipped_thing(*reason).text(language).into()])
        }
        PlannedAction::Refused(problem) => {
            (T::TrustNothing, palette.error, vec![problem.code.explain(language).message.into()])
        }
    };
    crate::ui::widgets::chip(ui, to.text(language), color);
    ui.with_layout(Layout::top_down(Align::Min), |ui| {
        ui.add_space(2.0);
        ui.horizontal(|ui| {
            word(ui, kind.text(language), palette.weak);
            ui.add(Label::new(RichText::new(name).strong()).truncate());
        });
        ui.horizontal(|ui| {
            word(ui, &item.file_name, palette.weak);
            let color = if matches!(item.action, PlannedAction::Refused(_)) { palette.error } else { palette.warning };
            let said = notes.join("; ");
            let said = RichText::new(said).size(theme::SMALL_TEXT).color(color);
            ui.add(Label::new(said).truncate());
        });
    });
}
