//! The kinds of edits, as numbers and words.

use std::ffi::{CString, c_char};
use std::sync::OnceLock;

use crate::soup::EditKind;

/// What repair did. Vertices and polygons are those of the soup, by their numbers. The numbers of kinds
/// never change; new ones may be added.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_edit_kind {
    /// A vertex with a coordinate that is no finite number was dropped.
    /// Element: vertex.
    ROUNDEL_EDIT_VERTEX_NOT_FINITE = 0,
    /// A polygon with such a vertex was dropped.
    /// Element: polygon; other: vertex that is not finite.
    ROUNDEL_EDIT_POLYGON_NOT_FINITE = 1,
    /// A polygon that names a vertex that is not there was dropped.
    /// Element: polygon; other: corner that names no vertex.
    ROUNDEL_EDIT_POLYGON_OUT_OF_RANGE = 2,
    /// A vertex was welded to another one.
    /// Element: vertex; other: vertex that stays.
    ROUNDEL_EDIT_VERTEX_WELDED = 3,
    /// Corners of a polygon that repeat were removed.
    /// Element: polygon; other: number of corners removed.
    ROUNDEL_EDIT_CORNERS_REMOVED = 4,
    /// A polygon of fewer than three different corners was dropped.
    /// Element: polygon.
    ROUNDEL_EDIT_POLYGON_DEGENERATE = 5,
    /// A polygon of more than three corners was triangulated.
    /// Element: polygon; other: number of triangles.
    ROUNDEL_EDIT_POLYGON_TRIANGULATED = 6,
    /// A triangle with the corners and the direction of an earlier one was dropped.
    /// Element: polygon; other: polygon that stays.
    ROUNDEL_EDIT_DUPLICATE_DROPPED = 7,
    /// A triangle that runs against one with the same corners was dropped.
    /// Element: polygon; other: polygon that it runs against.
    ROUNDEL_EDIT_OPPOSITE_DROPPED = 8,
    /// A vertex of a triangle without area was merged with the vertex next to it.
    /// Element: vertex; other: vertex that stays.
    ROUNDEL_EDIT_EDGE_COLLAPSED = 9,
    /// A triangle with a vertex on its opposite edge gave way: the others at that edge were split there.
    /// Element: polygon; other: vertex on the edge.
    ROUNDEL_EDIT_CAP_FLIPPED = 10,
    /// A triangle without area that could not be collapsed or flipped was dropped.
    /// Element: polygon.
    ROUNDEL_EDIT_SLIVER_DROPPED = 11,
    /// A polygon was turned, so that it runs like its neighbors.
    /// Element: polygon.
    ROUNDEL_EDIT_POLYGON_TURNED = 12,
    /// A closed component in which polygons were turned was turned outwards as a whole.
    /// Element: lowest polygon of the component; other: number of triangles.
    ROUNDEL_EDIT_COMPONENT_TURNED = 13,
    /// An edge was cut open: it had more than two faces, or its faces cannot run alike.
    /// Element: vertex at one end; other: vertex at the other end.
    ROUNDEL_EDIT_EDGE_CUT = 14,
    /// A vertex became several, one for each fan of its faces.
    /// Element: vertex; other: number of vertices that it became.
    ROUNDEL_EDIT_VERTEX_SPLIT = 15,
    /// A second edge between the same vertices got a vertex in its middle.
    /// Element: vertex at one end; other: vertex at the other end.
    ROUNDEL_EDIT_EDGE_HALVED = 16,
    /// A vertex without faces was dropped.
    /// Element: vertex.
    ROUNDEL_EDIT_VERTEX_UNUSED = 17,
    /// A component below the share of the area that was asked for was dropped.
    /// Element: lowest polygon of the component; other: number of triangles.
    ROUNDEL_EDIT_COMPONENT_DROPPED = 18,
    /// A hole was filled.
    /// Element: an vertex on its rim; other: number of edges.
    ROUNDEL_EDIT_HOLE_FILLED = 19,
}

/// The word for a kind of edit, such as "vertex_welded"; "unknown" for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_edit_kind_name(kind: i32) -> *const c_char {
    static NAMES: OnceLock<Vec<CString>> = OnceLock::new();
    let names = NAMES.get_or_init(|| {
        // The names are ours and hold no NUL, which would show as an empty text.
        let names = EditKind::ALL.iter().map(|kind| CString::new(kind.name()));
        names.map(Result::unwrap_or_default).collect()
    });
    let found = usize::try_from(kind).ok().and_then(|kind| names.get(kind));
    found.map_or(c"unknown", CString::as_c_str).as_ptr()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::ffi::CStr;

    fn name(kind: i32) -> &'static str {
        // SAFETY: the function gives a text that lives as long as the library.
        let name = unsafe { CStr::from_ptr(roundel_edit_kind_name(kind)) };
        name.to_str().unwrap()
    }

    #[test]
    fn the_kinds_in_the_header_are_those_of_rust_with_their_numbers() {
        let header = include_str!("../../include/roundel/roundel.h").lines();
        let kinds = header.filter_map(|line| {
            let (kind, number) = line.trim().trim_end_matches(',').split_once(" = ")?;
            let kind = kind.strip_prefix("ROUNDEL_EDIT_")?.to_lowercase();
            Some((kind, number.parse().unwrap()))
        });
        let ours = EditKind::ALL.map(|kind| (kind.name().to_owned(), kind as i32));
        assert_eq!(kinds.collect::<Vec<_>>(), ours);
    }

    #[test]
    fn the_word_for_a_kind_is_that_of_rust() {
        for kind in EditKind::ALL {
            assert_eq!(name(kind as i32), kind.name());
        }
        for none in [-1, EditKind::ALL.len() as i32, i32::MAX, i32::MIN] {
            assert_eq!(name(none), "unknown");
        }
    }
}
