//! Parses OBJ text to flat lists, one piece per task in parallel.
//!
//! The text is split at ends of lines. A first pass over all pieces counts lines and vertices, so that the second
//! pass can read each piece as if it had read everything before. Messages name lines of the file, and every index
//! is checked on the spot. The result depends neither on how the text was split nor on the number of threads.

use std::path::Path;

use rayon::prelude::*;

use super::index::{Counts, NONE};
use super::lines::{Census, Chunk, census, cut, number};
use super::oddities::{Oddities, Oddity, Tally};
use super::record::Content;
use super::record::Record;
use super::section::{Section, read_section};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::options::{LoadOptions, LoadStage};
use crate::rows::plain_text;
use crate::warning::Warnings;

/// How many bytes are a piece: long enough to be worth a task.
const PIECE: usize = 1 << 20;

/// An OBJ as it was parsed, before it is cut into nodes.
#[derive(Debug, Default)]
pub(crate) struct Parsed {
    /// All elements in file order.
    pub(crate) content: Content,
    pub(crate) record: Record,
    /// The first line with a position that is not finite.
    pub(crate) non_finite_line: Option<u64>,
    /// The first face with fewer than 3 different vertices.
    pub(crate) flat_line: Option<u64>,
    /// The first line or point statement.
    pub(crate) wire_line: Option<u64>,
    oddities: Oddities,
    colorless: Tally,
    corners: usize,
}

pub(crate) fn parse(
    path: &Path,
    bytes: &[u8],
    options: &LoadOptions<'_>,
    warnings: &mut Warnings,
) -> Result<Parsed, LoadError> {
    parse_in_pieces(path, bytes, PIECE, options, warnings)
}

/// The same with pieces of a certain size.
pub(super) fn parse_in_pieces(
    path: &Path,
    bytes: &[u8],
    size: usize,
    options: &LoadOptions<'_>,
    warnings: &mut Warnings,
) -> Result<Parsed, LoadError> {
    let text = plain_text(bytes);
    options.report(path, LoadStage::Geometry, 0.0)?;
    let pieces = cut(&text, size);
    let (chunks, total) = number(&pieces, &count_all(path, &pieces, options)?);
    // Above the largest index there is `NONE`, whatever the caller allows.
    let limit = options.limits.vertices.min(NONE as usize);
    if total.positions.max(total.coordinates).max(total.normals) > limit {
        return Err(LoadError::limit(path, format!("it has more than {limit} vertices")));
    }
    let mut parsed = read_all(path, &chunks, total, options)?;
    if parsed.content.arities.is_empty() && !options.may_be_empty {
        return Err(nothing(path, total.positions, &parsed.oddities));
    }
    let colorless = if parsed.content.colors.is_empty() { Tally::default() } else { parsed.colorless };
    parsed.oddities.add(&parsed.record.oddities);
    parsed.oddities.warn(colorless, warnings);
    Ok(parsed)
}

/// How many pieces a thread has before what has come of them is put together.
const PIECES_PER_THREAD: usize = 4;

/// The part of the work that counting is; the last quarter is for building the mesh.
const COUNTED: f32 = 0.1;
pub(super) const READ: f32 = 0.75;

/// Counts some pieces at a time: that takes seconds for a gigabyte.
fn count_all(path: &Path, pieces: &[&[u8]], options: &LoadOptions<'_>) -> Result<Vec<Census>, LoadError> {
    let mut censuses = Vec::with_capacity(pieces.len());
    for some in pieces.chunks(PIECES_PER_THREAD * rayon::current_num_threads()) {
        let share = COUNTED * censuses.len() as f32 / pieces.len() as f32;
        let ask = || options.report(path, LoadStage::Geometry, share);
        censuses.extend(side_by_side(some, ask, |piece| census(piece))?);
    }
    Ok(censuses)
}

