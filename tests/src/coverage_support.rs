//! What the tests of the rasterizer share: triangles given on the sub-pixel
//! grid, and images that count how often each pixel is covered.

use proptest::prelude::*;
use trigon_math::Vec4;
use trigon_raster::simd::SimdLevel;
use trigon_raster::{
    BlendMode, Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pipeline, Rasterizer, Target,
    TargetImages, VertexOutput,
};
use trigon_study::oracle::GridPoint;

pub(crate) use crate::samples::Samples;

/// Width and height of the images: a power of two, so that points of the
/// sub-pixel grid are exact in clip space.
pub(crate) const SIDE: i32 = 64;

/// The clip-space position of a point on the grid, at `depth`, for w = 1.
/// Exact for all points in the guard band.
pub(crate) fn clip_position(point: GridPoint, depth: f32) -> Vec4 {
    clip_position_on(SIDE, point, depth)
}

/// The same on an image of another width and height, a power of two.
pub(crate) fn clip_position_on(side: i32, [x, y]: GridPoint, depth: f32) -> Vec4 {
    let unit = (side * 128) as f32;
    Vec4::new(x as f32 / unit - 1.0, 1.0 - y as f32 / unit, depth, 1.0)
}

/// Vertices with one value each; a fragment is that value in red and nothing in
/// alpha, so that translucent layers add up.
pub(crate) struct Values {
    pub(crate) vertices: Vec<(Vec4, f32)>,
}

impl Values {
    pub(crate) fn ones(positions: impl IntoIterator<Item = Vec4>) -> Self {
        Self { vertices: positions.into_iter().map(|position| (position, 1.0)).collect() }
    }

    /// Ones at points of the grid, at depth 1/2.
    pub(crate) fn on_grid(points: &[GridPoint]) -> Self {
        Self::ones(points.iter().map(|&point| clip_position(point, 0.5)))
    }
}

impl Pipeline for Values {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        let (position, varyings) = self.vertices[index];
        VertexOutput { position, varyings }
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        Vec4::new(fragment.varyings, 0.0, 0.0, 0.0)
    }
}

/// The triangles of one draw, whose colours are numbers. Translucent ones have an alpha of 1/2.
pub(crate) struct NumberedTriangles {
    values: Values,
    triangles: Vec<[u32; 3]>,
    faces: Vec<u32>,
    object: u32,
    blend_mode: BlendMode,
}

impl NumberedTriangles {
    pub(crate) fn new(object: u32, blend_mode: BlendMode) -> Self {
        let values = Values { vertices: Vec::new() };
        Self { values, triangles: Vec::new(), faces: Vec::new(), object, blend_mode }
    }

    /// Adds a triangle of a face, with its number.
    pub(crate) fn push(&mut self, positions: [Vec4; 3], face: u32, number: usize) {
        let first = self.values.vertices.len() as u32;
        self.values.vertices.extend(positions.map(|position| (position, number as f32)));
        self.triangles.push([first, first + 1, first + 2]);
        self.faces.push(face);
    }

    /// Both sides of all of them.
    pub(crate) fn draw(&self) -> Draw<'_, Self> {
        let Self { object, blend_mode, .. } = *self;
        let draw = Draw { object, blend_mode, ..Draw::new(self, &self.triangles) };
        Draw { faces: Some(&self.faces), culling: Culling::None, ..draw }
    }
}

impl Pipeline for NumberedTriangles {
    type Varyings = f32;

    fn vertex_count(&self) -> usize {
        self.values.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<f32> {
        self.values.vertex(index)
    }

    fn fragment(&self, fragment: &Fragment<f32>) -> Vec4 {
        let alpha = if self.blend_mode == BlendMode::Translucent { 0.5 } else { 1.0 };
        Vec4::new(fragment.varyings * alpha, 0.0, 0.0, alpha)
    }
}

impl Samples {
    /// Either kind, both together, or none.
    pub(crate) fn any() -> impl Strategy<Value = Self> {
        let per_pixel = prop_oneof![Just(1_u32), Just(2), Just(4), Just(8), Just(16)];
        prop_oneof![
            3 => per_pixel.clone().prop_map(|per_pixel| Self { per_axis: 1, per_pixel }),
            1 => (2..5_u32).prop_map(|per_axis| Self { per_axis, per_pixel: 1 }),
            1 => per_pixel.prop_map(|per_pixel| Self { per_axis: 2, per_pixel }),
        ]
    }
}

/// The SIMD levels of this machine that are built in.
pub(crate) fn levels() -> impl Iterator<Item = SimdLevel> {
    SimdLevel::ALL.into_iter().filter(|level| level.is_supported())
}

/// A rasterizer with these settings, which the machine supports.
pub(crate) fn rasterizer(settings: &ExecuteSettings) -> Rasterizer {
    Rasterizer::new(*settings).expect("the level is supported")
}

/// All images of a pass, `width` by `height` pixels.
pub(crate) fn draw_sized(
    pass: &Pass<'_>,
    [width, height]: [i32; 2],
    settings: &ExecuteSettings,
) -> TargetImages {
    let outputs =
        [Output::Srgb8, Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
    let mut target = Target::new(width as u32, height as u32, &outputs).expect("the size is in range");
    rasterizer(settings).draw(pass, &mut target);
    target.into_images()
}

/// All images of a pass, [`SIDE`] by [`SIDE`] pixels.
pub(crate) fn draw(pass: &Pass<'_>) -> TargetImages {
    draw_sized(pass, [SIDE; 2], &ExecuteSettings::default())
}

/// How often each pixel is covered by the triangles, of either winding.
pub(crate) fn count(pipeline: &Values, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut pass = Pass::new();
    let surface = BlendMode::Translucent;
    pass.triangles(Draw { blend_mode: surface, culling: Culling::None, ..Draw::new(pipeline, triangles) });
    let linear = draw(&pass).linear.expect("asked for");
    linear.iter().map(|color| color.x as u32).collect()
}

/// Pixel coordinates of a row-major index.
pub(crate) fn pixel(index: usize) -> [i32; 2] {
    [index as i32 % SIDE, index as i32 / SIDE]
}
