//! What the tests of the rasterizer share: triangles given on the sub-pixel
//! grid, and pictures that count how often each pixel is covered.

use trigon_math::Vec4;
use trigon_raster::{
    Culling, Draw, ExecuteSettings, Fragment, Output, Pass, Pictures, Pipeline, Surface, Target, VertexOutput,
};

/// Width and height of the pictures: a power of two, so that points of the
/// sub-pixel grid are exact in clip space.
pub(crate) const SIDE: i32 = 64;

/// A point in 1/256 pixel from the top left, y down.
pub(crate) type Raw = [i32; 2];

/// The clip-space position of a point on the grid, at `depth`, for w = 1.
/// Exact for all points in the guard band.
pub(crate) fn clip_position([x, y]: Raw, depth: f32) -> Vec4 {
    let unit = (SIDE * 128) as f32;
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
    pub(crate) fn on_grid(points: &[Raw]) -> Self {
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

/// All pictures of a pass, `width` by `height` pixels.
pub(crate) fn draw_sized(pass: &Pass<'_>, [width, height]: [i32; 2], settings: &ExecuteSettings) -> Pictures {
    let outputs =
        [Output::Srgb8, Output::Linear, Output::Depth, Output::Object, Output::Face, Output::Triangle];
    let mut target = Target::new(width as u32, height as u32, &outputs).expect("the size is in range");
    pass.execute(&mut target, settings);
    target.into_pictures()
}

/// All pictures of a pass, [`SIDE`] by [`SIDE`] pixels.
pub(crate) fn draw(pass: &Pass<'_>) -> Pictures {
    draw_sized(pass, [SIDE; 2], &ExecuteSettings::default())
}

/// How often each pixel is covered by the triangles, of either winding.
pub(crate) fn count(pipeline: &Values, triangles: &[[u32; 3]]) -> Vec<u32> {
    let mut pass = Pass::new();
    let surface = Surface::Translucent;
    pass.triangles(Draw { surface, culling: Culling::None, ..Draw::new(pipeline, triangles) });
    let linear = draw(&pass).linear.expect("asked for");
    linear.iter().map(|color| color.x as u32).collect()
}

/// Pixel coordinates of a row-major index.
pub(crate) fn pixel(index: usize) -> [i32; 2] {
    [index as i32 % SIDE, index as i32 / SIDE]
}
