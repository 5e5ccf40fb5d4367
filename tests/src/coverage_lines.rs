//! Lines and points: the same from either end, one pixel in each step, each
//! joint once. Hard case 38.

use crate::coverage_support::{SIDE, Values, clip_position, draw, pixel};
use crate::effort::cases;
use crate::hard_cases::wide_lines::Line;
use proptest::prelude::*;
use trigon_raster::{BlendMode, Lines, Pass, PointShape, Points};
use trigon_study::oracle::GridPoint;

/// How often each pixel is covered by segments of a width in pixels.
fn count(points: &[GridPoint], segments: &[[u32; 2]], width: f32) -> Vec<u32> {
    let pipeline = Values::on_grid(points);
    let mut pass = Pass::new();
    pass.lines(Lines { width, blend_mode: BlendMode::Translucent, ..Lines::new(&pipeline, segments) });
    draw(&pass).linear.expect("asked for").iter().map(|color| color.x as u32).collect()
}

fn inside() -> impl Strategy<Value = GridPoint> {
    let coordinate = 4 * 256..(SIDE - 4) * 256;
    [coordinate.clone(), coordinate]
}

proptest! {
    #![proptest_config(cases(200))]

    #[test]
    fn a_line_is_the_same_from_either_end(
        ends in [inside(), inside()],
        depths in [0.0_f32..1.0, 0.0..1.0],
        width in 1.0_f32..9.0,
    ) {
        let vertices = (0..2).map(|i| (clip_position(ends[i], depths[i]), depths[i] * 3.0)).collect();
        let pipeline = Values { vertices };
        let images = [[[0, 1]], [[1, 0]]].map(|segments| {
            let mut pass = Pass::new();
            pass.lines(Lines { width, ..Lines::new(&pipeline, &segments) });
            draw(&pass)
        });
        prop_assert!(images[0] == images[1]);
        let line = Line::new([0, 1].map(|i| pipeline.vertices[i].0), width);
        let shown: Vec<bool> = images[0].triangles.iter().flatten().map(|&id| id != u32::MAX).collect();
        line.check(&shown);
    }

    /// One pixel in each column that the line passes (or row, if it is steep),
    /// within half a pixel of it.
    #[test]
    fn a_line_of_one_pixel_has_one_in_each_step(ends in [inside(), inside()]) {
        let counts = count(&ends, &[[0, 1]], 1.0);
        let span = [ends[1][0] - ends[0][0], ends[1][1] - ends[0][1]];
        let major = usize::from(span[0].abs() < span[1].abs());
        let mut steps = [0; SIDE as usize];
        for (index, &count) in counts.iter().enumerate() {
            prop_assert!(count <= 1, "twice at {:?}", pixel(index));
            if count == 1 {
                let at = pixel(index);
                steps[at[major] as usize] += 1;
                let along = f64::from(256 * at[major] + 128 - ends[0][major]) / f64::from(span[major]);
                let line = f64::from(ends[0][1 - major]) + f64::from(span[1 - major]) * along;
                let distance = f64::from(256 * at[1 - major] + 128) - line;
                // Half a pixel, and half a step for the corners of the line's outline.
                prop_assert!(span[major] == 0 || distance.abs() <= 128.5, "{distance} off at {at:?}");
            }
        }
        let (low, high) = (ends[0][major].min(ends[1][major]), ends[0][major].max(ends[1][major]));
        for (step, &found) in (0..).zip(&steps) {
            // Prolonged by half a pixel, so both ends have theirs.
            let centre = 256 * step + 128;
            let expected = (low - 128..high + 128).contains(&centre);
            prop_assert_eq!(found, i32::from(expected), "step {}", step);
        }
    }

    #[test]
    fn a_polyline_draws_each_joint_once(points in [inside(), inside()], width in 1.0_f32..6.0) {
        let [a, b] = points;
        // Out and back again: the second segment lies on the first.
        let counts = count(&[a, b], &[[0, 1], [1, 0]], width);
        prop_assert!(counts.iter().all(|&count| count <= 1), "no pixel twice");
        let once = count(&[a, b], &[[0, 1]], width);
        let line = Line::new([a, b].map(|end| clip_position(end, 0.5)), width);
        line.check(&counts.iter().map(|&count| count == 1).collect::<Vec<_>>());
        prop_assert_eq!(counts, once);
    }

    /// A strip of segments that go on in one direction: it begins at its first end and stops at its last, both within half
    /// a pixel; between them no step is missed, and no pixel is covered twice, also where two segments meet. Where one of
    /// them covers a pixel is decided in integers; the corners of its outline are on the grid, which leaves half a step.
    #[test]
    fn a_strip_has_no_gap_and_no_pixel_twice_and_ends_where_its_ends_are(
        start in inside(), parts in prop::collection::vec((2 * 256..20 * 256_i32, -1.0_f64..1.0), 1..20),
        major in 0..2_usize, backwards in any::<bool>(),
    ) {
        let minor = 1 - major;
        let mut points = vec![start];
        for (step, slope) in parts {
            let mut next = points[points.len() - 1];
            next[major] += step;
            let shift = (f64::from(step) * slope) as i32;
            let is_inside = (2 * 256..(SIDE - 2) * 256).contains(&(next[minor] + shift));
            next[minor] += if is_inside { shift } else { -shift };
            points.push(next);
        }
        let joints: Vec<u32> = (0..points.len() as u32).collect();
        let segments: Vec<[u32; 2]> = joints.windows(2).map(|pair| if backwards { [pair[1], pair[0]] } else { [pair[0], pair[1]] }).collect();
        let counts = count(&points, &segments, 1.0);
        let (first, last) = (points[0][major], points[points.len() - 1][major]);
        for step in 0..SIDE {
            let centre = 256 * step + 128;
            // The segments that cover this step, with half a pixel at either end.
            let about: Vec<_> = points.windows(2).filter(|ends| (ends[0][major] - 128..ends[1][major] + 128).contains(&centre)).collect();
            prop_assert_eq!(about.is_empty(), !(first - 128..last + 128).contains(&centre), "step {}", step);
            let mut found = 0;
            for across in 0..SIDE {
                let at = if major == 0 { [step, across] } else { [across, step] };
                let times = counts[(at[1] * SIDE + at[0]) as usize];
                prop_assert!(times <= 1, "{} times at {:?}", times, at);
                found += times;
                // Half a pixel across the line, times its length along the axis.
                let is_within = |ends: &&[GridPoint], half: i64| {
                    let [along, over] = [major, minor].map(|axis| i64::from(ends[1][axis] - ends[0][axis]));
                    let distance = i64::from(256 * across + 128 - ends[0][minor]) * along - i64::from(centre - ends[0][major]) * over;
                    (2 * distance).abs() <= half * along
                };
                prop_assert!(times == 0 || about.iter().any(|ends| is_within(ends, 257)), "beside the strip at {:?}", at);
                prop_assert!(times == 1 || !about.iter().any(|ends| is_within(ends, 254)), "a hole at {:?}", at);
            }
            prop_assert!(about.is_empty() == (found == 0), "{} pixels in step {}", found, step);
        }
    }

    /// A line that leaves the view is drawn as if the view were larger.
    #[test]
    fn the_border_of_the_view_moves_no_pixel(ends in crossing(), dx in 0..30_i32) {
        let moved = ends.map(|[x, y]| [x + 256 * dx, y]);
        let [before, after] = [ends, moved].map(|ends| count(&ends, &[[0, 1]], 1.0));
        prop_assert!(before.contains(&1), "it is seen");
        for (ends, counts) in [(ends, &before), (moved, &after)] {
            let line = Line::new(ends.map(|end| clip_position(end, 0.5)), 1.0);
            line.check(&counts.iter().map(|&count| count == 1).collect::<Vec<_>>());
        }
        for (index, &count) in before.iter().enumerate() {
            let [x, y] = pixel(index);
            if x + dx < SIDE {
                prop_assert_eq!(count, after[(y * SIDE + x + dx) as usize]);
            }
        }
    }
}

