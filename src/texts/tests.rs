use super::*;
use crate::model::ErrorCode;

#[test]
fn fixed_texts_follow_the_house_style() {
    for key in TextKey::all() {
        for language in Language::ALL {
            let text = key.text(language);
            assert!(!text.is_empty(), "{key:?}");
            assert!(!text.ends_with([':', '：']), "{key:?}: no colon after a label");
        }
        let en = key.text(Language::En);
        let sentences = en.matches(". ").count() + 1;
        assert!(sentences > 1 || !en.ends_with('.') || en.len() > 40, "{key:?}: {en}");
        assert!(!en.ends_with("..."), "{key:?}: use …");
    }
}

/// See the module of the Japanese texts.
#[test]
fn japanese_follows_its_house_style() {
    let japanese = |c: char| ('\u{3041}'..='\u{30ff}').contains(&c) || ('\u{4e00}'..='\u{9fff}').contains(&c);
    let mut texts: Vec<&str> = TextKey::all().map(|key| key.text(Language::Ja)).collect();
    for code in ErrorCode::ALL {
        let Explanation { message, cause, remedy } = code.explain(Language::Ja);
        assert!(!message.contains('。') && cause.ends_with('。') && remedy.ends_with('。'), "{code:?}");
        texts.extend([message, cause, remedy]);
    }
    let help = help(Language::Ja).unwrap();
    texts.extend(help.commands.iter().map(|(_, text)| text));
    texts.extend(help.arguments.iter().map(|(.., text)| text));
    for text in texts {
        let characters: Vec<char> = text.chars().collect();
        for window in characters.windows(3) {
            let [before, between, after] = window else { unreachable!() };
            let one_is_latin = before.is_ascii_alphanumeric() || after.is_ascii_alphanumeric();
            let blank = *between == ' ' && (japanese(*before) || japanese(*after)) && one_is_latin;
            assert!(!blank, "a blank between Japanese and Latin: {text}");
        }
        assert!(!text.contains(['（', '）', '，', '“', '”']), "{text}");
        for word in ["コントローラ", "サーバ", "ユーザ", "フォルダ", "エラ", "ドライバ", "パラメータ"]
        {
            let short = text.match_indices(word).any(|(at, _)| !text[at + word.len()..].starts_with('ー'));
            assert!(!short, "{word} without its long vowel: {text}");
        }
    }
}
