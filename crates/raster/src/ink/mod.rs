//! Edges of faces, painted from what is visible: no line is drawn for them.
//!
//! A pixel shows an edge in one of two ways.
//! - **Own ink**: the edges of the triangle that is visible in the pixel. Shading already knows the distances to
//!   these edges, and paints the line over the triangle's colour.
//! - **Outer ink**: the edges of triangles that are visible in other pixels close by. These give the half of a line
//!   that lies beyond its face: outside a silhouette, around a corner, beyond a diagonal.
//!   [`outer_ink`](crate::outer_ink) computes it before a tile is shaded. To know what is visible around a tile,
//!   each tile also determines visibility in a margin of [`Ink::reach`] pixels, which its neighbours draw.
//!
//! Both have the coverage of an anti-aliased line ([`crate::line`]): at a distance of d from a line of width w,
//! `min(w, 1, w/2 + 1/2 - d)` of a pixel. A pixel shows the larger of the two.

mod face_lines;
#[cfg(test)]
mod tests;

pub(crate) use face_lines::{EdgePoint, FaceLine, LARGE, LineColumns, OutlinedHalves, VisibleFaces};

use crate::draw::{MarkColors, Overlap};
use crate::simd::{F32, InlineMap, LANES, Mask, Simd, U32, prelude::*};
use trigon_math::{Vec3, Vec4};

/// How a pass paints the edges of faces: see [`Pass::edges`](crate::Pass::edges).
///
/// # Widths
/// A line has the requested width where faces have room for it, and takes no more than a fraction of a small
/// face, so that a dense mesh keeps the colour of its surface. Let r be the inner radius of a face in pixels
/// of the target: twice its area over its perimeter, on the screen. The half of a line that lies on the face
/// is no wider than
///
/// `min(width / 2, r / 3, r² / 4.5)`
///
/// pixels: a third of the radius, and from r = 1.5 pixels on less and less, so that edges fade away with the
/// distance. A pixel cannot resolve the edges of a face that is smaller than itself. From r = 1.5 pixels down
/// to 0.5 (of the finer grid, with supersampling) distances to single edges no longer count. The share of the
/// face that its lines cover takes their place: `1 - ((r - h) / r)²` for lines of half width h.
///
/// The width of a line beyond its own face follows from that face's r, and fades out from r = 2 pixels of the
/// finer grid to 1. On a face that shares a corner with it, the width follows from the smaller r of the two.
/// An edge whose mark is [outlined](MarkColors::outlined) is as wide as two lines, with an outline of one line on each
/// side, which is the first to go: on a face, half of all that and half of the coloured part obey the same limits.
/// Beyond the ends of such an edge its line is no wider than others, so that nothing sticks out where it ends.
///
/// Triangles tell the radius of their polygon by the edges that are flagged, and by
/// [`EdgeFlags::with_radius_ratio`](crate::EdgeFlags::with_radius_ratio). A triangle that is cut by the near
/// plane or far outside of the view counts as large.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FaceEdges {
    /// Pixels of the target, 0 (no edges) to [`MAX_WIDTH`](Self::MAX_WIDTH); with
    /// supersampling to 31 pixels of the finer grid, if that is less. More counts as that.
    pub width: f32,
    /// Linear RGB.
    pub color: Vec3,
    /// From 0, no edges, to 1.
    pub opacity: f32,
}

impl FaceEdges {
    /// The greatest width in pixels.
    pub const MAX_WIDTH: f32 = 16.0;
}

/// The greatest width in pixels of the finer grid: its reach leaves half of a tile's side.
const MAX_INNER_WIDTH: f32 = 31.0;

/// The width of an outlined edge with its outline, and of its coloured core, in widths of other edges.
const OUTLINED: f32 = 4.0;
const CORE: f32 = 2.0;

/// [`FaceEdges`] on the finer grid, in its pixels, and [`MarkColors`].
#[derive(Clone, Debug)]
pub(crate) struct Ink {
    /// 0 if no edges are painted, only faces.
    half_width: f32,
    /// The same of outlined edges, and of their cores; 0 if there are none.
    outlined_half: f32,
    core_half: f32,
    /// A bit for each mark.
    outlined: u32,
    /// Pixels of the finer grid for one of the target.
    scale: f32,
    /// Of edges by their marks, premultiplied by the opacity.
    colors: [[f32; 4]; MarkColors::COUNT],
    /// Of faces, likewise.
    tints: [[f32; 4]; MarkColors::COUNT],
    has_marks: bool,
}

