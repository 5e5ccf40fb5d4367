//! The four ways of shading as pipelines of the rasterizer.

use super::shading::{AMBIENT, BASE_COLOR, blinn_phong, lambert};
use super::{Mesh, Scene};
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_raster::{Fragment, Pipeline, Sampler, Texture, VertexOutput};

/// Each triangle in its own colour.
pub(super) struct Flat<'a>(pub(super) &'a Scene);

impl Pipeline for Flat<'_> {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: clip_position(self.0, index), varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        let color = self.0.mesh.colors[fragment.triangle as usize];
        Vec4::from(color.map(f32::from)) / 255.0
    }
}

/// Light at the vertices.
pub(super) struct Gouraud<'a>(pub(super) &'a Scene);

impl Pipeline for Gouraud<'_> {
    /// The colour.
    type Varyings = Vec3;

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<Vec3> {
        let light = lambert(normal(&self.0.mesh, index), AMBIENT);
        VertexOutput { position: clip_position(self.0, index), varyings: BASE_COLOR * light }
    }

    fn fragment(&self, fragment: &Fragment<Vec3>) -> Vec4 {
        fragment.varyings.extend(1.0)
    }
}

/// Light and highlight in each pixel.
pub(super) struct BlinnPhong<'a>(pub(super) &'a Scene);

impl Pipeline for BlinnPhong<'_> {
    /// Position and normal.
    type Varyings = [Vec3; 2];

    fn vertex_count(&self) -> usize {
        self.0.mesh.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<[Vec3; 2]> {
        let varyings = [position(&self.0.mesh, index), normal(&self.0.mesh, index)];
        VertexOutput { position: clip_position(self.0, index), varyings }
    }

    fn fragment(&self, fragment: &Fragment<[Vec3; 2]>) -> Vec4 {
        let [position, normal] = fragment.varyings;
        blinn_phong(position, normal, self.0.eye).extend(1.0)
    }
}

/// A texture times light at the vertices.
pub(super) struct Textured<'a> {
    pub(super) scene: &'a Scene,
    pub(super) texture: &'a Texture,
}

impl Pipeline for Textured<'_> {
    /// Texture coordinates and light.
    type Varyings = (Vec2, f32);

    fn vertex_count(&self) -> usize {
        self.scene.mesh.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<(Vec2, f32)> {
        let mesh = &self.scene.mesh;
        let [u, v] = [0, 1].map(|axis| mesh.coordinates[axis][index]);
        let light = lambert(normal(mesh, index), AMBIENT);
        VertexOutput { position: clip_position(self.scene, index), varyings: (Vec2::new(u, v), light) }
    }

    fn fragment(&self, fragment: &Fragment<(Vec2, f32)>) -> Vec4 {
        let (coordinates, light) = fragment.varyings;
        let texel = self.texture.sample(coordinates, fragment.ddx.0, fragment.ddy.0, &Sampler::default());
        (texel.truncate() * light).extend(1.0)
    }
}

fn position(mesh: &Mesh, index: usize) -> Vec3 {
    Vec3::from([0, 1, 2].map(|axis| mesh.positions[axis][index]))
}

fn normal(mesh: &Mesh, index: usize) -> Vec3 {
    Vec3::from([0, 1, 2].map(|axis| mesh.normals[axis][index]))
}

fn clip_position(scene: &Scene, index: usize) -> Vec4 {
    scene.to_clip_space * position(&scene.mesh, index).extend(1.0)
}
