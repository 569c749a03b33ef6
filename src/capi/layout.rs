//! The layout handle, and quads that follow a layout.

use std::ffi::c_char;
use std::path::Path;

use super::event::{roundel_monitor, watchers};
use super::failure::Outcome;
use super::guard::{self, Guarded, boundary, object};
use super::input::{path, slice};
use super::mesh::{roundel_mesh, times_three};
use super::mesh_files::room_to_read;
use super::output::{Out, copy_numbers};
use super::quads::{Quads, roundel_quads};
use super::soup::{of_arrays, roundel_soup};
use super::status::roundel_status;
use crate::error::{Error, Result};
use crate::layout::found::{FoundLayout, QuadSurface, SimplifyOptions, simplify};
use crate::layout::{BaseLayout, DrawnLayout, LayoutOptions, LayoutSizing, layout_quads};
use crate::mesh::TriangleMesh;
use crate::soup::PolygonSoup;

/// A base layout: a coarse mesh of polygons anywhere near a surface. Its vertices mark points of the surface, its
/// edges are the arcs, its polygons the patches. It is a manifold, with or without boundary, whose polygons have
/// three sides or more and agree in orientation; two vertices have one arc at most. Arcs are numbered in the order in
/// which polygons name them. What is asked of arcs is kept with it.
pub struct roundel_layout(Guarded<Asked>);

object!(roundel_layout, Asked, "layout");

/// A layout, and what is asked of its arcs.
pub(super) struct Asked {
    layout: BaseLayout,
    options: LayoutOptions,
}

impl From<DrawnLayout> for Asked {
    fn from(drawn: DrawnLayout) -> Self {
        Asked {
            layout: drawn.layout,
            options: LayoutOptions {
                curves: drawn.curves,
                ..LayoutOptions::default()
            },
        }
    }
}

#[cfg(feature = "mesh-io")]
fn read(file: &Path) -> Result<Asked> {
    Ok(crate::layout::read_layout(file)?.into())
}

#[cfg(not(feature = "mesh-io"))]
fn read(file: &Path) -> Result<Asked> {
    super::mesh_files::without_files(file)
}

/// Makes a layout of `vertex_count` vertices, whose `coordinates` are x, y, z in turn, and `polygon_count` polygons.
/// `sizes` are their numbers of corners, and `corners` the vertices of all polygons, one polygon after the other. To be
/// freed with roundel_layout_free.
///
/// Fails as roundel_soup_new does, with ROUNDEL_ERROR_INDEX_OUT_OF_RANGE and the polygon for a corner that is no vertex,
/// with ROUNDEL_ERROR_NOT_FINITE and the vertex, and with ROUNDEL_ERROR_INVALID_ARGUMENT and the polygon or the vertex
/// for what is no manifold of polygons of one orientation.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_new(
    vertex_count: usize,
    coordinates: *const f64,
    polygon_count: usize,
    sizes: *const i32,
    corner_count: usize,
    corners: *const i32,
    layout: *mut *mut roundel_layout,
) -> roundel_status {
    boundary(None, || {
        let vertices = (vertex_count, coordinates);
        let polygons = (polygon_count, sizes);
        // SAFETY: the caller gives arrays of the lengths given and a place, or NULL.
        let (out, soup) = unsafe {
            (
                Out::new("layout", layout)?,
                of_arrays(vertices, polygons, (corner_count, corners))?,
            )
        };
        out.set(guard::handle(Asked {
            layout: BaseLayout::from_soup(&soup)?,
            options: LayoutOptions::default(),
        }));
        Ok(())
    })
}

/// Reads a layout from an OBJ file: its vertices and polygons, and lines for the arcs whose course is given. A line
/// starts and ends at vertices of polygons that an edge joins, and runs over further vertices.
///
/// Fails with ROUNDEL_ERROR_IO, with ROUNDEL_ERROR_PARSE and the line, and as roundel_layout_new does.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_read(
    file: *const c_char,
    layout: *mut *mut roundel_layout,
) -> roundel_status {
    boundary(None, || {
        // SAFETY: the caller gives a text and a place, or NULL.
        let (out, file) = unsafe { (Out::new("layout", layout)?, path("file", file)?) };
        room_to_read(file)?;
        out.set(guard::handle(read(file)?));
        Ok(())
    })
}

