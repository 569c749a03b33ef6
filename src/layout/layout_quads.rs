//! From a layout to quads, step by step: [`layout_quads`].
//!
//! ```text
//! nodes         vertices of the layout on the surface; curves that are given are cut into it
//! embedding     arcs are laid as shortest paths
//! subdivisions  numbers of edges along arcs are decided, with a proof
//! rectangles    patches of other than four sides are divided by spokes
//! grid          a map of all patches, whose arcs slide until it is smooth
//! quads         extraction, comparison with what is prescribed, and smoothing
//! ```

use super::base_layout::BaseLayout;
use super::correspondence::{Correspondence, correspondence};
use super::embed::surface::Surface;
use super::embed::{embed, is_turned_over, place_nodes};
use super::given::GivenCurves;
use super::grid::{Grid, Motion};
use super::rectangles::Rectangles;
use super::subdivide::{LayoutSizing, Subdividing, Subdivisions};
use crate::error::{Error, Result};
use crate::extract::{IntegerGridMap, Origin, QuadMesh, extract};
use crate::mesh::vector::Vec3;
use crate::mesh::{TriangleMesh, barycentric};
use crate::monitor::{Monitor, Phase, may_continue, span, with_threads};
use crate::smooth::{SmoothOptions, smooth};

/// What is asked for besides the layout.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutOptions {
    /// The number or the size of quads.
    pub sizing: LayoutSizing,
    /// Arcs whose number of edges is fixed, each with that number, at least 1.
    pub fixed: Vec<(usize, u32)>,
    /// Arcs whose course is given: the arc, and points in space near the surface from its first end to its second. It
    /// starts and ends at the vertices of the layout, whatever the first and the last point are.
    pub curves: Vec<(usize, Vec<Vec3>)>,
    /// Whether arcs with a given course are cut into the mesh and stay there; else they only go about that way, and
    /// slide.
    pub hold_curves: bool,
    /// Whether vertices of the layout with four patches stay where they are, too; else they slide on the surface, as
    /// arcs do. Irregular vertices and those of the boundary stay always.
    pub hold_regular: bool,
    /// How quads are smoothed; not at all for none.
    pub smooth: Option<SmoothOptions>,
    /// The largest number of threads; 0 for one for each core. The result does not depend on it.
    pub threads: usize,
}

impl Default for LayoutOptions {
    fn default() -> Self {
        LayoutOptions {
            sizing: LayoutSizing::Quads(1000),
            fixed: Vec::new(),
            curves: Vec::new(),
            hold_curves: false,
            hold_regular: false,
            smooth: Some(SmoothOptions::default()),
            threads: 0,
        }
    }
}

/// Quads that follow a layout.
#[derive(Debug, Clone, PartialEq)]
pub struct LayoutQuads {
    /// The quads.
    pub quads: QuadMesh,
    /// The layout, with its orientation turned to that of the mesh.
    pub layout: BaseLayout,
    /// The numbers of edges along arcs and spokes.
    pub subdivisions: Subdivisions,
    /// The length of each arc when it was laid.
    pub lengths: Vec<f64>,
    /// The vertices of each arc when it was laid, from its first end to its second.
    pub arcs: Vec<Vec<Vec3>>,
    /// The polygon of the layout that every face of the mesh belongs to, or the first one where arcs divide it.
    pub patches: Vec<u32>,
    /// Faces that the map folds: none in a valid one.
    pub folded: usize,
    /// Whether the quads conform and are connected as layout and subdivisions prescribe: each patch is a grid, with as
    /// many edges along each arc as that has, and irregular vertices are those of the layout.
    pub is_as_prescribed: bool,
    /// The vertices of the quads along each arc, from its first end to its second: one more than the arc has edges.
    /// Empty unless the quads are as prescribed.
    pub arc_vertices: Vec<Vec<u32>>,
    /// The polygon of the layout that each quad is in. Empty unless the quads are as prescribed.
    pub quad_patches: Vec<u32>,
}

/// Makes quads on a mesh that follow a layout: its patches are filled with grids of quads, its vertices with other than
/// four patches and the middles of polygons of other than four sides are the irregular vertices.
///
/// # Errors
/// Those of the steps, with the vertex, arc or patch of the layout at fault: a vertex off the surface, an arc that
/// cannot be laid without crossing others, fixed numbers that contradict each other
/// ([`Error::Contradiction`]), a layout of other topology than the mesh; and [`Error::Cancelled`].
pub fn layout_quads<'a>(
    mesh: &TriangleMesh,
    layout: &BaseLayout,
    options: &LayoutOptions,
    monitor: impl Fn() -> Monitor<'a>,
) -> Result<LayoutQuads> {
    with_threads(options.threads, || {
        on_threads(mesh, layout, options, &monitor)
    })
}

