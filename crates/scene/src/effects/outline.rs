//! Outlines around nodes, drawn over the finished image from its node ids.

use crate::work::{Work, note};
use trigon_math::color;

use crate::effect_settings::Outline;

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
