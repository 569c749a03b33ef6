//! Step 1: what is not finite, and what names vertices that are not there, is dropped.

use super::PolygonSoup;
use super::edits::{EditKind, Edits};
use super::lists::NONE;

/// Which polygons have vertices only that are there and finite; the others are told.
pub(super) fn usable(soup: &PolygonSoup, stands_for: &[u32], edits: &mut Edits) -> Vec<bool> {
    let missing = |&v: &i64| v < 0 || v >= stands_for.len() as i64;
    let check = |(number, polygon): (usize, &[i64])| {
        let number = number as u32;
        if let Some(corner) = polygon.iter().position(missing) {
            edits.add(EditKind::PolygonOutOfRange, number, corner as u32);
            return false;
        }
        let infinite = |&&v: &&i64| stands_for[v as usize] == NONE;
        if let Some(&v) = polygon.iter().find(infinite) {
            edits.add(EditKind::PolygonNotFinite, number, v as u32);
            return false;
        }
        true
    };
    soup.polygons().enumerate().map(check).collect()
}
