//! `roundel parametrize`: a seamless map of a mesh, with its figures and files.

mod arguments;
mod field;
mod page;
mod report;
mod sizing;
mod summary;

use std::time::Instant;

use roundel::map::{SeamlessProblem, Sizing};
use roundel::mesh::TriangleMesh;
use roundel::problem::files::{self, NamedProblem};
use roundel::quad::{FoldFreeMap, RefinedInput, solve_fold_free};
use roundel::untangle::{UntangleOptions, Untangled};
use roundel::{Options, Result, Solution};

use crate::changes::Changes;
use crate::exit::Exit;
use crate::field::{CurveCounts, Followed, too_short};
use crate::mesh::{Input, RepairCounts, Wanted};
use crate::output;
use crate::outputs::{MAP, Outputs, PAGE, PROBLEM, TRACE};
use crate::progress::Progress;
use crate::refinement::Refinement;
use crate::report::Preparation;
pub use arguments::Arguments;
use field::FieldSource;
use report::MapReport;
pub use sizing::SizingFlags;
use summary::MapSummary;

/// The share of a run that the field takes.
const FIELD: f64 = 0.3;

/// Runs the command and tells its outcome, once.
pub fn run(arguments: &Arguments) -> Exit {
    let run = || solve(arguments);
    let solved = arguments.tracing.around(&arguments.solver, run);
    let told = solved.and_then(|solved| tell(arguments, &solved));
    output::conclude(&arguments.mesh, arguments.json, told)
}

/// A map, and how it was found.
struct Solved {
    options: Options,
    /// The number of faces of the mesh that was given.
    given_faces: usize,
    /// The mesh of the map: that which was given, or what it was refined to.
    mesh: TriangleMesh,
    repair: RepairCounts,
    /// On the mesh of the map.
    changes: Changes,
    curves: Option<CurveCounts>,
    refined: Option<Refinement>,
    field: FieldSource,
    sizing: Sizing,
    /// Edges that are isolines.
    features: Vec<usize>,
    /// How many sharp edges are too short to be among them.
    too_short: usize,
    untangled: Untangled,
    /// The number of times that integers were decided anew.
    rounds: usize,
    /// The number of refinements of the whole map.
    refinements: usize,
    /// The number of refinements around faults alone.
    gradings: usize,
    /// Seconds of the map beside those of the last solve.
    untangle_seconds: f64,
    solution: Solution,
    before: Preparation,
}

fn solve(arguments: &Arguments) -> Result<Solved> {
    let started = Instant::now();
    check_outputs(arguments)?;
    let mut progress = Progress::start(arguments.output.quiet)?;
    let mut options = arguments.solver.over(Options::default())?;
    progress.limit(&mut options, started);
    let monitor = || progress.monitor();
    let wanted = Wanted {
        features: arguments.directions.attributes(),
        ..Wanted::default()
    };
    let input = arguments
        .input
        .read_with(&arguments.mesh, arguments.json, wanted)?;
    arguments.directions.keep_numbers(&input)?;
    input.keeps_numbers("--field", arguments.field.is_some())?;
    let Input {
        mesh,
        repair,
        changes,
        features: by_attributes,
        ..
    } = input;
    let read = started.elapsed().as_secs_f64();
    let sizing = arguments.sizing.of()?;
    let edge_length = Some(sizing.edge_length(&mesh));
    let given = (arguments.directions).of_map(&mesh, by_attributes.as_ref(), edge_length)?;
    let too_short = too_short(&mesh, &given.0)?;
    let given_faces = mesh.face_count();
    let curves = &arguments.directions.curves;
    let Followed {
        cut,
        guidance,
        features,
        sizing,
        counts: curves,
    } = curves.follow(&mesh, given, sizing)?;
    let (mesh, changes) = match cut {
        Some(cut) => (cut.mesh, changes.on_refined(&cut.face_origin)),
        None => (mesh, changes),
    };
    let input = match arguments.field.is_some() || arguments.no_refine {
        true => None,
        false => RefinedInput::new(&mesh, &guidance, &features, &sizing)?,
    };
    let refined = input.as_ref().map(|input| Refinement::new(&input.refined));
    let (mesh, guidance, features, sizing, changes) = match input {
        Some(input) => (
            input.refined.mesh,
            input.guidance,
            input.features,
            input.sizing,
            changes.on_refined(&input.refined.face_origin),
        ),
        None => (mesh, guidance, features, sizing, changes),
    };
    let follows = (&guidance, &features, &sizing);
    progress.next_call(0.0, FIELD);
    let field = field::of(arguments, &mesh, follows, &options, monitor)?;
    let started = Instant::now();
    let problem = SeamlessProblem::with_features(&mesh, &field.field, &sizing, &features)?;
    let assemble = started.elapsed().as_secs_f64();
    if let Some(path) = &arguments.write_problem {
        files::write(path, &NamedProblem::new(problem.problem().clone()))?;
    }
    progress.next_call(FIELD, 1.0);
    let started = Instant::now();
    let fold_free = match arguments.no_untangle {
        true => {
            let solution = roundel::solve_with(problem.problem(), &options, monitor())?;
            let map = problem.map(&mesh, &solution)?;
            FoldFreeMap::untouched(&mesh, &problem, solution, map)?
        }
        false => {
            let work = UntangleOptions {
                stiffenings: arguments.stiffen,
                ..UntangleOptions::default()
            };
            solve_fold_free(&mesh, &problem, &options, &work, monitor)?
        }
    };
    let solved = started.elapsed().as_secs_f64();
    let FoldFreeMap {
        solution,
        untangled,
        rounds,
        refinements,
        gradings,
        ..
    } = fold_free;
    let untangle_seconds = solved - solution.seconds().total;
    if let Some(path) = &arguments.out {
        untangled.map.write_obj(&mesh, path)?;
    }
    Ok(Solved {
        options,
        given_faces,
        mesh,
        repair,
        changes,
        curves,
        refined,
        field,
        sizing,
        features: features.edges().collect(),
        too_short,
        untangled,
        rounds,
        refinements,
        gradings,
        untangle_seconds,
        solution,
        before: Preparation {
            read,
            assemble: Some(assemble),
        },
    })
}

/// Checks all that is to be written.
fn check_outputs(arguments: &Arguments) -> Result<()> {
    let lengths = arguments.sizing.edge_lengths.as_deref();
    let field = arguments.field.as_deref();
    let mut read = vec![Some(arguments.mesh.as_path()), lengths, field];
    read.extend(arguments.directions.files());
    let outputs = Outputs::of(&read, arguments.output.force)
        .write(arguments.out.as_ref(), MAP)?
        .write(arguments.report.as_ref(), PAGE)?
        .write(arguments.tracing.trace.as_ref(), TRACE)?
        .write(arguments.write_problem.as_ref(), PROBLEM)?;
    outputs.tell(arguments.json || arguments.output.quiet);
    Ok(())
}

fn tell(arguments: &Arguments, solved: &Solved) -> Result<()> {
    if let Some(path) = &arguments.report {
        page::write(path, arguments, solved)?;
    }
    if arguments.json {
        output::print_json(&MapReport::new(arguments, solved))
    } else {
        output::print(&MapSummary { arguments, solved }.to_string())
    }
}
