//! A pass with a scissor: inside the rectangle the bytes of the whole image,
//! outside of it what the caller's buffers held.

use crate::coverage_support::{Samples, rasterizer};
use crate::effort::cases;
use crate::programs::{Scalar, Vertices};
use proptest::prelude::*;
use trigon_math::{UVec2, Vec3, Vec4};
use trigon_raster::{
    Background, BlendMode, Culling, Draw, ExecuteSettings, Lines, Output, Pass, Rect, Target, TargetImages,
    TileSize,
};

const SIZE: [u32; 2] = [75, 52];

/// What a frame shows.
#[derive(Debug)]
struct Scene {
    vertices: Vertices,
    surfaces: Vec<BlendMode>,
    background: Vec4,
}

fn scene() -> impl Strategy<Value = Scene> {
    let position = (-1.5_f32..1.5, -1.5_f32..1.5, 0.0_f32..1.1, -0.2_f32..3.0)
        .prop_map(|(x, y, z, w)| Vec4::new(x * w, y * w, z * w, w));
    let color = (0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0, 0.2_f32..1.0).prop_map(Vec4::from);
    let surface = prop_oneof![Just(BlendMode::Opaque), Just(BlendMode::Masked), Just(BlendMode::Translucent)];
    let surfaces = proptest::collection::vec(surface, 0..3);
    (proptest::collection::vec((position, color), 3..20), surfaces, any::<bool>()).prop_map(
        |(list, surfaces, blank)| {
            let mut vertices = Vertices::default();
            for (position, color) in list {
                vertices.push(position, color);
            }
            let background = if blank { Vec4::ZERO } else { Vec4::new(0.1, 0.2, 0.3, 1.0) };
            Scene { vertices, surfaces, background }
        },
    )
}

/// Draws with or without a scissor.
fn draw(scene: &Scene, gradient: bool, scissor: Option<Rect>, tile_size: TileSize, target: &mut Target<'_>) {
    let pipeline = Scalar(&scene.vertices);
    let count = scene.vertices.len() as u32;
    let triangles: Vec<_> = (0..count).map(|i| [i, (i + 1) % count, (i + 5) % count]).collect();
    let segments: Vec<_> = (1..count).map(|i| [i - 1, i]).collect();
    let shades = |pixel: UVec2| Vec3::new(pixel.x as f32, pixel.y as f32, 40.0).extend(80.0) / 80.0;
    let mut pass = Pass::new();
    pass.background(if gradient {
        Background::PerPixel(&shades)
    } else {
        Background::Color(scene.background)
    });
    for (object, &surface) in scene.surfaces.iter().enumerate() {
        let object = object as u32;
        let draw = Draw::new(&pipeline, &triangles);
        pass.triangles(Draw { object, blend_mode: surface, culling: Culling::None, ..draw });
        pass.lines(Lines {
            object: object + 10,
            blend_mode: surface,
            width: 2.0,
            ..Lines::new(&pipeline, &segments)
        });
    }
    if let Some(rect) = scissor {
        pass.scissor(rect);
    }
    let settings = ExecuteSettings { tile_size, ..ExecuteSettings::default() };
    rasterizer(&settings).draw(&pass, target);
}

/// Rectangles of all kinds: within the image, over its rim, empty, inside out.
fn rect() -> impl Strategy<Value = Rect> {
    let at = |side: u32| {
        let side = side as i32;
        prop_oneof![4 => 0..side, 1 => -side..2 * side, 1 => Just(0), 1 => Just(side), 1 => Just(i32::MAX), 1 => Just(i32::MIN)]
    };
    let corner = (at(SIZE[0]), at(SIZE[1]));
    (corner.clone(), corner, any::<bool>()).prop_map(|(a, b, sorted)| {
        let [low, high] = if sorted {
            [[a.0.min(b.0), a.1.min(b.1)], [a.0.max(b.0), a.1.max(b.1)]]
        } else {
            [[a.0, a.1], [b.0, b.1]]
        };
        Rect::new(low, high)
    })
}

