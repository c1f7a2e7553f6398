//! What holds for every value, and not only for the examples of the other tests: what is written is read back, what is
//! shown is understood, and mistakes are found in the line they stand in.

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::Path;

use chrono::{DateTime, Utc};
use opcua_configurator::model::activation::{self, ActivationKeys, FIRST_LINE};
use opcua_configurator::model::{
    Address, ConnectionKind, ControllerName, ControllerSeries, FirmwareVersion, Language, SecurityPolicy, SerialNumber,
    ServerPort, ServerSettings, StartupMode, UserTokenPolicy,
};
use opcua_configurator::pki::{Certificate, Fingerprint, PkiError, describe, read_bundle};
use opcua_configurator::protocol::{ExportContent, ExportError, ExportedUser, SettingsExport};
use opcua_configurator::workspace::{
    Configuration, ConnectionList, ControllerEntry, Options, PasswordPlace, ThemeChoice, WindowState, Workspace,
};
use proptest::prelude::*;

use crate::readers;

/// The same cases every time, and no file of those that failed: a failure prints its input.
fn cases(count: u32) -> ProptestConfig {
    ProptestConfig {
        cases: count,
        failure_persistence: None,
        rng_seed: proptest::test_runner::RngSeed::Fixed(1),
        ..ProptestConfig::default()
    }
}

fn parsed<T: std::str::FromStr<Err: std::fmt::Debug>>(text: String) -> T {
    text.parse().unwrap_or_else(|error| panic!("{text:?}: {error:?}"))
}

fn serial() -> impl Strategy<Value = SerialNumber> {
    "[A-Za-z0-9_-]{1,32}".prop_map(parsed)
}

fn name() -> impl Strategy<Value = ControllerName> {
    // Not a blank at either end, and no control character; otherwise anything.
    "[^\\p{C}\\p{Z}]([^\\p{C}]{0,30}[^\\p{C}\\p{Z}])?".prop_map(parsed)
}

fn host() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<std::net::Ipv4Addr>().prop_map(|ip| ip.to_string()),
        any::<std::net::Ipv6Addr>().prop_map(|ip| format!("[{ip}]")),
        // A last label of digits only would be a mistyped IPv4 address.
        "([a-z0-9]([a-z0-9_-]{0,20}[a-z0-9])?\\.){0,3}[a-z]([a-z0-9_-]{0,20}[a-z0-9])?",
    ]
}

fn address() -> impl Strategy<Value = Address> {
    (host(), 1_u16..).prop_map(|(host, port)| parsed(format!("{host}:{port}")))
}

fn firmware() -> impl Strategy<Value = FirmwareVersion> {
    any::<(u16, u16, u16)>().prop_map(|(major, minor, patch)| FirmwareVersion::new(major, minor, patch))
}

fn keys() -> impl Strategy<Value = ActivationKeys> {
    ("[a-zA-Z0-9]{16}", "[a-zA-Z0-9]{24}")
        .prop_map(|(licence, activation)| ActivationKeys { licence: parsed(licence), activation: parsed(activation) })
}

fn settings() -> impl Strategy<Value = ServerSettings> {
    let some = |all: &'static [SecurityPolicy]| prop::sample::subsequence(all, 1..=all.len());
    let port = (ServerPort::MIN..).prop_map(|port| ServerPort::try_from(port).expect("a port"));
    let startup = prop::sample::select(&StartupMode::ALL[..]);
    let tokens = prop::sample::subsequence(&UserTokenPolicy::ALL[..], 1..=2);
    (port, startup, some(&SecurityPolicy::ALL), tokens, any::<bool>()).prop_map(
        |(port, startup, policies, tokens, server_log)| ServerSettings {
            port,
            startup,
            security_policies: BTreeSet::from_iter(policies),
            user_tokens: BTreeSet::from_iter(tokens),
            server_log,
        },
    )
}

/// Also what is no number, and what no screen has.
fn points() -> impl Strategy<Value = f32> {
    prop_oneof![1.0_f32..8000.0, prop::num::f32::ANY]
}

/// To the second, within the years that have four digits.
fn time() -> impl Strategy<Value = DateTime<Utc>> {
    (0_i64..253_402_300_799).prop_map(|seconds| DateTime::from_timestamp(seconds, 0).expect("a time"))
}

