use super::*;

#[test]
fn fixed_texts_follow_the_house_style() {
    for key in TextKey::ALL {
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
