//! What the report claims of lines.

use super::*;

const SIZE: [usize; 2] = [256; 2];

fn errors(line: Line) -> LineErrors {
    let mut sum = LineErrors::default();
    for segment in star(SIZE[0], 120) {
        sum += LineErrors::of(line, segment, SIZE);
    }
    sum
}

#[test]
fn steep_lines_have_gaps_in_the_naive_form_only() {
    assert!(errors(Line::Naive).gaps > 1000, "half of the lines are steep: {:?}", errors(Line::Naive));
    for line in [Line::Dda, Line::Bresenham, Line::Engine] {
        let LineErrors { gaps, strays, steps, .. } = errors(line);
        assert_eq!((gaps, strays), (0, 0), "{line:?} in {steps} steps");
    }
}

#[test]
fn the_slope_adds_up_its_rounding() {
    let long = [[0, 0], [16_001, 331]];
    let dda = LineErrors::of(Line::Dda, long, [16_002, 332]);
    let bresenham = LineErrors::of(Line::Bresenham, long, [16_002, 332]);
    assert!(dda.strays > 0, "after {} additions in f32", dda.steps);
    assert_eq!(bresenham.strays, 0, "whole numbers do not round");
}

#[test]
fn anti_aliased_lines_are_nearer_to_the_area() {
    let [sharp, wu, smooth] = [Line::Bresenham, Line::Wu, Line::EngineSmooth].map(|line| errors(line).rmse());
    assert!(wu < sharp / 2.0, "{wu} and {sharp}");
    assert!(smooth < wu, "{smooth} and {wu}");
}

#[test]
fn outlines_leave_the_fill_unless_the_face_paints_them() {
    let mut sums = [OutlineErrors::default(); 3];
    for i in 0..40 {
        let corners = [[20 + i, 10], [230 - 2 * i, 40 + 4 * i], [60 + i, 240 - 3 * i]];
        for (sum, outline) in sums.iter_mut().zip(Outline::ALL) {
            *sum += outline.errors(corners, SIZE);
        }
    }
    let [source, lines, faces] = sums.map(|sum| sum.outside);
    assert!(source > 0 && lines > 0, "pixels beside the fill: {source} and {lines}");
    assert_eq!(faces, 0, "edges painted by the face are on the face");
    assert!(sums[2].outline > 1000, "and there are {} of them", sums[2].outline);
}

#[test]
fn flat_lines_of_the_naive_form_are_as_good_as_others() {
    let mut sum = LineErrors::default();
    for segment in star(SIZE[0], 120) {
        let [from, to] = segment;
        if (to[0] - from[0]).abs() >= (to[1] - from[1]).abs() {
            sum += LineErrors::of(Line::Naive, segment, SIZE);
        }
    }
    assert!(sum.steps > 1000, "half of the lines are flat: {sum:?}");
    assert_eq!((sum.gaps, sum.strays), (0, 0), "in {} steps", sum.steps);
}
