//! Fields as text files: for each face one line `X Y Z`, a direction, which is one arm of its cross.
//!
//! libigl and its users call this a per-face field. Crosses match over an edge by their nearest
//! arms. If a field needs another matching, a line `jump FACE SIDE P` after the directions gives
//! it: after the unfolding over local edge SIDE, P quarter turns lead from the arm of FACE to the
//! arm across. Elements are counted from 0; empty lines and text after a `#` are ignored. A field
//! of another symmetry than 4 starts with a line `symmetry N`.

use std::f64::consts::TAU;
use std::fs::File;
use std::io::{self, Write};
use std::path::Path;

use super::OrientationField;
use super::directions::angle;
use crate::error::{Error, Result};
use crate::mesh::vector::Vec3;
use crate::mesh::{MeshError, TriangleMesh};
use crate::monitor::{filter_in_parts, write_lines};

/// The least number of edges that are worth a thread.
const LEAST: usize = 1 << 12;

impl OrientationField {
    /// Reads the field of a mesh from a text file.
    ///
    /// # Errors
    /// [`Error::Io`]; [`Error::Parse`] with the line for what is not three numbers or a jump, a
    /// direction that does not lie in its face, a jump over no interior edge of the mesh, or
    /// other than one direction a face.
    pub fn read(mesh: &TriangleMesh, path: impl AsRef<Path>) -> Result<Self> {
        let path = path.as_ref();
        let text = std::fs::read(path).map_err(|reason| MeshError::of_file(path, &reason))?;
        Self::parse(mesh, &String::from_utf8_lossy(&text))
    }

    /// Reads the field of a mesh from the contents of a file.
    ///
    /// # Errors
    /// Those of [`read`](Self::read).
    pub fn parse(mesh: &TriangleMesh, text: &str) -> Result<Self> {
        parse(mesh, text)
    }

    /// Writes the field to a text file, such that reading gives the same crosses (to the last
    /// digits) and the same matching.
    ///
    /// # Errors
    /// [`Error::LengthMismatch`] for another mesh, [`Error::Io`].
    pub fn write(&self, mesh: &TriangleMesh, path: impl AsRef<Path>) -> Result<()> {
        self.check_mesh(mesh)?;
        let path = path.as_ref();
        let file = File::create(path).and_then(|file| self.encode(mesh, file));
        Ok(file.map_err(|reason| MeshError::of_file(path, &reason))?)
    }

    fn encode(&self, mesh: &TriangleMesh, mut out: impl Write) -> io::Result<()> {
        if self.symmetry != 4 {
            writeln!(out, "symmetry {}", self.symmetry)?;
        }
        write_lines(&mut out, mesh.face_count(), |face, text| {
            let [x, y, z] = self.direction(mesh, face);
            writeln!(text, "{x} {y} {z}")
        })?;
        // Full turns of a face's angle, which its direction does not keep.
        let turns = |face: usize| {
            let direction = self.direction(mesh, face);
            let read = angle(mesh, face, direction).unwrap_or(self.angles[face]);
            ((self.angles[face] - read) / TAU).round() as i32
        };
        let of_file = filter_in_parts(mesh.edge_count(), LEAST, |e| {
            let is_interior = mesh.edge(e).second.is_some();
            is_interior && self.period_jumps[e] != self.nearest_jump(mesh, e)
        });
        write_lines(&mut out, of_file.len(), |k, text| {
            let (e, edge) = (of_file[k], mesh.edge(of_file[k]));
            let ((face, side), Some((across, _))) = (edge.first, edge.second) else {
                return Ok(());
            };
            let full = turns(face) - turns(across);
            let jump = self.period_jumps[e] + i32::from(self.symmetry) * full;
            writeln!(text, "jump {face} {side} {jump}")
        })?;
        out.flush()
    }
}

fn parse(mesh: &TriangleMesh, text: &str) -> Result<OrientationField> {
    let mut directions: Vec<Vec3> = Vec::with_capacity(mesh.face_count());
    let mut at_line = Vec::with_capacity(mesh.face_count());
    let mut jumps = Vec::new();
    let mut symmetry = 4;
    for (line, content) in (1..).zip(text.lines()) {
        let content = content.split('#').next().unwrap_or_default();
        let words: Vec<&str> = content.split_whitespace().collect();
        match words[..] {
            [] => {}
            ["symmetry", arms] if directions.is_empty() => symmetry = arms_of(line, arms)?,
            ["jump", face, side, jump] => jumps.push((line, jump_of(line, [face, side, jump])?)),
            [x, y, z] if jumps.is_empty() => {
                directions.push(direction(line, [x, y, z])?);
                at_line.push(line);
            }
            _ => {
                return Err(wrong(
                    line,
                    "expected a direction X Y Z or jump FACE SIDE P",
                ));
            }
        }
        if directions.len() > mesh.face_count() {
            let faces = mesh.face_count();
            return Err(wrong(
                line,
                &format!("there are more directions than the {faces} faces of the mesh"),
            ));
        }
    }
    if directions.len() < mesh.face_count() {
        let (given, faces) = (directions.len(), mesh.face_count());
        let message = format!("the file ends after {given} directions: the mesh has {faces} faces");
        return Err(wrong(text.lines().count().max(1), &message));
    }
    let field = OrientationField::matched(mesh, &directions, symmetry);
    let mut field = field.map_err(|error| {
        let line = error.index().and_then(|face| at_line.get(face));
        wrong(line.copied().unwrap_or(1), &error.to_string())
    })?;
    for (line, jump) in jumps {
        set_jump(mesh, &mut field, line, jump)?;
    }
    Ok(field)
}

