#![no_main]

libfuzzer_sys::fuzz_target!(|bytes: &[u8]| adslam_tests::readers::read("obj", bytes));
