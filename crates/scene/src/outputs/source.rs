//! The parts of an object that outputs read: its mesh, its transform, and its materials.

use trigon_math::{DAffine3, DVec2, DVec3, Mat3, Vec2, Vec3};
use trigon_mesh::Mesh;
use trigon_raster::Texture;

use super::facet::{Beam, Facet, mixed, mixed2, vertex};
use crate::geometry::Geometry;
use crate::material::{Material, MaterialTexture, Shading, TextureBinding};
use crate::node::Node;
use crate::placement::normal_matrix;
use crate::prepare::PreparedScene;
use crate::scene::Scene;
use crate::settings::{Outputs, Style};
use crate::shapes::Shape;

/// An object that may be visible.
pub(super) struct ObjectSource<'s> {
    geometry: &'s Geometry,
    looks: Vec<OutputMaterial<'s>>,
    to_camera: DAffine3,
    normal_to_world: Mat3,
    tangent_to_world: Mat3,
    mirrored: bool,
    /// Whether a draw's triangles are those of a run, or all of the object.
    draws_are_runs: bool,
}

/// The material of a run of triangles.
struct OutputMaterial<'s> {
    /// With tangents, if there is a normal map.
    geometry: &'s Geometry,
    material: u32,
    color: Vec3,
    texture: Option<OutputTexture<'s>>,
    /// With the factor of x and y.
    normal_map: Option<(OutputTexture<'s>, f32)>,
}

/// A texture with the mesh's coordinates.
struct OutputTexture<'s> {
    texture: &'s Texture,
    binding: TextureBinding,
}

/// A visible triangle.
#[derive(Clone, Copy)]
pub(super) struct Triangle<'s> {
    source: &'s ObjectSource<'s>,
    look: &'s OutputMaterial<'s>,
    pub(super) facet: Facet,
    index: usize,
    /// Whether its front is visible.
    front: bool,
}

/// A point on a triangle.
#[derive(Clone, Copy)]
pub(super) struct Point {
    pub(super) weights: DVec3,
    /// The change of the barycentrics per pixel to the right, and downwards.
    pub(super) slopes: [DVec3; 2],
}

impl<'s> ObjectSource<'s> {
    pub(super) fn new(prepared: &'s PreparedScene<'_>, node: &Node, shape: &'s Shape, mesh: &Mesh) -> Self {
        let scene = prepared.scene;
        let needs = &prepared.settings.outputs;
        let geometry = &*shape.geometry;
        let looks = geometry.runs.iter().map(|run| {
            let id = node.materials.get(run.slot as usize).copied();
            let known = id.and_then(|id| Some((id.index() as u32, scene.materials.get(id)?)));
            match known {
                Some((index, material)) => OutputMaterial::new(scene, index, material, geometry, mesh, needs),
                None => OutputMaterial::new(scene, u32::MAX, &Material::default(), geometry, mesh, needs),
            }
        });
        Self {
            geometry,
            looks: looks.collect(),
            to_camera: prepared.eye.to_camera(&shape.world),
            normal_to_world: normal_matrix(&shape.world.matrix3, shape.is_mirrored),
            tangent_to_world: shape.world.matrix3.as_mat3(),
            mirrored: shape.is_mirrored,
            draws_are_runs: prepared.settings.style != Style::HiddenLine,
        }
    }

    /// The triangle of a face, by its number in its draw. A face lies in one run only.
    pub(super) fn triangle(&self, face: u32, number: u32, beam: Beam) -> Option<Triangle<'_>> {
        let (look, index) = self.geometry.runs.iter().zip(&self.looks).find_map(|(run, look)| {
            let start = if self.draws_are_runs { run.triangles.start } else { 0 };
            let index = start + number as usize;
            (run.triangles.contains(&index) && self.geometry.face(index) == face).then_some((look, index))
        })?;
        let columns = &look.geometry.columns;
        let corners = look.geometry.triangles[index].map(|corner| {
            self.to_camera.transform_point3(vertex(&columns.positions, corner as usize).as_dvec3())
        });
        let facet = Facet::new(corners, beam);
        let front = facet.is_clockwise() == self.mirrored;
        Some(Triangle { source: self, look, facet, index, front })
    }
}

