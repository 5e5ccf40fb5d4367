//! A finished picture, owned, with what was asked for beside the colours.

use std::fmt;

use trigon_raster::TargetError;

use crate::arena::Arena;
use crate::node::Node;
use crate::scene::NodeId;
use crate::settings::RenderSettings;

/// A finished picture. Rows run from the top, pixels from the left.
#[derive(Clone, Default, PartialEq)]
pub struct Frame {
    /// Pixels.
    pub width: u32,
    /// Pixels.
    pub height: u32,
    /// Four bytes a pixel: sRGB and straight (not premultiplied) alpha.
    pub color: Vec<u8>,
    /// Distance from the camera along its view axis in metres, infinite where
    /// nothing was drawn. Taken at the sample in the middle of the pixel, or with
    /// an even number of samples per axis at the one right and below of it.
    pub depth: Option<Vec<f32>>,
    /// Index of the node, `u32::MAX` where nothing was drawn. Taken at the same
    /// sample as the depth, never mixed. What is translucent leaves no id.
    pub object_ids: Option<Vec<u32>>,
    /// Index of the polygon in its mesh, `u32::MAX` where nothing was drawn.
    pub face_ids: Option<Vec<u32>>,
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
            .finish_non_exhaustive()
    }
}

impl Frame {
    /// Red, green, blue and alpha of a pixel.
    ///
    /// # Panics
    /// Outside the picture.
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
        resize(&mut self.color, 4 * pixels, 0).ok_or(full)?;
        resize_optional(&mut self.depth, outputs.depth, pixels, 0.0).ok_or(full)?;
        resize_optional(&mut self.object_ids, outputs.ids, pixels, u32::MAX).ok_or(full)?;
        resize_optional(&mut self.face_ids, outputs.ids, pixels, u32::MAX).ok_or(full)
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
