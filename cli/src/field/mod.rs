//! `roundel field`: the smoothest field of a mesh, with its figures, files and picture.

mod arguments;
mod curves;
mod directions;
mod feature_sources;
mod page;
mod report;
mod solved;
mod summary;

use std::path::Path;
use std::time::Instant;

use roundel::field::{FieldProblem, OrientationField, smoothest_field};
use roundel::map::Sizing;
use roundel::mesh::{TriangleMesh, io};
use roundel::problem::files::{self, NamedProblem};
use roundel::{Error, Options, Result};
use roundel_pictures::{FieldModel, draw_field};

use crate::exit::Exit;
use crate::mesh::{Input, Wanted};
use crate::output;
use crate::outputs::{Content, Outputs, PAGE, PICTURE, PROBLEM, TRACE};
use crate::progress::Progress;
use crate::report::Preparation;
pub use arguments::Arguments;
pub use curves::{CurveCounts, Followed};
pub use directions::{Directions, named, too_short};
use report::FieldReport;
use solved::Solved;
use summary::FieldSummary;

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let run = || solve(arguments);
    let solved = arguments.tracing.around(&arguments.solver, run);
    let told = solved.and_then(|solved| tell(arguments, &solved));
    output::conclude(&arguments.mesh, arguments.json, told)
}

fn solve(arguments: &Arguments) -> Result<Solved> {
    let started = Instant::now();
    check_outputs(arguments)?;
    let mut progress = Progress::start(arguments.output.quiet)?;
    let mut options = arguments.solver.over(Options::default())?;
    progress.limit(&mut options, started);
    let wanted = Wanted {
        features: arguments.directions.attributes(),
        ..Wanted::default()
    };
    let input = arguments
        .input
        .read_with(&arguments.mesh, arguments.json, wanted)?;
    arguments.directions.keep_numbers(&input)?;
    let Input {
        mesh,
        repair,
        changes,
        features: by_attributes,
        ..
    } = input;
    let read = started.elapsed().as_secs_f64();
    let started = Instant::now();
    if arguments.symmetry != 4 && draws(arguments) {
        return Err(Error::InvalidArgument {
            what: "pictures and models need a field of crosses, --symmetry 4".into(),
            index: None,
        });
    }
    let given = arguments
        .directions
        .of(&mesh, by_attributes.as_ref(), arguments.symmetry, None)?;
    let curves = &arguments.directions.curves;
    let Followed {
        cut,
        guidance,
        features,
        counts: curves,
        ..
    } = curves.follow(&mesh, given, Sizing::EdgeLength(1.0))?;
    let (mesh, changes) = match cut {
        Some(cut) => (cut.mesh, changes.on_refined(&cut.face_origin)),
        None => (mesh, changes),
    };
    let follows = guidance.field_options(&mesh, &features)?;
    let before_solve = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.write_problem {
        let problem = FieldProblem::with_options(&mesh, &follows)?;
        files::write(path, &NamedProblem::new(problem.problem().clone()))?;
    }
    let started = Instant::now();
    let monitor = || progress.monitor();
    let (field, solution) = smoothest_field(&mesh, &follows, &options, monitor)?;
    // The library states the problem, and solves for a first field where the last one needs it.
    let around_solve = started.elapsed().as_secs_f64() - solution.seconds().total;
    let started = Instant::now();
    write(arguments, &mesh, &field)?;
    Ok(Solved {
        strategy: options.strategy,
        mesh,
        repair,
        changes,
        curves,
        features: features.edges().collect(),
        field,
        solution,
        before: Preparation {
            read,
            assemble: Some(before_solve + around_solve),
        },
        written: started.elapsed().as_secs_f64(),
    })
}

/// Checks all that is to be written.
fn check_outputs(arguments: &Arguments) -> Result<()> {
    let mut read = vec![Some(arguments.mesh.as_path())];
    read.extend(arguments.directions.files());
    let outputs = Outputs::of(&read, arguments.output.force)
        .write(arguments.out.as_ref(), Content::Field)?
        .write(arguments.picture.file.as_ref(), PICTURE)?
        .write(arguments.report.as_ref(), PAGE)?
        .write(arguments.tracing.trace.as_ref(), TRACE)?
        .write(arguments.write_problem.as_ref(), PROBLEM)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    Ok(())
}

fn is_text(path: &Path) -> bool {
    let extension = path.extension();
    extension.is_some_and(|e| e.eq_ignore_ascii_case("txt"))
}

fn draws(arguments: &Arguments) -> bool {
    arguments.picture.file.is_some() || arguments.out.as_ref().is_some_and(|path| !is_text(path))
}

fn write(arguments: &Arguments, mesh: &TriangleMesh, field: &OrientationField) -> Result<()> {
    if let Some(path) = &arguments.out {
        match is_text(path) {
            true => field.write(mesh, path)?,
            false => io::write(path, FieldModel::new(mesh, field).drawing())?,
        }
    }
    if let Some(path) = &arguments.picture.file {
        draw_field(mesh, field, &arguments.picture.view())?.write_png(path)?;
    }
    Ok(())
}

fn tell(arguments: &Arguments, solved: &Solved) -> Result<()> {
    if let Some(path) = &arguments.report {
        page::write(path, arguments, solved)?;
    }
    if arguments.json {
        output::print_json(&FieldReport::new(&arguments.mesh, solved))
    } else {
        output::print(&FieldSummary { arguments, solved }.to_string())
    }
}
