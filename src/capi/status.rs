//! The status of a call, and the way in which a solve ended.

use std::ffi::{CStr, c_char};

use crate::error::Error;
use crate::search::{SolveStatus, StoppedBy};

/// The status of a call. The numbers never change; new ones may be added, so treat every number other
/// than ROUNDEL_OK as a failure.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_status {
    /// The call succeeded.
    ROUNDEL_OK = 0,
    /// A pointer that must not be NULL is NULL.
    ROUNDEL_ERROR_NULL_POINTER = 1,
    /// A value that is never allowed; the index is its position, if it has one.
    ROUNDEL_ERROR_INVALID_ARGUMENT = 2,
    /// A length does not fit the problem, or two arrays that belong together differ in length.
    ROUNDEL_ERROR_LENGTH_MISMATCH = 3,
    /// An index is negative or too large; the error's index is its position in the array.
    ROUNDEL_ERROR_INDEX_OUT_OF_RANGE = 4,
    /// NaN or infinity; the index is its position in the array, or the vertex of a mesh.
    ROUNDEL_ERROR_NOT_FINITE = 5,
    /// A problem without variables, a mesh without faces, or a soup of which repair leaves nothing.
    ROUNDEL_ERROR_EMPTY = 6,
    /// A count or a sum is beyond what can be represented.
    ROUNDEL_ERROR_OVERFLOW = 7,
    /// Memory for a large array was not available.
    ROUNDEL_ERROR_OUT_OF_MEMORY = 8,
    /// There is no option of this name.
    ROUNDEL_ERROR_UNKNOWN_OPTION = 20,
    /// The option takes another type of value.
    ROUNDEL_ERROR_OPTION_TYPE = 21,
    /// The option does not take this value.
    ROUNDEL_ERROR_OPTION_RANGE = 22,
    /// Something that the library does not solve (yet); the line names it in a file.
    ROUNDEL_ERROR_NOT_SUPPORTED = 30,
    /// A file that does not follow its format, at the line given if it is a text.
    ROUNDEL_ERROR_PARSE = 31,
    /// A file that cannot be read or written.
    ROUNDEL_ERROR_IO = 32,
    /// A proof that does not hold, at the line given; the text says what is wrong with it.
    ROUNDEL_ERROR_PROOF_REFUSED = 33,
    /// The constraint of this index contradicts the others.
    ROUNDEL_ERROR_INFEASIBLE = 40,
    /// The constraint of this index has no solution in integers.
    ROUNDEL_ERROR_NO_INTEGER_SOLUTION = 41,
    /// The objective falls without limit along the direction given; the index is a variable that
    /// it moves.
    ROUNDEL_ERROR_UNBOUNDED = 42,
    /// The objective curves downwards along the direction given; the index is a variable that it
    /// moves. In a file, the line is that of the entry that shows it.
    ROUNDEL_ERROR_NOT_CONVEX = 43,
    /// An edge of a mesh has more than two faces; the index is the lowest of them.
    ROUNDEL_ERROR_NON_MANIFOLD_EDGE = 50,
    /// The faces of a vertex form more than one fan; the index is the vertex.
    ROUNDEL_ERROR_NON_MANIFOLD_VERTEX = 51,
    /// Two faces run along their common edge in the same direction; the index is the lower face.
    ROUNDEL_ERROR_INCONSISTENT_ORIENTATION = 52,
    /// A face without area; the index is the face.
    ROUNDEL_ERROR_ZERO_AREA = 53,
    /// A vertex that no face uses; the index is the vertex.
    ROUNDEL_ERROR_ISOLATED_VERTEX = 54,
    /// A face with another number of corners than three; the index is the face.
    ROUNDEL_ERROR_NOT_A_TRIANGLE = 55,
    /// A face that visits a vertex twice; the index is the face.
    ROUNDEL_ERROR_REPEATED_VERTEX = 56,
    /// Cancelled before a first solution was found.
    ROUNDEL_ERROR_CANCELLED = 60,
    /// The time limit passed before a first solution was found.
    ROUNDEL_ERROR_TIME_LIMIT = 61,
    /// The option nodes, the budget of auto, or the precision of numbers ended the search before a first solution was
    /// found.
    ROUNDEL_ERROR_SEARCH_LIMIT = 62,
    /// A defect of the library, kept inside. The handle can only be freed from now on.
    ROUNDEL_ERROR_PANIC = 90,
    /// The handle was given up in an earlier ROUNDEL_ERROR_PANIC.
    ROUNDEL_ERROR_UNUSABLE = 91,
}

