//! The four shading methods as pipelines of the rasterizer.

use super::Scene;
use super::shading::{BASE_COLOR, blinn_phong, lambert_lanes, lit};
use trigon_raster::simd::{F32, InlineMap, Simd, prelude::*};
use trigon_raster::{FragmentLanes, LanePipeline, Sampler, Texture, VertexLanes};

/// Each triangle in its own colour.
pub(super) struct Flat<'a>(pub(super) &'a Scene);

impl LanePipeline for Flat<'_> {
    const VARYINGS: usize = 0;
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        clip_position(self.0, columns(simd, vertices, &self.0.mesh.positions))
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let colors = fragments.primitives().each(
            #[inline(always)]
            |primitive| self.0.mesh.colors[primitive as usize],
        );
        [0, 1, 2, 3].each(
            #[inline(always)]
            |channel| {
                let bytes = colors.each(
                    #[inline(always)]
                    |color| f32::from(color[channel]),
                );
                F32::simd_from(simd, bytes) / 255.0
            },
        )
    }
}

/// Light at the vertices.
pub(super) struct Gouraud<'a>(pub(super) &'a Scene);

impl LanePipeline for Gouraud<'_> {
    /// The light: the colour is the same everywhere.
    const VARYINGS: usize = 1;

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        lit_vertices(simd, self.0, vertices, 0)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        opaque(simd, lit(BASE_COLOR, fragments.varying(0)))
    }
}

/// Light and highlight in each pixel.
pub(super) struct BlinnPhong<'a>(pub(super) &'a Scene);

impl LanePipeline for BlinnPhong<'_> {
    /// Position and normal.
    const VARYINGS: usize = 6;

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let mesh = &self.0.mesh;
        let position = columns(simd, vertices, &mesh.positions);
        let normal = columns(simd, vertices, &mesh.normals);
        for axis in 0..3 {
            vertices.set(axis, position[axis]);
            vertices.set(3 + axis, normal[axis]);
        }
        clip_position(self.0, position)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [position, normal] = [fragments.varyings(0), fragments.varyings(3)];
        opaque(simd, blinn_phong(simd, position, normal, self.0.eye))
    }
}

/// A texture times light at the vertices.
pub(super) struct Textured<'a> {
    pub(super) scene: &'a Scene,
    pub(super) texture: &'a Texture,
}

impl LanePipeline for Textured<'_> {
    /// Texture coordinates and light.
    const VARYINGS: usize = 3;

    fn vertex_count(&self) -> usize {
        self.scene.mesh.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        for (axis, coordinates) in self.scene.mesh.coordinates.iter().enumerate() {
            vertices.set(axis, vertices.load(simd, coordinates));
        }
        lit_vertices(simd, self.scene, vertices, 2)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [u, v, light] = fragments.varyings::<3>(0);
        let [[ux, uy], [vx, vy]] = [fragments.gradient(0), fragments.gradient(1)];
        let sampler = Sampler::default();
        let [r, g, b, _] = self.texture.sample_lanes(simd, [u, v], [ux, vx], [uy, vy], &sampler);
        opaque(simd, [r * light, g * light, b * light])
    }
}

/// Vertices with light at them: the varying `index`.
#[inline(always)]
fn lit_vertices<S: Simd>(
    simd: S,
    scene: &Scene,
    vertices: &mut VertexLanes<'_>,
    index: usize,
) -> [F32<S>; 4] {
    let normal = columns(simd, vertices, &scene.mesh.normals);
    vertices.set(index, lambert_lanes(simd, normal));
    clip_position(scene, columns(simd, vertices, &scene.mesh.positions))
}

#[inline(always)]
fn columns<S: Simd>(simd: S, vertices: &VertexLanes<'_>, [x, y, z]: &[Vec<f32>; 3]) -> [F32<S>; 3] {
    [vertices.load(simd, x), vertices.load(simd, y), vertices.load(simd, z)]
}

#[inline(always)]
fn clip_position<S: Simd>(scene: &Scene, position: [F32<S>; 3]) -> [F32<S>; 4] {
    let [x, y, z, w] = scene.to_clip_space.transpose().to_cols_array_2d();
    [affine(x, position), affine(y, position), affine(z, position), affine(w, position)]
}

/// One row of a matrix times a position.
#[inline(always)]
fn affine<S: Simd>([a, b, c, d]: [f32; 4], [x, y, z]: [F32<S>; 3]) -> F32<S> {
    x * a + y * b + z * c + d
}

#[inline(always)]
fn opaque<S: Simd>(simd: S, [r, g, b]: [F32<S>; 3]) -> [F32<S>; 4] {
    [r, g, b, F32::splat(simd, 1.0)]
}
