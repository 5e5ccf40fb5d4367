//! How open surfaces are to their surroundings or to a lamp, at half the resolution of an image, and how the samples of the
//! image read it.
//!
//! **Made** in two steps. A pass over the visible surfaces casts a sixteenth of the rays at each pixel of an image of
//! half the size ([`AmbientRays`](super::AmbientRays), [`LampRays`](super::LampRays)). Then every pixel takes the mean of the
//! 4×4 pixels around it (5×5, the outermost ones by half), which have cast all the rays together.
//!
//! **Read** bilinearly at every sample of the image.
//!
//! Both steps weigh a neighbour by its distance from the plane through the point, so neither objects nor the sides of an
//! edge mix, and on surfaces that the eye sees at a grazing angle all neighbours count. The mean weighs it by the angle
//! between both normals, too. Where no neighbour lies on a sample's surface, the buffer says so, and the sample casts rays.
//!
//! The mean would blur edges of shadows that are narrower than its reach. Where the means of a lamp change that fast, the
//! buffer says that it knows nothing, too.

use trigon_camera::Projection;
use trigon_math::simd::Token;
use trigon_math::{DMat4, Vec3, Vec4, at_level};
use trigon_raster::Rasterizer;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, I32, InlineMap, LANES, Mask, Simd, greater, inlined, lane_numbers, lesser};

use crate::lanes::{V3, dot, positive};
use crate::lighting::LitPoints;

/// How far the mean reaches, in pixels to each side. As many lie around the image, empty.
const REACH: usize = 2;

/// The weights of the mean across one axis.
const MEAN: [f32; 2 * REACH + 1] = [0.5, 1.0, 1.0, 1.0, 0.5];

/// Where nothing is: farther from every plane than any weight reaches.
const NOWHERE: f32 = 1e30;

/// What is visible or not from surfaces.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum OpennessOf {
    /// What is around them.
    Surroundings,
    /// The lamp of this number.
    Lamp(usize),
}

/// In place of a fraction: the edge of a shadow is too narrow for the buffer. With any share of it, a sum of fractions
/// is negative.
const NARROW: f32 = -1e30;

/// The fraction that is visible at each pixel of a small image.
#[derive(Debug)]
pub(crate) struct OpennessBuffer {
    view: SmallView,
    /// Along the axis of the view, in metres, and the fraction: row by row, with empty pixels around them.
    pixels: Vec<[f32; 2]>,
}

/// How a small image sees the space of its camera.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmallView {
    pub(crate) width: u32,
    pub(crate) height: u32,
    /// Its pixels in a pixel of the image, across and down.
    scale: [f32; 2],
    /// How far apart two pixels lie at distance 1, and where the first corner lies, across and up.
    step: [f32; 2],
    corner: [f32; 2],
    /// Whether rays meet in the eye.
    meets: bool,
}

impl SmallView {
    /// Of an image of this size through a projection; of half the size.
    pub(crate) fn new(projection: &Projection, matrix: &DMat4, [width, height]: [u32; 2]) -> Self {
        let size = [width.div_ceil(2), height.div_ceil(2)];
        let meets = !projection.is_orthographic();
        // What a projection matrix adds to x and y: in perspective in proportion to −z, which it divides by.
        let shift = if meets { matrix.z_axis * -1.0 } else { matrix.w_axis };
        let (factor, shift) = ([matrix.x_axis.x, matrix.y_axis.y], [shift.x, shift.y]);
        let pixels = size.map(f64::from);
        // From −1…1, y up, to pixels, y down.
        let step = [2.0 / (pixels[0] * factor[0]), -2.0 / (pixels[1] * factor[1])];
        let corner = [(-1.0 - shift[0]) / factor[0], (1.0 - shift[1]) / factor[1]];
        Self {
            width: size[0],
            height: size[1],
            scale: [pixels[0] / f64::from(width), pixels[1] / f64::from(height)].map(|scale| scale as f32),
            step: step.map(|step| step as f32),
            corner: corner.map(|corner| corner as f32),
            meets,
        }
    }

    /// The pixels of a row, with those around it; the last vector may reach as far.
    fn stride(&self) -> usize {
        self.width as usize + 2 * REACH + LANES
    }

    /// All pixels, with those around them.
    fn len(&self) -> usize {
        self.stride() * (self.height as usize + 2 * REACH)
    }

    /// The slopes of the rays through the middle of columns or rows; in a parallel view their offsets.
    #[inline(always)]
    fn slopes<S: Simd>(&self, axis: usize, number: F32<S>) -> F32<S> {
        (number + 0.5) * self.step[axis] + self.corner[axis]
    }

