//! Arbitrary soups: the strict mesh accepts what repair makes of them, and there is nothing left to repair.
#![no_main]

mod soups;

use libfuzzer_sys::arbitrary::Unstructured;
use libfuzzer_sys::fuzz_target;

fuzz_target!(|bytes: &[u8]| {
    let mut u = Unstructured::new(bytes);
    if let (Ok(options), Ok(soup)) = (soups::options(&mut u), soups::soup(&mut u)) {
        soups::check(&soup, &options);
    }
});
