//! STL, the format of stereolithography (3D Systems, 1988), as text and binary, with the colours that
//! VisCAM, SolidView and Materialise Magics put into its attribute bytes.
//!
//! Text files begin with the word "solid", but so do many binary ones, and some text begins with a comment: the size
//! of a file decides, and the zeros in it. Vertices are corners of single triangles; those with bit-identical coordinates are merged. Normals follow from the
//! order of the vertices; those in the file are ignored, because many files contain zeros.
//!
//! The crate `stl_io` 0.11 decides by the first line alone, drops the attributes, reads only the first of
//! several solids, and rejects a file for one line without saying which.

mod binary;
mod colors;
mod solid;
mod text;
mod write;

use std::borrow::Cow;

use crate::error::LoadError;
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::add_polygons;
use crate::text::plain_text;

pub(crate) use write::write_stl;

/// Whether a file without a telling name is an STL.
pub(crate) fn is_stl(bytes: &[u8]) -> bool {
    binary::has_exact_size(bytes) || as_text(bytes).is_some_and(|text| text::begins_as_stl(&text))
}

/// So much of a file tells what it is.
const START: usize = 1 << 10;

fn has_zero(bytes: &[u8]) -> bool {
    bytes[..bytes.len().min(START)].contains(&0)
}

/// The file as text, if it is that. Text has no zeros; the number of triangles of a binary file has one, unless there
/// are 16 million of them.
fn as_text(bytes: &[u8]) -> Option<Cow<'_, [u8]>> {
    if binary::has_exact_size(bytes) {
        return None;
    }
    let text = plain_text(bytes);
    (!has_zero(&text) && text::has_keyword(&text)).then_some(text)
}

/// Reads an STL into the scene.
pub(crate) fn import_stl(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let solids = match as_text(&bytes) {
        Some(text) => text::read(import, &text)?,
        None if bytes.len() >= binary::HEADER && !has_zero(&bytes) && !binary::has_exact_size(&bytes) => {
            let what = "it is text without a facet, so it is not an STL";
            return Err(LoadError::malformed(import.path, what, "check that it is the right file"));
        }
        None => vec![binary::read(import, &bytes)?],
    };
    drop(bytes);
    add_polygons(import, solids)
}
