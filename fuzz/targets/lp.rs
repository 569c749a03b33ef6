//! LP files: any bytes give a problem or an error, and a problem is written and read back unchanged.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roundel::problem::lp;

fuzz_target!(|bytes: &[u8]| {
    let Ok(first) = lp::parse(bytes) else {
        return;
    };
    let mut text = Vec::new();
    // Sums of repeated terms may overflow.
    if lp::write_to(&mut text, &first).is_err() {
        return;
    }
    let again = lp::parse(text.as_slice()).expect("what was written can be read");
    let mut same = Vec::new();
    lp::write_to(&mut same, &again).expect("a problem that was written can be written again");
    assert!(text == same, "reading what was written changes it");
});