/// Reads some pieces at a time, so that no more than those are in memory besides
/// what has been kept.
fn read_all(
    path: &Path,
    chunks: &[Chunk<'_>],
    total: Counts,
    options: &LoadOptions<'_>,
) -> Result<Parsed, LoadError> {
    let most_corners = options.limits.corners;
    let mut parsed = Parsed::default();
    parsed.content.reserve(total);
    let mut done = 0;
    for some in chunks.chunks(PIECES_PER_THREAD * rayon::current_num_threads()) {
        let share = COUNTED + (READ - COUNTED) * done as f32 / chunks.len() as f32;
        let ask = || options.report(path, LoadStage::Geometry, share);
        let sections = side_by_side(some, ask, |chunk| read_section(chunk, total, most_corners))?;
        for (chunk, section) in some.iter().zip(sections) {
            parsed.append(path, chunk, section, most_corners)?;
        }
        done += some.len();
    }
    Ok(parsed)
}

/// The results in the order of the items; a single one needs no threads. Before each,
/// `ask` tells whether to go on: whoever cancels does not wait for all of them.
fn side_by_side<T: Sync, R: Send>(
    items: &[T],
    ask: impl Fn() -> Result<(), LoadError> + Sync,
    work: impl Fn(&T) -> R + Sync,
) -> Result<Vec<R>, LoadError> {
    let work = |item: &T| ask().map(|()| work(item));
    match items {
        [only] => Ok(vec![work(only)?]),
        several => several.par_iter().map(work).collect(),
    }
}

impl Parsed {
    fn append(
        &mut self,
        path: &Path,
        chunk: &Chunk<'_>,
        section: Section,
        most_corners: usize,
    ) -> Result<(), LoadError> {
        self.corners += section.corners;
        if self.corners > most_corners {
            return Err(LoadError::limit(path, format!("the faces have more than {most_corners} corners")));
        }
        if let Some(stop) = section.stop {
            return Err(LoadError::malformed(path, stop.what, stop.remedy).at(Location::Line(stop.line)));
        }
        self.record.follow(chunk.text, &section.statements, section.content.arities.len());
        self.content.append(section.content);
        self.oddities.add(&section.oddities);
        self.colorless.add_all(section.colorless);
        self.non_finite_line = self.non_finite_line.or(section.non_finite_line);
        self.flat_line = self.flat_line.or(section.flat_line);
        self.wire_line = self.wire_line.or(section.wire_line);
        Ok(())
    }
}

fn nothing(path: &Path, vertices: usize, oddities: &Oddities) -> LoadError {
    let remedy = "export the model with faces";
    let (what, remedy) = if let Some((what, remedy)) = oddities.unknown.first() {
        (format!("there is nothing to draw, and {what}"), remedy)
    } else if oddities.has(Oddity::Surface) {
        let what = "there is nothing to draw but curves and surfaces, which are not drawn";
        (what.to_owned(), "convert them to polygons")
    } else if vertices == 0 {
        ("there is nothing to draw: the file is empty or has no vertices".to_owned(), remedy)
    } else {
        let what =
            format!("there is nothing to draw: {vertices} vertices, but no face with at least 3 of them");
        (what, remedy)
    };
    LoadError::new(LoadErrorKind::Empty, path, what, remedy)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;
    use std::sync::Mutex;

    use proptest::prelude::*;

    use super::*;
    use crate::options::Progress;

    /// All that there is to know about what came out.
    fn read(text: &str, size: usize, threads: usize) -> String {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().expect("a pool");
        pool.install(|| {
            let path = Path::new("a.obj");
            let mut warnings = Warnings::about(path);
            let parsed = parse_in_pieces(path, text.as_bytes(), size, &LoadOptions::default(), &mut warnings);
            format!("{parsed:#?} {:#?}", warnings.into_list())
        })
    }

    /// Counting a gigabyte takes seconds, too: whoever cancels does not wait for its end.
    #[test]
    fn the_first_look_at_a_file_can_be_cancelled_as_well() {
        const BATCHES: usize = 5;
        let text = "v 0 0 0\n".repeat(BATCHES * PIECES_PER_THREAD);
        let reports = Mutex::new(Vec::new());
        let parse = |most: usize| {
            let follow = |progress: Progress| {
                let mut reports = reports.lock().expect("nobody panics");
                reports.push(progress.fraction);
                if reports.len() < most { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
            };
            let options = LoadOptions { progress: Some(&follow), ..LoadOptions::default() };
            let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a pool");
            let path = Path::new("a.obj");
            let parse = || parse_in_pieces(path, text.as_bytes(), 1, &options, &mut Warnings::about(path));
            pool.install(parse).map(drop).map_err(|error| error.kind)
        };
        assert_eq!(parse(3), Err(LoadErrorKind::Cancelled), "before the second piece that was counted");
        reports.lock().expect("nobody panics").clear();
        assert_eq!(parse(usize::MAX), Err(LoadErrorKind::Empty), "there are no faces");
        let reports = reports.lock().expect("nobody panics");
        let pieces = BATCHES * PIECES_PER_THREAD;
        assert_eq!(reports.len(), 1 + 2 * pieces, "at the start, and in both looks: {reports:?}");
        assert!(reports.is_sorted(), "forwards: {reports:?}");
    }

    proptest! {
        /// Messages, numbers, groups, warnings: everything.
        #[test]
        fn neither_pieces_nor_threads_matter(
            lines in prop::collection::vec(
                "(v|v|vt|vn|f|f|l|p|o|g|s|usemtl|mtllib|curv|lod|#|[A-Z])( -?[1-9](/[1-9]?){0,2}| [a-c.]| \\\\\n){2,7}", 0..12),
            ending in prop::sample::select(vec!["\n", "\r\n", "\r"]),
            size in 1usize..60,
            threads in 1usize..4,
        ) {
            let square = ["v 0 0 0", "v 1 0 0", "v 1 1 0 1 0 0", "v 0 1 0", "f 1 2 3"].map(str::to_owned);
            let text: String = square.iter().chain(&lines).map(|line| format!("{line}{ending}")).collect();
            prop_assert_eq!(read(&text, size, threads), read(&text, usize::MAX, 1), "{}", text);
        }
    }
}
