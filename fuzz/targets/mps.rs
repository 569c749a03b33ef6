//! MPS files: any bytes give a problem or an error, and a problem is written and read back unchanged.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roundel::problem::mps;

fuzz_target!(|bytes: &[u8]| {
    let Ok(first) = mps::parse(bytes) else {
        return;
    };
    let mut text = Vec::new();
    // A range may reach limits that readers take for infinite.
    if mps::write_to(&mut text, &first).is_err() {
        return;
    }
    let again = mps::parse(text.as_slice()).expect("what was written can be read");
    let mut same = Vec::new();
    mps::write_to(&mut same, &again).expect("a problem that was read can be written");
    assert!(text == same, "reading what was written changes it");
});