proptest! {
    #![proptest_config(cases(300))]

    #[test]
    fn an_address_is_shown_as_it_is_read((host, port) in (host(), 1_u16..)) {
        let address: Address = parsed(format!("{host}:{port}"));
        prop_assert_eq!(address.port(), port);
        prop_assert_eq!(address.host(), host.trim_matches(['[', ']']));
        prop_assert_eq!(address.to_string().parse(), Ok(address.clone()));
        prop_assert_eq!(address.authority().parse(), Ok(address));
    }

    #[test]
    fn every_spelling_of_an_ip_address_is_the_same_address(ip: std::net::Ipv6Addr) {
        let groups = ip.segments();
        let long = groups.map(|group| format!("{group:04X}")).join(":");
        let short = groups.map(|group| format!("{group:x}")).join(":");
        let usual: Address = parsed(format!("[{ip}]:8000"));
        prop_assert_eq!(parsed::<Address>(format!("[{long}]:8000")), usual.clone());
        prop_assert_eq!(parsed::<Address>(format!("[{short}]:8000")), usual);
    }

    #[test]
    fn versions_are_ordered_by_their_numbers(one: (u16, u16, u16), other: (u16, u16, u16)) {
        let version = |(major, minor, patch)| parsed::<FirmwareVersion>(format!("{major}.{minor}.{patch}"));
        prop_assert_eq!(version(one).cmp(&version(other)), one.cmp(&other));
    }

    #[test]
    fn a_text_becomes_a_name_or_a_mistake_and_nothing_else(
        text in prop_oneof![
            any::<String>(),
            "[0-9a-fA-F:.\\[\\]%]{0,45}",
            "[ -~]{0,70}",
            "[0-9]{0,6}\\.[0-9+]{0,6}\\.[0-9]{0,6}",
            "[0-9A-Fa-f: ]{62,70}",
        ],
    ) {
        readers::names(text.as_bytes());
    }

    #[test]
    fn a_secret_is_shown_by_nothing_that_tells_a_mistake(keys in keys(), damage in 0_usize..24) {
        let mut activation = keys.activation.to_string().replace('-', "");
        activation.replace_range(damage..=damage, "!");
        let text = format!("{FIRST_LINE}\nR7A0000001,{},{activation}\n", keys.licence);
        let file = activation::parse(text.as_bytes()).expect("a file");
        let shown = format!("{} {file:?}", file.mistakes()[0]);
        prop_assert!(!shown.contains(&activation[..damage.max(1)]) || damage < 4, "{}", shown);
        prop_assert!(!shown.contains(&keys.licence.to_string()));
    }
}

/// One line of an activation file.
#[derive(Debug, Clone)]
enum Line {
    Good(SerialNumber, ActivationKeys, String),
    Blank(String),
    Mistake(String),
}

fn line() -> impl Strategy<Value = Line> {
    prop_oneof![
        4 => (serial(), keys(), "[ \t]{0,3}").prop_map(|(serial, keys, blank)| Line::Good(serial, keys, blank)),
        1 => "[ \t]{0,3}".prop_map(Line::Blank),
        1 => "[a-z]{1,8}( [a-z]{1,8}){0,3}".prop_map(Line::Mistake),
    ]
}

/// One line of a connection list.
#[derive(Debug, Clone)]
enum Entry {
    Fields(String, String, String),
    Blank,
}

