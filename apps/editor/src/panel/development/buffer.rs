//! The buffers of a frame as images.

use trigon_window::egui::{Color32, ColorImage};
use trigon_window::scene::Frame;
use trigon_window::scene::math::Vec3;

/// One of them.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) enum Buffer {
    Color,
    #[default]
    Depth,
    Objects,
    Faces,
    Triangles,
    Materials,
    Normals,
    Uvs,
    Albedo,
}

impl Buffer {
    pub(super) const ALL: [Self; 9] = [
        Self::Color,
        Self::Depth,
        Self::Objects,
        Self::Faces,
        Self::Triangles,
        Self::Materials,
        Self::Normals,
        Self::Uvs,
        Self::Albedo,
    ];

    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Color => "Color",
            Self::Depth => "Depth",
            Self::Objects => "Objects",
            Self::Faces => "Faces",
            Self::Triangles => "Triangles",
            Self::Materials => "Materials",
            Self::Normals => "Normals",
            Self::Uvs => "Texture coordinates",
            Self::Albedo => "Albedo",
        }
    }

    /// The buffer no wider than so many pixels. Pixels are left out, not mixed: an id in between
    /// two is that of something else.
    pub(super) fn image(self, frame: &Frame, width: u32) -> ColorImage {
        let width = width.clamp(1, frame.width.max(1));
        let height =
            (u64::from(frame.height) * u64::from(width) / u64::from(frame.width.max(1))).max(1) as u32;
        let depths = depth_range(frame);
        let mut pixels = Vec::with_capacity(width as usize * height as usize);
        for y in 0..height {
            for x in 0..width {
                let from =
                    |at: u32, size: u32, of: u32| (u64::from(at) * u64::from(of) / u64::from(size)) as usize;
                let (x, y) = (from(x, width, frame.width), from(y, height, frame.height));
                pixels.push(self.pixel(frame, y * frame.width as usize + x, depths));
            }
        }
        ColorImage::new([width as usize, height as usize], pixels)
    }

    fn pixel(self, frame: &Frame, at: usize, depths: [f32; 2]) -> Color32 {
        let id = |ids: &Option<Vec<u32>>| ids.as_ref().map_or(u32::MAX, |ids| ids[at]);
        let vector = |list: &Option<Vec<Vec3>>| list.as_ref().map_or(Vec3::ZERO, |list| list[at]);
        match self {
            Self::Color => {
                let [red, green, blue, alpha] = [0, 1, 2, 3].map(|channel| frame.color[4 * at + channel]);
                Color32::from_rgba_unmultiplied(red, green, blue, alpha)
            }
            Self::Depth => gray(frame.depth.as_ref().map_or(f32::INFINITY, |depth| depth[at]), depths),
            Self::Objects => of_id(id(&frame.object_ids)),
            Self::Faces => of_id(id(&frame.face_ids)),
            Self::Triangles => of_id(id(&frame.triangle_ids)),
            Self::Materials => of_id(id(&frame.material_ids)),
            Self::Normals => match vector(&frame.normals) {
                Vec3::ZERO => Color32::BLACK,
                normal => of_shares(normal * 0.5 + 0.5),
            },
            Self::Uvs => {
                let uv = frame.uvs.as_ref().map_or_else(Default::default, |uvs| uvs[at]);
                of_shares(Vec3::new(uv.x - uv.x.floor(), uv.y - uv.y.floor(), 0.0))
            }
            Self::Albedo => of_shares(vector(&frame.albedo)),
        }
    }
}

/// The nearest and the farthest depth.
fn depth_range(frame: &Frame) -> [f32; 2] {
    let depths = frame.depth.iter().flatten().copied().filter(|depth| depth.is_finite());
    depths
        .fold([f32::INFINITY, f32::NEG_INFINITY], |[least, most], depth| [least.min(depth), most.max(depth)])
}

/// Near is bright, background black.
fn gray(depth: f32, [least, most]: [f32; 2]) -> Color32 {
    if !depth.is_finite() {
        return Color32::BLACK;
    }
    let share = if most > least { (depth - least) / (most - least) } else { 0.0 };
    Color32::from_gray((255.0 - 200.0 * share) as u8)
}

/// Colours that differ clearly for neighbouring numbers.
fn of_id(id: u32) -> Color32 {
    if id == u32::MAX {
        return Color32::BLACK;
    }
    // Knuth's multiplicative hash ("The Art of Computer Programming", volume 3, section 6.4).
    let mixed = (id + 1).wrapping_mul(2_654_435_761);
    let [a, b, c, _] = (mixed ^ mixed >> 15).to_le_bytes();
    Color32::from_rgb(64 | a, 64 | b, 64 | c)
}

fn of_shares(shares: Vec3) -> Color32 {
    let [red, green, blue] = shares.to_array().map(|share| (share.clamp(0.0, 1.0) * 255.0) as u8);
    Color32::from_rgb(red, green, blue)
}
