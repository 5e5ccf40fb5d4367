//! STL, the format of stereolithography (3D Systems, 1988), as text and binary, with the colours that
//! VisCAM, SolidView and Materialise Magics put into its attribute bytes.
//!
//! Text files begin with the word "solid", but so do many binary ones: the size of a file decides. Vertices
//! are corners of single triangles; those with bit-identical coordinates are merged. Normals follow from the
//! order of the vertices; those in the file are ignored, because many files contain zeros.
//!
//! The crate `stl_io` 0.11 decides by the first line alone, drops the attributes, reads only the first of
//! several solids, and rejects a file for one line without saying which.

mod binary;
mod solid;
mod text;
mod write;

use std::borrow::Cow;

use crate::error::LoadError;
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::add_polygons;

pub(crate) use write::write_stl;

/// Whether a file without a telling name is an STL.
pub(crate) fn is_stl(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1024)];
    binary::has_exact_size(bytes) || (begins_with_solid(start) && has_word(start, b"facet"))
}

fn begins_with_solid(bytes: &[u8]) -> bool {
    bytes.trim_ascii_start().get(..5).is_some_and(|word| word.eq_ignore_ascii_case(b"solid"))
}

fn has_word(bytes: &[u8], word: &[u8]) -> bool {
    bytes.windows(word.len()).any(|window| window.eq_ignore_ascii_case(word))
}

/// Text has no zeros, and the header or the first numbers of a binary file have some.
fn is_text(bytes: &[u8]) -> bool {
    let start = &bytes[..bytes.len().min(1024)];
    !binary::has_exact_size(bytes) && begins_with_solid(start) && !start.contains(&0)
}

/// Reads an STL into the scene.
pub(crate) fn import_stl(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let solids =
        if is_text(&bytes) { text::read(import, &bytes)? } else { vec![binary::read(import, &bytes)?] };
    drop(bytes);
    add_polygons(import, solids)
}
