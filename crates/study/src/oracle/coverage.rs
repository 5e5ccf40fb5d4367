//! Decides which samples a triangle on the sub-pixel grid covers.
//!
//! The top-left rule (Direct3D 11.3 functional specification, section 3.4.2.1) assigns a sample on an edge to
//! the triangle to the right of it or, if the edge is horizontal, to the one below. It is implemented here by
//! its meaning: every sample is moved a tiny distance to the right, and a much tinier one down.

use super::{GridPoint, STEPS};

/// The centre of a pixel.
#[must_use]
pub fn pixel_center(pixel: [i32; 2]) -> GridPoint {
    pixel.map(|coordinate| STEPS * coordinate + STEPS / 2)
}

/// Whether a triangle covers a sample, exactly. The winding does not matter, and a
/// triangle without area covers nothing.
#[must_use]
pub fn covers(triangle: [GridPoint; 3], sample: GridPoint) -> bool {
    let [a, b, c] = triangle;
    let sides = [side(a, b, sample), side(b, c, sample), side(c, a, sample)];
    sides == [1; 3] || sides == [-1; 3]
}

/// On which side of an edge a sample lies, 1 or -1; 0 if the edge has no length.
///
/// The edge function at the sample, moved to the right by ε and down by ε², is
/// `at the sample - dy ε + dx ε²`: for ε small enough the first term that is not
/// zero decides.
fn side(from: GridPoint, to: GridPoint, sample: GridPoint) -> i128 {
    let [[dx, dy], [x, y]] =
        [to, sample].map(|point| [0, 1].map(|axis| wide(point[axis]) - wide(from[axis])));
    let terms = [dx * y - dy * x, -dy, dx];
    terms.into_iter().find(|&term| term != 0).map_or(0, i128::signum)
}

/// Twice the area of a triangle in square steps of the grid, positive if it is
/// clockwise as seen on the screen.
#[must_use]
pub fn doubled_area([a, b, c]: [GridPoint; 3]) -> i128 {
    let [u, v] = [b, c].map(|point| [0, 1].map(|axis| wide(point[axis]) - wide(a[axis])));
    u[0] * v[1] - u[1] * v[0]
}

fn wide(coordinate: i32) -> i128 {
    i128::from(coordinate)
}

/// The standard positions of 1, 2, 4, 8 or 16 samples in sixteenths of a pixel
/// from its top left corner; none of other numbers.
///
/// Direct3D 11.3 functional specification, section 19.2.4, and the Vulkan
/// specification, table "Standard sample locations".
#[must_use]
pub fn standard_positions(samples: u32) -> &'static [[i32; 2]] {
    match samples {
        1 => &[[8, 8]],
        2 => &[[12, 12], [4, 4]],
        4 => &[[6, 2], [14, 6], [2, 10], [10, 14]],
        8 => &[[9, 5], [7, 11], [13, 9], [5, 3], [3, 13], [1, 7], [11, 15], [15, 1]],
        16 => &[
            [9, 9],
            [7, 5],
            [5, 10],
            [12, 7],
            [3, 6],
            [10, 13],
            [13, 11],
            [11, 3],
            [6, 14],
            [8, 1],
            [4, 2],
            [2, 12],
            [0, 8],
            [15, 4],
            [14, 15],
            [1, 0],
        ],
        _ => &[],
    }
}

/// Where the samples of a pixel lie, at the [`standard_positions`].
pub fn sample_points(samples: u32, [x, y]: [i32; 2]) -> impl Iterator<Item = GridPoint> {
    const SIXTEENTH: i32 = STEPS / 16;
    let position =
        move |offset: &[i32; 2]| [STEPS * x + SIXTEENTH * offset[0], STEPS * y + SIXTEENTH * offset[1]];
    standard_positions(samples).iter().map(position)
}

