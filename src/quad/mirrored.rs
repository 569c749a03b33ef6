//! Quads that are mirrored: the mesh is cut by its mirror planes, the part on one side is turned into quads
//! with the cut as a feature, and the other parts are its mirror images.

use super::final_error::is_final;
use super::mirror_images::{Seams, with_image};
use super::quadrangulate::unmirrored;
use super::refined_input::{check_faces, divided};
use super::size_metric::SizeMetric;
use super::tries::smaller;
use super::{Near, QuadOptions, Quadrangulation};
use crate::error::{Error, Result};
use crate::extract::Origin;
use crate::mesh::features::FeatureGraph;
use crate::mesh::mirror::{Half, MirrorPlane, mirror_planes};
use crate::mesh::vector::{Vec3, add, scale};
use crate::mesh::{ClosestPoint, TriangleMesh, barycentric};
use crate::monitor::{Monitor, optional, with_threads};
use crate::smooth::SmoothOptions;

/// How many times as many quads are tried where those of the part conform but leave gaps along the seam.
const MORE: [f64; 2] = [1.1, 1.25];

/// The part of a mesh that was turned into quads, and the planes that its mirror images are behind.
#[derive(Debug, Clone)]
pub struct Mirrored {
    /// The planes, in the order of [`QuadOptions::mirror`].
    pub planes: Vec<MirrorPlane>,
    /// The part of the mesh on the side of their normals. Field and map belong to it, or to it refined.
    pub half: Half,
}

/// The quads of the part on one side of the planes, and their mirror images. Where quads of the part conform but leave
/// gaps along the seam, more of them are tried.
///
/// # Errors
/// Those of [`mirror_planes`], [`Half::new`] and [`quadrangulate`](super::quadrangulate()), and
/// [`Error::InvalidArgument`] for indices that are prescribed.
pub(super) fn mirrored<'a>(
    mesh: &TriangleMesh,
    options: &QuadOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<Quadrangulation> {
    let (planes, half, given) = with_threads(options.field.threads, || {
        let (_watch, _memory) = (monitor().watch(), mesh.watch_memory());
        options.sizing.check(mesh)?;
        SizeMetric::check(mesh, options)?;
        let planes = mirror_planes(mesh, &options.mirror, options.mirror_tolerance)?;
        let half = Half::new(mesh, &planes)?;
        let given = of_half(mesh, &half, options)?;
        Ok::<_, Error>((planes, half, given))
    })?;
    let run = monitor().run();
    let monitor = || monitor().of_run(&run);
    let made = unmirrored(&half.mesh, &given, &monitor)?;
    let part_conforms = made.quads.is_conforming();
    let first = with_images(mesh, &planes, &half, made);
    if !part_conforms || first.quads.is_conforming() {
        return Ok(first);
    }
    for more in MORE {
        let other = QuadOptions {
            sizing: smaller(&given.sizing, more),
            ..given.clone()
        };
        let again = optional(&monitor, || {
            run.with_share([1.0, 1.0], || unmirrored(&half.mesh, &other, &monitor))
        });
        match again {
            Ok(None) => break,
            Ok(Some(made)) => {
                let found = with_images(mesh, &planes, &half, made);
                if found.quads.is_conforming() {
                    return Ok(found);
                }
            }
            Err(error) if is_final(&error) => return Err(error),
            // The quads that there are remain.
            Err(_) => {}
        }
    }
    Ok(first)
}

/// The options for the part.
fn of_half(mesh: &TriangleMesh, half: &Half, options: &QuadOptions) -> Result<QuadOptions> {
    if options.guidance.indices.is_some() {
        return Err(Error::InvalidArgument {
            what: "indices are prescribed for the whole mesh, and only a part of one that is mirrored has a field: leave out one of both".into(),
            index: None,
        });
    }
    check_faces(mesh, &options.guidance)?;
    let wanted = options.guidance.features(mesh)?;
    let mut features = half.parts_of(|edge| wanted.contains(edge));
    let mut guidance = divided(mesh, &options.guidance, &half.mesh, &half.face_origin, &[]);
    features.extend(&half.seam);
    guidance.feature_edges = features;
    let smooth = match &options.smooth {
        Some(given) => {
            let kept = FeatureGraph::from_edges(mesh, &given.features)?;
            Some(SmoothOptions {
                features: half.parts_of(|edge| kept.contains(edge)),
                ..given.clone()
            })
        }
        None => None,
    };
    let images = 1 << options.mirror.len();
    let is_near = |&v: &usize| {
        let origin = half.vertex_origin[v];
        origin.is_some_and(|w| options.near_vertices.contains(&(w as usize)))
    };
    let near_vertices: Vec<usize> = (0..half.mesh.vertex_count()).filter(is_near).collect();
    let sizing = options.sizing.on_faces(&half.face_origin);
    Ok(QuadOptions {
        sizing: match options.sizing.quads() {
            Some(quads) => sizing.with_quads(quads.div_ceil(images)),
            None => sizing,
        },
        guidance,
        smooth,
        density: of_vertices(mesh, half, &options.density),
        near: match options.near {
            Near::Vertices if near_vertices.is_empty() => Near::Nothing,
            near => near,
        },
        near_vertices,
        mirror: Vec::new(),
        ..options.clone()
    })
}

