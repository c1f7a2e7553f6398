use super::{fonts, native_options, no_display, theme, viewport};
use crate::model::{Language, Problem};
use crate::texts::TextKey;

/// Shows a text in a small window of its own, and returns when it is closed. Not while the main window is open.
pub fn show_notice(text: &str, language: Language) -> Result<(), Problem> {
    let viewport =
        viewport(TextKey::AppName.text(language)).with_inner_size(theme::NOTICE_WINDOW).with_resizable(false);
    let notice = Notice { text: text.to_owned(), language };
    let create = |creation: &eframe::CreationContext<'_>| {
        theme::install(&creation.egui_ctx);
        fonts::install(&creation.egui_ctx, language);
        Ok(Box::new(notice) as Box<dyn eframe::App>)
    };
    eframe::run_native(super::APP_ID, native_options(viewport), Box::new(create)).map_err(no_display)
}

struct Notice {
    text: String,
    language: Language,
}

impl eframe::App for Notice {
    fn ui(&mut self, ui: &mut egui::Ui, _frame: &mut eframe::Frame) {
        egui::Panel::bottom("buttons").show_separator_line(false).show(ui, |ui| {
            ui.add_space(theme::NOTICE_SPACE);
            ui.vertical_centered(|ui| {
                let confirmed =
                    ui.input(|input| input.key_pressed(egui::Key::Enter) || input.key_pressed(egui::Key::Escape));
                if ui.button(TextKey::Ok.text(self.language)).clicked() || confirmed {
                    ui.ctx().send_viewport_cmd(egui::ViewportCommand::Close);
                }
            });
            ui.add_space(theme::NOTICE_SPACE);
        });
        egui::CentralPanel::default().show(ui, |ui| {
            egui::ScrollArea::vertical().show(ui, |ui| ui.add(egui::Label::new(&self.text).wrap()));
        });
    }
}
