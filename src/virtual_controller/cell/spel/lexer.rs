use super::error::SpelError;

/// One word, number, text or sign of a statement.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Token {
    /// Letters, digits and underscores behind a letter, and a dollar sign at the end. In the case it was written in.
    Word(String),
    /// A whole number.
    Integer(i128),
    /// A number with a decimal point or an exponent.
    Real(f64),
    /// What was between quotes.
    Text(String),
    /// One of `( ) , ; : + - * / =`.
    Sign(char),
}

/// A token and where it begins, in bytes.
pub(super) type Placed = (usize, Token);

/// Cuts a text into tokens. Blanks separate; `'` begins a comment. A text whose quote is not closed goes to the end, as
/// in a command that is itself in quotes.
pub(super) fn tokens(text: &str) -> Result<Vec<Placed>, SpelError> {
    let mut tokens = Vec::new();
    let mut rest = text;
    loop {
        rest = rest.trim_start();
        let at = text.len() - rest.len();
        let Some(first) = rest.chars().next() else { return Ok(tokens) };
        let (token, left) = match first {
            '\'' => return Ok(tokens),
            '"' => {
                let (inside, left) = rest[1..].split_once('"').unwrap_or((&rest[1..], ""));
                (Token::Text(inside.to_owned()), left)
            }
            '&' => hexadecimal(rest).ok_or_else(|| unsupported(rest))?,
            _ if first.is_ascii_digit() || first == '.' => number(rest).ok_or_else(|| unsupported(rest))?,
            _ if first.is_ascii_alphabetic() => word(rest),
            '(' | ')' | ',' | ';' | ':' | '+' | '-' | '*' | '/' | '=' => (Token::Sign(first), &rest[1..]),
            _ => return Err(unsupported(rest)),
        };
        tokens.push((at, token));
        rest = left;
    }
}

pub(super) fn unsupported(rest: &str) -> SpelError {
    SpelError::Unsupported(rest.chars().filter(|character| !character.is_control()).take(40).collect())
}

fn word(text: &str) -> (Token, &str) {
    let end = text.find(|next: char| !next.is_ascii_alphanumeric() && next != '_').unwrap_or(text.len());
    let end = if text[end..].starts_with('$') { end + 1 } else { end };
    (Token::Word(text[..end].to_owned()), &text[end..])
}

/// `&H` and hexadecimal digits.
fn hexadecimal(text: &str) -> Option<(Token, &str)> {
    let digits = text.strip_prefix("&H").or_else(|| text.strip_prefix("&h"))?;
    let end = digits.find(|next: char| !next.is_ascii_hexdigit()).unwrap_or(digits.len());
    let value = u64::from_str_radix(&digits[..end], 16).ok()?;
    Some((Token::Integer(value.into()), &digits[end..]))
}

/// Digits with at most one point, and an exponent.
fn number(text: &str) -> Option<(Token, &str)> {
    let digits = |from: usize| {
        let end = text[from..].find(|next: char| !next.is_ascii_digit());
        end.map_or(text.len(), |end| from + end)
    };
    let whole = digits(0);
    let mut end = whole;
    if text[end..].starts_with('.') {
        end = digits(end + 1);
    }
    if text[end..].starts_with(['e', 'E']) {
        let sign = usize::from(text[end + 1..].starts_with(['+', '-']));
        let exponent = digits(end + 1 + sign);
        if exponent > end + 1 + sign {
            end = exponent;
        }
    }
    let token = if end == whole {
        Token::Integer(text[..end].parse::<u64>().ok()?.into())
    } else {
        Token::Real(text[..end].parse().ok()?)
    };
    Some((token, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(text: &str) -> Vec<Token> {
        tokens(text).unwrap().into_iter().map(|(_, token)| token).collect()
    }

    fn word(text: &str) -> Token {
        Token::Word(text.to_owned())
    }

    #[test]
    fn words_numbers_texts_and_signs() {
        assert_eq!(
            found("Print ErrMsg$(2150), P1+X(-0.5e1);'x"),
            [
                word("Print"),
                word("ErrMsg$"),
                Token::Sign('('),
                Token::Integer(2150),
                Token::Sign(')'),
                Token::Sign(','),
                word("P1"),
                Token::Sign('+'),
                word("X"),
                Token::Sign('('),
                Token::Sign('-'),
                Token::Real(5.0),
                Token::Sign(')'),
                Token::Sign(';'),
            ]
        );
        assert_eq!(
            found("&HfF .5 1e x2 1."),
            [Token::Integer(255), Token::Real(0.5), Token::Integer(1), word("e"), word("x2"), Token::Real(1.0)]
        );
        assert_eq!(found(r#""a'b" "open"#), [Token::Text("a'b".to_owned()), Token::Text("open".to_owned())]);
        assert_eq!(found(" \t"), []);
    }

    #[test]
    fn other_characters_are_not_understood() {
        for wrong in ["?", "a % b", "&HG", "&", "99999999999999999999", "日", "1 \u{7f}", "."] {
            assert!(matches!(tokens(wrong), Err(SpelError::Unsupported(_))), "{wrong}");
        }
        assert_eq!(tokens("On 1 #\x07x"), Err(SpelError::Unsupported("#x".to_owned())));
    }
}
