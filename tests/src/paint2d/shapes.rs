//! What the tests paint, and on what.

use proptest::prelude::*;
use trigon_raster::Wrap;
use trigon_raster::paint2d::{Canvas, Image, Mesh, Painted, Painter, Rect, Vertex};

/// Width and height of the images: no multiples of eight.
pub(crate) const SIZE: [i32; 2] = [37, 29];

/// An image to paint on, every pixel different.
pub(crate) fn background() -> Vec<[u8; 4]> {
    let level = |i: i32| (i * 37 % 256) as u8;
    (0..SIZE[0] * SIZE[1]).map(|i| [level(i), level(i + 3), level(i * 5), 255]).collect()
}

/// Paints on a copy of an image.
pub(crate) fn painted_over(below: &[[u8; 4]], meshes: &[Mesh<'_>]) -> (Vec<[u8; 4]>, Painted) {
    painted_by(&mut Painter::new(), below, meshes)
}

/// The same by a painter of one's own.
pub(crate) fn painted_by(
    painter: &mut Painter,
    below: &[[u8; 4]],
    meshes: &[Mesh<'_>],
) -> (Vec<[u8; 4]>, Painted) {
    let mut pixels = below.to_vec();
    let [width, height] = SIZE.map(i32::cast_unsigned);
    let mut canvas = Canvas::new(width, height, &mut pixels).expect("the sides and the pixels agree");
    let painted = painter.paint(&mut canvas, meshes);
    (pixels, painted)
}

/// Paints on the background.
pub(crate) fn painted(meshes: &[Mesh<'_>]) -> Vec<[u8; 4]> {
    painted_over(&background(), meshes).0
}

/// A mesh that owns what it is made of.
#[derive(Clone, Debug)]
pub(crate) struct Shape {
    pub(crate) scissor: Rect,
    pub(crate) vertices: Vec<Vertex>,
    pub(crate) indices: Vec<u32>,
    pub(crate) image: Option<Image>,
}

impl Shape {
    /// Of these vertices and triangles, seen everywhere, without an image.
    pub(crate) fn new(vertices: Vec<Vertex>, indices: &[u32]) -> Self {
        Self { scissor: EVERYWHERE, vertices, indices: indices.to_vec(), image: None }
    }

    /// An upright rectangle of one colour as two triangles.
    pub(crate) fn rectangle(min: [f32; 2], max: [f32; 2], color: [u8; 4]) -> Self {
        let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
        let uvs = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let vertex = |i: usize| Vertex { position: corners[i], uv: uvs[i], color };
        Self::new((0..4).map(vertex).collect(), &[0, 1, 2, 2, 3, 0])
    }

    pub(crate) fn mesh(&self) -> Mesh<'_> {
        Mesh {
            scissor: self.scissor,
            vertices: &self.vertices,
            indices: &self.indices,
            image: self.image.as_ref(),
        }
    }

    /// A mesh for each triangle: none has a partner to be a rectangle with.
    pub(crate) fn apart(&self) -> Vec<Mesh<'_>> {
        self.indices.chunks(3).map(|indices| Mesh { indices, ..self.mesh() }).collect()
    }
}

/// The meshes of shapes.
pub(crate) fn meshes(shapes: &[Shape]) -> Vec<Mesh<'_>> {
    shapes.iter().map(Shape::mesh).collect()
}

/// A scissor that leaves everything.
pub(crate) const EVERYWHERE: Rect = Rect::new([i32::MIN; 2], [i32::MAX; 2]);

/// Colours that a painter meets: no channel above alpha.
pub(crate) fn color() -> impl Strategy<Value = [u8; 4]> {
    let translucent = any::<[u8; 4]>().prop_map(|[r, g, b, a]| [r.min(a), g.min(a), b.min(a), a]);
    let opaque = any::<[u8; 3]>().prop_map(|[r, g, b]| [r, g, b, 255]);
    prop_oneof![4 => translucent, 2 => opaque, 1 => Just([0; 4]), 1 => Just([255; 4])]
}

/// Coordinates near the canvas: anywhere, or on halves of pixels, where they
/// meet centres and each other.
pub(crate) fn coordinate() -> impl Strategy<Value = f32> {
    let halves = (-8..90_i32).prop_map(|v| v as f32 / 2.0);
    prop_oneof![3 => -6.0..44.0_f32, 3 => halves, 1 => -3000.0..3000.0_f32]
}

/// Images of any shape up to nine texels a side, linearly filtered.
pub(crate) fn image() -> impl Strategy<Value = Image> {
    let wrap = prop_oneof![Just(Wrap::ClampToEdge), Just(Wrap::Repeat), Just(Wrap::MirroredRepeat)];
    (1..10_u32, 1..10_u32, wrap).prop_flat_map(|(width, height, wrap)| {
        proptest::collection::vec(color(), (width * height) as usize).prop_map(move |texels| {
            let mut image = Image::new(width, height, texels).expect("the sides and the texels agree");
            image.wrap = wrap;
            image
        })
    })
}

/// Scissors around and across the canvas, empty ones too.
pub(crate) fn scissor() -> impl Strategy<Value = Rect> {
    let any = ([-9..40_i32, -9..40_i32], [-9..50_i32, -9..50_i32]).prop_map(|(min, max)| Rect::new(min, max));
    prop_oneof![2 => Just(EVERYWHERE), 1 => any]
}

/// Shapes of a few triangles, some with one colour, some with an image.
pub(crate) fn shape() -> impl Strategy<Value = Shape> {
    let place = prop_oneof![2 => [-1.5..2.5_f32, -1.5..2.5_f32], 1 => Just([0.25, 0.5])];
    let vertex = ([coordinate(), coordinate()], place, color());
    let vertices = proptest::collection::vec(vertex, 3..8);
    let indices = proptest::collection::vec(0..1000_u32, 3..13);
    (vertices, indices, proptest::option::of(image()), scissor(), any::<[bool; 2]>()).prop_map(
        |(vertices, mut indices, image, scissor, [one_color, one_place])| {
            let (_, first_uv, first_color) = vertices[0];
            let vertex = |&(position, uv, color): &([f32; 2], [f32; 2], [u8; 4])| Vertex {
                position,
                uv: if one_place { first_uv } else { uv },
                color: if one_color { first_color } else { color },
            };
            indices.truncate(indices.len() / 3 * 3);
            indices.iter_mut().for_each(|index| *index %= vertices.len() as u32);
            Shape { scissor, vertices: vertices.iter().map(vertex).collect(), indices, image }
        },
    )
}
