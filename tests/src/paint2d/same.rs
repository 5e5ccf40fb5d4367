//! What gives the same bytes: rectangles and their halves, levels of
//! instructions, orders of vertices, scissors and crops, and painting in steps.

use super::shapes::{
    EVERYWHERE, SIZE, Shape, background, color, image, meshes, painted, painted_by, painted_over, scissor,
    shape,
};
use crate::effort::cases;
use proptest::prelude::*;
use trigon_raster::Filter;
use trigon_raster::paint2d::{Canvas, Painter, Rect};
use trigon_raster::simd::SimdLevel;

/// Quads with texels one to one from a whole pixel, as glyphs are: part of an
/// image, or all of it.
fn glyph() -> impl Strategy<Value = Shape> {
    let position = [-12..40_i32, -12..32_i32];
    (position, image(), color(), scissor(), any::<[bool; 3]>(), -0.0019..0.0019_f32).prop_map(
        |(min, mut image, color, scissor, [nearest, whole, turned], off)| {
            if nearest {
                image.filter = Filter::Nearest;
            }
            let size = image.size();
            let from = [0, 1].map(|axis| if whole { 0 } else { size[axis] / 3 });
            let corner = |v: u32| [0, 1].map(|axis| if v == 0 { from[axis] } else { size[axis] });
            let position =
                |v: u32| [0, 1].map(|axis| (min[axis] + (corner(v)[axis] - from[axis]) as i32) as f32 + off);
            let mut shape = Shape::rectangle(position(0), position(1), color);
            let uv = |v: u32| [0, 1].map(|axis| corner(v)[axis] as f32 / size[axis] as f32);
            let [[left, top], [right, bottom]] = [uv(0), uv(1)];
            for (vertex, uv) in
                shape.vertices.iter_mut().zip([[left, top], [right, top], [right, bottom], [left, bottom]])
            {
                vertex.uv = uv;
            }
            if turned {
                shape.indices = vec![1, 0, 3, 1, 3, 2];
            }
            Shape { scissor, image: Some(image), ..shape }
        },
    )
}

/// A part of an image, from far less than any painter would notice.
fn magnitude() -> impl Strategy<Value = f32> {
    (5..22_u32).prop_map(|bits| 1.0 / (1 << bits) as f32)
}

/// Upright rectangles of one colour, at any place.
fn panel() -> impl Strategy<Value = Shape> {
    let range = || [-9.0..40.0_f32, -9.0..32.0_f32];
    (range(), range(), color(), scissor())
        .prop_map(|(a, b, color, scissor)| Shape { scissor, ..Shape::rectangle(a, b, color) })
}

