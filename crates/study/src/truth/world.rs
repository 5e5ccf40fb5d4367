//! A scene as rays see it: triangles, lamps and materials in f64, in world space.

use trigon_math::{DMat3, DVec2, DVec3, DVec4, Vec3, elementary};
use trigon_scene::camera::{Camera, Projection};
use trigon_scene::{
    AlphaMode, Background, LightKind, Material, MaterialTexture, RenderSettings, Scene, Shading, Shadows,
    SightRays, Style, Texture, TextureFormat, ToneMapping, Wrap,
};

use super::tree::Tree;

/// Why a scene has no truth: it needs something that is not implemented a second time.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the truth of {0} is not implemented")]
pub struct Unsupported(&'static str);

/// What rays may meet, and the light there.
pub(super) struct World {
    pub(super) tree: Tree,
    pub(super) triangles: Vec<WorldTriangle>,
    pub(super) looks: Vec<Look>,
    pub(super) lamps: Vec<Lamp>,
    pub(super) ambient: DVec3,
    pub(super) background: [DVec3; 2],
    pub(super) eye: Eye,
    pub(super) effects: Effects,
}

/// What the settings request beyond light from lamps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Effects {
    pub(super) shadows: bool,
    /// The distance within which surfaces occlude ambient light.
    pub(super) occlusion: Option<f64>,
    /// Surfaces that a mirrored ray meets at most.
    pub(super) bounces: u32,
}

/// A triangle, and what changes over it.
pub(super) struct WorldTriangle {
    pub(super) corners: [DVec3; 3],
    pub(super) normals: [DVec3; 3],
    pub(super) uvs: [DVec2; 3],
    /// The place of its material in [`World::looks`].
    pub(super) look: usize,
}

/// A material with its texture.
pub(super) struct Look {
    pub(super) material: Material,
    pub(super) texture: Option<Texels>,
}

/// A lamp.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lamp {
    pub(super) radiance: DVec3,
    pub(super) source: Source,
}

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Source {
    /// From infinity; the unit vector points there.
    Parallel(DVec3),
    /// From a point up to a distance, within a cone around an axis: the cosines of the angles where it begins to fade and
    /// where it ends.
    Point { at: DVec3, range: f64, axis: DVec3, cone: Option<[f64; 2]> },
}

/// Rays through the pixels of an image.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Eye {
    position: DVec3,
    /// Right, up and backwards.
    axes: [DVec3; 3],
    /// Half of the width and height of the window, at the distance 1 or of a parallel view.
    half: DVec2,
    is_parallel: bool,
    size: DVec2,
}

impl World {
    pub(super) fn new(
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
    ) -> Result<Self, Unsupported> {
        let effects = effects(settings)?;
        let eye = Eye::new(camera, settings)?;
        let is_soft = |light: &trigon_scene::Light| light.radius > 0.0;
        if settings.effects.soft_shadows.radius > 0.0
            || scene.nodes().iter().any(|(_, node)| node.light.as_deref().is_some_and(is_soft))
        {
            return Err(Unsupported("lamps with an extent"));
        }
        let (lamps, ambient) = lights(scene, &eye, settings);
        let looks = scene.materials.iter().map(|(_, material)| Look::new(scene, material));
        let looks = looks.collect::<Result<Vec<Look>, _>>()?;
        if ambient != DVec3::ZERO && looks.iter().any(Look::needs_integral) {
            return Err(Unsupported("ambient light on rough metals and dielectrics"));
        }
        let mut triangles = Vec::new();
        let visible = scene.visible_transforms();
        for (id, node) in scene.nodes().iter() {
            let Some(world) = visible[id.index()] else { continue };
            let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
            let look = node
                .materials
                .first()
                .and_then(|first| scene.materials.iter().position(|(material, _)| material == *first));
            let attributes = asset.mesh().attributes();
            let slots = attributes.face_materials.iter().flatten();
            if slots.copied().any(|slot| slot != 0) || attributes.has_colors() {
                return Err(Unsupported("faces with materials or colours of their own"));
            }
            let look = look.ok_or(Unsupported("a surface without material"))?;
            add(asset.mesh(), world.matrix3, world.translation, look, &mut triangles);
        }
        let background = match settings.background {
            Background::Color(color) => [color; 2],
            Background::Gradient { top, bottom } => [top, bottom],
            Background::Transparent | Background::Environment => {
                return Err(Unsupported("a background without colour"));
            }
        };
        let tree = Tree::new(triangles.iter().map(|triangle| triangle.corners));
        let background = background.map(Vec3::as_dvec3);
        Ok(Self { tree, triangles, looks, lamps, ambient, background, eye, effects })
    }
}

