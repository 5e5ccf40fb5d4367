//! The farthest remaining layers of each sample, in memory of a fixed size.
//!
//! A sample that has more layers than fit keeps the farthest ones. These are blended, and the next round collects
//! layers in front of the last one. Layers are therefore blended from back to front however many fit at a time,
//! and the result does not depend on that number.
//!
//! When the memory of a sample is full, its layers are sorted and the nearer half is dropped. From then on the first half
//! is the sorted set of the farthest, and any layer in front of its last is dropped at once. The other half of the
//! memory collects candidates until it is full again. So each layer takes a constant amount of work on average.
//!
//! [`DepthOrder`] is the order in which layers are blended. [`Fragments`] are what shading needs of some layers: one
//! fragment for each triangle and pixel, sorted by triangle. Where translucent fragments are blended over single
//! samples, the colours of pixels are first copied to their samples.

use crate::fragments::{Job, ShadePoint};
use crate::resolve::mean;
use crate::shade::{BEHIND, Shading};
use crate::simd::LANES;
use crate::tile::TileView;
use crate::tile_buffer::{NO_TRIANGLE, TileArea, VisibilityBuffer};
use crate::view::FrameView;
use std::cmp::Ordering;
use trigon_math::Vec4;

/// Layers that all samples together have room for: three quarters of a megabyte
/// with what is held beside each, and eight for every sample of the largest tile.
pub(super) const CAPACITY: usize = 1 << 15;

/// One translucent fragment at one sample.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Layer {
    pub(super) depth: f32,
    /// Index among the tile's triangles.
    pub(super) triangle: u32,
    /// The fraction of the sample that it covers, 0 to 1.
    pub(super) coverage: f32,
    /// Which colour it has, once that is known.
    pub(super) color: u32,
}

/// An order of layers, from back to front.
pub(super) trait Order: Copy {
    /// Less if `a` lies behind `b`. Only a layer and itself are equal.
    fn compare(&self, a: &Layer, b: &Layer) -> Ordering;

    /// Whether `a` lies behind `b`.
    #[inline(always)]
    fn is_behind(&self, a: &Layer, b: &Layer) -> bool {
        self.compare(a, b).is_lt()
    }
}

/// The layers that are held at one sample.
#[derive(Clone, Copy, Default)]
struct SampleRun {
    len: u32,
    /// How many layers found no room. If any did, the first half of the room
    /// holds the farthest of all, in order, and all that is held lies behind the
    /// last of those.
    waiting: u32,
}

/// The layers of some samples.
#[derive(Default)]
pub(super) struct Runs {
    layers: Vec<Layer>,
    runs: Vec<SampleRun>,
    /// How many layers each sample has room for, at least 2.
    capacity: usize,
}

impl Runs {
    /// Empties all, and shares `total` layers out among `samples`.
    pub(super) fn reset(&mut self, samples: usize, total: usize) {
        self.capacity = (total / samples).max(2);
        self.runs.clear();
        self.runs.resize(samples, SampleRun::default());
        let needed = self.capacity * samples;
        if self.layers.len() < needed {
            self.layers.resize(needed, Layer::default());
        }
    }

    /// Keeps a layer if it is among the farthest of its sample.
    #[inline(always)]
    pub(super) fn push(&mut self, order: impl Order, sample: usize, layer: Layer) {
        let SampleRun { len, waiting } = self.runs[sample];
        if waiting == 0 && (len as usize) < self.capacity {
            self.layers[sample * self.capacity + len as usize] = layer;
            self.runs[sample].len += 1;
        } else {
            self.push_to_full(order, sample, layer);
        }
    }

    #[inline(never)]
    fn push_to_full(&mut self, order: impl Order, sample: usize, layer: Layer) {
        let half = self.capacity / 2;
        let run = &mut self.runs[sample];
        let layers = &mut self.layers[sample * self.capacity..(sample + 1) * self.capacity];
        if run.waiting > 0 && !order.is_behind(&layer, &layers[half - 1]) {
            run.waiting += 1;
            return;
        }
        if run.len as usize == self.capacity {
            layers.sort_unstable_by(|a, b| order.compare(a, b));
            run.waiting += (self.capacity - half) as u32;
            run.len = half as u32;
            if !order.is_behind(&layer, &layers[half - 1]) {
                run.waiting += 1;
                return;
            }
        }
        layers[run.len as usize] = layer;
        run.len += 1;
    }