    /// Where eight pixels of a row see surfaces at these distances. Counted with the empty pixels.
    #[inline(always)]
    fn positions<S: Simd>(&self, [column, row]: [usize; 2], distance: F32<S>) -> V3<S> {
        let (simd, spread) = (distance.token(), self.spread(distance));
        let columns = lane_numbers(simd).to_float::<F32<S>>() + (column as f32 - REACH as f32);
        let rows = F32::splat(simd, row as f32 - REACH as f32);
        [self.slopes(0, columns) * spread, self.slopes(1, rows) * spread, -distance]
    }

    /// The factor on slopes at a distance.
    #[inline(always)]
    fn spread<S: Simd>(&self, distance: F32<S>) -> F32<S> {
        if self.meets { distance } else { F32::splat(distance.token(), 1.0) }
    }

    /// The width or height of a pixel at distance 1, whichever is larger.
    #[inline(always)]
    fn widest(&self) -> f32 {
        let [width, height] = self.step.map(f32::abs);
        if width > height { width } else { height }
    }
}

/// What the pass over the surfaces leaves, row by row.
pub(crate) struct SmallImage<'a> {
    pub(crate) view: SmallView,
    /// The normal, zero where nothing is to be found out, and the fraction of the pixel's rays that nothing stops.
    pub(crate) found: &'a [Vec4],
    /// Along the axis of the view, in metres.
    pub(crate) distances: &'a [f32],
}

impl OpennessBuffer {
    pub(crate) fn new(small: &SmallImage<'_>, of: OpennessOf, rasterizer: &Rasterizer) -> Self {
        let surfaces = Surfaces::new(small);
        let means = surfaces.each_row(None, rasterizer);
        let open = match of {
            OpennessOf::Surroundings => means,
            OpennessOf::Lamp(_) => surfaces.each_row(Some(&means), rasterizer),
        };
        let pixels = surfaces.distances.into_iter().zip(open).map(|(distance, open)| [distance, open]);
        Self { view: small.view, pixels: pixels.collect() }
    }

    pub(crate) fn byte_count(&self) -> usize {
        size_of_val(self.pixels.as_slice())
    }

    /// The fraction at eight points, and which of them it is known for. The positions are in pixels of the image.
    #[inline(always)]
    pub(crate) fn at<S: Simd>(
        &self,
        simd: S,
        points: &LitPoints<S>,
        position: [F32<S>; 2],
    ) -> (F32<S>, Mask<S>) {
        /// With less on its surface, a sample knows too little.
        const LEAST: f32 = 1.0 / 16.0;
        /// How far off the plane a neighbour counts, in pixels of the small image.
        const OFF: f32 = 0.5;
        let view = &self.view;
        let (zero, one) = (F32::splat(simd, 0.0), F32::splat(simd, 1.0));
        let (sizes, stride) = ([view.width, view.height], view.stride());
        // The first of two pixels, held next to the image, and the weight of the second.
        let axis = inlined(
            #[inline(always)]
            |axis: usize| {
                let at = position[axis] * view.scale[axis] - 0.5;
                let held = lesser(greater(at, zero - 1.0), F32::splat(simd, sizes[axis] as f32 - 0.5));
                let first = held.floor();
                (first, held - first)
            },
        );
        let ((column, across), (row, down)) = (axis(0), axis(1));
        let normal = points.facing;
        let plane = dot(normal, points.position);
        let width = view.spread(-points.position[2]) * view.widest();
        let inverse = F32::splat(simd, 1.0 / OFF) / width;
        let first = indices([column, row], stride);
        let (mut sum, mut open) = (zero, zero);
        for (below, row_weight) in [(0, one - down), (1, down)] {
            let pairs = self.pairs(simd, first, below * stride);
            for (beside, column_weight) in [(0, one - across), (1, across)] {
                let [distance, fraction] = pairs[beside];
                let spread = view.spread(distance);
                let x = view.slopes(0, column + beside as f32) * spread;
                let y = view.slopes(1, row + below as f32) * spread;
                let off = dot(normal, [x, y, -distance]) - plane;
                let weight = row_weight * column_weight * positive(one - off.abs() * inverse);
                sum += weight;
                open += weight * fraction;
            }
        }
        let known = sum.simd_ge(LEAST);
        (known.select(open / sum, one), known)
    }

    /// Distance and fraction of eight pixels that lie so far behind the first ones, and of the next ones in their rows.
    #[inline(always)]
    fn pairs<S: Simd>(&self, simd: S, first: [usize; LANES], offset: usize) -> [[F32<S>; 2]; 2] {
        let mut values = [[[0.0; LANES]; 2]; 2];
        for (lane, first) in first.into_iter().enumerate() {
            let pair: &[[f32; 2]] = &self.pixels[first + offset..first + offset + 2];
            for (values, pixel) in values.iter_mut().zip(pair) {
                for (values, value) in values.iter_mut().zip(pixel) {
                    values[lane] = *value;
                }
            }
        }
        values.each(
            #[inline(always)]
            |pixel| {
                pixel.each(
                    #[inline(always)]
                    |values| F32::simd_from(simd, values),
                )
            },
        )
    }
}