fn effects(settings: &RenderSettings) -> Result<Effects, Unsupported> {
    let effects = &settings.effects;
    if settings.style != Style::Surface
        || effects.fog.is_some()
        || effects.environment.is_some()
        || effects.tone_mapping != ToneMapping::None
    {
        return Err(Unsupported("edges, fog, environments and mapped tones"));
    }
    let bounces = match effects.sight {
        SightRays::All { bounces } => bounces,
        SightRays::Glass { .. } | SightRays::Off => 0,
    };
    let occlusion = effects.ambient_occlusion.map(|occlusion| f64::from(occlusion.distance));
    Ok(Effects { shadows: effects.shadows != Shadows::Off, occlusion, bounces })
}

/// The faces of a mesh as triangles in the world.
fn add(
    mesh: &trigon_mesh::Mesh,
    matrix: DMat3,
    translation: DVec3,
    look: usize,
    triangles: &mut Vec<WorldTriangle>,
) {
    let turn = matrix.inverse().transpose();
    let normals = mesh.shading_normals();
    let uvs = mesh.attributes().uv_sets.first();
    for corners in mesh.triangulation().triangles {
        let corners = corners.map(|corner| corner as usize);
        triangles.push(WorldTriangle {
            corners: corners.map(|corner| {
                let vertex = mesh.corner_vertices()[corner] as usize;
                matrix * mesh.positions()[vertex].as_dvec3() + translation
            }),
            normals: corners.map(|corner| (turn * normals[corner].as_dvec3()).normalize_or_zero()),
            uvs: corners.map(|corner| uvs.map_or(DVec2::ZERO, |uvs| uvs[corner].as_dvec2())),
            look,
        });
    }
}

impl Look {
    fn new(scene: &Scene, material: &Material) -> Result<Self, Unsupported> {
        let is_plain = material.textures().all(|(slot, _)| slot == MaterialTexture::BaseColor)
            && material.transmission == 0.0
            && !matches!(material.alpha_mode, AlphaMode::Mask { .. })
            && material.double_sided;
        if !is_plain {
            return Err(Unsupported("masks, glass, textures but colours, and faces with one side"));
        }
        let texture = match material.base_color_texture {
            None => None,
            Some(binding) if binding.uv_set != 0 => return Err(Unsupported("a second set of coordinates")),
            Some(binding) => {
                let asset = scene.textures.get(binding.texture).ok_or(Unsupported("a lost texture"))?;
                let matrix = binding.transform.matrix2.as_dmat2();
                let to = [matrix.x_axis, matrix.y_axis, binding.transform.translation.as_dvec2()];
                let wrap = [binding.sampler.wrap_u, binding.sampler.wrap_v];
                Some(Texels::new(&asset.texture, wrap, to)?)
            }
        };
        Ok(Self { material: material.clone(), texture })
    }

    /// Whether light passes it without a shadow.
    pub(super) fn casts_shadow(&self) -> bool {
        self.material.alpha_mode != AlphaMode::Blend
    }

    /// The colour in linear light, and its alpha.
    pub(super) fn albedo(&self, uv: DVec2) -> DVec4 {
        let factor = self.material.base_color.as_dvec4();
        let color = self.texture.as_ref().map_or(DVec4::ONE, |texture| texture.at(uv)) * factor;
        if self.material.alpha_mode == AlphaMode::Blend { color } else { color.with_w(1.0) }
    }

    /// Whether the light that it reflects from everywhere has no closed form.
    fn needs_integral(&self) -> bool {
        matches!(self.material.shading, Shading::MetallicRoughness(_)) && !self.is_mirror()
    }

