//! The lights of a scene, as they arrive at points in the world: in f64, by the formulas of
//! [`Light`](crate::Light).

use trigon_math::{DAffine3, DVec3};

use crate::light::{Light, LightKind};
use crate::scene::Scene;

/// All lights of a scene.
pub(super) struct Lamps {
    ambient: DVec3,
    lamps: Vec<MeteredLamp>,
}

struct MeteredLamp {
    light: Light,
    position: DVec3,
    /// The unit vector against the direction in which it shines.
    backwards: DVec3,
    /// See [`Light::cone`].
    cone: (f64, f64),
}

impl Lamps {
    /// Those at visible nodes; `None` if there are none but ambient lights.
    pub(super) fn of(scene: &Scene, transforms: &[Option<DAffine3>]) -> Option<Self> {
        let mut all = Self { ambient: DVec3::ZERO, lamps: Vec::new() };
        for (id, node) in scene.nodes().iter() {
            let (Some(light), Some(world)) = (node.light, &transforms[id.index()]) else { continue };
            if light.kind == LightKind::Ambient {
                all.ambient += light.radiance().as_dvec3();
            } else {
                all.lamps.push(MeteredLamp::new(light, world));
            }
        }
        (!all.lamps.is_empty()).then_some(all)
    }

    /// The value of a white matt surface with a unit normal: that of the side that is lit more, by its
    /// brightest channel.
    pub(super) fn white(&self, position: DVec3, normal: DVec3) -> f64 {
        let [mut front, mut back] = [self.ambient; 2];
        for lamp in &self.lamps {
            let (towards, share) = lamp.arriving(position);
            let cosine = normal.dot(towards);
            let light = lamp.light.radiance().as_dvec3() * (share * cosine.abs());
            if cosine > 0.0 { front += light } else { back += light }
        }
        let [front, back] = [front.max_element(), back.max_element()];
        if front > back { front } else { back }
    }
}

impl MeteredLamp {
    fn new(light: Light, world: &DAffine3) -> Self {
        let backwards = world.transform_vector3(DVec3::Z).normalize_or_zero();
        let (scale, offset) = light.cone();
        let cone = (f64::from(scale), f64::from(offset));
        Self { light, position: world.translation, backwards, cone }
    }

    /// The unit vector towards the lamp, and the fraction of its light that arrives.
    fn arriving(&self, position: DVec3) -> (DVec3, f64) {
        if self.light.kind == LightKind::Directional {
            return (self.backwards, 1.0);
        }
        let offset = self.position - position;
        let towards = offset.normalize_or_zero();
        let (scale, end) = self.cone;
        let linear = (self.backwards.dot(towards) * scale + end).clamp(0.0, 1.0);
        (towards, f64::from(self.light.falloff(offset.length_squared() as f32)) * (linear * linear))
    }
}