impl Ink {
    /// `None` if there is nothing to be painted.
    pub(crate) fn new(
        edges: Option<&FaceEdges>,
        marks: Option<&MarkColors>,
        samples_per_axis: u32,
    ) -> Option<Self> {
        let scale = samples_per_axis as f32;
        let width = edges.map_or(0.0, |edges| edges.width);
        let mut colors = marks.map_or([[0.0; 4]; MarkColors::COUNT], |marks| marks.edges.map(premultiplied));
        colors[0] = edges.map_or([0.0; 4], |edges| premultiplied(edges.color.extend(edges.opacity)));
        let tints = marks.map_or([[0.0; 4]; MarkColors::COUNT], |marks| marks.faces.map(premultiplied));
        let is_visible = |colors: &[[f32; 4]]| colors.iter().any(|color| color[3] > 0.0);
        // Not where the width is no number, either.
        let has_lines = width > 0.0 && is_visible(&colors);
        let width = (width.min(FaceEdges::MAX_WIDTH) * scale).min(MAX_INNER_WIDTH);
        let half_width = if has_lines { width * 0.5 } else { 0.0 };
        let is_painted = has_lines || is_visible(&tints[1..]);
        let outlined = marks.filter(|_| has_lines).map_or(0, |marks| bits(&marks.outlined));
        let half_of =
            |factor: f32| if outlined == 0 { 0.0 } else { (width * factor).min(MAX_INNER_WIDTH) * 0.5 };
        let (outlined_half, core_half) = (half_of(OUTLINED), half_of(CORE));
        let has_marks = marks.is_some();
        is_painted.then_some(Self {
            half_width,
            outlined_half,
            core_half,
            outlined,
            scale,
            colors,
            tints,
            has_marks,
        })
    }

    /// Whether some edges have outlines.
    #[inline(always)]
    pub(crate) fn has_outlines(&self) -> bool {
        self.outlined != 0
    }

    /// Whether the edges with a mark have outlines.
    pub(crate) fn is_outlined(&self, mark: u8) -> bool {
        self.outlined >> mark & 1 != 0
    }

    /// The same of lanes.
    #[inline(always)]
    pub(crate) fn outlined_lanes<S: Simd>(&self, marks: U32<S>) -> Mask<S> {
        let simd = marks.token();
        let marks: [u32; LANES] = marks.into();
        let bits = marks.each(
            #[inline(always)]
            |mark| self.outlined >> (mark % MarkColors::COUNT as u32) & 1,
        );
        U32::simd_from(simd, bits).simd_gt(U32::splat(simd, 0))
    }

    /// Whether edges are painted.
    pub(crate) fn has_lines(&self) -> bool {
        self.half_width > 0.0
    }

    /// Whether some edges or faces have other colours than the rest.
    #[inline(always)]
    pub(crate) fn has_marks(&self) -> bool {
        self.has_marks
    }

    /// How far from an edge it may cover a part of a pixel, in whole pixels.
    pub(crate) fn reach(&self) -> u32 {
        let half = if self.has_outlines() { self.outlined_half } else { self.half_width };
        if self.has_lines() { (half + 0.5).ceil() as u32 } else { 0 }
    }

    /// Laid over a colour with a share of 0 to 1.
    #[inline(always)]
    pub(crate) fn over(&self, color: Vec4, Overlap { share, core, mark }: Overlap) -> Vec4 {
        let (color, ink) = (color.to_array(), self.colors[usize::from(mark)]);
        let rest = 1.0 - ink[3] * share;
        // An outline is black: nothing but opacity.
        Vec4::from_array([(0, core), (1, core), (2, core), (3, share)].each(
            #[inline(always)]
            |(channel, share)| color[channel] * rest + ink[channel] * share,
        ))
    }

    /// [`over`](Self::over), for lanes without marks.
    #[inline(always)]
    pub(crate) fn over_lanes<S: Simd>(&self, color: [F32<S>; 4], share: F32<S>) -> [F32<S>; 4] {
        let ink = self.colors[0];
        let rest = 1.0 - share * ink[3];
        [0, 1, 2, 3].each(
            #[inline(always)]
            |channel| color[channel] * rest + share * ink[channel],
        )
    }

