//! A finished frame: its image, and the other requested outputs.

use std::fmt;

use trigon_camera::{Camera, CameraAxes};
use trigon_math::{DVec3, Vec2, Vec3, Vec4};
use trigon_raster::TargetError;

use crate::arena::Arena;
use crate::node::Node;
use crate::node::NodeId;
use crate::settings::RenderSettings;

/// A finished frame. Rows run from the top, pixels from the left.
#[derive(Clone, Default, PartialEq)]
pub struct Frame {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes per pixel: sRGB and straight (not premultiplied) alpha. Empty if not requested.
    pub color: Vec<u8>,
    /// Linear RGB, premultiplied with alpha, which is the fourth number: 1 is the display's white,
    /// and light may be brighter. Before exposure and tone mapping, on the background.
    pub radiance: Option<Vec<Vec4>>,
    /// Distance from the camera along its view axis in metres, infinite where nothing was drawn; through a fisheye lens,
    /// which sees beyond 90°, the distance from the eye itself.
    /// Taken at the sample in the middle of the pixel, or with an even number of samples per axis
    /// at the one to the right and below of the middle.
    pub depth: Option<Vec<f32>>,
    /// Index of the node, `u32::MAX` where nothing was drawn. Taken at the same sample as the
    /// depth, never averaged. Translucent surfaces write no id, unless
    /// [`Outputs::of_blended`](crate::Outputs::of_blended) requests it.
    pub object_ids: Option<Vec<u32>>,
    /// Index of the polygon in its mesh, `u32::MAX` where nothing was drawn.
    pub face_ids: Option<Vec<u32>>,
    /// Index of the material in the scene, `u32::MAX` where no face was drawn or it has no
    /// material. This and all following outputs belong to faces: lines and points write the same
    /// values as the background.
    pub material_ids: Option<Vec<u32>>,
    /// Index of the triangle in the mesh's
    /// [`triangulation`](trigon_mesh::Mesh::triangulation), `u32::MAX` where no face
    /// was drawn.
    pub triangle_ids: Option<Vec<u32>>,
    /// The barycentrics of the point in that triangle, in the order of its corners: at least 0,
    /// with sum 1 up to rounding. All 0 where no face was drawn. If a pixel shows the triangle only
    /// because vertices are snapped to the sub-pixel grid, these are the barycentrics of the
    /// nearest point of the triangle.
    pub barycentrics: Option<Vec<Vec3>>,
    /// The position on the surface, in metres along the world's axes from
    /// [`Outputs::origin`](crate::Outputs::origin); computed in f64 and rounded once. All 0 where
    /// no face was drawn.
    pub positions: Option<Vec<Vec3>>,
    /// [`Outputs::origin`](crate::Outputs::origin), to which positions are added for those in the world.
    pub origin: DVec3,
    /// Shading normals, unit vectors in world space: interpolated, perturbed by the material's
    /// normal map, and flipped for back faces. All 0 where no face was drawn.
    pub normals: Option<Vec<Vec3>>,
    /// Geometric normals, unit vectors in world space: perpendicular to the triangle, on the
    /// visible side. All 0 where no face was drawn, and for triangles without area.
    pub geometric_normals: Option<Vec<Vec3>>,
    /// Coordinates of the first UV set, v downwards, before any texture's transform.
    /// All 0 where no face was drawn or the mesh has none.
    pub uvs: Option<Vec<Vec2>>,
    /// Linear RGB: base colour times texture times vertex colour, with the texture filtered over a
    /// whole pixel. All 0 where no face was drawn.
    pub albedo: Option<Vec<Vec3>>,
}

/// What a pixel shows.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Hit {
    /// The node.
    pub node: NodeId,
    /// Index of the polygon in the node's mesh; `None` for lines and points.
    pub face: Option<usize>,
}

impl fmt::Debug for Frame {
    /// Prints the size and the outputs present, not a million numbers.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Frame")
            .field("width", &self.width)
            .field("height", &self.height)
            .field("depth", &self.depth.is_some())
            .field("ids", &self.object_ids.is_some())
            .field("positions", &self.positions.is_some())
            .finish_non_exhaustive()
    }
}