/// How a solve with a solution ended. The numbers never change; new ones may be added.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_solve_status {
    /// The energy is the least possible, and that is proved.
    ROUNDEL_SOLVE_OPTIMAL = 1,
    /// Every constraint and integrality holds; a better solution may exist.
    ROUNDEL_SOLVE_FEASIBLE = 2,
    /// As feasible, but a limit that the caller set ended the search early: the option time_limit or nodes.
    ROUNDEL_SOLVE_LIMIT = 3,
    /// As feasible, but the caller ended the search early.
    ROUNDEL_SOLVE_CANCELLED = 4,
    /// The relaxation was asked for: integers may be fractions.
    ROUNDEL_SOLVE_RELAXED = 5,
    /// Reserved. A problem without a solution is an error of the solve, which names the row.
    ROUNDEL_SOLVE_INFEASIBLE = 10,
    /// Reserved. An unbounded problem is an error of the solve, which gives the direction.
    ROUNDEL_SOLVE_UNBOUNDED = 11,
}

/// Why a search ended before it had visited everything that could be better. The numbers never change;
/// new ones may be added.
#[repr(i32)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum roundel_stopped_by {
    /// Nothing stopped it: it is complete, it has reached the option gap, or its strategy proves nothing.
    ROUNDEL_STOPPED_BY_NONE = 0,
    /// The option nodes, set by the caller.
    ROUNDEL_STOPPED_BY_NODES = 1,
    /// The option time_limit.
    ROUNDEL_STOPPED_BY_TIME = 2,
    /// A lack of memory.
    ROUNDEL_STOPPED_BY_MEMORY = 3,
    /// The caller, by a cancel token or the callback.
    ROUNDEL_STOPPED_BY_CANCEL = 4,
    /// A budget of the library: the work of auto, or the default of nodes.
    ROUNDEL_STOPPED_BY_BUDGET = 5,
}

use roundel_solve_status::*;
use roundel_status::*;
use roundel_stopped_by::*;

const NAMES: &[(roundel_status, &CStr)] = &[
    (ROUNDEL_OK, c"ok"),
    (ROUNDEL_ERROR_NULL_POINTER, c"null_pointer"),
    (ROUNDEL_ERROR_INVALID_ARGUMENT, c"invalid_argument"),
    (ROUNDEL_ERROR_LENGTH_MISMATCH, c"length_mismatch"),
    (ROUNDEL_ERROR_INDEX_OUT_OF_RANGE, c"index_out_of_range"),
    (ROUNDEL_ERROR_NOT_FINITE, c"not_finite"),
    (ROUNDEL_ERROR_EMPTY, c"empty"),
    (ROUNDEL_ERROR_OVERFLOW, c"overflow"),
    (ROUNDEL_ERROR_OUT_OF_MEMORY, c"out_of_memory"),
    (ROUNDEL_ERROR_UNKNOWN_OPTION, c"unknown_option"),
    (ROUNDEL_ERROR_OPTION_TYPE, c"option_type"),
    (ROUNDEL_ERROR_OPTION_RANGE, c"option_range"),
    (ROUNDEL_ERROR_NOT_SUPPORTED, c"not_supported"),
    (ROUNDEL_ERROR_PARSE, c"parse"),
    (ROUNDEL_ERROR_IO, c"io"),
    (ROUNDEL_ERROR_PROOF_REFUSED, c"proof_refused"),
    (ROUNDEL_ERROR_INFEASIBLE, c"infeasible"),
    (ROUNDEL_ERROR_NO_INTEGER_SOLUTION, c"no_integer_solution"),
    (ROUNDEL_ERROR_UNBOUNDED, c"unbounded"),
    (ROUNDEL_ERROR_NOT_CONVEX, c"not_convex"),
    (ROUNDEL_ERROR_NON_MANIFOLD_EDGE, c"non_manifold_edge"),
    (ROUNDEL_ERROR_NON_MANIFOLD_VERTEX, c"non_manifold_vertex"),
    (
        ROUNDEL_ERROR_INCONSISTENT_ORIENTATION,
        c"inconsistent_orientation",
    ),
    (ROUNDEL_ERROR_ZERO_AREA, c"zero_area"),
    (ROUNDEL_ERROR_ISOLATED_VERTEX, c"isolated_vertex"),
    (ROUNDEL_ERROR_NOT_A_TRIANGLE, c"not_a_triangle"),
    (ROUNDEL_ERROR_REPEATED_VERTEX, c"repeated_vertex"),
    (ROUNDEL_ERROR_CANCELLED, c"cancelled"),
    (ROUNDEL_ERROR_TIME_LIMIT, c"time_limit"),
    (ROUNDEL_ERROR_SEARCH_LIMIT, c"search_limit"),
    (ROUNDEL_ERROR_PANIC, c"panic"),
    (ROUNDEL_ERROR_UNUSABLE, c"unusable"),
];