fn on_threads<'a>(
    mesh: &TriangleMesh,
    given_layout: &BaseLayout,
    options: &LayoutOptions,
    monitor: &impl Fn() -> Monitor<'a>,
) -> Result<LayoutQuads> {
    let run = monitor().run();
    let monitor = || monitor().of_run(&run);
    let (_watch, _memory) = (monitor().watch(), mesh.watch_memory());
    may_continue()?;
    check(given_layout, options)?;
    check_topology(mesh, given_layout)?;
    let layout = match is_turned_over(mesh, given_layout) {
        true => given_layout.turned_over(),
        false => given_layout.clone(),
    };
    let (held, guides): (&[_], &[_]) = match options.hold_curves {
        true => (&options.curves, &[]),
        false => (&[], &options.curves),
    };
    let curves = GivenCurves::new(mesh, &layout, held, &monitor())?;
    let cut = curves.mesh(mesh);
    let mut surface = Surface::new(cut);
    let nodes = place_nodes(cut, &layout, &curves.nodes, &mut surface)?;
    let embedding = run.with_share([0.0, 0.3], || {
        let _span = span("embed");
        embed(&layout, surface, nodes, &curves.chains, guides)
    })?;
    let lengths: Vec<f64> = embedding
        .chains
        .iter()
        .map(|chain| embedding.surface.chain_length(chain))
        .collect();
    let arcs = embedding.chains.iter().map(|chain| {
        let places = chain.iter().map(|&v| embedding.surface.position(v));
        places.collect()
    });
    let arcs: Vec<Vec<Vec3>> = arcs.collect();
    let area = mesh.surface_area();
    let subdividing = Subdividing::new(&layout, &lengths, &options.fixed)?;
    let subdivisions = run.with_share([0.3, 0.5], || {
        let _span = span("subdivide");
        subdividing.solve(options.sizing, area, &monitor)
    })?;
    let nodes = embedding.nodes.clone();
    let all = Rectangles::new(&layout, embedding, &subdivisions)?;
    let mut grid = Grid::new(&all)?;
    let motion = motion(&layout, &all, &nodes, options);
    let edge = (area / subdivisions.quads as f64).sqrt();
    run.with_share([0.5, 0.8], || {
        let _span = span("relax");
        grid.relax(&all, &motion, edge, &mut monitor())
    })?;
    let uvs: Vec<[[f64; 2]; 3]> = (0..all.surface.triangles.len())
        .map(|f| grid.uv(f))
        .collect();
    let refined = TriangleMesh::new(all.surface.positions.clone(), all.surface.triangles.clone())?;
    let map = IntegerGridMap::new(&refined, &uvs)?;
    let mut quads = run.with_share([0.8, 0.9], || extract(&refined, &map, &mut monitor()))?;
    let filled = match quads.is_conforming() {
        true => correspondence(&all, &quads),
        false => None,
    };
    let origins = |face: u32| curves.original(all.surface.origin[face as usize]);
    bring_back(&mut quads, mesh, &refined, origins);
    if let Some(smoothing) = &options.smooth {
        let features = curves.features(mesh);
        let smoothing = SmoothOptions {
            features: [features, smoothing.features.clone()].concat(),
            ..smoothing.clone()
        };
        run.with_share([0.9, 1.0], || {
            smooth(&mut quads, mesh, &smoothing, &mut monitor())
        })?;
    }
    let mut patches = vec![u32::MAX; mesh.face_count()];
    for (face, &rectangle) in grid.rectangle.iter().enumerate() {
        let patch = &mut patches[origins(face as u32)];
        *patch = (*patch).min(all.rectangles[rectangle as usize].polygon);
    }
    run.end_call();
    let _ = monitor().progress(Phase::Quads, 1.0);
    let is_as_prescribed = filled.is_some();
    let Correspondence {
        curves: mut arc_vertices,
        patches: quad_patches,
    } = filled.unwrap_or_default();
    arc_vertices.truncate(layout.arc_count());
    Ok(LayoutQuads {
        is_as_prescribed,
        arc_vertices,
        quad_patches,
        folded: grid.folded(),
        quads,
        layout,
        subdivisions,
        lengths,
        arcs,
        patches,
    })
}

