use serde::{Deserialize, Serialize};

/// A language of the texts. Everything a person reads exists in each.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Language {
    /// English.
    #[default]
    En,
    /// Simplified Chinese.
    Zh,
    /// Japanese.
    Ja,
}

impl Language {
    /// All languages, in the order of the options.
    pub const ALL: [Self; 3] = [Self::En, Self::Zh, Self::Ja];

    /// ISO 639-1, as in locale names, in the configuration file and after `--lang`.
    pub const fn code(self) -> &'static str {
        match self {
            Self::En => "en",
            Self::Zh => "zh",
            Self::Ja => "ja",
        }
    }

    /// From a locale name such as `zh-CN` or `en_GB.UTF-8`; anything unknown is English.
    pub fn from_locale(locale: &str) -> Self {
        let locale = locale.to_ascii_lowercase();
        Self::ALL.into_iter().find(|language| locale.starts_with(language.code())).unwrap_or_default()
    }

    /// The language's own name, as a language menu shows it.
    pub const fn own_name(self) -> &'static str {
        match self {
            Self::En => "English",
            Self::Zh => "简体中文",
            Self::Ja => "日本語",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_locale_names_its_language() {
        assert_eq!(Language::from_locale("zh-CN"), Language::Zh);
        assert_eq!(Language::from_locale("ZH_hans"), Language::Zh);
        assert_eq!(Language::from_locale("ja_JP.UTF-8"), Language::Ja);
        assert_eq!(Language::from_locale("en_GB.UTF-8"), Language::En);
        assert_eq!(Language::from_locale("xx-XX"), Language::En);
    }

    #[test]
    fn a_language_is_stored_by_its_code() {
        for language in Language::ALL {
            assert_eq!(serde_json::to_value(language).unwrap(), language.code());
        }
    }
}
