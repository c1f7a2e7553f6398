//! Writes the seeds of `corpus/`: small files of every kind the readers know. Keys are made anew and are used nowhere
//! else.

use std::fs;
use std::path::Path;
use std::process::Command;

use base64::Engine as _;
use chrono::{DateTime, Utc};
use opcua_configurator::model::{
    Base64Bytes, CertificateType, Changed, ClientList, ControllerSeries, CsrRequest, ErrorCode, FirmwareVersion,
    KeyLength, ListedCertificate, LogChunk, Problem, RevisionToken, Revisioned, SelfSignedRequest, ServerSettings,
    ServerStatus, StoredServerCertificate, StoredServerCertificates, Subject, TrustStep, Validity,
};
use opcua_configurator::pki::{Certificate, Csr, PrivateKey, ServerNames, make_csr, self_signed, tls_identity};
use opcua_configurator::protocol::{
    Activate, AddUser, CertificateInstalled, CsrMade, EditTrust, ExportContent, ExportSettings, ExportedUser,
    FailureBody, Hello, ImportCaSigned, ImportCertificate, ImportCsr, ImportSettings, Login, MakeCsr, MakeSelfSigned,
    RemoveUsers, SelectCertificate, SessionStarted, SetSettings, SettingsExport, WireSecret,
};
use opcua_configurator::recorder::{self, Entry, JournalWriter, RecordSettings, RecordingHeader, StopReason};
use opcua_configurator::records::force::{AllData, DataHead, ForceDataType, ForceFooter, ForceHeader, Header};
use opcua_configurator::records::motion::{Encoder, MotionBlock};
use opcua_configurator::records::{ControllerTime, Label, Ticks};
use opcua_configurator::virtual_controller::{
    ControllerIdentity, ControllerState, Faults, KeyPair, PendingCsr, SecretBytes, Store, TrustListCertificate,
    demo_keys, hash_connection_password,
};
use opcua_configurator::workspace::Workspace;
use serde::Serialize;

use crate::common::samples;
use crate::readers::PASSWORD;

/// Replaces every seed below the folder.
pub fn write(corpus: &Path) {
    let seeds = Seeds { corpus, made: Made::new() };
    for (name, _) in crate::readers::TARGETS {
        let _ = fs::remove_dir_all(corpus.join(name));
        fs::create_dir_all(corpus.join(name)).expect("a folder in the tree");
    }
    seeds.lists();
    seeds.names();
    seeds.configuration();
    seeds.certificates();
    seeds.keys();
    seeds.trust();
    seeds.messages();
    seeds.controller_state();
    seeds.records();
    seeds.recordings();
    seeds.remote();
    seeds.fins();
    seeds.practice();
    seeds.everything();
}

/// Targets, and files below `tests/cases`.
pub const PRACTICE: [(&str, &str); 22] = [
    ("activation_file", "03-csv/act-excel-comma.csv"),
    ("activation_file", "03-csv/act-quoted-fields-only.csv"),
    ("activation_file", "05-utf16/act-excel-unicode-text-tab-utf16.txt"),
    ("connection_list", "03-csv/con-columns-reordered.csv"),
    ("connection_list", "03-csv/con-sep.csv"),
    ("connection_list", "03-csv/con-urls.csv"),
    ("connection_list", "05-utf16/con-utf16.csv"),
    ("certificate", "05-utf16/utf16le-bom.pem"),
    ("certificate", "06-wrong-or-no-pem-label/bare-base64.cer"),
    ("certificate", "06-wrong-or-no-pem-label/trusted-certificate.pem"),
    ("certificate", "13-pem-readers/c-p7.pem"),
    ("certificate", "14-der-trailing/der-nul-padded.der"),
    ("certificate_request", "02-new-certificate-request/certreq-old-oid.csr"),
    ("certificate_request", "06-wrong-or-no-pem-label/certutil-encode.csr"),
    ("bundle", "06-wrong-or-no-pem-label/certutil-encode-crl.b64"),
    ("bundle", "08-pfx/p7b-ber.p7b"),
    ("bundle", "13-pem-readers/c-chain.pem"),
    ("pkcs12", "08-pfx/ber-inner.pfx"),
    ("pkcs12", "08-pfx/pbmac1-sha256.pfx"),
    ("pkcs12", "08-pfx/pbmac1-sha512-prf-sha1.pfx"),
    ("pkcs12", "08-pfx/rc2-128.pfx"),
    ("description", "08-pfx/p7b-ber.p7b"),
];

