//! Binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each. The header has one
//! colour for all triangles, and the attribute of a triangle one of its own.

use rayon::prelude::*;
use trigon_math::color::srgb_to_linear;
use trigon_math::{DVec3, Vec3, Vec4};

use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{Polygons, check_vertices, most_corners, too_many_corners};
use crate::vertex_table::EqualKeys;
use crate::warning::Warnings;

/// The header and the number of triangles, in bytes.
pub(super) const HEADER: usize = 84;
/// A normal, three vertices and the attribute, in bytes.
pub(super) const TRIANGLE: usize = 50;

/// So many triangles are read by all threads at once, before the caller is asked again whether to go on.
const AT_ONCE: usize = 1 << 15;

/// How many triangles the file claims; none if it is too short to say.
fn claimed(bytes: &[u8]) -> Option<u32> {
    let &[a, b, c, d] = bytes.get(HEADER - 4..HEADER)? else { return None };
    Some(u32::from_le_bytes([a, b, c, d]))
}

/// Whether a file has just the room that its number of triangles needs.
pub(super) fn has_exact_size(bytes: &[u8]) -> bool {
    claimed(bytes)
        .is_some_and(|count| bytes.len() as u64 == HEADER as u64 + u64::from(count) * TRIANGLE as u64)
}

pub(super) fn read(import: &mut Import<'_>, bytes: &[u8]) -> Result<Polygons, LoadError> {
    let Some(count) = claimed(bytes) else {
        let what = format!("it has {} bytes, and neither the start of text nor a binary header", bytes.len());
        return Err(LoadError::malformed(import.path, what, "copy or export the file again"));
    };
    let capacity = (bytes.len() - HEADER) / TRIANGLE;
    // Programs that write while they compute leave 0 where they would have to come back for the number.
    let length = if count == 0 { capacity } else { capacity.min(count as usize) };
    warn_of_size(import, bytes, count, length);
    if length > most_corners(import) / 3 {
        return Err(too_many_corners(import));
    }
    let mut polygons = Polygons { face_sizes: vec![3; length], ..Polygons::default() };
    polygons.corner_vertices.reserve_exact(3 * length);
    let mut attributes = Attributes::default();
    // Half as many vertices as triangles, as in a closed surface.
    let mut equal = EqualKeys::with_capacity(length / 2);
    let (triangles, _) = bytes[HEADER..][..length * TRIANGLE].as_chunks::<TRIANGLE>();
    let mut found = StlCorners::default();
    for some in triangles.chunks(AT_ONCE) {
        let share = polygons.corner_vertices.len() as f32 / (3 * length) as f32;
        import.options.report(import.path, LoadStage::Geometry, 0.9 * share)?;
        // One thread adds what was found before, while all others find more.
        let add = || {
            some.iter()
                .for_each(|triangle| attributes.push(u16::from_le_bytes([triangle[48], triangle[49]])));
            push_corners(&mut polygons, &found);
        };
        let ((), more) = rayon::join(add, || StlCorners::find(some, &mut equal));
        found = more;
        check_vertices(import, polygons.positions.len() as u64)?;
    }
    push_corners(&mut polygons, &found);
    check_vertices(import, polygons.positions.len() as u64)?;
    attributes.color(&bytes[..HEADER - 4], &mut polygons, &mut import.warnings);
    Ok(polygons)
}

/// Corners of triangles.
#[derive(Default)]
struct StlCorners {
    /// As the bits of their coordinates.
    positions: Vec<[[u32; 3]; 3]>,
    /// For each the number of the first corner at its place.
    firsts: Vec<u32>,
}

impl StlCorners {
    fn find(triangles: &[[u8; TRIANGLE]], equal: &mut EqualKeys<[u32; 3]>) -> Self {
        let positions: Vec<[[u32; 3]; 3]> = triangles.par_iter().map(corners).collect();
        let firsts = equal.add(positions.as_flattened());
        Self { positions, firsts }
    }
}

/// The places of a triangle's corners, as the bits of their coordinates.
fn corners(triangle: &[u8; TRIANGLE]) -> [[u32; 3]; 3] {
    let (numbers, _) = triangle.as_chunks::<4>();
    // Adding zero makes −0 and +0 the same.
    let bits = |at: usize| (f32::from_le_bytes(numbers[at]) + 0.0).to_bits();
    // The normal comes first.
    [3, 6, 9].map(|at| [bits(at), bits(at + 1), bits(at + 2)])
}

