//! The structure of the source, read from its `use` lines: which module may use which, and that no files use each other
//! in a circle. Tests inside the source are left out.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// Each module of the crate and the modules that it may use.
const ALLOWED: &[(&str, &[&str])] = &[
    ("platform", &[]),
    ("licences", &[]),
    ("model", &[]),
    ("pki", &["model"]),
    ("records", &["model"]),
    ("protocol", &["model", "pki"]),
    ("remote", &["model", "pki"]),
    ("fins", &["model"]),
    ("workspace", &["model", "pki", "platform", "records", "protocol"]),
    ("session", &["model", "pki", "protocol", "remote", "workspace"]),
    ("recorder", &["platform", "model", "records", "workspace", "session"]),
    ("jobs", &["model", "pki", "remote", "fins", "workspace", "session", "recorder"]),
    ("texts", &["model", "pki", "remote", "fins", "workspace", "session", "recorder", "jobs"]),
    ("ui", &["licences", "platform", "model", "pki", "remote", "workspace", "session", "recorder", "jobs", "texts"]),
    ("virtual_controller", &["platform", "model", "pki", "records", "protocol", "remote"]),
    (
        "cli",
        &[
            "licences",
            "platform",
            "model",
            "pki",
            "remote",
            "fins",
            "workspace",
            "session",
            "recorder",
            "jobs",
            "texts",
            "ui",
            "virtual_controller",
        ],
    ),
];

/// Files that use each other because they are one concern in several files.
const ONE_CONCERN: &[&str] = &[
    // A path to a trusted root needs revocation lists, whose signers need a path.
    "pki::trust::chain, pki::trust::checks, pki::trust::lists, pki::trust::revocation",
    // The connection of a client, its secure channel and its sessions: each is closed through the others.
    "virtual_controller::opcua::admission::channel, virtual_controller::opcua::admission::client_to_server, \
     virtual_controller::opcua::admission::connections, virtual_controller::opcua::admission::gate, \
     virtual_controller::opcua::admission::inner_server, virtual_controller::opcua::admission::logins, \
     virtual_controller::opcua::admission::rewrap, virtual_controller::opcua::admission::sessions",
    // The files of the CA open it, and the CA writes them.
    "workspace::authority::files, workspace::authority::signing",
    // One kind of password store shows what it is made of, for the settings of the window.
    "workspace::password_store, workspace::passwords",
];

#[test]
fn a_module_uses_only_the_modules_below_it() {
    let allowed: BTreeMap<_, _> = ALLOWED.iter().copied().collect();
    let mut wrong = BTreeSet::new();
    let source = Source::read();
    let named = source.files.iter().flat_map(|(file, uses)| uses.iter().map(move |one| (file, &one.path)));
    for (file, used) in named {
        let (Some(from), Some(to)) = (file.first(), used.first()) else { continue };
        if let Some(may_use) = allowed.get(from.as_str())
            && from != to
            && !may_use.contains(&to.as_str())
        {
            wrong.insert(format!("{} uses {to}", file.join("::")));
        }
        assert!(allowed.contains_key(from.as_str()) || from == "main", "no rule for the module {from}");
    }
    assert_eq!(wrong, BTreeSet::new());
}

/// The files below `jobs` that make a [`Problem`] of an error: one for each module, at its edge. A [`Problem`] is what a
/// person or a peer is told; everything before that is a typed error with its source.
///
/// [`Problem`]: opcua_configurator::model::Problem
const MAKES_PROBLEMS: &[&str] = &[
    "fins::problem",
    "model",
    "model::capabilities",
    "pki::error",
    "pki::fingerprint",
    "protocol::messages",
    "protocol::settings_export",
    "recorder::problem",
    "remote::problem",
    "virtual_controller::api::failed",
    "workspace::problem",
];

/// The modules that run operations for a person or speak to a controller, and tell what comes of it as a `Problem`.
const TELLS_PROBLEMS: &[&str] = &["session", "jobs", "texts", "ui", "cli"];

#[test]
fn an_error_becomes_a_problem_once_at_the_edge_of_its_module() {
    let source = Source::read();
    let uses_it = |uses: &[Use]| uses.iter().any(|one| one.path.iter().any(|part| part == "Problem"));
    let files = source.files.iter().filter(|(_, uses)| uses_it(uses)).map(|(file, _)| file);
    let below = files.filter(|file| file.first().is_some_and(|module| !TELLS_PROBLEMS.contains(&module.as_str())));
    let making: Vec<String> = below.map(|file| file.join("::")).collect();
    assert_eq!(making, MAKES_PROBLEMS);
}

#[test]
fn no_files_use_each_other_in_a_circle() {
    let mut uses: BTreeMap<Module, BTreeSet<Module>> = BTreeMap::new();
    for (file, used) in Source::read().edges() {
        uses.entry(file).or_default().insert(used);
    }
    let reachable: BTreeMap<&Module, BTreeSet<&Module>> = uses.keys().map(|file| (file, reach(file, &uses))).collect();
    let circles: BTreeSet<String> = reachable
        .iter()
        .filter(|(file, reached)| reached.contains(**file))
        .map(|(file, reached)| {
            let circle = reached.iter().filter(|other| reachable.get(**other).is_some_and(|of| of.contains(*file)));
            circle.map(|file| file.join("::")).collect::<Vec<_>>().join(", ")
        })
        .collect();
    let known: BTreeSet<String> = ONE_CONCERN.iter().map(ToString::to_string).collect();
    assert_eq!(circles, known);
}