proptest! {
    #![proptest_config(cases(512))]

    #[test]
    fn a_glyph_is_its_two_triangles(shape in glyph()) {
        let (pixels, counts) = painted_over(&background(), &[shape.mesh()]);
        prop_assert_eq!(pixels, painted(&shape.apart()));
        let seen = !shape.scissor.intersection(Rect::new([0; 2], SIZE)).is_empty();
        prop_assert_eq!(counts.in_rectangles, if seen { 2 } else { 0 }, "glyphs take the fast path");
    }

    /// What is no more than almost one to one is filtered, by either way.
    #[test]
    fn a_glyph_between_texels_is_its_two_triangles(shape in glyph(), off in [magnitude(), magnitude()]) {
        let mut shape = shape;
        for vertex in &mut shape.vertices {
            vertex.uv = [vertex.uv[0] + off[0], vertex.uv[1] + off[1]];
        }
        prop_assert_eq!(painted(&[shape.mesh()]), painted(&shape.apart()));
    }

    /// As several threads paint it.
    #[test]
    fn rows_of_an_image_are_painted_as_the_whole(
        shapes in proptest::collection::vec(prop_oneof![shape(), glyph(), panel()], 1..4),
        count in 1..40_usize,
    ) {
        let mut pixels = background();
        let [width, height] = SIZE.map(|side| side as usize);
        for (number, band) in pixels.chunks_mut(count * width).enumerate() {
            let top = number * count;
            let rows = top as u32..(top + count).min(height) as u32;
            let mut canvas = Canvas::of_rows(width as u32, rows, band).expect("its rows");
            Painter::new().paint(&mut canvas, &meshes(&shapes));
        }
        prop_assert_eq!(pixels, painted(&meshes(&shapes)));
    }

    #[test]
    fn a_panel_is_its_two_triangles(shape in panel()) {
        prop_assert_eq!(painted(&[shape.mesh()]), painted(&shape.apart()));
    }

    #[test]
    fn every_level_paints_the_same(shapes in proptest::collection::vec(prop_oneof![shape(), glyph(), panel()], 1..4)) {
        let expected = painted(&meshes(&shapes));
        for level in SimdLevel::ALL.into_iter().filter(|level| level.is_supported()) {
            let mut painter = Painter::with_simd(level).expect("it is supported");
            let (pixels, _) = painted_by(&mut painter, &background(), &meshes(&shapes));
            prop_assert_eq!(&pixels, &expected, "{}", level);
        }
    }

    #[test]
    fn winding_and_the_first_vertex_do_not_matter(shape in shape(), turns in proptest::collection::vec(0..6_usize, 4)) {
        const ORDERS: [[usize; 3]; 6] = [[0, 1, 2], [1, 2, 0], [2, 0, 1], [0, 2, 1], [1, 0, 2], [2, 1, 0]];
        let mut turned = shape.clone();
        for (triangle, turn) in turned.indices.chunks_mut(3).zip(turns) {
            let old = [triangle[0], triangle[1], triangle[2]];
            triangle.copy_from_slice(&ORDERS[turn].map(|i| old[i]));
        }
        prop_assert_eq!(painted(&[shape.mesh()]), painted(&[turned.mesh()]));
    }

    #[test]
    fn a_scissor_is_a_crop(shape in prop_oneof![shape(), glyph(), panel()], scissor in scissor()) {
        let whole = painted(&[Shape { scissor: EVERYWHERE, ..shape.clone() }.mesh()]);
        let cut = painted(&[Shape { scissor, ..shape }.mesh()]);
        for (i, (pixel, below)) in cut.iter().zip(background()).enumerate() {
            let [x, y] = [i as i32 % SIZE[0], i as i32 / SIZE[0]];
            let inside = !scissor.intersection(Rect::new([x, y], [x + 1, y + 1])).is_empty();
            prop_assert_eq!(*pixel, if inside { whole[i] } else { below }, "at {}, {}", x, y);
        }
    }

    /// A smaller canvas cut from the image, with everything moved by whole
    /// pixels.
    #[test]
    fn a_smaller_canvas_is_a_crop(shape in prop_oneof![shape(), glyph()], [left, top] in [0..SIZE[0], 0..SIZE[1]]) {
        let mut shape = Shape { scissor: EVERYWHERE, ..shape };
        for vertex in &mut shape.vertices {
            // On the grid, so that moving is exact.
            vertex.position = vertex.position.map(|v| (v * 256.0).round_ties_even() / 256.0);
        }
        let whole = painted(&[shape.mesh()]);
        let crop = |pixels: &[[u8; 4]]| -> Vec<[u8; 4]> {
            pixels.chunks(SIZE[0] as usize).skip(top as usize).flat_map(|row| row[left as usize..].to_vec()).collect()
        };
        for vertex in &mut shape.vertices {
            vertex.position = [vertex.position[0] - left as f32, vertex.position[1] - top as f32];
        }
        let [width, height] = [SIZE[0] - left, SIZE[1] - top].map(i32::cast_unsigned);
        let mut pixels = crop(&background());
        let mut canvas = Canvas::new(width, height, &mut pixels).expect("the sides and the pixels agree");
        Painter::new().paint(&mut canvas, &[shape.mesh()]);
        prop_assert_eq!(pixels, crop(&whole));
    }

    /// Submission order: all at once is one after the other, triangle by
    /// triangle.
    #[test]
    fn painting_in_steps_is_painting_at_once(shapes in proptest::collection::vec(shape(), 1..4)) {
        let mut pixels = background();
        let mut painter = Painter::new();
        for shape in &shapes {
            for mesh in shape.apart() {
                pixels = painted_by(&mut painter, &pixels, &[mesh]).0;
            }
        }
        prop_assert_eq!(pixels, painted(&meshes(&shapes)));
    }
}

#[test]
fn panels_are_painted_as_rectangles() {
    let corners = [[3.25, 4.5], [20.0, 9.125]];
    let mut panel = Shape::rectangle(corners[0], corners[1], [10, 20, 30, 200]);
    for indices in [[0, 1, 2, 2, 3, 0], [3, 0, 1, 1, 3, 2], [1, 2, 0, 3, 2, 0]] {
        panel.indices = indices.to_vec();
        let counts = painted_over(&background(), &[panel.mesh()]).1;
        assert_eq!((counts.triangles, counts.in_rectangles), (2, 2), "{indices:?}");
    }
    for indices in [[0, 1, 2, 0, 1, 2], [0, 1, 2, 0, 1, 3]] {
        panel.indices = indices.to_vec();
        assert_eq!(painted_over(&background(), &[panel.mesh()]).1.in_rectangles, 0, "{indices:?} overlap");
    }
}

#[test]
fn what_comes_later_is_above() {
    let sheet = |color| Shape::rectangle([0.0; 2], [64.0; 2], color);
    let (red, half_blue) = ([200, 0, 0, 255], [0, 0, 100, 128]);
    let pixel = |shapes: &[Shape]| painted(&meshes(shapes))[0];
    assert_eq!(
        pixel(&[sheet(red), sheet(half_blue)]),
        [100, 0, 100, 255],
        "127/255 of the red, and the blue"
    );
    assert_eq!(pixel(&[sheet(half_blue), sheet(red)]), red, "the red is opaque");
    let mut both = sheet(red);
    both.vertices.extend(sheet(half_blue).vertices);
    both.indices = vec![0, 1, 2, 4, 5, 6, 2, 3, 0, 6, 7, 4];
    assert_eq!(painted(&[both.mesh()])[1], [100, 0, 100, 255], "in one mesh, too, by its indices");
}

/// Colours above alpha add light and end at 255.
#[test]
fn additive_colours_saturate() {
    let light = Shape::rectangle([0.0; 2], [64.0; 2], [90, 10, 0, 0]);
    let below = vec![[200, 100, 7, 255]; (SIZE[0] * SIZE[1]) as usize];
    let (pixels, _) = painted_over(&below, &[light.mesh()]);
    assert!(pixels.iter().all(|&pixel| pixel == [255, 110, 7, 255]), "all pixels are lit: {:?}", pixels[0]);
}