/// The samples of a pixel that a triangle covers, the first in the lowest bit.
#[must_use]
pub fn mask(triangle: [GridPoint; 3], samples: u32, pixel: [i32; 2]) -> u32 {
    let bits = sample_points(samples, pixel).enumerate();
    bits.map(|(number, point)| u32::from(covers(triangle, point)) << number).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Direct3D's own words: on an edge the sample is covered if that is a top or
    /// a left edge; where two meet, if both are.
    #[test]
    fn edges_and_corners_belong_as_the_specification_says() {
        let sample = pixel_center([0, 0]);
        let [x, y] = sample;
        let triangles = [
            ("above a bottom edge", [[x - 256, y], [x, y - 256], [x + 256, y]], false),
            ("below a top edge", [[x - 256, y], [x + 256, y], [x, y + 256]], true),
            ("left of a right edge", [[x, y - 256], [x, y + 256], [x - 256, y]], false),
            ("right of a left edge", [[x, y - 256], [x + 256, y], [x, y + 256]], true),
            ("at a corner of top and left", [[x, y], [x + 256, y], [x, y + 256]], true),
            ("at a corner of top and right", [[x, y], [x - 256, y], [x, y + 256]], false),
            ("at a corner of left and bottom", [[x, y], [x, y - 256], [x + 256, y]], false),
            ("at a corner of two left edges", [[x, y], [x + 256, y - 256], [x + 256, y + 256]], true),
        ];
        for (position, [a, b, c], expected) in triangles {
            assert_eq!(covers([a, b, c], sample), expected, "{position}");
            assert_eq!(covers([c, b, a], sample), expected, "{position}, reversed");
        }
    }

    #[test]
    fn a_square_covers_each_centre_once_and_others_not() {
        let corners = [[0, 0], [1024, 0], [1024, 1024], [0, 1024]];
        let halves = [[0, 1, 2], [0, 2, 3]].map(|half| half.map(|i: usize| corners[i]));
        for y in -1..6 {
            for x in -1..6 {
                let count = halves.iter().filter(|&&half| covers(half, pixel_center([x, y]))).count();
                let inside = [x, y].iter().all(|v| (0..4).contains(v));
                assert_eq!(count, usize::from(inside), "at {x}, {y}");
            }
        }
    }

    #[test]
    fn the_whole_range_of_coordinates_is_exact() {
        const END: [i32; 2] = [i32::MIN, i32::MAX];
        let [low, high] = END;
        let triangle = [[low, low], [high, low], [low, high]];
        assert_eq!(doubled_area(triangle), ((1_i128 << 32) - 1).pow(2), "the square of the longest side");
        assert!(!covers(triangle, [-1, 0]), "on the long edge: moved right it is outside");
        assert!(covers(triangle, [-2, 0]), "one step further left it is inside");
    }

    #[test]
    fn what_has_no_area_covers_nothing() {
        for flat in [[[0, 0]; 3], [[0, 0], [512, 0], [256, 0]], [[0, 0], [512, 512], [128, 128]]] {
            assert_eq!(doubled_area(flat), 0, "{flat:?}");
            assert!(!covers(flat, [128, 128]) && !covers(flat, [128, 0]), "{flat:?}");
        }
    }

    #[test]
    fn a_mask_numbers_the_samples() {
        let half = [[-9000, -9000], [128, -9000], [128, 90_000]];
        assert_eq!(mask(half, 4, [0, 0]), 0b0101, "6/16 and 2/16 of a pixel lie in the left half");
        assert_eq!(mask(half, 3, [0, 0]), 0, "three samples have no standard place");
    }

    #[test]
    fn standard_patterns_have_their_number_of_places() {
        for samples in [1, 2, 4, 8, 16] {
            let positions = standard_positions(samples);
            assert_eq!(positions.len(), samples as usize, "{samples} samples");
            let sum = |axis: usize| positions.iter().map(|position| position[axis]).sum::<i32>();
            // The 16 lie half a sixteenth off the middle, all others around it.
            let middle = if samples == 16 { [120, 120] } else { [8 * samples as i32; 2] };
            assert_eq!([sum(0), sum(1)], middle, "{samples} samples are balanced");
        }
    }
}
