//! The reasons for which a search ends before it is complete.

/// Why a search ended before it had visited everything that could be better.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StoppedBy {
    /// Nothing stopped it: it is complete, it has reached the gap that was asked for, or its strategy
    /// proves nothing and has done all that it does.
    Nothing,
    /// The option `nodes`, set by the caller.
    Nodes,
    /// The option `time_limit`.
    Time,
    /// A lack of memory.
    Memory,
    /// The caller, by a cancel token or an event.
    Cancel,
    /// A budget of the library: the work of `auto`, or the default of `nodes`.
    Budget,
}

impl StoppedBy {
    /// The word that every interface has for it.
    pub fn name(self) -> &'static str {
        match self {
            StoppedBy::Nothing => "none",
            StoppedBy::Nodes => "nodes",
            StoppedBy::Time => "time",
            StoppedBy::Memory => "memory",
            StoppedBy::Cancel => "cancel",
            StoppedBy::Budget => "budget",
        }
    }
}
