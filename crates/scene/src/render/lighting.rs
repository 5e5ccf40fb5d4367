//! The lights of a picture, in camera space, and what they make of a surface.
//!
//! Gathered once per picture. Shading happens relative to the camera in f32:
//! differences of large world coordinates never appear.

use trigon_math::{DAffine3, DVec3, Vec3, elementary};

use super::placement::Eye;
use crate::light::{Light, LightKind};
use crate::material::Shading;
use crate::scene::Scene;
use crate::settings::Lighting;

/// Parallel light in camera space.
struct Directional {
    /// Unit vector towards the light.
    towards: Vec3,
    radiance: Vec3,
}

/// Light from a point in camera space.
struct Point {
    position: Vec3,
    radiance: Vec3,
}

/// The light from everywhere in the studio: enough to see shapes in the shade.
const STUDIO_AMBIENT: Vec3 = Vec3::splat(0.1);

/// All lights of a picture.
#[derive(Default)]
pub(super) struct Lights {
    ambient: Vec3,
    directional: Vec<Directional>,
    point: Vec<Point>,
}

impl Lights {
    /// The lights that the settings and the scene call for. `transforms` is
    /// the scene's table of visible nodes.
    pub(super) fn gather(
        scene: &Scene,
        transforms: &[Option<DAffine3>],
        eye: &Eye,
        lighting: Lighting,
    ) -> Self {
        let mut lights = Self::default();
        if lighting != Lighting::Studio {
            for (id, node) in scene.nodes().iter() {
                if let (Some(light), Some(world)) = (&node.light, &transforms[id.index()]) {
                    lights.add(light, &eye.to_camera(world));
                }
            }
        }
        match lighting {
            Lighting::Studio => return Self::studio(),
            Lighting::Automatic if lights.is_dark() => return Self::studio(),
            // Formats such as glTF know no ambient light; without any, the sides
            // that no light reaches would be black holes.
            Lighting::Automatic if lights.ambient == Vec3::ZERO => lights.ambient = STUDIO_AMBIENT,
            Lighting::Automatic | Lighting::Scene => {}
        }
        lights
    }

    fn is_dark(&self) -> bool {
        self.ambient == Vec3::ZERO && self.directional.is_empty() && self.point.is_empty()
    }

    /// A key light from the upper left, a weak fill from the right, a rim
    /// light from behind, and a little light from everywhere. All of it moves
    /// with the camera, so that no side of a model is ever dark.
    fn studio() -> Self {
        let light = |x: f32, y: f32, z: f32, radiance: f32| Directional {
            towards: Vec3::new(x, y, z).normalize(),
            radiance: Vec3::splat(radiance),
        };
        Self {
            ambient: STUDIO_AMBIENT,
            directional: vec![
                light(-0.55, 0.65, 0.55, 0.78),
                light(0.85, 0.05, 0.5, 0.16),
                light(0.25, 0.75, -0.6, 0.25),
            ],
            point: Vec::new(),
        }
    }

    /// Every light this many times as bright; a factor that is no positive
    /// number puts them out.
    pub(super) fn scaled(mut self, factor: f32) -> Self {
        let factor = if factor > 0.0 && factor.is_finite() { factor } else { 0.0 };
        self.ambient *= factor;
        self.directional.iter_mut().for_each(|light| light.radiance *= factor);
        self.point.iter_mut().for_each(|light| light.radiance *= factor);
        self
    }

    fn add(&mut self, light: &Light, to_camera: &DAffine3) {
        let radiance = light.radiance();
        match light.kind {
            LightKind::Ambient => self.ambient += radiance,
            LightKind::Directional => {
                let towards = to_camera.transform_vector3(DVec3::Z).normalize_or_zero().as_vec3();
                self.directional.push(Directional { towards, radiance });
            }
            LightKind::Point | LightKind::Spot { .. } => {
                self.point.push(Point { position: to_camera.translation.as_vec3(), radiance });
            }
        }
    }

