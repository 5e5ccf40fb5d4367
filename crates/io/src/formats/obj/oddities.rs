//! What an OBJ says and the scene does not: statements that are not read, and parts that are left out or changed,
//! counted and reported once each at the end. `docs/obj-statements.md` lists all statements.

use trigon_mesh::Mesh;

use super::parse::Parsed;
use crate::error::Location;
use crate::warning::Warnings;

/// What is worth one warning, however often a file has it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Oddity {
    SurplusInVertex,
    SurplusInAttribute,
    ColorOutOfRange,
    OddCoordinate,
    NoDirection,
    ShortFace,
    ShortLine,
    WireCoordinate,
    IndexDropped,
    MixedCoordinates,
    MixedNormals,
    Smoothing,
    Libraries,
    Surface,
    Call,
    Shell,
    TextureMap,
    ShadowObject,
    TraceObject,
    Bevel,
    ColorInterpolation,
    DissolveInterpolation,
    LevelOfDetail,
}

const KINDS: usize = Oddity::LevelOfDetail as usize + 1;

/// Of each kind, in the order above, what is wrong and what to do about it.
const WORDS: [(&str, &str); KINDS] = [
    ("a vertex has more numbers than trigon reads", "remove the numbers after x, y, z and the colour"),
    ("a texture coordinate or normal has more than 3 numbers, and the first 3 count", "remove the others"),
    (
        "a vertex has a colour outside of 0 to 1, which is clamped",
        "write colours from 0 to 1, not from 0 to 255",
    ),
    ("a texture coordinate is not finite and is taken as 0", "export the model again"),
    (
        "a normal has no direction and is computed from the faces instead",
        "export the model again, or remove the normal",
    ),
    (
        "a face has fewer than 3 vertices and is left out",
        "remove it, or write edges with `l` and points with `p`",
    ),
    (
        "a line has fewer than 2 vertices, or a point statement none, and is left out",
        "remove it, or write points with `p`",
    ),
    (
        "a line or a point has texture coordinates, which are ignored: it shows no texture",
        "give it a material of one colour",
    ),
    ("a texture coordinate or normal index does not exist and is ignored", "export the model again"),
    (
        "a face has texture coordinates at some corners only, and 0 is taken at the others",
        "write v/vt at all corners of a face or at none",
    ),
    (
        "a face has normals at some corners only, and they are computed at the others",
        "write v//vn at all corners of a face or at none",
    ),
    (
        "s is followed by neither a number nor on or off, and the faces are flat",
        "write the number of a smoothing group, or `s off`",
    ),
    ("more than 256 libraries are named, and the others are not read", "put their materials into one file"),
    ("curves and surfaces are not drawn", "convert them to polygons"),
    ("call names another file, which is not read", "copy its statements to this place"),
    ("csh asks to run a command, and trigon runs none", "run it yourself, and load what it writes"),
    ("usemap names a texture map, which is not drawn", "name the image with map_Kd in a material"),
    (
        "shadow_obj names a model to cast the shadow, which is not read; this one casts its own",
        "remove the line, or load the other model",
    ),
    (
        "trace_obj names a model to show in mirrors, which is not read; they show this one",
        "remove the line, or load the other model",
    ),
    ("bevel asks for edges that look rounded, and they are drawn sharp", "bevel the edges of the model"),
    (
        "c_interp asks for colours blended between materials, which are not drawn",
        "write colours at the vertices: v x y z red green blue",
    ),
    (
        "d_interp asks for opacity blended between materials, which is not drawn",
        "give the material an opacity texture with map_d",
    ),
    ("lod marks a level of detail, and all levels are drawn", "keep one level in the file"),
];

/// How often something was seen, and the line of the first.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Tally {
    pub(crate) count: usize,
    pub(crate) line: u64,
}

impl Tally {
    pub(crate) fn add(&mut self, line: u64) {
        self.add_all(Self { count: 1, line });
    }

    /// Adds what was counted further on in the file.
    pub(crate) fn add_all(&mut self, later: Self) {
        if self.count == 0 {
            self.line = later.line;
        }
        self.count += later.count;
    }
}

/// A tally of each kind, and of statements that are none.
#[derive(Debug, Default)]
pub(crate) struct Oddities {
    tallies: [Tally; KINDS],
    pub(crate) unknown: Unknown,
}

impl Oddities {
    pub(crate) fn note(&mut self, oddity: Oddity, line: u64) {
        self.tallies[oddity as usize].add(line);
    }

