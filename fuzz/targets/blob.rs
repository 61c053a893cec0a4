#![no_main]

use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    whitted_fuzz::survives_blob(bytes);
});
