//! Tables in text files, as spreadsheets and scripts save them (RFC 4180 and its usual variants).

/// One row that is not empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTableRow {
    /// Counted from 1.
    pub line: usize,
    /// Without blanks around them, and without the empty ones at the end that spreadsheets add.
    pub fields: Vec<String>,
    /// Whether a field has a line end in it: a quotation mark was never closed, or the cell has several lines.
    pub is_broken: bool,
}

/// A table, and what separates its fields.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TextTable {
    /// The rows that are not empty, in the order of the file.
    pub rows: Vec<TextTableRow>,
    /// What separates the fields: comma, semicolon or tab.
    pub separator: char,
}

/// What may separate fields: a comma, the semicolon where the comma is for decimals, and the tab of Excel's "Unicode
/// text".
pub const SEPARATORS: [char; 3] = [',', ';', '\t'];

impl TextTable {
    /// Reads fields that are quoted where needed (RFC 4180 §2.5 to §2.7), in lines ended by LF, CRLF or CR.
    ///
    /// The separator is the one that Excel's line `sep=` names, or else that of the first line with any. `sep=` and the
    /// `#TYPE` of PowerShell's `Export-Csv` are no rows. At most `max_rows` are read.
    pub fn read(text: &str, max_rows: usize) -> Self {
        let mut rest = text;
        let mut named = None;
        while let Some((line, after)) = first_line(rest) {
            let bare = line.trim().trim_matches('"');
            if named.is_none() && bare.len() == 5 && starts_with(bare, "sep=") {
                named = bare.chars().next_back().filter(|separator| SEPARATORS.contains(separator));
            } else if line == "sep=\t" {
                named = Some('\t');
            } else if !starts_with(bare, "#TYPE ") && !bare.is_empty() {
                break;
            }
            rest = after;
        }
        let separator = named.or_else(|| separator_of(rest)).unwrap_or(',');
        let mut reader = csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .delimiter(separator as u8)
            .from_reader(rest.as_bytes());
        let mut lines = LineCounter { bytes: text.as_bytes(), counted: 0, line: 1 };
        let before = text.len() - rest.len();
        let mut rows = Vec::new();
        // UTF-8 text cannot fail to be a list of records of any length.
        for record in reader.records().filter_map(Result::ok) {
            let used = record.iter().map(str::trim).collect::<Vec<_>>();
            let used = &used[..used.iter().rposition(|field| !field.is_empty()).map_or(0, |last| last + 1)];
            if used.is_empty() {
                continue;
            }
            if rows.len() == max_rows {
                break;
            }
            let from = record.position().map_or(0, |position| usize::try_from(position.byte()).unwrap_or(usize::MAX));
            rows.push(TextTableRow {
                line: lines.line_from(before.saturating_add(from)),
                fields: used.iter().map(|field| (*field).to_owned()).collect(),
                is_broken: record.iter().any(|field| field.contains(['\r', '\n'])),
            });
        }
        Self { rows, separator }
    }
}

fn first_line(text: &str) -> Option<(&str, &str)> {
    if text.is_empty() {
        return None;
    }
    let end = text.find(['\r', '\n']).map_or(text.len(), |at| at + 1);
    Some((text[..end].trim_end_matches(['\r', '\n']), &text[end..]))
}

fn starts_with(text: &str, word: &str) -> bool {
    text.get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}

/// Of the first line that has any outside of quotation marks: the more frequent of comma and semicolon, or else the tab,
/// which also stands for blanks.
fn separator_of(text: &str) -> Option<char> {
    text.split(['\r', '\n']).map(str::trim).find_map(|line| {
        let mut is_quoted = false;
        let mut count = [0_usize; SEPARATORS.len()];
        for character in line.chars() {
            is_quoted ^= character == '"';
            if let (false, Some(index)) = (is_quoted, SEPARATORS.iter().position(|known| *known == character)) {
                count[index] += 1;
            }
        }
        let [commas, semicolons, tabs] = count;
        match (commas, semicolons, tabs) {
            (0, 0, 0) => None,
            (0, 0, _) => Some('\t'),
            _ if semicolons > commas => Some(';'),
            _ => Some(','),
        }
    })
}

/// Numbers records by the lines they stand in. The reader's own count is late by the line ends and empty lines before a
/// record.
struct LineCounter<'a> {
    bytes: &'a [u8],
    counted: usize,
    line: usize,
}

impl LineCounter<'_> {
    /// The line of the first character at `from` or after it that ends no line. Asked for ascending places only.
    fn line_from(&mut self, from: usize) -> usize {
        while let Some(byte) = self.bytes.get(self.counted) {
            if self.counted >= from && !matches!(byte, b'\r' | b'\n') {
                break;
            }
            self.counted += 1;
            let ends = *byte == b'\n' || *byte == b'\r' && self.bytes.get(self.counted) != Some(&b'\n');
            self.line += usize::from(ends);
        }
        self.line
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rows(text: &str) -> Vec<(usize, Vec<String>)> {
        TextTable::read(text, 100).rows.into_iter().map(|row| (row.line, row.fields)).collect()
    }

    fn row(line: usize, fields: &[&str]) -> (usize, Vec<String>) {
        (line, fields.iter().map(|&field| field.to_owned()).collect())
    }

    #[test]
    fn every_spelling_is_the_same_table() {
        let expected = [row(1, &["a", "b", "c"]), row(2, &["1", "", "3"])];
        for text in [
            "a,b,c\n1,,3\n",
            "a,b,c\r\n1,,3\r\n",
            "a,b,c\r1,,3\r",
            "a;b;c\n1;;3",
            "a\tb\tc\n1\t\t3",
            "a,b,c,,\n1,,3,,\n,,,,\n",
            " a , b ,c \n1, ,3\n \n",
            "\t a\t\t,\tb,c\n1,,3\n",
            "\"a\",\"b\",\"c\"\n\"1\",\"\",\"3\"\n",
            "a;\"b\";c\n1;;\"3\"\n",
        ] {
            assert_eq!(rows(text), expected, "{text:?}");
        }
    }

    #[test]
    fn lines_of_excel_and_powershell_are_no_rows() {
        for (text, line) in [
            ("sep=;\r\na;b,c\r\n", 2),
            ("SEP=;\n\na;b,c\n", 3),
            ("\"sep=;\"\na;b,c\n", 2),
            ("#TYPE System.Management.Automation.PSCustomObject\n\"a\";\"b,c\"\n", 2),
        ] {
            assert_eq!(rows(text), [row(line, &["a", "b,c"])], "{text:?}");
        }
        assert_eq!(rows("sep=\t\na\tb\n"), [row(2, &["a", "b"])]);
        assert_eq!(TextTable::read("sep=,", 9), TextTable { rows: vec![], separator: ',' });
    }

    #[test]
    fn quotes_hold_separators_quotes_and_line_ends() {
        let text = "n,t\n\"Cell, \"\"9\"\"\",x\n\"two\nlines\",y\n\"open,z\nmore\n";
        let table = TextTable::read(text, 100);
        assert_eq!(
            rows(text),
            [
                row(1, &["n", "t"]),
                row(2, &["Cell, \"9\"", "x"]),
                row(3, &["two\nlines", "y"]),
                row(5, &["open,z\nmore"])
            ]
        );
        assert_eq!(table.rows.iter().map(|row| row.is_broken).collect::<Vec<_>>(), [false, false, true, true]);
        assert_eq!(TextTable::read("a\nb\nc\n", 2).rows.len(), 2, "bounded");
        assert_eq!(TextTable::read("", 2).rows, []);
    }
}
