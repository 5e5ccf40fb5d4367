//! The difference between two images.

use trigon_math::color;
use trigon_raster::Cancel;
use trigon_scene::Frame;
use trigon_scene::quality::rmse;

use super::heat;

/// The difference between an image and the reference, over all pixels and the three colours, over
/// black as a window shows them.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Difference {
    /// As measured by [`rmse`].
    pub rmse: f64,
    /// The largest difference, in linear light with white being 1.
    pub worst: f64,
    /// The largest difference, in levels of the 8-bit image.
    pub worst_levels: u8,
    /// The fraction of pixels that differ at all.
    pub share: f64,
}

/// Two images, compared.
pub(crate) struct Compared {
    pub(crate) difference: Difference,
    /// Their size.
    pub(crate) map: Frame,
}

/// Compares two images of the same size; `None` if the sizes differ, or if cancelled.
pub(crate) fn compare(found: &Frame, right: &Frame, cancel: &Cancel) -> Option<Compared> {
    if [found.width, found.height] != [right.width, right.height] || found.color.len() != right.color.len() {
        return None;
    }
    let mut sums = Sums::default();
    let mut map = Vec::with_capacity(found.color.len());
    let row = 4 * found.width.max(1) as usize;
    for (found, right) in found.color.chunks(row).zip(right.color.chunks(row)) {
        if cancel.is_cancelled() {
            return None;
        }
        for (&found, &right) in found.as_chunks().0.iter().zip(right.as_chunks().0) {
            let (found, right) = (over_black(found), over_black(right));
            let levels = sums.add(found, right);
            map.extend(heat::color(levels, right));
        }
    }
    let map = Frame { width: found.width, height: found.height, color: map, ..Frame::default() };
    let difference = Difference { rmse: rmse(found, right), ..sums.difference() };
    Some(Compared { difference, map })
}

/// From straight alpha to the colour over black.
pub(crate) fn over_black([r, g, b, a]: [u8; 4]) -> [u8; 3] {
    // A product of two bytes, divided by 255 and rounded to the nearest.
    let dim = |channel: u8| ((u32::from(channel) * u32::from(a) + 127) / 255) as u8;
    if a == 255 { [r, g, b] } else { [dim(r), dim(g), dim(b)] }
}

#[derive(Default)]
struct Sums {
    pixels: u64,
    differing: u64,
    worst: f64,
    worst_levels: u8,
}

impl Sums {
    /// Adds a pixel; returns its largest difference in levels.
    fn add(&mut self, found: [u8; 3], right: [u8; 3]) -> u8 {
        self.pixels += 1;
        if found == right {
            return 0;
        }
        self.differing += 1;
        let mut most = 0;
        for (found, right) in found.into_iter().zip(right) {
            let light = |byte| f64::from(color::srgb8_to_linear(byte));
            let error = (light(found) - light(right)).abs();
            self.worst = if error > self.worst { error } else { self.worst };
            most = most.max(found.abs_diff(right));
        }
        self.worst_levels = self.worst_levels.max(most);
        most
    }

    fn difference(&self) -> Difference {
        let pixels = self.pixels.max(1) as f64;
        Difference {
            worst: self.worst,
            worst_levels: self.worst_levels,
            share: self.differing as f64 / pixels,
            ..Difference::default()
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(pixels: &[[u8; 4]]) -> Frame {
        Frame { width: pixels.len() as u32, height: 1, color: pixels.concat(), ..Frame::default() }
    }

    #[test]
    fn differences_are_summed_up_in_linear_light() {
        let found = frame(&[[0, 0, 0, 255], [7, 8, 9, 255], [255, 255, 255, 0]]);
        let right = frame(&[[255, 255, 255, 255], [7, 8, 9, 255], [0, 0, 0, 0]]);
        let compared = compare(&found, &right, &Cancel::default()).expect("of one size");
        let Difference { rmse, worst, worst_levels, share } = compared.difference;
        assert_eq!((worst, worst_levels), (1.0, 255), "black instead of white");
        assert_eq!(share, 1.0 / 3.0, "in one pixel of three; nobody sees what is transparent");
        assert_eq!(rmse, (1.0_f64 / 3.0).sqrt(), "all three colours of it");
        assert_eq!(compared.map.color.len(), right.color.len(), "a colour for each pixel");
        let same = compare(&right, &right, &Cancel::default()).expect("of one size");
        assert_eq!(same.difference, Difference::default(), "nothing differs from itself");
    }

    #[test]
    fn images_of_other_sizes_and_cancelled_ones_are_not_compared() {
        let (one, two) = (frame(&[[0; 4]]), frame(&[[0; 4]; 2]));
        assert!(compare(&one, &two, &Cancel::default()).is_none(), "another size");
        let cancel = Cancel::default();
        cancel.cancel();
        assert!(compare(&one, &one, &cancel).is_none(), "nobody waits for it");
    }
}
