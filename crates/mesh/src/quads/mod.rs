//! Several quads at a time: their normals, their angles, and how they are cut. All have the bits and the cuts that
//! one polygon after the other gets.

mod cuts;
mod group;
mod halves;
mod vectors;

use trigon_math::{Vec3, angles};

pub use group::QuadGroup;
pub use halves::Halves;
use vectors::{Vectors, cross, difference, dot, each, lanes};

/// The corners of quads side by side, so that the compiler computes several at once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quads<const N: usize> {
    /// By corner and axis. Each use widens the numbers to f64, which takes less time than to read twice as much.
    places: [[[f32; N]; 3]; 4],
}

impl<const N: usize> Quads<N> {
    /// All corners at the origin, until they are placed.
    pub const NONE: Self = Self { places: [[[0.0; N]; 3]; 4] };

    /// Places the corners of one quad.
    ///
    /// # Panics
    ///
    /// If `quad` is not below `N`.
    pub fn place(&mut self, quad: usize, corners: [Vec3; 4]) {
        for (corner, place) in corners.into_iter().enumerate() {
            self.move_corner(quad, corner, place);
        }
    }

    /// Moves one corner of a quad.
    pub(crate) fn move_corner(&mut self, quad: usize, corner: usize, place: Vec3) {
        for (axis, value) in self.places[corner].iter_mut().zip(place.to_array()) {
            axis[quad] = value;
        }
    }

    /// The corners as they are computed with.
    #[inline(always)]
    fn wide(&self) -> [Vectors<N>; 4] {
        let mut wide = [[[0.0; N]; 3]; 4];
        for (vectors, places) in wide.iter_mut().zip(&self.places) {
            *vectors = each(|axis, quad| f64::from(places[axis][quad]));
        }
        wide
    }

    /// The unit normal of each quad; zero if it has none.
    #[inline(always)]
    pub(crate) fn normals(&self) -> [Vec3; N] {
        let [a, b, c, d] = &self.wide();
        let [b, c, d] = [difference(b, a), difference(c, a), difference(d, a)];
        // In the order in which the area vector of any polygon is added up.
        let mut doubled = [[0.0; N]; 3];
        for part in [cross(&[[0.0; N]; 3], &b), cross(&b, &c), cross(&c, &d)] {
            doubled = each(|axis, quad| doubled[axis][quad] + part[axis][quad]);
        }
        let vectors: Vectors<N> = each(|axis, quad| doubled[axis][quad] * 0.5);
        let squares = dot(&vectors, &vectors);
        let lengths: [f64; N] = lanes(|quad| squares[quad].sqrt());
        let unit = |axis: usize, quad: usize| {
            let has_direction = lengths[quad] > 0.0 && lengths[quad].is_finite();
            if has_direction { vectors[axis][quad] / lengths[quad] } else { 0.0 }
        };
        let units: Vectors<N> = each(unit);
        lanes(|quad| Vec3::new(units[0][quad] as f32, units[1][quad] as f32, units[2][quad] as f32))
    }

    /// The angles at the corners of each quad, in radians.
    #[inline(always)]
    pub(crate) fn angles(&self) -> [[f64; 4]; N] {
        let places = self.wide();
        let (mut ahead, mut squares) = ([[[0.0; N]; 3]; 4], [[0.0; N]; 4]);
        for corner in 0..4 {
            ahead[corner] = difference(&places[(corner + 1) % 4], &places[corner]);
            squares[corner] = dot(&ahead[corner], &ahead[corner]);
        }
        let mut by_corner = [[0.0; N]; 4];
        for (corner, made) in by_corner.iter_mut().enumerate() {
            // The way back is the way ahead of the corner before, turned round.
            let before = (corner + 3) % 4;
            let dots = dot(&ahead[before], &ahead[corner]);
            let products = lanes(|quad| squares[before][quad] * squares[corner][quad]);
            *made = angles(lanes(|quad| -dots[quad]), products);
        }
        let [a, b, c, d] = by_corner;
        lanes(|quad| [a[quad], b[quad], c[quad], d[quad]])
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::MeshBuilder;
    use crate::normals::corner_angle;

    fn corner() -> impl Strategy<Value = Vec3> {
        let coordinate = prop_oneof![
            4 => -2.0_f32..2.0,
            4 => (-1_i8..=1).prop_map(f32::from),
            1 => prop::sample::select(vec![-0.0, 1e-30, 1e30, f32::NAN, f32::INFINITY]),
        ];
        prop::array::uniform3(coordinate).prop_map(Vec3::from_array)
    }

    proptest! {
        #[test]
        fn quads_side_by_side_have_the_values_of_each(
            corners in prop::array::uniform3(prop::array::uniform4(corner())),
        ) {
            let mut quads = Quads::<3>::NONE;
            for (quad, corners) in corners.into_iter().enumerate() {
                quads.place(quad, corners);
            }
            for (quad, corners) in corners.into_iter().enumerate() {
                let mut builder = MeshBuilder::new();
                corners.iter().for_each(|&corner| { builder.push_vertex(corner); });
                builder.push_face(&[0, 1, 2, 3]).expect("four vertices");
                let mesh = builder.build();
                let angles = [0, 1, 2, 3].map(|corner| corner_angle(&mesh, &[0, 1, 2, 3], corner).to_bits());
                prop_assert_eq!(quads.angles()[quad].map(f64::to_bits), angles, "quad {}", quad);
                let [own, expected] = [quads.normals()[quad], mesh.face_normal(0)];
                let bits = |normal: Vec3| normal.to_array().map(f32::to_bits);
                prop_assert_eq!(bits(own), bits(expected), "quad {}", quad);
            }
        }
    }
}
