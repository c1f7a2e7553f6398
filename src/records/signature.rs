/// The first line of a packet file: every packet of a recording as it came.
pub const JOURNAL: &[u8] = b"OPCUA-RECORDING 1\n";

/// What an Apache Parquet file begins with.
const PARQUET: &[u8] = b"PAR1";

/// The first columns of the CSV files of the recorder: of the force sensor, of the motion log.
const CSV: [&[u8]; 2] = [b"OPCUACommonID,Count,ElapsedTime [ms],", b"ENC_1.TIMESTAMP [ticks],ENC_1.ENC_POS [pulses],"];

/// Whether a file with this beginning is a recording: packets, Parquet, or CSV. 64 bytes are enough.
pub fn begins_recording(head: &[u8]) -> bool {
    // As another program may have saved a CSV file.
    let head = head.strip_prefix("\u{feff}".as_bytes()).unwrap_or(head);
    // Every version of a packet file, so that a later one is refused by its reader.
    let journal = JOURNAL.split(|byte| *byte == b' ').next().unwrap_or(JOURNAL);
    head.starts_with(journal) || head.starts_with(PARQUET) || CSV.iter().any(|columns| head.starts_with(columns))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::records::columns::Column;
    use crate::records::force::{ForceColumns, ForceDataType};
    use crate::records::motion::MotionColumns;

    #[test]
    fn recordings_are_told_from_other_files() {
        let titles = |columns: Vec<Column<'_>>| {
            let title = |column: &Column<'_>| match column.unit {
                "" => column.name.clone(),
                unit => format!("{} [{unit}]", column.name),
            };
            columns.iter().map(title).collect::<Vec<_>>().join(",").into_bytes()
        };
        let force = ForceDataType::ALL.map(|data_type| titles(ForceColumns::default().columns(data_type)));
        let motion = titles(MotionColumns::default().columns());
        for head in
            force.iter().chain([&motion]).map(Vec::as_slice).chain([JOURNAL, b"OPCUA-RECORDING 2\n", b"PAR1\x15\x04"])
        {
            assert!(begins_recording(&head[..head.len().min(64)]), "{}", String::from_utf8_lossy(head));
        }
        assert!(begins_recording(&["\u{feff}".as_bytes(), &motion[..50]].concat()));
        for head in [&b""[..], b"PAR", b"OPCUA.Activation.Ver.1.0", b"Name,Type,Address", b"ENC_1", b"\x89PNG"] {
            assert!(!begins_recording(head));
        }
    }
}
