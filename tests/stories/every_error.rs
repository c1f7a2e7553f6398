//! Every error is given by the program, and a test provokes it.
//!
//! Checked on the sources. A code counts as provoked when a test expects it of the program: it is in the arguments of an
//! assertion (`assert_eq!`, `assert!`, a function called `assert_…` or `refused`), or in the last column of a table that a
//! `for` loop goes through, with an assertion on that column in the loop. A code that a test only makes up, as for a picture
//! or a peer that lies, does not count.
//!
//! Limit: whether the value that is compared came out of the program cannot be seen here.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use opcua_configurator::model::ErrorCode;

/// Names of variants and names on the wire.
#[derive(Default)]
struct Found<'a>(BTreeSet<&'a str>);

impl<'a> Found<'a> {
    fn has(&self, code: ErrorCode) -> bool {
        self.0.contains(code.as_str()) || self.0.contains(&*format!("{code:?}"))
    }

    /// What follows `ErrorCode::`, and what is in quotation marks.
    fn add_named(&mut self, text: &'a str) {
        let after = text.split("ErrorCode::").skip(1);
        self.0.extend(after.filter_map(|rest| rest.split(|c: char| !c.is_ascii_alphanumeric()).next()));
        self.0.extend(text.split('"').skip(1).step_by(2).map(|quoted| quoted.trim_end_matches('\\')));
    }

    fn add_provoked(&mut self, tests: &'a str) {
        for arguments in assertions(tests) {
            self.add_named(arguments);
        }
        for (at, _) in tests.match_indices("for (") {
            let Some((variable, table, body)) = loop_over_table(&tests[at..]) else { continue };
            if assertions(body).any(|arguments| has_word(arguments, variable)) {
                for row in rows(table) {
                    self.add_named(row.rsplit_once(',').map_or(row, |(_, last)| last));
                }
            }
        }
    }
}

/// The arguments of every assertion.
fn assertions(text: &str) -> impl Iterator<Item = &str> {
    text.match_indices('(').filter_map(|(at, _)| {
        let before = text[..at].strip_suffix('!').unwrap_or(&text[..at]);
        let start = before.rfind(|c: char| !c.is_ascii_alphanumeric() && c != '_').map_or(0, |last| last + 1);
        let name = &before[start..];
        let asserts = name == "assert" || name.starts_with("assert_") || name == "refused";
        asserts.then(|| between(&text[at..])).flatten()
    })
}

/// Of `for (…, variable) in [table] {body}`.
fn loop_over_table(text: &str) -> Option<(&str, &str, &str)> {
    let after = text.strip_prefix("for ")?;
    let pattern = between(after)?;
    let table_at = after[pattern.len() + 2..].strip_prefix(" in ")?;
    let table_at = table_at.strip_prefix('&').unwrap_or(table_at);
    let table = between(table_at).filter(|_| table_at.starts_with('['))?;
    let body = between(table_at[table.len() + 2..].trim_start())?;
    let variable = pattern.trim_end_matches([' ', ',']).rsplit([',', ' ']).next()?;
    Some((variable, table, body))
}

/// The elements of a table, without the brackets of each.
fn rows(table: &str) -> Vec<&str> {
    let mut rows = Vec::new();
    let mut rest = table;
    while let Some(at) = rest.find('(') {
        let Some(row) = between(&rest[at..]) else { break };
        rows.push(row.trim().trim_end_matches(','));
        rest = &rest[at + row.len() + 2..];
    }
    rows
}

/// What is between the bracket that the text begins with and the one that belongs to it.
fn between(text: &str) -> Option<&str> {
    let bytes = text.as_bytes();
    let (mut depth, mut at) = (0_usize, 0);
    while at < bytes.len() {
        match bytes[at] {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' if depth == 1 => return text.get(1..at),
            b')' | b']' | b'}' => depth = depth.checked_sub(1)?,
            b'"' => {
                let raw = text[..at].ends_with("r#");
                let end = if raw { text[at + 1..].find("\"#")? } else { end_of_string(&bytes[at + 1..])? };
                at += 1 + end;
            }
            // A character such as '(' or '"'; a lifetime has no second quotation mark.
            b'\'' if bytes.get(at + 2) == Some(&b'\'') => at += 2,
            _ => {}
        }
        at += 1;
    }
    None
}

