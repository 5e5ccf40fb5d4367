//! Depths as greys, for [`Display::Depth`](crate::Display::Depth).

use crate::frame::Frame;

/// Paints the depths of a frame into its colours.
pub(super) fn paint_depth(frame: &mut Frame) {
    let Some(depths) = &frame.depth else { return };
    frame.color = grey_depths(depths);
}

/// Near is dark; nothing is white. Greys are in proportion to the distance.
fn grey_depths(depths: &[f32]) -> Vec<u8> {
    /// The brightest grey, so that it differs from the background.
    const FAR: f32 = 235.0;
    let finite = || depths.iter().copied().filter(|depth| depth.is_finite());
    let nearest = finite().fold(f32::INFINITY, |least, depth| if depth < least { depth } else { least });
    let farthest = finite().fold(0.0, |most: f32, depth| if depth > most { depth } else { most });
    let range = if farthest > nearest { farthest - nearest } else { 1.0 };
    let grey = |&depth: &f32| {
        let grey = if depth.is_finite() { ((depth - nearest) / range * FAR) as u8 } else { 255 };
        [grey, grey, grey, 255]
    };
    depths.iter().flat_map(grey).collect()
}
