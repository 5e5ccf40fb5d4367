//! A painter that is simple instead of fast: coverage in exact integers, colour
//! in f64, one pixel after the other.

use trigon_raster::paint2d::{Image, Mesh, Rect, Vertex};
use trigon_raster::{Filter, Wrap};

/// Paints meshes pixel by pixel; each triangle is rounded to bytes, as the
/// canvas of any painter is.
pub(crate) fn paint([width, height]: [i32; 2], pixels: &mut [[u8; 4]], meshes: &[Mesh<'_>]) {
    for mesh in meshes {
        let clip = mesh.scissor.intersection(Rect::new([0; 2], [width, height]));
        for indices in mesh.indices.chunks_exact(3) {
            let vertices = [0, 1, 2].map(|i| mesh.vertices[indices[i] as usize]);
            for y in clip.min[1]..clip.max[1] {
                for x in clip.min[0]..clip.max[0] {
                    if let Some(weights) = weights(&vertices, [x, y]) {
                        let pixel = &mut pixels[(y * width + x) as usize];
                        *pixel = over(color(&vertices, weights, mesh.image), *pixel);
                    }
                }
            }
        }
    }
}

/// The weights of a triangle's vertices at the centre of a pixel, if it is
/// covered.
///
/// The top-left rule says that a centre on an edge counts as if it lay a little
/// to the right, and on a horizontal one as if a little below. So the centre is
/// moved to the right by 1/K and down by 1/K² for a K so large that no edge is
/// crossed on the way, everything times K², and no case is left open.
fn weights(vertices: &[Vertex; 3], pixel: [i32; 2]) -> Option<[f64; 3]> {
    const K: i128 = 1 << 40;
    let raw =
        vertices.map(|vertex| vertex.position.map(|v| (f64::from(v) * 256.0).round_ties_even() as i128));
    let [x, y] = pixel.map(|v| 256 * i128::from(v) + 128);
    let across = |a: usize, b: usize, [px, py]: [i128; 2], scale: i128| {
        let [[ax, ay], [bx, by]] = [raw[a], raw[b]];
        (bx - ax) * (py - ay * scale) - (by - ay) * (px - ax * scale)
    };
    let moved = [x * K * K + K, y * K * K + 1];
    let turns = [(1, 2), (2, 0), (0, 1)].map(|(a, b)| across(a, b, moved, K * K).signum());
    let area = across(0, 1, raw[2], 1);
    (turns == [1; 3] || turns == [-1; 3])
        .then(|| [(1, 2), (2, 0), (0, 1)].map(|(a, b)| across(a, b, [x, y], 1) as f64 / area as f64))
}

/// The colour at a place of a triangle, in levels.
fn color(vertices: &[Vertex; 3], weights: [f64; 3], image: Option<&Image>) -> [f64; 4] {
    let mean = |value: &dyn Fn(&Vertex) -> f64| -> f64 {
        vertices.iter().zip(weights).map(|(vertex, weight)| value(vertex) * weight).sum()
    };
    let color = [0, 1, 2, 3].map(|c| mean(&|vertex| f64::from(vertex.color[c])));
    let Some(image) = image else { return color };
    let texel = sample(image, [0, 1].map(|axis| mean(&|vertex| f64::from(vertex.uv[axis]))));
    [0, 1, 2, 3].map(|c| color[c] * texel[c] / 255.0)
}

/// The image's colour at a place.
fn sample(image: &Image, uv: [f64; 2]) -> [f64; 4] {
    let size = image.size();
    let [u, v] = [0, 1].map(|axis| uv[axis] * f64::from(size[axis]));
    match image.filter {
        Filter::Nearest => texel(image, [u, v].map(|place| place.floor() as i64)),
        Filter::Linear => {
            let [u, v] = [u - 0.5, v - 0.5];
            let [x, y] = [u, v].map(|place| place.floor() as i64);
            let [right, below] = [u - u.floor(), v - v.floor()];
            let corner = |dx: i64, dy: i64| texel(image, [x + dx, y + dy]);
            let [a, b, c, d] = [corner(0, 0), corner(1, 0), corner(0, 1), corner(1, 1)];
            let mix = |a: f64, b: f64, weight: f64| a * (1.0 - weight) + b * weight;
            [0, 1, 2, 3].map(|i| mix(mix(a[i], b[i], right), mix(c[i], d[i], right), below))
        }
    }
}

fn texel(image: &Image, place: [i64; 2]) -> [f64; 4] {
    let [width, height] = image.size().map(i64::from);
    let wrapped = |v: i64, size: i64| match image.wrap {
        Wrap::ClampToEdge => v.max(0).min(size - 1),
        Wrap::Repeat => v.rem_euclid(size),
        // 0 1 2 2 1 0 0 1 …
        Wrap::MirroredRepeat if v.div_euclid(size) % 2 == 0 => v.rem_euclid(size),
        Wrap::MirroredRepeat => size - 1 - v.rem_euclid(size),
    };
    let index = wrapped(place[1], height) * width + wrapped(place[0], width);
    image.texels()[index as usize].map(f64::from)
}

fn over(source: [f64; 4], below: [u8; 4]) -> [u8; 4] {
    let rest = 1.0 - source[3] / 255.0;
    [0, 1, 2, 3].map(|c| (source[c] + f64::from(below[c]) * rest).round().min(255.0) as u8)
}
