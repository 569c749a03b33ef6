//! `roundel check`: whether the coordinates in a file are an integer-grid map.

mod checked;
mod report;
mod summary;

use std::path::PathBuf;
use std::time::Instant;

use roundel::Result;
use roundel::check::{CheckOptions, MAP_TOLERANCE, check_map, feature_edges};
use roundel::mesh::io;

use crate::exit::{self, Exit};
use crate::output;
use checked::Checked;
use report::CheckReport;
use summary::CheckSummary;

/// Check whether the texture coordinates of a mesh are an integer-grid map.
///
/// Over every edge the coordinates must change by a quarter turn and integers, singular vertices must
/// be at integer points, all triangles must be positively oriented (decided exactly), and features and
/// boundary must be on integer isolines. Vertices, edges and faces are counted from 0, edges in
/// increasing order of (lower face, local edge there).
#[derive(clap::Args)]
#[command(after_help = exit::HELP)]
pub struct Arguments {
    /// The mesh, with coordinates for every corner: f v/vt v/vt v/vt
    #[arg(value_name = "UV.obj")]
    pub map: PathBuf,

    /// Require edges over which the normal turns by more than this, in degrees, to be on isolines
    #[arg(long, value_name = "ANGLE", value_parser = angle, allow_negative_numbers = true)]
    pub features: Option<f64>,

    /// Do not require the boundary to be on isolines
    #[arg(long)]
    pub free_boundary: bool,

    /// The tolerance for integers and for equal points, in units of the grid
    #[arg(long, value_name = "T", default_value_t = MAP_TOLERANCE)]
    #[arg(value_parser = tolerance, allow_negative_numbers = true)]
    pub tolerance: f64,

    /// Print one JSON object instead of the summary
    #[arg(long)]
    pub json: bool,
}

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let mut is_valid = false;
    let told = check(arguments).and_then(|checked| {
        is_valid = checked.check.is_valid();
        match arguments.json {
            true => output::print_json(&CheckReport::new(&arguments.map, &checked)),
            false => output::print(&CheckSummary(&checked).to_string()),
        }
    });
    match output::conclude(&arguments.map, arguments.json, told) {
        Exit::Solved if !is_valid => Exit::Invalid,
        exit => exit,
    }
}

fn check(arguments: &Arguments) -> Result<Checked> {
    let started = Instant::now();
    let (mesh, uv) = io::read_textured(&arguments.map)?;
    let read = started.elapsed().as_secs_f64();
    let features = arguments.features.map(f64::to_radians);
    let options = CheckOptions {
        tolerance: arguments.tolerance,
        features: features.map_or(Vec::new(), |angle| feature_edges(&mesh, angle)),
        boundary: !arguments.free_boundary,
    };
    let check = check_map(&mesh, &uv, &options)?;
    Ok(Checked {
        mesh,
        check,
        read,
        seconds: started.elapsed().as_secs_f64() - read,
    })
}

fn angle(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(angle) if (0.0..=180.0).contains(&angle) => Ok(angle),
        _ => Err("the angle must be from 0 to 180 degrees".into()),
    }
}

fn tolerance(text: &str) -> std::result::Result<f64, String> {
    match text.parse() {
        Ok(tolerance) if (0.0..0.25).contains(&tolerance) => Ok(tolerance),
        _ => Err("the tolerance must be at least 0 and below 0.25".into()),
    }
}
