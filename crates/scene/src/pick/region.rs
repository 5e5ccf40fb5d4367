//! Regions of an image: which points and pixels lie in a region. [`Sides`] records in one byte on which sides of an area a
//! point lies.
//!
//! A lasso is a polygon by the even-odd rule, without rounding. A horizontal ray from the point to the right crosses some
//! sides of the polygon; the point is inside if the number of crossed sides is odd. A side is crossed if one end is above
//! the point and the other end is not, and if the side passes to the right of the point, by the exact orientation of the
//! three points. So a corner counts for only one of its two sides, and a point on a side belongs to only one of the two
//! areas beside the side.

use std::ops::Range;

use fearless_simd::f64x8;
use trigon_camera::Viewport;
use trigon_math::{DVec2, Orientation, orientation};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{LANES, Simd, inlined, lanes_of};

use super::screen::{Spot, Spots};

/// A part of an image, in pixels: the origin is the upper left corner, y points down, and pixel (i,
/// j) has its centre at (i + 0.5, j + 0.5). Parts beyond the image's borders are ignored. A region
/// with a coordinate that is not finite is empty.
#[derive(Clone, Debug, PartialEq)]
pub enum Region {
    /// The pixel that contains this point.
    Point(DVec2),
    /// The points with `min ≤ point < max` in both coordinates, so that neighbouring
    /// rectangles share none.
    Rectangle {
        /// The left and upper border.
        min: DVec2,
        /// The right and lower border.
        max: DVec2,
    },
    /// The points within a distance, in `f64`.
    Circle {
        /// The middle.
        center: DVec2,
        /// Pixels. A negative one contains nothing.
        radius: f64,
    },
    /// The points inside a polygon by the even-odd rule. Its last corner is joined to its first,
    /// and its sides may cross. The side of a point relative to an edge is decided exactly; of
    /// points on an edge, one side of it counts as inside, so that neighbouring polygons share
    /// none.
    Lasso(Vec<DVec2>),
}

/// A region prepared for an image.
pub(super) struct Area<'r> {
    shape: AreaShape<'r>,
    /// The pixels around it, all of them in the image.
    pub(super) columns: Range<u32>,
    /// As the columns.
    pub(super) rows: Range<u32>,
}

enum AreaShape<'r> {
    Rectangle { min: DVec2, max: DVec2 },
    Circle { center: DVec2, radius_squared: f64 },
    Lasso(Lasso<'r>),
}

impl<'r> Area<'r> {
    pub(super) fn new(region: &'r Region, viewport: Viewport) -> Self {
        let (min, max) = bounds(region);
        let is_usable = min.is_finite() && max.is_finite();
        let pixels = |min: f64, max: f64, size: u32| {
            // The casts saturate: beyond the image all is one.
            let end = if is_usable { (max.floor() as u32).saturating_add(1).min(size) } else { 0 };
            if max < 0.0 { 0..0 } else { (min.floor() as u32).min(end)..end }
        };
        let columns = pixels(min.x, max.x, viewport.width);
        let rows = pixels(min.y, max.y, viewport.height);
        let shape = match region {
            Region::Point(_) => AreaShape::Rectangle { min, max: min + DVec2::ONE },
            &Region::Rectangle { min, max } => AreaShape::Rectangle { min, max },
            &Region::Circle { center, radius } => {
                AreaShape::Circle { center, radius_squared: radius * radius }
            }
            Region::Lasso(corners) => {
                AreaShape::Lasso(Lasso::new(if is_usable { corners } else { &[] }, &rows))
            }
        };
        Self { shape, columns, rows }
    }

    /// Whether no pixel of the image is near it.
    pub(super) fn is_empty(&self) -> bool {
        self.columns.is_empty() || self.rows.is_empty()
    }

