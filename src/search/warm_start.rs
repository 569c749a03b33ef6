//! Where a search begins: at nothing, or at the integers of an earlier solution.

use super::table::words;

words! {
    /// What a search makes of earlier integers.
    ///
    /// Right sides may have changed since. What is taken over are the integers that the elimination of
    /// the constraints left free; the others follow from these and the right sides as they are now.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
    pub enum WarmStart {
        #[default]
        Off = "off": "Nothing.",
        Offer = "offer": "They are offered first, with all else re-optimised: the result is never worse.",
        Keep = "keep": "They are kept and all else is re-optimised: no search, at the price of a relaxation.",
    }
}
