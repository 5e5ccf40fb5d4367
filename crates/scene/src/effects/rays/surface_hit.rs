//! The appearance of triangles that rays hit: colour, normal, and whether a ray continues.

use std::ops::Range;
use std::sync::Arc;

use trigon_math::{DMat3, Mat3, Ray, RayHit, Vec2, Vec3, elementary};
use trigon_raster::Texture;

use super::encloses;
use super::optics::{Glass, Optics, Volume};
use crate::effects::casters::{Caster, Casters};
use crate::geometry::Geometry;
use crate::material::{AlphaMode, MaterialTexture, Shading, TextureBinding};
use crate::placement::normal_matrix;
use crate::scene::Scene;

/// A point that a ray hit, in the space of the triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceHit {
    pub(crate) position: Vec3,
    /// From the origin of the ray.
    pub(crate) distance: f32,
    /// Unit vector, towards the outside.
    pub(crate) normal: Vec3,
    /// The same, of the triangle's plane.
    pub(crate) plane_normal: Vec3,
    pub(crate) color: Vec3,
    pub(crate) emissive: Vec3,
    pub(crate) optics: Option<Optics>,
    /// Whether the eye would see nothing of it: a hole of a mask, or a back face that is not drawn.
    pub(crate) is_gap: bool,
}

impl SurfaceHit {
    /// Whether nothing of its diffuse colour is seen.
    pub(crate) fn hides_its_color(&self) -> bool {
        match self.optics {
            None => false,
            Some(Optics::Mirror) => true,
            Some(Optics::Glass(glass)) => glass.transmission >= 1.0,
        }
    }

    /// The normal and that of the plane, turned against a ray. Where an interpolated normal points
    /// along the ray all the same, that of the plane takes its place.
    pub(crate) fn normals_against(&self, along: Vec3) -> [Vec3; 2] {
        let turn = if self.plane_normal.dot(along) > 0.0 { -1.0 } else { 1.0 };
        let [normal, side] = [self.normal * turn, self.plane_normal * turn];
        [if normal.dot(along) < 0.0 { normal } else { side }, side]
    }
}

/// The appearance of all triangles that rays can hit.
#[derive(Debug, Default)]
pub(crate) struct CasterSurfaces {
    /// For each triangle its caster, and its number there.
    owners: Vec<[u32; 2]>,
    casters: Vec<CasterSurface>,
}

#[derive(Debug)]
struct CasterSurface {
    node: u32,
    geometry: Arc<Geometry>,
    normal_to_scene: Mat3,
    looks: Vec<(Range<usize>, CasterMaterial)>,
}

/// A material as rays see it: without its highlights.
#[derive(Debug)]
struct CasterMaterial {
    slot: u32,
    color: Vec3,
    texture: Option<BoundTexture>,
    /// For glass: the weights of its transmission and its thickness.
    glass_textures: [Option<BoundTexture>; 2],
    emissive: Vec3,
    /// Whether the colour is shown unlit.
    unlit: bool,
    optics: Option<Optics>,
    /// The alpha of the colour, and the least that is no hole.
    mask: Option<[f32; 2]>,
    double_sided: bool,
}

type BoundTexture = (Arc<Texture>, TextureBinding);

impl CasterSurfaces {
    /// In the order of the casters' triangles.
    pub(super) fn new(scene: &Scene, casters: &Casters) -> Self {
        let mut surfaces = Self::default();
        for (number, caster) in (0_u32..).zip(&casters.list) {
            let met = CasterSurface::new(scene, caster);
            for (triangles, _) in &met.looks {
                surfaces.owners.extend(triangles.clone().map(|triangle| [number, triangle as u32]));
            }
            surfaces.casters.push(met);
        }
        surfaces
    }

    /// The glass of a slot of a node.
    pub(super) fn glass(&self, node: u32, slot: u32) -> Option<Glass> {
        let caster = self.casters.binary_search_by_key(&node, |caster| caster.node).ok()?;
        let (_, look) = self.casters[caster].looks.iter().find(|(_, look)| look.slot == slot)?;
        look.optics?.glass().copied()
    }

