//! Runs the engine on the same input as the other algorithms.

use std::num::NonZeroUsize;
use trigon_classic::Field;
use trigon_math::{DVec2, Vec2, Vec4};
use trigon_raster::simd::{F32, Simd, prelude::*};
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, Fragment, FragmentLanes, LanePipeline, Lines, Output, Pass,
    Pipeline, Rasterizer, Smoothing, Target, VertexLanes, VertexOutput,
};

/// The engine's rasterizer, kept from frame to frame.
pub struct Engine {
    pub(crate) rasterizer: Rasterizer,
}

impl Default for Engine {
    /// With one thread, as the algorithms that it is compared with.
    fn default() -> Self {
        Self::with_threads(NonZeroUsize::MIN)
    }
}

impl Engine {
    /// With a number of threads.
    #[must_use]
    pub fn with_threads(threads: NonZeroUsize) -> Self {
        let settings = ExecuteSettings { threads: Some(threads), ..Default::default() };
        Self { rasterizer: Rasterizer::new(settings).expect("no SIMD level was asked for") }
    }

    /// Draws triangles with separate corners into a target.
    pub(crate) fn draw(&mut self, shape: &Corners, target: &mut Target<'_>) {
        let mut pass = Pass::new();
        pass.triangles(shape.draw(BlendMode::Opaque));
        self.rasterizer.draw(&pass, target);
    }

    /// How many triangles cover each pixel.
    pub(crate) fn counts(&mut self, shape: &Corners, size: [usize; 2]) -> Field<u32> {
        let mut target = target(size, &[Output::Linear]);
        let mut pass = Pass::new();
        // No alpha: layers add up.
        pass.triangles(shape.draw(BlendMode::Translucent));
        self.rasterizer.draw(&pass, &mut target);
        field(size, target.linear()).map(|color| color.x as u32)
    }

    /// The triangle visible in each pixel, `u32::MAX` for none.
    pub(crate) fn visible(&mut self, shape: &Corners, size: [usize; 2]) -> Field<u32> {
        let mut target = target(size, &[Output::Triangle]);
        self.draw(shape, &mut target);
        field(size, target.triangles()).map(|&triangle| triangle)
    }

    /// Draws lines into a target; pairs of corners are their ends.
    pub(crate) fn draw_lines(&mut self, ends: &Corners, smoothing: Smoothing, target: &mut Target<'_>) {
        let segments: Vec<[u32; 2]> =
            (0..ends.positions.len() as u32 / 2).map(|i| [2 * i, 2 * i + 1]).collect();
        let mut pass = Pass::new();
        pass.lines(Lines { smoothing, ..Lines::new(ends, &segments) });
        self.rasterizer.draw(&pass, target);
    }

    /// Faces in red, with pixels within one pixel of an edge also in green.
    pub(crate) fn edges(&mut self, shape: &Corners, size: [usize; 2]) -> Field<Vec4> {
        let mut target = target(size, &[Output::Linear]);
        let edged = Edged(shape);
        let mut pass = Pass::new();
        pass.triangles(Draw { culling: Culling::None, ..Draw::new(&edged, &shape.triangles) });
        self.rasterizer.draw(&pass, &mut target);
        field(size, target.linear())
    }
}

/// A target for an image of the study, which is small.
pub(crate) fn target([width, height]: [usize; 2], outputs: &[Output]) -> Target<'static> {
    Target::new(width as u32, height as u32, outputs).expect("images of the study have a size in range")
}

/// One image of a target.
pub(crate) fn field<T: Copy>([width, height]: [usize; 2], pixels: Option<&[T]>) -> Field<T> {
    let pixels = pixels.expect("the image was asked for");
    Field::from_fn([width, height], |[x, y]| pixels[y * width + x])
}

/// A point in pixels from the top left, y down, at a depth from 0 to 1 (nearest) as the
/// engine takes it.
pub(crate) fn clip_position(point: DVec2, depth: f64, [width, height]: [usize; 2]) -> Vec4 {
    let (x, y) = (point.x / width as f64 * 2.0 - 1.0, 1.0 - point.y / height as f64 * 2.0);
    Vec4::new(x as f32, y as f32, depth as f32, 1.0)
}

/// Triangles of one colour, red without alpha, each with corners of its own.
pub(crate) struct Corners {
    positions: Vec<Vec4>,
    triangles: Vec<[u32; 3]>,
}

impl Corners {
    /// Triangles by the positions of their corners in clip space.
    pub(crate) fn new(positions: Vec<Vec4>) -> Self {
        let triangles = (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        Self { positions, triangles }
    }

    /// Flat triangles in pixels.
    pub(crate) fn flat(triangles: &[[Vec2; 3]], size: [usize; 2]) -> Self {
        let corners = triangles.as_flattened().iter();
        Self::new(corners.map(|corner| clip_position(corner.as_dvec2(), 0.5, size)).collect())
    }

    fn draw(&self, surface: BlendMode) -> Draw<'_, Self> {
        Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(self, &self.triangles) }
    }
}

impl LanePipeline for Corners {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.positions.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        positions(simd, vertices, &self.positions)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, _: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        [1.0, 0.0, 0.0, 0.0].map(|value| F32::splat(simd, value))
    }
}

/// Positions in clip space, so that the vertex stage has nothing to do.
#[inline(always)]
pub(crate) fn positions<S: Simd>(simd: S, vertices: &VertexLanes<'_>, positions: &[Vec4]) -> [F32<S>; 4] {
    let mut columns = [[0.0; 8]; 4];
    let lanes = vertices.first()..vertices.first() + vertices.count();
    for (lane, position) in positions[lanes].iter().enumerate() {
        for (column, value) in columns.iter_mut().zip(position.to_array()) {
            column[lane] = value;
        }
    }
    columns.map(|column| F32::simd_from(simd, column))
}

/// Triangles that paint their own edges.
struct Edged<'a>(&'a Corners);

impl Pipeline for Edged<'_> {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.0.positions.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.0.positions[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let is_edge = fragment.nearest_edge() < 1.0;
        Vec4::new(1.0, f32::from(u8::from(is_edge)), 0.0, 1.0)
    }
}
