//! What `--json` prints is what the schema in the book says, for every command.

use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

use serde_json::{Map, Value};

use crate::layout::{CUBE, cube_around_the_origin};
use crate::problem::mps;
use crate::run::{Scratch, finish, only_object, program};

/// The parts of JSON Schema that `docs/program.schema.json` uses.
struct Schema(Value);

/// A schema and all that it includes.
type Parts<'a> = Vec<&'a Map<String, Value>>;

impl Schema {
    fn of_the_book() -> Self {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
        let text = fs::read_to_string(root.join("docs/program.schema.json")).unwrap();
        Schema(serde_json::from_str(&text).unwrap())
    }

    fn definition(&self, name: &str) -> &Value {
        let found = &self.0["$defs"][name];
        assert!(found.is_object(), "no definition of {name}");
        found
    }

    /// The schema, what it refers to, and what it is composed of.
    fn parts<'a>(&'a self, schema: &'a Value, parts: &mut Parts<'a>) {
        let schema = schema.as_object().expect("a schema is an object");
        parts.push(schema);
        if let Some(target) = schema.get("$ref") {
            let name = target.as_str().unwrap().strip_prefix("#/$defs/").unwrap();
            self.parts(self.definition(name), parts);
        }
        for part in schema
            .get("allOf")
            .and_then(Value::as_array)
            .into_iter()
            .flatten()
        {
            self.parts(part, parts);
        }
    }

    /// Checks `value`, which is at `place`.
    fn check(&self, schema: &Value, value: &Value, place: &str) -> Result<(), String> {
        let mut parts = Parts::new();
        self.parts(schema, &mut parts);
        let mut known = BTreeSet::new();
        for part in &parts {
            for (word, rule) in *part {
                self.rule(word, rule, value, place)?;
                if word == "properties" {
                    known.extend(rule.as_object().unwrap().keys());
                }
            }
        }
        let is_closed = parts
            .iter()
            .any(|part| part.get("unevaluatedProperties") == Some(&Value::Bool(false)));
        if let Some(members) = value.as_object().filter(|_| is_closed) {
            let stranger = members.keys().find(|key| !known.contains(key));
            match stranger {
                Some(key) => return Err(format!("{place}/{key} is not in the schema")),
                None => return Ok(()),
            }
        }
        Ok(())
    }

    fn rule(&self, word: &str, rule: &Value, value: &Value, place: &str) -> Result<(), String> {
        let holds = match word {
            "description" | "$ref" | "allOf" | "unevaluatedProperties" => true,
            "type" => match rule {
                Value::Array(kinds) => kinds.iter().any(|kind| is_of(value, kind)),
                kind => is_of(value, kind),
            },
            "const" => value == rule,
            "enum" => rule.as_array().unwrap().contains(value),
            "minimum" => value.as_f64().is_none_or(|x| x >= rule.as_f64().unwrap()),
            "minItems" => value
                .as_array()
                .is_none_or(|v| v.len() as u64 >= rule.as_u64().unwrap()),
            "maxItems" => value
                .as_array()
                .is_none_or(|v| v.len() as u64 <= rule.as_u64().unwrap()),
            "required" => {
                let keys = rule.as_array().unwrap().iter();
                let missing = keys
                    .filter_map(Value::as_str)
                    .find(|key| value.get(key).is_none());
                return missing.map_or(Ok(()), |key| Err(format!("{place}/{key} is missing")));
            }
            "anyOf" => {
                let mut others = rule.as_array().unwrap().iter();
                others.any(|other| self.check(other, value, place).is_ok())
            }
            "items" => {
                let mut elements = value.as_array().into_iter().flatten().enumerate();
                return elements.try_for_each(|(i, element)| {
                    self.check(rule, element, &format!("{place}/{i}"))
                });
            }
            "properties" => {
                let members = rule.as_object().unwrap().iter();
                let mut given =
                    members.filter_map(|(key, rule)| Some((key, rule, value.get(key)?)));
                return given.try_for_each(|(key, rule, value)| {
                    self.check(rule, value, &format!("{place}/{key}"))
                });
            }
            "additionalProperties" => {
                let mut members = value.as_object().into_iter().flatten();
                return members.try_for_each(|(key, value)| {
                    self.check(rule, value, &format!("{place}/{key}"))
                });
            }
            other => panic!("the test does not know {other}"),
        };
        match holds {
            true => Ok(()),
            false => Err(format!("{place}: {value} is not {word} {rule}")),
        }
    }
}

fn is_of(value: &Value, kind: &Value) -> bool {
    match kind.as_str().unwrap() {
        "null" => value.is_null(),
        "boolean" => value.is_boolean(),
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        other => panic!("no type {other}"),
    }
}

/// The object that a command line prints with `--json`.
fn printed(words: &[&str]) -> Value {
    let (_, output) = finish(program(&[words, &["--json"]].concat()));
    only_object(&output)
}

