//! Binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each.

use trigon_math::color::srgb_to_linear;
use trigon_math::{DVec3, Vec3, Vec4};

use super::solid::Solid;
use crate::error::{LoadError, Place};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{Polygons, most_corners, too_many_corners};

/// The header and the number of triangles, in bytes.
pub(super) const HEADER: usize = 84;
/// A normal, three vertices and the attribute, in bytes.
pub(super) const TRIANGLE: usize = 50;

/// So many triangles are read before the caller is asked again whether to go on: a multiple of [`AT_ONCE`].
const STRIDE: usize = 1 << 16;

/// So many triangles are read before their 96 corners are looked up together.
const AT_ONCE: usize = 32;

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
    let length = ((bytes.len() - HEADER) / TRIANGLE).min(count as usize);
    warn_of_size(import, bytes, count, length);
    if length > most_corners(import) / 3 {
        return Err(too_many_corners(import));
    }
    let mut solid = Solid::with_room(length);
    let mut colors = Colors::new(&bytes[..HEADER - 4]);
    let mut places = Vec::new();
    for (index, some) in bytes[HEADER..][..length * TRIANGLE].chunks(AT_ONCE * TRIANGLE).enumerate() {
        let first = index * AT_ONCE;
        if first.is_multiple_of(STRIDE) {
            import.options.report(import.path, LoadStage::Geometry, 0.9 * first as f32 / length as f32)?;
        }
        places.clear();
        for triangle in some.chunks_exact(TRIANGLE) {
            let (numbers, rest) = triangle.as_chunks::<4>();
            let number = |at: usize| f64::from(f32::from_le_bytes(numbers[at]));
            let corner = |at: usize| DVec3::new(number(at), number(at + 1), number(at + 2));
            places.push([corner(3), corner(6), corner(9)]);
            colors.push(u16::from_le_bytes([rest[0], rest[1]]));
        }
        solid.push_triangles(import, &places)?;
    }
    // One for each triangle, unless none has any.
    solid.polygons.face_colors = colors.colors;
    Ok(solid.polygons)
}

fn warn_of_size(import: &mut Import<'_>, bytes: &[u8], claimed: u32, there: usize) {
    let end = Place::Byte(bytes.len() as u64);
    if there < claimed as usize {
        let what = format!("the header claims {claimed} triangles, and the file ends after {there}");
        import.warnings.push(end, what, "copy or export the file again");
    } else if !has_exact_size(bytes) {
        let what = format!("there are bytes after the {claimed} triangles, which are ignored");
        import.warnings.push(end, what, "export the model again");
    }
}

/// The colours of triangles: 5 bits for each channel, and one that tells whether they count.
struct Colors {
    /// What Magics writes in the header: the colour of all triangles without one of their own. In such
    /// files the bit is set where there is none, and red is in the lowest bits; elsewhere the
    /// bit is set where there is one, and blue is.
    of_all: Option<Vec4>,
    /// Empty until a triangle has one.
    colors: Vec<Vec4>,
    /// The triangles so far.
    count: usize,
}

impl Colors {
    fn new(header: &[u8]) -> Self {
        const KEY: &[u8] = b"COLOR=";
        let start = header.windows(KEY.len()).position(|window| window == KEY);
        let bytes = start.and_then(|start| header.get(start + KEY.len()..start + KEY.len() + 4));
        let of_all = bytes.map(|bytes| {
            let [red, green, blue, alpha] = [0, 1, 2, 3].map(|at| f32::from(bytes[at]) / 255.0);
            linear([red, green, blue]).extend(alpha)
        });
        Self { of_all, colors: Vec::new(), count: 0 }
    }

    fn push(&mut self, attribute: u16) {
        let channel = |shift: u16| f32::from((attribute >> shift) & 31) / 31.0;
        let flag = attribute & 0x8000 != 0;
        let color = match self.of_all {
            Some(of_all) if flag => Some(of_all),
            Some(of_all) => Some(linear([channel(0), channel(5), channel(10)]).extend(of_all.w)),
            None => flag.then(|| linear([channel(10), channel(5), channel(0)]).extend(1.0)),
        };
        if color.is_some() || !self.colors.is_empty() {
            self.colors.resize(self.count, Vec4::ONE);
            self.colors.push(color.unwrap_or(Vec4::ONE));
        }
        self.count += 1;
    }
}

fn linear(color: [f32; 3]) -> Vec3 {
    Vec3::from(color.map(srgb_to_linear))
}
