//! The appearance of triangles that rays hit: colour, normal, and whether a ray continues.

use std::ops::Range;
use std::sync::Arc;

use trigon_math::{Mat3, RayHit, Vec2, Vec3};
use trigon_raster::Texture;

use crate::effects::casters::{Caster, Casters};
use crate::geometry::Geometry;
use crate::material::{Material, Shading, TextureBinding};
use crate::placement::normal_matrix;
use crate::scene::Scene;

/// Surfaces from which sight rays continue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Optics {
    /// A metal without roughness.
    Mirror,
    /// A transmissive surface.
    Glass {
        /// The transmitted fraction.
        transmission: f32,
        /// Index of refraction.
        ior: f32,
    },
}

impl Optics {
    /// `None` for surfaces at which rays end.
    pub(crate) fn of(material: &Material) -> Option<Self> {
        let Shading::MetallicRoughness(model) = &material.shading else { return None };
        if material.transmission > 0.0 && material.ior >= 1.0 {
            return Some(Self::Glass { transmission: material.transmission, ior: material.ior });
        }
        (model.metallic == 1.0 && model.roughness == 0.0).then_some(Self::Mirror)
    }
}

/// A point that a ray hit, in the space of the triangles.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SurfaceHit {
    pub(crate) position: Vec3,
    /// Unit vector, towards the outside.
    pub(crate) normal: Vec3,
    pub(crate) color: Vec3,
    pub(crate) emissive: Vec3,
    pub(crate) optics: Option<Optics>,
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
    geometry: Arc<Geometry>,
    normal_to_scene: Mat3,
    looks: Vec<(Range<usize>, CasterMaterial)>,
}

/// A material as rays see it: without its highlights.
#[derive(Debug)]
struct CasterMaterial {
    color: Vec3,
    texture: Option<(Arc<Texture>, TextureBinding)>,
    /// For glass: the weight of its transmission.
    transmission_texture: Option<(Arc<Texture>, TextureBinding)>,
    emissive: Vec3,
    /// Whether the colour is shown unlit.
    unlit: bool,
    optics: Option<Optics>,
}

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

    /// What a ray hit at a position.
    pub(super) fn at(&self, hit: &RayHit, position: Vec3) -> SurfaceHit {
        let [caster, triangle] = self.owners[hit.triangle as usize].map(|number| number as usize);
        let CasterSurface { geometry, normal_to_scene, looks } = &self.casters[caster];
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
        let texel = |map: &Option<(Arc<Texture>, TextureBinding)>| {
            let (texture, binding) = map.as_ref()?;
            let [u, v] = geometry.columns.uv_sets.get(binding.uv_set)?;
            let uv = binding.transform.transform_point2(Vec2::new(mixed(u), mixed(v)));
            Some(texture.sample(uv, Vec2::ZERO, Vec2::ZERO, &binding.sampler).truncate())
        };
        let mut color = look.color * texel(&look.texture).unwrap_or(Vec3::ONE);
        let mut optics = look.optics;
        if let (Some(Optics::Glass { transmission, .. }), Some(texel)) =
            (&mut optics, texel(&look.transmission_texture))
        {
            *transmission *= texel.x;
        }
        if let Some([r, g, b, _]) = &geometry.columns.colors {
            color *= Vec3::new(mixed(r), mixed(g), mixed(b));
        }
        let (color, emissive) =
            if look.unlit { (Vec3::ZERO, look.emissive + color) } else { (color, look.emissive) };
        SurfaceHit { position, normal, color, emissive, optics }
    }

    pub(super) fn byte_count(&self) -> usize {
        size_of_val(self.owners.as_slice())
    }
}

impl CasterSurface {
    fn new(scene: &Scene, caster: &Caster) -> Self {
        let runs = caster.geometry.runs.iter().zip(&caster.shadow.materials);
        let looks = runs.filter_map(|(run, material)| {
            let material = material.as_ref()?;
            let bound = |binding: Option<TextureBinding>| {
                let binding = binding?;
                Some((Arc::clone(&scene.textures.get(binding.texture)?.texture), binding))
            };
            let look = CasterMaterial {
                color: material.base_color.truncate(),
                texture: bound(material.base_color_texture),
                transmission_texture: bound(material.transmission_texture),
                emissive: material.emissive,
                unlit: material.shading == Shading::Unlit,
                optics: Optics::of(material),
            };
            Some((run.triangles.clone(), look))
        });
        let normal_to_scene =
            normal_matrix(&caster.shadow.place.world.matrix3, caster.shadow.place.is_mirrored);
        Self { looks: looks.collect(), normal_to_scene, geometry: Arc::clone(&caster.geometry) }
    }
}
