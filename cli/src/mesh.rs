//! The mesh that a command works on: a file of any kind, repaired where it must be, or a procedural shape.

use std::io::Read;
use std::path::Path;

use roundel::mesh::attributes::SurfaceAttributes;
use roundel::mesh::features::FeatureGraph;
use roundel::mesh::{MeshError, TriangleMesh, io, shape};
use roundel::soup::io::{Attribute, Attributes, Format};
use roundel::soup::{EditKind, Edits, PolygonSoup, RepairOptions, Repaired, io as soup};
use roundel::{Error, Result};
use serde::{Serialize, Serializer};

use crate::changes::Changes;
use crate::options::RepairFlags;
use crate::output;
use crate::shape::suggesting;

/// The name of standard input.
const STDIN: &str = "-";

/// How the file of a mesh is read.
#[derive(clap::Args)]
pub struct MeshFlags {
    /// Read the mesh as this format, whatever its name: obj, off, ply, stl, gltf or glb. Standard input,
    /// `-`, needs it
    #[arg(long, value_name = "FORMAT", value_parser = format)]
    pub format: Option<Format>,

    /// Refuse what is not an oriented manifold triangle mesh as it stands, and repair nothing
    #[arg(long)]
    #[arg(conflicts_with_all = ["weld", "drop_components", "fill_holes"])]
    pub strict: bool,

    #[command(flatten)]
    pub repair: RepairFlags,
}

/// A mesh, and what was done to make it one.
pub struct Input {
    pub mesh: TriangleMesh,
    pub repair: RepairCounts,
    pub changes: Changes,
    /// The edges at which the attributes that were asked for change.
    pub features: Option<FeatureGraph>,
    /// What the faces, corners and vertices have, if that was asked for.
    pub attributes: SurfaceAttributes,
    /// Why there are none, where they cannot be read and need not be.
    pub refused: Option<Error>,
}

/// What is wanted of a file beside its mesh.
#[derive(Default, Clone, Copy)]
pub struct Wanted<'a> {
    /// Attributes whose changes are features.
    pub features: &'a [Attribute],
    /// Whether attributes are read.
    pub attributes: Reading,
}

/// Whether something is read.
#[derive(Default, Clone, Copy, PartialEq, Eq)]
pub enum Reading {
    #[default]
    No,
    /// Where it is damaged, it is left out.
    IfSound,
    /// Where it is damaged, the call fails.
    Yes,
}

/// How often each kind of repair was done; those that were not are left out.
#[derive(Debug, Clone, Default)]
pub struct RepairCounts(Vec<(EditKind, usize)>);

impl RepairCounts {
    /// The counts of a list of edits.
    pub fn new(edits: &Edits) -> Self {
        let counts = EditKind::ALL
            .into_iter()
            .map(|kind| (kind, edits.count(kind)));
        RepairCounts(counts.filter(|&(_, count)| count > 0).collect())
    }
}

impl Serialize for RepairCounts {
    fn serialize<S: Serializer>(&self, serializer: S) -> std::result::Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(kind, count)| (kind.name(), count)))
    }
}

impl Input {
    /// Adds what is wanted of the attributes of a file.
    fn add(
        &mut self,
        wanted: Wanted,
        origin: (&PolygonSoup, Option<&Repaired>),
        read: &Attributes,
    ) -> Result<()> {
        let mesh = &self.mesh;
        if !wanted.features.is_empty() {
            let mut features = FeatureGraph::none(mesh);
            for &attribute in wanted.features {
                let found = FeatureGraph::by_attribute(mesh, origin, read, attribute)?;
                features = features.with(mesh, &found)?;
            }
            self.features = Some(features);
        }
        if wanted.attributes != Reading::No {
            match SurfaceAttributes::of_file(mesh, origin, read) {
                Ok(attributes) => self.attributes = attributes,
                Err(error) if wanted.attributes == Reading::IfSound => self.refused = Some(error),
                Err(error) => return Err(error),
            }
        }
        Ok(())
    }

    /// Refuses a flag whose argument counts faces or vertices, if repair has changed their numbers.
    ///
    /// # Errors
    /// [`Error::InvalidArgument`].
    pub fn keeps_numbers(&self, flag: &str, is_given: bool) -> Result<()> {
        if !is_given || self.repair.0.is_empty() {
            return Ok(());
        }
        Err(Error::InvalidArgument {
            what: format!(
                "{flag} counts the faces and vertices of the file, but repair has changed them: write \
                 the mesh with `roundel repair`, and count those of its result"
            ),
            index: None,
        })
    }
}

impl Wanted<'_> {
    fn may_lack_attributes(self) -> bool {
        self.features.is_empty() && self.attributes == Reading::IfSound
    }
}