#[test]
fn every_command_prints_what_the_schema_says() {
    let schema = Schema::of_the_book();
    let scratch = Scratch::new("schema");
    let path = |name: &str| scratch.path(name).to_str().unwrap().to_owned();
    let (uv, problem) = (path("uv.obj"), path("problem.mps"));
    fs::write(
        &problem,
        mps(
            &[],
            &[("I", "OBJ", -0.8)],
            &[("OBJ", -1.16)],
            &[("I", "I", 4.0)],
        ),
    )
    .unwrap();
    let soup = path("soup.obj");
    fs::write(
        &soup,
        "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nf 1 2 3 4\nf 5 2 3\n",
    )
    .unwrap();
    // Two folded triangles, whose quads do not conform.
    let folded = path("folded.obj");
    let square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 1\n";
    fs::write(&folded, format!("{square}f 1/1 2/2 3/3\nf 1/1 3/3 4/2\n")).unwrap();
    let (cube, patches) = (path("cube.obj"), path("patches.json"));
    fs::write(&cube, CUBE).unwrap();
    let around = path("around.obj");
    fs::write(&around, cube_around_the_origin()).unwrap();
    let shape = "shape:torus:300";
    let proof = path("proof.jsonl");
    // A curve beside the torus.
    let lines = path("lines.obj");
    fs::write(&lines, "v 1.4 0.1 0\nv 0.2 1.4 0\nl 1 2\n").unwrap();
    let runs: [(&str, &[&str]); 25] = [
        ("solve", &["solve", &problem]),
        ("solve", &["solve", &problem, "--strategy", "relax"]),
        ("solve", &["solve", &problem, "--proof", &proof]),
        ("check_proof", &["check-proof", &proof]),
        ("check_proof", &["check-proof", &problem]),
        ("field", &["field", shape]),
        ("distance", &["distance", shape, "--from", "vertex:3"]),
        (
            "parametrize",
            &["parametrize", shape, "--quads", "100", "-o", &uv],
        ),
        (
            "parametrize",
            &["parametrize", "shape:gear:200", "--edge-length", "0.1"],
        ),
        ("check", &["check", &uv]),
        ("check", &["check", &folded, "--features", "10"]),
        ("extract", &["extract", &uv]),
        ("extract", &["extract", &folded]),
        (
            "quad",
            &[
                "quad",
                shape,
                "--quads",
                "100",
                "--compare-strategies",
                "direct,relax",
            ],
        ),
        (
            "quad",
            &[
                "quad",
                "shape:gear:200",
                "--quads",
                "300",
                "--measure-distance",
            ],
        ),
        ("field", &["field", shape, "--guide-curves", &lines]),
        (
            "parametrize",
            &["parametrize", shape, "--feature-curves", &lines],
        ),
        ("quad", &["quad", shape, "--feature-curves", &lines]),
        (
            "quad",
            &["quad", shape, "--mirror", "auto", "--mirror", "-z"],
        ),
        ("repaired", &["repair", &soup]),
        ("layout", &["layout", "--of", &cube]),
        (
            "layout_quads",
            &[
                "layout",
                "shape:sphere:300",
                "--layout",
                &around,
                "--fewest",
            ],
        ),
        (
            "layout",
            &[
                "layout",
                "--of",
                &cube,
                "--kind",
                "simplified",
                "--patches",
                &patches,
            ],
        ),
        ("failure", &["quad", "nothing.obj"]),
        ("failure", &["solve", &problem, "--time-limit", "0"]),
    ];
    for (kind, words) in runs {
        let object = printed(words);
        if let Err(reason) = schema.check(schema.definition(kind), &object, "") {
            panic!("{words:?}: {reason}");
        }
        // Every object is of one of the kinds that the schema lists, and of that alone.
        let kinds = schema.0["anyOf"].as_array().unwrap();
        let fits = kinds
            .iter()
            .filter(|kind| schema.check(kind, &object, "").is_ok());
        assert_eq!(fits.count(), 1, "{words:?}");
    }
}

#[test]
fn the_schema_refuses_what_is_missing_new_or_of_another_type() {
    let schema = Schema::of_the_book();
    let good = printed(&["field", "shape:torus:200"]);
    let check = |change: &dyn Fn(&mut Map<String, Value>)| {
        let mut object = good.clone();
        change(object.as_object_mut().unwrap());
        schema.check(schema.definition("field"), &object, "")
    };
    assert_eq!(check(&|_| {}), Ok(()));
    assert!(check(&|o| drop(o.remove("index_sum"))).is_err());
    assert!(check(&|o| drop(o.insert("news".into(), 1.into()))).is_err());
    assert!(check(&|o| drop(o.insert("faces".into(), (-1).into()))).is_err());
    assert!(check(&|o| drop(o.insert("status".into(), "done".into()))).is_err());
    assert!(check(&|o| drop(o.insert("schema".into(), 2.into()))).is_err());
    let seconds =
        |o: &mut Map<String, Value>| drop(o["seconds"].as_object_mut().unwrap().remove("read"));
    assert!(check(&seconds).is_err());
}
