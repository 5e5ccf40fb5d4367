//! Memory that shading holds from tile to tile, the context for shading a draw, and which pixels of a tile are shaded, if
//! not all are ([`PixelsToShade`]).
//!
//! A pixel may look different than in the last frame if the triangle that it shows may, or if it shows another one. Edges
//! of faces reach into pixels around them. So where a triangle has come, gone or moved, pixels within reach of a line are
//! shaded, too.

use super::visible::Edges;
use crate::bin::TriangleRef;
use crate::fragments::{Columns, DrawVaryings, FragmentList, Group, RecordShape, Records, ShadeContext};
use crate::ink::VisibleFaces;
use crate::outer_ink::OuterInk;
use crate::tile_buffer::{
    GROUP_COUNT, MAX_SIDE, PIXELS, TileArea, TileLanes, TileRows, lanes_of, rows_of_either,
};
use crate::view::FrameView;
use std::ops::Range;

/// What is visible of one draw.
pub(super) struct DrawRun {
    pub(super) draw: usize,
    /// The records of its triangles.
    pub(super) slots: Range<usize>,
    pub(super) groups: Range<usize>,
    pub(super) fragments: Range<usize>,
    pub(super) parts: Range<usize>,
    /// Its records, if they are there already.
    pub(super) records: Option<RecordShape>,
}

/// A group with pixels whose first samples show the background.
#[derive(Clone, Copy)]
pub(crate) struct EmptyGroup {
    pub(crate) number: u32,
    /// Those pixels.
    pub(crate) lanes: u32,
}

/// What shading keeps from tile to tile, so that nothing allocates once it is
/// warm.
pub(crate) struct Shading {
    /// For each of the tile's triangles its number among the visible ones.
    pub(super) slots: Vec<u32>,
    /// The visible triangles among the tile's, in their order.
    pub(super) visible_triangles: Vec<u32>,
    /// Groups of pixels that see one draw.
    pub(super) groups: Vec<Group>,
    /// Pixels that see one triangle, in other groups.
    pub(super) fragments: FragmentList,
    /// Fragments that cover a part of their pixel.
    pub(super) parts: FragmentList,
    pub(super) runs: Vec<DrawRun>,
    pub(crate) records: Records,
    pub(super) columns: [Columns; 2],
    /// A fragment and one colour for each visible triangle of a flat draw, in linear
    /// light and as bytes.
    pub(super) flat: FragmentList,
    pub(super) flat_codes: Vec<u32>,
    pub(super) flat_colors: Vec<[f32; 4]>,
    /// Pixels as bytes.
    pub(crate) codes: Vec<u32>,
    /// Pixels in linear light; edge pixels with the colour of their first samples; then the background; then
    /// the other samples of edge pixels.
    pub(crate) colors: Vec<[f32; 4]>,
    /// Groups with pixels that see the background.
    pub(crate) empty_groups: Vec<EmptyGroup>,
    /// Pixels whose samples see different triangles.
    pub(crate) edges: Edges,
    /// What edges cover beyond their faces.
    pub(crate) outer: OuterInk,
    /// How many triangles got edges.
    pub(crate) edged: u64,
}

impl Shading {
    /// Starts a tile with this many triangles, and samples per pixel.
    pub(super) fn clear(&mut self, triangle_count: usize, samples: usize) {
        self.slots.clear();
        // One more, for samples without a triangle.
        self.slots.resize(triangle_count + 1, 0);
        self.groups.clear();
        self.fragments.clear();
        self.parts.clear();
        self.empty_groups.clear();
        self.edges.clear(samples);
    }

    pub(crate) fn new() -> Self {
        Self {
            slots: Vec::new(),
            visible_triangles: Vec::new(),
            groups: Vec::new(),
            fragments: FragmentList::default(),
            parts: FragmentList::default(),
            runs: Vec::new(),
            records: Records::default(),
            columns: [Columns::new(), Columns::new()],
            flat: FragmentList::default(),
            flat_codes: Vec::new(),
            flat_colors: Vec::new(),
            codes: vec![0; PIXELS],
            colors: vec![[0.0; 4]; PIXELS + 1],
            empty_groups: Vec::new(),
            edges: Edges::new(),
            outer: OuterInk::default(),
            edged: 0,
        }
    }
}

impl<'f> FrameView<'f> {
    /// The context for shading one of the frame's draws in a tile, without edges of other faces.
    pub(super) fn shade_context<'c>(
        &'c self,
        area: &TileArea,
        triangles: &'c [TriangleRef],
        draw: usize,
    ) -> ShadeContext<'c> {
        let (plan, pipeline) = (&self.plan.draws[draw], self.pipeline(draw));
        let stride = pipeline.stride();
        let values = &self.varyings[plan.varyings..plan.varyings + plan.used.len() * stride];
        ShadeContext {
            draw: self.draw_view(draw),
            varyings: DrawVaryings { slots: self.plan.slots(plan), values, stride },
            varying_count: pipeline.varyings(),
            is_flat: pipeline.is_flat(),
            reads_all: pipeline.reads_all(),
            frame_ink: self.ink.as_ref(),
            pattern: self.grid.pattern,
            supersampling: self.supersampling,
            area: *area,
            triangles,
            outer: None,
        }
    }
}