/// The values of the part's vertices; those that the cut made have the mean of a face of the mesh beside them.
fn of_vertices(mesh: &TriangleMesh, half: &Half, values: &[f64]) -> Vec<f64> {
    if values.is_empty() {
        return Vec::new();
    }
    let of = |v: usize| match half.vertex_origin[v] {
        Some(origin) => values[origin as usize],
        None => half.mesh.ring(v).next().map_or(1.0, |(face, _)| {
            let corners = mesh.corners(half.face_origin[face] as usize);
            corners.iter().map(|&w| values[w]).sum::<f64>() / 3.0
        }),
    };
    (0..half.mesh.vertex_count()).map(of).collect()
}

/// The result for the whole mesh, with elements of the given mesh where it names elements.
fn with_images(
    mesh: &TriangleMesh,
    planes: &[MirrorPlane],
    half: &Half,
    made: Quadrangulation,
) -> Quadrangulation {
    let mut quads = made.quads;
    let kept = quads.vertices.len();
    let mut seams = Seams::of_quads(&mut quads, planes, half);
    let mut of_mesh = Seams::of_half(half);
    for (k, plane) in planes.iter().enumerate() {
        of_mesh.count_image(k);
        with_image(&mut quads, &mut seams, plane, k, of_mesh.euler());
    }
    quads.expected_euler = of_mesh.euler();
    let tree = ClosestPoint::new(mesh);
    for v in 0..quads.origins.len() {
        let (origin, at) = (quads.origins[v], quads.vertices[v]);
        quads.origins[v] = given_place(mesh, half, &tree, origin, (v < kept).then_some(at), at);
    }
    quads.folded = given(quads.folded.iter().map(|&f| half.face_origin[f]));
    let edges = |of: Vec<usize>| given(of.into_iter().filter_map(|e| half.edge_origin[e]));
    let faces = |of: &[usize]| given(of.iter().map(|&f| half.face_origin[f]));
    Quadrangulation {
        quads,
        features: edges(made.features),
        missed_features: edges(made.missed_features),
        apart: faces(&made.apart),
        paired: faces(&made.paired),
        mirrored: Some(Mirrored {
            planes: planes.to_vec(),
            half: half.clone(),
        }),
        ..made
    }
}

fn given(numbers: impl Iterator<Item = u32>) -> Vec<usize> {
    let mut numbers: Vec<usize> = numbers.map(|n| n as usize).collect();
    numbers.sort_unstable();
    numbers.dedup();
    numbers
}

/// The place on the given mesh of a vertex of the quads: that of its place on the part, or, of a mirror
/// image, the closest to it.
fn given_place(
    mesh: &TriangleMesh,
    half: &Half,
    tree: &ClosestPoint,
    place: Origin,
    kept: Option<Vec3>,
    at: Vec3,
) -> Origin {
    let (point, hint) = match place {
        Origin::Middle => return place,
        _ if kept.is_none() => (at, None),
        Origin::Vertex(v) => match half.vertex_origin[v] {
            Some(vertex) => return Origin::Vertex(vertex as usize),
            None => (half.mesh.position(v), None),
        },
        Origin::Face(face, weights) => {
            let corners = half.mesh.corner_positions(face);
            let point = (0..3).fold([0.0; 3], |p, k| add(p, scale(corners[k], weights[k])));
            (point, Some(half.face_origin[face] as usize))
        }
    };
    match tree.find(point, hint) {
        Some((face, foot)) => Origin::Face(face, barycentric(mesh.corner_positions(face), foot)),
        None => place,
    }
}

#[cfg(test)]
mod tests {
    use super::super::mirror_tests::asymmetric;
    use super::super::pairs::Paired;
    use super::*;
    use crate::mesh::shape::by_name;

    /// The half has a boundary on the plane. A triangle there that is a quad alone has a vertex on the plane.
    #[test]
    fn pairs_of_triangles_are_mirrored() {
        for name in ["torus", "sphere", "plate-with-holes"] {
            let mesh = by_name(name, 700).unwrap();
            let options = QuadOptions {
                mirror: vec!["x".parse().unwrap()],
                ..QuadOptions::default()
            };
            let planes = mirror_planes(&mesh, &options.mirror, options.mirror_tolerance).unwrap();
            let half = Half::new(&mesh, &planes).unwrap();
            let given = of_half(&mesh, &half, &options).unwrap();
            let mut made = unmirrored(&half.mesh, &given, &Monitor::default).unwrap();
            let paired = Paired::new(&half.mesh, &given, &Monitor::default).unwrap();
            paired.replace(&mut made, &half.mesh);
            let whole = with_images(&mesh, &planes, &half, made);
            assert!(
                whole.quads.is_conforming(),
                "{name}: {:?}",
                whole.quads.figures()
            );
            assert_eq!(asymmetric(&whole.quads, &planes[0], 0.0), 0, "{name}");
            let is_of_mesh = whole.paired.iter().all(|&f| f < mesh.face_count());
            assert!(is_of_mesh && whole.paired.is_sorted() && !whole.paired.is_empty());
        }
    }
}
