#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| opcua_configurator_fuzz::readers::recording_csv(bytes));
