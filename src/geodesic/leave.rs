//! Vertices as roots: sources, and vertices that shortest paths bend around.
//!
//! A shortest path that passes a vertex has an angle of at least pi on both sides of it, or on one at the boundary
//! (`mitchell1987`). So only vertices with more than 2 pi, or boundary vertices with more than pi, are
//! passed, and only in some directions.

use std::f64::consts::{PI, TAU};
use std::ops::Range;

use super::frame::Frame;
use super::wavefront::{Arrival, NONE, Wavefront};
use super::window::Window;

/// A vertex with so much more than a full turn is a saddle. Lines that pass others miss nothing between them but
/// vertices that `cross` finds by tolerance.
const EXCESS: f64 = 1e-12;

/// Directions are taken wider by this angle: windows that overlap do no harm, gaps do.
const WIDER: f64 = 1e-12;

/// A face around a vertex, which is its corner `k`.
struct Sector {
    face: usize,
    k: usize,
    /// The face on its edge opposite the vertex.
    frame: Frame,
    /// The angles of its two edges at the vertex, counted around it.
    angles: Range<f64>,
}

/// The directions in which shortest paths go on, as angles around a vertex.
enum Directions {
    All,
    None,
    /// At an interior vertex: those no farther than `half` from `middle`, on a circle of `total`.
    Near {
        middle: f64,
        half: f64,
        total: f64,
    },
    /// At a boundary vertex: those up to the first and those from the second.
    Outside([f64; 2]),
}

impl Wavefront<'_> {
    /// A vertex was reached: its neighbours are, along the edges, and windows start where paths bend around it.
    pub(super) fn leave(&mut self, vertex: usize) {
        let sectors = self.sectors(vertex);
        let distance = self.distance[vertex];
        for sector in &sectors {
            self.reach_along_edges(vertex, distance, sector);
        }
        if self.has_left(vertex) {
            return;
        }
        let directions = self.directions(vertex, &sectors);
        if matches!(directions, Directions::None) {
            return;
        }
        self.left_at[vertex] = distance;
        for sector in &sectors {
            let Some(twin) = self.twin(sector.face, (sector.k + 1) % 3) else {
                continue;
            };
            let Some([from, to]) = directions.part(sector) else {
                continue;
            };
            let Frame { length, apex, .. } = sector.frame;
            let window = Window {
                a: length - to,
                b: length - from,
                x: length - apex[0],
                y: -apex[1],
                s: distance,
                root: vertex as u32,
                is_line: false,
            };
            if window.a < window.b {
                self.deliver_one(twin, window);
            }
        }
    }

    fn sectors(&self, vertex: usize) -> Vec<Sector> {
        let mut angle = 0.0;
        let sector = |(face, k): (usize, usize)| {
            let from = angle;
            angle += self.mesh.angle(face, k);
            Sector {
                face,
                k,
                frame: Frame::new(self.mesh, face, (k + 1) % 3),
                angles: from..angle,
            }
        };
        self.mesh.ring(vertex).map(sector).collect()
    }

    fn reach_along_edges(&mut self, vertex: usize, distance: f64, sector: &Sector) {
        let &Sector {
            face, k, ref frame, ..
        } = sector;
        let corners = self.mesh.corners(face);
        let [next, last] = [(k + 1) % 3, (k + 2) % 3];
        // The half-edge opposite corner k + 1 ends at the vertex, the one opposite corner k + 2 starts there.
        let to_next = Arrival {
            half: (3 * face + last) as u32,
            root: vertex as u32,
            x: frame.right,
            y: 0.0,
        };
        self.reach(corners[next], distance + frame.left, to_next);
        let to_last = Arrival {
            half: (3 * face + k) as u32,
            x: 0.0,
            ..to_next
        };
        self.reach(corners[last], distance + frame.right, to_last);
    }

    /// The directions in which shortest paths leave a vertex.
    fn directions(&self, vertex: usize, sectors: &[Sector]) -> Directions {
        let arrival = self.arrival[vertex];
        if arrival.half == NONE {
            return Directions::All;
        }
        let total = sectors.last().map_or(0.0, |s| s.angles.end);
        let is_boundary = self.mesh.is_boundary_vertex(vertex);
        if total <= if is_boundary { PI } else { TAU + EXCESS } {
            return Directions::None;
        }
        let (face, k) = (arrival.half as usize / 3, arrival.half as usize % 3);
        let sector = sectors
            .iter()
            .find(|s| s.face == face && (s.k + 1) % 3 == k);
        let Some(sector) = sector else {
            return Directions::All;
        };
        let back = sector.angles.start + self.angle_back(arrival, sector);
        match is_boundary {
            true => Directions::Outside([back - PI + WIDER, back + PI - WIDER]),
            false => Directions::Near {
                middle: back + 0.5 * total,
                half: 0.5 * total - PI + WIDER,
                total,
            },
        }
    }

    /// The angle from the first edge of a sector to the line that ends at its vertex.
    fn angle_back(&self, arrival: Arrival, sector: &Sector) -> f64 {
        let [px, py] = sector.frame.apex;
        let back = match self.is_segment(arrival.root) {
            true => [-arrival.x, arrival.y],
            false => [arrival.x - px, arrival.y - py],
        };
        let first = [-px, -py];
        let sine = first[0] * back[1] - first[1] * back[0];
        sine.atan2(first[0] * back[0] + first[1] * back[1])
    }
}

impl Directions {
    /// The part of the edge opposite the vertex of a sector in these directions, as lengths from its first end.
    fn part(&self, sector: &Sector) -> Option<[f64; 2]> {
        let Range { start, end } = sector.angles;
        let angle = end - start;
        let length = sector.frame.length;
        let ranges = match *self {
            Directions::All => return Some([0.0, length]),
            Directions::None => return None,
            Directions::Outside([to, from]) => [[start, to], [from, end]],
            Directions::Near {
                middle,
                half,
                total,
            } => {
                let middle = middle.rem_euclid(total);
                [
                    middle,
                    if middle > start {
                        middle - total
                    } else {
                        middle + total
                    },
                ]
                .map(|m| [m - half, m + half])
            }
        };
        let cut = ranges.map(|[from, to]| [from.max(start) - start, to.min(end) - start]);
        let mut parts = cut.into_iter().filter(|[from, to]| from < to);
        let first = parts.next()?;
        if parts.next().is_some() {
            return Some([0.0, length]);
        }
        let place = |beta: f64| {
            if beta <= 0.0 {
                0.0
            } else if beta >= angle {
                length
            } else {
                let near = sector.frame.left * beta.sin();
                let far = sector.frame.right * (angle - beta).sin();
                length * (near / (near + far))
            }
        };
        Some(first.map(place))
    }
}
