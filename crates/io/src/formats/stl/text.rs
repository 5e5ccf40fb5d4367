//! STL as text: `facet`, three times `vertex`, `endfacet`; any number of solids. Lines mean nothing but the end of a
//! name and of a comment: some programs write all on one line.

use trigon_math::DVec3;

use super::Solid;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::numbers::number;
use crate::options::LoadStage;
use crate::polygons::{Polygons, check_solids, most_corners, too_many_corners};
use crate::rows::{Rows, Words, quoted, words};

/// So many statements are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 18;

/// The words that mean something.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Keyword {
    Vertex,
    Facet,
    EndFacet,
    /// Says nothing that the others do not say.
    Loop,
    Solid,
    EndSolid,
}

/// The most frequent ones first.
const KEYWORDS: [(&[u8], Keyword); 8] = [
    (b"vertex", Keyword::Vertex),
    (b"outer", Keyword::Loop),
    (b"loop", Keyword::Loop),
    (b"endloop", Keyword::Loop),
    (b"endfacet", Keyword::EndFacet),
    (b"facet", Keyword::Facet),
    (b"solid", Keyword::Solid),
    (b"endsolid", Keyword::EndSolid),
];

impl Keyword {
    fn of(word: &[u8]) -> Option<Self> {
        KEYWORDS.iter().find(|(keyword, _)| keyword.eq_ignore_ascii_case(word)).map(|&(_, keyword)| keyword)
    }
}

/// Whether words of the format stand near the start of a text, where comments may come before them.
pub(super) fn has_keyword(text: &[u8]) -> bool {
    const NEAR: usize = 1 << 16;
    words(&text[..text.len().min(NEAR)])
        .any(|word| matches!(Keyword::of(word), Some(Keyword::Facet | Keyword::Solid)))
}

/// Whether a text begins with a solid and its first facet, after any comments.
pub(super) fn begins_as_stl(text: &[u8]) -> bool {
    let mut rows = Rows::after(0, text).filter(|row| !is_comment(row));
    let is_facet = |row: &[u8]| words(row).any(|word| Keyword::of(word) == Some(Keyword::Facet));
    let first = rows.next().unwrap_or_default();
    match words(first).next().and_then(Keyword::of) {
        Some(Keyword::Facet) => true,
        Some(Keyword::Solid) => is_facet(first) || rows.next().is_some_and(is_facet),
        _ => false,
    }
}

fn is_comment(row: &[u8]) -> bool {
    COMMENTS.iter().any(|start| row.starts_with(start))
}

/// How lines begin that are comments, though the format has none.
const COMMENTS: [&[u8]; 4] = [b"#", b"//", b";", b"!"];

/// The solids while they are read.
struct StlReader<'a> {
    words: Words<'a>,
    done: Vec<Polygons>,
    /// The one that facets go to.
    solid: Solid,
    /// Of all solids.
    corner_count: usize,
    /// The vertices of the facet so far.
    corners: Vec<DVec3>,
}

pub(super) fn read(import: &mut Import<'_>, text: &[u8]) -> Result<Vec<Polygons>, LoadError> {
    let words = Words::of(Rows::after(0, text));
    let mut reader =
        StlReader { words, done: Vec::new(), solid: Solid::default(), corner_count: 0, corners: Vec::new() };
    let mut statements = 0_u64;
    while reader.statement(import)? {
        statements += 1;
        if statements.is_multiple_of(STRIDE) {
            let (done, left) = reader.words.progress();
            let share = 0.9 * done as f32 / (done + left) as f32;
            import.options.report(import.path, LoadStage::Geometry, share)?;
        }
    }
    if !reader.corners.is_empty() {
        import.warnings.push(
            Location::Line(reader.words.line()),
            "the file ends within a facet, which is left out",
            "copy or export the file again",
        );
    }
    reader.begin_solid(import, String::new())?;
    Ok(reader.done)
}