const SOLVE_NAMES: &[(roundel_solve_status, &CStr)] = &[
    (ROUNDEL_SOLVE_OPTIMAL, c"optimal"),
    (ROUNDEL_SOLVE_FEASIBLE, c"feasible"),
    (ROUNDEL_SOLVE_LIMIT, c"limit"),
    (ROUNDEL_SOLVE_CANCELLED, c"cancelled"),
    (ROUNDEL_SOLVE_RELAXED, c"relaxed"),
    (ROUNDEL_SOLVE_INFEASIBLE, c"infeasible"),
    (ROUNDEL_SOLVE_UNBOUNDED, c"unbounded"),
];

const STOP_NAMES: &[(roundel_stopped_by, &CStr)] = &[
    (ROUNDEL_STOPPED_BY_NONE, c"none"),
    (ROUNDEL_STOPPED_BY_NODES, c"nodes"),
    (ROUNDEL_STOPPED_BY_TIME, c"time"),
    (ROUNDEL_STOPPED_BY_MEMORY, c"memory"),
    (ROUNDEL_STOPPED_BY_CANCEL, c"cancel"),
    (ROUNDEL_STOPPED_BY_BUDGET, c"budget"),
];

/// The word for a status, such as "index_out_of_range"; "unknown" for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_status_name(status: i32) -> *const c_char {
    let mut names = NAMES.iter();
    let found = names.find(|(s, _)| *s as i32 == status);
    found.map_or(c"unknown", |(_, name)| name).as_ptr()
}

/// The word for the end of a solve, such as "optimal"; "unknown" for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_solve_status_name(status: i32) -> *const c_char {
    let mut names = SOLVE_NAMES.iter();
    let found = names.find(|(s, _)| *s as i32 == status);
    found.map_or(c"unknown", |(_, name)| name).as_ptr()
}

/// The word for what stopped a search, such as "budget"; "unknown" for a number that is none.
#[unsafe(no_mangle)]
pub extern "C" fn roundel_stopped_by_name(stopped_by: i32) -> *const c_char {
    let mut names = STOP_NAMES.iter();
    let found = names.find(|(s, _)| *s as i32 == stopped_by);
    found.map_or(c"unknown", |(_, name)| name).as_ptr()
}

