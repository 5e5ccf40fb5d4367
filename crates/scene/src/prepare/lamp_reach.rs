//! Leaves out lamps that light nothing that is drawn: without light, or with a range or a cone that ends before any lit
//! surface. Their light would be exactly 0 in every pixel, but shadow maps would be drawn for them, and rays cast.
//!
//! What rays may hit counts as drawn. A lamp is only left out if that is certain: bounds of positions that were rounded
//! to f32 are widened.

use trigon_math::{Bounds3, DVec3, Vec3, elementary};

use super::{PreparedScene, has_sight_rays};
use crate::effects::LampPose;
use crate::lighting::Lamp;
use crate::material::Shading;
use crate::node::Node;
use crate::scene::Scene;
use crate::shapes::Shape;
use crate::work::keeps_unseen;

/// By how much of itself a range is widened. The falloff is computed in f32.
const RANGE_MARGIN: f64 = 1e-3;

/// By how much a cone is widened, in radians; likewise.
const CONE_MARGIN: f64 = 2e-3;

/// The error of a position in camera space, as a fraction of its distance from the eye: some roundings to f32.
const POSITION_ERROR: f64 = 1e-5;

/// Ranges above it are no limit: the shader's square of their inverse is too small a number.
const LARGEST_RANGE: f64 = 1e15;

impl PreparedScene<'_> {
    pub(super) fn leave_out_idle_lamps(&mut self) {
        if keeps_unseen() {
            return;
        }
        let before = self.lights.lamps.len();
        self.lights.lamps.retain(|lamp| lamp.radiance != Vec3::ZERO);
        let shining = self.lights.lamps.len();
        let idle = self.out_of_reach();
        let mut number = 0..;
        self.lights.lamps.retain(|_| number.next().is_none_or(|number| !idle.contains(&number)));
        self.lights.idle.dark = before - shining;
        self.lights.idle.out_of_reach = idle.len();
    }

    /// The lamps that reach no lit surface, by their numbers.
    fn out_of_reach(&self) -> Vec<usize> {
        let limited = |(number, lamp)| Some((number, LampReach::new(self, lamp)?));
        let mut waiting: Vec<(usize, LampReach)> =
            self.lights.lamps.iter().enumerate().filter_map(limited).collect();
        let is_met_by_rays = has_sight_rays(self.scene, self.settings.effects.sight);
        for (id, node) in self.scene.nodes().iter() {
            if waiting.is_empty() {
                break;
            }
            let shape = self.shapes.get(id.index());
            let is_visible = |shape: &&Shape| is_met_by_rays || self.may_show(shape);
            let Some(shape) = shape.filter(|shape| is_lit(self.scene, node, shape)).filter(is_visible) else {
                continue;
            };
            let bounds = shape.geometry.bounds().transformed(&shape.world);
            waiting.retain(|(_, reach)| !reach.may_light(&bounds));
        }
        waiting.into_iter().map(|(number, _)| number).collect()
    }
}

/// Whether a shape shows light.
fn is_lit(scene: &Scene, node: &Node, shape: &Shape) -> bool {
    let is_lit = |slot: u32| {
        let material = node.materials.get(slot as usize).and_then(|&id| scene.materials.get(id));
        material.is_none_or(|material| material.shading != Shading::Unlit)
    };
    shape.geometry.runs.iter().any(|run| is_lit(run.slot))
}

/// Where the light of a lamp ends, in the world.
struct LampReach {
    position: DVec3,
    /// In metres; infinite without a limit.
    range: f64,
    cone: Option<ConeReach>,
    eye: DVec3,
}

/// A cone up to half a space.
struct ConeReach {
    axis: DVec3,
    /// Of its angle from the axis.
    sine: f64,
    cosine: f64,
}

impl LampReach {
    /// `None` for a lamp that shines everywhere.
    fn new(prepared: &PreparedScene<'_>, lamp: &Lamp) -> Option<Self> {
        let LampPose::Point { position, cone } = prepared.pose(lamp) else { return None };
        let range = f64::from(prepared.light(lamp)?.range);
        let is_limit = range > 0.0 && range < LARGEST_RANGE;
        let range = if is_limit { range } else { f64::INFINITY };
        let cone = cone.and_then(|(axis, half)| ConeReach::new(axis, half));
        let eye = prepared.camera_to_world.translation;
        (is_limit || cone.is_some()).then_some(Self { position, range, cone, eye })
    }