    /// Whether a point of the image lies in the region. One that is no number does not.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let within = |at: f64, pixels: &Range<u32>| at >= pixels.start.into() && at < pixels.end.into();
        within(point.x, &self.columns) && within(point.y, &self.rows) && self.shape.contains(point)
    }

    /// The pixels of a row whose centres lie in the region, from left to right.
    pub(super) fn runs(&self, row: u32) -> Vec<Range<u32>> {
        if let AreaShape::Lasso(lasso) = &self.shape {
            return lasso.runs(row, &self.columns);
        }
        // The others are convex.
        let mut inside = self.columns.clone().filter(|&column| self.contains(center(column, row)));
        let Some(first) = inside.next() else { return Vec::new() };
        let last = self.columns.clone().rev().find(|&column| self.contains(center(column, row)));
        std::iter::once(first..last.unwrap_or(first) + 1).collect()
    }
}

impl AreaShape<'_> {
    fn contains(&self, point: DVec2) -> bool {
        match self {
            Self::Rectangle { min, max } => point.cmpge(*min).all() && point.cmplt(*max).all(),
            Self::Circle { center, radius_squared } => point.distance_squared(*center) <= *radius_squared,
            Self::Lasso(lasso) => lasso.contains(point),
        }
    }
}

/// A box around a region; not finite where that is empty.
fn bounds(region: &Region) -> (DVec2, DVec2) {
    match region {
        Region::Point(point) => (point.floor(), point.floor()),
        &Region::Rectangle { min, max } => (min, max),
        &Region::Circle { center, radius } if radius >= 0.0 => (center - radius, center + radius),
        Region::Circle { .. } => (DVec2::NAN, DVec2::NAN),
        Region::Lasso(corners) if corners.iter().all(|corner| corner.is_finite()) => {
            corners.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), &corner| {
                (min.min(corner), max.max(corner))
            })
        }
        Region::Lasso(_) => (DVec2::NAN, DVec2::NAN),
    }
}

/// The centre of a pixel.
pub(super) fn center(column: u32, row: u32) -> DVec2 {
    DVec2::new(f64::from(column) + 0.5, f64::from(row) + 0.5)
}

/// Sides are listed for each band of rows that they touch, with no more entries than
/// this, whatever the polygon: 32 MB. A lasso by hand needs a few thousand.
const MOST_ENTRIES: usize = 1 << 22;

/// A polygon, its sides sorted by the rows of pixels that they touch.
pub(super) struct Lasso<'r> {
    corners: &'r [DVec2],
    first_row: u32,
    /// Rows to a band.
    band: u32,
    /// For each band where its sides begin, and the end of the last one's.
    starts: Vec<usize>,
    /// Sides, by the corner at which they begin.
    sides: Vec<u32>,
}

impl<'r> Lasso<'r> {
    /// For points in these rows. All corners have to be finite.
    pub(super) fn new(corners: &'r [DVec2], rows: &Range<u32>) -> Self {
        let mut lasso =
            Self { corners, first_row: rows.start, band: 1, starts: Vec::new(), sides: Vec::new() };
        let entries =
            |lasso: &Self| -> usize { (0..corners.len()).map(|side| lasso.bands(side, rows).len()).sum() };
        while lasso.band < rows.end && entries(&lasso) > MOST_ENTRIES {
            lasso.band *= 2;
        }
        let count = rows.len().div_ceil(lasso.band as usize);
        let mut lists = vec![Vec::new(); count];
        for side in 0..corners.len() {
            lasso.bands(side, rows).for_each(|band| lists[band].push(side as u32));
        }
        lasso.starts.push(0);
        for list in lists {
            lasso.sides.extend(list);
            lasso.starts.push(lasso.sides.len());
        }
        lasso
    }

    /// The bands that a side touches.
    fn bands(&self, side: usize, rows: &Range<u32>) -> Range<usize> {
        let [from, to] = self.ends(side);
        let (upper, lower) = if from.y < to.y { (from.y, to.y) } else { (to.y, from.y) };
        if rows.is_empty() || lower < rows.start.into() || upper >= rows.end.into() {
            return 0..0;
        }
        let row = |y: f64| (y.floor() as u32).clamp(rows.start, rows.end - 1) - rows.start;
        (row(upper) / self.band) as usize..(row(lower) / self.band) as usize + 1
    }

    fn ends(&self, side: usize) -> [DVec2; 2] {
        [self.corners[side], self.corners[(side + 1) % self.corners.len()]]
    }

