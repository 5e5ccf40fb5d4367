//! Colours of a heat map, in classes each twice as wide as the previous one: darker means less, and
//! the order is visible in the lightness alone.

/// A class of differences.
pub(crate) struct Class {
    /// The largest difference in it, in levels of 255.
    pub(crate) up_to: u8,
    /// sRGB: after the map "inferno" of S. van der Walt and N. Smith (matplotlib 2.0).
    pub(crate) color: [u8; 3],
    /// The legend's text.
    pub(crate) label: &'static str,
}

const fn class(up_to: u8, color: [u8; 3], label: &'static str) -> Class {
    Class { up_to, color, label }
}

/// From the smallest differences to the largest.
pub(crate) const CLASSES: [Class; 8] = [
    class(1, [87, 16, 110], "1"),
    class(2, [124, 29, 109], "2"),
    class(4, [163, 44, 97], "3-4"),
    class(8, [199, 62, 76], "5-8"),
    class(16, [229, 92, 48], "9-16"),
    class(32, [249, 142, 9], "17-32"),
    class(64, [249, 201, 50], "33-64"),
    class(255, [252, 255, 164], "65-255"),
];

/// Pixels without a difference are grey at this fraction of their brightness, for orientation.
const GREY: u32 = 5;

/// The opaque colour of a pixel with a difference in levels.
pub(super) fn color(levels: u8, right: [u8; 3]) -> [u8; 4] {
    let class = CLASSES.iter().find(|class| (1..=class.up_to).contains(&levels));
    let [r, g, b] = class.map_or_else(|| [grey(right); 3], |class| class.color);
    [r, g, b, 255]
}

fn grey(color: [u8; 3]) -> u8 {
    (color.into_iter().map(u32::from).sum::<u32>() / 3 / GREY) as u8
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_level_has_a_class_and_more_is_lighter() {
        let lightness = |[r, g, b]: [u8; 3]| 2 * u32::from(r) + 5 * u32::from(g) + u32::from(b);
        let white = color(0, [255; 3]);
        assert_eq!(white, [51, 51, 51, 255], "no difference shows what is there, dimmed");
        for levels in 1..=255 {
            let [r, g, b, a] = color(levels, [255; 3]);
            assert!(a == 255 && [r, g, b] != [51; 3], "{levels} levels are to be seen");
        }
        for pair in CLASSES.windows(2) {
            assert!(lightness(pair[0].color) < lightness(pair[1].color), "{} is darker", pair[0].label);
            assert!(pair[0].up_to < pair[1].up_to, "{} is less", pair[0].label);
        }
    }
}
