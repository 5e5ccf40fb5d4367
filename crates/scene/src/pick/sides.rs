//! On which sides of an area points lie: a byte for each, which tells what lies beside the area.

use fearless_simd::f64x8;
use trigon_raster::simd::{LANES, Simd, inlined, lanes_of, prelude::*};

use super::region::Area;
use super::screen::{Spot, Spots};

/// On which sides of an area a point lies, of the box of pixels around it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Sides(u8);

impl Sides {
    const LEFT: u8 = 1;
    const RIGHT: u8 = 2;
    const ABOVE: u8 = 4;
    const BELOW: u8 = 8;
    /// Beyond the far plane.
    const FAR: u8 = 16;
    /// Before the near plane: not on the screen.
    const NOWHERE: u8 = 32;

    pub(super) fn of(spot: &Spot, area: &Area<'_>) -> Self {
        if !spot.is_somewhere() {
            return Self(Self::NOWHERE);
        }
        let [left, right] = [area.columns.start, area.columns.end].map(f64::from);
        let [above, below] = [area.rows.start, area.rows.end].map(f64::from);
        let side = |is_there: bool, side: u8| if is_there { side } else { 0 };
        Self(
            side(spot.at.x < left, Self::LEFT)
                | side(spot.at.x > right, Self::RIGHT)
                | side(spot.at.y < above, Self::ABOVE)
                | side(spot.at.y > below, Self::BELOW)
                | side(!spot.is_in_range(), Self::FAR),
        )
    }

    /// The same of several points.
    #[inline(always)]
    pub(super) fn of_each<S: Simd>(simd: S, spots: &Spots<S>, area: &Area<'_>) -> [Self; LANES] {
        let splat = inlined(
            #[inline(always)]
            |value: f64| f64x8::splat(simd, value),
        );
        let border = inlined(
            #[inline(always)]
            |pixel: u32| splat(pixel.into()),
        );
        let Spots([x, y, depth]) = *spots;
        let (none, far) = (splat(0.0), splat(Self::FAR.into()));
        let sides = x.simd_lt(border(area.columns.start)).select(splat(Self::LEFT.into()), none)
            + x.simd_gt(border(area.columns.end)).select(splat(Self::RIGHT.into()), none)
            + y.simd_lt(border(area.rows.start)).select(splat(Self::ABOVE.into()), none)
            + y.simd_gt(border(area.rows.end)).select(splat(Self::BELOW.into()), none)
            + depth.simd_ge(none).select(none, far);
        let sides = depth.simd_eq(depth).select(sides, splat(Self::NOWHERE.into()));
        let sides: [f64; LANES] = sides.into();
        lanes_of(
            #[inline(always)]
            |lane| Self(sides[lane] as u8),
        )
    }

    /// Whether the point lies in the box.
    pub(super) fn is_inside(self) -> bool {
        self.0 == 0
    }

    /// Whether the near plane cuts what lies between points, of which some are before it.
    pub(super) fn is_cut(points: &[Self]) -> bool {
        points.iter().any(|point| point.0 == Self::NOWHERE)
    }

    /// Whether all that is between some points lies on one side.
    pub(super) fn is_beside(points: &[Self]) -> bool {
        points.iter().fold(u8::MAX, |sides, point| sides & point.0) != 0
    }
}

#[cfg(test)]
mod tests {
    use fearless_simd::{Level, dispatch};
    use proptest::prelude::*;
    use trigon_camera::Viewport;
    use trigon_math::DVec2;

    use super::*;
    use crate::pick::region::Region;

    proptest! {
        #[test]
        fn several_points_have_the_sides_that_each_has_alone(
            points in prop::array::uniform8((-5.0..50.0_f64, 0.0..30.0_f64, prop_oneof![
                4 => -0.1..1.0_f64, 1 => Just(0.0), 1 => Just(f64::NAN)
            ])),
            left in prop_oneof![0.0..40.0_f64, Just(f64::from(7_u8))],
        ) {
            let region = Region::Rectangle { min: DVec2::new(left, 5.0), max: DVec2::new(left + 9.0, 20.0) };
            let area = Area::new(&region, Viewport { width: 40, height: 30 });
            let spots = points.map(|(x, y, depth)| {
                let at = if depth.is_nan() { DVec2::NAN } else { DVec2::new(x, y) };
                Spot { at, depth }
            });
            let together = dispatch!(Level::new(), simd => Sides::of_each(simd, &Spots::of(simd, &spots), &area));
            prop_assert_eq!(together, spots.map(|spot| Sides::of(&spot, &area)));
        }
    }
}
