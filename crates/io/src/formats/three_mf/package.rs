//! The archive of a 3MF: an Open Packaging Conventions package (ECMA-376, part 2). Its parts are unpacked into memory, one at
//! a time and within the limits; names of parts never lead to the disk.

use std::io::{Cursor, Read};

use percent_encoding::percent_decode_str;
use zip::ZipArchive;
use zip::result::ZipError;

use super::namespaces::MODEL_TYPE;
use super::xml::{Step, Xml};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::options::LoadStage;

/// Where the relationships of the package are.
const RELATIONSHIPS: &str = "_rels/.rels";

/// So much is unpacked before the limits are checked again.
const PIECE: usize = 1 << 20;

/// An archive with its parts.
pub(super) struct Package<'a> {
    archive: ZipArchive<Cursor<&'a [u8]>>,
}

impl<'a> Package<'a> {
    pub(super) fn open(import: &Import<'_>, bytes: &'a [u8]) -> Result<Self, LoadError> {
        let archive = ZipArchive::new(Cursor::new(bytes)).map_err(|error| broken(import, "", &error))?;
        Ok(Self { archive })
    }

    /// The name of the part with the model: what the package's relationships say.
    pub(super) fn model_part(&mut self, import: &mut Import<'_>) -> Result<String, LoadError> {
        if self.index_of(RELATIONSHIPS).is_none() {
            return Err(no_model(import, "it is a zip archive without the relationships of a 3MF"));
        }
        let text = self.read(import, RELATIONSHIPS)?;
        let mut xml = Xml::new(import.path, RELATIONSHIPS, &text);
        while let Some(step) = xml.step()? {
            let Step::Start(element) = step else { continue };
            if element.name() != b"Relationship" {
                continue;
            }
            let (mut kind, mut target) = (String::new(), String::new());
            for attribute in element.attributes() {
                let attribute = xml.checked(attribute)?;
                match attribute.key.as_ref() {
                    b"Type" => kind = xml.text(&attribute)?,
                    b"Target" => target = xml.text(&attribute)?,
                    _ => {}
                }
            }
            if kind == MODEL_TYPE {
                return Ok(part_name(&target));
            }
        }
        Err(no_model(import, "no relationship of the package leads to a model"))
    }

    /// Unpacks a part.
    ///
    /// # Errors
    /// It is not there, broken, encrypted, or larger than the limits allow.
    pub(super) fn read(&mut self, import: &mut Import<'_>, name: &str) -> Result<Vec<u8>, LoadError> {
        let Some(index) = self.index_of(name) else {
            let what = format!("the archive has no part \"{name}\"");
            return Err(LoadError::malformed(import.path, what, "export the model again"));
        };
        let mut part = self.archive.by_index(index).map_err(|error| broken(import, name, &error))?;
        let limit = import.options.limits.file_bytes;
        let mut bytes = Vec::new();
        loop {
            let before = bytes.len();
            let piece = (&mut part).take(PIECE as u64).read_to_end(&mut bytes);
            let count = piece.map_err(|error| broken(import, name, &ZipError::Io(error)))?;
            debug_assert_eq!(bytes.len(), before + count, "it appends");
            if count == 0 {
                return Ok(bytes);
            }
            if bytes.len() as u64 > limit {
                let what = format!("the part \"{name}\" unpacks to more than {limit} bytes");
                return Err(LoadError::limit(import.path, what));
            }
            import.folder.account(count as u64).map_err(|refusal| refusal.of_model(import.path))?;
            import.options.report(import.path, LoadStage::Geometry, 0.0)?;
        }
    }

    /// The number of a part; names are the same in upper and lower case.
    fn index_of(&self, name: &str) -> Option<usize> {
        let is_it =
            |known: &[u8]| known.strip_prefix(b"/").unwrap_or(known).eq_ignore_ascii_case(name.as_bytes());
        let exact = self.archive.index_for_name_raw(name.as_bytes());
        exact.or_else(|| self.archive.file_names_raw().position(is_it))
    }
}

/// The name of a part as the archive has it: `/3D/3dmodel.model` without its slash, and without escapes.
pub(super) fn part_name(target: &str) -> String {
    let name = percent_decode_str(target.trim()).decode_utf8_lossy();
    name.trim_start_matches('/').to_owned()
}

fn no_model(import: &Import<'_>, what: &str) -> LoadError {
    LoadError::malformed(import.path, what, "check that it is the right file, or export the model again")
}

/// What the archive is refused for.
fn broken(import: &Import<'_>, part: &str, error: &ZipError) -> LoadError {
    let (kind, remedy) = match error {
        ZipError::UnsupportedArchive(_)
        | ZipError::CompressionMethodNotSupported(_)
        | ZipError::InvalidPassword => {
            (LoadErrorKind::Unsupported, "pack the file again without a password, with deflate")
        }
        _ => (LoadErrorKind::Malformed, "copy or export the file again"),
    };
    let error =
        LoadError::new(kind, import.path, format!("the archive cannot be unpacked ({error})"), remedy);
    match part {
        "" => error,
        part => error.at(Location::Named(format!("part \"{part}\""))),
    }
}
