use unicode_width::UnicodeWidthStr as _;

use crate::model::untrusted_text;

/// A plain table for a terminal: columns padded to their widest cell, two blanks apart. Chinese and Japanese characters count double.
///
/// Names in certificates and the like come from strangers: each cell is one line ([`untrusted_text`]).
pub fn table(header: &[&str], rows: &[Vec<String>]) -> String {
    let rows: Vec<Vec<String>> =
        rows.iter().map(|row| row.iter().map(|cell| untrusted_text::one_line(cell, usize::MAX)).collect()).collect();
    let mut widths: Vec<usize> = header.iter().map(|h| h.width()).collect();
    for row in &rows {
        for (width, cell) in widths.iter_mut().zip(row) {
            *width = (*width).max(cell.width());
        }
    }
    let mut out = String::new();
    let header: Vec<String> = header.iter().map(ToString::to_string).collect();
    for row in std::iter::once(&header).chain(&rows) {
        let mut line = String::new();
        for (width, cell) in widths.iter().zip(row) {
            line.push_str(cell);
            line.push_str(&" ".repeat(width - cell.width() + 2));
        }
        out.push_str(line.trim_end());
        out.push('\n');
    }
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_line_up_in_chinese_too() {
        let text = table(&["NAME", "STATUS"], &[vec!["焊接".into(), "Run".into()], vec!["a".into(), "Stop".into()]]);
        assert_eq!(text, "NAME  STATUS\n焊接  Run\na     Stop\n");
    }

    #[test]
    fn a_cell_cannot_command_the_terminal() {
        assert_eq!(table(&["NAME", "BY"], &[vec!["\u{1b}[2J".into(), "a\nb".into()]]), "NAME  BY\n�[2J  a b\n");
    }
}