    /// Metals without roughness, in which other surfaces are visible.
    pub(super) fn is_mirror(&self) -> bool {
        matches!(&self.material.shading, Shading::MetallicRoughness(model)
            if model.roughness == 0.0 && model.metallic == 1.0)
    }
}

/// A texture as a function of position: the texels, and what is linear between them.
pub(super) struct Texels {
    size: [usize; 2],
    wrap: [Wrap; 2],
    /// Where coordinates are mapped to: the images of both axes and of the origin.
    to: [DVec2; 3],
    values: Vec<DVec4>,
}

impl Texels {
    fn new(texture: &Texture, wrap: [Wrap; 2], to: [DVec2; 3]) -> Result<Self, Unsupported> {
        if wrap.contains(&Wrap::MirroredRepeat) {
            return Err(Unsupported("mirrored textures"));
        }
        let decode = |byte: u8| match texture.format() {
            TextureFormat::Srgb => light_of(byte),
            TextureFormat::Linear => f64::from(byte) / 255.0,
        };
        let value = |[r, g, b, a]: [u8; 4]| DVec4::new(decode(r), decode(g), decode(b), f64::from(a) / 255.0);
        let size = [texture.width(), texture.height()].map(|side| side as usize);
        Ok(Self { size, wrap, to, values: texture.texels().map(value).collect() })
    }

    /// All texels.
    pub(super) fn values(&self) -> &[DVec4] {
        &self.values
    }

    fn at(&self, uv: DVec2) -> DVec4 {
        let [right, down, origin] = self.to;
        let uv = right * uv.x + down * uv.y + origin;
        let axis = |axis: usize| {
            let size = self.size[axis] as f64;
            let middle = uv[axis] * size - 0.5;
            let first = middle.floor();
            let texel = |index: f64| match self.wrap[axis] {
                Wrap::ClampToEdge => index.clamp(0.0, size - 1.0) as usize,
                Wrap::Repeat | Wrap::MirroredRepeat => index.rem_euclid(size) as usize % self.size[axis],
            };
            ([texel(first), texel(first + 1.0)], middle - first)
        };
        let ((columns, right), (rows, down)) = (axis(0), axis(1));
        let row = |row: usize| {
            let [one, other] = columns.map(|column| self.values[row * self.size[0] + column]);
            one + (other - one) * right
        };
        let [top, bottom] = rows.map(row);
        top + (bottom - top) * down
    }
}

/// The light that a byte of sRGB stands for (IEC 61966-2-1, 5.2).
pub(super) fn light_of(byte: u8) -> f64 {
    let value = f64::from(byte) / 255.0;
    if value <= 0.04045 { value / 12.92 } else { elementary::pow((value + 0.055) / 1.055, 2.4) }
}

/// The lamps that a scene is lit by, and its ambient light, as `Lighting::Automatic` describes them.
fn lights(scene: &Scene, eye: &Eye, settings: &RenderSettings) -> (Vec<Lamp>, DVec3) {
    let (mut lamps, mut ambient) = (Vec::new(), DVec3::ZERO);
    let visible = scene.visible_transforms();
    for (id, node) in scene.nodes().iter() {
        let (Some(light), Some(world)) = (&node.light, visible[id.index()]) else { continue };
        let radiance = light.color.as_dvec3() * f64::from(light.intensity);
        let axis = world.transform_vector3(DVec3::Z).normalize_or_zero();
        let point = |cone| Source::Point { at: world.translation, range: light.range.into(), axis, cone };
        let source = match light.kind {
            LightKind::Ambient => {
                ambient += radiance;
                continue;
            }
            LightKind::Directional => Source::Parallel(axis),
            LightKind::Point => point(None),
            LightKind::Spot { inner, outer } => {
                point(Some([inner, outer].map(|angle| elementary::cos(angle.into()))))
            }
        };
        lamps.push(Lamp { radiance, source });
    }
    if lamps.is_empty() && ambient == DVec3::ZERO {
        // The studio, which moves with the camera.
        let lamp = |[x, y, z]: [f64; 3], light: f64| Lamp {
            radiance: DVec3::splat(light),
            source: Source::Parallel(eye.turned(DVec3::new(x, y, z).normalize())),
        };
        lamps = vec![
            lamp([-0.5, 0.55, 0.75], 0.72),
            lamp([0.75, -0.1, 0.65], 0.25),
            lamp([0.25, 0.75, -0.6], 0.25),
        ];
        ambient = DVec3::splat(0.2);
    } else if ambient == DVec3::ZERO {
        ambient = DVec3::splat(0.1);
    }
    let factor = f64::from(settings.light_intensity);
    lamps.iter_mut().for_each(|lamp| lamp.radiance *= factor);
    (lamps, ambient * factor)
}

