//! Runs tobj over the feed: text in, flat lists of f64 out.

use std::path::Path;

use super::feed::{Colors, Feed, Source, Stop};
use super::index::Counts;
use super::lines::{Lines, plain_bytes, split_keyword};
use super::record::Record;
use crate::error::{LoadError, LoadErrorKind, Place};
use crate::options::LoadOptions;
use crate::warning::Warnings;

/// An OBJ as it was parsed, before it is cut into nodes.
pub(crate) struct Parsed {
    /// All elements in file order; vertices in the order of their first use.
    pub(crate) mesh: tobj::Mesh,
    pub(crate) record: Record,
    /// The first line with a position that is not finite.
    pub(crate) non_finite_line: Option<u64>,
}

/// tobj reports points and lines as faces of one and two corners, and keeps
/// positions, coordinates and normals apart.
const OPTIONS: tobj::LoadOptions =
    tobj::LoadOptions { single_index: false, triangulate: false, ignore_points: false, ignore_lines: false };

pub(crate) fn parse(
    path: &Path,
    bytes: &[u8],
    options: &LoadOptions<'_>,
    warnings: &mut Warnings,
) -> Result<Parsed, LoadError> {
    let text = plain_bytes(bytes)
        .map_err(|what| LoadError::malformed(path, what, "fetch the real file with `git lfs pull`"))?;
    let total = count_ahead(&text);
    let limit = options.limits.vertices;
    if total.positions.max(total.coordinates).max(total.normals) > limit {
        return Err(LoadError::limit(path, format!("it has more than {limit} vertices")));
    }
    let source = Source { path, text: &text, total, options };
    match run(source, Colors::Unknown, warnings) {
        Err(Stop::LateColor) => run(source, Colors::Present, warnings),
        result => result,
    }
    .map_err(|stop| match stop {
        Stop::Error(error) => error,
        Stop::LateColor => unreachable!("colours were expected from the first vertex on"),
    })
    .and_then(
        |parsed| if parsed.record.elements > 0 { Ok(parsed) } else { Err(nothing(path, total.positions)) },
    )
}

/// Counts vertices, coordinates and normals ahead, so that indices can be
/// checked at the line that has them.
fn count_ahead(text: &[u8]) -> Counts {
    let mut counts = Counts::default();
    for (_, line) in Lines::new(text) {
        match split_keyword(&line) {
            Some((b"v", _)) => counts.positions += 1,
            Some((b"vt", _)) => counts.coordinates += 1,
            Some((b"vn", _)) => counts.normals += 1,
            _ => {}
        }
    }
    counts
}

fn run(source: Source<'_>, colors: Colors, warnings: &mut Warnings) -> Result<Parsed, Stop> {
    let mut feed = Feed::new(source, colors);
    let result = tobj::load_obj_buf(&mut feed, &OPTIONS, |_| Ok(Default::default()));
    if let Some(stop) = feed.take_stop() {
        return Err(stop);
    }
    let models = match result {
        Ok((models, _)) => models,
        Err(error) => return Err(Stop::Error(parse_error(source.path, error, feed.last_line()))),
    };
    let (record, non_finite_line) = feed.finish(warnings);
    let mesh = models.into_iter().next().map(|model| model.mesh).unwrap_or_default();
    Ok(Parsed { mesh, record, non_finite_line })
}

fn parse_error(path: &Path, error: tobj::LoadError, line: u64) -> LoadError {
    let what = match error {
        tobj::LoadError::PositionParseError => "a coordinate is no number".to_owned(),
        tobj::LoadError::TexcoordParseError => "a texture coordinate is no number".to_owned(),
        tobj::LoadError::NormalParseError => "a normal has what is no number".to_owned(),
        other => other.to_string(),
    };
    LoadError::malformed(path, what, "mend the line, or export the model again").at(Place::Line(line))
}

fn nothing(path: &Path, vertices: usize) -> LoadError {
    let what = if vertices == 0 {
        "there is nothing to draw: the file is empty or has no vertices".to_owned()
    } else {
        format!("there is nothing to draw: {vertices} vertices, but no face with at least 3 of them")
    };
    LoadError::new(LoadErrorKind::Empty, path, what, "export the model with faces")
}