/// Every file that is used by a file, directly or through others.
fn reach<'a>(file: &Module, uses: &'a BTreeMap<Module, BTreeSet<Module>>) -> BTreeSet<&'a Module> {
    let mut reached = BTreeSet::new();
    let mut next: Vec<&Module> = uses.get(file).into_iter().flatten().collect();
    while let Some(file) = next.pop() {
        if reached.insert(file) {
            next.extend(uses.get(file).into_iter().flatten());
        }
    }
    reached
}

/// The path of a module below the crate.
type Module = Vec<String>;

/// Every file of `src`, and the names that its `use` lines bring in.
struct Source {
    files: BTreeMap<Module, Vec<Use>>,
}

struct Use {
    path: Module,
    is_public: bool,
}

impl Source {
    fn read() -> Self {
        let mut source = Self { files: BTreeMap::new() };
        source.folder(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"), &[]);
        assert!(source.files.len() > 300, "the source was not found");
        let modules: BTreeSet<Module> = source.files.keys().cloned().collect();
        for (module, uses) in &mut source.files {
            uses.retain_mut(|one| absolute(&mut one.path, module, &modules));
        }
        source
    }

    fn folder(&mut self, folder: &Path, module: &[String]) {
        for entry in std::fs::read_dir(folder).unwrap().map(Result::unwrap) {
            let path = entry.path();
            let name = path.file_stem().unwrap().to_str().unwrap().to_owned();
            if name == "tests" || name == "samples" {
                continue;
            }
            let inner = [module, std::slice::from_ref(&name)].concat();
            if path.is_dir() {
                self.folder(&path, &inner);
            } else if path.extension().is_some_and(|e| e == "rs") && name != "build" {
                let text = std::fs::read_to_string(&path).unwrap();
                let text = text.split("\nmod tests {").next().unwrap_or_default();
                let module = if matches!(name.as_str(), "mod" | "lib") { module.to_vec() } else { inner };
                self.files.insert(module, uses(text));
            }
        }
    }

    /// From each file to the files that define what it uses; a parent that only declares or re-exports its children does
    /// not use them.
    fn edges(&self) -> Vec<(Module, Module)> {
        let mut edges = Vec::new();
        for (file, uses) in &self.files {
            for one in uses {
                let used = self.defining_file(one.path.clone());
                let re_exports = one.is_public && used.starts_with(file);
                if used != *file && !used.is_empty() && !re_exports {
                    edges.push((file.clone(), used));
                }
            }
        }
        edges
    }

    /// Follows re-exports.
    fn defining_file(&self, mut path: Module) -> Module {
        for _ in 0..10 {
            let at = (0..=path.len()).rev().find(|at| self.files.contains_key(&path[..*at])).unwrap_or(0);
            let (file, rest) = path.split_at(at);
            let Some(name) = rest.first() else { return file.to_vec() };
            let uses = self.files.get(file).map(Vec::as_slice).unwrap_or_default();
            let from = uses.iter().find(|one| one.is_public && one.path.last() == Some(name) && one.path != path);
            match from {
                Some(one) => path = [&one.path[..], &rest[1..]].concat(),
                None => return file.to_vec(),
            }
        }
        path
    }
}

/// Makes a path absolute; `false` for one that leads out of the crate.
fn absolute(path: &mut Module, module: &[String], modules: &BTreeSet<Module>) -> bool {
    let supers = path.iter().take_while(|part| *part == "super").count();
    let child = [module, &path[..1]].concat();
    match path[0].as_str() {
        "crate" => drop(path.remove(0)),
        "self" => *path = [module, &path[1..]].concat(),
        "super" => *path = [&module[..module.len().saturating_sub(supers)], &path[supers..]].concat(),
        _ if modules.contains(&child) => *path = [module, &path[..]].concat(),
        _ => return false,
    }
    true
}

fn uses(text: &str) -> Vec<Use> {
    let mut found = Vec::new();
    let lines = text.lines().map(|line| line.split("//").next().unwrap_or_default());
    let text = lines.collect::<Vec<_>>().join("\n");
    for statement in text.split(';') {
        // A statement begins after what ended before it: an attribute, a block, a doc comment.
        let Some(line) = statement.rfind("use ").filter(|at| {
            let before = statement[..*at].rsplit('\n').next().unwrap_or_default().trim();
            before.is_empty() || before.starts_with("pub")
        }) else {
            continue;
        };
        let before = statement[..line].rsplit('\n').next().unwrap_or_default();
        expand(&statement[line + 4..], &[], &mut |path| {
            found.push(Use { path, is_public: before.trim().starts_with("pub") });
        });
    }
    found
}

/// Every path of a `use` tree, without what is renamed.
fn expand(tree: &str, before: &[String], found: &mut dyn FnMut(Module)) {
    let tree = tree.trim();
    let (prefix, group) = match tree.split_once('{') {
        Some((prefix, group)) => (prefix, group.trim_end().strip_suffix('}')),
        None => (tree.split(" as ").next().unwrap_or_default(), None),
    };
    let parts = prefix.split("::").map(str::trim).filter(|part| !part.is_empty()).map(str::to_owned);
    let path: Module = before.iter().cloned().chain(parts).collect();
    let Some(group) = group else {
        if !path.is_empty() {
            found(path);
        }
        return;
    };
    let (mut depth, mut start) = (0, 0);
    for (at, c) in group.char_indices().chain([(group.len(), ',')]) {
        match c {
            '{' => depth += 1,
            '}' => depth -= 1,
            ',' if depth == 0 => {
                if !group[start..at].trim().is_empty() {
                    expand(&group[start..at], &path, found);
                }
                start = at + 1;
            }
            _ => {}
        }
    }
}
