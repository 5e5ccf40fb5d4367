//! Predictions of normals: the mean of those of the triangles around a vertex, by area. Normals are stored as points
//! of a square: the faces of an octahedron, unfolded (Meyer and others 2010).

use super::Neighbours;
use crate::formats::gltf::draco::corners::{NONE, next, previous};
use crate::formats::gltf::draco::symbols::LikelyBits;
use crate::formats::gltf::stream::Broken;
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

/// Normals as points of a square: the faces of an octahedron, unfolded (Meyer and others 2010).
///
/// A correction is turned and mirrored into a sector that all normals share, where likely ones are close to
/// zero.
///
/// The square.
#[derive(Clone, Copy)]
pub(super) struct Octahedron {
    /// Half of its side.
    center: i32,
}

impl Octahedron {
    pub(super) fn read(stream: &mut Stream<'_>) -> Result<Self, Broken> {
        let largest = i32::from_le_bytes(stream.array()?);
        // The centre follows from it.
        let _center: [u8; 4] = stream.array()?;
        // The largest number of some bits.
        let bits = 32 - largest.leading_zeros();
        if largest % 2 == 0 || !(2..=30).contains(&bits) {
            return Err("its normals have an impossible precision");
        }
        Ok(Self { center: (1 << (bits - 1)) - 1 })
    }

    /// Adds a predicted normal to a correction.
    pub(super) fn correct(self, predicted: [i32; 2], correction: [i32; 2]) -> [i32; 2] {
        let mut predicted = predicted.map(|number| number.wrapping_sub(self.center));
        let is_inside = predicted[0].unsigned_abs().saturating_add(predicted[1].unsigned_abs())
            <= self.center.unsigned_abs();
        if !is_inside {
            predicted = self.invert(predicted);
        }
        let turns = quarter_turns(predicted);
        let predicted = turn(predicted, turns);
        let sum = |k: usize| self.wrap(predicted[k].wrapping_add(correction[k]));
        let mut value = turn([sum(0), sum(1)], (4 - turns) % 4);
        if !is_inside {
            value = self.invert(value);
        }
        value.map(|number| number.wrapping_add(self.center))
    }

    /// Brings a number back into the square.
    fn wrap(self, number: i32) -> i32 {
        let size = 2 * self.center + 1;
        if number > self.center {
            number.wrapping_sub(size)
        } else if number < -self.center {
            number.wrapping_add(size)
        } else {
            number
        }
    }

    /// Mirrors a point at the nearest edge of the diamond in the square: the upper half of the
    /// octahedron is inside of it, and the lower one outside.
    fn invert(self, [s, t]: [i32; 2]) -> [i32; 2] {
        let sign = match (s, t) {
            _ if s >= 0 && t >= 0 => [1, 1],
            _ if s <= 0 && t <= 0 => [-1, -1],
            _ => [if s > 0 { 1 } else { -1 }, if t > 0 { 1 } else { -1 }],
        };
        let corner = [sign[0] * self.center, sign[1] * self.center];
        let double = |number: i32, corner: i32| number.wrapping_mul(2).wrapping_sub(corner);
        let (s, t) = (double(s, corner[0]), double(t, corner[1]));
        let mirrored = if sign[0] == sign[1] { [t.wrapping_neg(), s.wrapping_neg()] } else { [t, s] };
        [mirrored[0].wrapping_add(corner[0]) / 2, mirrored[1].wrapping_add(corner[1]) / 2]
    }

    /// The point of a direction.
    pub(super) fn point(self, direction: [i64; 3]) -> [i32; 2] {
        let center = i64::from(self.center);
        let side = 2 * center;
        let [x, y, z] = direction;
        let [s, t] = if x >= 0 {
            [y + center, z + center]
        } else {
            let folded = |a: i64, b: i64| if a < 0 { b.abs() } else { side - b.abs() };
            [folded(y, z), folded(z, y)]
        };
        let [s, t] = match [s, t] {
            // The four corners are one and the same direction, and the edges are folded in half.
            [0, 0] => [side, side],
            [0, t] if t == side => [side, side],
            [s, 0] if s == side => [side, side],
            [0, t] if t > center => [0, side - t],
            [s, t] if s == side && t < center => [s, side - t],
            [s, t] if t == side && s < center => [side - s, t],
            [s, 0] if s > center => [side - s, 0],
            point => point,
        };
        [s as i32, t as i32]
    }

    /// The direction of a vector whose components sum up to half the square's side.
    pub(super) fn on_surface(self, vector: [i64; 3]) -> [i64; 3] {
        let center = i64::from(self.center);
        let sum: i64 = vector.iter().map(|number| number.abs()).sum();
        if sum == 0 {
            return [center, 0, 0];
        }
        let [x, y] = [vector[0], vector[1]].map(|number| number * center / sum);
        let rest = center - x.abs() - y.abs();
        [x, y, if vector[2] >= 0 { rest } else { -rest }]
    }
}

/// How many quarters a point is turned to come into the lower left.
fn quarter_turns([s, t]: [i32; 2]) -> u32 {
    match (s.signum(), t.signum()) {
        (0, 0) | (-1, ..=0) => 0,
        (0, -1) | (1, -1) => 1,
        (1, _) => 2,
        _ => 3,
    }
}

fn turn([s, t]: [i32; 2], quarters: u32) -> [i32; 2] {
    match quarters {
        1 => [t, s.wrapping_neg()],
        2 => [s.wrapping_neg(), t.wrapping_neg()],
        3 => [t.wrapping_neg(), s],
        _ => [s, t],
    }
}