/// Adds corners, each new place among them as a vertex.
fn push_corners(polygons: &mut Polygons, corners: &StlCorners) {
    let Polygons { positions, corner_vertices, .. } = polygons;
    for (&first, corner) in corners.firsts.iter().zip(corners.positions.as_flattened()) {
        if first as usize == corner_vertices.len() {
            corner_vertices.push(positions.len() as u32);
            positions.push(DVec3::from_array(corner.map(|bits| f64::from(f32::from_bits(bits)))));
        } else {
            corner_vertices.push(corner_vertices[first as usize]);
        }
    }
}

fn warn_of_size(import: &mut Import<'_>, bytes: &[u8], claimed: u32, there: usize) {
    let end = Location::Byte(bytes.len() as u64);
    if there < claimed as usize {
        let what = format!("the header claims {claimed} triangles, and the file ends after {there}");
        import.warnings.push(end, what, "copy or export the file again");
    } else if claimed == 0 && there > 0 {
        let what = format!("the header claims no triangles, and the {there} that follow are read");
        import.warnings.push(Location::Byte(HEADER as u64 - 4), what, "export the model again");
    } else if !has_exact_size(bytes) {
        let what = format!("there are bytes after the {claimed} triangles, which are ignored");
        import.warnings.push(end, what, "export the model again");
    }
}

/// Set where there is a colour, or where there is none.
const FLAG: u16 = 0x8000;
/// What Magics writes where there is none.
const FILLED: u16 = 0xffff;

const AGAIN: &str = "export the model again, or as PLY or GLB if its colours matter";

/// The colours of a binary STL: one for all triangles in the header, and one in the attribute of each.
///
/// Programs disagree about both, so their bytes are believed only where they make a picture. Materialise
/// Magics writes `COLOR=` and four bytes, and `MATERIAL=` and three times four. The first four of `MATERIAL`
/// are the colour of diffuse light and come before `COLOR`. In attributes bit 15 is set where a triangle has
/// no colour of its own, and red is in the lowest bits. VisCAM and SolidView write no header, set bit 15
/// where there is a colour, and put blue into the lowest bits. MeshLab writes the header of Magics with
/// spaces instead of alpha, no attributes or, with red in the lowest bits, those with bit 15 set.
///
/// The attributes of triangles.
#[derive(Default)]
pub(super) struct Attributes {
    /// Empty until one is not 0.
    values: Vec<u16>,
    /// The triangles so far.
    count: usize,
}

/// What the attributes of a file mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Meaning {
    /// No triangle has a colour of its own.
    Nothing,
    /// Those without the flag have one.
    Unflagged,
    /// Those with it, red in the lowest bits.
    FlaggedRedLow,
    /// Those with it, blue in the lowest bits.
    FlaggedBlueLow,
}

impl Attributes {
    pub(super) fn push(&mut self, attribute: u16) {
        if attribute != 0 || !self.values.is_empty() {
            self.values.resize(self.count, 0);
            self.values.push(attribute);
        }
        self.count += 1;
    }

    /// Gives the triangles their colours.
    pub(super) fn color(&self, header: &[u8], polygons: &mut Polygons, warnings: &mut Warnings) {
        let of_all = color_of_all(header, warnings);
        let otherwise = of_all.unwrap_or(Vec4::ONE);
        let own = |red: u16, blue: u16, value: u16| {
            let channel = |shift: u16| f32::from((value >> shift) & 31) / 31.0;
            linear([channel(red), channel(5), channel(blue)]).extend(otherwise.w)
        };
        let color = |is_own: bool, color: Vec4| if is_own { color } else { otherwise };
        let color_of = |meaning: Meaning, value: u16| match meaning {
            Meaning::Nothing => otherwise,
            Meaning::Unflagged => color(value & FLAG == 0, own(0, 10, value)),
            Meaning::FlaggedRedLow => color(value & FLAG != 0, own(0, 10, value)),
            Meaning::FlaggedBlueLow => color(value & FLAG != 0, own(10, 0, value)),
        };
        match self.meaning(of_all.is_some(), warnings) {
            Meaning::Nothing => polygons.color = of_all,
            meaning => {
                polygons.face_colors = self.values.iter().map(|&value| color_of(meaning, value)).collect();
            }
        }
    }