impl From<&Error> for roundel_status {
    fn from(error: &Error) -> Self {
        match error {
            Error::InvalidArgument { .. } => ROUNDEL_ERROR_INVALID_ARGUMENT,
            Error::LengthMismatch { .. } => ROUNDEL_ERROR_LENGTH_MISMATCH,
            Error::IndexOutOfRange { .. } => ROUNDEL_ERROR_INDEX_OUT_OF_RANGE,
            Error::NotFinite { .. } => ROUNDEL_ERROR_NOT_FINITE,
            Error::Empty => ROUNDEL_ERROR_EMPTY,
            Error::Overflow { .. } => ROUNDEL_ERROR_OVERFLOW,
            Error::OutOfMemory { .. } => ROUNDEL_ERROR_OUT_OF_MEMORY,
            Error::UnknownOption { .. } => ROUNDEL_ERROR_UNKNOWN_OPTION,
            Error::OptionType { .. } => ROUNDEL_ERROR_OPTION_TYPE,
            Error::OptionRange { .. } => ROUNDEL_ERROR_OPTION_RANGE,
            Error::NotSupported { .. } => ROUNDEL_ERROR_NOT_SUPPORTED,
            Error::Input(error) => of_mesh(error.code),
            Error::Parse { .. } => ROUNDEL_ERROR_PARSE,
            Error::Io { .. } => ROUNDEL_ERROR_IO,
            Error::Infeasible { .. } | Error::Contradiction { .. } => ROUNDEL_ERROR_INFEASIBLE,
            Error::NoIntegerSolution { .. } => ROUNDEL_ERROR_NO_INTEGER_SOLUTION,
            Error::Unbounded { .. } => ROUNDEL_ERROR_UNBOUNDED,
            Error::NotConvex { .. } | Error::NotConvexAt { .. } => ROUNDEL_ERROR_NOT_CONVEX,
            Error::Cancelled => ROUNDEL_ERROR_CANCELLED,
            Error::TimeLimit => ROUNDEL_ERROR_TIME_LIMIT,
            Error::SearchLimit { .. } => ROUNDEL_ERROR_SEARCH_LIMIT,
        }
    }
}

/// The status of each reason for which a mesh is refused, by [`MeshError::code`](crate::mesh::MeshError::code).
const OF_MESHES: [(&str, roundel_status); 16] = [
    ("no_faces", ROUNDEL_ERROR_EMPTY),
    ("no_surface", ROUNDEL_ERROR_EMPTY),
    ("mesh_too_large", ROUNDEL_ERROR_OVERFLOW),
    ("vertex_not_finite", ROUNDEL_ERROR_NOT_FINITE),
    ("not_a_triangle", ROUNDEL_ERROR_NOT_A_TRIANGLE),
    ("vertex_out_of_range", ROUNDEL_ERROR_INDEX_OUT_OF_RANGE),
    ("repeated_vertex", ROUNDEL_ERROR_REPEATED_VERTEX),
    ("zero_area", ROUNDEL_ERROR_ZERO_AREA),
    ("non_manifold_edge", ROUNDEL_ERROR_NON_MANIFOLD_EDGE),
    (
        "inconsistent_orientation",
        ROUNDEL_ERROR_INCONSISTENT_ORIENTATION,
    ),
    ("isolated_vertex", ROUNDEL_ERROR_ISOLATED_VERTEX),
    ("non_manifold_vertex", ROUNDEL_ERROR_NON_MANIFOLD_VERTEX),
    ("malformed", ROUNDEL_ERROR_PARSE),
    ("unknown_format", ROUNDEL_ERROR_NOT_SUPPORTED),
    ("unknown_shape", ROUNDEL_ERROR_INVALID_ARGUMENT),
    ("invalid_argument", ROUNDEL_ERROR_INVALID_ARGUMENT),
];

fn of_mesh(code: &str) -> roundel_status {
    let found = OF_MESHES.iter().find(|(known, _)| *known == code);
    found.map_or(ROUNDEL_ERROR_INVALID_ARGUMENT, |(_, status)| *status)
}

impl From<SolveStatus> for roundel_solve_status {
    fn from(status: SolveStatus) -> Self {
        match status {
            SolveStatus::Optimal => ROUNDEL_SOLVE_OPTIMAL,
            SolveStatus::Feasible => ROUNDEL_SOLVE_FEASIBLE,
            SolveStatus::Limit => ROUNDEL_SOLVE_LIMIT,
            SolveStatus::Cancelled => ROUNDEL_SOLVE_CANCELLED,
            SolveStatus::Relaxed => ROUNDEL_SOLVE_RELAXED,
        }
    }
}

