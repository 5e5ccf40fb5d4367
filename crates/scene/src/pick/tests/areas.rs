//! Which points and pixels lie in regions.

use num_bigint::BigInt;
use num_rational::BigRational;
use proptest::prelude::*;
use trigon_camera::Viewport;
use trigon_math::DVec2;

use super::super::region::{Area, Region, center};

const VIEWPORT: Viewport = Viewport { width: 23, height: 17 };

fn exact(value: f64) -> BigRational {
    BigRational::from_float(value).expect("finite")
}

/// Whether a point is inside a polygon by the even-odd rule, in rational numbers: by where
/// each side crosses the point's level.
fn is_inside(corners: &[DVec2], point: DVec2) -> bool {
    let [x, y] = point.to_array().map(exact);
    let zero = BigRational::from(BigInt::from(0));
    let sides = (0..corners.len()).map(|i| [corners[i], corners[(i + 1) % corners.len()]]);
    let crossed = sides.filter(|[from, to]| {
        let ([ax, ay], [bx, by]) = (from.to_array().map(exact), to.to_array().map(exact));
        if (ay > y) == (by > y) {
            return false;
        }
        let crossing = &ax + (&y - &ay) * (&bx - &ax) / (&by - &ay);
        crossing - &x > zero
    });
    crossed.count() % 2 == 1
}

fn runs(area: &Area<'_>, row: u32) -> Vec<u32> {
    if !area.rows.contains(&row) {
        return Vec::new();
    }
    let runs = area.runs(row);
    assert!(runs.windows(2).all(|two| two[0].end <= two[1].start), "from left to right: {runs:?}");
    runs.into_iter().flatten().collect()
}

/// The runs of all rows are the pixels whose centres are inside.
fn check_runs(area: &Area<'_>, is_inside: impl Fn(DVec2) -> bool) {
    for row in 0..VIEWPORT.height {
        let expected: Vec<u32> =
            (0..VIEWPORT.width).filter(|&column| is_inside(center(column, row))).collect();
        assert_eq!(runs(area, row), expected, "row {row}");
    }
}

/// Coordinates on and off pixels' borders and centres, in and beside the image.
fn coordinate() -> impl Strategy<Value = f64> {
    prop_oneof![-10.0..40.0, (-20..80_i32).prop_map(|half| f64::from(half) * 0.5)]
}

fn point() -> impl Strategy<Value = DVec2> {
    (coordinate(), coordinate()).prop_map(DVec2::from)
}

proptest! {
    #[test]
    fn a_lasso_holds_what_the_even_odd_rule_says(
        corners in prop::collection::vec(point(), 0..12),
        points in prop::collection::vec(point(), 20),
    ) {
        let region = Region::Lasso(corners.clone());
        let area = Area::new(&region, VIEWPORT);
        let in_image = |point: DVec2| point.cmpge(DVec2::ZERO).all() && point.cmplt(VIEWPORT.size()).all();
        // Corners, too, and what lies on the sides.
        let middles = corners.windows(2).map(|side| (side[0] + side[1]) * 0.5);
        for point in points.into_iter().chain(corners.iter().copied()).chain(middles) {
            let expected = in_image(point) && is_inside(&corners, point);
            prop_assert_eq!(area.contains(point), expected, "{}", point);
        }
        check_runs(&area, |point| area.contains(point));
    }

    #[test]
    fn a_circle_holds_what_is_within_its_radius(center in point(), radius in 0.0..30.0, points in prop::collection::vec(point(), 20)) {
        let region = Region::Circle { center, radius };
        let area = Area::new(&region, VIEWPORT);
        let squared = |point: DVec2| {
            let [x, y] = (point - center).to_array().map(exact);
            &x * &x + &y * &y
        };
        let limit = exact(radius) * exact(radius);
        // The squares are rounded: by less than this share of them.
        let slack = exact(1e-15) * &limit;
        for point in points {
            let in_image = point.cmpge(DVec2::ZERO).all() && point.cmplt(VIEWPORT.size()).all();
            let by = squared(point) - &limit;
            if by > slack || by < -slack.clone() || !in_image {
                prop_assert_eq!(area.contains(point), in_image && by <= -slack.clone(), "{}", point);
            }
        }
        check_runs(&area, |point| area.contains(point));
    }

    #[test]
    fn neighbouring_lassos_share_nothing_and_leave_nothing_out(corners in prop::collection::vec(point(), 4), points in prop::collection::vec(point(), 20)) {
        // A triangle parted by a line from a corner: in each half, or in neither.
        let [a, b, c, _] = corners[..] else { unreachable!("four of them") };
        let between = (b + c) * 0.5;
        let lassos = [vec![a, b, between], vec![a, between, c], vec![a, b, between, c]].map(Region::Lasso);
        let areas = lassos.each_ref().map(|region| Area::new(region, VIEWPORT));
        for point in points {
            let [one, other, both] = areas.each_ref().map(|area| area.contains(point));
            prop_assert_eq!(one != other, both, "{}", point);
        }
    }

    #[test]
    fn no_region_is_too_strange(numbers in prop::collection::vec(any::<f64>(), 8), point in point()) {
        let pair = |at: usize| DVec2::new(numbers[at], numbers[at + 1]);
        let regions = [
            Region::Point(pair(0)),
            Region::Rectangle { min: pair(0), max: pair(2) },
            Region::Circle { center: pair(0), radius: numbers[2] },
            Region::Lasso(vec![pair(0), pair(2), pair(4), pair(6)]),
        ];
        for region in &regions {
            let area = Area::new(region, VIEWPORT);
            if area.rows.contains(&3) {
                runs(&area, 3);
            }
            area.contains(point);
        }
    }
}

#[test]
fn a_point_is_its_pixel_and_rectangles_leave_out_their_end() {
    let pixels = |region: &Region| {
        let area = Area::new(region, VIEWPORT);
        (0..VIEWPORT.height)
            .flat_map(|row| runs(&area, row).into_iter().map(move |column| [column, row]))
            .collect()
    };
    let found: Vec<[u32; 2]> = pixels(&Region::Point(DVec2::new(3.0, 4.999)));
    assert_eq!(found, [[3, 4]], "one pixel");
    let found: Vec<[u32; 2]> =
        pixels(&Region::Rectangle { min: DVec2::new(2.5, 7.0), max: DVec2::new(4.5, 8.0) });
    assert_eq!(found, [[2, 7], [3, 7]], "the centre at 4.5 is the next rectangle's");
    let found: Vec<[u32; 2]> = pixels(&Region::Point(DVec2::new(-0.5, 3.0)));
    assert!(found.is_empty(), "beside the image");
}

#[test]
fn a_lasso_of_many_long_sides_takes_bounded_memory() {
    let high = |number: usize| if number.is_multiple_of(2) { -5.0 } else { 16e3 };
    let corners: Vec<DVec2> =
        (0..2000).map(|number| DVec2::new(number as f64 * 0.01, high(number))).collect();
    let region = Region::Lasso(corners.clone());
    let area = Area::new(&region, Viewport { width: 23, height: 16_000 });
    for row in [0, 7001, 15_999] {
        let expected: Vec<u32> = (0..23).filter(|&column| is_inside(&corners, center(column, row))).collect();
        assert_eq!(runs(&area, row), expected, "row {row}");
    }
}