impl MeshFlags {
    /// The mesh that `name` stands for: `shape:NAME[:TRIANGLES]`, a file, or `-` for standard input. What was
    /// repaired is told on stderr, unless `json` tells it.
    ///
    /// # Errors
    /// Those of reading and of repair; with `--strict` those of [`TriangleMesh::new`].
    pub fn read(&self, name: &Path, json: bool) -> Result<Input> {
        self.read_with(name, json, Wanted::default())
    }

    /// As [`read`](Self::read), with what is wanted beside the mesh.
    ///
    /// # Errors
    /// Those of [`read`](Self::read), of [`FeatureGraph::by_attribute`], and of attributes that are to be read.
    pub fn read_with(&self, name: &Path, json: bool, wanted: Wanted) -> Result<Input> {
        if let Some(drawn) = name.to_str().and_then(shape::from_spec) {
            if let Some(first) = wanted.features.first() {
                return Err(Error::InvalidArgument {
                    what: format!("a shape has no {first}: it is no file"),
                    index: None,
                });
            }
            return Ok(unchanged(suggesting(drawn)?));
        }
        let format = self.format_of(name)?;
        let bytes = match is_stdin(name) {
            true => stdin()?,
            false => std::fs::read(name)
                .map_err(|reason| output::io_error(&name.display().to_string(), &reason))?,
        };
        let soup = soup::parse_in(&bytes, format, name.parent())?;
        let is_read = !wanted.features.is_empty()
            || wanted.attributes != Reading::No && Attributes::are_in(&bytes, format)?;
        let read = match is_read {
            true => Attributes::parse_in(&bytes, format, name.parent(), &soup).map(Some),
            false => Ok(None),
        };
        drop(bytes);
        let (read, refused) = match read {
            Ok(read) => (read, None),
            Err(error) if wanted.may_lack_attributes() => (None, Some(error.into())),
            Err(error) => return Err(error.into()),
        };
        let (mut input, repaired) = match self.strict {
            true => (unchanged(io::of_soup(&soup, format)?), None),
            false => {
                let (input, repaired) = self.repaired_input(name, &soup, json)?;
                (input, Some(repaired))
            }
        };
        input.refused = refused;
        if let Some(read) = read {
            input.add(wanted, (&soup, repaired.as_ref()), &read)?;
        }
        Ok(input)
    }

    fn repaired_input(
        &self,
        name: &Path,
        soup: &PolygonSoup,
        json: bool,
    ) -> Result<(Input, Repaired)> {
        let (mesh, repaired) = self.repaired(soup)?;
        if !repaired.edits.is_empty() && !json {
            output::note(name, &format!("repaired: {}", repaired.edits.summary()));
        }
        let input = Input {
            repair: RepairCounts::new(&repaired.edits),
            changes: Changes::new(&repaired),
            ..unchanged(mesh)
        };
        Ok((input, repaired))
    }

    /// The soup in a file, or on standard input.
    ///
    /// # Errors
    /// Those of reading.
    pub fn read_soup(&self, name: &Path) -> Result<PolygonSoup> {
        if is_stdin(name) {
            return Ok(soup::parse(&stdin()?, self.format_of(name)?)?);
        }
        Ok(soup::read_as(name, self.format_of(name)?)?)
    }

    /// The mesh that repair makes of a soup by the flags.
    ///
    /// # Errors
    /// Those of [`TriangleMesh::from_soup`].
    pub fn repaired(&self, soup: &PolygonSoup) -> Result<(TriangleMesh, Repaired)> {
        let options = self.repair.over(RepairOptions::default())?;
        Ok(TriangleMesh::from_soup(soup, &options)?)
    }

    fn format_of(&self, name: &Path) -> Result<Format> {
        match self.format {
            Some(format) => Ok(format),
            None if is_stdin(name) => Err(Error::InvalidArgument {
                what: "standard input has no extension: add --format".into(),
                index: None,
            }),
            None => Ok(Format::of(name).map_err(MeshError::from)?),
        }
    }
}

/// A mesh to which nothing was done.
fn unchanged(mesh: TriangleMesh) -> Input {
    Input {
        mesh,
        repair: RepairCounts::default(),
        changes: Changes::default(),
        features: None,
        attributes: SurfaceAttributes::default(),
        refused: None,
    }
}

fn is_stdin(name: &Path) -> bool {
    name.as_os_str() == STDIN
}

fn stdin() -> Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let read = std::io::stdin().lock().read_to_end(&mut bytes);
    read.map_err(|reason| output::io_error("standard input", &reason))?;
    Ok(bytes)
}

fn format(word: &str) -> std::result::Result<Format, String> {
    Format::by_name(word).map_err(|error| error.to_string())
}