fn arms_of(line: usize, arms: &str) -> Result<u8> {
    let arms: Option<u8> = arms.parse().ok();
    let known = arms.filter(|arms| [1, 2, 4, 6].contains(arms));
    known.ok_or_else(|| wrong(line, "the symmetry must be 1, 2, 4 or 6"))
}

fn direction(line: usize, words: [&str; 3]) -> Result<Vec3> {
    let mut numbers = [0.0; 3];
    for (number, word) in numbers.iter_mut().zip(words) {
        *number = word
            .parse()
            .map_err(|_| wrong(line, &format!("'{word}' is not a number")))?;
    }
    Ok(numbers)
}

/// Face, side and quarter turns.
type Jump = (usize, usize, i32);

fn jump_of(line: usize, [face, side, jump]: [&str; 3]) -> Result<Jump> {
    let numbers = (face.parse(), side.parse(), jump.parse());
    match numbers {
        (Ok(face), Ok(side), Ok(jump)) => Ok((face, side, jump)),
        _ => Err(wrong(line, "a jump needs three integers: jump FACE SIDE P")),
    }
}

fn set_jump(
    mesh: &TriangleMesh,
    field: &mut OrientationField,
    line: usize,
    (face, side, jump): Jump,
) -> Result<()> {
    /// Angles lie within one turn, so that no meaningful jump is as large.
    const LARGEST: i32 = 1 << 20;
    let exists = face < mesh.face_count() && side < 3;
    if !exists || mesh.neighbor(face, side).is_none() || jump.abs() > LARGEST {
        let message = format!(
            "side {side} of face {face} is no interior edge, or the jump {jump} is too large"
        );
        return Err(wrong(line, &message));
    }
    field.period_jumps[mesh.edge_of(face, side)] = mesh.out_of(face, side, jump);
    Ok(())
}

