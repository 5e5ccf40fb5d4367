use proptest::prelude::*;
use trigon_math::{DVec2, SplitMix64};

use super::pack::*;
use crate::refusal::Refusal;

/// An island for tests.
#[derive(Debug, Clone)]
struct TestIsland {
    points: Vec<DVec2>,
    triangles: Vec<[u32; 3]>,
}

impl TestIsland {
    /// A polygon around its first point, which sees all others. It is moved to the origin.
    fn around(mut points: Vec<DVec2>) -> Self {
        let low = points.iter().fold(DVec2::INFINITY, |low, &point| low.min(point));
        points.iter_mut().for_each(|point| *point -= low);
        let last = points.len() as u32 - 1;
        let triangles = (1..=last).map(|i| [0, i, i % last + 1]).collect();
        Self { points, triangles }
    }

    fn rectangle(width: f64, height: f64) -> Self {
        let points =
            vec![DVec2::ZERO, DVec2::new(width, 0.0), DVec2::new(width, height), DVec2::new(0.0, height)];
        Self { points, triangles: vec![[0, 1, 2], [0, 2, 3]] }
    }

    /// A star with spikes of random lengths.
    fn star(spikes: usize, random: &mut SplitMix64) -> Self {
        let size = random.between(0.02, 1.0);
        let spike = |i: usize| {
            let angle = (i as f64 + random.between(0.0, 0.8)) / spikes as f64 * std::f64::consts::TAU;
            let (sin, cos) = trigon_math::elementary::sin_cos(angle);
            DVec2::new(cos, sin) * size * random.between(0.1, 1.0)
        };
        Self::around(std::iter::once(DVec2::ZERO).chain((0..spikes).map(spike)).collect())
    }

    fn area(&self) -> f64 {
        let double = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| self.points[vertex as usize]);
            (b - a).perp_dot(c - a) / 2.0
        };
        self.triangles.iter().map(double).sum()
    }
}

fn packed(islands: &[TestIsland], turns: PackTurns, margin: f64) -> Result<Arrangement, Refusal> {
    let shapes: Vec<IslandShape<'_>> = islands
        .iter()
        .map(|island| IslandShape { points: &island.points, triangles: &island.triangles })
        .collect();
    pack(&shapes, turns, margin)
}

/// The triangles of an island where it was laid.
fn laid(island: &TestIsland, slot: &Slot) -> Vec<[DVec2; 3]> {
    let corner = |vertex: u32| slot.apply(island.points[vertex as usize]);
    island.triangles.iter().map(|triangle| triangle.map(corner)).collect()
}

/// The distance of a point from a segment.
fn distance_to_segment(point: DVec2, [a, b]: [DVec2; 2]) -> f64 {
    let along = b - a;
    let t = if a == b { 0.0 } else { ((point - a).dot(along) / along.length_squared()).clamp(0.0, 1.0) };
    point.distance(a + along * t)
}

/// Whether some line separates two triangles: one along a side of either.
fn is_separate(one: &[DVec2; 3], other: &[DVec2; 3]) -> bool {
    let separates = |of: &[DVec2; 3], from: &[DVec2; 3]| {
        (0..3).any(|side| {
            let (a, b, inside) = (of[side], of[(side + 1) % 3], of[(side + 2) % 3]);
            let across = |point: DVec2| (b - a).perp_dot(point - a) * (b - a).perp_dot(inside - a).signum();
            from.iter().all(|&point| across(point) <= 0.0)
        })
    };
    separates(one, other) || separates(other, one)
}

/// The distance of two triangles: 0 if they overlap, otherwise the least from a corner of one to a side of the other.
fn distance(one: &[DVec2; 3], other: &[DVec2; 3]) -> f64 {
    if !is_separate(one, other) {
        return 0.0;
    }
    let from = |one: &[DVec2; 3], other: &[DVec2; 3]| {
        let sides = |point: DVec2| {
            (0..3).map(move |side| distance_to_segment(point, [other[side], other[(side + 1) % 3]]))
        };
        one.iter().flat_map(|&point| sides(point).collect::<Vec<_>>()).fold(f64::INFINITY, f64::min)
    };
    from(one, other).min(from(other, one))
}

