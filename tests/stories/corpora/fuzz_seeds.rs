//! The readers of bytes from outside, fed with the fuzzer's seeds and with damaged copies of them: what a fuzzer does
//! for hours, in seconds, with the stable compiler and the same result every time.

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use crate::make_seeds;
use crate::readers;

/// Damaged copies of each seed, unless `FUZZ_COPIES` says how many.
const COPIES: usize = 200;
/// For one input, in a build that is not optimised, on a busy machine. What it is about is minutes.
const SLOW: Duration = Duration::from_secs(20);

fn corpus() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/fuzz/corpus")
}

fn seeds(folder: &Path) -> Vec<(String, Vec<u8>)> {
    let mut seeds: Vec<_> = fs::read_dir(folder)
        .unwrap_or_else(|error| panic!("{}: {error}", folder.display()))
        .map(|entry| entry.expect("a folder that can be read"))
        .map(|entry| (entry.file_name().into_string().expect("a plain name"), entry.path()))
        // The others are what a fuzzer found on this computer.
        .filter(|(name, _)| name.starts_with("seed-"))
        .map(|(name, path)| (name, fs::read(path).expect("a file that can be read")))
        .collect();
    seeds.sort();
    seeds
}

#[test]
fn no_reader_breaks_its_promise_on_a_seed_or_a_damaged_copy() {
    let copies = std::env::var("FUZZ_COPIES").map_or(COPIES, |copies| copies.parse().expect("a number"));
    let check = |(name, reader): &(&str, readers::Target)| {
        let begun = Instant::now();
        let seeds = seeds(&corpus().join(name));
        assert!(!seeds.is_empty(), "{name} has no seeds");
        for (number, (seed, bytes)) in seeds.iter().enumerate() {
            let mut damage = Damage(0x9e37_79b9_7f4a_7c15 ^ number as u64);
            let damaged = (0..copies).map(|_| damage.of(bytes, &seeds));
            for (copy, input) in std::iter::once(bytes.clone()).chain(damaged).enumerate() {
                let begun = Instant::now();
                let kept = catch_unwind(AssertUnwindSafe(|| reader(&input)));
                if kept.is_err() || begun.elapsed() > SLOW {
                    let path = std::env::temp_dir().join(format!("{name}-{seed}-{copy}"));
                    fs::write(&path, &input).expect("a temporary file");
                    let took = begun.elapsed();
                    panic!("{name}, {seed}, copy {copy}: see above; took {took:?}; input kept as {}", path.display());
                }
            }
        }
        println!("{name}: {} inputs in {:.1} s", seeds.len() * (copies + 1), begun.elapsed().as_secs_f64());
    };
    std::thread::scope(|scope| {
        let halves = readers::TARGETS.split_at(readers::TARGETS.len() / 2);
        let other = scope.spawn(move || halves.0.iter().for_each(check));
        halves.1.iter().for_each(check);
        other.join().expect("the first half");
    });
}

#[test]
fn every_reader_has_its_fuzz_target() {
    let of = |folder: &str| {
        let mut names: Vec<String> = fs::read_dir(corpus().join("..").join(folder))
            .expect("a folder that can be read")
            .map(|entry| entry.expect("a folder that can be read").path())
            .map(|path| path.file_stem().expect("a name").to_str().expect("a plain name").to_owned())
            .collect();
        names.sort();
        names
    };
    let names: Vec<&str> = readers::TARGETS.iter().map(|(name, _)| *name).collect();
    assert_eq!(of("fuzz_targets"), names);
    assert_eq!(of("corpus"), names);
}

/// The seeds are real files: the readers understand them. Otherwise their damaged copies would show nothing.
#[test]
fn the_seeds_are_what_the_readers_read() {
    for (file, bytes) in seeds(&corpus().join("certificate")) {
        assert!(opcua_configurator::pki::Certificate::from_any(&bytes).is_ok(), "{file}");
    }
    for (file, bytes) in seeds(&corpus().join("private_key")) {
        assert!(opcua_configurator::pki::read_key_file(&bytes, Some(readers::PASSWORD)).is_ok(), "{file}");
    }
    for (file, bytes) in seeds(&corpus().join("pkcs12")) {
        assert!(opcua_configurator::pki::pkcs12_read(&bytes, readers::PASSWORD).is_ok(), "{file}");
    }
    for (file, bytes) in seeds(&corpus().join("bundle")) {
        assert!(opcua_configurator::pki::read_bundle(&bytes).is_ok(), "{file}");
    }
    for (file, bytes) in seeds(&corpus().join("certificate_request")) {
        assert!(opcua_configurator::pki::Csr::from_any(&bytes).is_ok(), "{file}");
    }
}

/// Makes the seeds anew, with new keys; needs OpenSSL 3.
#[test]
#[ignore = "writes into the tree"]
fn make_the_seeds() {
    make_seeds::write(&corpus());
}

/// Damages bytes in the ways a fuzzer does, always the same ones (xorshift64*).
struct Damage(u64);

impl Damage {
    fn below(&mut self, bound: usize) -> usize {
        self.0 ^= self.0 >> 12;
        self.0 ^= self.0 << 25;
        self.0 ^= self.0 >> 27;
        (self.0.wrapping_mul(0x2545_f491_4f6c_dd1d) >> 33) as usize % bound.max(1)
    }

    fn of(&mut self, bytes: &[u8], others: &[(String, Vec<u8>)]) -> Vec<u8> {
        const WORDS: [&[u8]; 14] = [
            b"\0",
            b"\xff",
            b"\n",
            b"\r\n",
            b"\"",
            b",",
            b";",
            b":",
            b"\x30\x80",
            b"\x30\x82",
            b"null",
            b"-1",
            b"18446744073709551616",
            b"-----BEGIN ",
        ];
        let mut bytes = bytes.to_vec();
        for _ in 0..=self.below(4) {
            let at = self.below(bytes.len() + 1);
            let end = (at + self.below(32)).min(bytes.len());
            match self.below(8) {
                0 | 1 if at < bytes.len() => bytes[at] ^= 1 << self.below(8),
                2 if at < bytes.len() => bytes[at] = [0, 1, 0x7f, 0x80, 0xff, b' ', b'0', b'-'][self.below(8)],
                3 => bytes.truncate(at),
                4 => drop(bytes.drain(at..end)),
                5 => {
                    let part = bytes[at..end].to_vec();
                    let to = self.below(bytes.len() + 1);
                    bytes.splice(to..to, part);
                }
                6 => {
                    let word = WORDS[self.below(WORDS.len())];
                    bytes.splice(at..at, word.iter().copied());
                }
                _ => {
                    let (_, other) = &others[self.below(others.len())];
                    let tail = other[self.below(other.len() + 1)..].to_vec();
                    bytes.splice(at..end, tail.into_iter().take(64));
                }
            }
        }
        bytes
    }
}
