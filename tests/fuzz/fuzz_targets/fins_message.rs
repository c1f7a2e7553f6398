#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| opcua_configurator_fuzz::readers::fins_message(bytes));
