//! This computer's clock.

use std::time::SystemTime;

use chrono::{DateTime, Utc};

/// The time by this computer's clock. To be used instead of `chrono::Utc::now`, which panics where the clock stands
/// before 1970, as that of a PC with an empty battery may.
pub fn now() -> DateTime<Utc> {
    SystemTime::now().into()
}

#[cfg(test)]
mod tests {
    use std::fs;
    use std::path::Path;
    use std::time::{Duration, UNIX_EPOCH};

    use super::*;

    #[test]
    fn a_clock_may_stand_before_1970() {
        let at: DateTime<Utc> = (UNIX_EPOCH - Duration::from_secs(86_400)).into();
        assert_eq!(at.to_rfc3339(), "1969-12-31T00:00:00+00:00");
    }

    /// Other ways to the time panic before 1970.
    #[test]
    fn the_program_reads_the_time_here_only() {
        let mut folders = vec![Path::new(env!("CARGO_MANIFEST_DIR")).join("src")];
        let mut read = 0;
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder).unwrap() {
                let path = entry.unwrap().path();
                if path.is_dir() && !path.ends_with("tests") {
                    folders.push(path);
                } else if path.extension().is_some_and(|extension| extension == "rs") && !path.ends_with("tests.rs") {
                    let text = fs::read_to_string(&path).unwrap();
                    let code = text.split("#[cfg(test)]\nmod tests {").next().unwrap();
                    for other in ["Utc::now", "Local::now", "OffsetDateTime::now", "UnixTime::now"] {
                        let used =
                            code.lines().any(|line| line.contains(other) && !line.trim_start().starts_with("//"));
                        assert!(!used, "{} uses {other}", path.display());
                    }
                    read += 1;
                }
            }
        }
        assert!(read > 100, "{read}");
    }
}