    pub(crate) fn has(&self, oddity: Oddity) -> bool {
        self.tallies[oddity as usize].count > 0
    }

    /// Adds what was counted further on in the file.
    pub(crate) fn add(&mut self, later: &Self) {
        for (tally, later) in self.tallies.iter_mut().zip(later.tallies) {
            tally.add_all(later);
        }
        self.unknown.add_all(&later.unknown);
    }

    /// Says once each what was odd; `colorless` are vertices without a colour
    /// while others have one.
    pub(crate) fn warn(&self, colorless: Tally, warnings: &mut Warnings) {
        let mut warn = |tally: Tally, what: &str, remedy: &str| {
            warnings.push_counted(tally.count, Location::Line(tally.line), what, remedy);
        };
        for (&tally, (what, remedy)) in self.tallies.iter().zip(WORDS) {
            warn(tally, what, remedy);
        }
        warn(
            colorless,
            "a vertex has no colour while others have; it is white",
            "export colours for all vertices or for none",
        );
        self.unknown.warn(warnings);
    }
}

/// How many elements there were, and what was odd about some of them.
#[derive(Default)]
pub(super) struct Passed {
    pub(super) elements: usize,
    pub(super) non_finite: usize,
    pub(super) flat: usize,
    /// Edges and points in another material than the first edge or point of their part.
    plain: usize,
    /// The material of the first of those.
    plain_material: Option<u32>,
    /// Lines on edges of faces.
    covered: usize,
}

impl Passed {
    /// Notes an edge or a point: it is drawn in the material of the first of its part.
    pub(super) fn note_wire(&mut self, slot: u32, material: Option<u32>) {
        if slot != 0 {
            self.plain += 1;
            self.plain_material = self.plain_material.or(material);
        }
    }

    /// Notes which lines of a mesh are edges of its faces, too: those are not loose.
    pub(super) fn note_covered(&mut self, mut lines: Vec<[u32; 2]>, mesh: &Mesh) {
        lines.sort_unstable();
        lines.dedup();
        self.covered += lines.len() - mesh.loose_edges().len();
    }

    pub(super) fn warn(&self, parsed: &Parsed, warnings: &mut Warnings) {
        let mut warn = |count: usize, line: Option<u64>, what: &str, remedy: &str| {
            warnings.push_counted(count, line.map_or(Location::Whole, Location::Line), what, remedy);
        };
        warn(
            self.non_finite,
            parsed.non_finite_line,
            "a face, a line or a point has a vertex that is not finite and is left out",
            "export the model again",
        );
        warn(
            self.flat,
            parsed.flat_line,
            "a face has fewer than 3 different vertices and is left out",
            "clean the model up",
        );
        warn(
            self.plain,
            self.plain_material.map(|material| parsed.record.material_lines[material as usize]),
            "a line or a point has another material than the first of its group, whose colour it gets",
            "start a group for each material, with g",
        );
        warn(
            self.covered,
            parsed.wire_line,
            "a line on the edge of a face of its group is not drawn",
            "start a group for the lines, with g",
        );
    }
}

/// What leaving a statement out means.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Unread {
    /// The image stays the same, or what changes it is noted elsewhere.
    Harmless,
    /// The image is another than the file asks for.
    Noted(Oddity),
    /// No version of the format has it.
    Unknown,
}

/// Judges a statement that the reader has no use for.
pub(super) fn judge(keyword: &[u8], rest: &[u8]) -> Unread {
    let is_off = matches!(rest.trim_ascii(), b"off");
    let unless = |harmless: bool, oddity: Oddity| match harmless {
        true => Unread::Harmless,
        false => Unread::Noted(oddity),
    };
    match keyword {
        b"curv" | b"surf" | b"bsp" | b"bzp" | b"cdc" | b"cdp" => Unread::Noted(Oddity::Surface),
        b"call" => Unread::Noted(Oddity::Call),
        b"csh" => Unread::Noted(Oddity::Shell),
        b"shadow_obj" => Unread::Noted(Oddity::ShadowObject),
        b"trace_obj" => Unread::Noted(Oddity::TraceObject),
        b"usemap" => unless(is_off, Oddity::TextureMap),
        b"bevel" => unless(is_off, Oddity::Bevel),
        b"c_interp" => unless(is_off, Oddity::ColorInterpolation),
        b"d_interp" => unless(is_off, Oddity::DissolveInterpolation),
        b"lod" => unless(matches!(rest.trim_ascii(), b"0"), Oddity::LevelOfDetail),
        // They describe curves and surfaces, each of which is noted.
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv2" | b"parm" | b"trim" | b"hole" | b"scrv"
        | b"sp" | b"end" | b"con" | b"mg" | b"ctech" | b"stech" | b"res" => Unread::Harmless,
        // Only `usemap` shows what is in it.
        b"maplib" => Unread::Harmless,
        _ => Unread::Unknown,
    }
}