/// The surfaces of a small image, value by value, with empty pixels around them.
struct Surfaces {
    view: SmallView,
    normals: [Vec<f32>; 3],
    distances: Vec<f32>,
    /// By the rays of the pixel alone.
    open: Vec<f32>,
}

impl Surfaces {
    fn new(&SmallImage { view, found, distances }: &SmallImage<'_>) -> Self {
        let empty = |value| vec![value; view.len()];
        let normals = [empty(0.0), empty(0.0), empty(0.0)];
        let mut surfaces = Self { view, normals, distances: empty(NOWHERE), open: empty(1.0) };
        let width = view.width as usize;
        for (row, (found, distances)) in found.chunks(width).zip(distances.chunks(width)).enumerate() {
            let start = (row + REACH) * view.stride() + REACH;
            for (column, (found, &distance)) in found.iter().zip(distances).enumerate() {
                if distance < NOWHERE && found.truncate() != Vec3::ZERO {
                    surfaces.distances[start + column] = distance;
                    surfaces.open[start + column] = found.w;
                    for (axis, normals) in surfaces.normals.iter_mut().enumerate() {
                        normals[start + column] = found[axis];
                    }
                }
            }
        }
        surfaces
    }

    /// The means of all pixels, or these without those that are too coarse.
    fn each_row(&self, means: Option<&[f32]>, rasterizer: &Rasterizer) -> Vec<f32> {
        let (view, token) = (&self.view, Token::best());
        let mut open = vec![1.0; view.len()];
        let rows = open.chunks_mut(view.stride()).enumerate().skip(REACH).take(view.height as usize);
        rasterizer.share(rows, |(row, open)| at_level!(token, simd => self.row(simd, row, means, open)));
        open
    }

    #[inline(always)]
    fn row<S: Simd>(&self, simd: S, row: usize, means: Option<&[f32]>, open: &mut [f32]) {
        let start = row * self.view.stride();
        let columns = REACH..REACH + self.view.width as usize;
        for column in columns.step_by(LANES) {
            let distances = eight(simd, &self.distances, start + column);
            if distances.simd_lt(NOWHERE).any_true() {
                let found = match means {
                    None => self.mean_of_eight(simd, [column, row], distances),
                    Some(means) => self.fine_of_eight(simd, [column, row], distances, means),
                };
                found.store_slice(&mut open[column..column + LANES]);
            }
        }
    }

    /// The means of eight pixels with their neighbours on the same surface.
    #[inline(always)]
    fn mean_of_eight<S: Simd>(&self, simd: S, [column, row]: [usize; 2], distance: F32<S>) -> F32<S> {
        let (view, zero, one) = (&self.view, F32::splat(simd, 0.0), F32::splat(simd, 1.0));
        let index = row * view.stride() + column;
        let normal = self.normals.each_ref().each(
            #[inline(always)]
            |values| eight(simd, values, index),
        );
        let plane = dot(normal, view.positions([column, row], distance));
        let inverse = one / (view.spread(distance) * view.widest());
        let (mut sum, mut open) = (zero, zero);
        for (down, down_weight) in MEAN.iter().enumerate() {
            let row = row + down - REACH;
            let start = row * view.stride() + column - REACH;
            let (distances, fractions) = (part(&self.distances, start), part(&self.open, start));
            let normals = self.normals.each_ref().each(
                #[inline(always)]
                |values| part(values, start),
            );
            for (across, across_weight) in MEAN.iter().enumerate() {
                let distance = eight(simd, distances, across);
                let off = dot(normal, view.positions([column + across - REACH, row], distance)) - plane;
                let other = normals.each(
                    #[inline(always)]
                    |values| eight(simd, values, across),
                );
                let near = positive(one - off.abs() * inverse) * positive(dot(normal, other) * 2.0 - 1.0);
                let weight = near * (down_weight * across_weight);
                sum += weight;
                open += weight * eight(simd, fractions, across);
            }
        }
        sum.simd_gt(0.0).select(open / sum, one)
    }
}

