//! egui's textures as images for painting triangles.

use std::collections::HashMap;

use egui::epaint::{ImageData, ImageDelta};
use egui::{TextureFilter, TextureId, TextureOptions, TextureWrapMode, TexturesDelta};
use trigon_raster::paint2d::{self, Image, Rect};
use trigon_raster::{Filter, Wrap};

use super::ChannelOrder;

/// The longest side of a texture that can be painted, in texels; egui must be told.
pub const MAX_TEXTURE_SIDE: usize = paint2d::MAX_SIZE as usize;

/// The textures of one context.
#[derive(Debug, Default)]
pub(super) struct Textures {
    images: HashMap<TextureId, Image>,
    /// Freed by the last delta, whose primitives may still use them.
    freed: Vec<TextureId>,
    /// Where textures have changed since the last primitives, in texture coordinates.
    changed: HashMap<TextureId, egui::Rect>,
}

impl Textures {
    pub(super) fn image(&self, id: TextureId) -> Option<&Image> {
        self.images.get(&id)
    }

    /// Where a texture looks different than with the last primitives; an empty rectangle if
    /// nowhere.
    pub(super) fn changed(&self, id: TextureId) -> egui::Rect {
        self.changed.get(&id).copied().unwrap_or(egui::Rect::NOTHING)
    }

    /// The primitives of this state have been received.
    pub(super) fn forget_changes(&mut self) {
        self.changed.clear();
    }

    /// Drops what was freed before, and takes new and changed textures. Leaves the delta empty.
    pub(super) fn update(&mut self, delta: &mut TexturesDelta, order: ChannelOrder) {
        for id in self.freed.drain(..) {
            self.images.remove(&id);
        }
        for (id, deltas) in delta.set.drain() {
            deltas.iter().for_each(|delta| self.set(id, delta, order));
        }
        self.freed.extend(delta.free.drain());
    }

    /// Applies one change to one texture. Invalid changes are ignored: a texture that is too large,
    /// or a part outside it.
    fn set(&mut self, id: TextureId, delta: &ImageDelta, order: ChannelOrder) {
        let ImageData::Color(image) = &delta.image;
        let [width, height] = image.size.map(|side| u32::try_from(side).unwrap_or(u32::MAX));
        let texels = image.pixels.iter().map(|color| order.arrange(color.to_array())).collect();
        match (delta.pos, self.images.get_mut(&id)) {
            (None, _) => {
                let Ok(mut image) = Image::new(width, height, texels) else { return };
                (image.filter, image.wrap) = (filter(delta.options), wrap(delta.options));
                self.images.insert(id, image);
                self.changed.insert(id, egui::Rect::EVERYTHING);
            }
            (Some(min), Some(whole)) => {
                let min = min.map(|coordinate| i32::try_from(coordinate).unwrap_or(i32::MAX));
                let end = |axis: usize, side: u32| min[axis].saturating_add_unsigned(side);
                let area = Rect::new(min, [end(0, width), end(1, height)]);
                if whole.update(area, &texels).is_ok() {
                    let changed = uv_of(area, whole);
                    self.changed.entry(id).and_modify(|all| *all |= changed).or_insert(changed);
                }
            }
            (Some(_), None) => {}
        }
    }
}

/// The coordinates that some texels affect. If the image is repeated, that is everywhere.
fn uv_of(area: Rect, image: &Image) -> egui::Rect {
    if image.wrap != Wrap::ClampToEdge {
        return egui::Rect::EVERYTHING;
    }
    let size = image.size();
    let uv = |coordinate: i32, axis: usize| coordinate as f32 / size[axis] as f32;
    // Linear filters extend half a texel further; a whole one leaves room for rounding.
    egui::Rect::from_min_max(
        egui::pos2(uv(area.min[0] - 1, 0), uv(area.min[1] - 1, 1)),
        egui::pos2(uv(area.max[0] + 1, 0), uv(area.max[1] + 1, 1)),
    )
}

/// There is one filter for both directions; interfaces mostly magnify.
fn filter(options: TextureOptions) -> Filter {
    match options.magnification {
        TextureFilter::Nearest => Filter::Nearest,
        TextureFilter::Linear => Filter::Linear,
    }
}

fn wrap(options: TextureOptions) -> Wrap {
    match options.wrap_mode {
        TextureWrapMode::ClampToEdge => Wrap::ClampToEdge,
        TextureWrapMode::Repeat => Wrap::Repeat,
        TextureWrapMode::MirroredRepeat => Wrap::MirroredRepeat,
    }
}