/// A segment through the image, with one end or both up to 30,000 pixels out.
fn crossing() -> impl Strategy<Value = [GridPoint; 2]> {
    let far = || [-15_000 * 256..15_000 * 256, -15_000 * 256..15_000 * 256_i32];
    (inside(), far(), 0..=4_i32).prop_map(|(through, [x, y], part)| {
        let end = |parts: i32| [through[0] + x / 2 * parts, through[1] + y / 2 * parts];
        [end(-part), end(4 - part)]
    })
}

#[test]
fn points_have_their_size() {
    let centre = [[20 * 256, 20 * 256]];
    let pipeline = Values::on_grid(&centre);
    for (shape, size, expected) in [
        (PointShape::Square, 1.0, 1),
        (PointShape::Square, 6.0, 36),
        (PointShape::Round, 2.0, 4),
        (PointShape::Round, 6.0, 32),
        (PointShape::Square, f32::NAN, 1),
    ] {
        let mut pass = Pass::new();
        let surface = BlendMode::Translucent;
        pass.points(Points { shape, blend_mode: surface, ..Points::new(&pipeline, &[0], size) });
        let linear = draw(&pass).linear.expect("asked for");
        let covered: f32 = linear.iter().map(|color| color.x).sum();
        assert_eq!(covered, expected as f32, "{shape:?} of {size}");
        assert!(linear.iter().all(|color| color.x <= 1.0), "no pixel twice");
    }
}

/// Ends that snap to one point must not be told apart by the order in which
/// they were given.
#[test]
fn a_segment_without_length_is_the_same_from_either_end() {
    let vertices = [0.25, 0.75].map(|value| (clip_position([5000, 5000], value), value));
    let pipeline = Values { vertices: vertices.to_vec() };
    let images = [[[0, 1]], [[1, 0]]].map(|segments| {
        let mut pass = Pass::new();
        pass.lines(Lines { width: 5.0, ..Lines::new(&pipeline, &segments) });
        draw(&pass)
    });
    assert!(images[0] == images[1], "both directions");
    for (index, &id) in images[0].triangles.iter().flatten().enumerate() {
        // A square of five pixels, whose middle is not on a sample: 5000 = 19 · 256 + 136.
        let is_inside = pixel(index).iter().all(|at| (256 * at + 128 - 5000).abs() < 640);
        assert_eq!(id == 0, is_inside, "at {:?}", pixel(index));
    }
}

/// Translucent segments that share no vertex. Asking each about each other would take
/// minutes.
#[test]
fn many_segments_that_cross_in_one_sample_are_all_drawn() {
    let count_of_segments = 16_000;
    let mut points = Vec::new();
    for i in 0..count_of_segments {
        let angle = std::f64::consts::PI * f64::from(i) / f64::from(count_of_segments);
        let (sine, cosine) = trigon_math::elementary::sin_cos(angle);
        for radius in [-25.0, 25.0] {
            points.push([cosine, sine].map(|v| SIDE * 128 + 128 + (v * radius * 256.0) as i32));
        }
    }
    let segments: Vec<_> = (0..count_of_segments as u32).map(|i| [2 * i, 2 * i + 1]).collect();
    let counts = count(&points, &segments, 1.0);
    let middle = (SIDE / 2 * SIDE + SIDE / 2) as usize;
    assert_eq!(counts[middle], count_of_segments as u32, "all pass through the centre");
}
