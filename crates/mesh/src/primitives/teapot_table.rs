//! The numbers of the Utah teapot, as Martin Newell published them.
//!
//! M. Newell, "The Utilization of Procedure Models in Digital Image
//! Synthesis", PhD thesis, University of Utah, 1975: 28 bicubic Bézier patches.
//! The four patches of the bottom are those that F. C. Crow added in
//! "Displays on Display: The Origins of the Teapot", IEEE Computer Graphics
//! and Applications 7(1), 1987. The table goes round the world as 32 patches
//! over 306 control points, 4 of which no patch uses and 12 of which repeat
//! others. All of them follow from the numbers below: body and lid are four
//! quarter turns each, handle and spout are two mirrored halves each.
//!
//! Published axes: z up, the spout towards +x.

/// A row of control points round the axis: the first one of a quarter turn is
/// (radius, 0), the next (radius, pull), then (pull, radius) and (0, radius),
/// at this height. A radius of 0 is a single point.
pub(super) struct Round {
    pub(super) radius: f64,
    pub(super) pull: f64,
    pub(super) height: f64,
}

/// A row of control points across the handle or the spout: a loop from `from`
/// (x, z) over both sides, `width` from the middle, to `to` and back.
pub(super) struct Across {
    pub(super) from: [f64; 2],
    pub(super) to: [f64; 2],
    pub(super) width: f64,
}

const fn round(radius: f64, pull: f64, height: f64) -> Round {
    Round { radius, pull, height }
}

const fn across(from: [f64; 2], to: [f64; 2], width: f64) -> Across {
    Across { from, to, width }
}

/// From the inner edge of the rim over the belly to the middle of the bottom:
/// each patch has four rows and shares the last with the next one.
pub(super) const BODY: [Round; 13] = [
    round(1.4, 0.784, 2.4),
    round(1.3375, 0.749, 2.53125),
    round(1.4375, 0.805, 2.53125),
    round(1.5, 0.84, 2.4),
    round(1.75, 0.98, 1.875),
    round(2.0, 1.12, 1.35),
    round(2.0, 1.12, 0.9),
    round(2.0, 1.12, 0.45),
    round(1.5, 0.84, 0.225),
    round(1.5, 0.84, 0.15),
    round(1.5, 0.84, 0.075),
    round(1.425, 0.798, 0.0),
    round(0.0, 0.0, 0.0),
];

/// From the tip of the knob to the edge of the lid.
pub(super) const LID: [Round; 7] = [
    round(0.0, 0.0, 3.15),
    round(0.8, 0.45, 3.15),
    round(0.0, 0.0, 2.85),
    round(0.2, 0.112, 2.7),
    round(0.4, 0.224, 2.55),
    round(1.3, 0.728, 2.55),
    round(1.3, 0.728, 2.4),
];

/// From its upper end on the belly backwards and down to the lower one.
pub(super) const HANDLE: [Across; 7] = [
    across([-1.6, 2.025], [-1.5, 2.25], 0.3),
    across([-2.3, 2.025], [-2.5, 2.25], 0.3),
    across([-2.7, 2.025], [-3.0, 2.25], 0.3),
    across([-2.7, 1.8], [-3.0, 1.8], 0.3),
    across([-2.7, 1.575], [-3.0, 1.35], 0.3),
    across([-2.5, 1.125], [-2.65, 0.9375], 0.3),
    across([-2.0, 0.9], [-1.9, 0.6], 0.3),
];

/// From the belly outwards, over the lip and into the mouth.
pub(super) const SPOUT: [Across; 7] = [
    across([1.7, 1.425], [1.7, 0.6], 0.66),
    across([2.6, 1.425], [3.1, 0.825], 0.66),
    across([2.3, 2.1], [2.4, 2.025], 0.25),
    across([2.7, 2.4], [3.3, 2.4], 0.25),
    across([2.8, 2.475], [3.525, 2.49375], 0.25),
    across([2.9, 2.475], [3.45, 2.5125], 0.15),
    across([2.8, 2.4], [3.2, 2.4], 0.15),
];
