//! The nodes of a scene and their transforms (glTF 2.0, section 3.5).

use super::document::{Document, Node};
use super::{malformed, not_supported};
use crate::soup::SoupError;

/// An affine map: three columns, and what is added.
#[derive(Clone, Copy, PartialEq)]
pub(super) struct Transform([[f64; 3]; 4]);

const IDENTITY: Transform =
    Transform([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0], [0.0; 3]]);

impl Transform {
    pub(super) fn is_identity(&self) -> bool {
        *self == IDENTITY
    }

    pub(super) fn of_point(&self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        let Transform([a, b, c, d]) = self;
        [0, 1, 2].map(|i| a[i] * x + b[i] * y + c[i] * z + d[i])
    }

    /// Whether it turns surfaces inside out.
    pub(super) fn mirrors(&self) -> bool {
        let Transform([a, b, c, _]) = self;
        let minor = |i: usize, j: usize| b[i] * c[j] - b[j] * c[i];
        a[0] * minor(1, 2) + a[1] * minor(2, 0) + a[2] * minor(0, 1) < 0.0
    }

    fn after(&self, first: &Transform) -> Transform {
        let mut product = first.0.map(|column| self.of_point(column));
        // The columns are directions, which nothing is added to.
        for column in &mut product[..3] {
            for (x, shift) in column.iter_mut().zip(self.0[3]) {
                *x -= shift;
            }
        }
        Transform(product)
    }

    fn of_node(node: &Node) -> Transform {
        if let Some(m) = node.matrix {
            return Transform([0, 4, 8, 12].map(|at| [m[at], m[at + 1], m[at + 2]]));
        }
        let mut columns = rotation(node.rotation.unwrap_or([0.0, 0.0, 0.0, 1.0]));
        for (column, scale) in columns.iter_mut().zip(node.scale.unwrap_or([1.0; 3])) {
            *column = column.map(|x| x * scale);
        }
        let [a, b, c] = columns;
        Transform([a, b, c, node.translation.unwrap_or_default()])
    }
}

/// The columns of the rotation that a quaternion gives, which need not be quite of length one.
fn rotation(quaternion: [f64; 4]) -> [[f64; 3]; 3] {
    let length = quaternion.iter().map(|q| q * q).sum::<f64>().sqrt();
    let [x, y, z, w] = match length {
        0.0 => [0.0, 0.0, 0.0, 1.0],
        length => quaternion.map(|q| q / length),
    };
    [
        [
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y + z * w),
            2.0 * (x * z - y * w),
        ],
        [
            2.0 * (x * y - z * w),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z + x * w),
        ],
        [
            2.0 * (x * z + y * w),
            2.0 * (y * z - x * w),
            1.0 - 2.0 * (x * x + y * y),
        ],
    ]
}

/// The meshes of the default scene, or else of the first, or else of all nodes that are no children, in
/// the order of the nodes. Where no node has a mesh, all meshes as they are.
pub(super) fn meshes(document: &Document) -> Result<Vec<(usize, Transform)>, SoupError> {
    if document.nodes.iter().all(|node| node.mesh.is_none()) {
        let all = 0..document.meshes.len();
        return Ok(all.map(|mesh| (mesh, IDENTITY)).collect());
    }
    let mut found = Vec::new();
    let mut seen = vec![false; document.nodes.len()];
    let roots = roots(document)?;
    let mut open: Vec<_> = roots.iter().rev().map(|&root| (root, IDENTITY)).collect();
    while let Some((number, above)) = open.pop() {
        let node = document.nodes.get(number);
        let node = node.ok_or_else(|| malformed(format!("there is no node {number}")))?;
        if std::mem::replace(&mut seen[number], true) {
            return Err(malformed(format!(
                "node {number} has two parents, or is its own descendant"
            )));
        }
        let instances = "EXT_mesh_gpu_instancing";
        if node.extensions.contains_key(instances) {
            return Err(not_supported(instances));
        }
        let transform = match Transform::of_node(node) {
            own if own.is_identity() => above,
            own if above.is_identity() => own,
            own => above.after(&own),
        };
        found.extend(node.mesh.map(|mesh| (mesh, transform)));
        open.extend(node.children.iter().rev().map(|&child| (child, transform)));
    }
    Ok(found)
}

fn roots(document: &Document) -> Result<Vec<usize>, SoupError> {
    let number = document.scene.unwrap_or_default();
    if let Some(scene) = document.scenes.get(number) {
        return Ok(scene.nodes.clone());
    }
    if document.scene.is_some() {
        return Err(malformed(format!("there is no scene {number}")));
    }
    let mut is_child = vec![false; document.nodes.len()];
    for &child in document.nodes.iter().flat_map(|node| &node.children) {
        if let Some(flag) = is_child.get_mut(child) {
            *flag = true;
        }
    }
    let roots: Vec<_> = (0..is_child.len())
        .filter(|&node| !is_child[node])
        .collect();
    if roots.is_empty() {
        return Err(malformed("every node is a child of another".into()));
    }
    Ok(roots)
}