struct Seeds<'a> {
    corpus: &'a Path,
    made: Made,
}

/// What many seeds are made of.
struct Made {
    now: DateTime<Utc>,
    key: PrivateKey,
    certificate: Certificate,
    csr: Csr,
    subject: Subject,
}

impl Made {
    fn new() -> Self {
        let now = DateTime::from_timestamp(1_900_000_000, 0).expect("a time");
        let key_length = KeyLength::Rsa1024;
        let key = PrivateKey::generate(key_length).expect("a key");
        let subject = Subject {
            common_name: "EpsonRC.SN0000123.192.168.010.001".into(),
            country: "JP".into(),
            state: "Nagano".into(),
            locality: "Suwa".into(),
            organisation: "Example & Sons".into(),
        };
        let names = ServerNames {
            application_uri: "urn:EpsonRC:SN0000123".into(),
            ips: vec!["192.168.10.1".parse().expect("an address"), "fe80::1".parse().expect("an address")],
            dns: vec!["robot-7.plant.example".into()],
        };
        let validity = Validity::try_from(5).expect("years");
        let request = SelfSignedRequest { subject: subject.clone(), key_length, validity };
        let certificate = self_signed(&request, &names, &key, now).expect("a certificate");
        let csr = make_csr(&CsrRequest { subject: subject.clone(), key_length }, &names, &key).expect("a request");
        Self { now, key, certificate, csr, subject }
    }

    fn pkcs8(&self) -> Vec<u8> {
        self.key.to_pkcs8_der().expect("DER").to_vec()
    }
}