fn check(layout: &BaseLayout, options: &LayoutOptions) -> Result<()> {
    for (position, (arc, points)) in options.curves.iter().enumerate() {
        if *arc >= layout.arc_count() {
            return Err(Error::IndexOutOfRange {
                what: "arcs with given courses",
                position,
                value: i64::try_from(*arc).unwrap_or(i64::MAX),
                len: layout.arc_count(),
            });
        }
        let is_twice = options.curves[..position]
            .iter()
            .any(|other| other.0 == *arc);
        let is_finite = points.as_flattened().iter().all(|x| x.is_finite());
        if is_twice || !is_finite {
            let what = match is_finite {
                true => format!("two courses are given for arc {arc}"),
                false => format!("the course of arc {arc} has a coordinate that is not finite"),
            };
            return Err(Error::InvalidArgument {
                what,
                index: Some(*arc),
            });
        }
    }
    let what = match options.sizing {
        LayoutSizing::Quads(0) => "the number of quads is 0; it must be at least 1".into(),
        LayoutSizing::EdgeLength(length) if !(length.is_finite() && length > 0.0) => {
            format!("the edge length is {length}; it must be finite and above 0")
        }
        _ => return Ok(()),
    };
    Err(Error::InvalidArgument { what, index: None })
}

/// What can be told without laying any arc.
fn check_topology(mesh: &TriangleMesh, layout: &BaseLayout) -> Result<()> {
    let [of_mesh, of_layout] = [mesh.euler_characteristic(), layout.euler_characteristic()];
    if of_mesh != of_layout {
        return Err(Error::InvalidArgument {
            what: format!(
                "the layout has Euler characteristic {of_layout}, and the mesh {of_mesh}: they must have as many \
                 components, boundaries and handles"
            ),
            index: None,
        });
    }
    Ok(())
}

/// How each vertex of the surface may move in the map.
fn motion(
    layout: &BaseLayout,
    all: &Rectangles,
    nodes: &[u32],
    options: &LayoutOptions,
) -> Vec<Motion> {
    let mut motion = vec![Motion::Free; all.surface.positions.len()];
    let is_held = |arc: usize| {
        layout.is_boundary_arc(arc)
            || (options.hold_curves && options.curves.iter().any(|curve| curve.0 == arc))
    };
    for arc in (0..layout.arc_count()).filter(|&arc| is_held(arc)) {
        let chain = &all.curves[arc].chain;
        chain
            .iter()
            .for_each(|&v| motion[v as usize] = Motion::Along);
    }
    for (number, &v) in nodes.iter().enumerate() {
        let slides = !options.hold_regular
            && layout.valence(number) == 4
            && motion[v as usize] == Motion::Free;
        if !slides {
            motion[v as usize] = Motion::Held;
        }
    }
    for &center in all.centers.iter().flatten() {
        motion[center as usize] = Motion::Held;
    }
    motion
}

/// Lets the origins of quads name elements of the mesh that was given instead of those of the one that was cut.
fn bring_back(
    quads: &mut QuadMesh,
    mesh: &TriangleMesh,
    refined: &TriangleMesh,
    original: impl Fn(u32) -> usize,
) {
    for (origin, &p) in quads.origins.iter_mut().zip(&quads.vertices) {
        let face = match *origin {
            Origin::Face(face, _) => face,
            Origin::Vertex(v) if v < mesh.vertex_count() => continue,
            Origin::Vertex(v) => match refined.ring(v).next() {
                Some((face, _)) => face,
                None => continue,
            },
            Origin::Middle => continue,
        };
        let face = original(face as u32);
        *origin = Origin::Face(face, barycentric(mesh.corner_positions(face), p));
    }
    let mut folded: Vec<usize> = quads.folded.iter().map(|&f| original(f as u32)).collect();
    folded.sort_unstable();
    folded.dedup();
    quads.folded = folded;
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::layout::base_layout::tests::cube;
    use crate::mesh::shape::by_name;
    use crate::monitor::spawned;

    #[test]
    fn as_many_threads_work_as_are_allowed() {
        let mesh = by_name("rounded-cube", 2_000).unwrap();
        for threads in [1, 2] {
            let options = LayoutOptions {
                sizing: LayoutSizing::Quads(6_000),
                threads,
                ..LayoutOptions::default()
            };
            let found = spawned(|| {
                let made = layout_quads(&mesh, &cube(), &options, Monitor::default).unwrap();
                assert!(made.is_as_prescribed);
            });
            assert_eq!(found > 0, threads > 1, "{threads}: {found}");
        }
    }
}
