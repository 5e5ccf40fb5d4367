//! How far triangles extend. A long line that is neither level nor upright is far from most of the box around it.

/// How far a triangle extends to the left and to the right between two heights. If it is not there, the left end is
/// greater than the right one.
pub(super) fn columns([a, b, c]: &[[f64; 2]; 3], [top, bottom]: [f64; 2]) -> [f64; 2] {
    let mut columns = [f64::INFINITY, f64::NEG_INFINITY];
    for (from, to) in [(a, b), (b, c), (c, a)] {
        let [upper, lower] = if from[1] <= to[1] { [from, to] } else { [to, from] };
        if lower[1] < top || upper[1] > bottom {
            continue;
        }
        let at = |y: f64| upper[0] + (lower[0] - upper[0]) * ((y - upper[1]) / (lower[1] - upper[1]));
        let ends = [
            if upper[1] < top { at(top) } else { upper[0] },
            if lower[1] > bottom { at(bottom) } else { lower[0] },
        ];
        columns = [columns[0].min(ends[0]).min(ends[1]), columns[1].max(ends[0]).max(ends[1])];
    }
    columns
}
