//! What happens to a finished image: exposure and tone mapping, from the image's linear light to display values, after all
//! samples are averaged; and outlines around nodes, from the image's node ids.
//!
//! A background colour is a colour of the display, so it stays as it is behind the mapped image. An environment is light,
//! and part of the image that is mapped.

use trigon_math::{Vec3, Vec4, color};
use trigon_raster::Rasterizer;

use crate::effect_settings::{Outline, ToneMapping};
use crate::settings::RenderSettings;
use crate::work::{Work, note};

/// Converts an image in linear light, premultiplied, without background, to sRGB bytes on its
/// background.
pub(crate) fn map_tones(
    linear: &[Vec4],
    settings: &RenderSettings,
    pixels: &mut [[u8; 4]],
    rasterizer: &Rasterizer,
) {
    note(Work::ToneMapping);
    let RenderSettings { width, height, background, effects, .. } = settings;
    let (width, factor) = (*width as usize, effects.exposure_factor());
    let rows = pixels.chunks_mut(width).zip(linear.chunks(width)).enumerate();
    rasterizer.share(rows, |(y, (row, linear))| {
        let behind = background.row(y as u32, *height);
        for (pixel, &light) in row.iter_mut().zip(linear) {
            *pixel = encoded(mapped(light, factor, effects.tone_mapping), behind);
        }
    });
}

/// Converts an image in linear light, premultiplied and on its background, to sRGB bytes.
pub(crate) fn encode(linear: &[Vec4], pixels: &mut [[u8; 4]]) {
    for (pixel, &light) in pixels.iter_mut().zip(linear) {
        *pixel = encoded(light, Vec4::ZERO);
    }
}

/// Composites an image in linear light over its background.
pub(crate) fn lay_on_background(linear: &mut [Vec4], settings: &RenderSettings) {
    let RenderSettings { width, height, background, .. } = settings;
    for (y, row) in linear.chunks_mut(*width as usize).enumerate() {
        let behind = background.row(y as u32, *height);
        for light in row {
            *light += behind * (1.0 - light.w);
        }
    }
}

/// The colour is mapped as it is where it is opaque.
fn mapped(light: Vec4, factor: f32, tone: ToneMapping) -> Vec4 {
    if light.w <= 0.0 {
        return Vec4::ZERO;
    }
    let color = light.truncate() * (factor / light.w);
    let color = match tone {
        ToneMapping::None => color,
        ToneMapping::KhronosPbrNeutral => khronos_pbr_neutral(color),
    };
    (color * light.w).extend(light.w)
}

/// Khronos PBR Neutral, by the formula of its specification (Khronos Group,
/// "Khronos PBR Neutral Tone Mapper", 2024). Negative colours count as 0.
fn khronos_pbr_neutral(color: Vec3) -> Vec3 {
    const START_COMPRESSION: f32 = 0.8 - 0.04;
    const DESATURATION: f32 = 0.15;
    let color = Vec3::select(color.cmpgt(Vec3::ZERO), color, Vec3::ZERO);
    let [least, most] = [color.min_element(), color.max_element()];
    let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
    let (color, peak) = (color - offset, most - offset);
    if peak < START_COMPRESSION {
        return color;
    }
    let d = 1.0 - START_COMPRESSION;
    let new_peak = 1.0 - d * d / (peak + d - START_COMPRESSION);
    let color = color * (new_peak / peak);
    let share = 1.0 - 1.0 / (DESATURATION * (peak - new_peak) + 1.0);
    color.lerp(Vec3::splat(new_peak), share)
}

/// sRGB and straight alpha of a premultiplied colour over another one.
fn encoded(color: Vec4, behind: Vec4) -> [u8; 4] {
    let over = color + behind * (1.0 - color.w);
    if over.w <= 0.0 {
        return [0; 4];
    }
    let straight = over.truncate() / over.w;
    let [r, g, b] = straight.to_array().map(color::linear_to_srgb8);
    [r, g, b, (over.w.clamp(0.0, 1.0) * 255.0 + 0.5) as u8]
}

/// The widest line in pixels.
const WIDEST: u32 = 16;

