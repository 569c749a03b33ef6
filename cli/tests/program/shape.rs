//! `roundel shape`: procedural meshes as files.

use roundel::mesh::{io, jitter, shape};

use crate::run::{Scratch, finish, program};

#[test]
fn every_shape_is_written_as_the_library_makes_it() {
    let scratch = Scratch::new("shapes");
    for (name, _) in shape::NAMES {
        let name = name.replace('N', "3");
        let out = scratch.path(&format!("{name}.off"));
        let words = ["shape", &name, "--triangles", "700", "-o"];
        let mut command = program(&words);
        command.arg(&out);
        assert_eq!(finish(command).0, 0, "{name}");
        let expected = shape::by_name(&name, 700).unwrap();
        let mesh = io::read(&out).unwrap();
        assert_eq!(mesh.vertices(), expected.vertices(), "{name}");
        assert_eq!(mesh.triangles(), expected.triangles(), "{name}");
    }
}

#[test]
fn jitter_is_that_of_its_seed() {
    let scratch = Scratch::new("jitter");
    let out = scratch.path("torus.ply");
    let words = ["shape", "torus", "--triangles", "300"];
    let noise = ["--jitter", "1e-3", "--seed", "7", "-o"];
    let mut command = program(&[&words[..], &noise[..]].concat());
    command.arg(&out);
    assert_eq!(finish(command).0, 0);
    let plain = shape::by_name("torus", 300).unwrap();
    let expected = jitter(&plain, 1e-3, 7).unwrap();
    let mesh = io::read(&out).unwrap();
    assert_eq!(mesh.vertices(), expected.vertices());
    assert_ne!(mesh.vertices(), plain.vertices());
}

#[test]
fn what_cannot_be_drawn_or_written_is_one_line_on_stderr() {
    let scratch = Scratch::new("no-shape");
    let out = scratch.path("out.obj");
    let out = out.to_str().unwrap();
    for (words, says) in [
        (&["teapot", "-o", out][..], "no shape 'teapot'"),
        (
            &["torus", "--triangles", "0", "-o", out],
            "number of triangles is 0",
        ),
        (
            &["torus", "--jitter", "-1", "-o", out],
            "jitter amplitude is -1",
        ),
        (&["torus", "-o", "torus.3mf"], "'3mf' is not a mesh format"),
        (&["torus", "-o", "no-such-folder/t.obj"], "t.obj: "),
    ] {
        let (code, output) = finish(program(&[&["shape"], words].concat()));
        let text = String::from_utf8(output.stderr).unwrap();
        assert_eq!((code, text.lines().count()), (1, 1), "{text}");
        assert!(text.contains(says), "{text}");
        assert_eq!(output.stdout, b"");
    }
}

#[test]
fn the_help_lists_every_shape() {
    let (_, output) = finish(program(&["shape", "--help"]));
    let text = String::from_utf8(output.stdout).unwrap();
    for (name, what) in shape::NAMES {
        assert!(text.contains(name) && text.contains(what), "{text}");
    }
}

#[test]
fn a_shape_or_flag_or_command_that_is_misspelt_is_guessed() {
    for (words, says) in [
        (
            &["quad", "shape:gaer:100", "--json"][..],
            "did you mean 'gear'?",
        ),
        (&["shape", "tours", "-o", "x.obj"], "did you mean 'torus'?"),
        (
            &["quad", "shape:gear", "--edge-lenght", "1"],
            "'--edge-length'",
        ),
        (&["quda", "shape:gear"], "'quad'"),
    ] {
        let (code, output) = finish(program(words));
        assert_ne!(code, 0);
        let text = [output.stdout, output.stderr].concat();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains(says), "{text}");
    }
}

#[test]
fn completions_and_manual_pages_know_every_command() {
    let scratch = Scratch::new("generated");
    let folder = scratch.path("");
    let (code, _) = finish(program(&["generate", folder.to_str().unwrap()]));
    assert_eq!(code, 0);
    let read = |name: &str| std::fs::read_to_string(scratch.path(name)).unwrap();
    for name in ["bash/roundel.bash", "zsh/_roundel", "fish/roundel.fish"] {
        let text = read(&format!("completions/{name}"));
        assert!(
            text.contains("parametrize") && text.contains("edge-length"),
            "{name}"
        );
    }
    assert!(read("man1/roundel.1").contains("quad"));
    assert!(read("man1/roundel-quad.1").contains("edge\\-length"));
}
