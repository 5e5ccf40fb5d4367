//! The lines that all algorithms draw, the image that they paint, and the algorithms of the literature.

use trigon_classic::Field;

use crate::fill::interpolate;

/// The equation y = a x + b, evaluated for each column (the first form of source row B1): steep lines have
/// gaps, and vertical ones are not drawn.
pub(super) fn draw_naive([from, to]: Segment, coverage: &mut Field<f32>) {
    let ([x0, y0], [x1, y1]) = if from[0] < to[0] { (from, to) } else { (to, from) };
    if x0 == x1 {
        return;
    }
    let slope = (y1 - y0) as f32 / (x1 - x0) as f32;
    let offset = y0 as f32 - slope * x0 as f32;
    for x in x0..=x1 {
        let y = slope * x as f32 + offset;
        paint(coverage, [x, (y + 0.5).floor() as i32], 1.0);
    }
}

/// The incremental form (the last one of source row B1): the slope is added at each step along the longer
/// side. There are no gaps, but rounding errors accumulate.
pub(super) fn draw_dda(segment: Segment, coverage: &mut Field<f32>) {
    for pixel in pixels(segment) {
        paint(coverage, pixel, 1.0);
    }
}

/// The pixels from the lower end to the upper one along the longer side.
pub(super) fn pixels([from, to]: Segment) -> Vec<[i32; 2]> {
    let along = usize::from((to[0] - from[0]).abs() <= (to[1] - from[1]).abs());
    let (first, last) = if from[along] < to[along] { (from, to) } else { (to, from) };
    let across = interpolate(first[along], first[1 - along] as f32, last[along], last[1 - along] as f32);
    let pixel = |(step, across): (i32, f32)| {
        let across = (across + 0.5).floor() as i32;
        if along == 0 { [step, across] } else { [across, step] }
    };
    (first[along]..).zip(across).map(pixel).collect()
}

/// J. E. Bresenham, "Algorithm for computer control of a digital plotter", IBM Systems Journal 4(1), 1965,
/// for all eight directions: integers only, so no error accumulates.
pub(super) fn draw_bresenham([from, to]: Segment, coverage: &mut Field<f32>) {
    let distance = [0, 1].map(|axis| (to[axis] - from[axis]).abs());
    let step = [0, 1].map(|axis| (to[axis] - from[axis]).signum());
    let mut pixel = from;
    let mut error = distance[0] - distance[1];
    paint(coverage, pixel, 1.0);
    while pixel != to {
        let doubled = 2 * error;
        if doubled > -distance[1] {
            error -= distance[1];
            pixel[0] += step[0];
        }
        if doubled < distance[0] {
            error += distance[0];
            pixel[1] += step[1];
        }
        paint(coverage, pixel, 1.0);
    }
}

/// X. Wu, "An efficient antialiasing technique", SIGGRAPH 1991: the two pixels above and below the line share
/// the ink of one pixel, in proportion to their distances.
pub(super) fn draw_wu([from, to]: Segment, coverage: &mut Field<f32>) {
    let along = usize::from((to[0] - from[0]).abs() < (to[1] - from[1]).abs());
    let (first, last) = if from[along] < to[along] { (from, to) } else { (to, from) };
    let steps = last[along] - first[along];
    let slope = (last[1 - along] - first[1 - along]) as f32 / steps.max(1) as f32;
    for step in 0..=steps {
        let across = first[1 - along] as f32 + slope * step as f32;
        let whole = across.floor();
        let pixel = |across: i32| {
            let step = first[along] + step;
            if along == 0 { [step, across] } else { [across, step] }
        };
        paint(coverage, pixel(whole as i32), 1.0 - (across - whole));
        paint(coverage, pixel(whole as i32 + 1), across - whole);
    }
}

/// A segment between the centres of two pixels.
pub type Segment = [[i32; 2]; 2];

/// Adds ink to a pixel, if it is in the image.
#[inline]
pub(super) fn paint(coverage: &mut Field<f32>, pixel: [i32; 2], share: f32) {
    if let Some(sum) = coverage.get_mut(pixel) {
        *sum += share;
    }
}
