//! QPLIB files: any bytes give a problem or an error, and a problem is the same through MPS and through LP.
#![no_main]

use libfuzzer_sys::fuzz_target;
use roundel::problem::{lp, mps, qplib};

fuzz_target!(|bytes: &[u8]| {
    let Ok(first) = qplib::parse(bytes) else {
        return;
    };
    let mut text = Vec::new();
    // Limits above 1e20 but below the file's infinity cannot be written.
    if mps::write_to(&mut text, &first).is_err() {
        return;
    }
    let again = mps::parse(text.as_slice()).expect("what was written can be read");
    assert_eq!(again.variables(), first.variables());
    text.clear();
    lp::write_to(&mut text, &first).expect("a problem that MPS holds can be written as LP");
    let again = lp::parse(text.as_slice()).expect("what was written can be read");
    assert_eq!(again.variables().len(), first.variables().len());
});
