//! The pipelines of edges, loose lines and points, and of faces that only hide what is behind them.

use std::sync::Arc;

use trigon_math::{UVec2, Vec3, Vec4};
use trigon_raster::simd::{F32, InlineMap, LANES, Simd, lanes_of, prelude::*};
use trigon_raster::{Fragment, FragmentLanes, LanePipeline, MarkColors, Pipeline, VertexLanes, VertexOutput};

use crate::geometry::Columns;
use crate::material::{AlphaMode, Material};
use crate::placement::Placement;
use crate::prepare::Backdrop;

/// Lines in one colour, or points, unlit.
pub(super) struct Wire<'a> {
    pub(super) positions: &'a [Vec3],
    pub(super) placement: Placement,
    pub(super) paint: WirePaint,
    /// The colours of points, if they differ.
    pub(super) colors: Option<PointColors<'a>>,
    /// Lines or points in other colours.
    pub(super) marks: WireMarks,
}

/// Lines whose vertices have colours, unlit.
pub(super) struct ColoredLines<'a> {
    pub(super) wire: Wire<'a>,
    /// Of the mesh's vertices.
    pub(super) colors: &'a [Vec4],
}

/// The colours of a mesh's vertices, and which of them a draw shows as points.
#[derive(Clone, Copy)]
pub(super) struct PointColors<'a> {
    pub(super) of_vertices: &'a [Vec4],
    pub(super) points: &'a [u32],
}

/// What a material makes of lines and points: glTF 2.0, section 3.7.2.1, defines those without normals as base colour
/// times colour of the vertex plus emission.
#[derive(Clone, Copy)]
pub(super) struct WirePaint {
    base_color: Vec4,
    emissive: Vec3,
    alpha_mode: AlphaMode,
}

impl WirePaint {
    pub(super) fn of(material: &Material) -> Self {
        let Material { base_color, emissive, alpha_mode, .. } = *material;
        Self { base_color, emissive, alpha_mode }
    }

    /// Opaque, in linear RGB.
    pub(super) fn of_color(color: Vec3) -> Self {
        Self { base_color: color.extend(1.0), emissive: Vec3::ZERO, alpha_mode: AlphaMode::Opaque }
    }

    /// The same for outputs that see through nothing but what is transparent altogether.
    pub(super) fn masked(self) -> Self {
        Self { alpha_mode: AlphaMode::Mask { cutoff: f32::MIN_POSITIVE }, ..self }
    }

    pub(super) fn alpha_mode(&self) -> AlphaMode {
        self.alpha_mode
    }

    /// What a vertex of some colour shows, premultiplied.
    fn shown(&self, vertex: Vec4) -> Vec4 {
        let color = self.base_color * vertex;
        let light = color.truncate() + self.emissive;
        match self.alpha_mode {
            AlphaMode::Opaque | AlphaMode::Mask { .. } => light.extend(1.0),
            AlphaMode::Blend => {
                let alpha = color.w.clamp(0.0, 1.0);
                (light * alpha).extend(alpha)
            }
        }
    }

    fn is_drawn(&self, vertex: Vec4) -> bool {
        match self.alpha_mode {
            AlphaMode::Opaque | AlphaMode::Blend => true,
            AlphaMode::Mask { cutoff } => self.base_color.w * vertex.w >= cutoff,
        }
    }
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
    /// The colour of a marked line or point.
    fn color(&self, index: u32) -> Option<Vec4> {
        let number = self.numbers.get(index as usize).copied().filter(|&number| number != 0)?;
        Some(self.colors[usize::from(number)].truncate().extend(1.0))
    }
}

impl Wire<'_> {
    /// The colour of a line or point before its material's.
    fn vertex_color(&self, index: u32) -> Vec4 {
        let of = |colors: PointColors<'_>| colors.of_vertices[colors.points[index as usize] as usize];
        self.colors.map_or(Vec4::ONE, of)
    }

    fn clip_position(&self, vertex: usize) -> Vec4 {
        let position = self.positions[vertex] - self.placement.anchor;
        self.placement.to_clip * position.extend(1.0)
    }
}

impl Pipeline for Wire<'_> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.clip_position(index), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let own = || self.paint.shown(self.vertex_color(fragment.triangle));
        self.marks.color(fragment.triangle).unwrap_or_else(own)
    }

    fn mask(&self, fragment: &Fragment<()>) -> bool {
        self.paint.is_drawn(self.vertex_color(fragment.triangle))
    }
}

impl Pipeline for ColoredLines<'_> {
    /// The colour of the vertex.
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.wire.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        VertexOutput { position: self.wire.clip_position(index), varyings: self.colors[index] }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let own = || self.wire.paint.shown(fragment.varyings);
        self.wire.marks.color(fragment.triangle).unwrap_or_else(own)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        self.wire.paint.is_drawn(fragment.varyings)
    }
}

/// A pipeline of lines or points.
pub(super) trait AnyWire<'a>: Pipeline {
    fn wire(&self) -> &Wire<'a>;
}

impl<'a> AnyWire<'a> for Wire<'a> {
    fn wire(&self) -> &Self {
        self
    }
}

impl<'a> AnyWire<'a> for ColoredLines<'a> {
    fn wire(&self) -> &Wire<'a> {
        &self.wire
    }
}

/// Faces painted in the background's colour. With the edges that the pass paints on them, they make a
/// hidden-line image.
pub(super) struct HiddenLine<'a> {
    pub(super) columns: &'a Columns,
    pub(super) placement: Placement,
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
        self.placement.clip(simd, position)
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
