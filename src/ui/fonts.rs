use std::sync::Arc;

use egui::{Context, FontData, FontDefinitions};

use crate::model::Language;

const CHINESE: &str = "noto-sans-sc";
const JAPANESE: &str = "noto-sans-jp";

/// Sets egui's own fonts with Chinese and Japanese ones behind them, so that both show on computers without such fonts.
///
/// The two languages write many characters differently that Unicode does not tell apart: the font of the language comes
/// first, and the other one draws what it lacks.
pub fn install(ctx: &Context, language: Language) {
    let mut fonts = FontDefinitions::default();
    let chinese = FontData::from_static(include_bytes!("../../assets/fonts/NotoSansSC-gb2312-level1.otf"));
    let japanese = FontData::from_static(include_bytes!("../../assets/fonts/NotoSansJP-jis-level1.otf"));
    fonts.font_data.insert(CHINESE.to_owned(), Arc::new(chinese));
    fonts.font_data.insert(JAPANESE.to_owned(), Arc::new(japanese));
    for family in fonts.families.values_mut() {
        family.extend(order(language).map(str::to_owned));
    }
    ctx.set_fonts(fonts);
}

/// The fonts behind egui's own, in the order in which they are asked for a character.
pub const fn order(language: Language) -> [&'static str; 2] {
    match language {
        Language::Ja => [JAPANESE, CHINESE],
        Language::En | Language::Zh => [CHINESE, JAPANESE],
    }
}
