//! Coverage of a triangle on a sub-pixel grid: exact integer edge functions with the top-left rule.

use std::ops::RangeInclusive;

/// The three edges of a triangle as functions of the pixel, exact in `i64` for corners
/// within 2¹⁴ pixels and up to 12 bits behind the point.
pub struct Edges {
    corners: [[i64; 2]; 3],
    /// How the functions change from column to column and from row to row.
    steps: [[i64; 2]; 3],
    /// Their values at the first pixel's centre.
    starts: [i64; 3],
    /// 0 for an edge that owns the samples on it, 1 for one that does not.
    biases: [i64; 3],
    one: i64,
    /// Whether the last two corners were swapped.
    flipped: bool,
}

impl Edges {
    /// Edges of a triangle with corners in units of 1/`one` pixel, in either winding;
    /// none if it has no area.
    #[must_use]
    pub fn new([a, b, c]: [[i64; 2]; 3], one: i64) -> Option<Self> {
        let turn = cross(a, b, c);
        let corners = if turn < 0 { [a, c, b] } else { [a, b, c] };
        let flipped = turn < 0;
        let mut edges = Self { corners, steps: [[0; 2]; 3], starts: [0; 3], biases: [0; 3], one, flipped };
        for i in 0..3 {
            // Edge i is opposite of corner i, so its value is that corner's weight.
            let (from, to) = (corners[(i + 1) % 3], corners[(i + 2) % 3]);
            let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
            edges.steps[i] = [-dy * one, dx * one];
            edges.starts[i] = cross(from, to, [one / 2; 2]);
            // Clockwise with y down: a left edge rises, a top edge runs to the right.
            let has_border = dy < 0 || (dy == 0 && dx > 0);
            edges.biases[i] = i64::from(!has_border);
        }
        (turn != 0).then_some(edges)
    }

    /// Whether the triangle covers the centre of a pixel.
    #[must_use]
    #[inline]
    pub fn covers(&self, pixel: [i32; 2]) -> bool {
        (0..3).all(|i| self.value(i, pixel) >= self.biases[i])
    }

    /// The edges in units of one pixel times the grid's, rounded down, which keeps their signs with the
    /// borders counted. For each edge the value at `first`, and the steps from column to column and from row
    /// to row. None if a value between `first` and `last` exceeds 32 bits.
    #[must_use]
    pub fn planes(&self, first: [i32; 2], last: [i32; 2]) -> Option<[[i32; 3]; 3]> {
        let mut planes = [[0; 3]; 3];
        for (i, plane) in planes.iter_mut().enumerate() {
            let value = |pixel: [i32; 2]| (self.value(i, pixel) - self.biases[i]).div_euclid(self.one);
            // A linear function is largest and least in corners.
            let corners = [first, last, [first[0], last[1]], [last[0], first[1]]];
            if corners.iter().any(|&corner| i32::try_from(value(corner)).is_err()) {
                return None;
            }
            let [across, down] = self.steps[i].map(|step| step / self.one);
            *plane = [value(first), across, down].map(|part| part as i32);
        }
        Some(planes)
    }

    /// Whether a pixel's centre lies beyond one of the three edges.
    #[must_use]
    pub fn is_beyond(&self, edge: usize, pixel: [i32; 2]) -> bool {
        self.value(edge, pixel) < self.biases[edge]
    }

    /// Values at the corners, in the order in which those were given, made ready for
    /// [`interpolated`](Self::interpolated).
    #[must_use]
    pub fn shares(&self, [a, b, c]: [f64; 3]) -> [f64; 3] {
        let [p, q, r] = self.corners;
        let area = cross(p, q, r) as f64;
        let values = if self.flipped { [a, c, b] } else { [a, b, c] };
        values.map(|value| value / area)
    }

    /// A value that is linear on the screen, at the centre of a pixel.
    #[must_use]
    #[inline]
    pub fn interpolated(&self, shares: &[f64; 3], pixel: [i32; 2]) -> f64 {
        weighted(shares, [0, 1, 2].map(|i| self.value(i, pixel)))
    }

    /// Calls `visit` for each pixel of some columns and rows that the triangle covers, with the
    /// values of its edges there, which are the weights of the corners. From pixel to pixel the
    /// values change by their steps: nothing is multiplied.
    #[inline]
    pub fn each_covered(
        &self,
        [columns, rows]: &[RangeInclusive<i32>; 2],
        mut visit: impl FnMut([i32; 2], [i64; 3]),
    ) {
        for y in rows.clone() {
            let mut values = [0, 1, 2].map(|i| self.value(i, [*columns.start(), y]));
            for x in columns.clone() {
                if (0..3).all(|i| values[i] >= self.biases[i]) {
                    visit([x, y], values);
                }
                for (value, [across, _]) in values.iter_mut().zip(self.steps) {
                    *value += across;
                }
            }
        }
    }

    /// Columns and rows that the triangle can reach in an image of that size.
    #[must_use]
    pub fn bounding_box(&self, [width, height]: [i32; 2]) -> [RangeInclusive<i32>; 2] {
        let within = |axis: usize, side: i32| {
            let [a, b, c] = self.corners.map(|corner| corner[axis].div_euclid(self.one));
            let (low, high) = (a.min(b).min(c), a.max(b).max(c));
            low.clamp(0, i64::from(side)) as i32..=high.clamp(-1, i64::from(side) - 1) as i32
        };
        [within(0, width), within(1, height)]
    }

    #[inline]
    fn value(&self, edge: usize, [x, y]: [i32; 2]) -> i64 {
        let [across, down] = self.steps[edge];
        self.starts[edge] + across * i64::from(x) + down * i64::from(y)
    }
}

/// A value that is linear on the screen where the edges have some values.
#[must_use]
#[inline]
pub fn weighted(shares: &[f64; 3], weights: [i64; 3]) -> f64 {
    (0..3).map(|i| weights[i] as f64 * shares[i]).sum()
}

/// Twice the signed area: positive if the points run clockwise on the screen.
fn cross(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}