fn entry() -> impl Strategy<Value = Entry> {
    let kind = prop::sample::select(vec!["Ethernet", "USB", "Virtual", "Carrier pigeon"]).prop_map(str::to_owned);
    // Quotes, separators and line ends within a field.
    let text = || "[^\\p{C} \u{85}\u{a0}][a-z,;\" \n]{0,12}[a-z\"]";
    prop_oneof![
        4 => (text(), kind, text()).prop_map(|(name, kind, address)| Entry::Fields(name, kind, address)),
        1 => Just(Entry::Blank),
    ]
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn an_activation_file_gives_each_controller_the_keys_of_its_line(
        lines in prop::collection::vec(line(), 0..20),
        separator in prop::sample::select(vec![",", ";", "\t"]),
        end in prop::sample::select(vec!["\n", "\r\n", "\r"]),
        bom in any::<bool>(),
        quoted in any::<bool>(),
        empty_fields in 0_usize..3,
    ) {
        // As a spreadsheet pads its rows.
        let end = &(separator.repeat(empty_fields) + end);
        let mut text = format!("{}{FIRST_LINE}{end}", if bom { "\u{feff}" } else { "" });
        let (mut good, mut mistakes) = (BTreeMap::<_, Vec<_>>::new(), Vec::new());
        for (number, line) in (2..).zip(&lines) {
            text += &match line {
                Line::Good(serial, keys, blank) => {
                    good.entry(serial.clone()).or_default().push((number, keys.clone()));
                    let fields = [serial.to_string(), keys.licence.to_string(), keys.activation.to_string()];
                    let fields = fields.map(|field| if quoted { format!("\"{field}\"") } else { field });
                    let blank = if quoted || separator == "\t" { "" } else { blank };
                    format!("{blank}{}{blank}{end}", fields.join(&format!("{blank}{separator}{blank}")))
                }
                Line::Blank(blank) => format!("{blank}{end}"),
                Line::Mistake(text) => {
                    mistakes.push(number);
                    format!("{text}{end}")
                }
            };
        }
        let file = activation::parse(text.as_bytes()).expect("a file");
        let wide: Vec<u8> = format!("\u{feff}{text}").encode_utf16().flat_map(u16::to_le_bytes).collect();
        if !bom {
            let read = activation::parse(&wide);
            prop_assert_eq!(read.as_ref(), Ok(&file));
        }
        let mut expected: Vec<_> = Vec::new();
        for (serial, places) in good {
            match places.as_slice() {
                [(number, keys)] => expected.push((*number, serial, keys.clone())),
                // Which of several lines is meant is not known.
                several => mistakes.extend(several.iter().map(|(number, _)| *number)),
            }
        }
        expected.sort_by_key(|(number, ..)| *number);
        mistakes.sort_unstable();
        let found: Vec<_> = file.lines().iter().map(|l| (l.line, l.serial.clone(), l.keys.clone())).collect();
        prop_assert_eq!(found, expected);
        prop_assert_eq!(file.mistakes().iter().map(|m| m.line).collect::<Vec<_>>(), mistakes);
        readers::activation_file(text.as_bytes());
    }

    #[test]
    fn a_connection_list_is_read_as_it_was_written_and_numbered_by_its_lines(
        entries in prop::collection::vec(entry(), 0..20),
        end in prop::sample::select(vec!["\n", "\r\n"]),
    ) {
        let quoted = |field: &str| format!("\"{}\"", field.replace('"', "\"\""));
        let mut text = format!("Name,Type,Address{end}");
        let mut expected = Vec::new();
        for entry in &entries {
            let line = text.matches('\n').count() + 1;
            if let Entry::Fields(name, kind, address) = entry {
                expected.push((line, name.trim().to_owned(), address.trim().to_owned()));
                text += &[quoted(name), quoted(kind), quoted(address)].join(",");
            }
            text += end;
        }
        let list = ConnectionList::parse(text.as_bytes()).expect("a list");
        let plan = list.plan(&Configuration::default());
        let found: Vec<_> = plan.into_iter().map(|p| (p.line, p.name, p.address)).collect();
        prop_assert_eq!(found, expected);
        readers::connection_list(text.as_bytes());
    }

}

proptest! {
    // Every file is flushed to the disk.
    #![proptest_config(cases(40))]

    #[test]
    fn what_is_saved_of_a_configuration_is_loaded(
        entries in prop::collection::vec(
            (name(), address(), prop::sample::select(&ControllerSeries::ALL[..]), any::<Option<[u8; 4]>>()),
            0..8,
        ),
        backup: bool,
        parallelism in 1_usize..=64,
        size in prop::option::of((points(), points())),
        columns in prop::collection::btree_map("[a-z]{1,8}", points(), 0..4),
        column_order in prop::collection::vec("[a-z]{1,8}", 0..12),
        (details, details_width) in (any::<bool>(), prop::option::of(points())),
        (chinese, verify_after_changes, vault) in any::<(bool, bool, bool)>(),
    ) {
        let mut configuration = Configuration::default();
        configuration.controllers = entries
            .into_iter()
            .map(|(name, address, series, bytes)| {
                let fingerprint = bytes.map(|bytes| Fingerprint::of(&bytes));
                ControllerEntry { name, address, series, connection: ConnectionKind::Management, fingerprint, last: None }
            })
            .collect();
        configuration.options = Options {
            backup,
            verify_after_changes,
            parallelism,
            passwords: if vault { PasswordPlace::Vault } else { PasswordPlace::Keyring },
            language: chinese.then_some(Language::Zh),
            theme: ThemeChoice::Dark,
            window: WindowState { size, columns, column_order, details, details_width, sort: None },
        };
        let folder = tempfile::tempdir().expect("a temporary folder");
        let workspace = Workspace::new(folder.path());
        workspace.save(&configuration, &workspace.lock().expect("a lock")).expect("a file");
        let loaded = workspace.load().expect("the file");
        prop_assert!(loaded.damaged.is_none());
        // What no screen has was not measured on one.
        let is_length = |points: f32| (0.0..=32_768.0).contains(&points);
        let window = &mut configuration.options.window;
        window.details_width = window.details_width.filter(|width| is_length(*width));
        window.size = window.size.filter(|(width, height)| is_length(*width) && is_length(*height));
        window.columns.retain(|_, width| is_length(*width));
        prop_assert_eq!(loaded.configuration, configuration);
    }
}