    /// Whether light may arrive anywhere in a box.
    fn may_light(&self, bounds: &Bounds3) -> bool {
        let (Some(center), half) = (bounds.center(), bounds.size() * 0.5) else { return false };
        let largest_distance = center.distance(self.eye) + half.length() + self.position.distance(self.eye);
        let slack = POSITION_ERROR * largest_distance;
        let offset = center - self.position;
        let beyond = (offset.abs() - half).map(|gap| if gap > 0.0 { gap } else { 0.0 }).length();
        let is_far = beyond > self.range * (1.0 + RANGE_MARGIN) + slack;
        !is_far && self.cone.as_ref().is_none_or(|cone| cone.may_contain(offset, half, slack))
    }
}

impl ConeReach {
    /// `None` for a cone without an axis, with an angle that no cone has, or so wide that no plane touches it.
    fn new(axis: DVec3, half_angle: f64) -> Option<Self> {
        let angle = half_angle + CONE_MARGIN;
        // The formula of the light goes on with the cosine of an angle below 0, however large.
        let is_one = axis != DVec3::ZERO && half_angle >= 0.0 && angle < std::f64::consts::FRAC_PI_2;
        let (sine, cosine) = elementary::sin_cos(angle);
        is_one.then_some(Self { axis, sine, cosine })
    }

    /// Whether a part of a box may be inside, whose centre is so far from the apex. It is not where a plane through the
    /// apex that touches the cone has the whole box on its other side.
    fn may_contain(&self, center: DVec3, half: DVec3, slack: f64) -> bool {
        let aside = (center - self.axis * center.dot(self.axis)).normalize_or_zero();
        let planes = [-self.axis, aside * self.cosine - self.axis * self.sine];
        !planes.iter().any(|outwards| outwards.dot(center) - outwards.abs().dot(half) > slack)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point_lamp(range: f64, cone: Option<ConeReach>) -> LampReach {
        LampReach { position: DVec3::ZERO, range, cone, eye: DVec3::Z * 10.0 }
    }

    fn cube_at(center: DVec3) -> Bounds3 {
        Bounds3 { min: center - DVec3::ONE, max: center + DVec3::ONE }
    }

    #[test]
    fn a_range_ends_at_the_nearest_point_of_a_box() {
        let lamp = point_lamp(2.0, None);
        assert!(lamp.may_light(&cube_at(DVec3::X * 2.9)), "1.9 m away");
        assert!(!lamp.may_light(&cube_at(DVec3::X * 3.1)), "2.1 m away");
        // Its nearest corner is √3 · 1.1 m away, the centre √3 · 2.1 m.
        assert!(lamp.may_light(&cube_at(DVec3::splat(2.1))), "1.9 m away");
        assert!(!lamp.may_light(&cube_at(DVec3::splat(2.2))), "2.08 m away");
        assert!(!lamp.may_light(&Bounds3::EMPTY), "nothing is there");
    }

    #[test]
    fn a_cone_ends_at_its_sides_and_behind_the_lamp() {
        // 45° around −Z.
        let lamp = || point_lamp(f64::INFINITY, ConeReach::new(DVec3::NEG_Z, std::f64::consts::FRAC_PI_4));
        let may_light = |center: DVec3| lamp().may_light(&cube_at(center));
        assert!(may_light(DVec3::NEG_Z * 5.0), "in front");
        assert!(!may_light(DVec3::Z * 5.0), "behind");
        assert!(may_light(DVec3::Z * 0.9), "around it");
        // The nearest corner in x is at (x − 1, −z = 6).
        assert!(may_light(DVec3::new(6.9, 0.0, -5.0)), "a corner is inside");
        assert!(!may_light(DVec3::new(7.1, 0.0, -5.0)), "none is");
        for angle in [1.6, -7.8e18, -0.1, f64::NAN] {
            assert!(ConeReach::new(DVec3::NEG_Z, angle).is_none(), "{angle} is none that a plane touches");
        }
    }

    #[test]
    fn numbers_that_are_none_are_no_proof() {
        let nowhere = Bounds3 { min: DVec3::splat(f64::NEG_INFINITY), max: DVec3::splat(f64::INFINITY) };
        assert!(point_lamp(1.0, None).may_light(&nowhere), "everywhere");
        let astray = LampReach { position: DVec3::NAN, ..point_lamp(1.0, None) };
        assert!(astray.may_light(&cube_at(DVec3::ZERO)), "nobody knows where");
    }
}
