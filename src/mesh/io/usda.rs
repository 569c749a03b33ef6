//! Writing of universal scene description as text (OpenUSD, `UsdGeomMesh`): one mesh of polygons,
//! which is not to be subdivided. Colours are left out.

use std::io::Write;

use super::figure::Figure;

pub(super) fn encode(figure: &Figure) -> Vec<u8> {
    let mut out = Vec::with_capacity(64 * figure.vertices.len() + 32 * figure.faces.len());
    out.extend(b"#usda 1.0\n(\n    defaultPrim = \"mesh\"\n)\n\ndef Mesh \"mesh\"\n{\n");
    let mut list = |head: &str, items: &mut dyn Iterator<Item = String>| {
        let _ = write!(out, "    {head} = [");
        for (at, item) in items.enumerate() {
            let comma = if at == 0 { "" } else { ", " };
            let _ = write!(out, "{comma}{item}");
        }
        out.extend(b"]\n");
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
    out.extend(b"    uniform token subdivisionScheme = \"none\"\n}\n");
    out
}
