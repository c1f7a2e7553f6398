use opcua_configurator::records::RecordError;
use opcua_configurator::records::force::{ForceAssembly, ForceColumns, ForceEvent, ForceHeader, ForceRead};
use opcua_configurator::records::motion::{MotionColumns, MotionRead};

use super::assert_printable;

/// [`ForceRead::decode`]: what is taken is written again to bytes that mean the same, its texts can be shown, and every
/// record is in the columns; an error lies inside the bytes.
pub fn force_packet(bytes: &[u8]) {
    let read = match ForceRead::decode(bytes) {
        Ok(read) => read,
        Err(error) => return assert_inside(error, bytes),
    };
    let encoded = encoded(&read);
    assert_eq!(encoded.len(), bytes.len());
    let again = ForceRead::decode(&encoded).expect("what was encoded is a packet");
    assert_eq!(self::encoded(&again), encoded);
    assert_eq!(again.id(), read.id());
    if let Some(ForceHeader { header, .. }) = read.to_header() {
        let labels = [header.robot_name, header.sensor_label, header.monitor_label, header.coordinate_label];
        labels.iter().for_each(|label| assert_printable(&label.to_string()));
        assert_printable(&header.file_name.to_string());
        assert_printable(&header.start.to_string());
    }
    let mut columns = ForceColumns::default();
    let events = ForceAssembly::default().push(read, &mut columns);
    let count = events.iter().map(|event| if let ForceEvent::Records { count } = event { *count } else { 0 });
    assert_eq!(count.sum::<usize>(), columns.rows());
    if let ForceRead::Data(records) = read {
        assert_eq!(columns.rows(), records.len());
        let columns = columns.columns(records.data_type());
        assert!(columns.iter().all(|column| column.values.len() == records.len()));
    }
}

fn encoded(read: &ForceRead<'_>) -> Vec<u8> {
    match read {
        ForceRead::Header { .. } => read.to_header().expect("a header").encode(),
        ForceRead::Footer(footer) => footer.to_packet().encode().to_vec(),
        ForceRead::Data(records) => {
            let mut bytes = Vec::new();
            (0..records.len()).filter_map(|index| records.get(index)).for_each(|record| record.encode_into(&mut bytes));
            bytes
        }
    }
}

/// [`MotionRead::decode`]: what is taken is written again to bytes that mean the same, and every block is in the columns;
/// an error lies inside the bytes.
pub fn motion_packet(bytes: &[u8]) {
    let read = match MotionRead::decode(bytes) {
        Ok(read) => read,
        Err(error) => return assert_inside(error, bytes),
    };
    let mut encoded = Vec::new();
    read.blocks().for_each(|block| block.to_packet().encode_into(&mut encoded));
    assert_eq!(encoded.len(), bytes.len());
    let mut columns = MotionColumns::default();
    columns.extend(read);
    assert_eq!(columns.blocks(), read.len());
    for column in columns.columns() {
        assert_eq!(column.values.len() * column.rows_per_value, columns.rows(), "{}", column.name);
    }
    let mut again = MotionColumns::default();
    again.extend(MotionRead::decode(&encoded).expect("what was encoded is a packet"));
    let bits = |columns: &MotionColumns| {
        columns.tcp.components.clone().map(|values| values.into_iter().map(f64::to_bits).collect::<Vec<_>>())
    };
    assert_eq!(bits(&again), bits(&columns));
    assert_eq!((again.encoders, again.drive_commands), (columns.encoders, columns.drive_commands));
    assert_eq!((again.force_sensor, again.pulse_counters), (columns.force_sensor, columns.pulse_counters));
}

fn assert_inside(error: RecordError, bytes: &[u8]) {
    assert!(error.offset <= bytes.len(), "{error}");
    assert_printable(&error.to_string());
}