/// Statements that are read, for the remedy of one in upper case.
const READ: &[&[u8]] = &[b"v", b"vt", b"vn", b"f", b"fo", b"l", b"p", b"o", b"g", b"s", b"usemtl", b"mtllib"];

/// So many unknown statements are named; a hostile file could have millions.
const MOST_KINDS: usize = 8;

/// So much of an unknown statement is kept and shown, in bytes.
const MOST_BYTES: usize = 40;

/// What stands where a statement should, by its first word.
#[derive(Debug, Default)]
pub(crate) struct Unknown {
    all: Tally,
    /// The first kinds; one above [`MOST_KINDS`] says that there are too many to name.
    kinds: Vec<(Vec<u8>, Tally)>,
}

impl Unknown {
    pub(crate) fn note(&mut self, keyword: &[u8], line: u64) {
        self.all.add(line);
        self.add_kind(&keyword[..keyword.len().min(MOST_BYTES)], Tally { count: 1, line });
    }

    fn add_kind(&mut self, keyword: &[u8], tally: Tally) {
        if let Some((_, known)) = self.kinds.iter_mut().find(|(known, _)| known == keyword) {
            known.add_all(tally);
        } else if self.kinds.len() <= MOST_KINDS {
            self.kinds.push((keyword.to_owned(), tally));
        }
    }

    /// Adds what was counted further on in the file.
    pub(super) fn add_all(&mut self, later: &Self) {
        self.all.add_all(later.all);
        for (keyword, tally) in &later.kinds {
            self.add_kind(keyword, *tally);
        }
    }

    /// What is wrong with the first, and what to do about it.
    pub(super) fn first(&self) -> Option<(String, &'static str)> {
        self.kinds.first().map(|(keyword, _)| (describe(keyword), remedy(keyword)))
    }

    pub(super) fn warn(&self, warnings: &mut Warnings) {
        if self.kinds.len() > MOST_KINDS {
            let what = format!("more than {MOST_KINDS} kinds of statements are unknown and are ignored");
            let remedy = "check that the file is an OBJ, and its spelling";
            warnings.push_counted(self.all.count, Location::Line(self.all.line), what, remedy);
            return;
        }
        for (keyword, tally) in &self.kinds {
            warnings.push_counted(
                tally.count,
                Location::Line(tally.line),
                describe(keyword),
                remedy(keyword),
            );
        }
    }
}

fn describe(keyword: &[u8]) -> String {
    format!("the statement \"{}\" is unknown and is ignored", String::from_utf8_lossy(keyword))
}

fn remedy(keyword: &[u8]) -> &'static str {
    let lower = keyword.to_ascii_lowercase();
    if READ.contains(&lower.as_slice()) || judge(&lower, b"") != Unread::Unknown {
        "write it in lower case"
    } else {
        "check its spelling, or remove it"
    }
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;

    fn warned(unknown: &Unknown) -> Vec<String> {
        let mut warnings = Warnings::about(Path::new("a.obj"));
        unknown.warn(&mut warnings);
        warnings.into_list().iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_flood_of_unknown_statements_is_one_warning() {
        let mut unknown = Unknown::default();
        for line in 1..=MOST_KINDS as u64 {
            unknown.note(format!("x{line}").as_bytes(), line);
        }
        assert_eq!(warned(&unknown).len(), MOST_KINDS, "each is named");
        let mut later = Unknown::default();
        for line in 10..1000 {
            later.note(format!("y{line}").as_bytes(), line);
        }
        unknown.add_all(&later);
        let warnings = warned(&unknown);
        assert_eq!(warnings.len(), 1, "{warnings:?}");
        assert!(warnings[0].starts_with("a.obj, line 1: more than 8 kinds"), "{warnings:?}");
        assert!(warnings[0].contains("and 997 more"), "all are counted: {warnings:?}");
    }
}
