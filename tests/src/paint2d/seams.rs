//! Neighbours leave no gap and overlap nowhere: however a shape is cut into
//! triangles, each pixel is painted once.

use super::shapes::{SIZE, Shape, color, coordinate, meshes, painted, painted_over};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_raster::paint2d::Vertex;

/// One level more in each channel wherever it is painted, and nothing covered.
const COUNT: [u8; 4] = [1, 1, 1, 0];

/// A rectangle cut into a grid with wobbly inner points and either diagonal in
/// each cell, its triangles in either winding.
fn cut(min: [f32; 2], max: [f32; 2], cells: usize, wobble: &[[f32; 2]], turns: &[[bool; 2]]) -> Shape {
    let point = |i: usize| {
        let place = [i % (cells + 1), i / (cells + 1)];
        [0, 1].map(|axis| {
            let cell = (max[axis] - min[axis]) / cells as f32;
            let inner = 0 < place[axis] && place[axis] < cells;
            let off = if inner { wobble[i % wobble.len()][axis] } else { 0.0 };
            if place[axis] == cells { max[axis] } else { min[axis] + (place[axis] as f32 + off) * cell }
        })
    };
    let vertex = |i: usize| Vertex { position: point(i), uv: [0.0; 2], color: COUNT };
    let vertices = (0..(cells + 1) * (cells + 1)).map(vertex).collect();
    let mut indices = Vec::new();
    for cell in 0..cells * cells {
        let a = (cell / cells * (cells + 1) + cell % cells) as u32;
        let [b, c, d] = [a + 1, a + cells as u32 + 2, a + cells as u32 + 1];
        let [diagonal, mirrored] = turns[cell % turns.len()];
        let halves = if diagonal { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
        for [a, b, c] in halves {
            indices.extend(if mirrored { [a, c, b] } else { [a, b, c] });
        }
    }
    Shape::new(vertices, &indices)
}

/// The shape with another colour everywhere.
fn colored(shape: &Shape, color: [u8; 4]) -> Shape {
    let vertices = shape.vertices.iter().map(|vertex| Vertex { color, ..*vertex }).collect();
    Shape { vertices, ..shape.clone() }
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn a_cut_rectangle_is_painted_as_a_whole_one(
        (a, b) in ([coordinate(), coordinate()], [coordinate(), coordinate()]),
        cells in 1..6_usize,
        // From a quarter of a cell on, a cell may be concave and one of its diagonals lie
        // outside; a fifth leaves room for the grid of 1/256 pixel.
        wobble in proptest::collection::vec([-0.2..0.2_f32, -0.2..0.2_f32], 1..20),
        turns in proptest::collection::vec(any::<[bool; 2]>(), 1..20),
        color in color(),
    ) {
        let min = [a[0].min(b[0]), a[1].min(b[1])];
        let max = [a[0].max(b[0]), a[1].max(b[1])];
        // Finer cells than the grid of 1/256 pixel could fold.
        prop_assume!(max[0] - min[0] > 0.2 && max[1] - min[1] > 0.2);
        let shape = cut(min, max, cells, &wobble, &turns);
        for color in [color, COUNT] {
            let pieces = painted(&colored(&shape, color).apart());
            prop_assert_eq!(&pieces, &painted(&[Shape::rectangle(min, max, color).mesh()]));
            prop_assert_eq!(&pieces, &painted(&[colored(&shape, color).mesh()]), "halves pair up");
        }
    }

    /// The fan around a point that is no corner covers what the polygon covers:
    /// wherever it lies inside.
    #[test]
    fn a_fan_does_not_depend_on_its_centre(
        radius in 0.5..40.0_f64,
        middle in [coordinate(), coordinate()],
        centres in [[-0.3..0.3_f64, -0.3..0.3_f64], [-0.3..0.3_f64, -0.3..0.3_f64]],
    ) {
        const CORNERS: u32 = 11;
        let around = |angle: f64| {
            let (sine, cosine) = trigon_math::elementary::sin_cos(angle);
            [cosine, sine]
        };
        let point = |offset: [f64; 2]| [0, 1].map(|axis| middle[axis] + (offset[axis] * radius) as f32);
        let vertex = |offset: [f64; 2]| Vertex { position: point(offset), uv: [0.0; 2], color: COUNT };
        let fans = centres.map(|centre| {
            let outline = (0..CORNERS).map(|i| around(f64::from(i) / f64::from(CORNERS) * std::f64::consts::TAU));
            let vertices = outline.map(vertex).chain([vertex(centre)]).collect();
            let indices: Vec<u32> = (0..CORNERS).flat_map(|i| [i, (i + 1) % CORNERS, CORNERS]).collect();
            Shape::new(vertices, &indices)
        });
        prop_assert_eq!(painted(&[fans[0].mesh()]), painted(&[fans[1].mesh()]));
        let black = vec![[0; 4]; (SIZE[0] * SIZE[1]) as usize];
        let (counts, _) = painted_over(&black, &[fans[0].mesh()]);
        prop_assert!(counts.iter().all(|pixel| pixel[0] <= 1), "no pixel is painted twice");
    }
}

/// The top-left rule, spelt out: centres on the left and the upper edge are
/// inside, those on the right and the lower edge are not.
#[test]
fn centres_on_edges_belong_to_the_right_and_the_lower_neighbour() {
    let shape = Shape::rectangle([2.5, 1.5], [5.5, 3.5], [255; 4]);
    let black = vec![[0; 4]; (SIZE[0] * SIZE[1]) as usize];
    for painting in [meshes(std::slice::from_ref(&shape)), shape.apart()] {
        let (pixels, _) = painted_over(&black, &painting);
        let inside: Vec<usize> = (0..pixels.len()).filter(|&i| pixels[i] != [0; 4]).collect();
        let row = |y: usize| (2..5).map(move |x| y * SIZE[0] as usize + x);
        assert_eq!(inside, row(1).chain(row(2)).collect::<Vec<_>>(), "columns 2 to 4 of rows 1 and 2");
    }
}