    /// The layers of a sample from back to front.
    #[inline(always)]
    pub(super) fn sorted(&mut self, order: impl Order, sample: usize) -> &mut [Layer] {
        let start = sample * self.capacity;
        let layers = &mut self.layers[start..start + self.runs[sample].len as usize];
        if !layers.is_sorted_by(|a, b| order.is_behind(a, b)) {
            layers.sort_unstable_by(|a, b| order.compare(a, b));
        }
        layers
    }

    /// The layers of a sample as they are.
    #[inline(always)]
    pub(super) fn of(&self, sample: usize) -> &[Layer] {
        let start = sample * self.capacity;
        &self.layers[start..start + self.runs[sample].len as usize]
    }

    /// How many layers of a sample found no room.
    #[inline(always)]
    pub(super) fn waiting(&self, sample: usize) -> usize {
        self.runs[sample].waiting as usize
    }
}

/// The order of layers: a total key.
#[derive(Clone, Copy)]
pub(super) struct DepthOrder<'t>(pub(super) TileView<'t>);

impl Order for DepthOrder<'_> {
    #[inline(always)]
    fn compare(&self, a: &Layer, b: &Layer) -> Ordering {
        // Depths are numbers.
        match a.depth.partial_cmp(&b.depth) {
            Some(Ordering::Equal) | None => self.compare_keys(a, b),
            Some(order) => order,
        }
    }
}

impl DepthOrder<'_> {
    /// Of equal depths the smaller (object, face) is in front. Parts of one
    /// primitive, which may meet in a sample after snapping, go by their number.
    #[inline]
    fn compare_keys(&self, a: &Layer, b: &Layer) -> Ordering {
        let TileView { frame, triangles, ties, .. } = self.0;
        let part = |layer: &Layer| triangles[layer.triangle as usize].part();
        ties.compare(frame, triangles, [b.triangle, a.triangle]).then_with(|| part(b).cmp(&part(a)))
    }
}

/// Fragments that are to be shaded.
#[derive(Default)]
pub(super) struct Fragments {
    /// Triangle and pixel of each, in the order of the colours.
    listed: Vec<(u32, u32)>,
    /// For each triangle the last fragment that was listed.
    latest: Vec<u32>,
    /// For each triangle how many fragments it has; then where its next one goes.
    counts: Vec<u32>,
    pub(super) jobs: Vec<Job>,
    pub(super) points: Vec<ShadePoint>,
}

impl Fragments {
    /// Empties the list for a tile with this many triangles.
    pub(super) fn reset(&mut self, triangle_count: usize) {
        self.listed.clear();
        self.counts.clear();
        self.counts.resize(triangle_count, 0);
        if self.latest.len() < triangle_count {
            self.latest.resize(triangle_count, 0);
        }
    }

    /// Gives layers of a pixel's samples their colours' numbers; `first` is that of
    /// the pixel's first colour.
    #[inline(always)]
    pub(super) fn name(&mut self, pixel: usize, first: usize, layers: &mut [Layer]) {
        for layer in layers {
            let triangle = layer.triangle as usize;
            let latest = self.latest[triangle] as usize;
            // Another sample of the pixel may have named it already.
            let named = latest >= first && self.listed.get(latest).is_some_and(|at| at.0 == layer.triangle);
            layer.color = if named { latest as u32 } else { self.list(pixel, layer.triangle) };
        }
    }

    #[inline(always)]
    fn list(&mut self, pixel: usize, triangle: u32) -> u32 {
        let color = self.listed.len() as u32;
        self.listed.push((triangle, pixel as u32));
        self.latest[triangle as usize] = color;
        self.counts[triangle as usize] += 1;
        color
    }

    /// How many are listed.
    pub(super) fn len(&self) -> usize {
        self.listed.len()
    }

