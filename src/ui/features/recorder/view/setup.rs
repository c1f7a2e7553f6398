use egui::Ui;

use crate::recorder::Format;
use crate::texts::{self, TextKey as T};
use crate::ui::features::recorder::form::RecorderForm;
use crate::ui::features::recorder::setup::{RecordedData, RecorderSetup, limit_error};
use crate::ui::model::{BrowseField, BrowseFor, DialogAnswer, Message, Model};
use crate::ui::picker::FileKind;
use crate::ui::theme;
use crate::ui::widgets::{
    Buttons, choices, dialog, form as fields, labelled, list_title, mistake, path_field, secret_field, small_note,
    text_field,
};

const FOLDER: BrowseField = BrowseField {
    kind: FileKind::Folder,
    asks_for: BrowseFor::Folder(T::RecorderFolderTitle),
    text: |model| model.dialog::<RecorderForm>().map(|form| &mut form.setup.folder),
};

/// What is recorded, how, and when it ends.
pub fn show(ui: &Ui, form: &mut RecorderForm, model: &Model, messages: &mut Vec<Message>) -> DialogAnswer {
    let text = |key: T| key.text(model.language);
    let why = form.setup.incomplete();
    let buttons = Buttons { submit: Some((text(T::RecorderStart), why.map(text))), close: Some(text(T::Cancel)) };
    let title = texts::title_for(model.language, T::RecorderTitle, &form.names);
    dialog(ui, "recorder", &title, theme::DIALOG_WIDE, buttons, |ui| {
        let setup = &mut form.setup;
        fields(ui, "recorder data", |ui| data(ui, setup, model));
        if setup.data == RecordedData::Force {
            small_note(ui, text(T::RecorderPortText));
        }
        list_title(ui, text(T::RecorderFiles));
        fields(ui, "recorder files", |ui| files(ui, setup, model, messages));
        list_title(ui, text(T::RecorderEnds));
        fields(ui, "recorder limits", |ui| limits(ui, setup, model));
        list_title(ui, text(T::RecorderLogin));
        fields(ui, "recorder login", |ui| login(ui, setup, model));
        ui.add_space(theme::SPACE);
        if ui.button(text(T::OpenRecording)).on_hover_text(text(T::OpenRecordingTip)).clicked() {
            messages.push(Message::act(|model| model.open_recording(None)));
        }
    })
}

fn data(ui: &mut Ui, setup: &mut RecorderSetup, model: &Model) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::RecordingData), |ui| {
        choices(ui, |ui| {
            ui.radio_value(&mut setup.data, RecordedData::Motion, text(T::RecordingMotion))
                .on_hover_text(text(T::RecorderMotionTip));
            ui.radio_value(&mut setup.data, RecordedData::Force, text(T::RecordingForce))
                .on_hover_text(text(T::RecorderForceTip));
        });
        None
    });
    match setup.data {
        RecordedData::Motion => labelled(ui, text(T::RecorderInterval), |ui| {
            choices(ui, |ui| {
                for interval in 0..=4 {
                    let label = format!("{interval} (× {})", 1 << interval);
                    ui.radio_value(&mut setup.sampling_interval, interval, label)
                        .on_hover_text(text(T::RecorderIntervalTip));
                }
            });
            None
        }),
        RecordedData::Force => {
            labelled(ui, text(T::RecorderMonitor), |ui| {
                choices(ui, |ui| {
                    for monitor in [1, 2] {
                        ui.radio_value(&mut setup.monitor, monitor, monitor.to_string())
                            .on_hover_text(text(T::RecorderMonitorTip));
                    }
                });
                None
            });
            labelled(ui, text(T::RecorderDataType), |ui| {
                ui.spacing_mut().interact_size.y = theme::DENSE_HEIGHT;
                let kinds = [T::ForceDataAll, T::ForceDataMotion, T::ForceDataForce, T::ForceDataPosition];
                for (number, kind) in (0..).zip(kinds) {
                    ui.radio_value(&mut setup.data_type, number, format!("{number}: {}", text(kind)));
                }
                None
            });
        }
    }
    labelled(ui, text(T::RecorderDataNum), |ui| {
        let response = text_field(ui, &mut setup.data_num, text(T::RecorderDataNumHint));
        if let Some(error) = setup.data_num_error() {
            mistake(ui, text(error));
        }
        Some(response.on_hover_text(text(T::RecorderDataNumText)))
    });
}

fn files(ui: &mut Ui, setup: &mut RecorderSetup, model: &Model, messages: &mut Vec<Message>) {
    let text = |key: T| key.text(model.language);
    path_field(ui, text(T::RecorderFolder), &mut setup.folder, "", FOLDER, model.language, messages);
    labelled(ui, text(T::RecorderFormat), |ui| {
        choices(ui, |ui| {
            ui.radio_value(&mut setup.format, Format::Csv, "CSV").on_hover_text(text(T::RecorderCsvTip));
            ui.radio_value(&mut setup.format, Format::Parquet, "Parquet").on_hover_text(text(T::RecorderParquetTip));
            ui.checkbox(&mut setup.keep_packets, text(T::RecorderKeepPackets))
                .on_hover_text(text(T::RecorderKeepPacketsTip));
        });
        None
    });
}

fn limits(ui: &mut Ui, setup: &mut RecorderSetup, model: &Model) {
    let text = |key: T| key.text(model.language);
    let limit = |ui: &mut Ui, label: T, typed: &mut String| {
        labelled(ui, text(label), |ui| {
            let response = ui.scope(|ui| {
                ui.set_max_width(theme::LABEL_WIDTH);
                text_field(ui, typed, text(T::RecorderNoLimit))
            });
            if let Some(error) = limit_error(typed) {
                mistake(ui, text(error));
            }
            Some(response.inner)
        });
    };
    limit(ui, T::RecorderSeconds, &mut setup.seconds);
    limit(ui, T::RecorderMegabytes, &mut setup.megabytes);
    if setup.data == RecordedData::Force {
        limit(ui, T::RecorderFooters, &mut setup.footers);
    }
}

fn login(ui: &mut Ui, setup: &mut RecorderSetup, model: &Model) {
    let text = |key: T| key.text(model.language);
    labelled(ui, text(T::UserName), |ui| Some(text_field(ui, &mut setup.user, text(T::RecorderAnonymous))));
    labelled(ui, text(T::UserPassword), |ui| {
        let why = setup.login().err();
        let response = secret_field(ui, &mut setup.password.0, &mut setup.show_password, "", model.language);
        if let Some(why) = why {
            mistake(ui, text(why));
        }
        Some(response)
    });
}