/// Islands in the square, apart by the margin and congruent.
fn check(islands: &[TestIsland], turns: PackTurns, margin: f64) -> Result<Arrangement, TestCaseError> {
    let arrangement = packed(islands, turns, margin).expect("there is room");
    let side = arrangement.side;
    // The least distance, but for rounding.
    let apart = margin * side - 1e-9 * side;
    let all: Vec<Vec<[DVec2; 3]>> =
        islands.iter().zip(&arrangement.slots).map(|(island, slot)| laid(island, slot)).collect();
    for (i, one) in all.iter().enumerate() {
        for point in one.iter().flatten() {
            prop_assert!(
                point.min_element() >= apart && point.max_element() <= side - apart,
                "{point} in {side}"
            );
        }
        for other in &all[i + 1..] {
            let pairs = one.iter().flat_map(|a| other.iter().map(move |b| distance(a, b)));
            let least = pairs.fold(f64::INFINITY, f64::min);
            prop_assert!(least >= apart, "{} of {}", least, apart);
        }
    }
    for (island, slot) in islands.iter().zip(&arrangement.slots) {
        let [origin, right, up] = [DVec2::ZERO, DVec2::X, DVec2::Y].map(|point| slot.apply(point));
        let [x, y] = [right - origin, up - origin];
        prop_assert!(
            (x.length() - 1.0).abs() < 1e-9 && (y.length() - 1.0).abs() < 1e-9 && x.perp_dot(y) > 0.9,
            "a turn"
        );
        prop_assert!(turns == PackTurns::Quarters || (x - DVec2::X).length() < 1e-9, "not turned: {x}");
        let center = island.points.iter().sum::<DVec2>() / island.points.len() as f64;
        let moved = origin + x * center.x + y * center.y;
        prop_assert!(moved.distance(slot.apply(center)) < 1e-9, "the same for all points");
    }
    Ok(arrangement)
}

#[test]
fn four_equal_squares_fill_a_square() {
    let squares = vec![TestIsland::rectangle(1.0, 1.0); 4];
    let side = packed(&squares, PackTurns::None, 0.0).expect("there is room").side;
    assert!((side - 2.0).abs() < 1e-9, "nothing is left: {side}");
    let single =
        packed(&[TestIsland::rectangle(0.5, 2.0)], PackTurns::Quarters, 0.25).expect("there is room");
    let size = 2.0 / single.side;
    assert!((0.49..=0.5).contains(&size), "half of the square is margin: {size}");
    assert!(packed(&squares, PackTurns::None, 0.4).is_err(), "three margins are more than the square");
    let points = vec![TestIsland::rectangle(0.0, 0.0); 3];
    assert!(packed(&points, PackTurns::Quarters, 0.1).is_ok(), "points have room");
    assert!(packed(&vec![TestIsland::rectangle(1e-3, 1.0); 4], PackTurns::None, 0.24).is_ok(), "far apart");
}

#[test]
fn a_hole_is_filled_and_angles_lie_in_one_another() {
    // A frame around a hole of three fifths, as eight triangles.
    let corners = |low: f64, high: f64| [[low, low], [high, low], [high, high], [low, high]];
    let points = corners(0.0, 5.0).into_iter().chain(corners(1.0, 4.0)).map(DVec2::from_array).collect();
    let triangles = (0..4u32).flat_map(|i| {
        let next = (i + 1) % 4;
        [[i, next, 4 + next], [i, 4 + next, 4 + i]]
    });
    let frame = TestIsland { points, triangles: triangles.collect() };
    let arrangement =
        packed(&[TestIsland::rectangle(2.8, 2.8), frame], PackTurns::None, 0.01).expect("there is room");
    let side = arrangement.side;
    assert!(side < 5.2, "the small one is in the hole: {side}");
    // Two right triangles make a square once one of them is turned.
    let half = TestIsland { points: vec![DVec2::ZERO, DVec2::X, DVec2::ONE], triangles: vec![[0, 1, 2]] };
    let halves = [half.clone(), half];
    assert!(packed(&halves, PackTurns::Quarters, 0.0).expect("there is room").side < 1.02, "half a turn");
    assert!(packed(&halves, PackTurns::None, 0.0).expect("there is room").side > 1.2, "without");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(24))]

    /// Stars stay apart, whatever the margin, and come out alike each time.
    #[test]
    fn shapes_stay_apart(
        spikes in prop::collection::vec(3usize..9, 1..12),
        seed in any::<u64>(),
        margin in prop_oneof![Just(0.0), 0.0f64..0.05],
        turns in prop_oneof![Just(PackTurns::None), Just(PackTurns::Quarters)],
    ) {
        let mut random = SplitMix64::new(seed);
        let islands: Vec<TestIsland> = spikes.iter().map(|&spikes| TestIsland::star(spikes, &mut random)).collect();
        let arrangement = check(&islands, turns, margin)?;
        prop_assert_eq!(&packed(&islands, turns, margin).expect("as before"), &arrangement);
    }
}

proptest! {
    // Each case is a few dozen rectangles.
    #![proptest_config(ProptestConfig::with_cases(4))]

    /// Rectangles of similar sizes leave little.
    #[test]
    fn most_of_the_square_is_used(sizes in prop::collection::vec((0.5f64..1.0, 0.5f64..1.0), 30..50)) {
        let islands: Vec<TestIsland> = sizes.into_iter().map(|(x, y)| TestIsland::rectangle(x, y)).collect();
        let area: f64 = islands.iter().map(TestIsland::area).sum();
        let side = packed(&islands, PackTurns::Quarters, 0.0).expect("there is room").side;
        prop_assert!(area > 0.75 * side * side, "{} of {}", area, side * side);
    }
}
