//! What repair changed, by the elements of the mesh that it made.

use roundel::soup::{Edit, EditKind, Edits, Repaired};

/// All edits of one kind.
pub struct Change {
    /// How many there are, for people: "welded 12 vertices".
    pub words: String,
    /// The vertices and triangles of the mesh that they concern; none where all were dropped.
    pub vertices: Vec<u32>,
    pub triangles: Vec<u32>,
}

/// A change for each kind of edit, in the order of the steps of repair.
#[derive(Default)]
pub struct Changes(Vec<Change>);

impl Changes {
    /// What a repair changed.
    pub fn new(repaired: &Repaired) -> Self {
        let kinds = EditKind::ALL.into_iter();
        let made = kinds.filter(|&kind| repaired.edits.count(kind) > 0);
        Changes(made.map(|kind| Change::new(repaired, kind)).collect())
    }

    /// The same on the faces that a refinement made of the mesh. It keeps the numbers of vertices.
    pub fn on_refined(mut self, face_origin: &[u32]) -> Self {
        for change in &mut self.0 {
            let before = std::mem::take(&mut change.triangles);
            let faces = face_origin.iter().zip(0..);
            let parts = faces.filter(|(origin, _)| before.binary_search(origin).is_ok());
            change.triangles = parts.map(|(_, face)| face).collect();
        }
        self
    }

    /// The changes.
    pub fn iter(&self) -> impl Iterator<Item = &Change> {
        self.0.iter()
    }
}

impl Change {
    fn new(repaired: &Repaired, kind: EditKind) -> Self {
        let edits = repaired
            .edits
            .list()
            .iter()
            .filter(|edit| edit.kind == kind);
        let mut change = Change {
            words: words(&repaired.edits, kind),
            vertices: Vec::new(),
            triangles: Vec::new(),
        };
        edits.for_each(|edit| change.add(repaired, edit));
        if kind == EditKind::HoleFilled {
            let origins = repaired.triangle_origin.iter().zip(0..);
            let new = origins.filter(|(origin, _)| origin.is_none());
            change.triangles.extend(new.map(|(_, triangle)| triangle));
        }
        for list in [&mut change.vertices, &mut change.triangles] {
            list.sort_unstable();
            list.dedup();
        }
        change
    }

    /// Adds what an edit names, where it is still there.
    fn add(&mut self, repaired: &Repaired, edit: &Edit) {
        let named = [
            (Some(edit.kind.element()), Some(edit.element)),
            (edit.kind.other(), edit.other),
        ];
        for (what, number) in named {
            let (Some(what), Some(number)) = (what, number) else {
                continue;
            };
            if what.contains("input vertex") {
                self.vertices.extend(repaired.vertices_of(number as usize));
            } else if what.contains("input polygon") {
                self.triangles
                    .extend(repaired.triangles_of(number as usize));
            }
        }
    }
}

/// The part of the summary on one kind.
fn words(edits: &Edits, kind: EditKind) -> String {
    let before = EditKind::ALL.into_iter().filter(|&other| other < kind);
    let before = before.filter(|&other| edits.count(other) > 0).count();
    let summary = edits.summary();
    summary
        .split(", ")
        .nth(before)
        .unwrap_or(kind.name())
        .to_owned()
}

#[cfg(test)]
mod tests {
    use roundel::soup::{PolygonSoup, RepairOptions, repair};

    use super::*;

    #[test]
    fn changes_name_the_elements_that_are_left() {
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [1.0, 1.0]];
        let positions = positions.map(|[x, y]| [x, y, 0.0]).to_vec();
        let mut soup = PolygonSoup::new(positions);
        // A triangle, the same again, and one that runs against it at a vertex of the same place.
        soup.add_polygon([0, 1, 2]);
        soup.add_polygon([0, 1, 2]);
        soup.add_polygon([0, 3, 4]);
        let repaired = repair(&soup, &RepairOptions::default()).unwrap();
        let changes = Changes::new(&repaired);
        let words: Vec<&str> = changes.iter().map(|change| &*change.words).collect();
        let expected = ["welded 1 vertex", "dropped 1 duplicate", "turned 1 polygon"];
        assert_eq!(words, expected, "{}", repaired.edits.summary());
        let all: Vec<&Change> = changes.iter().collect();
        let at = |p: [f64; 3]| repaired.vertices.iter().position(|&q| q == p).unwrap() as u32;
        assert_eq!(all[0].vertices, [at([1.0, 1.0, 0.0])]);
        assert_eq!(all[1].triangles, repaired.triangles_of(0));
        assert_eq!(all[2].triangles, repaired.triangles_of(2));
        let turned = all[2].triangles[0];
        let parts = changes.on_refined(&[turned, 1 - turned, turned]);
        let parts: Vec<&[u32]> = parts.iter().map(|change| &*change.triangles).collect();
        assert_eq!(parts, [&[][..], &[1], &[0, 2]]);
    }
}