impl Eye {
    fn new(camera: &Camera, settings: &RenderSettings) -> Result<Self, Unsupported> {
        let size = DVec2::new(settings.width.into(), settings.height.into());
        let (half, is_parallel) = match camera.projection {
            Projection::Perspective { vertical_fov, .. } => (elementary::tan(vertical_fov / 2.0), false),
            Projection::Orthographic { height, .. } => (height / 2.0, true),
            _ => return Err(Unsupported("calibrated cameras")),
        };
        let half = DVec2::new(half * size.x / size.y, half);
        let axes = [DVec3::X, DVec3::Y, DVec3::Z].map(|axis| camera.orientation * axis);
        Ok(Self { position: camera.position, axes, half, is_parallel, size })
    }

    fn turned(&self, vector: impl Into<[f64; 3]>) -> DVec3 {
        let [x, y, z] = vector.into();
        let [right, up, back] = self.axes;
        right * x + up * y + back * z
    }

    /// The origin and the direction, of length 1, of the ray through a point of the image, in pixels from its upper left corner.
    pub(super) fn ray(&self, pixel: DVec2) -> [DVec3; 2] {
        let at = (pixel / self.size * 2.0 - 1.0) * self.half;
        if self.is_parallel {
            [self.position + self.turned([at.x, -at.y, 0.0]), self.turned([0.0, 0.0, -1.0])]
        } else {
            [self.position, self.turned([at.x, -at.y, -1.0]).normalize()]
        }
    }

    /// How far down in the image a point lies, from 0 to 1.
    pub(super) fn down(&self, pixel: DVec2) -> f64 {
        pixel.y / self.size.y
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_of_srgb_are_the_light_of_the_engine() {
        for byte in 0..=255 {
            // Half a unit in the last place of f32, and its own rounding.
            let (own, other) = (light_of(byte), f64::from(trigon_math::color::srgb8_to_linear(byte)));
            assert!((own - other).abs() <= 1.2e-7 * own, "{byte}: {own} and {other}");
        }
    }

    #[test]
    fn texels_are_right_in_their_middles_and_linear_between() {
        let texels = vec![[0, 0, 0, 255], [255, 0, 0, 255], [0, 255, 0, 255], [0, 0, 255, 255]];
        let texture = Texture::new(2, 2, texels, TextureFormat::Linear).unwrap();
        let identity = [DVec2::X, DVec2::Y, DVec2::ZERO];
        let repeated = Texels::new(&texture, [Wrap::Repeat; 2], identity).unwrap();
        assert_eq!(repeated.at(DVec2::new(0.75, 0.25)), DVec4::new(1.0, 0.0, 0.0, 1.0));
        assert_eq!(repeated.at(DVec2::new(-0.25, 7.25)), DVec4::new(1.0, 0.0, 0.0, 1.0), "again");
        assert_eq!(repeated.at(DVec2::new(0.5, 0.25)).x, 0.5, "half way");
        assert_eq!(repeated.at(DVec2::ZERO), DVec4::new(0.25, 0.25, 0.25, 1.0), "across the edge");
        let clamped = Texels::new(&texture, [Wrap::ClampToEdge; 2], identity).unwrap();
        assert_eq!(clamped.at(DVec2::ZERO), DVec4::new(0.0, 0.0, 0.0, 1.0), "but not here");
    }
}
