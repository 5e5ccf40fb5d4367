//! Parts of an OBJ that are left out or changed: counted line by line, and reported once each at the end.

use super::unread::Unknown;
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