/// Paints the line over sRGB bytes: on pixels that show none of the nodes and lie within its width
/// of one that does, fading out over the last pixel. `objects` are the node ids.
pub(crate) fn draw_outline(outline: &Outline, objects: &[u32], width: usize, pixels: &mut [[u8; 4]]) {
    note(Work::Outline);
    let mut chosen: Vec<u32> = outline.nodes.iter().map(|node| node.index() as u32).collect();
    chosen.sort_unstable();
    let inside = |index: usize| chosen.binary_search(&objects[index]).is_ok();
    let height = objects.len() / width;
    let reach = outline.width.clamp(1, WIDEST) as usize;
    let mut cover = vec![0.0_f32; objects.len()];
    for (y, x) in (0..height).flat_map(|y| (0..width).map(move |x| (y, x))) {
        let index = y * width + x;
        if !inside(index) || is_within(inside, [x, y], [width, height]) {
            continue;
        }
        for row in y.saturating_sub(reach)..=(y + reach).min(height - 1) {
            for column in x.saturating_sub(reach)..=(x + reach).min(width - 1) {
                let (dx, dy) = (column as f32 - x as f32, row as f32 - y as f32);
                let share = (reach as f32 + 0.5 - (dx * dx + dy * dy).sqrt()).clamp(0.0, 1.0);
                let cover = &mut cover[row * width + column];
                if share > *cover {
                    *cover = share;
                }
            }
        }
    }
    for (index, share) in cover.into_iter().enumerate() {
        if share > 0.0 && !inside(index) {
            pixels[index] = over(outline, share, pixels[index]);
        }
    }
}

/// Whether all four neighbours are also inside.
fn is_within(inside: impl Fn(usize) -> bool, [x, y]: [usize; 2], [width, height]: [usize; 2]) -> bool {
    let index = y * width + x;
    x > 0
        && x + 1 < width
        && y > 0
        && y + 1 < height
        && [index - 1, index + 1, index - width, index + width].into_iter().all(inside)
}