    /// The light that a surface sends to the camera. `normal` and `view` are
    /// unit vectors (or zero, which no light reaches), `position` lies on the
    /// surface; all in camera space.
    #[inline]
    pub(super) fn shade(&self, surface: &LitPoint, albedo: Vec3, shading: &Shading) -> Vec3 {
        let mut sum = self.ambient * albedo;
        for light in &self.directional {
            sum += light.radiance * reflectance(surface, light.towards, albedo, shading);
        }
        for light in &self.point {
            let offset = light.position - surface.position;
            let squared = offset.length_squared();
            // A light on the surface itself, or infinitely far, has no direction.
            if squared > 0.0 && squared.is_finite() {
                let towards = offset / squared.sqrt();
                sum += light.radiance / squared * reflectance(surface, towards, albedo, shading);
            }
        }
        sum
    }
}

/// A point of a surface, in camera space.
pub(super) struct LitPoint {
    pub(super) position: Vec3,
    /// Unit length, or zero.
    pub(super) normal: Vec3,
    /// Unit vector towards the camera.
    pub(super) view: Vec3,
}

/// What part of the light from one direction the surface sends to the camera,
/// N·L included.
#[inline]
fn reflectance(surface: &LitPoint, towards: Vec3, albedo: Vec3, shading: &Shading) -> Vec3 {
    let cosine = surface.normal.dot(towards);
    if cosine.is_nan() || cosine <= 0.0 {
        return Vec3::ZERO;
    }
    match *shading {
        Shading::BlinnPhong { specular, shininess, .. } => {
            let half = (towards + surface.view).normalize_or_zero();
            let facing = surface.normal.dot(half);
            let highlight = if facing > 0.0 { elementary::pow_f32(facing, shininess) } else { 0.0 };
            (albedo + specular * highlight) * cosine
        }
        Shading::Lambert | Shading::Unlit | Shading::MetallicRoughness(_) => albedo * cosine,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facing() -> LitPoint {
        LitPoint { position: Vec3::new(0.0, 0.0, -2.0), normal: Vec3::Z, view: Vec3::Z }
    }

    #[test]
    fn a_white_surface_head_on_shows_the_intensity() {
        let mut lights = Lights::default();
        lights.add(&Light::directional(0.5), &DAffine3::IDENTITY);
        assert_eq!(lights.shade(&facing(), Vec3::ONE, &Shading::Lambert), Vec3::splat(0.5), "directional");
        let mut lights = Lights::default();
        lights.add(&Light::point(1.0), &DAffine3::IDENTITY);
        assert_eq!(
            lights.shade(&facing(), Vec3::ONE, &Shading::Lambert),
            Vec3::splat(0.25),
            "a quarter at two metres"
        );
    }

    #[test]
    fn intensity_is_a_factor_for_every_light() {
        let shown = |factor| Lights::studio().scaled(factor).shade(&facing(), Vec3::ONE, &Shading::Lambert);
        assert_eq!(shown(2.0), shown(1.0) * 2.0, "twice as bright");
        assert_eq!(shown(f32::NAN), Vec3::ZERO, "no number, no light");
    }

    #[test]
    fn a_light_on_the_surface_gives_no_nan() {
        let mut lights = Lights::default();
        lights.add(&Light::point(1.0), &DAffine3::from_translation(DVec3::new(0.0, 0.0, -2.0)));
        assert_eq!(
            lights.shade(&facing(), Vec3::ONE, &Shading::Lambert),
            Vec3::ZERO,
            "no direction, no light"
        );
    }

    #[test]
    fn light_from_behind_does_not_reach_the_surface() {
        let mut lights = Lights::default();
        let turned = DAffine3::from_quat(trigon_math::DQuat::from_xyzw(0.0, 1.0, 0.0, 0.0));
        lights.add(&Light::directional(1.0), &turned);
        assert_eq!(lights.shade(&facing(), Vec3::ONE, &Shading::Lambert), Vec3::ZERO, "from behind");
    }
}
