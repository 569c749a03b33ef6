//! The caller's unknowns and the introduced ones in one numbering.

/// The data of each unknown. The caller's unknowns come first.
#[derive(Debug)]
pub(super) struct Unknowns {
    pub integer: Vec<bool>,
    /// The substitution that replaced it, or [`FREE`](Self::FREE) if there is none.
    pub replaced: Vec<u32>,
    /// The caller's unknown whose place in the Hessian's graph it has, or [`NOWHERE`](Self::NOWHERE).
    pub place: Vec<u32>,
    /// The number of nested sums that it stands for; see `subtree`.
    pub depth: Vec<u8>,
}

impl Unknowns {
    /// The unknown is not replaced.
    pub const FREE: u32 = u32::MAX;
    /// The unknown has no place in the Hessian's graph.
    pub const NOWHERE: u32 = u32::MAX;

    pub fn new(integer: &[bool]) -> Self {
        let n = integer.len();
        Unknowns {
            integer: integer.to_vec(),
            replaced: vec![Self::FREE; n],
            place: (0..n as u32).collect(),
            depth: vec![0; n],
        }
    }

    pub fn len(&self) -> usize {
        self.integer.len()
    }

    pub fn is_free(&self, unknown: u32) -> bool {
        self.replaced[unknown as usize] == Self::FREE
    }

    /// Introduces an unknown and returns its number.
    pub fn introduce(&mut self, integer: bool, place: u32, depth: u8) -> u32 {
        self.integer.push(integer);
        self.replaced.push(Self::FREE);
        self.place.push(place);
        self.depth.push(depth);
        self.len() as u32 - 1
    }
}