impl<'s> OutputMaterial<'s> {
    fn new(
        scene: &'s Scene,
        index: u32,
        material: &Material,
        geometry: &'s Geometry,
        mesh: &Mesh,
        needs: &Outputs,
    ) -> Self {
        let map = |binding: TextureBinding| {
            let texture = &scene.textures.get(binding.texture)?.texture;
            geometry.columns.uv_sets.get(binding.uv_set)?;
            Some(OutputTexture { texture, binding })
        };
        let shows_normals = needs.normals && material.shading != Shading::Unlit;
        let bent = material.normal_map.filter(|_| shows_normals && MaterialTexture::Normal.matters(material));
        let geometry = match bent {
            Some(bent) => geometry.with_tangents(mesh, bent.binding.uv_set),
            None => geometry,
        };
        Self {
            geometry,
            material: index,
            color: material.base_color.truncate(),
            texture: material.base_color_texture.filter(|_| needs.albedo).and_then(map),
            normal_map: bent
                .filter(|_| geometry.columns.tangents.is_some())
                .and_then(|bent| Some((map(bent.binding)?, bent.scale))),
        }
    }
}

/// 0 where files hold NaN, or infinity times zero: an output never does.
fn number(value: f32) -> f32 {
    if value.is_nan() { 0.0 } else { value }
}

impl Triangle<'_> {
    /// The index of its material in the scene.
    pub(super) fn material(&self) -> u32 {
        self.look.material
    }

    /// Its index in the mesh's triangulation.
    pub(super) fn index(&self) -> u32 {
        self.source.geometry.triangulated(self.index)
    }

    fn corners(&self) -> [usize; 3] {
        self.look.geometry.triangles[self.index].map(|corner| corner as usize)
    }

    /// Coordinates of the first UV set.
    pub(super) fn uv(&self, weights: DVec3) -> Vec2 {
        let set = self.look.geometry.columns.uv_sets.first();
        set.map_or(Vec2::ZERO, |set| mixed2(weights, set, self.corners()).as_vec2().map(number))
    }

    /// The colour before lighting.
    pub(super) fn albedo(&self, point: &Point) -> Vec3 {
        let mut color = self.look.color;
        if let Some(map) = &self.look.texture {
            color *= self.look_up(map, point);
        }
        if let Some([r, g, b, _]) = &self.look.geometry.columns.colors {
            let corners = self.corners();
            let channel = |column: &[f32]| mixed(point.weights, corners.map(|corner| column[corner])) as f32;
            color *= Vec3::new(channel(r), channel(g), channel(b));
        }
        color.map(number)
    }

    /// The value of a texture over a whole pixel.
    fn look_up(&self, map: &OutputTexture<'_>, point: &Point) -> Vec3 {
        let set = &self.look.geometry.columns.uv_sets[map.binding.uv_set];
        let mix = |weights: DVec3| -> DVec2 { mixed2(weights, set, self.corners()) };
        let transform = map.binding.transform;
        let uv = transform.transform_point2(mix(point.weights).as_vec2());
        let [ddx, ddy] = point.slopes.map(|slope| transform.transform_vector2(mix(slope).as_vec2()));
        map.texture.sample(uv, ddx, ddy, &map.binding.sampler).truncate()
    }

    /// The geometric normal on the visible side, in camera space.
    pub(super) fn plane_normal(&self) -> DVec3 {
        let normal = self.facet.normal();
        // A clockwise triangle's normal points away from the eye.
        if self.facet.is_clockwise() { -normal } else { normal }
    }

    /// The shading normal, in the world.
    pub(super) fn normal(&self, point: &Point) -> Vec3 {
        let columns = &self.look.geometry.columns;
        let [a, b, c] = self.corners();
        let mix = |values: [Vec3; 3]| -> Vec3 {
            let [u, v, w] = values.map(Vec3::as_dvec3);
            (u * point.weights.x + v * point.weights.y + w * point.weights.z).as_vec3()
        };
        let face = self.look.geometry.face(self.index);
        let turned =
            |corner| (self.source.normal_to_world * columns.normal(corner, face)).normalize_or_zero();
        let mut normal = mix([a, b, c].map(turned));
        if let (Some((map, scale)), Some(tangents)) = (&self.look.normal_map, &columns.tangents) {
            let turned =
                |corner| (self.source.tangent_to_world * vertex(tangents, corner)).normalize_or_zero();
            let tangent = mix([a, b, c].map(turned));
            let side = mixed(point.weights, [a, b, c].map(|corner| tangents[3][corner])) as f32;
            let bitangent = normal.cross(tangent) * if self.source.mirrored { -side } else { side };
            let bent = self.look_up(map, point) * 2.0 - 1.0;
            normal = tangent * (bent.x * scale) + bitangent * (bent.y * scale) + normal * bent.z;
        }
        let normal = normal.normalize_or_zero();
        if self.front { normal } else { -normal }
    }
}
