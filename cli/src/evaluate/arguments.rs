//! The command line of `roundel evaluate`.

use std::path::PathBuf;

/// Run the tables of Bommes' thesis (5.1 to 5.4, and the ordering), and write them as CSV and as a page
/// with plots, beside the figures of the thesis and of its program.
///
/// Each solve runs in a process of its own, on one thread.
#[derive(clap::Args)]
pub struct Arguments {
    /// The folder for index.html and one CSV file for each table
    #[arg(long, value_name = "OUT")]
    pub tables: PathBuf,

    /// The folder with the meshes: rockerarm_200, _1k, _2k, _20k, armadillo_10k, _50k, _200k, _800k and
    /// cube_10k to _800k, each .obj, .off or .ply. Procedural ones of about their size replace those
    /// that are missing; 800k is also made from 200k, by midpoint subdivision
    #[arg(long, value_name = "DIR")]
    pub meshes: Option<PathBuf>,

    /// Also show what other solvers made of the corpus: the CSV file that scripts/other-solvers writes
    #[arg(long, value_name = "FILE.csv")]
    pub other_solvers: Option<PathBuf>,

    /// Leave out larger meshes; a table without any smaller mesh is run on procedural meshes of at most
    /// this size
    #[arg(long, value_name = "N", default_value_t = usize::MAX, hide_default_value = true)]
    #[arg(value_parser = triangles)]
    pub max_triangles: usize,

    /// Seconds for each solve; a solver that reaches the limit is not run on larger meshes
    #[arg(long, value_name = "S", default_value_t = 300.0, value_parser = seconds)]
    #[arg(allow_negative_numbers = true)]
    pub time_limit: f64,
}

fn triangles(text: &str) -> Result<usize, String> {
    /// Smaller meshes are not worth a solve.
    const LEAST: usize = 200;
    match text.parse() {
        Ok(n) if n >= LEAST => Ok(n),
        _ => Err(format!("the number of triangles must be at least {LEAST}")),
    }
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if seconds > 0.0 => Ok(seconds),
        _ => Err("the number of seconds must be above 0".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::{seconds, triangles};

    #[test]
    fn limits_are_numbers_that_leave_something_to_run() {
        assert_eq!((triangles("2000"), seconds("0.5")), (Ok(2000), Ok(0.5)));
        for text in ["199", "-1", "many", ""] {
            assert!(triangles(text).is_err(), "{text}");
        }
        for text in ["0", "-1", "nan", "soon"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }
}
