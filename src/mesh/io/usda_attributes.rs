//! The attributes of a mesh as USD text.
//!
//! Colours, texture coordinates and numbers are primvars (`UsdGeomPrimvarsAPI`). Each material and each group is a
//! `UsdGeomSubset` of faces; those of materials are bound to a `Material` of the name, which says nothing more.

use std::collections::HashSet;
use std::io::Write;

use super::usda::add_list;
use crate::mesh::attributes::{FaceNames, SurfaceAttributes};

/// The metadata of what has a material.
pub(super) const MATERIAL_API: &str = "prepend apiSchemas = [\"MaterialBindingAPI\"]";

pub(super) fn add_primvars(out: &mut Vec<u8>, attributes: &SurfaceAttributes) {
    // There is one colour to be shown.
    let colors = match (&attributes.vertex_colors, &attributes.face_colors) {
        (Some(colors), _) => Some((colors, "vertex")),
        (None, Some(colors)) => Some((colors, "uniform")),
        (None, None) => None,
    };
    // What has no colour is white.
    let channel = |x: f64| if x.is_nan() { 1.0 } else { x };
    if let Some((colors, each)) = colors {
        let color = |c: &[f64; 4]| {
            let [r, g, b, _] = c.map(channel);
            format!("({r}, {g}, {b})")
        };
        add_primvar(
            out,
            "color3f",
            "displayColor",
            each,
            &mut colors.iter().map(color),
        );
        if colors.iter().any(|c| channel(c[3]) < 1.0) {
            let opacity = |c: &[f64; 4]| channel(c[3]).to_string();
            add_primvar(
                out,
                "float",
                "displayOpacity",
                each,
                &mut colors.iter().map(opacity),
            );
        }
    }
    if let Some(uv) = &attributes.uv {
        let point = |&[u, v]: &[f64; 2]| match u.is_nan() || v.is_nan() {
            true => "(0, 0)".to_owned(),
            false => format!("({u}, {v})"),
        };
        add_primvar(
            out,
            "texCoord2f",
            "st",
            "faceVarying",
            &mut uv.iter().map(point),
        );
    }
    let mut identifiers = Identifiers::of(&["displayColor", "displayOpacity", "st"]);
    for scalar in &attributes.scalars {
        let number = |x: &f64| match x.is_nan() {
            true => "nan".to_owned(),
            false => x.to_string(),
        };
        let name = identifiers.of_name(&scalar.name);
        add_primvar(
            out,
            "double",
            &name,
            "vertex",
            &mut scalar.values.iter().map(number),
        );
    }
}

fn add_primvar(
    out: &mut Vec<u8>,
    kind: &str,
    name: &str,
    each: &str,
    items: &mut dyn Iterator<Item = String>,
) {
    add_list(out, &format!("    {kind}[] primvars:{name}"), items);
    let _ = writeln!(out, " (\n        interpolation = \"{each}\"\n    )");
}

pub(super) fn add_subsets(out: &mut Vec<u8>, attributes: &SurfaceAttributes) {
    if let Some(names) = &attributes.groups {
        for (number, name, faces) in subsets(names) {
            add_head(
                out,
                &format!("def GeomSubset \"group_{number}\""),
                &[&shown(name)],
            );
            add_faces(out, "group", &faces);
            out.extend(b"    }\n");
        }
    }
    let Some(names) = &attributes.materials else {
        return;
    };
    out.extend(b"    uniform token subsetFamily:materialBind:familyType = \"nonOverlapping\"\n");
    let mut identifiers = Identifiers::of(&[]);
    let mut materials = Vec::new();
    for (number, name, faces) in subsets(names) {
        let identifier = identifiers.of_name(name);
        let head = format!("def GeomSubset \"material_{number}\"");
        add_head(out, &head, &[MATERIAL_API]);
        add_faces(out, "materialBind", &faces);
        let _ = writeln!(
            out,
            "        rel material:binding = </mesh/materials/{identifier}>\n    }}"
        );
        materials.push((identifier, name));
    }
    out.extend(b"    def Scope \"materials\"\n    {\n");
    for (identifier, name) in materials {
        let _ = writeln!(
            out,
            "        def Material \"{identifier}\" (\n            {}\n        )\n        {{\n        }}",
            shown(name)
        );
    }
    out.extend(b"    }\n");
}

fn add_head(out: &mut Vec<u8>, head: &str, metadata: &[&str]) {
    let _ = writeln!(out, "    {head} (");
    for line in metadata {
        let _ = writeln!(out, "        {line}");
    }
    out.extend(b"    )\n    {\n");
}

fn add_faces(out: &mut Vec<u8>, family: &str, faces: &[usize]) {
    let _ = writeln!(
        out,
        "        uniform token elementType = \"face\"\n        uniform token familyName = \"{family}\""
    );
    add_list(
        out,
        "        int[] indices",
        &mut faces.iter().map(usize::to_string),
    );
    out.push(b'\n');
}

/// Each name that faces have, with its number and these faces.
fn subsets(names: &FaceNames) -> impl Iterator<Item = (usize, &str, Vec<usize>)> {
    let mut faces = vec![Vec::new(); names.names.len()];
    for (face, &label) in names.of_face.iter().enumerate() {
        if let Some(faces) = faces.get_mut(label as usize) {
            faces.push(face);
        }
    }
    let all = names.names.iter().zip(faces).enumerate();
    let all = all.map(|(number, (name, faces))| (number, name.as_str(), faces));
    all.filter(|(.., faces)| !faces.is_empty())
}

/// The name as people gave it.
fn shown(name: &str) -> String {
    let escaped: String = name
        .chars()
        .filter(|c| !c.is_control())
        .flat_map(|c| {
            ['\\']
                .into_iter()
                .filter(move |_| matches!(c, '"' | '\\'))
                .chain([c])
        })
        .collect();
    format!("displayName = \"{escaped}\"")
}

/// Names of USD have letters, digits and underscores; no two are equal.
struct Identifiers(HashSet<String>);

impl Identifiers {
    fn of(taken: &[&str]) -> Self {
        Identifiers(taken.iter().map(|&name| name.to_owned()).collect())
    }

    fn of_name(&mut self, name: &str) -> String {
        let allowed = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut found: String = name.chars().map(allowed).collect();
        if !found.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
            found.insert(0, '_');
        }
        while !self.0.insert(found.clone()) {
            found.push('_');
        }
        found
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn identifiers_are_allowed_and_differ() {
        let mut identifiers = Identifiers::of(&["st"]);
        for (name, expected) in [
            ("st", "st_"),
            ("dark blue", "dark_blue"),
            ("dark-blue", "dark_blue_"),
            ("3d", "_3d"),
            ("", "_"),
            ("\u{e4}", "__"),
        ] {
            assert_eq!(identifiers.of_name(name), expected);
        }
        assert_eq!(shown("a \"b\" \\"), "displayName = \"a \\\"b\\\" \\\\\"");
    }
}
