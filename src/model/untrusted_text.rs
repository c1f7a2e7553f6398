//! Text that a controller, a client, a certificate or a file brings, made fit for terminals and windows.

/// Shown in place of a character that must not be written out.
const SHOWN_INSTEAD: char = char::REPLACEMENT_CHARACTER;

/// Whether a terminal or a text layout obeys this character instead of showing it: control characters (escape sequences
/// begin with one), the bidirectional controls of Unicode UAX #9, separators of lines and paragraphs, and characters
/// without a width that make two texts look the same. Joiners (U+200C, U+200D) are kept: scripts and emoji need them.
pub const fn is_obeyed(c: char) -> bool {
    matches!(c,
        '\0'..='\x1f'
        | '\x7f'..='\u{9f}'
        | '\u{ad}'
        | '\u{61c}'
        | '\u{180e}'
        | '\u{200b}' | '\u{200e}' | '\u{200f}'
        | '\u{2028}'..='\u{202e}'
        | '\u{2060}'..='\u{206f}'
        | '\u{feff}'
        | '\u{fff9}'..='\u{fffb}'
        | '\u{e0000}'..='\u{e007f}')
}

/// The text as one line of at most `max` characters, and `…` where more followed. A line break or a tab becomes a blank,
/// any other character of [`is_obeyed`] becomes `�`.
pub fn one_line(text: &str, max: usize) -> String {
    let mut chars = text.chars().map(|c| match c {
        '\n' | '\r' | '\t' => ' ',
        c if is_obeyed(c) => SHOWN_INSTEAD,
        c => c,
    });
    let mut line: String = chars.by_ref().take(max).collect();
    if chars.next().is_some() {
        line.push('…');
    }
    line
}

/// The text with its lines: LF and CR LF end one, and stay; a tab becomes a blank, any other character of [`is_obeyed`]
/// becomes `�`.
pub fn lines(text: &str) -> String {
    text.split_inclusive('\n')
        .flat_map(|line| {
            let (line, end) = match line.strip_suffix('\n') {
                Some(line) => (line.strip_suffix('\r').unwrap_or(line), "\n"),
                None => (line, ""),
            };
            [one_line(line, usize::MAX), end.to_owned()]
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_line_commands_no_terminal_and_turns_no_text_round() {
        for (text, shown) in [
            ("\u{1b}[2Jgone\r\nnext", "�[2Jgone  next"),
            ("\u{9b}31mred", "�31mred"),
            ("a\u{202e}gpj.exe", "a�gpj.exe"),
            ("\u{2066}x\u{2069}\u{200f}", "�x��"),
            ("two\u{2028}lines", "two�lines"),
            ("\u{feff}word\u{200b}s", "�word�s"),
            ("焊接 – Größe 👩\u{200d}🔧", "焊接 – Größe 👩\u{200d}🔧"),
        ] {
            assert_eq!(one_line(text, 500), shown, "{text:?}");
        }
    }

    #[test]
    fn one_line_has_an_end() {
        assert_eq!(one_line("长长长", 3), "长长长");
        assert_eq!(one_line("长长长长", 3), "长长长…");
        assert_eq!(one_line(&"x".repeat(4_000_000), 500).chars().count(), 501);
    }

    #[test]
    fn lines_stay_lines() {
        assert_eq!(lines("a\tb\r\n\u{1b}[31mc\n"), "a b\n�[31mc\n");
        assert_eq!(lines("a\rb"), "a b", "a lone carriage return would overwrite the line");
        assert_eq!(lines(""), "");
    }
}
