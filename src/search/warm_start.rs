//! Where a search begins: at nothing, or at the integers of an earlier solution.

/// What a search makes of earlier integers.
///
/// Right sides may have changed since. What is taken over are the integers that the elimination of
/// the constraints left free; the others follow from these and the right sides as they are now.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum WarmStart {
    /// Nothing.
    #[default]
    Off,
    /// They are offered first, with all else re-optimised: the result is never worse.
    Offer,
    /// They are kept, and all else re-optimised: no search, and the price of a relaxation.
    Keep,
}

impl WarmStart {
    /// All of them.
    pub const ALL: [WarmStart; 3] = [WarmStart::Off, WarmStart::Offer, WarmStart::Keep];

    /// The name by which options choose it.
    pub fn name(self) -> &'static str {
        match self {
            WarmStart::Off => "off",
            WarmStart::Offer => "offer",
            WarmStart::Keep => "keep",
        }
    }
}