/// Finds the layout of a soup of quads: irregular vertices and the lines that leave them, with every arc drawn. For a
/// `deviation` of 0 it is the base complex; else a layout with the same irregular vertices and fewer patches, whose arcs
/// drift at most so many edges across the lines of the quads, infinity for any drift. Further lines divide arcs that
/// join the same vertices. `monitor` may be NULL. To be freed with roundel_layout_free.
///
/// Fails as roundel_mesh_new does, with the quad, edge or vertex, for what is no manifold of one orientation; with
/// ROUNDEL_ERROR_INVALID_ARGUMENT and the polygon for one that is no quad, and for a deviation that is negative or no
/// number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_of_quads(
    quads: *const roundel_soup,
    deviation: f64,
    monitor: *const roundel_monitor,
    layout: *mut *mut roundel_layout,
) -> roundel_status {
    let body = |soup: &PolygonSoup| {
        // SAFETY: the caller gives a monitor as its members say and a place, or NULL.
        let (monitor, out) = unsafe { (watchers(monitor)?, Out::new("layout", layout)?) };
        let mut surface = QuadSurface::from_soup(soup).map_err(Error::from)?;
        if deviation != 0.0 {
            let options = SimplifyOptions {
                deviation,
                ..SimplifyOptions::default()
            };
            surface = simplify(&surface, &options, monitor)?.surface;
        }
        let drawn = FoundLayout::simple_complex(&surface).drawn(&surface)?;
        out.set(guard::handle(Asked::from(drawn)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(quads, body) }
}

/// Writes a layout as an OBJ file, which roundel_layout_read reads: its vertices and polygons, and a line for every arc
/// whose course is given.
///
/// Fails with ROUNDEL_ERROR_IO.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_write(
    layout: *const roundel_layout,
    file: *const c_char,
) -> roundel_status {
    let body = |asked: &Asked| {
        // SAFETY: the caller gives a text, or NULL.
        let file = unsafe { path("file", file) }?;
        let drawn = DrawnLayout {
            layout: asked.layout.clone(),
            curves: asked.options.curves.clone(),
        };
        Ok(drawn.write_obj(file)?)
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(layout, body) }
}

/// Gives the vertices and polygons of a layout as a soup, to be freed with roundel_soup_free.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_soup(
    layout: *const roundel_layout,
    soup: *mut *mut roundel_soup,
) -> roundel_status {
    let body = |asked: &Asked| {
        // SAFETY: the caller gives a place, or NULL.
        let out = unsafe { Out::new("soup", soup) }?;
        let mut soup = PolygonSoup::new(asked.layout.positions().to_vec());
        for polygon in asked.layout.polygons() {
            soup.add_polygon(polygon.iter().map(|&v| i64::from(v)));
        }
        out.set(guard::handle(soup));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(layout, body) }
}

/// Frees a layout. NULL is allowed.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_free(layout: *mut roundel_layout) -> roundel_status {
    // SAFETY: the caller gives up the handle, or NULL.
    unsafe { guard::free(layout) }
}

/// Gives the number of arcs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_arc_count(
    layout: *const roundel_layout,
    count: *mut usize,
) -> roundel_status {
    let body = |asked: &Asked| {
        // SAFETY: the caller gives a place for the number, or NULL.
        unsafe { Out::new("arc count", count) }?.set(asked.layout.arc_count());
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(layout, body) }
}

/// Copies the two vertices that each arc joins. `length` is twice the number of arcs.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_arcs(
    layout: *const roundel_layout,
    ends: *mut i32,
    length: usize,
) -> roundel_status {
    let body = |asked: &Asked| {
        let all = asked.layout.arcs().as_flattened();
        let all: Vec<i32> = all.iter().map(|&v| v as i32).collect();
        // SAFETY: the caller gives an array of `length` numbers, or NULL.
        unsafe { copy_numbers("ends of arcs", all.into_iter(), ends, length) }
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(layout, body) }
}

/// # Safety
/// `layout` is NULL or a live handle that nobody else uses.
unsafe fn ask(
    layout: *mut roundel_layout,
    arc: usize,
    change: impl FnOnce(&mut LayoutOptions) -> Outcome,
) -> roundel_status {
    let body = |asked: &mut Asked| {
        check_arc(&asked.layout, arc)?;
        change(&mut asked.options)
    };
    // SAFETY: handed on.
    unsafe { guard::write(layout, body) }
}

fn check_arc(layout: &BaseLayout, arc: usize) -> Result<()> {
    match arc < layout.arc_count() {
        true => Ok(()),
        false => Err(Error::IndexOutOfRange {
            what: "arcs",
            position: 0,
            value: i64::try_from(arc).unwrap_or(i64::MAX),
            len: layout.arc_count(),
        }),
    }
}

