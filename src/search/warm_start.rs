//! Warm starts: the use of the integers of an earlier solution.

use super::table::words;

words! {
    /// The use of earlier integers in a search.
    ///
    /// Right sides may have changed since the earlier solution. Only the integers that are free after the
    /// elimination of the constraints are used. They and the current right sides determine the others.
    #[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
    pub enum WarmStart {
        #[default]
        Off = "off": "Nothing.",
        Offer = "offer": "They are offered first, with all else re-optimised: the result is never worse.",
        Keep = "keep": "They are kept and all else is re-optimised: no search, at the price of a relaxation.",
    }
}
