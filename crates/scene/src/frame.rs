//! A finished picture, owned, with what was asked for beside the colours.

use std::fmt;

use trigon_math::{Vec2, Vec3, Vec4};
use trigon_raster::TargetError;

use crate::arena::Arena;
use crate::node::Node;
use crate::node::NodeId;
use crate::settings::RenderSettings;

/// A finished picture. Rows run from the top, pixels from the left.
#[derive(Clone, Default, PartialEq)]
pub struct Frame {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes a pixel: sRGB and straight (not premultiplied) alpha. Empty when
    /// it was not asked for.
    pub color: Vec<u8>,
    /// Linear RGB, premultiplied with alpha, which is the fourth number: 1 is what the
    /// display shows as white, and light may be brighter. Before exposure and tone
    /// mapping, on the background.
    pub radiance: Option<Vec<Vec4>>,
    /// Distance from the camera along its view axis in metres, infinite where
    /// nothing was drawn. Taken at the sample in the middle of the pixel, or with
    /// an even number of samples per axis at the one right and below of it.
    pub depth: Option<Vec<f32>>,
    /// Index of the node, `u32::MAX` where nothing was drawn. Taken at the same
    /// sample as the depth, never mixed. What is translucent leaves no id, unless
    /// [`Outputs::of_blended`](crate::Outputs::of_blended) asks for it.
    pub object_ids: Option<Vec<u32>>,
    /// Index of the polygon in its mesh, `u32::MAX` where nothing was drawn.
    pub face_ids: Option<Vec<u32>>,
    /// Index of the material in the scene, `u32::MAX` where no face was drawn or
    /// it has none. This and all that follows is of faces: lines and points leave
    /// in it what the background does.
    pub material_ids: Option<Vec<u32>>,
    /// Index of the triangle in the mesh's
    /// [`triangulation`](trigon_mesh::Mesh::triangulation), `u32::MAX` where no face
    /// was drawn.
    pub triangle_ids: Option<Vec<u32>>,
    /// The shares of that triangle's corners, in their order: at least 0, together 1
    /// but for rounding. All 0 where no face was drawn. Of a pixel that is seen only
    /// because vertices are moved to the sub-pixel grid, those of the nearest point
    /// of the triangle.
    pub barycentrics: Option<Vec<Vec3>>,
    /// The point of the surface, in metres along the world's axes from
    /// [`Outputs::origin`](crate::Outputs::origin); computed in f64 and rounded once.
    /// All 0 where no face was drawn.
    pub positions: Option<Vec<Vec3>>,
    /// Unit vectors of the world: interpolated, bent by the material's normal map,
    /// and turned over where a back is seen, as light finds them. All 0 where no
    /// face was drawn.
    pub normals: Option<Vec<Vec3>>,
    /// Unit vectors of the world: across the triangle's plane, to the side that is
    /// seen. All 0 where no face was drawn, and of triangles without area.
    pub geometric_normals: Option<Vec<Vec3>>,
    /// Coordinates of the first UV set, v downwards, before any texture's transform.
    /// All 0 where no face was drawn or the mesh has none.
    pub uvs: Option<Vec<Vec2>>,
    /// Linear RGB: base colour times texture times vertex colour; the texture
    /// filtered over a whole pixel. All 0 where no face was drawn.
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
    /// The size and what there is, not a million numbers.
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
    /// Outside the picture, and when the colour was not asked for.
    pub fn pixel(&self, x: u32, y: u32) -> [u8; 4] {
        let at = 4 * self.index(x, y);
        [self.color[at], self.color[at + 1], self.color[at + 2], self.color[at + 3]]
    }

    /// What a pixel shows, in constant time: `None` for background, outside
    /// the picture, and when ids were not asked for.
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

    /// Makes room for what a picture is to hold, in the memory that is there.
    pub(crate) fn make_room(&mut self, settings: &RenderSettings) -> Result<(), TargetError> {
        let RenderSettings { width, height, outputs, .. } = *settings;
        (self.width, self.height) = (width, height);
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

/// Gives a list a length; `None` without memory.
pub(crate) fn resize<T: Clone>(list: &mut Vec<T>, length: usize, value: T) -> Option<()> {
    list.try_reserve_exact(length.saturating_sub(list.len())).ok()?;
    list.resize(length, value);
    Some(())
}

/// The same for a list that is there only when it is wanted.
fn resize_optional<T: Clone>(list: &mut Option<Vec<T>>, wanted: bool, length: usize, value: T) -> Option<()> {
    if !wanted {
        *list = None;
        return Some(());
    }
    resize(list.get_or_insert_default(), length, value)
}
