//! Which texel is seen where.

use super::shapes::{EVERYWHERE, SIZE, Shape, painted_over};
use trigon_raster::paint2d::{Image, Rect, Vertex};
use trigon_raster::{Filter, Wrap};

const WIDTH: u32 = 5;
const HEIGHT: u32 = 3;

/// An opaque image, every texel different.
fn image(filter: Filter, wrap: Wrap) -> Image {
    let texels = (0..WIDTH * HEIGHT).map(|i| [i as u8 * 10, 255 - i as u8 * 7, i as u8, 255]).collect();
    let mut image = Image::new(WIDTH, HEIGHT, texels).expect("the sides and the texels agree");
    (image.filter, image.wrap) = (filter, wrap);
    image
}

/// The canvas covered by a triangle on which texel (x, y) of `image` is at the
/// `scale` by `scale` pixels from (x, y) · scale + `offset`.
fn covered(image: Image, scale: f32, offset: [f32; 2]) -> Vec<[u8; 4]> {
    let vertex = |position: [f32; 2]| {
        let texel = [0, 1].map(|axis| (position[axis] - offset[axis]) / scale);
        let uv = [texel[0] / WIDTH as f32, texel[1] / HEIGHT as f32];
        Vertex { position, uv, color: [255; 4] }
    };
    let vertices = [[-8.0, -8.0], [120.0, -8.0], [-8.0, 120.0]].map(vertex).to_vec();
    let shape = Shape { scissor: EVERYWHERE, vertices, indices: vec![0, 1, 2], image: Some(image) };
    painted_over(&vec![[9; 4]; (SIZE[0] * SIZE[1]) as usize], &[shape.mesh()]).0
}

/// What each wrap mode shows, as indices of an axis, beyond both ends.
fn wrapped(wrap: Wrap, size: i32) -> impl Fn(i32) -> i32 {
    let once: Vec<i32> = (0..size).collect();
    let mirrored: Vec<i32> = (0..size).chain((0..size).rev()).collect();
    move |index: i32| match wrap {
        Wrap::ClampToEdge => index.max(0).min(size - 1),
        Wrap::Repeat => once[index.rem_euclid(size) as usize],
        Wrap::MirroredRepeat => mirrored[index.rem_euclid(2 * size) as usize],
    }
}

#[test]
fn the_centre_of_a_texel_has_its_colour_with_every_filter_and_wrap() {
    for filter in [Filter::Nearest, Filter::Linear] {
        for wrap in [Wrap::ClampToEdge, Wrap::Repeat, Wrap::MirroredRepeat] {
            let image = image(filter, wrap);
            let [column, row] = [wrapped(wrap, WIDTH as i32), wrapped(wrap, HEIGHT as i32)];
            let pixels = covered(image.clone(), 1.0, [7.0, 11.0]);
            for (i, &pixel) in pixels.iter().enumerate() {
                let [x, y] = [i as i32 % SIZE[0], i as i32 / SIZE[0]];
                let texel = row(y - 11) * WIDTH as i32 + column(x - 7);
                assert_eq!(pixel, image.texels()[texel as usize], "{filter:?}, {wrap:?}, at {x}, {y}");
            }
        }
    }
}

#[test]
fn nearest_makes_blocks_of_texels() {
    let image = image(Filter::Nearest, Wrap::Repeat);
    for scale in [2, 4, 8] {
        let pixels = covered(image.clone(), scale as f32, [0.0; 2]);
        for (i, &pixel) in pixels.iter().enumerate() {
            let [x, y] = [i as i32 % SIZE[0], i as i32 / SIZE[0]];
            let texel = y / scale % HEIGHT as i32 * WIDTH as i32 + x / scale % WIDTH as i32;
            assert_eq!(pixel, image.texels()[texel as usize], "at {x}, {y}, {scale} times as large");
        }
    }
}

#[test]
fn a_delta_replaces_a_rectangle_and_nothing_else() {
    let mut image = image(Filter::Nearest, Wrap::ClampToEdge);
    let before = image.texels().to_vec();
    let area = Rect::new([2, 1], [4, 3]);
    image.update(area, &[[1; 4], [2; 4], [3; 4], [4; 4]]).expect("it is inside");
    for (i, &texel) in image.texels().iter().enumerate() {
        let expected = match i {
            7 => [1; 4],
            8 => [2; 4],
            12 => [3; 4],
            13 => [4; 4],
            _ => before[i],
        };
        assert_eq!(texel, expected, "texel {i}");
    }
}

#[test]
fn wrong_sizes_are_refused() {
    let mut image = image(Filter::Nearest, Wrap::ClampToEdge);
    let before = image.clone();
    for (area, texels) in [
        (Rect::new([4, 0], [6, 1]), 2),
        (Rect::new([-1, 0], [1, 1]), 2),
        (Rect::new([0, 0], [2, 1]), 3),
        (Rect::new([0, 0], [0, 1]), 0),
        (Rect::new([3, 2], [1, 1]), 2),
        (Rect::new([i32::MIN; 2], [i32::MAX; 2]), 1),
    ] {
        assert!(image.update(area, &vec![[0; 4]; texels]).is_err(), "{area:?} with {texels} texels");
    }
    assert_eq!(image, before, "what is refused changes nothing");
    for (width, height, texels) in [(0, 5, 0), (2, 2, 3), (20_000, 1, 20_000)] {
        assert!(Image::new(width, height, vec![[0; 4]; texels]).is_err(), "{width}x{height} with {texels}");
    }
}
