//! How near the next streamline of the same family is: samples in a grid of cubes.
//!
//! Two lines keep their distance if they run alike (within 45 degrees, either way round) and on
//! the same side of the surface, so that neither the crossing family nor the far side of a thin
//! wall counts.

use std::collections::HashMap;

use roundel::mesh::vector::{Vec3, dot, sub};

/// Lines run alike if the cosine between them is larger.
const ALIKE: f64 = 0.71;
/// Distances along a line count this many times, so that lines that meet head on almost touch.
const HEAD_ON: f64 = 2.0;
/// Two places are on the same side if the cosine between their normals is larger; edges of a
/// cube are.
const SAME_SIDE: f64 = -0.3;
/// A line may come near to itself over this part of its length, in distances between lines.
const OWN: f64 = 3.0;

/// A point of a line.
#[derive(Debug, Clone, Copy)]
pub(super) struct Sample {
    pub(super) position: Vec3,
    pub(super) normal: Vec3,
    pub(super) direction: Vec3,
    /// The line, and the signed length along it from its start.
    pub(super) line: usize,
    pub(super) at: f64,
}

/// Samples by place.
pub(super) struct Index {
    cell: f64,
    samples: Vec<Sample>,
    /// Looked up, never walked through: the order of a hash map does not matter.
    cells: HashMap<[i32; 3], Vec<u32>>,
}

impl Index {
    /// For questions about distances up to `spacing`.
    pub(super) fn new(spacing: f64) -> Index {
        Index {
            cell: spacing,
            samples: Vec::new(),
            cells: HashMap::new(),
        }
    }

    pub(super) fn len(&self) -> usize {
        self.samples.len()
    }

    pub(super) fn insert(&mut self, sample: Sample) {
        let number = self.samples.len() as u32;
        let cell = self.cell_of(sample.position);
        self.cells.entry(cell).or_default().push(number);
        self.samples.push(sample);
    }

    /// Takes the last samples out again.
    pub(super) fn truncate(&mut self, len: usize) {
        for sample in self.samples.split_off(len).iter().rev() {
            let cell = self.cell_of(sample.position);
            self.cells.entry(cell).or_default().pop();
        }
    }

    /// Whether another line that runs alike is nearer than `distance`.
    pub(super) fn is_crowded(&self, sample: &Sample, distance: f64) -> bool {
        let [i, j, k] = self.cell_of(sample.position);
        let around = |c: i32| c.saturating_sub(1)..=c.saturating_add(1);
        for i in around(i) {
            for j in around(j) {
                for k in around(k) {
                    let Some(cell) = self.cells.get(&[i, j, k]) else {
                        continue;
                    };
                    let mut others = cell.iter().map(|&n| &self.samples[n as usize]);
                    if others.any(|other| self.crowds(other, sample, distance)) {
                        return true;
                    }
                }
            }
        }
        false
    }

    fn crowds(&self, other: &Sample, sample: &Sample, distance: f64) -> bool {
        let apart = sub(other.position, sample.position);
        let along = dot(apart, other.direction);
        let near = dot(apart, apart) + (HEAD_ON * HEAD_ON - 1.0) * along * along;
        near < distance * distance
            && dot(other.direction, sample.direction).abs() > ALIKE
            && dot(other.normal, sample.normal) > SAME_SIDE
            && (other.line != sample.line || (other.at - sample.at).abs() > OWN * self.cell)
    }

    fn cell_of(&self, p: Vec3) -> [i32; 3] {
        p.map(|x| (x / self.cell).floor() as i32)
    }
}
