//! Values of the vertices of a file beside their positions: colours, and scalar properties of PLY.
//!
//! They are in the order of the vertices of the [`PolygonSoup`](crate::soup::PolygonSoup) of the file.

use super::lines::number;
use super::statements::{Statement, Statements, words};
use super::{Format, gzip, look, ply};
use crate::soup::SoupError;

/// The colours of the vertices in the contents of a file, red, green and blue from 0 to 1; `None` if they have none.
///
/// Colours are `v x y z r g b` of OBJ, and the properties `red`, `green` and `blue` of PLY, where numbers of integer
/// types are parts of the largest. Real numbers are parts of 255 where one of the file is above 1. A vertex without a
/// colour in an OBJ file where others have one is white. Files of other formats have none.
///
/// # Errors
/// [`SoupError::Parse`] with the line for a colour that is no number, and those of [`parse`](super::parse).
pub fn vertex_colors(bytes: &[u8], format: Format) -> Result<Option<Vec<[f64; 3]>>, SoupError> {
    let bytes = &gzip::inflated(bytes)?;
    look::check(bytes, format)?;
    match format {
        Format::Obj => of_obj(bytes),
        Format::Ply => of_ply(bytes),
        _ => Ok(None),
    }
}

/// The values of a scalar property of the vertices in the contents of a PLY file.
///
/// # Errors
/// [`SoupError::Malformed`] for another format, and where the vertices have no such property: the message lists those
/// that they have. Those of [`parse`](super::parse).
pub fn vertex_property(bytes: &[u8], format: Format, name: &str) -> Result<Vec<f64>, SoupError> {
    let bytes = &gzip::inflated(bytes)?;
    look::check(bytes, format)?;
    if format != Format::Ply {
        return Err(SoupError::Malformed {
            message: format!(
                "vertices of .{} files have no properties with names: those of .ply files have",
                format.name()
            ),
        });
    }
    let names = ply::vertex_properties(bytes)?;
    if !names.iter().any(|known| known.0 == name) {
        let list: Vec<&str> = names.iter().map(|known| &*known.0).collect();
        return Err(SoupError::Malformed {
            message: format!(
                "the vertices have no property '{name}'; they have {}",
                list.join(", ")
            ),
        });
    }
    let values = ply::vertex_scalars(bytes, [name])?;
    Ok(values.into_iter().map(|[value]| value).collect())
}

fn of_ply(bytes: &[u8]) -> Result<Option<Vec<[f64; 3]>>, SoupError> {
    let channels = ["red", "green", "blue"];
    let known = ply::vertex_properties(bytes)?;
    let largest = channels.map(|name| {
        let found = known.iter().find(|known| known.0 == name);
        found.map(|known| known.1)
    });
    let [Some(red), Some(green), Some(blue)] = largest else {
        return Ok(None);
    };
    let mut colors = ply::vertex_scalars(bytes, channels)?;
    match [red, green, blue] {
        [Some(red), Some(green), Some(blue)] => {
            for [r, g, b] in &mut colors {
                (*r, *g, *b) = (*r / red, *g / green, *b / blue);
            }
        }
        _ => parts_of_255(&mut colors),
    }
    Ok(Some(colors))
}

fn of_obj(bytes: &[u8]) -> Result<Option<Vec<[f64; 3]>>, SoupError> {
    let mut colors = Vec::new();
    let mut is_colored = false;
    for (line, statement) in Statements::new(bytes) {
        let Statement::Vertex(said) = statement else {
            continue;
        };
        let mut color = [1.0; 3];
        let numbers: Vec<&[u8]> = words(&said).skip(3).collect();
        // A fourth number alone is a weight.
        if let &[r, g, b, ..] = &numbers[..] {
            for (value, word) in color.iter_mut().zip([r, g, b]) {
                *value = number(word).ok_or_else(|| SoupError::Parse {
                    line,
                    message: "the colour of a vertex is not a number".into(),
                })?;
            }
            is_colored = true;
        }
        colors.push(color);
    }
    parts_of_255(&mut colors);
    Ok(is_colored.then_some(colors))
}

/// Makes numbers from 0 to 255 those from 0 to 1.
fn parts_of_255(colors: &mut [[f64; 3]]) {
    if colors.as_flattened().iter().any(|&x| x > 1.0) {
        for x in colors.as_flattened_mut() {
            *x /= 255.0;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const PLY: &str = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\n\
        property float z\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty double size\n\
        property list uchar int near\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n\
        0 0 0 255 0 51 0.5 2 1 1\n1 0 0 0 255 255 2.5 0\n";

    #[test]
    fn colours_and_properties_of_ply_are_read() {
        let colors = vertex_colors(PLY.as_bytes(), Format::Ply).unwrap().unwrap();
        assert_eq!(colors, [[1.0, 0.0, 0.2], [0.0, 1.0, 1.0]]);
        let sizes = vertex_property(PLY.as_bytes(), Format::Ply, "size").unwrap();
        assert_eq!(sizes, [0.5, 2.5]);
        let real = PLY.replace("uchar red", "float red");
        let colors = vertex_colors(real.as_bytes(), Format::Ply)
            .unwrap()
            .unwrap();
        assert_eq!(colors[0], [1.0, 0.0, 0.2]);
        let plain = PLY.replace("uchar red", "uchar rot");
        assert_eq!(vertex_colors(plain.as_bytes(), Format::Ply), Ok(None));
    }

    #[test]
    fn a_property_that_is_not_there_is_told_with_those_that_are() {
        for name in ["length", "near", ""] {
            let error = vertex_property(PLY.as_bytes(), Format::Ply, name).unwrap_err();
            let text = error.to_string();
            assert!(text.contains("x, y, z, red, green, blue, size"), "{text}");
            assert!(!text.contains(", near"), "{text}");
        }
        let error = vertex_property(b"v 0 0 0\n", Format::Obj, "size").unwrap_err();
        assert!(error.to_string().contains(".ply"), "{error}");
    }

    #[test]
    fn colours_of_obj_are_parts_of_1_or_of_255() {
        let of = |text: &str| vertex_colors(text.as_bytes(), Format::Obj);
        let found = of("v 0 0 0 1 0.5 0\nv 1 0 0\nv 1 1 0 1.0\n")
            .unwrap()
            .unwrap();
        assert_eq!(found, [[1.0, 0.5, 0.0], [1.0; 3], [1.0; 3]]);
        let found = of("v 0 0 0 255 51 0\nv 1 0 0 0 0 255\n").unwrap().unwrap();
        assert_eq!(found, [[1.0, 0.2, 0.0], [0.0, 0.0, 1.0]]);
        assert_eq!(of("v 0 0 0\nv 1 0 0 1\n"), Ok(None));
        let error = of("v 0 0 0\nv 1 0 0 1 red 0\n").unwrap_err();
        assert!(matches!(error, SoupError::Parse { line: 2, .. }), "{error}");
        assert_eq!(vertex_colors(b"OFF\n0 0 0\n", Format::Off), Ok(None));
    }
}