    /// Sorts them by triangle, by counting.
    pub(super) fn sort(&mut self, partly: bool) {
        self.jobs.clear();
        let mut start = 0;
        for (triangle, count) in self.counts.iter_mut().enumerate().filter(|(_, count)| **count > 0) {
            let end = start + *count as usize;
            self.jobs.push(Job { triangle: triangle as u32, points: start..end });
            *count = start as u32;
            start = end;
        }
        if self.points.len() < start {
            self.points.resize(start, ShadePoint::default());
        }
        for (color, &(triangle, pixel)) in self.listed.iter().enumerate() {
            let next = &mut self.counts[triangle as usize];
            self.points[*next as usize] = ShadePoint::anywhere(pixel as usize, partly, color);
            *next += 1;
        }
    }
}

/// Gives every sample the colour of its visible triangle.
pub(super) fn expand(
    frame: &FrameView<'_>,
    area: &TileArea,
    buffer: &VisibilityBuffer,
    shading: &Shading,
    samples: &mut Vec<Vec4>,
) {
    let count = buffer.samples;
    samples.clear();
    samples.resize(buffer.span() * count, Vec4::ZERO);
    for (pixel, color) in shading.colors.iter().enumerate().take(buffer.span()) {
        let position = TileArea::pixel_at(pixel);
        if !area.contains(position) {
            continue;
        }
        let background = || frame.lined_background_at(area, position, &shading.outer);
        for sample in 0..count {
            let index = buffer.index(pixel, sample);
            samples[index] = match buffer.visible[index] {
                NO_TRIANGLE => background(),
                _ => Vec4::from_array(*color),
            };
        }
    }
    for (group, names) in shading.edges.iter() {
        for (sample, names) in names.iter().enumerate() {
            for lane in group.lanes().filter(|&lane| names[lane] as usize != BEHIND) {
                let index = buffer.index(group.number as usize * LANES + lane, sample);
                samples[index] = Vec4::from_array(shading.colors[names[lane] as usize]);
            }
        }
    }
}

/// Gives every pixel the mean of its samples. All of the tile's pixels have a
/// colour then, and none is an edge pixel.
pub(super) fn collapse(
    frame: &FrameView<'_>,
    buffer: &VisibilityBuffer,
    shading: &mut Shading,
    samples: &[Vec4],
) {
    let Shading { colors, edges, .. } = shading;
    let count = frame.grid.pattern.count();
    edges.forget();
    for (pixel, color) in colors.iter_mut().enumerate().take(buffer.span()) {
        let first = buffer.index(pixel, 0);
        let of_pixel = (0..count).map(|sample| samples[first + sample * LANES]);
        *color = mean(of_pixel, count).to_array();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// By depth, then by index.
    #[derive(Clone, Copy)]
    struct ByDepth;

    impl Order for ByDepth {
        fn compare(&self, a: &Layer, b: &Layer) -> Ordering {
            a.depth.total_cmp(&b.depth).then(a.triangle.cmp(&b.triangle))
        }
    }

    /// What is laid, round by round, with room for so many layers at a time.
    fn peeled(layers: &[Layer], capacity: usize) -> Vec<u32> {
        let (mut runs, mut laid) = (Runs::default(), Vec::<Layer>::new());
        loop {
            runs.reset(2, 2 * capacity);
            let last = laid.last().copied();
            let is_left = |layer: &&Layer| last.is_none_or(|last| ByDepth.is_behind(&last, layer));
            let left = layers.iter().filter(is_left);
            left.for_each(|&layer| runs.push(ByDepth, 1, layer));
            laid.extend_from_slice(runs.sorted(ByDepth, 1));
            assert!(runs.of(0).is_empty(), "the other sample is left alone");
            if runs.waiting(1) == 0 {
                return laid.iter().map(|layer| layer.triangle).collect();
            }
        }
    }

    proptest! {
        #[test]
        fn layers_come_in_order_however_many_have_room(depths in proptest::collection::vec(0..50_u8, 0..200), capacity in 2..40_usize) {
            let layer = |(triangle, depth): (u32, &u8)| Layer { depth: f32::from(*depth), triangle, ..Layer::default() };
            let mut layers: Vec<_> = (0..).zip(&depths).map(layer).collect();
            let found = peeled(&layers, capacity);
            layers.sort_by(|a, b| ByDepth.compare(a, b));
            let expected: Vec<_> = layers.iter().map(|layer| layer.triangle).collect();
            prop_assert_eq!(found, expected);
        }
    }
}
