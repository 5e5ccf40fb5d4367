//! The pipelines of edges, loose lines and points, and of faces that only hide what is behind them.

use std::sync::Arc;

use trigon_math::{UVec2, Vec3, Vec4};
use trigon_raster::simd::{Each, F32, LANES, Simd, lanes_of, prelude::*};
use trigon_raster::{Fragment, FragmentLanes, LanePipeline, MarkColors, Pipeline, VertexLanes, VertexOutput};

use crate::geometry::Columns;
use crate::placement::Placement;
use crate::prepare::Backdrop;

/// Vertices of a mesh in one colour, unlit.
pub(super) struct Wire<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) place: Placement,
    /// Linear RGB.
    pub(super) color: Vec3,
    /// Lines or points in other colours.
    pub(super) marks: WireMarks,
}

/// The marks of a draw's lines or points.
#[derive(Default)]
pub(super) struct WireMarks {
    /// By the index of the line or point; without a mark beyond the end.
    pub(super) numbers: Arc<Vec<u8>>,
    /// By their numbers.
    pub(super) colors: [Vec4; MarkColors::COUNT],
}

impl WireMarks {
    fn of(&self, index: u32) -> usize {
        self.numbers.get(index as usize).map_or(0, |&number| usize::from(number))
    }
}

impl Pipeline for Wire<'_> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        let place = self.positions[index] - self.place.anchor;
        VertexOutput { position: self.place.to_clip * place.extend(1.0), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let color = match self.marks.of(fragment.triangle) {
            0 => self.color,
            mark => self.marks.colors[mark].truncate(),
        };
        color.extend(1.0)
    }
}

/// Faces painted in the background's colour. With the edges that the pass paints on them, they make a
/// hidden-line image.
pub(super) struct HiddenLine<'a> {
    pub(super) columns: &'a Columns,
    pub(super) place: Placement,
    pub(super) backdrop: &'a Backdrop,
}

impl LanePipeline for HiddenLine<'_> {
    const VARYINGS: usize = 0;

    fn vertex_count(&self) -> usize {
        self.columns.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let [x, y, z] = &self.columns.positions;
        let position = [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)];
        self.place.clip(simd, position)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [columns, rows]: [[f32; LANES]; 2] = fragments.position().each(
            #[inline(always)]
            |axis| axis.into(),
        );
        let papers =
            lanes_of(|lane| self.backdrop.at(UVec2::new(columns[lane] as u32, rows[lane] as u32)).to_array());
        [0, 1, 2, 3].each(
            #[inline(always)]
            |channel| {
                let values = papers.each(
                    #[inline(always)]
                    |paper| paper[channel],
                );
                F32::simd_from(simd, values)
            },
        )
    }
}