impl From<StoppedBy> for roundel_stopped_by {
    fn from(stopped_by: StoppedBy) -> Self {
        match stopped_by {
            StoppedBy::Nothing => ROUNDEL_STOPPED_BY_NONE,
            StoppedBy::Nodes => ROUNDEL_STOPPED_BY_NODES,
            StoppedBy::Time => ROUNDEL_STOPPED_BY_TIME,
            StoppedBy::Memory => ROUNDEL_STOPPED_BY_MEMORY,
            StoppedBy::Cancel => ROUNDEL_STOPPED_BY_CANCEL,
            StoppedBy::Budget => ROUNDEL_STOPPED_BY_BUDGET,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::MeshError;

    #[test]
    fn the_word_for_a_status_is_the_rust_errors_code() {
        let direction = vec![1.0];
        for error in [
            Error::Empty,
            Error::Cancelled,
            Error::TimeLimit,
            Error::SearchLimit { what: "nodes" },
            Error::OutOfMemory { what: "" },
            Error::UnknownOption { name: "".into() },
            Error::NotConvex {
                variable: 0,
                direction,
            },
            Error::NotFinite {
                what: "",
                position: 0,
            },
            Error::Io { message: "".into() },
            Error::LengthMismatch {
                what: "",
                expected: 0,
                actual: 0,
            },
            Error::NoIntegerSolution {
                constraint: 0,
                row: "".into(),
            },
            Error::from(MeshError::NonManifoldVertex { vertex: 0 }),
            Error::from(MeshError::ZeroArea { face: 0 }),
            Error::from(MeshError::IsolatedVertex { vertex: 0 }),
            Error::from(MeshError::RepeatedVertex { face: 0, vertex: 0 }),
            Error::from(MeshError::NotATriangle {
                face: 0,
                corners: 4,
            }),
            Error::from(MeshError::NonManifoldEdge {
                vertices: [0, 1],
                faces: vec![0, 1, 2],
            }),
            Error::from(MeshError::InconsistentOrientation {
                vertices: [0, 1],
                faces: [0, 1],
            }),
        ] {
            let number = roundel_status::from(&error) as i32;
            // SAFETY: the function gives a static text.
            let word = unsafe { CStr::from_ptr(roundel_status_name(number)) };
            assert_eq!(word.to_str(), Ok(error.code()));
        }
    }

    #[test]
    fn the_word_for_what_stopped_a_search_is_that_of_rust() {
        for stopped_by in [
            StoppedBy::Nothing,
            StoppedBy::Nodes,
            StoppedBy::Time,
            StoppedBy::Memory,
            StoppedBy::Cancel,
            StoppedBy::Budget,
        ] {
            let number = roundel_stopped_by::from(stopped_by) as i32;
            // SAFETY: the function gives a static text.
            let word = unsafe { CStr::from_ptr(roundel_stopped_by_name(number)) };
            assert_eq!(word.to_str(), Ok(stopped_by.name()));
        }
    }

    /// The names in the header and the numbers behind them are what other languages bind to.
    #[test]
    fn every_status_has_a_word() {
        let mut seen = 0;
        for line in include_str!("../../include/roundel/roundel.h").lines() {
            let Some((name, number)) = line.trim().trim_end_matches(',').split_once(" = ") else {
                continue;
            };
            let Ok(number) = number.parse::<i32>() else {
                continue;
            };
            let word = if name == "ROUNDEL_OK" || name.starts_with("ROUNDEL_ERROR_") {
                roundel_status_name(number)
            } else if name.starts_with("ROUNDEL_SOLVE_") {
                roundel_solve_status_name(number)
            } else if name.starts_with("ROUNDEL_STOPPED_BY_") {
                roundel_stopped_by_name(number)
            } else {
                continue;
            };
            // SAFETY: the function gives a static text.
            let word = unsafe { CStr::from_ptr(word) }.to_str().unwrap();
            assert!(
                name.to_lowercase().ends_with(word),
                "{name} is called {word}"
            );
            seen += 1;
        }
        assert!(seen >= 36, "only {seen} statuses found in the header");
    }
}
