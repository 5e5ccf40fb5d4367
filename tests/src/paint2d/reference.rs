//! Against the reference painter: each layer at most one level off.
//!
//! Layer by layer, because a canvas of bytes rounds after each: a value that is a
//! hair from the middle of two levels may go either way, and layers that hide little
//! add up what was rounded below them.

use super::oracle;
use super::shapes::{SIZE, Shape, background, color, image, meshes, painted, painted_over, scissor, shape};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_raster::paint2d::{Mesh, Vertex};

/// The largest difference of two images in levels, and where it is.
fn difference(a: &[[u8; 4]], b: &[[u8; 4]]) -> (u8, usize) {
    let pixel = |i: usize| [0, 1, 2, 3].map(|c| a[i][c].abs_diff(b[i][c])).into_iter().max();
    (0..a.len()).map(|i| (pixel(i).unwrap_or(0), i)).max().expect("the images are not empty")
}

/// Paints layers, each of triangles that do not overlap. Each is held to what the
/// reference paints over the same image; all at once must give the same bytes.
fn check(layers: &[Mesh<'_>], at_once: &[Mesh<'_>]) -> Result<(), TestCaseError> {
    let mut image = background();
    for (layer, mesh) in layers.iter().enumerate() {
        let mut expected = image.clone();
        oracle::paint(SIZE, &mut expected, &[*mesh]);
        image = painted_over(&image, &[*mesh]).0;
        let (levels, pixel) = difference(&image, &expected);
        prop_assert!(
            levels <= 1,
            "{levels} levels in layer {layer} at {}, {}: {:?} instead of {:?}",
            pixel as i32 % SIZE[0],
            pixel as i32 / SIZE[0],
            image[pixel],
            expected[pixel]
        );
    }
    prop_assert!(painted(at_once) == image, "the layers at once are other bytes");
    Ok(())
}

/// A quad from `min` of some size in pixels, with all of an image.
fn quad() -> impl Strategy<Value = Shape> {
    let position = [-10.0..40.0_f32, -10.0..30.0_f32];
    let size = [0.0..30.0_f32, 0.0..30.0_f32];
    (position, size, color(), image(), scissor()).prop_map(|(min, size, color, image, scissor)| {
        let max = [min[0] + size[0], min[1] + size[1]];
        Shape { scissor, image: Some(image), ..Shape::rectangle(min, max, color) }
    })
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn triangles_are_within_a_level(shapes in proptest::collection::vec(shape(), 1..4)) {
        let triangles: Vec<Mesh<'_>> = shapes.iter().flat_map(Shape::apart).collect();
        check(&triangles, &meshes(&shapes))?;
    }

    #[test]
    fn stretched_images_are_within_a_level(shapes in proptest::collection::vec(quad(), 1..4)) {
        check(&meshes(&shapes), &meshes(&shapes))?;
    }

    /// What an interface is at scales 1, 1.25 and 2: panels with feathered
    /// edges, one over the other.
    #[test]
    fn feathered_panels_are_within_a_level(
        panels in proptest::collection::vec(([-8.0..30.0_f32, -8.0..30.0_f32], [0.0..30.0_f32, 0.0..30.0_f32], color()), 1..6),
        scale in prop_oneof![Just(1.0), Just(1.25), Just(2.0)],
        scissor in scissor(),
    ) {
        let panel = |&(min, size, color): &([f32; 2], [f32; 2], [u8; 4])| {
            let max = [min[0] + size[0], min[1] + size[1]];
            Shape { scissor, ..feathered(min.map(|v| v * scale), max.map(|v| v * scale), color) }
        };
        let shapes: Vec<Shape> = panels.iter().map(panel).collect();
        check(&meshes(&shapes), &meshes(&shapes))?;
    }
}

/// A rectangle whose edges fade over a pixel, half of it on each side.
fn feathered(min: [f32; 2], max: [f32; 2], color: [u8; 4]) -> Shape {
    let ring = |by: f32, color: [u8; 4]| {
        let [min, max] = [min.map(|v| v - by), max.map(|v| v + by)];
        let corners = [min, [max[0], min[1]], max, [min[0], max[1]]];
        corners.map(|position| Vertex { position, uv: [0.0; 2], color })
    };
    let vertices = [ring(-0.5, color), ring(0.5, [0; 4])].concat();
    let mut indices = vec![0, 1, 2, 2, 3, 0];
    for (a, b) in [(0, 1), (1, 2), (2, 3), (3, 0)] {
        indices.extend([a, b, a + 4, a + 4, b, b + 4]);
    }
    Shape::new(vertices, &indices)
}