fn outputs() -> impl Strategy<Value = Vec<Output>> {
    use Output::{Depth, Face, Linear, Object, Srgb8, Triangle, Unorm8};
    prop_oneof![
        Just(vec![Srgb8]),
        Just(vec![Unorm8]),
        Just(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle]),
        proptest::sample::subsequence(vec![Srgb8, Unorm8, Linear, Depth, Object, Face, Triangle], 1..7),
    ]
}

/// The pixels of `inside` within the rectangle, of `outside` elsewhere.
fn pasted<T: Copy>(rect: Rect, inside: Option<&Vec<T>>, outside: Option<&Vec<T>>) -> Option<Vec<T>> {
    let within = |index: usize| {
        let pixel = [index as i32 % SIZE[0] as i32, index as i32 / SIZE[0] as i32];
        (0..2).all(|axis| rect.min[axis] <= pixel[axis] && pixel[axis] < rect.max[axis])
    };
    let pairs = inside?.iter().zip(outside?).enumerate();
    Some(pairs.map(|(index, (&a, &b))| if within(index) { a } else { b }).collect())
}

proptest! {
    #![proptest_config(cases(120))]

    #[test]
    fn a_scissor_is_a_crop(
        scenes in [scene(), scene()],
        rect in rect(),
        outputs in outputs(),
        samples in Samples::any(),
        gradient in any::<bool>(),
        tile_size in prop_oneof![Just(TileSize::Pixels8), Just(TileSize::Automatic)],
    ) {
        let [before, after] = &scenes;
        let image = |scene: &Scene| {
            let mut target = samples.target(SIZE, &outputs);
            draw(scene, gradient, None, tile_size, &mut target);
            target.into_images()
        };
        let (whole, old) = (image(after), image(before));
        let mut target = samples.target(SIZE, &outputs);
        draw(before, gradient, None, tile_size, &mut target);
        draw(after, gradient, Some(rect), tile_size, &mut target);
        let expected = TargetImages {
            srgb8: pasted(rect, whole.srgb8.as_ref(), old.srgb8.as_ref()),
            unorm8: pasted(rect, whole.unorm8.as_ref(), old.unorm8.as_ref()),
            linear: pasted(rect, whole.linear.as_ref(), old.linear.as_ref()),
            depth: pasted(rect, whole.depth.as_ref(), old.depth.as_ref()),
            objects: pasted(rect, whole.objects.as_ref(), old.objects.as_ref()),
            faces: pasted(rect, whole.faces.as_ref(), old.faces.as_ref()),
            triangles: pasted(rect, whole.triangles.as_ref(), old.triangles.as_ref()),
        };
        prop_assert!(target.into_images() == expected, "{rect:?}");
    }
}

#[test]
fn tiles_outside_of_the_scissor_are_not_drawn() {
    let mut vertices = Vertices::default();
    for [x, y] in [[-1.0, -1.0], [3.0, -1.0], [-1.0, 3.0]] {
        vertices.push(Vec4::new(x, y, 0.5, 1.0), Vec4::ONE);
    }
    let pipeline = Scalar(&vertices);
    let tiles = |rect: Option<Rect>| {
        let mut pass = Pass::new();
        pass.triangles(Draw::new(&pipeline, &[[0, 1, 2]]));
        if let Some(rect) = rect {
            pass.scissor(rect);
        }
        let settings = ExecuteSettings { tile_size: TileSize::Pixels16, ..ExecuteSettings::default() };
        let mut target = Samples::ONE.target([64, 64], &[Output::Srgb8]);
        rasterizer(&settings).draw(&pass, &mut target).tiles
    };
    assert_eq!(tiles(None), 16, "all of them");
    assert_eq!(tiles(Some(Rect::new([16, 16], [33, 17]))), 2, "those that the rectangle meets");
    assert_eq!(tiles(Some(Rect::new([16, 16], [16, 17]))), 0, "none for an empty one");
}
