//! The command line of `roundel census`.

use std::path::PathBuf;

/// Make quads of all meshes of a folder, and show them on a page.
///
/// Every mesh runs in a process of its own, so that none can spoil the others. Its row is added to a file of JSON lines
/// beside the page as soon as it is there: a census that was interrupted goes on where it was, and one whose meshes or
/// flags have changed runs those anew.
#[derive(clap::Args)]
pub struct Arguments {
    /// The folder with the meshes, also in folders of it: .obj, .off, .ply, .stl, .gltf, .glb, also .gz
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,

    /// The page. Rows are kept beside it, in a file with the same name and the extension .jsonl
    #[arg(short = 'o', long = "out", value_name = "PAGE.html")]
    pub page: PathBuf,

    /// How many meshes run at a time; 0: one for each core. The cores are shared between them
    #[arg(long, value_name = "N", default_value_t = 1)]
    pub jobs: usize,

    /// Run every Nth mesh from the Kth on, and write no page: for many machines with one folder. A census without --part
    /// collects the rows of all parts, and runs what they have lost
    #[arg(long, value_name = "K/N", value_parser = part)]
    pub part: Option<Part>,

    /// Seconds after which a mesh is given up
    #[arg(long, value_name = "S", default_value_t = 300.0, value_parser = seconds)]
    pub kill_after: f64,

    /// Write the quads of every mesh to this folder, as OBJ files of its name
    #[arg(long, value_name = "DIR")]
    pub quads_to: Option<PathBuf>,

    /// Print no line for each mesh
    #[arg(short, long)]
    pub quiet: bool,

    /// Flags of `roundel quad` for every mesh, after --
    #[arg(last = true, value_name = "FLAGS")]
    pub flags: Vec<String>,
}

/// A part of the meshes: every `count`th from the `number`th on, which is counted from 1.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Part {
    pub number: usize,
    pub count: usize,
}

fn part(text: &str) -> Result<Part, String> {
    let numbers = text.split_once('/').and_then(|(number, count)| {
        let (number, count) = (number.parse().ok()?, count.parse().ok()?);
        (1..=count)
            .contains(&number)
            .then_some(Part { number, count })
    });
    numbers.ok_or_else(|| "expected a part and the number of parts, such as 3/8".into())
}

fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(seconds) if seconds > 0.0 && f64::is_finite(seconds) => Ok(seconds),
        _ => Err("the number of seconds must be above 0".into()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_are_counted_from_one() {
        let last = Part {
            number: 8,
            count: 8,
        };
        assert_eq!(part("8/8"), Ok(last));
        for text in ["0/8", "9/8", "3", "3/", "/3", "0/0", "-1/2", "a/b"] {
            assert!(part(text).is_err(), "{text}");
        }
    }

    #[test]
    fn a_limit_is_a_number_of_seconds() {
        assert_eq!(seconds("1.5"), Ok(1.5));
        for text in ["0", "-1", "inf", "nan", "soon"] {
            assert!(seconds(text).is_err(), "{text}");
        }
    }
}
