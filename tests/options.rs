//! The options of the C++ headers and of the book are those of the library's tables.
//!
//! `ROUNDEL_BLESS=1 cargo test --test options` writes them anew, between the marks in these files.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use roundel::field::GUIDANCE_OPTIONS;
use roundel::quad::{QUAD_OPTIONS, QuadOptions};
use roundel::search::{OPTIONS, OptionInfo, OptionKind, OptionValue, UNSET};
use roundel::soup::REPAIR_OPTIONS;

/// What `Features` and the class of crosses say in C++.
const OF_FEATURES: &[&str] = &["feature_angle", "align_boundary"];
const OF_FIELDS: &[&str] = &["feature_angle", "align_boundary", "symmetry"];

#[test]
fn the_options_of_a_solve_are_in_cpp() {
    hold("options.hpp", "Options", &[("option", OPTIONS, &[])]);
}

#[test]
fn the_options_of_fields_are_in_cpp() {
    let guidance = ("guidance_option", GUIDANCE_OPTIONS, OF_FEATURES);
    hold("field.hpp", "FieldOptions", &[guidance]);
}

#[test]
fn the_options_of_quads_are_in_cpp() {
    let guidance = ("guidance_option", GUIDANCE_OPTIONS, OF_FIELDS);
    let tables = [("quad_option", QUAD_OPTIONS, &[][..]), guidance];
    hold("quads.hpp", "QuadOptions", &tables);
}

#[test]
fn the_options_of_repair_are_in_cpp() {
    let repair = ("repair_option", REPAIR_OPTIONS, &[][..]);
    hold("repair.hpp", "RepairOptions", &[repair]);
}

#[test]
fn the_options_of_the_book_are_the_librarys() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/options.md");
    let committed = fs::read_to_string(&path).unwrap();
    let mut fresh = committed.clone();
    for (heading, table) in [
        ("All options of a solve", OPTIONS),
        ("Options of the guidance", GUIDANCE_OPTIONS),
        ("Options of quads", QUAD_OPTIONS),
        ("Options of repair", REPAIR_OPTIONS),
    ] {
        fresh = with_rows(&fresh, heading, table);
    }
    bless(&path, &committed, &fresh);
}

/// The page with one row an option in the table below a heading.
fn with_rows(page: &str, heading: &str, options: &[OptionInfo]) -> String {
    let head = "| --- | --- | --- | --- |\n";
    let heading = format!("## {heading}\n");
    let at = page.find(&heading).expect(&heading);
    let begin = at + page[at..].find(head).expect(&heading) + head.len();
    let end = begin + page[begin..].find("\n\n").expect(&heading) + 1;
    let rows = options.iter().map(|info| {
        let range = info.range.replace('|', ", ");
        format!(
            "| `{}` | {} | {range} | {} |\n",
            info.name, info.default, info.text
        )
    });
    let rows: String = rows.collect();
    format!("{}{rows}{}", &page[..begin], &page[end..])
}

/// Writes the fresh text where that is asked for, and holds the committed one to it elsewhere.
fn bless(path: &Path, committed: &str, fresh: &str) {
    if std::env::var_os("ROUNDEL_BLESS").is_some_and(|v| v == "1") {
        fs::write(path, fresh).unwrap();
    } else {
        let file = path.display();
        assert!(
            committed == fresh,
            "{file} has drifted: ROUNDEL_BLESS=1 cargo test --test options"
        );
    }
}

/// A table, what one of its entries is called, and those that stand elsewhere.
type Part = (&'static str, &'static [OptionInfo], &'static [&'static str]);

fn hold(file: &str, name: &str, parts: &[Part]) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("include/roundel/detail")
        .join(file);
    let committed = fs::read_to_string(&path).unwrap();
    let (mut members, mut setters, mut lists) = (String::new(), String::new(), String::new());
    for (entry, table, elsewhere) in parts {
        let here = table.iter().filter(|info| !elsewhere.contains(&info.name));
        let here: Vec<_> = here.collect();
        for info in &here {
            members += &member(info, &default_of(name, info));
            setters += &setter(name, info);
        }
        lists += &list(name, entry, &here);
    }
    let mut fresh = between(&committed, "members", &members);
    fresh = between(&fresh, "setters", &setters);
    fresh = between(&fresh, "lists", &lists);
    bless(&path, &committed, &fresh);
}

/// What an option is where nobody sets it: quads have a guidance of their own.
fn default_of(class: &str, info: &OptionInfo) -> String {
    let of_quads = QuadOptions::default().guidance.get(info.name);
    match (class, of_quads) {
        ("QuadOptions", Ok(OptionValue::Real(number))) => number.to_string(),
        _ => info.default.into(),
    }
}

/// The text with `inner` between the two marks of this name.
fn between(text: &str, mark: &str, inner: &str) -> String {
    let (begin, end) = (
        format!("// Table of options: {mark}.\n"),
        "// End of the table.\n",
    );
    let (before, rest) = text.split_once(&begin).expect(mark);
    let (old, after) = rest.split_once(end).expect(mark);
    let indent = old.rsplit('\n').next().unwrap_or_default();
    format!("{before}{begin}{inner}{indent}{end}{after}")
}

fn cpp_type(info: &OptionInfo) -> &'static str {
    match info.kind {
        OptionKind::Integer if info.range == "[0, 1]" => "bool",
        OptionKind::Integer => "std::int64_t",
        OptionKind::Real => "double",
        OptionKind::Text => "std::string",
    }
}

/// The sentence of the table and what else is to be known, in lines of a comment.
fn comment(info: &OptionInfo, default: &str) -> String {
    let mut letters = info.text.chars();
    let first = letters.next().unwrap().to_uppercase();
    let default = match default {
        UNSET => String::new(),
        default => format!("; {default} by default"),
    };
    let range = match info.kind {
        OptionKind::Text => format!("One of {}", info.range.replace('|', ", ")),
        _ => format!("In {}", info.range.replace('|', ", ")),
    };
    let text = format!("{first}{}. {range}{default}.", letters.as_str());
    let mut lines = String::from("    ///");
    let mut width = lines.len();
    for word in text.split(' ') {
        if width + 1 + word.len() > 100 {
            lines += "\n    ///";
            width = 7;
        }
        write!(lines, " {word}").unwrap();
        width += 1 + word.len();
    }
    lines
}

fn member(info: &OptionInfo, default: &str) -> String {
    let (name, of, comment) = (info.name, cpp_type(info), comment(info, default));
    format!(
        "{comment}
    std::optional<{of}> {name} = std::nullopt;
"
    )
}

fn setter(class: &str, info: &OptionInfo) -> String {
    let (name, of) = (info.name, cpp_type(info));
    let value = if of == "std::string" {
        "std::move(value)"
    } else {
        "value"
    };
    format!(
        "    {class}& set_{name}({of} value) {{\n        {name} = {value};\n        return *this;\n    }}\n"
    )
}

/// A function that tells each option that is set.
fn list(class: &str, entry: &str, here: &[&OptionInfo]) -> String {
    let mut text = format!(
        "template <class Tell> bool each_{entry}(const {class}& options, const Tell& tell) {{\n"
    );
    for info in here {
        let name = info.name;
        let (is_set, told) = (
            format!("    if (options.{name} &&"),
            format!("!tell(\"{name}\", *options.{name})) {{"),
        );
        // As clang-format breaks it.
        let gap = if is_set.len() + 1 + told.len() > 100 {
            "\n        "
        } else {
            " "
        };
        writeln!(text, "{is_set}{gap}{told}\n        return false;\n    }}").unwrap();
    }
    text + "    return true;\n}\n"
}