    /// [`over`](Self::over), for lanes with marks.
    #[inline(always)]
    pub(crate) fn over_marked<S: Simd>(
        &self,
        color: [F32<S>; 4],
        share: F32<S>,
        marks: U32<S>,
    ) -> [F32<S>; 4] {
        let ink = channels(&self.colors, marks);
        let rest = 1.0 - share * ink[3];
        [0, 1, 2, 3].each(
            #[inline(always)]
            |channel| color[channel] * rest + share * ink[channel],
        )
    }

    /// [`over`](Self::over), for lanes of which some have outlines.
    #[inline(always)]
    pub(crate) fn over_outlined<S: Simd>(
        &self,
        color: [F32<S>; 4],
        [shares, cores]: [F32<S>; 2],
        marks: U32<S>,
    ) -> [F32<S>; 4] {
        let ink = channels(&self.colors, marks);
        let rest = 1.0 - shares * ink[3];
        let [r, g, b] = [0, 1, 2].each(
            #[inline(always)]
            |channel| color[channel] * rest + cores * ink[channel],
        );
        [r, g, b, color[3] * rest + shares * ink[3]]
    }

    /// The colours of faces with these marks. Their alpha stays.
    #[inline(always)]
    pub(crate) fn tinted<S: Simd>(&self, color: [F32<S>; 4], marks: U32<S>) -> [F32<S>; 4] {
        let tint = channels(&self.tints, marks);
        let rest = 1.0 - tint[3];
        let [r, g, b] = [0, 1, 2].each(
            #[inline(always)]
            |channel| color[channel] * rest + color[3] * tint[channel],
        );
        [r, g, b, color[3]]
    }
}

/// A bit for each that is set but the first.
fn bits(flags: &[bool; MarkColors::COUNT]) -> u32 {
    (1..MarkColors::COUNT).fold(0, |bits, mark| bits | u32::from(flags[mark]) << mark)
}

/// Linear RGB and opacity, held to 0 to 1, multiplied; nothing of what is not finite.
fn premultiplied(color: Vec4) -> [f32; 4] {
    if !color.is_finite() || color.w <= 0.0 {
        return [0.0; 4];
    }
    (color.truncate().extend(1.0) * color.w.min(1.0)).to_array()
}

/// The colours of lanes, channel by channel.
#[inline(always)]
fn channels<S: Simd>(colors: &[[f32; 4]; MarkColors::COUNT], marks: U32<S>) -> [F32<S>; 4] {
    let simd = marks.token();
    let marks: [u32; LANES] = marks.into();
    [0, 1, 2, 3].each(
        #[inline(always)]
        |channel| {
            let values = marks.each(
                #[inline(always)]
                |mark| colors[mark as usize % MarkColors::COUNT][channel],
            );
            F32::simd_from(simd, values)
        },
    )
}

#[cfg(test)]
mod limits {
    use super::*;

    #[test]
    fn what_cannot_be_seen_is_no_ink() {
        let plain = FaceEdges { width: 1.0, color: Vec3::ZERO, opacity: 1.0 };
        assert!(Ink::new(Some(&plain), None, 1).is_some(), "black lines");
        let nothing = [
            FaceEdges { width: 0.0, ..plain },
            FaceEdges { width: f32::NAN, ..plain },
            FaceEdges { opacity: 0.0, ..plain },
            FaceEdges { opacity: f32::NAN, ..plain },
            FaceEdges { color: Vec3::splat(f32::INFINITY), ..plain },
        ];
        for edges in nothing {
            assert!(Ink::new(Some(&edges), None, 1).is_none(), "{edges:?}");
        }
    }

    #[test]
    fn no_line_reaches_farther_than_a_tile_can_see() {
        for samples_per_axis in 1..=4 {
            let wide = FaceEdges { width: f32::INFINITY, color: Vec3::ZERO, opacity: 2.0 };
            let ink = Ink::new(Some(&wide), None, samples_per_axis).unwrap();
            assert!(ink.reach() <= 16, "{} with {samples_per_axis} per axis", ink.reach());
            let outlined = MarkColors { outlined: [true; MarkColors::COUNT], ..MarkColors::NONE };
            let outlined = Ink::new(Some(&wide), Some(&outlined), samples_per_axis).unwrap();
            assert!(outlined.reach() <= 16, "{} with outlines", outlined.reach());
            assert_eq!(ink.over(Vec4::ONE, Overlap::plain(1.0, 0)), Vec4::W, "no more than opaque");
        }
    }
}
