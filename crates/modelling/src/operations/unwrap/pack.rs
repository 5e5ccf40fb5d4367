//! Packing of islands: their rectangles are arranged in the unit square.
//!
//! Rectangles are laid one by one, the highest first, each as low as possible onto the skyline of those before: J.
//! Jylänki, *A Thousand Ways to Pack the Bin*, 2010, section 2.4 ("skyline bottom-left"). The side of the square is
//! the least of a series in which all have room.

use trigon_math::DVec2;

use crate::refusal::Refusal;

/// The arrangement of rectangles in a square.
#[derive(Debug, PartialEq)]
pub(super) struct Arrangement {
    /// The lower left corners, in the order of the rectangles.
    pub(super) corners: Vec<DVec2>,
    /// The side of the square.
    pub(super) side: f64,
}

/// Arranges rectangles of these sizes so that they are at least `margin` apart and from the border, measured in
/// sides of the square.
pub(super) fn pack(sizes: &[DVec2], margin: f64) -> Result<Arrangement, Refusal> {
    let mut order: Vec<usize> = (0..sizes.len()).collect();
    let by_height = |a: usize, b: usize| {
        sizes[b].y.total_cmp(&sizes[a].y).then(sizes[b].x.total_cmp(&sizes[a].x)).then(a.cmp(&b))
    };
    order.sort_by(|&a, &b| by_height(a, b));
    let area: f64 = sizes.iter().map(|size| size.x * size.y).sum();
    let greatest = sizes.iter().fold(0.0, |greatest: f64, size| greatest.max(size.max_element()));
    let least = if greatest > 0.0 { greatest.max(area.sqrt()) } else { 1.0 };
    sides(least)
        .find_map(|side| {
            arrange(sizes, &order, side, margin * side).map(|corners| Arrangement { corners, side })
        })
        .ok_or(Refusal::OutOfRange {
            parameter: "the margin",
            value: margin,
            range: "at least 0, and small enough that all islands find room",
        })
}

/// The sides that are tried: in small steps at first, then, where the margin takes most of the square, in large ones.
fn sides(least: f64) -> impl Iterator<Item = f64> {
    const SMALL_STEPS: usize = 100;
    const LARGE_STEPS: usize = 40;
    let factor = |step: usize| if step < SMALL_STEPS { 1.02 } else { 2.0 };
    (0..SMALL_STEPS + LARGE_STEPS).scan(least, move |side, step| {
        let now = *side;
        *side *= factor(step);
        Some(now)
    })
}

/// The lower left corners of rectangles in a square, if all have room.
fn arrange(sizes: &[DVec2], order: &[usize], side: f64, margin: f64) -> Option<Vec<DVec2>> {
    let mut skyline = Skyline::new(side - margin);
    let mut corners = vec![DVec2::ZERO; sizes.len()];
    for &index in order {
        let corner = skyline.add(sizes[index] + margin)?;
        corners[index] = corner + margin;
    }
    Some(corners)
}

/// A horizontal piece of the upper border of what was laid so far; the next one begins where it ends.
#[derive(Debug, Clone, Copy)]
struct Piece {
    x: f64,
    y: f64,
}

struct Skyline {
    pieces: Vec<Piece>,
    side: f64,
}

impl Skyline {
    fn new(side: f64) -> Self {
        Self { pieces: vec![Piece { x: 0.0, y: 0.0 }], side }
    }

    /// Lays a rectangle as low as possible, and there as far left as possible. Its lower left corner.
    fn add(&mut self, size: DVec2) -> Option<DVec2> {
        let mut best: Option<(usize, f64)> = None;
        for first in 0..self.pieces.len() {
            let Some(y) = self.height(first, size.x) else { break };
            if y + size.y <= self.side && best.is_none_or(|(_, lowest)| y < lowest) {
                best = Some((first, y));
            }
        }
        let (first, y) = best?;
        let x = self.pieces[first].x;
        self.cover(first, x + size.x, y + size.y);
        Some(DVec2::new(x, y))
    }

    /// How high a rectangle lies whose left side is at the beginning of a piece; `None` if it is too wide there.
    fn height(&self, first: usize, width: f64) -> Option<f64> {
        let end = self.pieces[first].x + width;
        if end > self.side {
            return None;
        }
        let below = self.pieces[first + 1..].iter().take_while(|piece| piece.x < end);
        Some(below.fold(self.pieces[first].y, |highest, piece| highest.max(piece.y)))
    }

    /// Replaces the skyline from the beginning of a piece up to `end`.
    fn cover(&mut self, first: usize, end: f64, y: f64) {
        let after = self.pieces[first..].iter().take_while(|piece| piece.x < end).count() + first;
        let last = self.pieces[after - 1];
        let next = self.pieces.get(after).map_or(self.side, |piece| piece.x);
        let covering = Piece { x: self.pieces[first].x, y };
        let rest = (end < next).then_some(Piece { x: end, y: last.y });
        self.pieces.splice(first..after, std::iter::once(covering).chain(rest));
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn four_equal_squares_fill_a_square() {
        let arrangement = pack(&[DVec2::ONE; 4], 0.0).expect("there is room");
        assert_eq!(arrangement.side, 2.0, "nothing is left");
        let single = pack(&[DVec2::new(0.5, 2.0)], 0.25).expect("there is room");
        let size = 2.0 / single.side;
        assert!((0.48..=0.5).contains(&size), "half of the square is margin: {size}");
        assert!(pack(&[DVec2::ONE; 4], 0.4).is_err(), "three margins are more than the square");
        assert!(pack(&[DVec2::ZERO; 3], 0.1).is_ok(), "points have room");
    }

    proptest! {
        /// All lie within the square, and any two are apart by the margin along an axis.
        #[test]
        fn rectangles_stay_apart(
            sizes in prop::collection::vec((0.0f64..2.0, 0.0f64..3.0), 1..40),
            margin in prop_oneof![Just(0.0), 0.0f64..0.05],
        ) {
            let sizes: Vec<DVec2> = sizes.into_iter().map(|(x, y)| DVec2::new(x, y)).collect();
            let Arrangement { corners, side } = pack(&sizes, margin).expect("there is room");
            // The least distance, but for rounding.
            let apart = margin * side - 1e-9;
            for (i, (&low, &size)) in corners.iter().zip(&sizes).enumerate() {
                let high = low + size;
                prop_assert!(low.min_element() >= apart && high.max_element() <= side - apart, "{} in {}", low, side);
                for (other, other_size) in corners.iter().zip(&sizes).skip(i + 1) {
                    let other_high = *other + *other_size;
                    let is_apart = |axis: fn(DVec2) -> f64| {
                        axis(low) - axis(other_high) >= apart || axis(*other) - axis(high) >= apart
                    };
                    prop_assert!(is_apart(|point| point.x) || is_apart(|point| point.y), "{} and {}", low, other);
                }
            }
        }

        /// The highest first on a skyline wastes at most half of the square for many small ones.
        #[test]
        fn most_of_the_square_is_used(sizes in prop::collection::vec((0.5f64..1.0, 0.5f64..1.0), 50..80)) {
            let sizes: Vec<DVec2> = sizes.into_iter().map(|(x, y)| DVec2::new(x, y)).collect();
            let area: f64 = sizes.iter().map(|size| size.x * size.y).sum();
            let side = pack(&sizes, 0.0).expect("there is room").side;
            prop_assert!(area > 0.7 * side * side, "{} of {}", area, side * side);
        }
    }
}