/// Which pixels of a tile are shaded.
pub(crate) struct PixelsToShade {
    pub(crate) lanes: TileLanes,
    pub(crate) rows: TileRows,
    /// Those, and pixels within reach of them.
    pub(crate) near: TileRows,
    /// Those, and pixels within reach of them that show moving triangles.
    pub(crate) visible: TileLanes,
}

/// What is known of a tile of which not all pixels are shaded.
#[derive(Clone, Copy)]
pub(crate) struct PartialTile<'p> {
    pub(crate) pixels: &'p PixelsToShade,
    /// The still triangles, as the search for outer halves of lines needs them.
    pub(crate) still: &'p VisibleFaces,
    /// Their indices in the tile's list.
    pub(crate) indices: &'p [u32],
}

impl PixelsToShade {
    pub(crate) fn new() -> Self {
        Self { lanes: [0; GROUP_COUNT], rows: [0; MAX_SIDE], near: [0; MAX_SIDE], visible: [0; GROUP_COUNT] }
    }

    /// Asks for those of a tile's own `columns` and `rows` that show a still triangle which may look different, or
    /// that lie within `reach` of pixels which show moving triangles now or did in the last frame.
    pub(crate) fn set(
        &mut self,
        look: &TileRows,
        now: &TileLanes,
        before: &TileLanes,
        [columns, rows]: [Range<usize>; 2],
        reach: usize,
    ) {
        let moved = spread(&rows_of_either(now, before), reach);
        let own = (u64::MAX >> (MAX_SIDE - columns.len())) << columns.start;
        self.rows = [0; MAX_SIDE];
        for y in rows {
            self.rows[y] = (look[y] | moved[y]) & own;
        }
        self.lanes = lanes_of(&self.rows);
        self.near = spread(&self.rows, reach);
        self.visible = lanes_of(&self.near);
        let lanes = self.lanes.iter().zip(now);
        self.visible
            .iter_mut()
            .zip(lanes)
            .for_each(|(visible, (lanes, now))| *visible = lanes | *visible & now);
    }

    /// Whether any pixel is shaded.
    pub(crate) fn any(&self) -> bool {
        self.rows.iter().any(|&row| row != 0)
    }
}

/// Those at most `reach` columns and rows away.
fn spread(rows: &TileRows, reach: usize) -> TileRows {
    if reach == 0 {
        return *rows;
    }
    let mut wide = *rows;
    for (wide, row) in wide.iter_mut().zip(rows).filter(|(_, row)| **row != 0) {
        for way in 1..=reach {
            *wide |= row << way | row >> way;
        }
    }
    let mut spread = wide;
    for (y, row) in wide.iter().enumerate().filter(|(_, row)| **row != 0) {
        for near in &mut spread[y.saturating_sub(reach)..(y + reach + 1).min(MAX_SIDE)] {
            *near |= row;
        }
    }
    spread
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simd::LANES;
    use crate::tile_buffer::rows_of;
    use crate::tile_buffer::{PIXELS, TileArea};
    use proptest::prelude::*;

    fn pixels() -> impl Strategy<Value = Vec<[usize; 2]>> {
        prop::collection::vec([0..MAX_SIDE, 0..MAX_SIDE], 0..6)
    }

    fn lanes(pixels: &[[usize; 2]]) -> TileLanes {
        let mut lanes = [0; GROUP_COUNT];
        for index in pixels.iter().map(|&pixel| TileArea::index_of(pixel)) {
            lanes[index / LANES] |= 1 << (index % LANES);
        }
        lanes
    }

    proptest! {
        /// Pixel by pixel.
        #[test]
        fn pixels_that_look_different_and_those_around_moved_ones_are_asked(
            look in pixels(), now in pixels(), before in pixels(),
            own in [0..20_usize, 0..20_usize], sides in [1..44_usize, 1..44_usize], reach in 0..17_usize,
        ) {
            let [columns, rows] = [0, 1].map(|axis| own[axis]..own[axis] + sides[axis]);
            let mut found = PixelsToShade::new();
            found.set(&rows_of(&lanes(&look)), &lanes(&now), &lanes(&before), [columns.clone(), rows.clone()], reach);
            let is_near = |[a, b]: [usize; 2], [x, y]: [usize; 2]| a.abs_diff(x) <= reach && b.abs_diff(y) <= reach;
            let is_expected = |pixel: [usize; 2]| {
                let is_moved = now.iter().chain(&before).any(|&moved| is_near(moved, pixel));
                columns.contains(&pixel[0]) && rows.contains(&pixel[1]) && (look.contains(&pixel) || is_moved)
            };
            let all = || (0..PIXELS).map(TileArea::pixel_at);
            let expected: Vec<_> = all().filter(|&pixel| is_expected(pixel)).collect();
            let is_visible = |at: &[usize; 2]| {
                expected.contains(at) || now.contains(at) && expected.iter().any(|&pixel| is_near(pixel, *at))
            };
            let visible_pixels: Vec<_> = all().filter(is_visible).collect();
            prop_assert_eq!(found.any(), !expected.is_empty());
            prop_assert!(found.lanes == lanes(&expected));
            prop_assert!(found.visible == lanes(&visible_pixels));
            for [x, y] in all() {
                prop_assert_eq!(found.rows[y] >> x & 1 != 0, expected.contains(&[x, y]));
            }
        }
    }
}
