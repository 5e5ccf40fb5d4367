//! egui's triangles in f64, one pixel after the other, with no shortcut. What it
//! shares with the painter is the definition only: positions on a grid of 1/256
//! pixel, the top-left rule, places in images to 1/4096 texel, an image of bytes.

use egui::epaint::{Mesh, Primitive, Vertex};
use egui::{ClippedPrimitive, ColorImage, ImageData, TextureOptions, TexturesDelta};

type Pixels = Vec<[u8; 4]>;

/// Paints everything over `image`.
pub(super) fn paint(
    primitives: &[ClippedPrimitive],
    scale: f32,
    textures: &TexturesDelta,
    [width, height]: [i32; 2],
    mut pixels: Pixels,
) -> Pixels {
    for primitive in primitives {
        let Primitive::Mesh(mesh) = &primitive.primitive else { continue };
        let delta = &textures.set[&mesh.texture_id][0];
        let ImageData::Color(image) = &delta.image;
        let clip = primitive.clip_rect;
        let sides =
            [clip.min.x, clip.min.y, clip.max.x, clip.max.y].map(|side| f64::from((side * scale).round()));
        let inside = |x: i32, y: i32| {
            let (x, y) = (f64::from(x), f64::from(y));
            x >= sides[0] && y >= sides[1] && x < sides[2] && y < sides[3]
        };
        for triangle in triangles(mesh, scale) {
            for (x, y) in
                (0..height).flat_map(|y| (0..width).map(move |x| (x, y))).filter(|&(x, y)| inside(x, y))
            {
                let Some(weights) = triangle.weights(x, y) else { continue };
                let source = triangle.color(weights, image, delta.options);
                let pixel = &mut pixels[(y * width + x) as usize];
                *pixel = over(source, *pixel);
            }
        }
    }
    pixels
}

struct Triangle<'a> {
    /// In 1/256 pixel.
    points: [[i64; 2]; 3],
    corners: [&'a Vertex; 3],
}

fn triangles(mesh: &Mesh, scale: f32) -> impl Iterator<Item = Triangle<'_>> {
    mesh.indices.chunks(3).map(move |indices| {
        let corners = [0, 1, 2].map(|i| &mesh.vertices[indices[i] as usize]);
        let snap = |point: f32| (f64::from(point * scale) * 256.0).round_ties_even() as i64;
        Triangle { points: corners.map(|corner| [snap(corner.pos.x), snap(corner.pos.y)]), corners }
    })
}

/// Twice the area of a triangle of points, positive if it is clockwise on the screen.
fn area(a: [i64; 2], b: [i64; 2], c: [i64; 2]) -> i64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
}

impl Triangle<'_> {
    /// The corners' shares at the centre of a pixel, if it is covered.
    fn weights(&self, x: i32, y: i32) -> Option<[f64; 3]> {
        let center = [i64::from(x) * 256 + 128, i64::from(y) * 256 + 128];
        let [a, b, c] = self.points;
        let whole = area(a, b, c);
        let shares = [(b, c), (c, a), (a, b)].map(|(from, to)| {
            let share = area(from, to, center) * whole.signum();
            // With the inside to the right of the way.
            let way = [(to[0] - from[0]) * whole.signum(), (to[1] - from[1]) * whole.signum()];
            let left_or_top = way[1] < 0 || (way[1] == 0 && way[0] > 0);
            (share > 0 || (share == 0 && left_or_top)).then_some(share as f64)
        });
        let [a, b, c] = shares;
        (whole != 0).then_some(())?;
        Some([a?, b?, c?].map(|share| share / whole.abs() as f64))
    }

    /// Colour times texel, in levels.
    fn color(&self, weights: [f64; 3], image: &ColorImage, options: TextureOptions) -> [f64; 4] {
        let mix = |of: &dyn Fn(&Vertex) -> f64| (0..3).map(|i| of(self.corners[i]) * weights[i]).sum::<f64>();
        let uv = [mix(&|corner| corner.uv.x.into()), mix(&|corner| corner.uv.y.into())];
        let texel = sample(image, uv, options);
        std::array::from_fn(|c| mix(&|corner| f64::from(corner.color.to_array()[c])) * texel[c] / 255.0)
    }
}

fn sample(image: &ColorImage, uv: [f64; 2], options: TextureOptions) -> [f64; 4] {
    let texel = |x: f64, y: f64| {
        let [x, y] = [x, y].map(|coordinate| coordinate.clamp(0.0, image.size[0] as f64 - 1.0) as usize);
        image.pixels[y * image.size[0] + x].to_array().map(f64::from)
    };
    let rounded = |at: f64, side: usize| (at * side as f64 * 4096.0).round() / 4096.0;
    let [u, v] = [rounded(uv[0], image.size[0]), rounded(uv[1], image.size[1])];
    if options == TextureOptions::NEAREST {
        return texel(u.floor(), v.floor());
    }
    let [left, top] = [(u - 0.5).floor(), (v - 0.5).floor()];
    let [right, lower] = [u - 0.5 - left, v - 0.5 - top];
    let corners =
        [texel(left, top), texel(left + 1.0, top), texel(left, top + 1.0), texel(left + 1.0, top + 1.0)];
    std::array::from_fn(|c| {
        let upper = corners[0][c] * (1.0 - right) + corners[1][c] * right;
        let under = corners[2][c] * (1.0 - right) + corners[3][c] * right;
        upper * (1.0 - lower) + under * lower
    })
}

/// Premultiplied, rounded to the nearest byte.
fn over(source: [f64; 4], below: [u8; 4]) -> [u8; 4] {
    let rest = 1.0 - source[3] / 255.0;
    std::array::from_fn(|c| (source[c] + f64::from(below[c]) * rest + 0.5).floor().min(255.0) as u8)
}
