//! Mirror modifiers with clipping: vertices on a plane of symmetry stay on it, and others stay on their side.

use trigon_math::Vec3;

use crate::edit_mesh::EditMesh;
use crate::modifier::Modifier;

/// For each axis, how far from its plane a vertex still counts as on it, in metres; `None` without clipping.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Clip([Option<f64>; 3]);

impl Clip {
    /// That of the modifiers of a mesh that are on.
    pub(super) fn of(mesh: &EditMesh) -> Self {
        let mut clip = Self::default();
        for stacked in mesh.modifiers.iter().filter(|stacked| stacked.is_on) {
            let Modifier::Mirror(mirror) = &stacked.modifier else { continue };
            for (axis, near) in clip.0.iter_mut().enumerate().filter(|_| mirror.clip) {
                if mirror.axes[axis] {
                    let distance = mirror.merge_distance.unwrap_or(0.0);
                    *near = Some(near.map_or(distance, |near: f64| near.max(distance)));
                }
            }
        }
        clip
    }

    pub(super) fn is_needed(&self) -> bool {
        self.0.iter().any(Option::is_some)
    }

    /// Where a vertex goes that would move from one position to another.
    pub(super) fn clipped(&self, from: Vec3, to: Vec3) -> Vec3 {
        let mut clipped = to;
        for (axis, near) in self.0.iter().enumerate() {
            let Some(near) = near else { continue };
            let (from, to) = (f64::from(from[axis]), f64::from(to[axis]));
            if from.abs() <= *near || from * to < 0.0 {
                clipped[axis] = 0.0;
            }
        }
        clipped
    }
}
