//! What a fragment knows of its place, against the closed form.

use crate::{Culling, Draw, Fragment, Output, Pass, Pipeline, Rasterizer, Target, VertexOutput};
use trigon_math::Vec4;

/// No whole number of tiles.
const SIZE: [u32; 2] = [75, 45];

/// A triangle in perspective, by its corners in clip space; its fragments show one of what they know.
struct Tilted {
    corners: [Vec4; 3],
    shown: fn(&Fragment<()>) -> f32,
}

impl Pipeline for Tilted {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        3
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        VertexOutput { position: self.corners[index], varyings: () }
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        Vec4::new((self.shown)(fragment), 0.0, 0.0, 1.0)
    }
}

/// On grid points, so that snapping moves nothing: places in eighths of the image, depths and distances.
fn corners() -> [[Vec4; 3]; 3] {
    let corner = |[x, y]: [f32; 2], depth: f32, w: f32| Vec4::new(x * w, y * w, depth * w, w);
    [
        [
            corner([-0.875, -0.75], 0.125, 8.0),
            corner([0.75, -0.5], 0.5, 2.0),
            corner([-0.25, 0.875], 0.75, 1.25),
        ],
        [corner([0.5, 0.5], 0.875, 1.0), corner([-0.75, 0.25], 0.25, 4.0), corner([0.125, -0.875], 0.5, 2.0)],
        [
            corner([-0.5, 0.75], 0.25, 0.5),
            corner([0.875, 0.25], 0.25, 32.0),
            corner([-0.75, -0.75], 1.0, 1.0),
        ],
    ]
}

/// What is shown of a triangle, and its depths in the target; pixel by pixel.
fn drawn(corners: [Vec4; 3], shown: fn(&Fragment<()>) -> f32) -> (Vec<f32>, Vec<f32>) {
    let pipeline = Tilted { corners, shown };
    let mut pass = Pass::new();
    pass.triangles(Draw { culling: Culling::None, ..Draw::new(&pipeline, &[[0, 1, 2]]) });
    let mut target = Target::new(SIZE[0], SIZE[1], &[Output::Linear, Output::Depth]).unwrap();
    Rasterizer::default().draw(&pass, &mut target);
    let light = target.linear().unwrap().iter().map(|color| color.x).collect();
    (light, target.depth().unwrap().to_vec())
}

/// The value at the centre of a pixel of what is linear on the screen, from its values at the corners.
fn linear(corners: [Vec4; 3], values: [f64; 3], pixel: usize) -> f64 {
    let [width, height] = SIZE.map(f64::from);
    let project = |corner: Vec4| {
        let (x, y) = (f64::from(corner.x / corner.w), f64::from(corner.y / corner.w));
        // Rounded to the grid of 1/256 pixel, as corners are.
        [(x + 1.0) / 2.0 * width, (1.0 - y) / 2.0 * height].map(|v| (v * 256.0).round_ties_even() / 256.0)
    };
    let [a, b, c] = corners.map(project);
    let at = [(pixel % SIZE[0] as usize) as f64 + 0.5, (pixel / SIZE[0] as usize) as f64 + 0.5];
    let doubled = |[a, b, c]: [[f64; 2]; 3]| (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    let shares = [[at, b, c], [a, at, c], [a, b, at]].map(doubled);
    shares.iter().zip(values).map(|(share, value)| share * value).sum::<f64>() / doubled([a, b, c])
}

#[test]
fn fragments_know_their_depth() {
    for corners in corners() {
        let (shown, depths) = drawn(corners, |fragment| fragment.depth);
        let drawn = depths.iter().enumerate().filter(|(_, depth)| **depth > 0.0);
        assert!(drawn.clone().count() > 300, "{}", drawn.count());
        for (pixel, depth) in drawn {
            let expected = linear(corners, corners.map(|corner| f64::from(corner.z / corner.w)), pixel);
            assert!((f64::from(shown[pixel]) - expected).abs() < 1e-6, "{}, not {expected}", shown[pixel]);
            assert!((shown[pixel] - depth).abs() < 1e-6, "{} and {depth}", shown[pixel]);
        }
    }
}

#[test]
fn fragments_know_their_distance_and_their_place() {
    for corners in corners() {
        let (inverse, depths) = drawn(corners, |fragment| fragment.inverse_w);
        let (across, _) = drawn(corners, |fragment| fragment.position.x + fragment.pixel.x as f32 * 100.0);
        let (down, _) = drawn(corners, |fragment| fragment.position.y + fragment.pixel.y as f32 * 100.0);
        for (pixel, _) in depths.iter().enumerate().filter(|(_, depth)| **depth > 0.0) {
            let expected = linear(corners, corners.map(|corner| 1.0 / f64::from(corner.w)), pixel);
            assert!(
                (f64::from(inverse[pixel]) / expected - 1.0).abs() < 1e-5,
                "{}, not {expected}",
                inverse[pixel]
            );
            let expected =
                [pixel % SIZE[0] as usize, pixel / SIZE[0] as usize].map(|v| v as f32 * 101.0 + 0.5);
            assert_eq!([across[pixel], down[pixel]], expected, "the centre of the pixel");
        }
    }
}

#[test]
fn fragments_know_how_far_their_edges_are() {
    const SHOWN: [fn(&Fragment<()>) -> f32; 3] = [
        |fragment| fragment.edge_distances[0],
        |fragment| fragment.edge_distances[1],
        |fragment| fragment.edge_distances[2],
    ];
    for corners in corners() {
        for (edge, shown) in SHOWN.into_iter().enumerate() {
            let (distances, depths) = drawn(corners, shown);
            // 0 on the edge and 1 at the corner opposite: the distance is a multiple of that.
            let mut values = [0.0; 3];
            values[(edge + 2) % 3] = 1.0;
            let [width, height] = SIZE.map(f64::from);
            let project = |corner: Vec4| {
                [f64::from(corner.x / corner.w) * width / 2.0, f64::from(corner.y / corner.w) * height / 2.0]
            };
            let [from, to, opposite] = [edge, (edge + 1) % 3, (edge + 2) % 3].map(|i| project(corners[i]));
            let way = [to[0] - from[0], to[1] - from[1]];
            let beside = [opposite[0] - from[0], opposite[1] - from[1]];
            let far =
                (way[0] * beside[1] - way[1] * beside[0]).abs() / (way[0] * way[0] + way[1] * way[1]).sqrt();
            for (pixel, _) in depths.iter().enumerate().filter(|(_, depth)| **depth > 0.0) {
                let expected = far * linear(corners, values, pixel);
                // Corners are moved by up to 1/512 pixel.
                assert!(
                    (f64::from(distances[pixel]) - expected).abs() < 0.01,
                    "{}, not {expected}",
                    distances[pixel]
                );
            }
        }
    }
}
