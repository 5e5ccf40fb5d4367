//! The mean of samples.

use trigon_math::Vec4;

/// The mean of `count` colours. Equal ones are not rounded, so that a pixel
/// that shows only the background is the same in a tile that shows more.
#[inline]
pub(crate) fn mean(colors: impl Iterator<Item = Vec4> + Clone, count: usize) -> Vec4 {
    let mut rest = colors.clone();
    let first = rest.next().unwrap_or(Vec4::ZERO);
    let (mut sum, mut equal) = (first, true);
    for color in rest {
        sum += color;
        equal &= color == first;
    }
    let share = 1.0 / count as f32;
    if equal {
        first
    } else if sum.is_finite() {
        sum * share
    } else {
        saturated(colors.map(|color| color * share).sum())
    }
}

/// The largest number in place of infinity: what sums of finite colours can
/// reach. An infinity would be no number as soon as it met a factor of 0.
#[inline]
pub(crate) fn saturated(color: Vec4) -> Vec4 {
    if color.is_finite() {
        return color;
    }
    Vec4::from_array(color.to_array().map(|v| {
        if v.is_finite() {
            v
        } else if v > 0.0 {
            f32::MAX
        } else {
            f32::MIN
        }
    }))
}
