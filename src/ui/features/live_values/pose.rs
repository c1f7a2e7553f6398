/// X, Y, Z in mm and U, V, W in degrees of a position as the controller writes it: `{"X":0.0, "Y":0.0, …}`
/// (manual 3.2.3.8). A stray full stop after a number, as the manual prints one, is passed over. `None` if a number is
/// missing.
pub fn pose(text: &str) -> Option<[f64; 6]> {
    let mut pose = [0.0; 6];
    for (name, value) in NAMES.iter().zip(&mut pose) {
        let (_, after) = text.split_once(&format!("\"{name}\""))?;
        let after = after.trim_start().strip_prefix(':')?.trim_start();
        let is_part = |char: char| char.is_ascii_digit() || matches!(char, '-' | '+' | '.' | 'e' | 'E');
        let number = &after[..after.find(|char| !is_part(char)).unwrap_or(after.len())];
        *value = number.trim_end_matches('.').parse().ok()?;
    }
    Some(pose)
}

/// The names of the coordinates, in their order.
pub const NAMES: [&str; 6] = ["X", "Y", "Z", "U", "V", "W"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_printed_forms_are_read() {
        let older = r#"{ "X":1.5, "Y":-2.0, "Z":0.0., "U":0.0, "V":90.0, "W":-180.0 }"#;
        let newer = r#"{"X":1.5, "Y":-2.0, "Z":0.0, "U":0.0, "V":90.0, "W":-180.0}"#;
        for text in [older, newer] {
            assert_eq!(pose(text), Some([1.5, -2.0, 0.0, 0.0, 90.0, -180.0]), "{text}");
        }
    }

    #[test]
    fn what_is_no_position_is_none() {
        for text in ["", "{}", r#"{"X":1, "Y":2, "Z":3}"#, r#"{"X":a, "Y":2, "Z":3, "U":0, "V":0, "W":0}"#] {
            assert_eq!(pose(text), None, "{text}");
        }
    }
}