    /// What a ray hit.
    pub(super) fn at(&self, hit: &RayHit, ray: &Ray) -> SurfaceHit {
        let [caster, triangle] = self.owners[hit.triangle as usize].map(|number| number as usize);
        let CasterSurface { geometry, normal_to_scene, looks, .. } = &self.casters[caster];
        let corners = geometry.triangles[triangle].map(|vertex| vertex as usize);
        let mixed = |column: &[f32]| {
            corners.iter().zip(hit.weights).map(|(&corner, weight)| column[corner] * weight).sum::<f32>()
        };
        let normals = corners.map(|corner| geometry.columns.normal(corner, geometry.face(triangle)));
        let axis = |axis: usize| -> f32 {
            normals.iter().zip(hit.weights).map(|(normal, weight)| normal[axis] * weight).sum()
        };
        let normal = (*normal_to_scene * Vec3::new(axis(0), axis(1), axis(2))).normalize_or_zero();
        let (_, look) = &looks[looks.partition_point(|(triangles, _)| triangles.end <= triangle)];
        let texel = |map: &Option<BoundTexture>| {
            let (texture, binding) = map.as_ref()?;
            let [u, v] = geometry.columns.uv_sets.get(binding.uv_set)?;
            let uv = binding.transform.transform_point2(Vec2::new(mixed(u), mixed(v)));
            Some(texture.sample(uv, Vec2::ZERO, Vec2::ZERO, &binding.sampler))
        };
        let base = texel(&look.texture);
        let mut color = look.color * base.map_or(Vec3::ONE, |texel| texel.truncate());
        let mut alpha = base.map_or(1.0, |texel| texel.w);
        let mut optics = look.optics;
        if let Some(Optics::Glass(glass)) = &mut optics {
            let [transmission, thickness] = &look.glass_textures;
            glass.transmission *= texel(transmission).map_or(1.0, |texel| texel.x);
            if let Some(volume) = &mut glass.volume {
                volume.thickness *= texel(thickness).map_or(1.0, |texel| texel.y);
            }
        }
        if let Some([r, g, b, a]) = &geometry.columns.colors {
            color *= Vec3::new(mixed(r), mixed(g), mixed(b));
            alpha *= mixed(a);
        }
        let (color, emissive) =
            if look.unlit { (Vec3::ZERO, look.emissive + color) } else { (color, look.emissive) };
        let plane_normal = normal_of_plane(geometry, corners, normal_to_scene).unwrap_or(normal);
        let is_hole = look.mask.is_some_and(|[factor, cutoff]| alpha * factor < cutoff);
        // Of a volume both sides count: light leaves it through back faces.
        let has_back = look.double_sided || optics.is_some_and(|optics| optics.has_back());
        let is_gap = is_hole || (!has_back && plane_normal.dot(ray.direction) > 0.0);
        let (position, distance) = (ray.at(hit.distance), hit.distance);
        SurfaceHit { position, distance, normal, plane_normal, color, emissive, optics, is_gap }
    }

    pub(super) fn byte_count(&self) -> usize {
        size_of_val(self.owners.as_slice())
    }
}

/// The unit normal of a triangle's plane; `None` if it has no area.
fn normal_of_plane(geometry: &Geometry, corners: [usize; 3], normal_to_scene: &Mat3) -> Option<Vec3> {
    let [x, y, z] = &geometry.columns.positions;
    let [a, b, c] = corners.map(|corner| Vec3::new(x[corner], y[corner], z[corner]));
    (*normal_to_scene * (b - a).cross(c - a)).try_normalize()
}

impl CasterSurface {
    fn new(scene: &Scene, caster: &Caster) -> Self {
        let runs = caster.geometry.runs.iter().zip(&caster.shadow.materials);
        let looks = runs.filter_map(|(run, material)| {
            let material = material.as_ref()?;
            let bound = |slot: MaterialTexture| {
                let binding = material.texture(slot)?;
                Some((Arc::clone(&scene.textures.get(binding.texture)?.texture), binding))
            };
            let look = CasterMaterial {
                slot: run.slot,
                color: material.base_color.truncate(),
                texture: bound(MaterialTexture::BaseColor),
                glass_textures: [MaterialTexture::Transmission, MaterialTexture::Thickness].map(bound),
                emissive: material.emissive,
                unlit: material.shading == Shading::Unlit,
                optics: Optics::of(material),
                mask: match material.alpha_mode {
                    AlphaMode::Mask { cutoff } => Some([material.base_color.w, cutoff]),
                    AlphaMode::Opaque | AlphaMode::Blend => None,
                },
                double_sided: material.double_sided,
            };
            Some((run.triangles.clone(), look))
        });
        let placement = &caster.shadow.placement;
        let normal_to_scene = normal_matrix(&placement.world.matrix3, placement.is_mirrored);
        let mut surface = Self {
            node: caster.node,
            looks: looks.collect(),
            normal_to_scene,
            geometry: Arc::clone(&caster.geometry),
        };
        surface.place_volumes(&placement.world.matrix3);
        surface
    }

    /// Scales the thickness of volumes as the node does, and finds out whether they are enclosed.
    fn place_volumes(&mut self, to_world: &DMat3) {
        fn volume(look: &mut CasterMaterial) -> Option<&mut Volume> {
            match &mut look.optics {
                Some(Optics::Glass(glass)) => glass.volume.as_mut(),
                Some(Optics::Mirror) | None => None,
            }
        }
        let with_volume: Vec<Range<usize>> = self
            .looks
            .iter_mut()
            .filter_map(|(triangles, look)| volume(look).map(|_| triangles.clone()))
            .collect();
        if with_volume.is_empty() {
            return;
        }
        let triangles = with_volume.into_iter().flatten().map(|triangle| self.geometry.triangles[triangle]);
        let is_enclosed = encloses(&self.geometry.columns.positions, triangles);
        let scale = elementary::cbrt(to_world.determinant().abs()) as f32;
        for volume in self.looks.iter_mut().filter_map(|(_, look)| volume(look)) {
            volume.is_enclosed = is_enclosed;
            volume.thickness *= scale;
        }
    }
}
