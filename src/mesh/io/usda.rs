//! Writing of universal scene description as text (OpenUSD, `UsdGeomMesh`): one mesh of polygons,
//! which is not to be subdivided, with its attributes as primvars and subsets of faces (`usda_attributes`).

use std::io::Write;

use super::figure::Figure;
use super::usda_attributes::{MATERIAL_API, add_primvars, add_subsets};

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * figure.vertices.len() + 32 * figure.faces.len());
    out.extend(b"#usda 1.0\n(\n    defaultPrim = \"mesh\"\n)\n\ndef Mesh \"mesh\"");
    if figure.attributes.is_some_and(|a| a.materials.is_some()) {
        let _ = write!(out, " (\n    {MATERIAL_API}\n)");
    }
    out.extend(b"\n{\n");
    let mut list = |head: &str, items: &mut dyn Iterator<Item = String>| {
        add_list(&mut out, &format!("    {head}"), items);
        out.push(b'\n');
    };
    let point = |[x, y, z]: &[f64; 3]| format!("({x}, {y}, {z})");
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for position in figure.vertices {
        for axis in 0..3 {
            bounds[0][axis] = bounds[0][axis].min(position[axis]);
            bounds[1][axis] = bounds[1][axis].max(position[axis]);
        }
    }
    if !figure.vertices.is_empty() {
        list("float3[] extent", &mut bounds.iter().map(point));
    }
    let counts = figure.faces.iter().map(|face| face.len().to_string());
    list("int[] faceVertexCounts", &mut { counts });
    let corners = figure.faces.iter().copied().flatten();
    list("int[] faceVertexIndices", &mut corners.map(u32::to_string));
    list("point3f[] points", &mut figure.vertices.iter().map(point));
    if let Some(attributes) = figure.attributes {
        add_primvars(&mut out, attributes);
    }
    out.extend(b"    uniform token subdivisionScheme = \"none\"\n");
    if let Some(attributes) = figure.attributes {
        add_subsets(&mut out, attributes);
    }
    out.extend(b"}\n");
    out
}

/// Adds `HEAD = [A, B, C]`.
pub(super) fn add_list(out: &mut Vec<u8>, head: &str, items: &mut dyn Iterator<Item = String>) {
    let _ = write!(out, "{head} = [");
    for (at, item) in items.enumerate() {
        let comma = if at == 0 { "" } else { ", " };
        let _ = write!(out, "{comma}{item}");
    }
    out.push(b']');
}
