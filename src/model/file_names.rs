//! Names of files and folders that every system can have.

/// Whether Windows keeps this name of a file or folder for itself, or changes it: device names, with any extension, and
/// names that end with a dot or a blank. Refused on every system, so that a workspace can be moved to any other.
///
/// Source: "Naming Files, Paths, and Namespaces", Win32 documentation.
pub fn is_reserved(name: &str) -> bool {
    if name.ends_with(['.', ' ']) {
        return true;
    }
    let stem = name.split('.').next().unwrap_or_default().trim_end_matches(' ').to_ascii_uppercase();
    let numbered = |device: &str| {
        stem.strip_prefix(device).is_some_and(|number| {
            let mut characters = number.chars();
            matches!(characters.next(), Some('0'..='9' | '¹' | '²' | '³')) && characters.next().is_none()
        })
    };
    DEVICES.contains(&stem.as_str()) || numbered("COM") || numbered("LPT")
}

const DEVICES: [&str; 6] = ["CON", "PRN", "AUX", "NUL", "CONIN$", "CONOUT$"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_that_windows_does_not_have_are_known() {
        for reserved in ["CON", "con", "Nul.txt", "COM1", "lpt9.der", "COM²", "AUX .x", "name.", "name ", "CONIN$"] {
            assert!(is_reserved(reserved), "{reserved:?}");
        }
        for usual in ["", "CONTROL", "COM", "COM10", "LPT", "xCON", "a.CON", ".hidden", "NULL", "焊接", "R7A0010001"]
        {
            assert!(!is_reserved(usual), "{usual:?}");
        }
    }
}
