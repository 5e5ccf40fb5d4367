//! T-junctions: many small polygons along one long edge.

use crate::coverage_support::{SIDE, Values, count, pixel};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::{DVec2, elementary};
use trigon_study::oracle::GridPoint;

/// How many polygons meet the long edge.
const PARTS: u32 = 64;

/// An edge across the image, its ends and the far ends of all polygons at it well
/// outside. In steps of the grid.
struct Edge {
    middle: DVec2,
    along: DVec2,
}

impl Edge {
    const REACH: f64 = 120.0 * 256.0;

    fn new(middle: [i32; 2], angle: f64) -> Self {
        let (sine, cosine) = elementary::sin_cos(angle);
        Self { middle: DVec2::from(middle.map(f64::from)), along: DVec2::new(cosine, sine) }
    }

    fn at(&self, along: f64, away: f64) -> DVec2 {
        self.middle + (self.along * along + self.along.perp() * away) * Self::REACH
    }

    /// Where the parts meet, from one end to the other, so far from the edge.
    fn joints(&self, away: f64) -> impl Iterator<Item = DVec2> + '_ {
        (0..=PARTS).map(move |i| self.at(f64::from(i) / f64::from(PARTS) * 2.0 - 1.0, away))
    }

    /// In pixels.
    fn distance(&self, point: DVec2) -> f64 {
        (point - self.middle).dot(self.along.perp()).abs() / 256.0
    }
}

/// How often each pixel is covered by quads on one side of the edge and, on the
/// other, one polygon with or without their corners on its side.
fn counts(edge: &Edge, with_corners: bool) -> Vec<u32> {
    let snapped =
        |point: DVec2| -> GridPoint { [point.x.round_ties_even() as i32, point.y.round_ties_even() as i32] };
    let mut points: Vec<GridPoint> = edge.joints(0.0).chain(edge.joints(1.0)).map(snapped).collect();
    let quads = (0..PARTS).flat_map(|i| {
        let [a, b, c, d] = [i, i + 1, PARTS + 2 + i, PARTS + 1 + i];
        [[a, b, c], [a, c, d]]
    });
    let mut triangles: Vec<_> = quads.collect();
    let apex = points.len() as u32;
    points.push(snapped(edge.at(0.0, -4.0)));
    if with_corners {
        triangles.extend((0..PARTS).map(|i| [i, i + 1, apex]));
    } else {
        triangles.push([0, PARTS, apex]);
    }
    count(&Values::on_grid(&points), &triangles)
}

/// Snapping moves a point by at most half a step on either axis, and so what runs
/// between two such points: no sample further than that from the edge can be beyond
/// it on one side and before it on the other.
const MOVED: f64 = std::f64::consts::FRAC_1_SQRT_2 / 256.0;

proptest! {
    #![proptest_config(cases(100))]

    #[test]
    fn t_junctions_crack_nowhere_but_on_their_edge(
        middle in [20 * 256..44 * 256_i32, 20 * 256..44 * 256],
        angle in 0.0_f64..7.0,
    ) {
        let edge = Edge::new(middle, angle);
        for (index, count) in counts(&edge, false).into_iter().enumerate() {
            let sample = DVec2::from(pixel(index).map(f64::from)) * 256.0 + 128.0;
            let on_the_edge = edge.distance(sample) <= MOVED;
            prop_assert!(count == 1 || on_the_edge, "{count} layers at {:?}", pixel(index));
            prop_assert!(count <= 2, "{count} layers on the edge");
        }
        let closed = counts(&edge, true);
        prop_assert!(closed.iter().all(|&count| count == 1), "with the corners on both sides nothing cracks");
    }

    /// Corners on a horizontal or vertical edge are on the grid as the edge is.
    #[test]
    fn t_junctions_along_the_axes_do_not_crack(middle in [0..SIDE * 256, 0..SIDE * 256], quarter in 0..4_u8) {
        let along = [DVec2::X, DVec2::Y, -DVec2::X, -DVec2::Y][usize::from(quarter)];
        let edge = Edge { middle: DVec2::from(middle.map(f64::from)), along };
        prop_assert!(counts(&edge, false).iter().all(|&count| count == 1), "every pixel once");
    }
}
