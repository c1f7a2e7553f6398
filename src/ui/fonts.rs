use egui::epaint::text::{FontInsert, FontPriority, InsertFontFamily};
use egui::{Context, FontData, FontFamily};

/// Adds Chinese after egui's own fonts, so that it shows on computers without a Chinese font.
pub fn install(ctx: &Context) {
    let data = FontData::from_static(include_bytes!("../../assets/fonts/NotoSansSC-gb2312-level1.otf"));
    let family = |family| InsertFontFamily { family, priority: FontPriority::Lowest };
    let families = vec![family(FontFamily::Proportional), family(FontFamily::Monospace)];
    ctx.add_font(FontInsert::new("noto-sans-sc", data, families));
}
