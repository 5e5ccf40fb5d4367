//! Copies colours of pixels to their samples, where a translucent fragment is blended over single samples.

use crate::resolve::mean;
use crate::shade::{BEHIND, Shading};
use crate::simd::LANES;
use crate::tile_buffer::{NO_TRIANGLE, TileArea, VisibilityBuffer};
use crate::view::FrameView;
use trigon_math::Vec4;

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
