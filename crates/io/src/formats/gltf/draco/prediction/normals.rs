//! Predictions of normals: the mean of those of the triangles around a vertex, by area.

use super::Neighbours;
use super::octahedron::Octahedron;
use crate::formats::gltf::broken::Broken;
use crate::formats::gltf::draco::corners::{NONE, next, previous};
use crate::formats::gltf::draco::rans::LikelyBits;
use crate::formats::gltf::stream::Stream;

/// The largest sum of a normal's components; larger ones are scaled down.
const LARGEST: i64 = 1 << 29;

/// Predictions from the positions of triangles.
pub(super) struct FaceNormals<'m, 'b> {
    near: Neighbours<'m>,
    octahedron: Octahedron,
    /// Whether each normal points to the other side.
    flips: LikelyBits<'b>,
}

impl<'m, 'b> FaceNormals<'m, 'b> {
    pub(super) fn read(
        stream: &mut Stream<'b>,
        near: Neighbours<'m>,
        octahedron: Octahedron,
    ) -> Result<Self, Broken> {
        Ok(Self { near, octahedron, flips: LikelyBits::open(stream)? })
    }

    pub(super) fn predict(&mut self, value: u32, predicted: &mut [i32]) -> Result<(), Broken> {
        let corner = self.near.order.corners.get(value as usize).copied().unwrap_or(NONE);
        let direction = self.octahedron.on_surface(self.normal(corner)?);
        let is_flipped = self.flips.take();
        let direction = direction.map(|number| if is_flipped { -number } else { number });
        predicted.copy_from_slice(&self.octahedron.point(direction));
        Ok(())
    }

    /// The sum of the normals of all triangles around the vertex of a corner.
    fn normal(&self, start: u32) -> Result<[i64; 3], Broken> {
        let position = |corner| self.near.position_of(self.near.value_at(corner).unwrap_or(NONE));
        let center = position(start)?;
        let mut sum = [0_i64; 3];
        for corner in self.near.table.around(start) {
            let (a, b) = (position(next(corner))?, position(previous(corner))?);
            let normal = cross(difference(a, center), difference(b, center));
            sum = std::array::from_fn(|k| sum[k].wrapping_add(normal[k]));
        }
        let size = sum.iter().fold(0, |size: i64, number| size.saturating_add(number.saturating_abs()));
        let scale = size / LARGEST;
        Ok(if size > LARGEST { sum.map(|number| number / scale) } else { sum })
    }
}

fn difference(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    std::array::from_fn(|k| a[k] - b[k])
}

fn cross(a: [i64; 3], b: [i64; 3]) -> [i64; 3] {
    let minor = |i: usize, j: usize| a[i].wrapping_mul(b[j]).wrapping_sub(a[j].wrapping_mul(b[i]));
    [minor(1, 2), minor(2, 0), minor(0, 1)]
}
