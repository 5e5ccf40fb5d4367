//! Interfaces made by chance: what egui tessellates to, and worse.

use egui::epaint::{ImageDelta, Mesh, Primitive, Vertex};
use egui::{
    ClippedPrimitive, Color32, ColorImage, Pos2, Rect, TextureId, TextureOptions, TexturesDelta, pos2, vec2,
};
use proptest::prelude::*;

pub(super) const WIDTH: u32 = 96;
pub(super) const HEIGHT: u32 = 72;

/// Texels along a side.
const SIDE: usize = 16;
const FONT: TextureId = TextureId::Managed(0);
const IMAGE: TextureId = TextureId::User(7);

/// A font with a white corner and translucent ink, and an image that is opaque
/// enough for filtering, see the test.
pub(super) fn textures() -> TexturesDelta {
    let image =
        |texel: fn(usize) -> Color32| ColorImage::new([SIDE, SIDE], (0..SIDE * SIDE).map(texel).collect());
    let font = image(|i| match i % SIDE {
        0..2 if i < 2 * SIDE => Color32::WHITE,
        _ => Color32::from_white_alpha((i * 37 % 256) as u8),
    });
    let pattern = image(|i| Color32::from_rgb((i * 91 % 256) as u8, (i * 13 % 256) as u8, (255 - i) as u8));
    let mut delta = TexturesDelta::default();
    delta.push(FONT, ImageDelta::full(font, TextureOptions::NEAREST));
    delta.push(IMAGE, ImageDelta::full(pattern, TextureOptions::LINEAR));
    delta
}

pub(super) fn any_scale() -> impl Strategy<Value = f32> {
    prop::sample::select(vec![1.0, 1.25, 2.0])
}

/// Places on and off pixels' centres and borders, also outside.
fn position() -> impl Strategy<Value = Pos2> {
    let coordinate = || prop_oneof![-10.0..110.0f32, (-20..220i32).prop_map(|half| half as f32 * 0.5)];
    (coordinate(), coordinate()).prop_map(|(x, y)| pos2(x, y * 0.75))
}

fn color() -> impl Strategy<Value = Color32> {
    prop_oneof![
        any::<[u8; 4]>().prop_map(|[r, g, b, a]| Color32::from_rgba_unmultiplied(r, g, b, a)),
        any::<[u8; 3]>().prop_map(|[r, g, b]| Color32::from_rgb(r, g, b)),
        Just(Color32::TRANSPARENT),
    ]
}

/// Of filtered images: above 1/8, see the test.
fn dense_color() -> impl Strategy<Value = Color32> {
    (any::<[u8; 3]>(), 40..=255u8).prop_map(|([r, g, b], a)| Color32::from_rgba_unmultiplied(r, g, b, a))
}

fn quad(rect: Rect, uv: Rect, color: Color32) -> Mesh {
    let mut mesh = Mesh::default();
    mesh.add_rect_with_uv(rect, uv, color);
    mesh
}

/// A shape in a mesh of its own.
fn shape() -> impl Strategy<Value = Mesh> {
    let white = Rect::from_min_max(egui::epaint::WHITE_UV, egui::epaint::WHITE_UV);
    let triangle = prop::array::uniform3((position(), color())).prop_map(|corners| Mesh {
        indices: vec![0, 1, 2],
        vertices: corners.map(|(pos, color)| Vertex { pos, uv: egui::epaint::WHITE_UV, color }).to_vec(),
        texture_id: FONT,
    });
    let panel = (position(), position(), color())
        .prop_map(move |(a, b, color)| quad(Rect::from_two_pos(a, b), white, color));
    let glyph = (0..90i32, 0..60i32, 1..14usize, color()).prop_map(|(x, y, side, color)| {
        let texels = |texel: usize| texel as f32 / SIDE as f32;
        let uv = Rect::from_min_max(pos2(texels(1), texels(1)), pos2(texels(1 + side), texels(1 + side)));
        quad(Rect::from_min_size(pos2(x as f32, y as f32), vec2(side as f32, side as f32)), uv, color)
    });
    let textured = (position(), position(), dense_color()).prop_map(|(a, b, color)| Mesh {
        texture_id: IMAGE,
        ..quad(Rect::from_two_pos(a, b), Rect::from_min_max(pos2(0.1, -0.2), pos2(0.9, 1.3)), color)
    });
    prop_oneof![triangle, panel, glyph, textured]
}

fn clip() -> impl Strategy<Value = Rect> {
    prop_oneof![
        Just(Rect::EVERYTHING),
        (position(), position()).prop_map(|(a, b)| Rect::from_two_pos(a, b)),
        (position(), position()).prop_map(|(min, max)| Rect { min, max }),
    ]
}