fn wrong(line: usize, message: &str) -> Error {
    Error::Parse {
        line,
        message: message.into(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::field::{FieldOptions, FieldProblem, curvature_constraints};
    use crate::mesh::shape;
    use crate::search::{Options, Strategy};
    use crate::solve::solve;

    /// A field by direct rounding, with one edge matched by other than the nearest arms.
    fn rounded(name: &str) -> (TriangleMesh, OrientationField) {
        let mesh = shape::by_name(name, 1_200).unwrap();
        let given = curvature_constraints(&mesh, 0.05).unwrap();
        let problem = FieldProblem::new(&mesh, &given).unwrap();
        let options = Options {
            strategy: Strategy::Direct,
            ..Options::default()
        };
        let solution = solve(problem.problem(), &options).unwrap();
        let mut field = problem.field(&mesh, &solution).unwrap();
        let inner = mesh.edges().position(|e| e.second.is_some()).unwrap();
        field.period_jumps[inner] += 3;
        (mesh, field)
    }

    fn again(mesh: &TriangleMesh, field: &OrientationField) -> (String, OrientationField) {
        let mut bytes = Vec::new();
        field.encode(mesh, &mut bytes).unwrap();
        let text = String::from_utf8(bytes).unwrap();
        let read = parse(mesh, &text).unwrap();
        (text, read)
    }

    /// What is left of an edge's angle once its jump is made.
    fn residual(mesh: &TriangleMesh, field: &OrientationField, e: usize) -> f64 {
        let edge = mesh.edge(e);
        let Some((j, _)) = edge.second else {
            return 0.0;
        };
        let turn = field.kappa[e] + field.step() * f64::from(field.period_jumps[e]);
        field.angles[edge.first.0] + turn - field.angles[j]
    }

    #[test]
    fn what_is_written_is_read_as_the_same_field() {
        for name in ["rounded-cube", "gear", "genus-2", "plate-with-holes"] {
            let (mesh, field) = rounded(name);
            let (text, read) = again(&mesh, &field);
            assert!(text.contains("\njump "), "{name}");
            for e in 0..mesh.edge_count() {
                let [a, b] = [&field, &read].map(|f| residual(&mesh, f, e));
                assert!((a - b).abs() < 1e-9, "{name}: edge {e} {a} {b}");
            }
            let [a, b] = [&field, &read].map(|f| f.irregular_vertices(&mesh));
            assert_eq!(a, b, "{name}");
        }
    }

    #[test]
    fn full_turns_of_an_angle_are_no_turns_of_a_direction() {
        let (mesh, mut field) = rounded("gear");
        let before: Vec<f64> = (0..mesh.edge_count())
            .map(|e| residual(&mesh, &field, e))
            .collect();
        // Face 3 turned around twice, its jumps with it.
        field.angles[3] += 2.0 * TAU;
        for k in 0..3 {
            let e = mesh.edge_of(3, k);
            let leaves = mesh.edge(e).first == (3, k);
            field.period_jumps[e] += if leaves { -8 } else { 8 };
        }
        let read = again(&mesh, &field).1;
        for (e, before) in before.iter().enumerate() {
            assert!((residual(&mesh, &read, e) - before).abs() < 1e-9, "{e}");
        }
    }

    #[test]
    fn a_field_of_any_symmetry_is_read_as_it_was_written() {
        let mesh = shape::by_name("torus", 800).unwrap();
        for symmetry in [1, 2, 4, 6] {
            let options = FieldOptions {
                symmetry,
                ..FieldOptions::default()
            };
            let problem = FieldProblem::with_options(&mesh, &options).unwrap();
            let solution = solve(problem.problem(), &Options::default()).unwrap();
            let field = problem.field(&mesh, &solution).unwrap();
            let (text, read) = again(&mesh, &field);
            assert_eq!(text.starts_with("symmetry"), symmetry != 4);
            assert_eq!(read.symmetry(), symmetry);
            for e in 0..mesh.edge_count() {
                let [a, b] = [&field, &read].map(|f| residual(&mesh, f, e));
                assert!((a - b).abs() < 1e-9, "{symmetry}: edge {e} {a} {b}");
            }
        }
    }

    #[test]
    fn lengths_comments_and_normal_parts_do_not_matter() {
        let (mesh, field) = rounded("sphere");
        let mut text = String::from("# a field\n\n");
        for face in 0..mesh.face_count() {
            let (d, n) = (field.direction(&mesh, face), mesh.normal(face));
            let [x, y, z] = [0, 1, 2].map(|i| 1e-200 * (3.0 * d[i] + n[i]));
            text += &format!("  {x} {y}\t{z} # face {face}\n");
        }
        let read = parse(&mesh, &text).unwrap();
        for face in 0..mesh.face_count() {
            let [a, b] = [&field, &read].map(|f| f.direction(&mesh, face));
            let apart = (0..3).map(|i| (a[i] - b[i]).abs()).fold(0.0, f64::max);
            assert!(apart < 1e-12, "{face}");
        }
    }

    #[test]
    fn what_is_wrong_is_named_by_its_line() {
        let mesh = shape::by_name("plane", 2).unwrap();
        let inner = (0..3).find(|&k| mesh.neighbor(0, k).is_some()).unwrap();
        let faces = "1 0 0\n".repeat(mesh.face_count());
        assert!(parse(&mesh, &format!("{faces}jump 0 {inner} 4\n")).is_ok());
        let last = mesh.face_count();
        let outer = (0..3).find(|&k| mesh.neighbor(0, k).is_none()).unwrap();
        let cases = [
            (String::new(), 1),
            ("1 0 0\n".into(), 1),
            ("1 0 0\n\n1 0\n".into(), 3),
            ("1 0 0\n1 zero 0\n".into(), 2),
            (faces.replacen("1 0 0", "0 0 1", 1), 1),
            (faces.replacen("1 0 0", "0 0 0", 1), 1),
            (faces.replacen("1 0 0", "1 nan 0", 1), 1),
            (format!("# more\n{faces}1 0 0\n"), last + 2),
            (format!("{faces}jump 0 {outer} 1\n"), last + 1),
            (format!("{faces}jump 0 3 1\n"), last + 1),
            (format!("{faces}jump {last} 0 1\n"), last + 1),
            (format!("{faces}jump 0 {inner} x\n"), last + 1),
            (format!("{faces}jump 0 {inner} 99999999\n"), last + 1),
            (format!("jump 0 {inner} 1\n{faces}"), 2),
            (format!("symmetry 3\n{faces}"), 1),
            (format!("{faces}symmetry 4\n"), last + 1),
        ];
        for (text, line) in cases {
            match parse(&mesh, &text) {
                Err(Error::Parse { line: found, .. }) => assert_eq!(found, line, "{text}"),
                other => panic!("{text}: {other:?}"),
            }
        }
    }
}
