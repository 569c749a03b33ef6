//! The edit list: what repair did, one entry for each thing done.

/// Makes the enum of kinds from one table.
macro_rules! kinds {
    ($($(#[$doc:meta])* $kind:ident = $number:literal, $name:literal, $summary:literal,
        $element:expr, $other:expr;)*) => {
        /// What was done. Names and numbers are stable.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        #[repr(i32)]
        pub enum EditKind {
            $($(#[$doc])* $kind = $number,)*
        }

        impl EditKind {
            /// All kinds, in the order of their numbers, which is that of the steps.
            pub const ALL: [EditKind; [$($number),*].len()] = [$(EditKind::$kind),*];

            /// Its name in files and in other languages.
            pub fn name(self) -> &'static str {
                match self {
                    $(EditKind::$kind => $name,)*
                }
            }

            /// What [`Edit::element`] counts.
            pub fn element(self) -> &'static str {
                match self {
                    $(EditKind::$kind => $element,)*
                }
            }

            /// What [`Edit::other`] counts, if anything.
            pub fn other(self) -> Option<&'static str> {
                match self {
                    $(EditKind::$kind => $other,)*
                }
            }

            /// Its part of a summary; `#` stands for the number.
            fn summary(self) -> &'static str {
                match self {
                    $(EditKind::$kind => $summary,)*
                }
            }
        }
    };
}

kinds! {
    /// A vertex with a coordinate that is no finite number was dropped.
    VertexNotFinite = 0, "vertex_not_finite", "dropped # not finite vertex|vertices", "input vertex", None;
    /// A polygon with such a vertex was dropped.
    PolygonNotFinite = 1, "polygon_not_finite", "dropped # not finite polygon|polygons",
        "input polygon", Some("input vertex that is not finite");
    /// A polygon that names a vertex that is not there was dropped.
    PolygonOutOfRange = 2, "polygon_out_of_range", "dropped # polygon|polygons with missing vertices",
        "input polygon", Some("corner that names no vertex");
    /// A vertex was welded to another one.
    VertexWelded = 3, "vertex_welded", "welded # vertex|vertices",
        "input vertex", Some("input vertex that stays");
    /// Corners of a polygon that repeat were removed.
    CornersRemoved = 4, "corners_removed", "removed repeated corners of # polygon|polygons",
        "input polygon", Some("number of corners removed");
    /// A polygon of fewer than three different corners was dropped.
    PolygonDegenerate = 5, "polygon_degenerate", "dropped # degenerate polygon|polygons",
        "input polygon", None;
    /// A polygon of more than three corners was triangulated.
    PolygonTriangulated = 6, "polygon_triangulated", "triangulated # polygon|polygons",
        "input polygon", Some("number of triangles");
    /// A triangle with the corners and the direction of an earlier one was dropped.
    DuplicateDropped = 7, "duplicate_dropped", "dropped # duplicate|duplicates",
        "input polygon", Some("input polygon that stays");
    /// A triangle that runs against one with the same corners was dropped.
    OppositeDropped = 8, "opposite_dropped", "dropped # opposite|opposites",
        "input polygon", Some("input polygon that it runs against");
    /// A vertex of a triangle without area was merged with the vertex next to it.
    EdgeCollapsed = 9, "edge_collapsed", "collapsed # edge|edges without length",
        "input vertex", Some("input vertex that stays");
    /// A triangle with a vertex on its opposite edge gave way: the others at that edge were split there.
    CapFlipped = 10, "cap_flipped", "flipped # triangle|triangles without area",
        "input polygon", Some("input vertex on the edge");
    /// A triangle without area that could not be collapsed or flipped was dropped.
    SliverDropped = 11, "sliver_dropped", "dropped # triangle|triangles without area",
        "input polygon", None;
    /// A polygon was turned, so that it runs like its neighbors.
    PolygonTurned = 12, "polygon_turned", "turned # polygon|polygons", "input polygon", None;
    /// A closed component in which polygons were turned was turned outwards as a whole.
    ComponentTurned = 13, "component_turned", "turned # component|components outwards",
        "lowest input polygon of the component", Some("number of triangles");
    /// An edge was cut open: it had more than two faces, or its faces cannot run alike.
    EdgeCut = 14, "edge_cut", "cut # edge|edges",
        "input vertex at one end", Some("input vertex at the other end");
    /// A vertex became several, one for each fan of its faces.
    VertexSplit = 15, "vertex_split", "split # vertex|vertices",
        "input vertex", Some("number of vertices that it became");
    /// A second edge between the same vertices got a vertex in its middle.
    EdgeHalved = 16, "edge_halved", "halved # edge|edges",
        "input vertex at one end", Some("input vertex at the other end");
    /// A vertex without faces was dropped.
    VertexUnused = 17, "vertex_unused", "dropped # unused vertex|vertices", "input vertex", None;
    /// A component below the share of the area that was asked for was dropped.
    ComponentDropped = 18, "component_dropped", "dropped # small component|components",
        "lowest input polygon of the component", Some("number of triangles");
    /// A hole was filled.
    HoleFilled = 19, "hole_filled", "filled # hole|holes",
        "an input vertex on its rim", Some("number of edges");
}