fn primitive() -> impl Strategy<Value = ClippedPrimitive> {
    (prop::collection::vec(shape(), 1..5), clip()).prop_map(|(shapes, clip_rect)| {
        let mut mesh = Mesh { texture_id: shapes[0].texture_id, ..Mesh::default() };
        for shape in
            shapes.into_iter().filter(|shape| shape.texture_id == mesh.texture_id).collect::<Vec<_>>()
        {
            mesh.append(shape);
        }
        ClippedPrimitive { clip_rect, primitive: Primitive::Mesh(mesh) }
    })
}

pub(super) fn any_scene() -> impl Strategy<Value = Vec<ClippedPrimitive>> {
    prop::collection::vec(primitive(), 1..6)
}

/// What may happen to an interface between two passes.
#[derive(Clone, Debug)]
pub(super) enum Change {
    /// One primitive more at this position.
    Insert(usize, ClippedPrimitive),
    /// One less.
    Remove(usize),
    /// Another shape in a mesh.
    Grow(usize, Mesh),
    /// A vertex moves, and takes another colour.
    Edit(usize, usize, Pos2, Color32),
    /// A triangle less.
    Shrink(usize),
    /// Another clip rectangle.
    Clip(usize, Rect),
    /// Another shape before a triangle of a mesh.
    InsertShape(usize, usize, Mesh),
    /// A triangle goes to another position in the order.
    Reorder(usize, usize, usize),
    /// A triangle occurs twice.
    Repeat(usize, usize, usize),
}

pub(super) fn changed() -> impl Strategy<Value = Change> {
    let index = || 0..64usize;
    prop_oneof![
        (index(), primitive()).prop_map(|(at, primitive)| Change::Insert(at, primitive)),
        index().prop_map(Change::Remove),
        (index(), shape()).prop_map(|(at, shape)| Change::Grow(at, shape)),
        (index(), index(), position(), dense_color())
            .prop_map(|(at, i, to, color)| Change::Edit(at, i, to, color)),
        index().prop_map(Change::Shrink),
        (index(), clip()).prop_map(|(at, clip)| Change::Clip(at, clip)),
        (index(), index(), shape()).prop_map(|(at, i, shape)| Change::InsertShape(at, i, shape)),
        (index(), index(), index()).prop_map(|(at, from, to)| Change::Reorder(at, from, to)),
        (index(), index(), index()).prop_map(|(at, from, to)| Change::Repeat(at, from, to)),
    ]
}

impl Change {
    pub(super) fn apply(self, mut scene: Vec<ClippedPrimitive>) -> Vec<ClippedPrimitive> {
        let count = scene.len();
        if count == 0 && !matches!(self, Self::Insert(..)) {
            return scene;
        }
        let mut edit = |at: usize, edit: &mut dyn FnMut(&mut Mesh)| match &mut scene[at % count].primitive {
            Primitive::Mesh(mesh) => edit(mesh),
            Primitive::Callback(_) => {}
        };
        match self {
            Self::Insert(at, primitive) => scene.insert(at % (count + 1), primitive),
            Self::Remove(at) => drop(scene.remove(at % count)),
            Self::Clip(at, clip) => scene[at % count].clip_rect = clip,
            Self::Grow(at, shape) => {
                edit(at, &mut |mesh| {
                    let texture_id = mesh.texture_id;
                    mesh.append(Mesh { texture_id, ..shape.clone() });
                });
            }
            Self::Edit(at, i, pos, color) => edit(at, &mut |mesh| {
                let vertex = i % mesh.vertices.len();
                (mesh.vertices[vertex].pos, mesh.vertices[vertex].color) = (pos, color);
            }),
            Self::Shrink(at) => edit(at, &mut |mesh| {
                let count = mesh.indices.len();
                drop(mesh.indices.drain(..3.min(count)));
            }),
            Self::InsertShape(at, i, shape) => edit(at, &mut |mesh| {
                let (texture_id, before) = (mesh.texture_id, mesh.indices.len());
                mesh.append(Mesh { texture_id, ..shape.clone() });
                mesh.indices[i % (before / 3 + 1) * 3..].rotate_left(before - i % (before / 3 + 1) * 3);
            }),
            Self::Reorder(at, from, to) => edit(at, &mut |mesh| {
                let mut triangles = triangles(mesh);
                if let Some(last) = triangles.len().checked_sub(1) {
                    let triangle = triangles.remove(from % (last + 1));
                    triangles.insert(to % (last + 1), triangle);
                }
                mesh.indices = triangles.into_flattened();
            }),
            Self::Repeat(at, from, to) => edit(at, &mut |mesh| {
                let mut triangles = triangles(mesh);
                if let Some(triangle) = triangles.get(from % triangles.len().max(1)).copied() {
                    triangles.insert(to % (triangles.len() + 1), triangle);
                }
                mesh.indices = triangles.into_flattened();
            }),
        }
        scene
    }
}

fn triangles(mesh: &Mesh) -> Vec<[u32; 3]> {
    mesh.indices.as_chunks::<3>().0.to_vec()
}
