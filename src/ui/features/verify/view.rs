use egui::{Color32, Frame, Grid, Label, RichText, Stroke, Ui, vec2};

use crate::jobs::{CertificateVerdict, EndpointVerdict, TokenOutcome, VerifyReport};
use crate::model::Problem;
use crate::pki::Severity;
use crate::session::opcua_client::TokenKind;
use crate::texts::{self, TextKey as T};
use crate::ui::features::verify::VerifyView;
use crate::ui::model::{DialogAnswer, Message, Model};
use crate::ui::theme::{self, Palette, palette};
use crate::ui::widgets::{
    Buttons, dialog, form, labelled, mistake, note, path_line, secret_field, small_note, text_field, word,
};

/// What works at each controller's OPC UA server, and why not.
pub fn show(ui: &Ui, view: &mut VerifyView, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    if view.shown.is_none() {
        // The dialog of the job lies over it.
        return DialogAnswer::None;
    }
    let why = if view.running { Some(T::Reading) } else { view.incomplete() };
    let buttons = Buttons { submit: Some((text(T::VerifyAgain), why.map(text))), close: Some(text(T::Close)) };
    let title = texts::title_for(model.language, T::VerifyTitle, &view.names);
    dialog(ui, "verify", &title, theme::DIALOG_LOG, buttons, |ui| {
        if view.rows.len() > 1 {
            controllers(ui, view, model);
        }
        match view.report() {
            Some(Ok(report)) => headline(ui, report, model),
            Some(Err(problem)) => not_asked(ui, problem, model),
            None => {}
        }
        // What helps most often comes first.
        let lacking = view.lacking_trust().len();
        if lacking > 0 {
            trust(ui, view, lacking, model, messages);
        }
        if let Some(Ok(report)) = view.report() {
            self::report(ui, report, model);
        }
        if view.asks_for_login() {
            login(ui, view, model);
        }
    })
}

/// One line a controller, to choose whose report is shown.
fn controllers(ui: &mut Ui, view: &mut VerifyView, model: &Model) {
    let palette = palette(ui);
    for row in view.rows.clone() {
        let Some(found) = view.of.get(&row) else { continue };
        let (said, color) = match found {
            Ok(report) if report.all_works() => (T::VerifyWorks.text(model.language).to_owned(), palette.ok),
            Ok(report) if report.endpoints.is_empty() => {
                (T::VerifyFails.text(model.language).to_owned(), palette.error)
            }
            Ok(report) => (texts::verify_counts(model.language, report.counts()), palette.error),
            Err(problem) => (problem.code.explain(model.language).message.to_owned(), palette.error),
        };
        let name = model.rows.get(row).map(|row| row.entry.name.as_str()).unwrap_or_default().to_owned();
        ui.horizontal(|ui| {
            ui.radio_value(&mut view.shown, Some(row), name);
            word(ui, &said, color);
        });
    }
    ui.add_space(theme::SPACE);
}

fn not_asked(ui: &mut Ui, problem: &Problem, model: &Model) {
    let explained = problem.code.explain(model.language);
    note(ui, palette(ui).error, |ui| {
        ui.label(RichText::new(explained.message).strong());
        small_note(ui, explained.remedy);
    });
}

fn headline(ui: &mut Ui, report: &VerifyReport, model: &Model) {
    let palette = palette(ui);
    let (key, color) = if report.all_works() { (T::VerifyWorks, palette.ok) } else { (T::VerifyFails, palette.error) };
    ui.horizontal(|ui| {
        ui.label(RichText::new(key.text(model.language)).strong().color(color));
        ui.add(Label::new(RichText::new(&report.url).monospace().color(palette.weak)).selectable(true));
    });
    for finding in &report.findings {
        line(ui, finding.severity(), &finding.explain(model.language), model);
    }
}

fn report(ui: &mut Ui, report: &VerifyReport, model: &Model) {
    if let Some(verdict) = &report.certificate {
        ui.add_space(theme::SPACE);
        certificate(ui, verdict, model);
    }
    if !report.endpoints.is_empty() {
        ui.add_space(theme::SPACE);
        matrix(ui, report, model);
        reasons(ui, report, model);
    }
}

fn line(ui: &mut Ui, severity: Severity, said: &str, model: &Model) {
    let palette = palette(ui);
    let (key, color) = match severity {
        Severity::Error => (T::StatusError, palette.error),
        Severity::Warning => (T::Warning, palette.warning),
    };
    let said = texts::finding(model.language, key, said);
    ui.add(Label::new(RichText::new(said).color(color)).wrap().selectable(true));
}

fn certificate(ui: &mut Ui, verdict: &CertificateVerdict, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let (key, color) = match verdict.refused {
        None => (T::VerifyAccepted, palette.ok),
        Some(_) => (T::VerifyRefused, palette.error),
    };
    framed(ui, if verdict.refused.is_some() { palette.error } else { palette.line }, |ui| {
        ui.horizontal(|ui| {
            ui.label(RichText::new(T::VerifyCertificate.text(language)).strong());
            word(ui, key.text(language), color);
        });
        small_note(ui, &texts::stored_certificate(language, &verdict.summary, model.zone));
        if let Some(rejection) = &verdict.refused {
            let said = rejection.cause().explain(language);
            ui.add(Label::new(RichText::new(said).color(palette.error)).wrap().selectable(true));
            // The words an OPC UA client would log.
            small_note(ui, rejection.status().as_str());
        }
        for finding in verdict.further_findings() {
            line(ui, finding.severity, &finding.explain(language), model);
        }
    });
}

