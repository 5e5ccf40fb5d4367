//! Binary STL: a header of 80 bytes, the number of triangles, and 50 bytes for each.

use rayon::prelude::*;
use trigon_math::DVec3;

use super::colors::Attributes;
use crate::equal_keys::EqualKeys;
use crate::error::{LoadError, Location};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{Polygons, check_vertices, most_corners, too_many_corners};

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
    let mut found = Corners::default();
    for some in triangles.chunks(AT_ONCE) {
        let share = polygons.corner_vertices.len() as f32 / (3 * length) as f32;
        import.options.report(import.path, LoadStage::Geometry, 0.9 * share)?;
        // One thread adds what was found before, while all others find more.
        let add = || {
            some.iter()
                .for_each(|triangle| attributes.push(u16::from_le_bytes([triangle[48], triangle[49]])));
            push_corners(&mut polygons, &found);
        };
        let ((), more) = rayon::join(add, || Corners::find(some, &mut equal));
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
struct Corners {
    /// As the bits of their coordinates.
    positions: Vec<[[u32; 3]; 3]>,
    /// For each the number of the first corner at its place.
    firsts: Vec<u32>,
}

impl Corners {
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
fn push_corners(polygons: &mut Polygons, corners: &Corners) {
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