fn over(outline: &Outline, share: f32, [r, g, b, a]: [u8; 4]) -> [u8; 4] {
    let below = f32::from(a) / 255.0 * (1.0 - share);
    let alpha = share + below;
    let mixed = |channel: usize, byte: u8| {
        let light = outline.color[channel] * share + color::srgb8_to_linear(byte) * below;
        color::linear_to_srgb8(light / alpha)
    };
    [mixed(0, r), mixed(1, g), mixed(2, b), (alpha * 255.0 + 0.5) as u8]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::settings::Background;

    #[test]
    fn colours_below_the_knee_lose_only_the_reflection_of_the_surface() {
        // A base colour of 0.5 in white light reflects 4 % more at its surface, which the mapping
        // removes.
        let mapped = khronos_pbr_neutral(Vec3::splat(0.54));
        assert!((mapped - Vec3::splat(0.5)).abs().max_element() < 1e-6, "{mapped}");
        assert_eq!(khronos_pbr_neutral(Vec3::ZERO), Vec3::ZERO, "black stays black");
    }

    #[test]
    fn bright_light_stays_below_white_in_order() {
        let mut last = 0.0;
        for step in 1..200_u8 {
            let mapped = khronos_pbr_neutral(Vec3::splat(f32::from(step) * 0.2));
            assert!(mapped.x > last && mapped.x < 1.0, "{mapped} after {last}");
            last = mapped.x;
        }
        let red = khronos_pbr_neutral(Vec3::new(50.0, 1.0, 1.0));
        assert!(red.y > 0.5, "what is far too bright loses its tint: {red}");
    }

    #[test]
    fn the_background_is_not_mapped() {
        let mut settings = RenderSettings::new(2, 1);
        settings.effects.exposure = crate::Exposure::Stops(3.0);
        settings.background = Background::Color(Vec3::splat(0.2));
        let mut pixels = [[0; 4]; 2];
        let linear = [Vec4::ZERO, Vec4::new(0.05, 0.0, 0.0, 1.0)];
        map_tones(&linear, &settings, &mut pixels, &Rasterizer::default());
        let grey = color::linear_to_srgb8(0.2);
        let red = color::linear_to_srgb8(0.4);
        assert_eq!(
            pixels,
            [[grey, grey, grey, 255], [red, 0, 0, 255]],
            "as chosen, and eight times as bright"
        );
    }

    #[test]
    fn light_is_laid_over_what_is_behind_it() {
        let half = Vec4::new(0.25, 0.125, 0.0, 0.5);
        let behind = Vec4::new(0.5, 0.5, 0.5, 1.0);
        let expected = [0.5, 0.375, 0.25].map(color::linear_to_srgb8);
        assert_eq!(encoded(half, behind), [expected[0], expected[1], expected[2], 255], "half shows through");
        let straight = [0.5, 0.25, 0.0].map(color::linear_to_srgb8);
        assert_eq!(encoded(half, Vec4::ZERO), [straight[0], straight[1], straight[2], 128], "straight alpha");
        assert_eq!(encoded(Vec4::ZERO, Vec4::ZERO), [0; 4], "nothing over nothing");
        let mut linear = [half, Vec4::ZERO];
        let mut settings = RenderSettings::new(1, 2);
        settings.background = Background::Gradient { top: Vec3::ZERO, bottom: Vec3::ONE };
        lay_on_background(&mut linear, &settings);
        assert_eq!(linear[0], half + Vec4::new(0.25, 0.25, 0.25, 1.0) * 0.5, "a quarter of the way down");
        assert_eq!(linear[1], Vec4::new(0.75, 0.75, 0.75, 1.0));
    }

    #[test]
    fn translucent_light_is_mapped_as_if_it_were_opaque() {
        let opaque = Vec4::new(0.6, 0.3, 2.0, 1.0);
        for tone in [ToneMapping::None, ToneMapping::KhronosPbrNeutral] {
            let right = mapped(opaque, 2.0, tone);
            for alpha in [0.25, 0.5] {
                let found = mapped(opaque * alpha, 2.0, tone);
                assert!((found - right * alpha).abs().max_element() < 1e-6, "{found} of {right}");
            }
            assert_eq!(mapped(Vec4::new(0.3, 0.3, 0.3, 0.0), 2.0, tone), Vec4::ZERO, "nothing is there");
        }
        assert_eq!(mapped(opaque, 2.0, ToneMapping::None), Vec4::new(1.2, 0.6, 4.0, 1.0));
    }

    /// By the formula of the specification, in f64.
    #[test]
    fn neutral_tones_follow_the_specification() {
        let by_hand = |color: [f64; 3]| {
            let [least, most] =
                [color.iter().copied().fold(9e9, f64::min), color.iter().copied().fold(0.0, f64::max)];
            let offset = if least < 0.08 { least - 6.25 * least * least } else { 0.04 };
            let (color, peak) = (color.map(|channel| channel - offset), most - offset);
            if peak < 0.76 {
                return color;
            }
            let bright = 1.0 - 0.24 * 0.24 / (peak + 0.24 - 0.76);
            let share = 1.0 - 1.0 / (0.15 * (peak - bright) + 1.0);
            color.map(|channel| channel * bright / peak * (1.0 - share) + bright * share)
        };
        let levels = [0.0, 0.03, 0.08, 0.5, 0.9, 3.0];
        for (r, g, b) in
            levels.into_iter().flat_map(|r| levels.into_iter().flat_map(move |g| levels.map(|b| (r, g, b))))
        {
            let found = khronos_pbr_neutral(Vec3::new(r as f32, g as f32, b as f32));
            for (found, expected) in found.to_array().into_iter().zip(by_hand([r, g, b])) {
                assert!(
                    (f64::from(found) - expected).abs() < 1e-5,
                    "{found}, not {expected}, of {r} {g} {b}"
                );
            }
        }
        assert_eq!(
            khronos_pbr_neutral(Vec3::new(-1.0, 0.2, 0.3)),
            khronos_pbr_neutral(Vec3::new(0.0, 0.2, 0.3))
        );
    }

    #[test]
    fn pixels_within_have_four_neighbours_inside() {
        // The last row and the last column are outside.
        let size = [5, 4];
        let inside = |index: usize| index % 5 < 4 && index / 5 < 3;
        for (x, y) in (0..4).flat_map(|y| (0..5).map(move |x| (x, y))) {
            let expected = (1..3).contains(&x) && y == 1;
            assert_eq!(is_within(inside, [x, y], size), expected, "{x}, {y}");
            let [all, none] = [true, false].map(|answer| is_within(|_| answer, [x, y], size));
            assert_eq!(all, (1..4).contains(&x) && (1..3).contains(&y), "{x}, {y}: borders have fewer");
            assert!(!none, "{x}, {y}");
        }
    }
}
