//! The means of pixels whose samples see different triangles.

use super::mean;
use crate::frame::FrameView;
use crate::pass::Background;
use crate::shade::{EdgeGroup, Encoding, Shading};
use crate::simd::{Each, F32, LANES, Mask, Simd, at_level, channels, lanes_of, prelude::*};
use crate::tile::{NOBODY, TileArea};
use trigon_math::Vec4;

/// Gives the pixels their bytes.
pub(super) fn average_codes(
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    encoding: Encoding,
) {
    at_level!(frame.token, simd => for_each_group(simd, frame, area, shading, #[inline(always)] |shading, edges, means| {
        let codes: [u32; LANES] = encoding.encode_lanes(simd, means).into();
        for lane in edges.lanes() {
            shading.codes[edges.number as usize * LANES + lane] = codes[lane];
        }
    }));
}

/// Gives the pixels their colours in linear light.
pub(super) fn average_colors(frame: &FrameView<'_>, area: &TileArea, shading: &mut Shading) {
    at_level!(frame.token, simd => for_each_group(simd, frame, area, shading, #[inline(always)] |shading, edges, means| {
        let means: [[f32; LANES]; 4] = means.each(Into::into);
        for lane in edges.lanes() {
            shading.colors[edges.number as usize * LANES + lane] = means.map(|channel| channel[lane]);
        }
    }));
}

/// Visits the groups that have such pixels, with their means.
#[inline(always)]
fn for_each_group<S: Simd>(
    simd: S,
    frame: &FrameView<'_>,
    area: &TileArea,
    shading: &mut Shading,
    mut visit: impl FnMut(&mut Shading, EdgeGroup, [F32<S>; 4]),
) {
    let samples = frame.grid.pattern.count();
    let mut behind = [frame.background_at(area, [0, 0]).to_array(); LANES];
    for group in 0..shading.edge_groups.len() {
        let edges = shading.edge_groups[group];
        if matches!(frame.background, Background::PerPixel(_)) {
            for lane in edges.lanes() {
                let pixel = TileArea::pixel_at(edges.number as usize * LANES + lane);
                behind[lane] = frame.background_at(area, pixel).to_array();
            }
        }
        let colors =
            Colors { names: edges.names(shading, samples), colors: &shading.colors, behind: &behind };
        let means = colors.means(simd, edges);
        visit(shading, edges, means);
    }
}

/// The colours of a group's samples.
struct Colors<'c> {
    /// Sample by sample.
    names: &'c [[u32; LANES]],
    colors: &'c [[f32; 4]],
    /// What nobody is seen before.
    behind: &'c [[f32; 4]; LANES],
}

impl Colors<'_> {
    /// As [`mean`] has it.
    #[inline(always)]
    fn means<S: Simd>(&self, simd: S, edges: EdgeGroup) -> [F32<S>; 4] {
        let first = self.sample(simd, &self.names[0]);
        let (mut sum, mut equal) = (first, Mask::splat(simd, true));
        for names in &self.names[1..] {
            let color = self.sample(simd, names);
            for channel in 0..4 {
                sum[channel] += color[channel];
                equal &= color[channel].simd_eq(first[channel]);
            }
        }
        // Infinity and NaN times zero are no numbers.
        let [r, g, b, a] = sum.each(
            #[inline(always)]
            |channel| channel * 0.0,
        );
        if (r + g + b + a).simd_eq(F32::splat(simd, 0.0)).all_true() {
            let share = 1.0 / self.names.len() as f32;
            return [0, 1, 2, 3].each(
                #[inline(always)]
                |channel| equal.select(first[channel], sum[channel] * share),
            );
        }
        self.large_means(edges).each(
            #[inline(always)]
            |channel| F32::simd_from(simd, channel),
        )
    }

    /// One by one, where sums overflow.
    #[cold]
    fn large_means(&self, edges: EdgeGroup) -> [[f32; LANES]; 4] {
        let mut means = [[0.0; LANES]; 4];
        for lane in edges.lanes() {
            let colors = self.names.iter().map(|names| Vec4::from_array(*self.of(names, lane)));
            let mean = mean(colors, self.names.len()).to_array();
            for (channel, value) in means.iter_mut().zip(mean) {
                channel[lane] = value;
            }
        }
        means
    }

    #[inline(always)]
    fn of(&self, names: &[u32; LANES], lane: usize) -> &[f32; 4] {
        // Nobody is no index.
        const { assert!(NOBODY == u32::MAX, "beyond all colours") };
        self.colors.get(names[lane] as usize).unwrap_or(&self.behind[lane])
    }

    /// One sample of the pixels, channel by channel.
    #[inline(always)]
    fn sample<S: Simd>(&self, simd: S, names: &[u32; LANES]) -> [F32<S>; 4] {
        let colors = lanes_of(
            #[inline(always)]
            |lane| self.of(names, lane),
        );
        channels(simd, colors)
    }
}