/// One thing done.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Edit {
    /// What was done.
    pub kind: EditKind,
    /// To what; [`EditKind::element`] says what it counts.
    pub element: u32,
    /// The second number, where [`EditKind::other`] says that there is one.
    pub other: Option<u32>,
}

/// All things done, in the order of the steps.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Edits {
    list: Vec<Edit>,
    counts: [usize; EditKind::ALL.len()],
}

impl Edits {
    pub(super) fn add(&mut self, kind: EditKind, element: u32, other: impl Into<Option<u32>>) {
        let other = other.into();
        debug_assert_eq!(other.is_some(), kind.other().is_some(), "{kind:?}");
        self.list.push(Edit {
            kind,
            element,
            other,
        });
        self.counts[kind as usize] += 1;
    }

    /// The edits, step by step.
    pub fn list(&self) -> &[Edit] {
        &self.list
    }

    /// How often this was done.
    pub fn count(&self, kind: EditKind) -> usize {
        self.counts[kind as usize]
    }

    /// Whether nothing was done: the soup is what the strict mesh accepts.
    pub fn is_empty(&self) -> bool {
        self.list.is_empty()
    }

    /// One line for people, such as "welded 12 vertices, split 3 vertices"; empty if nothing was done.
    pub fn summary(&self) -> String {
        let part = |&kind: &EditKind| {
            let count = self.count(kind);
            (count > 0).then(|| told(kind.summary(), count))
        };
        let parts: Vec<_> = EditKind::ALL.iter().filter_map(part).collect();
        parts.join(", ")
    }
}

/// Puts the number in, and of "one|many" the word that goes with it.
fn told(pattern: &str, count: usize) -> String {
    let word = |word: &str| match word.split_once('|') {
        _ if word == "#" => count.to_string(),
        Some((one, many)) => if count == 1 { one } else { many }.to_owned(),
        None => word.to_owned(),
    };
    pattern.split(' ').map(word).collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_follow_the_list_and_names_differ() {
        for (number, kind) in EditKind::ALL.into_iter().enumerate() {
            assert_eq!(kind as usize, number);
            let same = |other: &EditKind| other.name() == kind.name();
            assert_eq!(EditKind::ALL.iter().filter(|o| same(o)).count(), 1);
        }
    }

    #[test]
    fn a_summary_counts_and_inflects() {
        let mut edits = Edits::default();
        assert_eq!((edits.summary(), edits.is_empty()), (String::new(), true));
        edits.add(EditKind::VertexSplit, 3, 2);
        edits.add(EditKind::VertexWelded, 1, 0);
        edits.add(EditKind::VertexWelded, 2, 0);
        assert_eq!(edits.summary(), "welded 2 vertices, split 1 vertex");
        assert_eq!(edits.count(EditKind::VertexWelded), 2);
        assert_eq!(edits.list()[0].kind, EditKind::VertexSplit);
    }
}
