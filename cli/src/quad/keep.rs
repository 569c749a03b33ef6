//! `--keep`: which attributes of a mesh its quads get, and what is told of them.

use std::path::Path;

use roundel::mesh::attributes::{AttributeKind, FaceNames, SurfaceAttributes};
use roundel::mesh::io::{Format, format_of};
use roundel::{Error, Result};
use serde::Serialize;

use super::Arguments;
use crate::mesh::Reading;
use crate::output;
use crate::summary::counted;

/// The attributes that quads get.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum Keep {
    /// All that can be read.
    #[default]
    WhatIsSound,
    /// All that the file has.
    All,
    /// These, which the file must have.
    Only(Vec<AttributeKind>),
}

impl Keep {
    /// Reads a list of names, separated by commas.
    pub fn parse(text: &str) -> std::result::Result<Self, String> {
        match text {
            "all" => return Ok(Keep::All),
            "none" => return Ok(Keep::Only(Vec::new())),
            _ => {}
        }
        let mut kinds = Vec::new();
        for word in text.split(',') {
            let kind = AttributeKind::by_name(word).ok_or_else(|| {
                let names = AttributeKind::ALL.map(AttributeKind::name).join(", ");
                format!("'{word}' is none of {names}; alone stand all and none")
            })?;
            if kinds.contains(&kind) {
                return Err(format!("{word} is given twice"));
            }
            kinds.push(kind);
        }
        Ok(Keep::Only(kinds))
    }

    /// Whether the attributes of the mesh are read, for quads that are written to a file.
    ///
    /// # Errors
    /// For attributes by name that the format of this file does not hold.
    pub(super) fn reading(&self, out: Option<&Path>) -> Result<Reading> {
        let Some(out) = out else {
            return Ok(Reading::No);
        };
        let format = format_of(out)?;
        let holds_any = matches!(format, Format::Obj | Format::Ply | Format::Usda);
        match self {
            Keep::WhatIsSound if holds_any => Ok(Reading::IfSound),
            Keep::All if holds_any => Ok(Reading::Yes),
            Keep::WhatIsSound | Keep::All => Ok(Reading::No),
            Keep::Only(kinds) => {
                let has_place = |&kind: &AttributeKind| {
                    holds_any && !(format == Format::Obj && kind == AttributeKind::Scalars)
                };
                match kinds.iter().find(|kind| !has_place(kind)) {
                    Some(kind) => Err(refused(format!(
                        "--keep {kind}: {} files have no place for {kind}",
                        format.name()
                    ))),
                    None if kinds.is_empty() => Ok(Reading::No),
                    None => Ok(Reading::Yes),
                }
            }
        }
    }

    /// Leaves out what is not to be kept.
    ///
    /// # Errors
    /// For attributes by name that the file lacks.
    pub(super) fn choose(&self, attributes: &mut SurfaceAttributes) -> Result<()> {
        let Keep::Only(kinds) = self else {
            return Ok(());
        };
        if let Some(kind) = kinds.iter().find(|&&kind| !attributes.has(kind)) {
            let found: Vec<_> = attributes.kinds().map(AttributeKind::name).collect();
            let has = match found.is_empty() {
                true => "none that are kept".to_owned(),
                false => found.join(", "),
            };
            return Err(refused(format!(
                "--keep {kind}: the file has no {kind}; it has {has}"
            )));
        }
        attributes.keep(kinds);
        Ok(())
    }
}

fn refused(what: String) -> Error {
    Error::InvalidArgument { what, index: None }
}

/// The attributes that were written with the quads.
#[derive(Default)]
pub(super) struct Kept {
    pub(super) attributes: SurfaceAttributes,
    /// Of carrying them to the quads.
    pub(super) seconds: f64,
    /// Why there are none, where the file has some that need not be kept.
    pub(super) refused: Option<String>,
}

impl Kept {
    /// Tells people why there are no attributes, and keeps it for `--json`.
    pub(super) fn tell_refused(&mut self, reason: Option<Error>, arguments: &Arguments) {
        self.refused = reason.map(|error| error.to_string());
        if let Some(reason) = self.refused.as_ref().filter(|_| !arguments.json) {
            let note = format!("attributes are not kept: {reason}");
            output::note(&arguments.mesh, &note);
        }
    }

    /// What they are, for people.
    pub(super) fn words(&self) -> Option<String> {
        let all = &self.attributes;
        let names = |names: &Option<FaceNames>, what| {
            let names = names.as_ref()?;
            Some(counted(used(names).len(), what))
        };
        let parts = [
            names(&all.materials, "material"),
            names(&all.groups, "group"),
            all.has(AttributeKind::Colors).then(|| "colours".to_owned()),
            all.has(AttributeKind::Uv)
                .then(|| "texture coordinates".to_owned()),
            all.has(AttributeKind::Scalars)
                .then(|| counted(all.scalars.len(), "number") + " a vertex"),
        ];
        let parts: Vec<_> = parts.into_iter().flatten().collect();
        (!parts.is_empty()).then(|| parts.join(", "))
    }
}

/// The names that a face has.
fn used(names: &FaceNames) -> Vec<&str> {
    let mut is_used = vec![false; names.names.len()];
    for &name in &names.of_face {
        if let Some(is_used) = is_used.get_mut(name as usize) {
            *is_used = true;
        }
    }
    let all = names.names.iter().zip(is_used);
    all.filter(|(_, is_used)| *is_used)
        .map(|(name, _)| name.as_str())
        .collect()
}

/// What `--json` tells of kept attributes.
#[derive(Serialize)]
pub(super) struct KeptReport<'a> {
    materials: Vec<&'a str>,
    groups: Vec<&'a str>,
    libraries: &'a [String],
    face_colors: bool,
    vertex_colors: bool,
    uv: bool,
    scalars: Vec<&'a str>,
    seconds: f64,
}

impl<'a> KeptReport<'a> {
    /// None where there are none.
    pub(super) fn new(kept: &'a Kept) -> Option<Self> {
        let all = &kept.attributes;
        let names = |names: &'a Option<FaceNames>| names.as_ref().map(used).unwrap_or_default();
        (!all.is_empty()).then(|| KeptReport {
            materials: names(&all.materials),
            groups: names(&all.groups),
            libraries: &all.libraries,
            face_colors: all.face_colors.is_some(),
            vertex_colors: all.vertex_colors.is_some(),
            uv: all.uv.is_some(),
            scalars: all
                .scalars
                .iter()
                .map(|scalar| scalar.name.as_str())
                .collect(),
            seconds: kept.seconds,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::{AttributeKind, Keep};

    #[test]
    fn attributes_are_kept_by_name() {
        assert_eq!(Keep::parse("all"), Ok(Keep::All));
        assert_eq!(Keep::parse("none"), Ok(Keep::Only(Vec::new())));
        let some = Keep::Only(vec![AttributeKind::Uv, AttributeKind::Materials]);
        assert_eq!(Keep::parse("uv,materials"), Ok(some));
        for text in ["", "uv,", "uv,uv", "uv,all", "normals"] {
            assert!(Keep::parse(text).is_err(), "{text}");
        }
    }
}
