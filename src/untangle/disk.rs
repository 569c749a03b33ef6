//! A disk of faces around a vertex, its boundary, and a path from the vertex to the boundary.

use std::collections::{BTreeMap, BTreeSet, VecDeque};

use crate::mesh::TriangleMesh;

/// A disk of faces around a vertex, inside the mesh.
pub(super) struct Disk {
    /// The vertex.
    pub center: usize,
    /// The faces, those nearer to the center first.
    pub faces: Vec<usize>,
    /// The vertices that have all their faces in the disk, without the center, increasing.
    pub inside: Vec<usize>,
    /// The edges (face, local edge) of the boundary, counter-clockwise. The path crosses the last.
    pub boundary: Vec<(usize, usize)>,
    /// The edges that a path from the center to the boundary crosses. Each is given by its vertex
    /// clockwise of the path and then the other.
    pub path: Vec<[usize; 2]>,
}

impl Disk {
    /// The largest disk around the center that consists of its own faces and of faces for which
    /// `may_be_in` holds; `None` if these faces form no disk.
    pub fn around(
        mesh: &TriangleMesh,
        center: usize,
        may_be_in: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let faces = grow(mesh, center, may_be_in)?;
        let is_in: BTreeSet<usize> = faces.iter().copied().collect();
        let seen: BTreeSet<usize> = faces.iter().flat_map(|&f| mesh.corners(f)).collect();
        let path = path(mesh, center, &is_in)?;
        let boundary = boundary(mesh, &is_in, *path.last()?)?;
        let outer: BTreeSet<usize> = boundary.iter().map(|&(f, k)| mesh.corners(f)[k]).collect();
        let inside: Vec<usize> = seen
            .iter()
            .copied()
            .filter(|v| *v != center && !outer.contains(v))
            .collect();
        // Euler: a disk has F = 2 (inner vertices) + (boundary edges) - 2, the center being inner.
        let is_disk = faces.len() == 2 * (inside.len() + 1) + boundary.len() - 2;
        (is_disk && !outer.contains(&center)).then_some(Disk {
            center,
            faces,
            inside,
            boundary,
            path,
        })
    }
}

/// Adds faces one by one, nearest first, as long as the set remains a disk.
fn grow(
    mesh: &TriangleMesh,
    center: usize,
    may_be_in: impl Fn(usize) -> bool,
) -> Option<Vec<usize>> {
    let mut faces: Vec<usize> = mesh.ring(center).map(|(face, _)| face).collect();
    let mut is_in: BTreeSet<usize> = faces.iter().copied().collect();
    let corners = |face: usize| mesh.corners(face);
    let mut vertices: BTreeSet<usize> = faces.iter().flat_map(|&f| corners(f)).collect();
    if vertices.len() != faces.len() + 1 || mesh.is_boundary_vertex(center) {
        return None;
    }
    let mut front = faces.clone();
    // Faces that would close a ring or touch at a vertex wait until more faces are in the set.
    let mut waiting: BTreeSet<usize> = BTreeSet::new();
    while !front.is_empty() {
        for &face in &front {
            let beside = (0..3).filter_map(|k| Some(mesh.neighbor(face, k)?.0));
            waiting.extend(beside.filter(|&next| !is_in.contains(&next) && may_be_in(next)));
        }
        front.clear();
        for &face in &waiting {
            let is_shared = [0, 1, 2].map(|k| {
                let next = mesh.neighbor(face, k);
                next.is_some_and(|(next, _)| is_in.contains(&next))
            });
            let opposite = |k: usize| corners(face)[(k + 2) % 3];
            let fits = match is_shared.iter().filter(|s| **s).count() {
                1 => (0..3).all(|k| !is_shared[k] || !vertices.contains(&opposite(k))),
                2 => true,
                _ => false,
            };
            if fits {
                is_in.insert(face);
                front.push(face);
                vertices.extend(corners(face));
            }
        }
        waiting.retain(|face| !is_in.contains(face));
        faces.extend(&front);
    }
    Some(faces)
}

/// The edges that a shortest path of faces crosses from the first face of the center out of the set.
fn path(mesh: &TriangleMesh, center: usize, is_in: &BTreeSet<usize>) -> Option<Vec<[usize; 2]>> {
    let (first, corner) = mesh.ring(center).next()?;
    let out = (corner + 1) % 3;
    let mut came: BTreeMap<usize, (usize, usize)> = BTreeMap::new();
    let mut queue = VecDeque::from([(first, out)]);
    let mut crossed = None;
    while let Some((face, k)) = queue.pop_front() {
        let next = mesh.neighbor(face, k).map(|(next, _)| next);
        match next.filter(|next| is_in.contains(next)) {
            None => {
                crossed = Some((face, k));
                break;
            }
            Some(next) if mesh.corners(next).contains(&center) || came.contains_key(&next) => {}
            Some(next) => {
                came.insert(next, (face, k));
                let back = mesh.neighbor(face, k).map(|(_, back)| back);
                queue.extend((0..3).filter(|&l| Some(l) != back).map(|l| (next, l)));
            }
        }
    }
    let mut half_edges = vec![crossed?];
    while let Some(&before) = came.get(&half_edges.last()?.0) {
        half_edges.push(before);
    }
    half_edges.reverse();
    let ends = |&(face, k): &(usize, usize)| {
        let corners = mesh.corners(face);
        [corners[k], corners[(k + 1) % 3]]
    };
    Some(half_edges.iter().map(ends).collect())
}

/// The boundary as one loop that ends with the edge between these two vertices.
fn boundary(
    mesh: &TriangleMesh,
    is_in: &BTreeSet<usize>,
    [from, to]: [usize; 2],
) -> Option<Vec<(usize, usize)>> {
    let mut leaving = BTreeMap::new();
    for &face in is_in {
        for k in 0..3 {
            let is_out = mesh
                .neighbor(face, k)
                .is_none_or(|(g, _)| !is_in.contains(&g));
            if is_out && leaving.insert(mesh.corners(face)[k], (face, k)).is_some() {
                return None;
            }
        }
    }
    let mut round = Vec::with_capacity(leaving.len());
    let mut at = to;
    while round.len() < leaving.len() {
        let &(face, k) = leaving.get(&at)?;
        round.push((face, k));
        at = mesh.corners(face)[(k + 1) % 3];
        if at == to {
            break;
        }
    }
    let &(face, k) = round.last()?;
    (round.len() == leaving.len() && at == to && mesh.corners(face)[k] == from).then_some(round)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::shape;

    #[test]
    fn a_disk_on_a_sphere_grows_until_one_face_is_left() {
        let mesh = shape::by_name("sphere", 320).unwrap();
        for v in 0..mesh.vertex_count() {
            let disk = Disk::around(&mesh, v, |_| true).unwrap();
            assert_eq!(disk.faces.len(), mesh.face_count() - 1);
            let small = Disk::around(&mesh, v, |face| face % 3 != 0).unwrap();
            for pair in small.boundary.windows(2) {
                let [(f, k), (g, l)] = [pair[0], pair[1]];
                assert_eq!(mesh.corners(f)[(k + 1) % 3], mesh.corners(g)[l]);
            }
        }
    }
}
