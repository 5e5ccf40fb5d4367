//! The view of a lamp's map, fitted to the casters.

use trigon_camera::{Camera, Projection};
use trigon_math::{Bounds3, DMat4, DVec3, elementary};

use super::LampPose;
use crate::effects::casters::Casters;

/// The widest cone (radians, the whole angle) that one view covers; wider ones would waste most
/// texels on their edges.
const WIDEST: f64 = 2.2;

/// A lamp's camera.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct View {
    pub(crate) camera: Camera,
    /// Width over height.
    pub(crate) aspect: f64,
    /// Its width in metres where w is 1, in its longer direction.
    pub(crate) width_at_one: f64,
}

impl View {
    /// From the world to clip space.
    pub(crate) fn world_to_clip(&self) -> DMat4 {
        self.camera.view_projection(self.aspect)
    }
}

/// The views of a lamp; none if there is nothing that it could see.
pub(crate) fn views(pose: &LampPose, casters: &Casters) -> Vec<View> {
    if casters.bounds.is_empty() {
        return Vec::new();
    }
    match *pose {
        LampPose::Directional(along) => parallel(along, casters).into_iter().collect(),
        LampPose::Point { position, cone: Some((along, half)) } if 2.0 * half < WIDEST => {
            // Slightly wider, so that the edge has neighbours.
            meeting(position, along, 2.0 * half + 0.02, &casters.bounds).into_iter().collect()
        }
        LampPose::Point { position, .. } => {
            let sides = [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|axis| [axis, -axis]);
            let quarter = std::f64::consts::FRAC_PI_2;
            sides.filter_map(|along| meeting(position, along, quarter, &casters.bounds)).collect()
        }
    }
}

/// Parallel rays through the box of all casters, seen along them.
fn parallel(along: DVec3, casters: &Casters) -> Option<View> {
    let turned = Camera::look_at(DVec3::ZERO, along, DVec3::Y);
    let mut extent = Bounds3::EMPTY;
    for bounds in casters.boxes() {
        bounds.corners().into_iter().for_each(|corner| extent.include(turned.to_camera(corner)));
    }
    let (middle, size) = (extent.center()?, extent.size());
    // A flat caster still has two sides, and no caster lies at the ends.
    let margin = 1e-3 * size.length() + 1e-30;
    let (width, height, depth) = (size.x + margin, size.y + margin, size.z / 2.0 + margin);
    let projection = Projection::orthographic(height, -depth, depth).ok()?;
    let camera = Camera { position: turned.to_world(middle), projection, ..turned };
    let width_at_one = if width > height { width } else { height };
    Some(View { camera, aspect: width / height, width_at_one })
}

/// Rays that meet in the lamp.
fn meeting(position: DVec3, along: DVec3, angle: f64, casters: &Bounds3) -> Option<View> {
    /// Objects down to this fraction of the farthest caster's distance cast shadows. Reversed depth is as exact however
    /// small it is; f32 still holds it where the farthest caster is 10⁻¹⁹ m away. A power of two times what it once was:
    /// depths that it only scales compare as they did.
    const NEAREST: f64 = 1e-4 / (1_u64 << 46) as f64;
    let farthest = casters.corners().into_iter().map(|corner| corner.distance(position));
    let farthest = farthest.fold(0.0, |far, distance| if distance > far { distance } else { far });
    let projection = Projection::perspective(angle, farthest * NEAREST, None).ok()?;
    let camera = Camera { projection, ..Camera::look_at(position, position + along, DVec3::Y) };
    Some(View { camera, aspect: 1.0, width_at_one: 2.0 * elementary::tan(angle * 0.5) })
}