    /// The sides that a point in this row can have beside it.
    fn beside(&self, row: u32) -> impl Iterator<Item = [DVec2; 2]> + '_ {
        let band = ((row - self.first_row) / self.band) as usize;
        let sides = &self.sides[self.starts[band]..self.starts[band + 1]];
        sides.iter().map(|&side| self.ends(side as usize))
    }

    /// Whether a point is inside. It has to lie in the rows.
    pub(super) fn contains(&self, point: DVec2) -> bool {
        let crossed = self.beside(point.y.floor() as u32).filter(|side| is_level(side, point.y));
        crossed.filter(|side| is_right_of(side, point)).count() % 2 == 1
    }

    /// The pixels of a row whose centres are inside.
    pub(super) fn runs(&self, row: u32, columns: &Range<u32>) -> Vec<Range<u32>> {
        let level = center(0, row).y;
        let crossed = self.beside(row).filter(|side| is_level(side, level));
        // Left of each of these columns a side lies to the right, from it on it does not.
        let mut borders: Vec<u32> = crossed.map(|side| border(&side, row, columns)).collect();
        borders.sort_unstable();
        let pairs = borders.as_chunks::<2>().0;
        pairs.iter().map(|&[start, end]| start..end).filter(|run| !run.is_empty()).collect()
    }
}

/// Whether a horizontal line passes between the ends of a side.
fn is_level([from, to]: &[DVec2; 2], y: f64) -> bool {
    (from.y > y) != (to.y > y)
}

/// Whether such a side lies to the right of a point on the line.
fn is_right_of(&[from, to]: &[DVec2; 2], point: DVec2) -> bool {
    let side = if from.y < to.y { Orientation::CounterClockwise } else { Orientation::Clockwise };
    orientation(from, to, point) == side
}

/// The first of the columns whose centre has the side not to its right; the end if
/// there is none.
fn border(side: &[DVec2; 2], row: u32, columns: &Range<u32>) -> u32 {
    let Range { mut start, mut end } = *columns;
    while start < end {
        let middle = u32::midpoint(start, end);
        if is_right_of(side, center(middle, row)) {
            start = middle + 1;
        } else {
            end = middle;
        }
    }
    start
}

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
    use super::{Region, *};
    use proptest::prelude::*;
    use trigon_camera::Viewport;
    use trigon_math::DVec2;
    use trigon_math::at_level;
    use trigon_math::simd::Token;

    /// Whether a point is in a polygon, by the angles under which it sees the sides: the sum is a full turn or none.
    fn surrounds(corners: &[DVec2], point: DVec2) -> bool {
        let sides =
            (0..corners.len()).map(|i| [corners[i] - point, corners[(i + 1) % corners.len()] - point]);
        let turn: f64 = sides.map(|[a, b]| a.angle_to(b)).sum();
        turn.abs() > 3.0
    }

    #[test]
    fn rows_begin_and_end_where_the_polygon_does() {
        let star = [[1.3, 2.2], [17.9, 9.1], [3.7, 9.9], [18.2, 1.4], [9.6, 18.3], [-6.0, 30.0]];
        for polygon in [&star[..3], &star[1..5], &star[2..]] {
            let corners: Vec<DVec2> = polygon.iter().map(|&corner| DVec2::from_array(corner)).collect();
            for (rows, columns) in [(0..20, 0..20), (3..11, 5..9)] {
                let lasso = Lasso::new(&corners, &rows);
                for row in rows {
                    let runs = lasso.runs(row, &columns);
                    assert!(runs.iter().all(|run| !run.is_empty()), "{runs:?}");
                    for column in columns.clone() {
                        let at = center(column, row);
                        let is_inside = runs.iter().filter(|run| run.contains(&column)).count();
                        assert_eq!(is_inside, usize::from(lasso.contains(at)), "{at}: {runs:?}");
                        // Polygons that cross themselves may be surrounded twice.
                        let is_simple = polygon.len() == 3;
                        assert!(!is_simple || lasso.contains(at) == surrounds(&corners, at), "{at}");
                    }
                }
            }
        }
    }

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
            let together = at_level!(Token::best(), simd => Sides::of_each(simd, &Spots::of(simd, &spots), &area));
            prop_assert_eq!(together, spots.map(|spot| Sides::of(&spot, &area)));
        }
    }
}
