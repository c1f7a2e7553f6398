//! Every error is reachable: each code of the registry is named by a test that provokes it.
//!
//! The sources are searched for it. Pictures do not count, as they are drawn from what a test made up, nor do the
//! registry and its own tests.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use opcua_configurator::model::ErrorCode;

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

/// What of a source is test: all of it, or what stands in its test module.
fn tests_of(path: &Path) -> String {
    let text = fs::read_to_string(path).unwrap();
    let name = path.file_name().unwrap().to_string_lossy().into_owned();
    let is_made_up = path.components().any(|part| part.as_os_str() == "pictures")
        || ["samples.rs", "every_error.rs"].contains(&&*name);
    let registry = ["problem.rs", "error_code.rs"].contains(&&*name);
    if is_made_up || registry {
        return String::new();
    }
    let inside = path.strip_prefix(env!("CARGO_MANIFEST_DIR")).unwrap();
    let all = name == "tests.rs" || inside.components().any(|part| part.as_os_str() == "tests");
    let module =
        ["#[cfg(test)]\nmod tests {", "#[cfg(all(test, unix))]\nmod tests {"].iter().find_map(|at| text.find(at));
    match module {
        _ if all => text,
        Some(at) => text[at..].to_owned(),
        None => String::new(),
    }
}

/// The identifiers that follow `ErrorCode::`, and the codes that stand in quotation marks.
fn named(text: &str) -> (BTreeSet<&str>, BTreeSet<&str>) {
    let after = text.split("ErrorCode::").skip(1);
    let variants = after.map(|rest| rest.split(|c: char| !c.is_ascii_alphanumeric()).next().unwrap_or_default());
    (variants.collect(), text.split('"').collect())
}

#[test]
fn every_error_is_provoked_by_a_test() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut files = Vec::new();
    sources(&root.join("src"), &mut files);
    sources(&root.join("tests"), &mut files);
    let tests: Vec<String> = files.iter().map(|path| tests_of(path)).collect();
    assert!(tests.iter().filter(|text| !text.is_empty()).count() > 50, "the sources are not where they should be");
    let (mut variants, mut quoted) = (BTreeSet::new(), BTreeSet::new());
    for text in &tests {
        let (more_variants, more_quoted) = named(text);
        variants.extend(more_variants);
        quoted.extend(more_quoted);
    }
    let is_named = |code: &ErrorCode| variants.contains(&*format!("{code:?}")) || quoted.contains(&*code.as_str());
    let missing: Vec<ErrorCode> = ErrorCode::ALL.iter().copied().filter(|code| !is_named(code)).collect();
    assert!(missing.is_empty(), "no test provokes {missing:?}, out of {} codes", ErrorCode::ALL.len());
}