fn end_of_string(bytes: &[u8]) -> Option<usize> {
    let mut at = 0;
    while *bytes.get(at)? != b'"' {
        at += if bytes[at] == b'\\' { 2 } else { 1 };
    }
    Some(at)
}

fn has_word(text: &str, word: &str) -> bool {
    text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').any(|other| other == word)
}

fn sources(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            sources(&path, found);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
}

/// What of a source is the program, and what is test.
fn split(path: &Path) -> (String, String) {
    let text = fs::read_to_string(path).unwrap();
    let inside = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
    let has = |name: &str| inside.components().any(|part| part.as_os_str() == name);
    if has("pictures") || has("texts") || has("samples.rs") || has("every_error.rs") || has("error_code.rs") {
        return (String::new(), String::new());
    }
    if has("tests") || has("tests.rs") {
        return (String::new(), text);
    }
    let module = ["#[cfg(test)]\nmod tests {", "#[cfg(all(test, unix))]\nmod tests {"];
    match module.iter().find_map(|begin| text.find(begin)) {
        Some(at) => (text[..at].to_owned(), text[at..].to_owned()),
        None => (text, String::new()),
    }
}

#[test]
fn every_error_is_given_by_the_program_and_provoked_by_a_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    sources(&root.join("src"), &mut files);
    sources(&root.join("tests"), &mut files);
    let texts: Vec<(String, String)> = files.iter().map(|path| split(path)).collect();
    let (mut given, mut provoked) = (Found::default(), Found::default());
    for (program, tests) in &texts {
        given.add_named(program);
        provoked.add_provoked(tests);
    }
    let missing = |found: &Found<'_>| ErrorCode::ALL.iter().copied().filter(|code| !found.has(*code)).collect();
    let (not_given, not_provoked): (Vec<ErrorCode>, Vec<ErrorCode>) = (missing(&given), missing(&provoked));
    assert_eq!((not_given, not_provoked), (vec![], vec![]), "not given by the program; not provoked by a test");
}

#[test]
fn only_what_is_expected_of_the_program_is_provoked() {
    let provoked = |tests: &'static str| {
        let mut found = Found::default();
        found.add_provoked(tests);
        found.has(ErrorCode::BadPort)
    };
    for expects in [
        "assert_eq!(code(open()), ErrorCode::BadPort);",
        r#"assert!(shown.stdout.contains("bad-port"), "{}", shown.stdout);"#,
        r#"office.refused("sign", &[&short], 1, "bad-port");"#,
        r#"for (arguments, code) in [(&["--port", ")"], "bad-port")] { assert_eq!(run(arguments).code, code); }"#,
        "for (text, error) in [('(', ErrorCode::BadPort)] { let e = f(text); assert_eq!(e, error); }",
    ] {
        assert!(provoked(expects), "{expects}");
    }
    for makes_up in [
        "tell(window, Err(Problem::new(ErrorCode::BadPort))); assert!(shows(window));",
        "// assert that it is not ErrorCode::BadPort\nlet picker = FixedPicker(Err(ErrorCode::BadPort.into()));",
        r#"for code in ["refused", "bad-port"] { assert!(shown(code)); }"#,
        r#"for (code, name) in [(ErrorCode::BadPort, "x")] { assert_eq!(f(code), name); }"#,
        r#"for (name, code) in [("x", ErrorCode::BadPort)] { answer(code); assert!(shows(name)); }"#,
    ] {
        assert!(!provoked(makes_up), "{makes_up}");
    }
}