impl Frame {
    /// Red, green, blue and alpha of a pixel.
    ///
    /// # Panics
    /// The pixel is outside the image, or the colour was not requested.
    #[must_use]
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let at = 4 * self.index(x, y);
        [self.color[at], self.color[at + 1], self.color[at + 2], self.color[at + 3]]
    }

    /// What a pixel shows, in constant time: `None` for background, outside the image, and if ids
    /// were not requested.
    #[must_use]
    pub fn hit(&self, nodes: &Arena<Node>, x: u32, y: u32) -> Option<Hit> {
        if x >= self.width || y >= self.height {
            return None;
        }
        let at = self.index(x, y);
        let object = self.object_ids.as_ref()?[at];
        let node = nodes.id_at(object as usize)?;
        let face = self.face_ids.as_ref().map(|ids| ids[at]).filter(|&face| face != u32::MAX);
        Some(Hit { node, face: face.map(|face| face as usize) })
    }

    /// The normals along the axes of the camera that drew the frame, as networks for depth and normals are trained with:
    /// with [`CameraAxes::OpenGl`] a surface that faces the camera has (0, 0, 1), with [`CameraAxes::OpenCv`] (0, 0, −1).
    /// All 0 where no face was drawn; `None` if normals were not requested.
    #[must_use]
    pub fn camera_normals(&self, camera: &Camera, axes: CameraAxes) -> Option<Vec<Vec3>> {
        let to_camera = camera.extrinsics(axes).matrix3;
        let turned = |normal: &Vec3| (to_camera * normal.as_dvec3()).as_vec3();
        Some(self.normals.as_ref()?.iter().map(turned).collect())
    }

    /// Allocates the requested outputs, reusing existing memory.
    pub(crate) fn allocate(&mut self, settings: &RenderSettings) -> Result<(), TargetError> {
        let RenderSettings { width, height, outputs, .. } = *settings;
        (self.width, self.height, self.origin) = (width, height, outputs.origin);
        let pixels = width as usize * height as usize;
        let full = TargetError::Memory { width, height };
        let bytes = if outputs.color { 4 * pixels } else { 0 };
        resize(&mut self.color, bytes, 0).ok_or(full)?;
        resize_optional(&mut self.radiance, outputs.radiance, pixels, Vec4::ZERO).ok_or(full)?;
        resize_optional(&mut self.depth, outputs.depth, pixels, 0.0).ok_or(full)?;
        for (ids, wanted) in [
            (&mut self.object_ids, outputs.ids),
            (&mut self.face_ids, outputs.ids),
            (&mut self.material_ids, outputs.material_ids),
            (&mut self.triangle_ids, outputs.triangle_ids),
        ] {
            resize_optional(ids, wanted, pixels, u32::MAX).ok_or(full)?;
        }
        for (vectors, wanted) in [
            (&mut self.barycentrics, outputs.barycentrics),
            (&mut self.positions, outputs.positions),
            (&mut self.normals, outputs.normals),
            (&mut self.geometric_normals, outputs.geometric_normals),
            (&mut self.albedo, outputs.albedo),
        ] {
            resize_optional(vectors, wanted, pixels, Vec3::ZERO).ok_or(full)?;
        }
        resize_optional(&mut self.uvs, outputs.uvs, pixels, Vec2::ZERO).ok_or(full)
    }

    fn index(&self, x: u32, y: u32) -> usize {
        assert!(
            x < self.width && y < self.height,
            "pixel ({x}, {y}) is outside {}×{}",
            self.width,
            self.height
        );
        y as usize * self.width as usize + x as usize
    }
}

/// Sets a list's length; `None` if memory is exhausted.
pub(crate) fn resize<T: Clone>(list: &mut Vec<T>, length: usize, value: T) -> Option<()> {
    list.try_reserve_exact(length.saturating_sub(list.len())).ok()?;
    list.resize(length, value);
    Some(())
}

/// The same for an optional list.
fn resize_optional<T: Clone>(list: &mut Option<Vec<T>>, wanted: bool, length: usize, value: T) -> Option<()> {
    if !wanted {
        *list = None;
        return Some(());
    }
    resize(list.get_or_insert_default(), length, value)
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;
    use crate::{Material, Scene, render};

    /// Against the camera's own axes.
    #[test]
    fn normals_of_a_camera_are_along_its_axes() {
        let mut scene = Scene::new();
        scene.add_object("cube", primitives::cube(1.0), Material::default());
        let camera = Camera::look_at(DVec3::new(2.0, 3.0, 4.0), DVec3::ZERO, DVec3::Y);
        let mut settings = RenderSettings::new(24, 18);
        settings.outputs.normals = true;
        let frame = render(&scene, &camera, &settings).expect("a cube");
        let [gl, cv] = [CameraAxes::OpenGl, CameraAxes::OpenCv]
            .map(|axes| frame.camera_normals(&camera, axes).expect("normals"));
        let normals = frame.normals.as_ref().expect("normals");
        let mut sides = 0;
        for ((normal, gl), cv) in normals.iter().zip(gl).zip(cv) {
            let world = normal.as_dvec3();
            let expected =
                DVec3::new(world.dot(camera.right()), world.dot(camera.up()), -world.dot(camera.forward()));
            assert!((gl.as_dvec3() - expected).length() < 1e-6, "{gl} and {expected}: f32 has 24 bits");
            assert_eq!(cv, Vec3::new(gl.x, -gl.y, -gl.z), "Y down, Z forward");
            sides += u32::from(gl.z > 0.0);
        }
        assert!(sides > 50, "the cube is in view");
        assert_eq!(Frame::default().camera_normals(&camera, CameraAxes::OpenGl), None, "not requested");
    }
}
