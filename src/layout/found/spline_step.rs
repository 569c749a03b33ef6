//! Spline patches as STEP: a Part 21 file (ISO 10303-21) of the schema `AUTOMOTIVE_DESIGN` (AP214).
//!
//! The file has one part, whose shape is a set of surfaces without trimming. The crates that write STEP (`truck-stepio`,
//! `cadmpeg-step`) want a solid of their own kernel, with edges and loops, which patches do not need.

use std::io::{self, Write};
use std::path::Path;

use super::layout_obj::save;
use super::spline::DEGREE;
use super::{SplinePatches, SplineSurface};
use crate::error::Result;

/// The number of the set of surfaces.
const SET: usize = 16;

/// What every file has before the set: the part, and its units.
const HEAD: &str = "\
ISO-10303-21;
HEADER;
FILE_DESCRIPTION(('B-spline patches of a layout'),'2;1');
FILE_NAME('','',(''),(''),'roundel','','');
FILE_SCHEMA(('AUTOMOTIVE_DESIGN { 1 0 10303 214 1 1 1 1 }'));
ENDSEC;
DATA;
#1=APPLICATION_CONTEXT('automotive design');
#2=APPLICATION_PROTOCOL_DEFINITION('international standard','automotive_design',2000,#1);
#3=PRODUCT_CONTEXT('',#1,'mechanical');
#4=PRODUCT('patches','patches','',(#3));
#5=PRODUCT_DEFINITION_FORMATION('','',#4);
#6=PRODUCT_DEFINITION_CONTEXT('part definition',#1,'design');
#7=PRODUCT_DEFINITION('design','',#5,#6);
#8=PRODUCT_DEFINITION_SHAPE('','',#7);
#9=(LENGTH_UNIT()NAMED_UNIT(*)SI_UNIT(.MILLI.,.METRE.));
#10=(NAMED_UNIT(*)PLANE_ANGLE_UNIT()SI_UNIT($,.RADIAN.));
#11=(NAMED_UNIT(*)SI_UNIT($,.STERADIAN.)SOLID_ANGLE_UNIT());
#12=UNCERTAINTY_MEASURE_WITH_UNIT(LENGTH_MEASURE(1.E-7),#9,'distance_accuracy_value','');
#13=(GEOMETRIC_REPRESENTATION_CONTEXT(3)GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT((#12))
GLOBAL_UNIT_ASSIGNED_CONTEXT((#9,#10,#11))REPRESENTATION_CONTEXT('',''));
#14=SHAPE_DEFINITION_REPRESENTATION(#8,#15);
#15=GEOMETRICALLY_BOUNDED_SURFACE_SHAPE_REPRESENTATION('',(#16),#13);
";

impl SplinePatches {
    /// Writes the patches as a STEP file: a set of surfaces `patch_N`. Lengths count as millimetres.
    ///
    /// # Errors
    /// [`Error::Io`](crate::Error::Io).
    pub fn write_step(&self, path: &Path) -> Result<()> {
        save(path, |out| self.encode_step(out))
    }

    fn encode_step(&self, out: &mut impl Write) -> io::Result<()> {
        let first_point = SET + 1;
        let first_surface = first_point + self.points.len();
        out.write_all(HEAD.as_bytes())?;
        let surfaces = listed((0..self.surfaces.len()).map(|i| format!("#{}", first_surface + i)));
        writeln!(out, "#{SET}=GEOMETRIC_SET('',{surfaces});")?;
        for (i, point) in self.points.iter().enumerate() {
            let point = listed(point.iter().map(|&x| real(x)));
            writeln!(out, "#{}=CARTESIAN_POINT('',{point});", first_point + i)?;
        }
        for (i, surface) in self.surfaces.iter().enumerate() {
            let [columns, rows] = surface.spans.map(|spans| spans + DEGREE);
            let name = |i: usize, j: usize| {
                format!(
                    "#{}",
                    first_point + surface.control[j * columns + i] as usize
                )
            };
            let of_column = |i: usize| listed((0..rows).map(|j| name(i, j)));
            let control = listed((0..columns).map(of_column));
            let [times, knots] = [multiplicities(surface), distinct_knots(surface)];
            writeln!(
                out,
                "#{}=B_SPLINE_SURFACE_WITH_KNOTS('patch_{i}',{DEGREE},{DEGREE},{control},\
                 .UNSPECIFIED.,.F.,.F.,.F.,{times},{knots},.UNSPECIFIED.);",
                first_surface + i
            )?;
        }
        writeln!(out, "ENDSEC;\nEND-ISO-10303-21;")
    }
}

/// How often each knot occurs, in both directions.
fn multiplicities(surface: &SplineSurface) -> String {
    let of = |spans: usize| {
        let times = (0..=spans).map(|i| if i % spans == 0 { DEGREE + 1 } else { 1 });
        listed(times.map(|times| times.to_string()))
    };
    surface.spans.map(of).join(",")
}

/// The knots, each once, in both directions.
fn distinct_knots(surface: &SplineSurface) -> String {
    let of = |spans: usize| listed((0..=spans).map(|i| real(i as f64 / spans as f64)));
    surface.spans.map(of).join(",")
}

fn listed(words: impl Iterator<Item = String>) -> String {
    format!("({})", words.collect::<Vec<_>>().join(","))
}

/// A real number of Part 21: always with a point, and with all its digits.
fn real(x: f64) -> String {
    format!("{x:.16E}")
}