impl Surfaces {
    /// The means of eight pixels, or [`NARROW`] where those of their neighbours on the same surface differ by too much.
    #[inline(always)]
    fn fine_of_eight<S: Simd>(
        &self,
        simd: S,
        [column, row]: [usize; 2],
        distance: F32<S>,
        means: &[f32],
    ) -> F32<S> {
        /// The most that means four pixels apart differ by. An edge of no width makes that 0.6 and more.
        const STEEPEST: f32 = 0.35;
        /// The most that a mean is off the middle of those, twice. It finds the ends of penumbras, and thin shadows.
        const MOST_BENT: f32 = 0.08;
        let view = &self.view;
        let index = row * view.stride() + column;
        let (zero, own) = (F32::splat(simd, 0.0), eight(simd, means, index));
        let normal = self.normals.each_ref().each(
            #[inline(always)]
            |values| eight(simd, values, index),
        );
        let plane = dot(normal, view.positions([column, row], distance));
        let width = view.spread(distance) * view.widest();
        let at = inlined(
            #[inline(always)]
            |[column, row]: [usize; 2]| {
                let index = row * view.stride() + column;
                let position = view.positions([column, row], eight(simd, &self.distances, index));
                let is_near = (dot(normal, position) - plane).abs().simd_lt(width);
                is_near.select(eight(simd, means, index), own)
            },
        );
        let ends = [
            [at([column - REACH, row]), at([column + REACH, row])],
            [at([column, row - REACH]), at([column, row + REACH])],
        ];
        let mut is_narrow = zero.simd_gt(zero);
        for [before, after] in ends {
            let bend = before + after - own * 2.0;
            is_narrow |= (after - before).abs().simd_gt(STEEPEST) | bend.abs().simd_gt(MOST_BENT);
        }
        is_narrow.select(zero + NARROW, own)
    }
}

/// Where pixels are in a list of rows with empty pixels around them. Columns and rows are whole numbers from −1 on; in
/// integers, because large images have more pixels than f32 has whole numbers.
#[inline(always)]
fn indices<S: Simd>([column, row]: [F32<S>; 2], stride: usize) -> [usize; LANES] {
    let [columns, rows] = [column, row].each(
        #[inline(always)]
        |number| (number + REACH as f32).to_int::<I32<S>>(),
    );
    let numbers: [i32; LANES] = (rows * stride as i32 + columns).into();
    numbers.each(
        #[inline(always)]
        |number| number as usize,
    )
}

/// The values of eight pixels in a row, and of those around them that count in their means.
#[inline(always)]
fn part(values: &[f32], start: usize) -> &[f32; LANES + 2 * REACH] {
    values[start..].first_chunk().expect("empty pixels lie around the image")
}

/// Eight values in a row.
#[inline(always)]
fn eight<S: Simd>(simd: S, values: &[f32], first: usize) -> F32<S> {
    F32::from_slice(simd, &values[first..first + LANES])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::baseline::baseline;
    use proptest::prelude::*;

    fn projection() -> impl Strategy<Value = Projection> {
        let window = [-2.0_f64..0.5, 0.6..2.0, -1.0..-0.1, 0.0..1.5];
        prop_oneof![
            (0.2_f64..2.8).prop_map(|angle| Projection::perspective(angle, 0.1, None)),
            (0.1_f64..50.0).prop_map(|height| Projection::orthographic(height, -1.0, 20.0)),
            window.prop_map(|[left, right, low, high]| {
                Projection::frustum(left, right, low, high, 1.0, Some(9.0))
            }),
        ]
        .prop_map(|projection| projection.expect("the numbers are in range"))
    }

    proptest! {
        /// Rounded to f32, pixels of large images had the values of others.
        #[test]
        fn pixels_of_large_images_are_found(column in -1_i16..8192, row in -1_i16..8192, width in 8192_u16..9000) {
            let pixel = [column, row].map(|number| F32::splat(baseline(), f32::from(number)));
            let [column, row] = [column, row].map(|number| (i32::from(number) + REACH as i32) as usize);
            let expected = row * usize::from(width) + column;
            prop_assert_eq!(indices(pixel, usize::from(width)), [expected; LANES]);
        }

        /// By the projection matrix.
        #[test]
        fn pixels_lie_where_the_projection_puts_them(
            projection in projection(), size in [1_u32..300, 1_u32..300], share in [0.0_f64..1.0, 0.0..1.0],
            distance in 0.5_f32..9.0,
        ) {
            let matrix = projection.matrix(f64::from(size[0]) / f64::from(size[1]));
            let view = SmallView::new(&projection, &matrix, size);
            let small = [view.width, view.height].map(f64::from);
            let pixel = [share[0] * small[0], share[1] * small[1]].map(f64::floor);
            let counted = pixel.map(|number| number as usize + REACH);
            let point = view.positions(counted, F32::splat(baseline(), distance)).map(|axis| axis[0]);
            let clip = matrix.project_point3(Vec3::from_array(point).as_dvec3());
            let found = [(1.0 + clip.x) / 2.0 * small[0], (1.0 - clip.y) / 2.0 * small[1]];
            for axis in 0..2 {
                let middle = pixel[axis] + 0.5;
                // Some roundings of f32 in a hundred pixels.
                prop_assert!((found[axis] - middle).abs() < 1e-3, "{found:?}, not {middle} on axis {axis}");
            }
            prop_assert_eq!(point[2], -distance);
        }
    }
}
