//! Cameras that a scene suggests: where to stand to see all of it.

use trigon_camera::{Camera, DEFAULT_MARGIN};
use trigon_math::{DVec3, Vec3};

use crate::scene::{MeshAsset, Scene};

/// Where the overview looks: down from the upper right, in front.
pub const OVERVIEW_DIRECTION: DVec3 = DVec3::new(-1.0, -0.5, -1.0);

impl Scene {
    /// A perspective camera that sees everything visible from the upper right
    /// in front, with +Y up and a tenth of the picture left free. `aspect` is
    /// width over height.
    pub fn overview(&self, aspect: f64) -> Camera {
        let points = self.visible_points();
        Camera::default().fit_points(&points, OVERVIEW_DIRECTION, DVec3::Y, aspect, DEFAULT_MARGIN)
    }

    /// The vertices of everything visible, in the world, without those that no
    /// face, edge or point uses: what a camera is fitted to.
    pub fn visible_points(&self) -> Vec<DVec3> {
        let transforms = self.visible_transforms();
        let mut points = Vec::new();
        for (id, node) in self.nodes().iter() {
            let (Some(world), Some(mesh)) = (&transforms[id.index()], node.mesh) else { continue };
            let Some(mesh) = self.meshes().get(mesh).map(MeshAsset::mesh) else { continue };
            let placed =
                |(point, used): (&Vec3, bool)| used.then(|| world.transform_point3(point.as_dvec3()));
            points.extend(mesh.positions().iter().zip(mesh.used_vertices()).filter_map(placed));
        }
        points
    }
}
