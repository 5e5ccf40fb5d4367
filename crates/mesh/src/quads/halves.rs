//! The triangles into which quads are cut along a diagonal.

use super::Quads;
use super::vectors::{Vectors, cross, difference, dot, each, lanes};

/// Both triangles of each of several quads, side by side. First is the triangle of the quad's first two corners.
#[derive(Clone, Copy, Debug)]
pub struct Halves<const N: usize> {
    /// Twice the areas of the triangles.
    pub doubled_areas: [[f64; N]; 2],
    /// How long the two sides of each triangle are together that are sides of the quad.
    pub outer_lengths: [[f64; N]; 2],
    /// How long the diagonals are.
    pub diagonals: [f64; N],
}

impl<const N: usize> Quads<N> {
    /// The triangles of quads that are cut from their first corner to the third, or else from the second to the last.
    #[must_use]
    #[inline(always)]
    pub fn halves(&self, is_first: [bool; N]) -> Halves<N> {
        let [a, b, c, d] = &self.wide();
        let [ab, bc, cd, da] = [difference(b, a), difference(c, b), difference(d, c), difference(a, d)];
        let (first, second) = (difference(c, a), difference(d, b));
        // Twice the area is the cross product of two sides.
        let areas = [cross(&ab, &chosen(is_first, &bc, &second)), cross(&chosen(is_first, &first, &bc), &cd)];
        let diagonals = length(&chosen(is_first, &first, &second));
        let [ab, bc, cd, da] = [length(&ab), length(&bc), length(&cd), length(&da)];
        let pick = |first: f64, second: f64, lane: usize| if is_first[lane] { first } else { second };
        let outer_lengths = [
            lanes(|lane| ab[lane] + pick(bc[lane], da[lane], lane)),
            lanes(|lane| pick(cd[lane], bc[lane], lane) + pick(da[lane], cd[lane], lane)),
        ];
        let [one, other] = areas;
        Halves { doubled_areas: [length(&one), length(&other)], outer_lengths, diagonals }
    }
}

/// The first vectors where they are chosen, else the second ones.
#[inline(always)]
fn chosen<const N: usize>(is_first: [bool; N], first: &Vectors<N>, second: &Vectors<N>) -> Vectors<N> {
    each(|axis, lane| if is_first[lane] { first[axis][lane] } else { second[axis][lane] })
}

#[inline(always)]
fn length<const N: usize>(vectors: &Vectors<N>) -> [f64; N] {
    let squares = dot(vectors, vectors);
    lanes(|lane| squares[lane].sqrt())
}
