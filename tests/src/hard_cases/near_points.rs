//! Points at the near plane and behind the eye: each is as large as it is asked to be or not there at all.

use super::near_plane::distance;
use crate::coverage_support::{SIDE, Values, draw, pixel};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::{BlendMode, Pass, PointShape, Points};

/// A point in an infinite perspective.
#[derive(Clone, Copy, Debug)]
struct Point {
    position: Vec4,
}

fn point(near: f32) -> impl Strategy<Value = Point> {
    // In view or somewhat beside it, where dividing by a distance behind the eye would put it, too.
    let side = || -1.5_f32..1.5;
    (side(), side(), distance(near))
        .prop_map(move |(x, y, w)| Point { position: Vec4::new(x * w, y * w, near, w) })
}

impl Point {
    /// Where it is in steps of the grid; `None` where rounding may decide which one.
    fn on_grid(&self) -> Option<[i64; 2]> {
        let at = |coordinate: f32, sign: f64| {
            let steps =
                (1.0 + sign * f64::from(coordinate) / f64::from(self.position.w)) * f64::from(SIDE * 128);
            ((steps - steps.floor() - 0.5).abs() > 0.02).then(|| steps.round() as i64)
        };
        Some([at(self.position.x, 1.0)?, at(self.position.y, -1.0)?])
    }

    /// Whether it is on the near plane or beyond.
    fn is_before_the_eye(&self) -> bool {
        self.position.w >= self.position.z
    }
}

/// How often each pixel is covered by squares of so many steps, by integers: a sample on the left or upper side of a
/// square belongs to it.
fn expected(points: &[Point], size: i64) -> Option<Vec<f32>> {
    let mut counts = vec![0.0; (SIDE * SIDE) as usize];
    for point in points.iter().filter(|point| point.is_before_the_eye()) {
        let place = point.on_grid()?;
        for (index, count) in counts.iter_mut().enumerate() {
            let is_within = |axis: usize| {
                let from_side = 2 * (256 * i64::from(pixel(index)[axis]) + 128 - place[axis]) + size;
                (0..2 * size).contains(&from_side)
            };
            *count += f32::from(u8::from(is_within(0) && is_within(1)));
        }
    }
    Some(counts)
}

proptest! {
    #![proptest_config(cases(200))]

    /// Up to forty points about the near plane: those from it on are squares of their size in pixels, however near they
    /// are; those before it, beside the eye and behind it cover nothing.
    #[test]
    fn points_from_the_near_plane_on_have_their_size_and_nearer_ones_none(
        points in prop::sample::select(vec![0.25_f32, 0.01, 1e-4])
            .prop_flat_map(|near| prop::collection::vec(point(near), 1..40)),
        size in prop_oneof![1..40_u16, Just(200), Just(4096)],
    ) {
        let Some(expected) = expected(&points, 256 * i64::from(size)) else { return Ok(()) };
        let pipeline = Values::ones(points.iter().map(|point| point.position));
        let indices: Vec<u32> = (0..points.len() as u32).collect();
        let mut pass = Pass::new();
        pass.points(Points {
            shape: PointShape::Square,
            blend_mode: BlendMode::Translucent,
            ..Points::new(&pipeline, &indices, size.into())
        });
        let images = draw(&pass);
        let found: Vec<f32> = images.linear.expect("asked for").iter().map(|color| color.x).collect();
        prop_assert!(found == expected, "points of {} pixels", size);
    }
}
