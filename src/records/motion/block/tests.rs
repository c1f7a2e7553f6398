use super::*;

/// One value of each item, at the offsets of manual 4.3.3.
fn block() -> Vec<u8> {
    let mut bytes = vec![0; 2608];
    let mut put = |at: usize, value: &[u8]| bytes[at..at + value.len()].copy_from_slice(value);
    let second = [0, 0xb4, 0xc4, 0x04];
    // ENC_2, sample 3 (192 + 3 * 24): one second, position -2, timer 7, -5 °C.
    put(264, &second);
    put(272, &[0xfe, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff]);
    put(280, &[7]);
    put(284, &[0xfb]);
    // DRVCMD_6, sample 7 (1952 + 7 * 20): ID 1, IQ -1, 180°, velocity 256.
    put(2092, &second);
    put(2102, &[1, 0, 0xff, 0xff, 0, 0x80, 0, 1]);
    // RT-I/O, sample 1; STD-I/O, sample 2.
    put(2128, &second);
    put(2136, &[0x0f, 0, 0, 0, 0x81]);
    put(2288, &second);
    put(2304, &[1, 2, 3, 0, 4, 5, 0, 0]);
    // FSENS: Fy = 4 * 3 + 2.
    put(2432, &second);
    put(2446, &[3, 0]);
    put(2456, &[0b0000_1000]);
    // PLSCNT and TCP.
    put(2504, &second);
    put(2524, &[0, 0, 1, 0]);
    put(2528, &second);
    put(2536, &[0, 0, 0, 0, 0, 0, 0xf8, 0x3f]);
    put(2600, &[0, 0, 0, 0, 0, 0, 0xf0, 0xbf]);
    bytes
}

#[test]
fn a_block_by_the_table() {
    let bytes = block();
    let read = MotionRead::decode(&bytes).unwrap();
    let block = read.blocks().next().unwrap();
    let second = Ticks(Ticks::PER_SECOND);
    let encoder = Encoder { timestamp: second, position: -2, timer: 7, temperature: -5 };
    assert_eq!(block.encoder(1, 3).to_packet(), encoder);
    assert_eq!(block.encoder(1, 2).to_packet(), Encoder::default());
    let drive =
        DriveCommand { timestamp: second, d_current: 1, q_current: -1, electrical_angle: 0x8000, velocity: 256 };
    assert_eq!(block.drive_command(5, 7).to_packet(), drive);
    assert_eq!(block.real_time_io(1).to_packet(), RealTimeIo { timestamp: second, inputs: 0x0f, outputs: 0x81 });
    let io = StandardIo { timestamp: second, inputs: 0x03_0201, outputs: 0x0504 };
    assert_eq!(block.standard_io(2).to_packet(), io);
    assert_eq!(block.force_sensor().axes().force, [0, 14, 0]);
    assert_eq!(block.pulse_counters().second_latched(), 0x1_0000);
    assert_eq!(block.tcp().components(), [1.5, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, -1.0]);
    assert_eq!((block.first_timestamp(), block.last_timestamp()), (Some(second), Some(second)));
    let mut again = Vec::new();
    block.to_packet().encode_into(&mut again);
    assert_eq!(again, bytes);
}

#[test]
fn an_error_names_the_item_and_its_offset() {
    let wrong = |bytes: &[u8]| {
        let error = MotionRead::decode(bytes).unwrap_err();
        (error.record, error.field, error.offset, error.mistake)
    };
    assert_eq!(wrong(&[]), (0, "ENC_1", 0, Mistake::Truncated { missing: 2608 }));
    let two = [block(), block()].concat();
    assert_eq!(wrong(&two[..2608 + 2115]), (1, "RT-I/O", 2608 + 2112, Mistake::Truncated { missing: 493 }));
    let mut late = two;
    late[2608 + 1179] = 0x10;
    let expected = "more than a hundred years after the controller was switched on";
    let found = 0x10 << 56;
    assert_eq!(wrong(&late), (1, "DRVCMD_1", 2608 + 1172, Mistake::Value { found, expected }));
}