fn seed(name: &str) -> Vec<u8> {
    let corpus = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus");
    fs::read(corpus.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn text_around_a_certificate_does_not_matter(before in "([ -,.-~]{0,40}\n){0,4}", after in "([ -,.-~]{0,40}\n){0,4}") {
        let certificate = Certificate::from_any(&seed("certificate/seed-der")).expect("a certificate");
        let text = format!("{before}{}{after}", certificate.to_pem());
        for text in [text.clone(), text.replace('\n', "\r"), text.replace('\n', "\n   ")] {
            prop_assert_eq!(Certificate::from_any(text.as_bytes()), Ok(certificate.clone()));
            prop_assert_eq!(&read_bundle(text.as_bytes()).expect("a bundle").certificates, std::slice::from_ref(&certificate));
        }
    }

    #[test]
    fn a_bundle_is_read_in_its_order_whatever_it_is_made_of(order in prop::collection::vec(0_usize..3, 1..12), pem: bool) {
        let all = read_bundle(&seed("bundle/seed-der")).expect("a bundle").certificates;
        let chosen: Vec<Certificate> = order.iter().map(|index| all[*index].clone()).collect();
        let bytes = match pem {
            true => chosen.iter().map(Certificate::to_pem).collect::<String>().into_bytes(),
            false => chosen.iter().flat_map(Certificate::der).copied().collect(),
        };
        let mut once: Vec<Certificate> = Vec::new();
        for certificate in chosen {
            if !once.contains(&certificate) {
                once.push(certificate);
            }
        }
        prop_assert_eq!(read_bundle(&bytes).expect("a bundle").certificates, once);
    }
}

#[test]
fn a_file_cannot_keep_whoever_describes_it_busy_for_hours() {
    let described = |file: &str, times| {
        let text = seed(file).repeat(times);
        describe(&text, Some(readers::PASSWORD)).map(|things| things.len())
    };
    assert_eq!(described("certificate/seed-pem", 1001), Err(PkiError::TooMany(1000)));
    assert_eq!(described("private_key/seed-aes.pem", 16), Ok(16));
    assert_eq!(described("private_key/seed-aes.pem", 17), Err(PkiError::TooMany(16)));
}

proptest! {
    // Every passphrase is hashed, which is slow on purpose.
    #![proptest_config(cases(12))]

    #[test]
    fn only_the_passphrase_opens_what_was_sealed(
        (serial, series, version) in (serial(), prop::sample::select(&ControllerSeries::ALL[..]), firmware()),
        exported in time(),
        settings in settings(),
        users in prop::collection::vec(("[A-Za-z0-9]{8,32}", "[ -~]{0,90}"), 0..4),
        activation in prop::option::of(keys()),
        (passphrase, other) in ("\\PC{0,20}", "\\PC{0,20}"),
    ) {
        let user = |(name, password_hash)| ExportedUser { name: parsed(name), password_hash };
        let content = ExportContent { settings, users: users.into_iter().map(user).collect(), activation };
        let of = (serial.clone(), series, version);
        let export = SettingsExport::new(of, exported, &content, &passphrase.clone().into()).expect("an export");
        let read = SettingsExport::from_json(&export.to_json());
        prop_assert_eq!(read.as_ref(), Ok(&export));
        prop_assert_eq!(export.check_for(&serial, series, version), Ok(()));
        prop_assert_eq!(export.open(&passphrase.clone().into()), Ok(content));
        if other != passphrase {
            prop_assert_eq!(export.open(&other.into()), Err(ExportError::WrongPassphrase));
        }
        readers::settings_export(&export.to_json());
    }
}