impl Seeds<'_> {
    fn seed(&self, target: &str, name: &str, bytes: impl AsRef<[u8]>) {
        fs::write(self.corpus.join(target).join(format!("seed-{name}")), bytes).expect("a file in the tree");
    }

    fn json(&self, target: &str, name: &str, message: &impl Serialize) {
        self.seed(target, name, serde_json::to_vec(message).expect("JSON"));
    }

    fn lists(&self) {
        let good = include_str!("../../fixtures/activation.csv");
        self.seed("activation_file", "good", good);
        self.seed("activation_file", "mistakes", include_str!("../../fixtures/activation-with-mistakes.csv"));
        let other = good.replace(',', " ; ").replace('\n', "\r\n");
        self.seed("activation_file", "other-spelling", format!("\u{feff}{other}"));
        let list = include_str!("../../fixtures/connections.csv");
        self.seed("connection_list", "good", list);
        self.seed("connection_list", "other-spelling", format!("\u{feff}{}", list.replace('\n', "\r\n\r\n")));
        let odd = "Name,Type,Address\n\"Cell, 9\",ethernet,\"[fe80::1]:8000\"\n,Ethernet,10.0.0.999\nx,Bluetooth\n\
                   \"two\nlines\",USB,\nCell 9,Ethernet,robot.plant.example:7943\n";
        self.seed("connection_list", "odd", odd);
    }

    /// One packet of every kind and DataType.
    fn records(&self) {
        let start = ControllerTime { year: 2026, month: 6, day: 1, hour: 8, minute: 30, ..ControllerTime::default() };
        let robot_name = Label::new("robot1");
        let sensor_label = Label::from_bytes(&[0x97, 0xcd, 0x8a, 0x6f]);
        let header = Header { id: 7, start, interval: 0.002, robot_name, sensor_label, ..Header::default() };
        self.seed("force_packet", "header-1", ForceHeader { header, record_start: None }.encode());
        self.seed("force_packet", "header-2", ForceHeader { header, record_start: Some(Ticks(80_000_000)) }.encode());
        for data_type in ForceDataType::ALL {
            let mut bytes = Vec::new();
            for count in 0..3 {
                let head = DataHead { version: 2, id: 7, count, elapsed: 2 * count, ..DataHead::default() };
                AllData { head, time: start, ..AllData::default() }.reduced(data_type).encode_into(&mut bytes);
            }
            self.seed("force_packet", &format!("data-{}", data_type.number()), bytes);
        }
        let footer = ForceFooter { version: 2, id: 7, end: start, robot_name, ..ForceFooter::default() };
        self.seed("force_packet", "footer", footer.encode());
        let mut bytes = Vec::new();
        let mut block = MotionBlock::default();
        for number in 1..3 {
            for (axis, encoders) in block.encoders.iter_mut().enumerate() {
                encoders[0] =
                    Encoder { timestamp: Ticks(number * 80_000), position: axis as i64 - 3, timer: 1, temperature: 40 };
            }
            block.force_sensor.axes.force = [1, -2, 131_071];
            block.tcp.components[0] = 250.5;
            block.encode_into(&mut bytes);
        }
        self.seed("motion_packet", "two-blocks", bytes);
    }

    /// Recordings of three records and of two blocks, in every kind of file.
    fn recordings(&self) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let read = |file: &Path| fs::read(file).expect("a file that was just made");
        let at = DateTime::from_timestamp(1_900_000_000, 0).expect("a time");
        let force = |data| vec![("force_packet", "header-2"), ("force_packet", data), ("force_packet", "footer")];
        for (kind, settings, packets) in [
            ("force", RecordSettings::force(3, 1, 0), force("data-3")),
            ("force-all", RecordSettings::force(0, 1, 0), force("data-0")),
            ("motion", RecordSettings::motion(0, 0), vec![("motion_packet", "two-blocks")]),
        ] {
            let header = RecordingHeader {
                controller: "Weld 1".into(),
                serial: "R7A0000001".into(),
                url: "opc.tcp://127.0.0.1:4840".into(),
                settings: settings.expect("settings in range"),
                started_at: at,
                format: "csv".into(),
                keep_packets: true,
            };
            let journal = folder.path().join(format!("{kind}.packets"));
            let mut writer = JournalWriter::create(&journal, &header).expect("a file of our own");
            for (target, name) in packets {
                let bytes = read(&self.corpus.join(target).join(format!("seed-{name}")));
                writer.append(at, &Entry::Packet { bytes, overwritten: kind == "motion" });
            }
            writer.append(at, &Entry::ConnectionLost("the connection was closed".into()));
            writer.append(at, &Entry::End(StopReason::Request));
            writer.sync().expect("a file of our own");
            self.seed("recording_packets", kind, read(&journal));
            let csv = journal.with_extension("csv");
            recorder::convert(&journal, &csv).expect("a recording");
            self.seed("recording_csv", kind, read(&csv));
            self.seed("recording_sidecar", kind, read(&recorder::sidecar_path(&csv)));
        }
    }

    /// The captured conversation of a robot with a PLC, commands and responses of every kind, addresses and a map.
    fn fins(&self) {
        for (name, frames) in [
            (
                "client",
                concat!(
                    "46494E530000000C000000000000000000000064",
                    "46494E530000001A000000020000000080000200 5A00006400000101 82012C000001",
                    "46494E530000001C000000020000000080000200 5A00006400000102 82012C0000010141",
                ),
            ),
            (
                "plc",
                concat!(
                    "46494E53000000100000000100000000000000640000005A",
                    "46494E530000001800000002000000 00C000020064 00005A0000 01010000007B",
                    "46494E530000000800000006 00000000 46494E53000000080000000300000001",
                ),
            ),
        ] {
            self.seed("fins_stream", name, bytes(frames));
        }
        for (name, message) in [
            ("write", "80000200 5A00006400000102 82012C0000010141"),
            ("read-multiple", "80000200 5A00006400000104 82012C0009000100 89800200"),
            ("status", "C000020064 00005A00000601 0000 0104 0000 0010 0000 00F7 4C4F5720564F4C54 4147452020202020"),
            ("clock", "C000020064 00005A00000701 0000 26112804510906"),
        ] {
            self.seed("fins_message", name, bytes(message));
        }
        for (name, text) in [
            ("range", "D300-304"),
            ("bits", "CIO0.04-0.11"),
            ("bank", "E18_5"),
            ("flag", "T5.F"),
            ("map", include_str!("../../fixtures/fins-bridge.toml")),
        ] {
            self.seed("fins_text", name, text);
        }
    }

    /// Files of other tools, which the tests read too.
    fn practice(&self) {
        let cases = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
        for (target, file) in PRACTICE {
            let name = file.rsplit('/').next().expect("a name");
            self.seed(target, &format!("practice-{name}"), fs::read(cases.join(file)).expect("a file in the tree"));
        }
    }

    /// Of requests the first byte is the size of the pieces they come in, of answers the number of the request.
    fn remote(&self) {
        let frames: [&[u8]; 7] = [
            b"\x04\x02Lsecret\x03\x59",
            b"\x02S\x03\x50",
            b"\x02W\x01\x01\x0f\x03\x5b",
            b"\x02vg_Status,\x03\x03\x56",
            b"\x02vg_int3Array,\0\x03,\0\x05,\0\0,\x03,\0\x0a\x03\x77",
            b"\x02Vg_Status,\0\0,\x03\x03\x5a",
            b"\x02X\"print here\"\x03\x10",
        ];
        let lines: [&[u8]; 4] = [
            b"$Login,secret\r\n$getstatus\r$SetIOWord,1,010F\n",
            b"$GetVariable,g_int3Array(3,5,0),Integer,10\r\n",
            b"$SetVariable,g_s$,a,b,String\r\n$Execute,\"print here\"\r\n",
            b"$GetErrMsg,1234,4\r\n$GetHealthRB,1,2,3\r\n",
        ];
        self.seed("remote_request", "frames", [b"\x40", frames.concat().as_slice()].concat());
        self.seed("remote_request", "frames-in-pieces", [b"\x01", frames.concat().as_slice()].concat());
        self.seed("remote_request", "lines", [b"\x05", lines.concat().as_slice()].concat());
        for (name, answer) in [
            ("status", &b"\x19\x06S\0\0\x01\0\0\0\0\0\0\0\x010000\x03\x50"[..]),
            ("status-line", b"\x19#GetStatus,00110000010,0517\r\n"),
            ("refusal", b"\x02\x15G11\x03\x44"),
            ("refusal-line", b"\x02!Start,20\r\n"),
            ("alarms", b"\x1c\x06z\x02\x01\x09\x03\x73"),
            ("result", b"\x1a\x06X\"2.5\"\x03\x72"),
            ("result-line", b"\x1a#Execute,\" X: -182.632\"\r\n"),
            ("integer", b"\x33\x06v\xff\xfe\x03\x74"),
            ("string-line", b"\x34#GetVariable,a,b\r\n"),
            ("doubles-line", b"\x35#GetVariable,1.5,-1E300,0\r\n"),
        ] {
            self.seed("remote_answer", name, answer);
        }
    }

    fn names(&self) {
        for (name, text) in [
            ("ipv4", "192.168.10.1:8000"),
            ("ipv6", "[fe80::1:0:2]:8000"),
            ("ipv6-bare", "2001:DB8::7"),
            ("host", "Robot-7.plant.example:7944"),
            ("name", " 焊接 Weld 1 "),
            ("serial", "R7A0000001"),
            ("series", "T/VT"),
            ("version", "7.5.54"),
            ("policy", "Aes128_Sha256_RsaOaep"),
            ("licence-key", "ab12-cd34-ef56-gh78"),
            ("activation-key", "AAAA-BBBB-CCCC-DDDD-EEEE-1111"),
            (
                "fingerprint",
                "E3:B0:C4:42:98:FC:1C:14:9A:FB:F4:C8:99:6F:B9:24:27:AE:41:E4:64:9B:93:4C:A4:95:99:1B:78:52:B8:55",
            ),
        ] {
            self.seed("names", name, text);
        }
    }

    fn configuration(&self) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let workspace = Workspace::new(folder.path());
        let mut configuration = samples::configuration(2, self.made.now);
        configuration.options.window.size = Some((1280.0, 720.0));
        configuration.options.window.columns.insert("name".into(), 80.5);
        configuration.options.window.sort = Some(("name".into(), true));
        workspace.save(&configuration, &workspace.lock().expect("a lock")).expect("a file");
        let json = fs::read(folder.path().join("epson_opcua_config.json")).expect("the file");
        self.seed("configuration", "full", json);
        self.seed("configuration", "least", br#"{"version":1}"#);
    }

    fn certificates(&self) {
        let Made { certificate, csr, now, .. } = &self.made;
        self.seed("certificate", "der", certificate.der());
        self.seed("certificate", "pem", certificate.to_pem());
        let tls = tls_identity("robot", *now).expect("an identity");
        self.seed("certificate", "elliptic", &tls.certificate_der);
        self.seed("certificate_request", "der", csr.der());
        self.seed("certificate_request", "pem", csr.to_pem());
    }

    /// Few rounds, so that a fuzzer gets somewhere.
    fn keys(&self) {
        let folder = tempfile::tempdir().expect("a temporary folder");
        let openssl = |arguments: &str| {
            let mut command = Command::new("openssl");
            command.current_dir(folder.path()).args(arguments.split(' '));
            let output = command.output().expect("OpenSSL is installed");
            assert!(output.status.success(), "{arguments}: {}", String::from_utf8_lossy(&output.stderr));
        };
        let seed = |target: &str, name: &str| {
            self.seed(target, name, fs::read(folder.path().join(name)).expect("what OpenSSL wrote"));
        };
        fs::write(folder.path().join("pkcs8.der"), self.made.pkcs8()).expect("a file");
        fs::write(folder.path().join("cert.pem"), self.made.certificate.to_pem()).expect("a file");
        openssl("pkey -inform DER -in pkcs8.der -out pkcs8.pem");
        openssl("pkey -inform DER -in pkcs8.der -traditional -out pkcs1.pem");
        openssl("rsa -inform DER -in pkcs8.der -traditional -outform DER -out pkcs1.der");
        let encrypt = |name: &str, form: &str, how: &str| {
            openssl(&format!("pkcs8 -topk8 -in pkcs8.pem -outform {form} -passout pass:{PASSWORD} -out {name} {how}"));
        };
        encrypt("aes.der", "DER", "-v2 aes-256-cbc -iter 4");
        encrypt("aes.pem", "PEM", "-v2 aes-128-cbc -v2prf hmacWithSHA1 -iter 4");
        encrypt("scrypt.der", "DER", "-scrypt -scrypt_N 16 -scrypt_r 1 -scrypt_p 1");
        encrypt("3des.der", "DER", "-v1 PBE-SHA1-3DES -iter 4");
        for name in ["pkcs8.der", "pkcs8.pem", "pkcs1.pem", "pkcs1.der", "aes.der", "aes.pem", "scrypt.der", "3des.der"]
        {
            seed("private_key", name);
        }
        let export = |name: &str, how: &str| {
            let common = format!("pkcs12 -export -inkey pkcs8.pem -in cert.pem -passout pass:{PASSWORD} -out {name}");
            openssl(&format!("{common} -name server -iter 4 {how}"));
            seed("pkcs12", name);
        };
        export("modern.p12", "-macalg sha256");
        export("no-mac.p12", "-nomac");
        export("legacy.p12", "-keypbe PBE-SHA1-3DES -certpbe PBE-SHA1-3DES -macalg sha1");
        for (name, key) in [("der", "pkcs8.der"), ("encrypted", "aes.pem")] {
            let key = fs::read(folder.path().join(key)).expect("a file");
            let length = u16::try_from(key.len()).expect("a small key").to_be_bytes();
            self.seed("key_and_certificate", name, [&length[..], &key, self.made.certificate.der()].concat());
        }
    }

    /// A root, an authority below it, whom that one lets in, and whom it does not any more.
    fn trust(&self) {
        let key = || PrivateKey::generate(KeyLength::Rsa2048).expect("a key");
        let (root, between) = (Authority::new("Root", key(), None), key());
        let between = Authority::new("Plant CA", between, Some(&root));
        let (client, revoked) = (between.client(&key(), 5), between.client(&key(), 6));
        let lists = [root.revocation_list(9), between.revocation_list(6)];
        let certificates = [&client[..], &between.der, &root.der];

        self.seed("revocation_list", "one-entry", &lists[1]);
        let both = [certificates.concat(), lists.concat()].concat();
        self.seed("bundle", "der", &both);
        let pem = |kind: &str, der: &[u8]| {
            let body = base64::engine::general_purpose::STANDARD.encode(der);
            let lines: Vec<&str> = (0..body.len()).step_by(64).map(|at| &body[at..body.len().min(at + 64)]).collect();
            format!("-----BEGIN {kind}-----\n{}\n-----END {kind}-----\n", lines.join("\n"))
        };
        self.seed("bundle", "pem", pem("CERTIFICATE", &root.der) + "between\n" + &pem("X509 CRL", &lists[0]));
        let folder = tempfile::tempdir().expect("a temporary folder");
        let text = pem("CERTIFICATE", &root.der) + &pem("CERTIFICATE", &client) + &pem("X509 CRL", &lists[0]);
        fs::write(folder.path().join("crl.pem"), pem("X509 CRL", &lists[0])).expect("a file");
        fs::write(folder.path().join("all.pem"), text).expect("a file");
        let mut command = Command::new("openssl");
        command.current_dir(folder.path()).args(["crl2pkcs7", "-in", "crl.pem", "-certfile", "all.pem"]);
        let output = command.args(["-outform", "DER"]).output().expect("OpenSSL is installed");
        assert!(output.status.success());
        self.seed("bundle", "p7b", output.stdout);

        for (name, bits) in [("root-trusted", [2, 1, 0, 0]), ("sent", [2, 0, 1, 0x40]), ("lax", [1, 0, 0, 0x3f])] {
            self.seed("trust", name, [&bits[..], &both].concat());
        }
        let of_revoked = [&revoked[..], &between.der, &root.der, &lists[0], &lists[1]].concat();
        self.seed("trust", "revoked", [&[2, 1, 0, 0][..], &of_revoked].concat());
        let alone = self.made.certificate.der();
        self.seed("trust", "self-signed", [&[1, 0, 0, 0x80][..], alone].concat());
    }

    fn messages(&self) {
        let Made { now, certificate, csr, subject, .. } = &self.made;
        let seed = |name: &str, json: String| self.seed("management_message", name, json);
        macro_rules! seeds { ($($name:literal: $message:expr),* $(,)?) => {
            $(seed($name, serde_json::to_string(&$message).expect("JSON"));)*
        } }
        let secret = || WireSecret("correct horse battery staple".into());
        let der = || Base64Bytes(certificate.der().to_vec());
        let (revision, kind, key_length) = (RevisionToken::new(7), CertificateType::CaSigned, KeyLength::Rsa2048);
        let changed = || Changed { revision, status: ServerStatus::Run };
        let keys = demo_keys(&"R7A0000001".parse().expect("a serial number"));
        let name = || "operator1".parse().expect("a name");
        let settings = ServerSettings::default;
        let validity = Validity::try_from(5).expect("years");
        let pkcs12 = || Base64Bytes(vec![0x30, 0x03, 0x02, 0x01, 0x03]);

        let user = ExportedUser { name: name(), password_hash: "$argon2id$v=19$m=19456,t=2,p=1$c2FsdA$aGFzaA".into() };
        let content = ExportContent { settings: settings(), users: vec![user], activation: Some(keys.clone()) };
        let of = ("R7A0000001".parse().expect("a serial number"), ControllerSeries::Rc700, version("7.5.54"));
        let export = SettingsExport::new(of, *now, &content, &PASSWORD.into()).expect("an export");
        self.seed("settings_export", "sealed", export.to_json());
        self.json("settings_export", "content", &content);

        let listed = ListedCertificate {
            file_name: "client.der".into(),
            certificate: der(),
            summary: certificate.summary(),
            added: *now,
        };
        let held = StoredServerCertificates {
            selected: kind,
            held: vec![StoredServerCertificate { kind, certificate: der() }],
            csr: Some(Base64Bytes(csr.der().to_vec())),
        };
        let failure: FailureBody = Problem::with_detail(ErrorCode::PortConflict, 4840).into();
        seeds! {
            "login": Login { password: secret() },
            "set-settings": SetSettings { revision, settings: settings(), delete_log: true, log_password: None },
            "add-user": AddUser { revision, name: name(), password: secret() },
            "remove-users": RemoveUsers { revision, names: vec![name()] },
            "make-self-signed": MakeSelfSigned {
                revision,
                request: SelfSignedRequest { subject: subject.clone(), key_length, validity },
            },
            "import-certificate": ImportCertificate { revision, kind, pkcs12: pkcs12(), password: secret() },
            "select-certificate": SelectCertificate { revision, kind },
            "make-csr": MakeCsr { revision, request: CsrRequest { subject: subject.clone(), key_length } },
            "import-csr": ImportCsr { revision, csr: der(), pkcs12: pkcs12(), password: secret(), certificate: None },
            "import-ca-signed": ImportCaSigned { revision, certificate: der() },
            "edit-trust": EditTrust {
                revision,
                steps: vec![
                    TrustStep::Add { list: ClientList::Trusted, certificates: vec![("client.der".into(), der())] },
                    TrustStep::Move {
                        from: ClientList::Trusted,
                        to: ClientList::Rejected,
                        thumbprints: vec![certificate.thumbprint_sha1()],
                    },
                    TrustStep::AddCrls { crls: vec![("ca.crl".into(), der())] },
                    TrustStep::RemoveCrls { ids: vec![certificate.thumbprint_sha1()] },
                ],
            },
            "activate": Activate { revision, licence: keys.licence, activation: keys.activation },
            "export-settings": ExportSettings { passphrase: secret() },
            "import-settings": ImportSettings { revision, export, passphrase: secret() },
            "session": SessionStarted { token: secret(), idle_secs: 300 },
            "hello": Hello { product: "opcua-controller-management".into(), versions: vec![1] },
            "installed": CertificateInstalled { changed: changed(), certificate: der() },
            "csr-made": CsrMade { changed: changed(), csr: Base64Bytes(csr.der().to_vec()) },
            "log": LogChunk { size: 90, from: 10, next: 90, text: "started\nstopped\n".into() },
            "info": samples::info(0, *now, ControllerSeries::Rc800),
            "settings": Revisioned { revision, value: settings() },
            "users": Revisioned { revision, value: vec![name()] },
            "held": Revisioned { revision, value: held },
            "listed": Revisioned { revision, value: vec![listed] },
            "failure": failure,
        }
    }

    /// One of every kind of file with keys and certificates.
    fn everything(&self) {
        for (target, name) in [
            ("certificate", "der"),
            ("certificate", "elliptic"),
            ("certificate_request", "pem"),
            ("private_key", "pkcs1.der"),
            ("private_key", "aes.pem"),
            ("pkcs12", "modern.p12"),
            ("bundle", "pem"),
            ("bundle", "p7b"),
        ] {
            let file = self.corpus.join(target).join(format!("seed-{name}"));
            self.seed("description", &format!("{target}-{name}"), fs::read(file).expect("a seed"));
        }
    }

    fn controller_state(&self) {
        let Made { now, certificate, csr, .. } = &self.made;
        let der = || Base64Bytes(certificate.der().to_vec());
        let serial = || "R7A0000001".parse().expect("a serial number");
        let identity = |series, firmware| ControllerIdentity {
            serial: serial(),
            series,
            firmware: version(firmware),
            name: "Weld 1".parse().expect("a name"),
        };
        let tls = tls_identity("robot", *now).expect("an identity");
        let pair = || KeyPair { certificate: der(), private_key: SecretBytes(self.made.pkcs8().into()) };
        let listed = || TrustListCertificate { file_name: "client.der".into(), certificate: der(), added: *now };
        let legacy = ControllerState {
            identity: identity(ControllerSeries::Rc700, "7.5.54"),
            management: KeyPair {
                certificate: Base64Bytes(tls.certificate_der.clone()),
                private_key: SecretBytes(tls.private_key_pkcs8.clone()),
            },
            connection_password_hash: hash_connection_password(&PASSWORD.into()).expect("a hash"),
            settings: ServerSettings::default(),
            users: Vec::new(),
            activated: true,
            activation_keys: Some(demo_keys(&serial())),
            certificates: [(CertificateType::UserSpecified, pair())].into(),
            csr: None,
            selected: CertificateType::UserSpecified,
            trusted: vec![listed()],
            issuers: Vec::new(),
            crls: Vec::new(),
            used_ports: vec![2001, 5000],
            revision: 7,
        };
        let current = ControllerState {
            identity: identity(ControllerSeries::Rc800, "8.0.1"),
            activation_keys: None,
            certificates: [(CertificateType::CaSigned, pair())].into(),
            csr: Some(PendingCsr {
                csr: Base64Bytes(csr.der().to_vec()),
                private_key: SecretBytes(self.made.pkcs8().into()),
            }),
            selected: CertificateType::CaSigned,
            issuers: vec![listed()],
            ..legacy.clone()
        };
        self.json("controller_state", "legacy", &legacy);
        self.json("controller_state", "current", &current);
        let folder = tempfile::tempdir().expect("a temporary folder");
        let store = Store::open(folder.path(), Faults::default()).expect("a folder");
        store.save(&current).expect("a file");
        self.seed("controller_state", "file", fs::read(folder.path().join("controller.state")).expect("the file"));
    }
}

