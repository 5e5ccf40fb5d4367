//! One way to shade, written as each kind of pipeline that there is.

use trigon_math::{Vec2, Vec4};
use trigon_raster::simd::{F32, I32, InlineMap, Mask, Simd, lanes_of, prelude::*};
use trigon_raster::{
    Fragment, FragmentLanes, LanePipeline, Pipeline, Sampler, Texture, VertexLanes, VertexOutput,
};

/// Vertices in clip space with straight colours, column by column.
#[derive(Clone, Debug, Default)]
pub(crate) struct Vertices {
    positions: [Vec<f32>; 4],
    colors: [Vec<f32>; 4],
}

impl Vertices {
    pub(crate) fn push(&mut self, position: Vec4, color: Vec4) -> u32 {
        for axis in 0..4 {
            self.positions[axis].push(position[axis]);
            self.colors[axis].push(color[axis]);
        }
        self.len() as u32 - 1
    }

    pub(crate) fn len(&self) -> usize {
        self.positions[0].len()
    }

    fn position(&self, index: usize) -> Vec4 {
        Vec4::from_array(self.positions.each_ref().map(|column| column[index]))
    }

    pub(crate) fn color(&self, index: usize) -> Vec4 {
        Vec4::from_array(self.colors.each_ref().map(|column| column[index]))
    }

    /// The same with w = 1 and at a depth within the view, so that nothing is cut.
    pub(crate) fn in_front(mut self) -> Self {
        self.positions[2].fill(0.5);
        self.positions[3].fill(1.0);
        self
    }

    /// The vertices' positions, and their colours as the varyings from 0 on.
    #[inline(always)]
    fn run<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        for (index, column) in self.colors.iter().enumerate() {
            vertices.set(index, vertices.load(simd, column));
        }
        self.positions.each_ref().each(
            #[inline(always)]
            |column| vertices.load(simd, column),
        )
    }
}

/// Squares of the colour make holes.
const CELLS: f32 = 8.0;

/// One vertex and one fragment at a time.
pub(crate) struct Scalar<'a>(pub(crate) &'a Vertices);

impl Pipeline for Scalar<'_> {
    type Varyings = Vec4;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec4> {
        VertexOutput { position: self.0.position(index), varyings: self.0.color(index) }
    }

    fn fragment(&self, fragment: &Fragment<Vec4>) -> Vec4 {
        let straight = fragment.varyings;
        (straight.truncate() * straight.w).extend(straight.w)
    }

    fn mask(&self, fragment: &Fragment<Vec4>) -> bool {
        let [x, y] = [fragment.varyings.x, fragment.varyings.y].map(|v| (v * CELLS) as i32);
        (x + y) & 1 == 0
    }
}

/// The same eight at a time.
pub(crate) struct Lanes<'a>(pub(crate) &'a Vertices);

impl LanePipeline for Lanes<'_> {
    const VARYINGS: usize = 4;
    const MASKED: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.run(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, _: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, a] = fragments.varyings(0);
        [r * a, g * a, b * a, a]
    }

    #[inline(always)]
    fn masks<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
        let [x, y] = fragments.varyings::<2>(0).each(
            #[inline(always)]
            |v| (v * CELLS).to_int::<I32<S>>(),
        );
        ((x + y) & 1).simd_eq(I32::splat(simd, 0))
    }
}

/// One colour for each triangle: that of the vertex with its number.
pub(crate) struct Flat<'a>(pub(crate) &'a Vertices);

impl LanePipeline for Flat<'_> {
    const VARYINGS: usize = 4;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.0.run(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let vertices = fragments.primitives().map(|primitive| primitive as usize % self.0.len());
        let [r, g, b, a] = self.0.colors.each_ref().each(
            #[inline(always)]
            |column| F32::simd_from(simd, lanes_of(|lane| column[vertices[lane]])),
        );
        [r * a, g * a, b * a, a]
    }
}

/// [`Flat`], one fragment at a time.
pub(crate) struct ScalarFlat<'a>(pub(crate) &'a Vertices);

impl Pipeline for ScalarFlat<'_> {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.0.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.0.position(index), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let straight = self.0.color(fragment.triangle as usize % self.0.len());
        (straight.truncate() * straight.w).extend(straight.w)
    }
}

/// A texture in place of the colour, whose red and green say where.
pub(crate) struct Textured<'a> {
    pub(crate) vertices: &'a Vertices,
    pub(crate) texture: &'a Texture,
    pub(crate) sampler: Sampler,
}

/// How often the texture is repeated.
const REPEATS: f32 = 5.0;

impl LanePipeline for Textured<'_> {
    const VARYINGS: usize = 4;

    fn vertex_count(&self) -> usize {
        self.vertices.len()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        self.vertices.run(simd, vertices)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v] = fragments.varyings::<2>(0).each(
            #[inline(always)]
            |coordinate| coordinate * REPEATS,
        );
        let [[ux, uy], [vx, vy]] = [0, 1].each(
            #[inline(always)]
            |index| fragments.gradient(index).each(|slope| slope * REPEATS),
        );
        let [r, g, b, a] = self.texture.sample_lanes(simd, [u, v], [ux, vx], [uy, vy], &self.sampler);
        [r * a, g * a, b * a, a]
    }
}

/// [`Textured`], one fragment at a time.
pub(crate) struct ScalarTextured<'a>(pub(crate) Textured<'a>);

impl Pipeline for ScalarTextured<'_> {
    type Varyings = Vec2;

    fn vertex_count(&self) -> usize {
        self.0.vertices.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec2> {
        let vertices = self.0.vertices;
        VertexOutput {
            position: vertices.position(index),
            varyings: vertices.color(index).truncate().truncate(),
        }
    }

    fn fragment(&self, fragment: &Fragment<Vec2>) -> Vec4 {
        let [uv, ddx, ddy] = [fragment.varyings, fragment.ddx, fragment.ddy].map(|v| v * REPEATS);
        let straight = self.0.texture.sample(uv, ddx, ddy, &self.0.sampler);
        (straight.truncate() * straight.w).extend(straight.w)
    }
}
