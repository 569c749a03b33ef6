//! A flat piece made into a plate: two copies and walls between them.

use super::quads::Quads;

impl Quads {
    /// The plate between heights -`half` and `half` over this piece of the plane z = 0, its
    /// walls in `layers` rows.
    pub(super) fn extrude(&self, half: f64, layers: usize) -> Quads {
        let count = self.points.len() as u32;
        let mut plate = Quads::default();
        for z in [half, -half] {
            plate
                .points
                .extend(self.points.iter().map(|p| [p[0], p[1], z]));
        }
        plate.quads.extend(&self.quads);
        let below = self.quads.iter().map(|&[a, b, c, d]| [d, c, b, a]);
        plate.quads.extend(below.map(|q| q.map(|v| v + count)));

        let border = self.border();
        // Where the column of points under each border point starts.
        let mut column = vec![0; self.points.len()];
        for &[v, _] in &border {
            column[v as usize] = plate.points.len() as u32;
            let [x, y, _] = self.points[v as usize];
            let step = 2.0 * half / layers as f64;
            let between = (1..layers).map(|i| [x, y, half - step * i as f64]);
            plate.points.extend(between);
        }
        let at = |v: u32, layer: usize| match layer {
            0 => v,
            _ if layer == layers => v + count,
            _ => column[v as usize] + layer as u32 - 1,
        };
        for &[a, b] in &border {
            let walls = (0..layers).map(|i| [at(a, i + 1), at(b, i + 1), at(b, i), at(a, i)]);
            plate.quads.extend(walls);
        }
        plate
    }

    /// Directed edges without a counterpart; every border point starts exactly one.
    fn border(&self) -> Vec<[u32; 2]> {
        let mut edges = Vec::with_capacity(4 * self.quads.len());
        for q in &self.quads {
            edges.extend((0..4).map(|k| [q[k], q[(k + 1) % 4]]));
        }
        edges.sort_unstable_by_key(|&[a, b]| (a.min(b), a.max(b)));
        edges
            .chunk_by(|a, b| a == b || (a[0] == b[1] && a[1] == b[0]))
            .filter(|same| same.len() == 1)
            .map(|same| same[0])
            .collect()
    }
}