/// Who signs for others.
struct Authority {
    der: Vec<u8>,
    issuer: rcgen::Issuer<'static, PrivateKey>,
}

impl Authority {
    fn new(name: &str, key: PrivateKey, above: Option<&Self>) -> Self {
        let mut params = rcgen::CertificateParams::default();
        params.distinguished_name = rcgen::DistinguishedName::new();
        params.distinguished_name.push(rcgen::DnType::CommonName, name);
        params.is_ca = rcgen::IsCa::Ca(rcgen::BasicConstraints::Unconstrained);
        params.key_usages = vec![rcgen::KeyUsagePurpose::KeyCertSign, rcgen::KeyUsagePurpose::CrlSign];
        params.use_authority_key_identifier_extension = true;
        let made = match above {
            Some(above) => params.signed_by(&key, &above.issuer),
            None => params.self_signed(&key),
        };
        let der = made.expect("a certificate").der().to_vec();
        Self { der, issuer: rcgen::Issuer::new(params, key) }
    }

    fn client(&self, key: &PrivateKey, serial: u64) -> Vec<u8> {
        use rcgen::KeyUsagePurpose::{ContentCommitment, DataEncipherment, DigitalSignature, KeyEncipherment};
        let mut params = rcgen::CertificateParams::default();
        params.distinguished_name.push(rcgen::DnType::CommonName, "client");
        params.serial_number = Some(serial.into());
        params.key_usages = vec![DigitalSignature, ContentCommitment, KeyEncipherment, DataEncipherment];
        params.extended_key_usages = vec![rcgen::ExtendedKeyUsagePurpose::ClientAuth];
        params.use_authority_key_identifier_extension = true;
        params.signed_by(key, &self.issuer).expect("a certificate").der().to_vec()
    }

    fn revocation_list(&self, serial: u64) -> Vec<u8> {
        let time = |seconds| time::OffsetDateTime::from_unix_timestamp(seconds).expect("a time");
        let revoked = rcgen::RevokedCertParams {
            serial_number: serial.into(),
            revocation_time: time(1_899_000_000),
            reason_code: Some(rcgen::RevocationReason::KeyCompromise),
            invalidity_date: None,
        };
        let params = rcgen::CertificateRevocationListParams {
            this_update: time(1_899_900_000),
            next_update: time(1_900_900_000),
            crl_number: 7_u64.into(),
            issuing_distribution_point: None,
            revoked_certs: vec![revoked],
            key_identifier_method: rcgen::KeyIdMethod::Sha256,
        };
        params.signed_by(&self.issuer).expect("a revocation list").der().to_vec()
    }
}

fn version(text: &str) -> FirmwareVersion {
    text.parse().expect("a version")
}

fn bytes(hexadecimal: &str) -> Vec<u8> {
    hex::decode(hexadecimal.replace(' ', "")).expect("hexadecimal digits")
}
