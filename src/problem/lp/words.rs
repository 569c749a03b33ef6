//! The reserved words of LP files, and the characters of names.

/// The parts of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Section {
    Minimize,
    Maximize,
    SubjectTo,
    Bounds,
    General,
    Binary,
    End,
    /// A part that is not supported.
    Other,
}

/// The words that open a section, in lower case. A phrase stands before its beginnings.
const SECTIONS: [(&str, Section); 40] = [
    ("minimize", Section::Minimize),
    ("minimise", Section::Minimize),
    ("minimum", Section::Minimize),
    ("min", Section::Minimize),
    ("maximize", Section::Maximize),
    ("maximise", Section::Maximize),
    ("maximum", Section::Maximize),
    ("max", Section::Maximize),
    ("subject to", Section::SubjectTo),
    ("such that", Section::SubjectTo),
    ("s.t.", Section::SubjectTo),
    ("st.", Section::SubjectTo),
    ("st", Section::SubjectTo),
    ("bounds", Section::Bounds),
    ("bound", Section::Bounds),
    ("generals", Section::General),
    ("general constraints", Section::Other),
    ("general constraint", Section::Other),
    ("gencons", Section::Other),
    ("general", Section::General),
    ("gens", Section::General),
    ("gen", Section::General),
    ("integers", Section::General),
    ("integer", Section::General),
    ("int", Section::General),
    ("binaries", Section::Binary),
    ("binary", Section::Binary),
    ("bins", Section::Binary),
    ("bin", Section::Binary),
    ("semi-continuous", Section::Other),
    ("semis", Section::Other),
    ("semi", Section::Other),
    ("sos1", Section::Other),
    ("sos2", Section::Other),
    ("sos", Section::Other),
    ("lazy constraints", Section::Other),
    ("user cuts", Section::Other),
    ("pwlobj", Section::Other),
    ("scenario", Section::Other),
    ("end", Section::End),
];

/// The section that `line` opens, and the text behind its word.
pub(super) fn section_of(line: &str) -> Option<(Section, &str)> {
    let text = line.trim_ascii_start();
    SECTIONS.iter().find_map(|&(phrase, section)| {
        let rest = behind(text, phrase)?;
        // A name may not go on behind the word, and a label of a row is no section.
        let ends = !rest.starts_with(is_name_char) && !rest.trim_ascii_start().starts_with(':');
        ends.then_some((section, rest))
    })
}

/// The text behind `phrase`, whose blanks stand for any number of blanks.
fn behind<'a>(mut text: &'a str, phrase: &str) -> Option<&'a str> {
    for (k, word) in phrase.split(' ').enumerate() {
        if k > 0 {
            let next = text.trim_ascii_start();
            if next.len() == text.len() {
                return None;
            }
            text = next;
        }
        let head = text.get(..word.len())?;
        if !head.eq_ignore_ascii_case(word) {
            return None;
        }
        text = &text[word.len()..];
    }
    Some(text)
}

/// Whether a name may contain `c`.
pub(super) fn is_name_char(c: char) -> bool {
    c.is_alphanumeric() || "!\"#$%&(),.;?@_'`{}~|/".contains(c)
}

/// Whether a name may start with `c`.
pub(super) fn starts_name(c: char) -> bool {
    is_name_char(c) && !c.is_ascii_digit() && c != '.' && c != '/'
}

/// Whether `word` means an infinite number.
pub(super) fn is_infinity(word: &str) -> bool {
    ["inf", "infinity"]
        .iter()
        .any(|w| word.eq_ignore_ascii_case(w))
}

/// Whether `name` can be written: it is read back as one name, and no reader takes it for something else.
pub(super) fn is_writable(name: &str) -> bool {
    const LONGEST: usize = 255;
    let plain = |c: char| c.is_ascii_alphanumeric() || "!\"#$%&(),.;?@_'{}~".contains(c);
    let first = name
        .chars()
        .next()
        .is_some_and(|c| starts_name(c) && !"eE".contains(c));
    let reserved = section_of(name).is_some()
        || is_infinity(name)
        || ["free", "to", "that"]
            .iter()
            .any(|w| name.eq_ignore_ascii_case(w))
        || ["subject", "such", "lazy", "user"]
            .iter()
            .any(|w| name.eq_ignore_ascii_case(w));
    first && name.chars().all(plain) && name.len() <= LONGEST && !reserved
}
