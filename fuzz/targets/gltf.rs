#![no_main]

use libfuzzer_sys::fuzz_target;
use whitted_host::read::Format;

fuzz_target!(|bytes: &[u8]| whitted_fuzz::survives(Format::Gltf, bytes));