impl StlReader<'_> {
    /// Reads a statement; false at the end of the file.
    fn statement(&mut self, import: &mut Import<'_>) -> Result<bool, LoadError> {
        let line_before = self.words.line();
        let Some(word) = self.words.next() else { return Ok(false) };
        match Keyword::of(word) {
            Some(Keyword::Vertex) => self.vertex(import)?,
            Some(Keyword::Loop) => {}
            Some(Keyword::EndFacet) => self.facet(import)?,
            Some(Keyword::Facet) => {
                self.facet(import)?;
                self.pass_normal();
            }
            Some(Keyword::Solid) => {
                self.facet(import)?;
                let name = self.name(Keyword::EndSolid);
                self.begin_solid(import, name)?;
            }
            Some(Keyword::EndSolid) => self.pass_name(),
            None => self.unknown(import, word, self.words.line() > line_before),
        }
        Ok(true)
    }

    fn vertex(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        let line = self.words.line();
        let position = self.position().map_err(|what| {
            LoadError::malformed(import.path, what, "fix the line, or export the model again")
                .at(Location::Line(line))
        })?;
        self.corners.push(position);
        Ok(())
    }

    fn position(&mut self) -> Result<DVec3, String> {
        let mut coordinate = || match self.words.next().filter(|word| Keyword::of(word).is_none()) {
            Some(word) => number(word),
            None => Err("a vertex has fewer than 3 coordinates".to_owned()),
        };
        Ok(DVec3::new(coordinate()?, coordinate()?, coordinate()?))
    }

    /// Normals follow from the vertices.
    fn pass_normal(&mut self) {
        const WORDS: usize = 4;
        for _ in 0..WORDS {
            let mut ahead = self.words.clone();
            if ahead.next().is_none_or(|word| Keyword::of(word).is_some()) {
                return;
            }
            self.words = ahead;
        }
    }

    /// The name of a solid: up to the end of the line, or to the next statement where that is on the same line.
    fn name(&mut self, end: Keyword) -> String {
        let line = self.words.rest_of_line();
        let mut ahead = self.words.clone();
        let length = loop {
            let rest = ahead.rest_of_line();
            if rest.is_empty() {
                break line.len();
            }
            let keyword = ahead.next().and_then(Keyword::of);
            let next = words(ahead.rest_of_line()).next().unwrap_or_default();
            let is_facet = keyword == Some(Keyword::Facet) && next.eq_ignore_ascii_case(b"normal");
            if keyword == Some(end) || is_facet {
                break line.len() - rest.len();
            }
        };
        self.words.pass_in_line(length);
        String::from_utf8_lossy(&line[..length]).trim().to_owned()
    }

    /// The name after `endsolid`: that of the solid, or whatever comes before the next one.
    fn pass_name(&mut self) {
        let name = self.solid.polygons.name.as_bytes();
        match self.words.rest_of_line().strip_prefix(name) {
            Some(rest) if rest.first().is_none_or(u8::is_ascii_whitespace) => {
                self.words.pass_in_line(name.len());
            }
            _ => drop(self.name(Keyword::Solid)),
        }
    }

    /// At the start of a line it takes the line with it: words of people may be words of the format.
    fn unknown(&mut self, import: &mut Import<'_>, word: &[u8], is_first: bool) {
        let line = Location::Line(self.words.line());
        if is_first {
            self.words.pass_in_line(self.words.rest_of_line().len());
            if is_comment(word) {
                return;
            }
        }
        let what = format!("the statement {} is not one of STL and is ignored", quoted(word));
        import.warnings.push(line, what, "export the model again");
    }

    /// Ends a facet.
    fn facet(&mut self, import: &Import<'_>) -> Result<(), LoadError> {
        if self.corners.is_empty() {
            return Ok(());
        }
        self.corner_count += self.corners.len();
        if self.corner_count > most_corners(import) {
            return Err(too_many_corners(import));
        }
        self.solid.push(import, &self.corners)?;
        self.corners.clear();
        Ok(())
    }

    /// Ends a solid and begins the next. One without facets leaves nothing.
    fn begin_solid(&mut self, import: &Import<'_>, name: String) -> Result<(), LoadError> {
        let solid = std::mem::replace(&mut self.solid, Solid::named(name));
        if !solid.polygons.face_sizes.is_empty() {
            self.done.push(solid.polygons);
            check_solids(import, self.done.len())?;
        }
        Ok(())
    }
}