/// Fixes the number of edges of quads along an arc, at least 1; 0 leaves it free again. What contradicts what else is
/// fixed is told by roundel_quads_make_layout.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_fix_arc(
    layout: *mut roundel_layout,
    arc: usize,
    edges: i32,
) -> roundel_status {
    let change = |options: &mut LayoutOptions| {
        let edges = u32::try_from(edges).map_err(|_| Error::InvalidArgument {
            what: format!("arc {arc} is fixed to {edges} edges; the number must not be negative"),
            index: Some(arc),
        })?;
        options.fixed.retain(|fixed| fixed.0 != arc);
        if edges > 0 {
            options.fixed.push((arc, edges));
        }
        Ok(())
    };
    // SAFETY: the caller gives a live handle that nobody else uses, or NULL.
    unsafe { ask(layout, arc, change) }
}

/// Gives the course of an arc: `point_count` points near the surface, x, y, z in turn, from the first end of the arc to
/// the second. It starts and ends at the vertices of the layout, whatever the first and the last point are, and goes
/// about that way, unless roundel_layout_hold_arcs keeps it there. No points leave the course free again.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_draw_arc(
    layout: *mut roundel_layout,
    arc: usize,
    point_count: usize,
    coordinates: *const f64,
) -> roundel_status {
    let change = |options: &mut LayoutOptions| {
        let length = times_three("coordinates", point_count)?;
        // SAFETY: the caller gives an array of that length, or NULL.
        let points = unsafe { slice("coordinates", coordinates, length) }?;
        options.curves.retain(|curve| curve.0 != arc);
        if !points.is_empty() {
            options
                .curves
                .push((arc, points.as_chunks::<3>().0.to_vec()));
        }
        Ok(())
    };
    // SAFETY: the caller gives a live handle that nobody else uses, or NULL.
    unsafe { ask(layout, arc, change) }
}

/// Keeps all arcs whose course is given on it, for `held` other than 0: the courses are cut into the mesh. They must not
/// touch each other between their ends. By default arcs slide.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_layout_hold_arcs(
    layout: *mut roundel_layout,
    held: i32,
) -> roundel_status {
    let body = |asked: &mut Asked| {
        asked.options.hold_curves = held != 0;
        Ok(())
    };
    // SAFETY: the caller gives a live handle that nobody else uses, or NULL.
    unsafe { guard::write(layout, body) }
}

/// Makes quads on a mesh that follow a layout: about `quad_count` of them, or as few as the layout allows for 0.
/// Patches are filled with grids of quads; vertices of the layout with other than four patches and the middles of
/// polygons of other than four sides are the irregular vertices. `subdivisions`, of a `length` that is the number of
/// arcs, gets the number of edges along each arc; both may be NULL and 0. `monitor` may be NULL.
///
/// Fails with ROUNDEL_ERROR_INVALID_ARGUMENT and the vertex, arc or patch at fault for a layout of other topology than
/// the mesh, a vertex off the surface, or an arc that cannot be laid without crossing others, and with
/// ROUNDEL_ERROR_INFEASIBLE for fixed arcs that contradict each other.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn roundel_quads_make_layout(
    mesh: *const roundel_mesh,
    layout: *const roundel_layout,
    quad_count: usize,
    monitor: *const roundel_monitor,
    subdivisions: *mut i32,
    length: usize,
    quads: *mut *mut roundel_quads,
) -> roundel_status {
    let body = |mesh: &TriangleMesh| {
        // SAFETY: the caller gives a live handle, a monitor as its members say and a place, or NULL.
        let (asked, monitor, out): (&Asked, _, _) = unsafe {
            (
                guard::value(layout)?,
                watchers(monitor)?,
                Out::new("quads", quads)?,
            )
        };
        let expected = asked.layout.arc_count();
        if length != 0 && length != expected {
            Err(Error::LengthMismatch {
                what: "subdivisions",
                expected,
                actual: length,
            })?;
        }
        let options = LayoutOptions {
            sizing: match quad_count {
                0 => LayoutSizing::Fewest,
                quads => LayoutSizing::Quads(quads),
            },
            ..asked.options.clone()
        };
        let found = layout_quads(mesh, &asked.layout, &options, monitor)?;
        if length > 0 {
            let numbers = found.subdivisions.arcs.iter().map(|&n| n as i32);
            // SAFETY: the caller gives an array of `length` numbers, or NULL.
            unsafe { copy_numbers("subdivisions", numbers, subdivisions, length) }?;
        }
        out.set(guard::handle(Quads::extracted(found.quads)));
        Ok(())
    };
    // SAFETY: the caller gives a live handle, or NULL.
    unsafe { guard::read(mesh, body) }
}