    fn meaning(&self, has_header: bool, warnings: &mut Warnings) -> Meaning {
        let any = |is_it: fn(u16) -> bool| self.values.iter().any(|&value| is_it(value));
        let unflagged = any(|value| value & FLAG == 0 && value != 0);
        let flagged = any(|value| value & FLAG != 0 && value != FLAG && value != FILLED);
        let mut warn = |what: &str| warnings.push(Location::Whole, what, AGAIN);
        if has_header {
            // As Magics writes them: where others have no colour, 0 is black.
            if unflagged || (!flagged && any(|value| value & FLAG != 0)) && any(|value| value == 0) {
                return Meaning::Unflagged;
            }
            if flagged {
                warn(
                    "the colours of triangles have the bit that means none beside COLOR in the header, and are taken as colours",
                );
                return Meaning::FlaggedRedLow;
            }
            return Meaning::Nothing;
        }
        if !self.values.is_empty() && self.values.iter().all(|&value| value == FLAG) {
            warn("the attributes make every triangle black, and are not taken as colours");
            return Meaning::Nothing;
        }
        if any(|value| value & FLAG != 0) {
            return Meaning::FlaggedBlueLow;
        }
        if unflagged {
            warn("attributes of triangles lack the bit that marks a colour, and are not taken as colours");
        }
        Meaning::Nothing
    }
}

/// The colour that the header gives to all triangles.
fn color_of_all(header: &[u8], warnings: &mut Warnings) -> Option<Vec4> {
    let mut warn = |what: &str| warnings.push(Location::Whole, what, AGAIN);
    let (color, diffuse) =
        (StatedColors::after(header, b"COLOR="), StatedColors::after(header, b"MATERIAL="));
    let diffuse = diffuse.filter(|diffuse| diffuse.rgb != [0; 3]);
    if color.is_some_and(|color| diffuse.is_some_and(|diffuse| diffuse.rgb != color.rgb)) {
        warn("COLOR and MATERIAL in the header contradict each other, and MATERIAL counts");
    }
    let StatedColors { rgb, .. } = diffuse.or(color)?;
    let alpha = color.or(diffuse).map_or(Alpha::Given(u8::MAX), |stated| stated.alpha);
    let alpha = match alpha {
        Alpha::Given(alpha) => alpha,
        Alpha::Separator => {
            warn("the colour in the header has a separator in place of its alpha, and is taken as opaque");
            u8::MAX
        }
        Alpha::Invisible => {
            warn("the colour in the header would be invisible, and is taken as opaque");
            u8::MAX
        }
    };
    let unit = |byte: u8| f32::from(byte) / 255.0;
    Some(linear(rgb.map(unit)).extend(unit(alpha)))
}

/// A colour as a header has it.
#[derive(Clone, Copy)]
struct StatedColors {
    rgb: [u8; 3],
    alpha: Alpha,
}

#[derive(Clone, Copy)]
enum Alpha {
    Given(u8),
    /// A space, or the comma before the next word.
    Separator,
    Invisible,
}

impl StatedColors {
    /// What follows a word; nothing where only the filling of the header does.
    fn after(header: &[u8], word: &[u8]) -> Option<Self> {
        let start = header.windows(word.len()).position(|window| window == word)? + word.len();
        let &[red, green, blue, alpha] = header.get(start..start + 4)? else { return None };
        if [[b' '; 4], [0; 4]].contains(&[red, green, blue, alpha]) {
            return None;
        }
        let is_last = header.get(start + 4).is_none_or(|next| next.is_ascii_uppercase());
        let alpha = match alpha {
            0 => Alpha::Invisible,
            b' ' => Alpha::Separator,
            b',' if is_last => Alpha::Separator,
            alpha => Alpha::Given(alpha),
        };
        Some(Self { rgb: [red, green, blue], alpha })
    }
}

fn linear(color: [f32; 3]) -> Vec3 {
    Vec3::from(color.map(srgb_to_linear))
}