fn framed(ui: &mut Ui, line: Color32, body: impl FnOnce(&mut Ui)) {
    Frame::new().stroke(Stroke::new(1.0, line)).corner_radius(8).inner_margin(theme::CARD_MARGIN).show(ui, |ui| {
        ui.set_width(ui.available_width());
        body(ui);
    });
}

/// Endpoints down, tokens across.
fn matrix(ui: &mut Ui, report: &VerifyReport, model: &Model) {
    let (language, palette) = (model.language, palette(ui));
    let mut kinds: Vec<TokenKind> =
        report.endpoints.iter().flat_map(|endpoint| &endpoint.tokens).map(|token| token.kind).collect();
    kinds.sort_unstable();
    kinds.dedup();
    framed(ui, palette.line, |ui| {
        ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
        let spacing = vec2(theme::SPACE_LARGE * 2.0, 0.0);
        Grid::new("verify matrix").num_columns(kinds.len() + 1).spacing(spacing).striped(true).show(ui, |ui| {
            let heading = |ui: &mut Ui, text: &str| {
                ui.label(RichText::new(text).size(theme::HEADER_TEXT).color(palette.weak));
            };
            heading(ui, T::VerifyEndpoint.text(language));
            for kind in &kinds {
                heading(ui, kind.text(language));
            }
            ui.end_row();
            for endpoint in &report.endpoints {
                ui.label(endpoint.name());
                for kind in &kinds {
                    cell(ui, endpoint, *kind, model);
                }
                ui.end_row();
            }
        });
    });
}

fn cell(ui: &mut Ui, endpoint: &EndpointVerdict, kind: TokenKind, model: &Model) {
    let Some(token) = endpoint.tokens.iter().find(|token| token.kind == kind) else {
        ui.label("");
        return;
    };
    let (mark, key, color) = look(&token.verdict, palette(ui));
    let said = token.verdict.explain(model.language);
    let shown = RichText::new(format!("{mark} {}", key.text(model.language))).color(color);
    ui.label(shown).on_hover_text(said);
}

fn look(verdict: &TokenOutcome, palette: &Palette) -> (char, T, Color32) {
    match verdict {
        TokenOutcome::Works => ('✓', T::VerdictWorks, palette.ok),
        TokenOutcome::Fails(_) => ('×', T::VerdictFails, palette.error),
        TokenOutcome::NotTried(_) => ('–', T::VerdictNotTried, palette.off),
    }
}

/// Why not: each sentence once, with the endpoints it is about.
fn reasons(ui: &mut Ui, report: &VerifyReport, model: &Model) {
    let palette = palette(ui);
    let mut said: Vec<(String, Color32, Vec<String>)> = Vec::new();
    for endpoint in &report.endpoints {
        for token in endpoint.tokens.iter().filter(|token| token.verdict != TokenOutcome::Works) {
            let sentence = token.verdict.explain(model.language);
            let name = endpoint.name();
            match said.iter_mut().find(|(known, ..)| *known == sentence) {
                Some((.., names)) if names.contains(&name) => {}
                Some((.., names)) => names.push(name),
                None => said.push((sentence, look(&token.verdict, palette).2, vec![name])),
            }
        }
    }
    // What fails before what was left out.
    said.sort_by_key(|(_, color, _)| *color == palette.off);
    for (sentence, color, names) in said {
        ui.add_space(theme::SPACE / 2.0);
        ui.add(Label::new(RichText::new(sentence).color(color)).wrap().selectable(true));
        small_note(ui, &texts::endpoints_named(model.language, &names));
    }
}

fn trust(ui: &mut Ui, view: &VerifyView, lacking: usize, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    ui.add_space(theme::SPACE / 2.0);
    note(ui, palette(ui).warning, |ui| {
        ui.add(Label::new(text(T::VerifyTrustText)).wrap());
        let own = view.of.values().find_map(|found| found.as_ref().ok()).map(|report| &report.own);
        if let Some(folder) = own.and_then(|own| own.certificate_path.parent()) {
            path_line(ui, folder, true, model.language, messages);
        }
        let clicked = ui.add_enabled(!view.running, egui::Button::new(text(T::VerifyTrust))).clicked();
        if view.rows.len() > 1 {
            small_note(ui, &texts::controllers(model.language, lacking));
        }
        if clicked {
            messages.push(Message::act(Model::trust_configurator));
        }
    });
}

fn login(ui: &mut Ui, view: &mut VerifyView, model: &Model) {
    let text = |key: T| key.text(model.language);
    ui.add_space(theme::SPACE);
    small_note(ui, text(T::VerifyLogin));
    form(ui, "verify login", |ui| {
        labelled(ui, text(T::UserName), |ui| Some(text_field(ui, &mut view.user, text(T::UserRule))));
        labelled(ui, text(T::UserPassword), |ui| {
            let VerifyView { password, show_password, .. } = &mut *view;
            let response = secret_field(ui, &mut password.0, show_password, "", model.language);
            if let Some(why) = view.incomplete() {
                mistake(ui, text(why));
            }
            Some(response)
        });
    });
}
