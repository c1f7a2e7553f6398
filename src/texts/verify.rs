//! What is said of reports about connecting as a client.

use crate::jobs::Counts;
use crate::model::Language;

/// What came of everything that is offered.
pub fn verify_counts(language: Language, counts: Counts) -> String {
    let Counts { work, fail, not_tried } = counts;
    match language {
        Language::En => format!("{work} work, {fail} do not, {not_tried} not tried"),
        Language::Zh => format!("{work} 个正常，{fail} 个失败，{not_tried} 个未尝试"),
    }
}

/// Where a sentence holds, when there are many places.
pub fn endpoints_named(language: Language, names: &[String]) -> String {
    match (names, language) {
        (names, Language::En) if names.len() > MOST => format!("{} endpoints", names.len()),
        (names, Language::Zh) if names.len() > MOST => format!("{} 个端点", names.len()),
        (names, Language::En) => names.join(", "),
        (names, Language::Zh) => names.join("、"),
    }
}

const MOST: usize = 4;
