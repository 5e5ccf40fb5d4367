//! The farthest remaining layers of each sample, in memory of a fixed size.
//!
//! A sample that has more layers than fit keeps the farthest ones. These are blended, and the next round collects
//! layers in front of the last one. Layers are therefore blended from back to front however many fit at a time,
//! and the result does not depend on that number.
//!
//! When a sample's room is full, its layers are sorted and the nearer half is dropped. From then on the first half
//! is the sorted set of the farthest, and any layer in front of its last is dropped at once. The other half of the
//! room collects candidates until it is full again. So each layer takes a constant amount of work on average.

use std::cmp::Ordering;

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
