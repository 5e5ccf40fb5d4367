//! The four shading methods as pipelines of the rasterizer. Here are also the light and the two reflection
//! models.

use trigon_math::Vec3;
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, Simd, greater};
use trigon_raster::{FragmentLanes, LanePipeline, Sampler, Texture, VertexLanes};

use super::Scene;

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

/// Red, green and blue of lit surfaces.
pub(super) const BASE_COLOR: Vec3 = Vec3::new(0.85, 0.65, 0.40);

/// The share of light that comes from everywhere.
const AMBIENT: f32 = 0.1;

/// The strength of highlights. Their exponent is 32: five squares.
const SPECULAR: f32 = 0.4;

/// The direction towards the light: (0.4, 0.7, 0.6), of unit length. In numbers,
/// so that no vector of fragments takes a square root for it.
const LIGHT: Vec3 = Vec3::new(0.398_014_87, 0.696_526, 0.597_022_3);

/// Lambert's law with some light from everywhere: between `ambient` and 1.
pub(super) fn lambert(normal: Vec3, ambient: f32) -> f32 {
    ambient + (1.0 - ambient) * normal.dot(LIGHT).max(0.0)
}

/// Lambert's law for eight unit normals, with the light of lit surfaces: between 0.1 and 1.
#[inline(always)]
pub fn lambert_lanes<S: Simd>(simd: S, normal: [F32<S>; 3]) -> F32<S> {
    diffuse(dot(normal, splat(simd, LIGHT)))
}

/// J. F. Blinn, "Models of light reflection for computer synthesized pictures",
/// SIGGRAPH 1977: the highlight by the angle between the normal and the middle
/// of light and eye. The normal may have any length.
#[inline(always)]
pub fn blinn_phong<S: Simd>(simd: S, position: [F32<S>; 3], normal: [F32<S>; 3], eye: Vec3) -> [F32<S>; 3] {
    let light = splat(simd, LIGHT);
    let to_eye = difference(splat(simd, eye), position);
    let half = sum(light, scaled(to_eye, inverse_length(to_eye)));
    // Lengths divide the products: that is shorter than to divide the vectors.
    let shortness = inverse_length(normal);
    let mut highlight = positive(dot(normal, half) * (shortness * inverse_length(half)));
    for _ in 0..5 {
        highlight *= highlight;
    }
    let diffuse = diffuse(dot(normal, light) * shortness);
    let [r, g, b] = lit(BASE_COLOR, diffuse);
    let highlight = highlight * SPECULAR;
    [r + highlight, g + highlight, b + highlight]
}

/// A colour times a light.
#[inline(always)]
pub(super) fn lit<S: Simd>(color: Vec3, light: F32<S>) -> [F32<S>; 3] {
    [light * color.x, light * color.y, light * color.z]
}

/// By the cosine of the angle between the normal and the light.
#[inline(always)]
fn diffuse<S: Simd>(cosine: F32<S>) -> F32<S> {
    positive(cosine) * (1.0 - AMBIENT) + AMBIENT
}

#[inline(always)]
fn inverse_length<S: Simd>(vector: [F32<S>; 3]) -> F32<S> {
    1.0 / dot(vector, vector).sqrt()
}

#[inline(always)]
fn sum<S: Simd>([a, b, c]: [F32<S>; 3], [d, e, f]: [F32<S>; 3]) -> [F32<S>; 3] {
    [a + d, b + e, c + f]
}

#[inline(always)]
fn difference<S: Simd>([a, b, c]: [F32<S>; 3], [d, e, f]: [F32<S>; 3]) -> [F32<S>; 3] {
    [a - d, b - e, c - f]
}

#[inline(always)]
fn scaled<S: Simd>([a, b, c]: [F32<S>; 3], factor: F32<S>) -> [F32<S>; 3] {
    [a * factor, b * factor, c * factor]
}

#[inline(always)]
fn dot<S: Simd>(a: [F32<S>; 3], b: [F32<S>; 3]) -> F32<S> {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn splat<S: Simd>(simd: S, vector: Vec3) -> [F32<S>; 3] {
    [F32::splat(simd, vector.x), F32::splat(simd, vector.y), F32::splat(simd, vector.z)]
}

/// 0 also for what is no number.
#[inline(always)]
fn positive<S: Simd>(value: F32<S>) -> F32<S> {
    greater(value, F32::splat(value.simd, 0.0))
}
