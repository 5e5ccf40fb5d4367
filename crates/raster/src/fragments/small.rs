//! Edge functions of small triangles, from products of 16-bit numbers.
//!
//! A lane of 32 bits holds two numbers of 16, x in the low half and y in the high one. An edge
//! function through the first vertex is the dot product of the steps (right, down) with the offset
//! from that vertex, which is one instruction for eight lanes.

use crate::simd::{I32, InlineMap, Simd, U32, prelude::*};
use fearless_simd::i16x16;

/// Triangles whose sides and whose distances from points of the tile fit 16 bits: two
/// numbers to a lane, x in the low half, y in the high one.
pub(crate) struct SmallTriangles<S: Simd> {
    /// The first of the sorted vertices, from the tile's corner.
    pub(crate) point: I32<S>,
    /// Steps of the edge functions opposite vertices 1 and 2.
    pub(crate) steps: [I32<S>; 2],
}

impl<S: Simd> SmallTriangles<S> {
    /// The edge functions and twice the area.
    #[inline(always)]
    pub(crate) fn edges(&self, [x, y]: [I32<S>; 2]) -> ([I32<S>; 3], I32<S>) {
        let [first, second] = self.steps;
        let offset = pairs(x | (y << 16)) - pairs(self.point);
        let [b, c] = [first, second].each(
            #[inline(always)]
            |steps| pairs(steps).pairwise_dot_product(offset),
        );
        // Twice the area is the edge function opposite vertex 1, evaluated at vertex 1. The offset from
        // vertex 0 to vertex 1 is perpendicular to the steps of the other edge: (down, -right), or
        // its negative if the steps were negated to make the triangle positive inside. Hence `abs`.
        let across = (second.bitcast::<U32<S>>() >> 16).bitcast::<I32<S>>() | (-second << 16);
        let area = pairs(first).pairwise_dot_product(pairs(across)).abs();
        // The three edge functions add up to twice the area everywhere, so `area - b - c` is the third.
        // All three are below 2^30 and `area` is below 2^28, so nothing overflows.
        ([area - b - c, b, c], area)
    }
}

/// Each lane as two numbers.
#[inline(always)]
fn pairs<S: Simd>(both: I32<S>) -> i16x16<S> {
    both.bitcast()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::primitive::SMALL;
    use crate::simd::{SimdLevel, at_level};
    use proptest::prelude::*;

    /// Less than a small triangle's side, often as near to it as can be.
    fn side() -> impl Strategy<Value = i32> {
        prop_oneof![-SMALL + 1..SMALL, Just(-SMALL + 1), Just(SMALL - 1)]
    }

    /// Within a tile of 64 pixels, often at its ends.
    fn within() -> impl Strategy<Value = i32> {
        prop_oneof![0..64 * 256, Just(0), Just(64 * 256 - 1)]
    }

    proptest! {
        /// Of triangles that reach into the tile, at any of its points.
        #[test]
        fn products_of_16_bits_are_exact(
            steps in [[side(), side()], [side(), side()]],
            reached in [within(), within()],
            offset in [side(), side()],
            point in [within(), within()],
        ) {
            let vertex = [reached[0] + offset[0], reached[1] + offset[1]];
            let product = |a: [i32; 2], b: [i32; 2]| {
                i64::from(a[0]) * i64::from(b[0]) + i64::from(a[1]) * i64::from(b[1])
            };
            let to_point = [point[0] - vertex[0], point[1] - vertex[1]];
            let [b, c] = steps.map(|steps| product(steps, to_point));
            let area = product(steps[0], [steps[1][1], -steps[1][0]]).abs();
            // What is added up has to fit, too.
            prop_assume!(i32::try_from(area - b - c).is_ok());
            let packed = |[x, y]: [i32; 2]| (x & 0xffff) | y << 16;
            for token in SimdLevel::ALL.into_iter().filter_map(SimdLevel::token) {
                let found = at_level!(token, simd => {
                    let small = SmallTriangles {
                        point: I32::splat(simd, packed(vertex)),
                        steps: steps.map(|steps| I32::splat(simd, packed(steps))),
                    };
                    let (edges, area) = small.edges(point.map(|v| I32::splat(simd, v)));
                    [edges[0][0], edges[1][0], edges[2][0], area[0]]
                });
                prop_assert_eq!(found.map(i64::from), [area - b - c, b, c, area], "{:?}", token);
            }
        }
    }
}
