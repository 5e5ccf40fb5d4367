//! Lines over the image, clipped at its edges.

use trigon_math::DVec2;

/// The part of a line from `from` to `to` within `0..size`, all in pixels; `None` if it is outside (Liang and
/// Barsky, "A New Concept and Method for Line Clipping", 1984). No coordinate of the result is too large for
/// the f32 of shapes.
#[must_use]
pub fn clip_line(from: DVec2, to: DVec2, size: DVec2) -> Option<(DVec2, DVec2)> {
    // From the end that is nearer to the canvas: where a line begins right in front of an eye, the other is 10³⁰
    // pixels away, and nothing is left of places counted from there.
    if from.abs().max_element() > to.abs().max_element() {
        return clip_line(to, from, size).map(|(to, from)| (from, to));
    }
    let way = to - from;
    let (mut enter, mut leave) = (0.0, 1.0);
    for axis in 0..2 {
        for (speed, distance) in [(-way[axis], from[axis]), (way[axis], size[axis] - from[axis])] {
            let at = distance / speed;
            if speed < 0.0 && at > enter {
                enter = at;
            } else if speed > 0.0 && at < leave {
                leave = at;
            } else if speed == 0.0 && distance < 0.0 {
                return None;
            }
        }
    }
    (enter <= leave).then(|| (from + way * enter, from + way * leave))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_are_cut_at_the_edges() {
        let size = DVec2::new(10.0, 10.0);
        let through = clip_line(DVec2::new(-1e9, 5.0), DVec2::new(1e9, 5.0), size);
        let (from, to) = through.expect("it crosses the canvas");
        assert!(
            from.distance(DVec2::new(0.0, 5.0)) < 1e-3 && to.distance(DVec2::new(10.0, 5.0)) < 1e-3,
            "{from}, {to}"
        );
        assert_eq!(clip_line(DVec2::new(-1.0, 5.0), DVec2::new(-1.0, 8.0), size), None, "left of it");
        assert_eq!(clip_line(DVec2::new(-5.0, 2.0), DVec2::new(2.0, -5.0), size), None, "past its corner");
        for [from, to] in [[-1e30, 7.0], [7.0, -1e30]] {
            let line =
                clip_line(DVec2::new(from, 5.0), DVec2::new(to, 5.0), size).expect("it ends in the canvas");
            let expected = [from, to].map(|x| DVec2::new(x.max(0.0), 5.0));
            // Some roundings of places in the canvas, not of 10³⁰.
            let off = line.0.distance(expected[0]) + line.1.distance(expected[1]);
            assert!(off < 1e-12, "from {from} to {to}: {line:?}");
        }
        let inside = (DVec2::new(1.0, 2.0), DVec2::new(3.0, 4.0));
        assert_eq!(clip_line(inside.0, inside.1, size), Some(inside), "as it is");
    }
}
