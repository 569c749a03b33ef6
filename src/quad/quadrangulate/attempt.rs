//! The quads of one map, and how well that went.

use crate::mesh::TriangleMesh;
use crate::quad::untangle::Untangled;
use crate::quad::{IntegerGridMap, QuadMesh, extract};
use crate::{Monitor, Result};

pub(super) struct Attempt {
    pub(super) map: Untangled,
    pub(super) quads: QuadMesh,
    conforms: bool,
}

impl Attempt {
    pub(super) fn new(mesh: &TriangleMesh, map: Untangled, monitor: &mut Monitor) -> Result<Self> {
        let exact = IntegerGridMap::from_seamless(mesh, &map.map)?;
        let quads = extract(mesh, &exact, monitor)?;
        Ok(Attempt {
            conforms: quads.is_conforming(),
            map,
            quads,
        })
    }

    pub(super) fn conforms(&self) -> bool {
        self.conforms
    }

    /// What is to be as small as can be, the most important first.
    pub(super) fn cost(&self) -> (bool, usize, usize) {
        (
            !self.conforms,
            self.quads.repaired,
            self.quads.figures().irregular,
        )
    }
}
