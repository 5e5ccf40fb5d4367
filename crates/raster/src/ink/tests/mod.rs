//! Images of faces with edges: white faces, black lines, on white.

mod marks;

use crate::simd::SimdLevel;
use crate::{
    Background, BlendMode, Certainty, Culling, Draw, EdgeFlags, ExecuteSettings, FaceEdges, Fragment, Lines,
    Output, Pass, Pipeline, Points, Rasterizer, Rect, Target, TileSize, Tolerance, VertexOutput,
};
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::{Vec3, Vec4};

/// The side of all images in pixels.
const SIDE: u32 = 48;

/// Faces of one colour, their corners in pixels with a depth.
#[derive(Debug)]
struct Faces {
    corners: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    flags: Vec<EdgeFlags>,
    color: Vec4,
    blend_mode: BlendMode,
}

impl Pipeline for Faces {
    type Varyings = ();

    fn vertex_count(&self) -> usize {
        self.corners.len()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        let Vec3 { x, y, z } = self.corners[index];
        let scale = 2.0 / SIDE as f32;
        VertexOutput { position: Vec4::new(x * scale - 1.0, 1.0 - y * scale, z, 1.0), varyings: () }
    }

    fn fragment(&self, _: &Fragment<()>) -> Vec4 {
        self.color
    }
}

impl Faces {
    fn triangles(corners: Vec<Vec3>) -> Self {
        let count = corners.len() as u32 / 3;
        let triangles = (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let flags = vec![EdgeFlags::ALL; count as usize];
        Self { corners, triangles, flags, color: Vec4::ONE, blend_mode: BlendMode::Opaque }
    }

    /// Rectangles of two triangles each: left, top, right, bottom and depth.
    fn rectangles(rectangles: &[[f32; 5]]) -> Self {
        let mut faces = Self::triangles(Vec::new());
        for &[left, top, right, bottom, z] in rectangles {
            let first = faces.corners.len() as u32;
            let corners = [[left, top], [left, bottom], [right, bottom], [right, top]];
            faces.corners.extend(corners.map(|[x, y]| Vec3::new(x, y, z)));
            faces.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|half| half.map(|i: u32| first + i)));
            faces.flags.extend([[true, true, false], [false, true, true]].map(EdgeFlags::new));
        }
        faces
    }
}

/// The corners of faces, for lines and points of one colour each.
struct FlatMarks<'f>(&'f Faces);

impl Pipeline for FlatMarks<'_> {
    type Varyings = ();
    const FLAT: bool = true;

    fn vertex_count(&self) -> usize {
        self.0.vertex_count()
    }

    fn vertex(&self, index: usize) -> VertexOutput<()> {
        self.0.vertex(index)
    }

    fn fragment(&self, fragment: &Fragment<()>) -> Vec4 {
        self.0.fragment(fragment)
    }
}

/// How an image is drawn.
#[derive(Clone, Copy, Debug)]
struct Grid {
    samples_per_axis: u32,
    samples: u32,
}

const PLAIN: Grid = Grid { samples_per_axis: 1, samples: 1 };

fn pass<'a>(faces: &'a [&'a Faces], width: f32) -> Pass<'a> {
    let mut pass = Pass::new();
    pass.background(Background::Color(Vec4::ONE));
    pass.edges(FaceEdges { width, color: Vec3::ZERO, opacity: 1.0 });
    for (object, faces) in (0..).zip(faces) {
        pass.triangles(Draw {
            edge_flags: Some(&faces.flags),
            object,
            culling: Culling::None,
            blend_mode: faces.blend_mode,
            ..Draw::new(*faces, &faces.triangles)
        });
    }
    pass
}

fn target<'a>(grid: Grid) -> Target<'a> {
    let target = Target::new(SIDE, SIDE, &[Output::Linear]).unwrap();
    target.with_samples_per_axis(grid.samples_per_axis).unwrap().with_samples(grid.samples).unwrap()
}

fn image(faces: &[&Faces], width: f32, grid: Grid, settings: ExecuteSettings) -> Vec<Vec4> {
    let mut target = target(grid);
    Rasterizer::new(settings).unwrap().draw(&pass(faces, width), &mut target);
    target.linear().unwrap().to_vec()
}

/// How dark a plain image is, pixel by pixel.
fn darkness(faces: &[&Faces], width: f32, tile_size: TileSize) -> Vec<f32> {
    let settings = ExecuteSettings { tile_size, ..Default::default() };
    image(faces, width, PLAIN, settings).into_iter().map(|color| 1.0 - color.x).collect()
}

fn at(image: &[f32], x: u32, y: u32) -> f32 {
    image[(y * SIDE + x) as usize]
}

/// The distance of a pixel's centre from the outline of a rectangle.
fn distance([left, top, right, bottom]: [f32; 4], x: u32, y: u32) -> f32 {
    let [x, y] = [x, y].map(|v| v as f32 + 0.5);
    let [dx, dy] = [(left - x).max(x - right), (top - y).max(y - bottom)];
    let [outside_x, outside_y] = [dx.max(0.0), dy.max(0.0)];
    if dx < 0.0 && dy < 0.0 { -dx.max(dy) } else { (outside_x * outside_x + outside_y * outside_y).sqrt() }
}

/// Rounding of distances below 100 pixels: a few units of 2^-17.
const ROUNDING: f32 = 1e-4;

/// Also shows that no diagonal is painted, and that lines go on from tile to tile and around
/// corners.
#[test]
fn an_outline_is_the_same_inside_and_outside_across_all_tiles() {
    let outline = [7.25, 9.5, 40.0, 33.75];
    let [left, top, right, bottom] = outline;
    let faces = Faces::rectangles(&[[left, top, right, bottom, 0.5]]);
    for width in [0.5, 1.0, 2.0, 5.0_f32] {
        for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels64] {
            let found = darkness(&[&faces], width, tile_size);
            for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
                let overlap = width * 0.5 + 0.5 - distance(outline, x, y);
                let expected = overlap.clamp(0.0, width.min(1.0));
                let found = at(&found, x, y);
                assert!(
                    (found - expected).abs() < ROUNDING,
                    "{found} for {expected} at ({x}, {y}), {width} wide, {tile_size:?}"
                );
            }
        }
    }
}

#[test]
fn faces_side_by_side_share_one_line_of_full_width() {
    let columns: Vec<_> =
        (0..4).map(|i| [4.0 + 10.0 * i as f32, 6.0, 14.0 + 10.0 * i as f32, 42.0, 0.5]).collect();
    let found = darkness(&[&Faces::rectangles(&columns)], 2.0, TileSize::Automatic);
    for x in 6..40 {
        let line = ((x as f32 + 0.5 - 4.0) / 10.0).round() * 10.0 + 4.0;
        let expected = (1.5 - (x as f32 + 0.5 - line).abs()).clamp(0.0, 1.0);
        assert!((at(&found, x, 20) - expected).abs() < ROUNDING, "{} at {x}", at(&found, x, 20));
    }
}

#[test]
fn edges_behind_a_face_stay_behind_it() {
    let back = Faces::rectangles(&[[4.0, 4.0, 24.0, 44.0, 0.3]]);
    let front = Faces::rectangles(&[[20.0, 10.0, 40.0, 30.0, 0.6]]);
    let found = darkness(&[&back, &front], 4.0, TileSize::Automatic);
    // In the front face, by the edge of the back one that it hides.
    assert_eq!(at(&found, 25, 20), 0.0, "what is hidden is not painted");
    // On the back face, beside the front one's edge.
    assert!((at(&found, 18, 20) - 1.0).abs() < ROUNDING, "{}", at(&found, 18, 20));
    // On the background, beside the back one's edge.
    assert!((at(&found, 25, 40) - 1.0).abs() < ROUNDING, "{}", at(&found, 25, 40));
}

#[test]
fn translucent_faces_paint_nothing_beside_themselves() {
    let glass = Faces {
        color: Vec4::splat(0.5),
        blend_mode: BlendMode::Translucent,
        ..Faces::rectangles(&[[10.0, 10.0, 38.0, 38.0, 0.5]])
    };
    let found = darkness(&[&glass], 4.0, TileSize::Automatic);
    assert_eq!(at(&found, 8, 20), 0.0, "outside");
    assert!((at(&found, 11, 20) - 1.0).abs() < ROUNDING, "inside, on the line");
    assert_eq!(at(&found, 24, 24), 0.0, "half of white over white");
}

#[test]
fn only_draws_that_list_edges_show_them() {
    let [left, right] = [4.0, 28.0].map(|x| Faces::rectangles(&[[x, 10.0, x + 16.0, 38.0, 0.5]]));
    let listing = [&left];
    let mut pass = pass(&listing, 4.0);
    pass.triangles(Draw { object: 1, culling: Culling::None, ..Draw::new(&right, &right.triangles) });
    let mut target = target(PLAIN);
    Rasterizer::default().draw(&pass, &mut target);
    for (index, &color) in (0..).zip(target.linear().unwrap()) {
        let [x, y]: [u32; 2] = [index % SIDE, index / SIDE];
        // The lines of the left one are two pixels wide on either side of its edges.
        let beside = [x.abs_diff(4).min(x.abs_diff(19)), y.abs_diff(10).min(y.abs_diff(37))];
        if (6..18).contains(&x) && (12..36).contains(&y) || !(2..22).contains(&x) || !(8..40).contains(&y) {
            assert!((color - Vec4::ONE).abs().max_element() < ROUNDING, "{color} at ({x}, {y}), not white");
        } else if beside[0] == 0 && (10..38).contains(&y) || beside[1] == 0 && (4..20).contains(&x) {
            assert!(color.x < ROUNDING, "{color} on an edge, at ({x}, {y})");
        }
    }
}

/// Slivers of a fan around a corner of a large square: each by itself would count as small.
#[test]
fn slivers_of_a_large_polygon_have_lines_of_full_width() {
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.5);
    // A square whose left side has corners every half a pixel, cut into ears at its right.
    let mut corners = vec![corner(40.0, 8.0), corner(40.0, 40.0)];
    corners.extend((0..=64).map(|i| corner(8.0, 40.0 - i as f32 * 0.5)));
    let last = corners.len() as u32 - 1;
    let mut faces = Faces::triangles(Vec::new());
    faces.corners = corners;
    let radius = 2.0 * 32.0 * 32.0 / (4.0 * 32.0);
    for i in 1..last {
        faces.triangles.push([0, i, i + 1]);
        let flags = EdgeFlags::new([i == 1, true, i + 1 == last]);
        // Twice the triangle's area over the length of its edges.
        let own = if i == 1 { 32.0 * 32.0 / 64.0 } else { 0.5 * 32.0 / 0.5 };
        faces.flags.push(flags.with_radius_ratio(radius / own));
    }
    let found = darkness(&[&faces], 3.0, TileSize::Automatic);
    for y in 12..36 {
        for (x, expected) in [(6, 0.5), (7, 1.0), (8, 1.0), (9, 0.5), (12, 0.0)] {
            let found = at(&found, x, y);
            assert!((found - expected).abs() < ROUNDING, "{found} for {expected} at ({x}, {y})");
        }
    }
}

fn faces() -> impl Strategy<Value = Faces> {
    let point = || {
        let near = [-4.0..52.0_f32, -4.0..52.0_f32, 0.0..1.0_f32];
        // Many meet in a few points.
        let shared = (0..5_u8, 0..5_u8).prop_map(|(x, y)| [f32::from(x) * 11.3, f32::from(y) * 9.7, 0.5]);
        prop_oneof![near, shared].prop_map(Vec3::from_array)
    };
    let small = (point(), [-3.0..3.0_f32, -3.0..3.0, -3.0..3.0, -3.0..3.0])
        .prop_map(|(at, [a, b, c, d])| [at, at + Vec3::new(a, b, 0.01), at + Vec3::new(c, d, -0.01)]);
    let triangle = prop_oneof![[point(), point(), point()], small];
    proptest::collection::vec((triangle, 0..8_u8, 1.0..9.0_f32), 1..40).prop_map(|triangles| {
        let corners = triangles.iter().flat_map(|(corners, ..)| *corners).collect();
        let flags = triangles.iter().map(|(_, bits, ratio)| {
            EdgeFlags::new([0, 1, 2].map(|bit| bits >> bit & 1 != 0)).with_radius_ratio(*ratio)
        });
        Faces { flags: flags.collect(), ..Faces::triangles(corners) }
    })
}

fn grid() -> impl Strategy<Value = Grid> {
    let plain = (1..=3_u32).prop_map(|samples_per_axis| Grid { samples_per_axis, samples: 1 });
    prop_oneof![plain, Just(Grid { samples_per_axis: 1, samples: 4 })]
}

fn width() -> impl Strategy<Value = f32> {
    prop_oneof![Just(0.5_f32), Just(1.0), Just(2.0), Just(5.0), Just(16.0), 0.1..20.0_f32]
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn edges_are_the_same_bytes_for_all_tiles_threads_and_levels(
        opaque in faces(), glass in faces(), grid in grid(), width in width(), with_glass in any::<bool>(),
    ) {
        let glass = Faces { color: Vec4::splat(0.5), blend_mode: BlendMode::Translucent, ..glass };
        let list: &[&Faces] = if with_glass { &[&opaque, &glass] } else { &[&opaque] };
        let expected = image(list, width, grid, ExecuteSettings::default());
        let tiles = [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64];
        for tile_size in tiles {
            let settings = ExecuteSettings { tile_size, threads: NonZeroUsize::new(2), ..Default::default() };
            prop_assert!(image(list, width, grid, settings) == expected, "{:?}", tile_size);
        }
        for level in SimdLevel::ALL.into_iter().filter(|level| level.token().is_some()) {
            let settings = ExecuteSettings { simd: Some(level), ..Default::default() };
            prop_assert!(image(list, width, grid, settings) == expected, "{:?}", level);
        }
    }

    /// A tile did not list the lines and points that only its neighbours show, so it painted edges of faces
    /// that these hide.
    #[test]
    fn edges_under_lines_and_points_of_a_neighbouring_tile_were_painted(
        opaque in faces(), beside in faces(), grid in grid(), width in width(), size in 1.0..40.0_f32,
    ) {
        let segments: Vec<[u32; 2]> = beside.triangles.iter().map(|&[a, b, _]| [a, b]).collect();
        let points: Vec<u32> = beside.triangles.iter().map(|&[.., c]| c).collect();
        let (list, marks) = ([&opaque], FlatMarks(&beside));
        let draw = |tile_size| {
            let mut pass = pass(&list, width);
            pass.lines(Lines { width: size, ..Lines::new(&marks, &segments) });
            pass.points(Points::new(&marks, &points, size));
            let mut target = target(grid);
            let settings = ExecuteSettings { tile_size, ..Default::default() };
            Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
            target.linear().unwrap().to_vec()
        };
        let expected = draw(TileSize::Pixels64);
        for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32] {
            prop_assert!(draw(tile_size) == expected, "{:?}", tile_size);
        }
    }

    #[test]
    fn a_part_of_an_image_has_the_edges_of_the_whole(
        opaque in faces(), grid in grid(), width in width(), first in [0..40_i32, 0..40_i32],
    ) {
        let list: &[&Faces] = &[&opaque];
        let whole = image(list, width, grid, ExecuteSettings::default());
        let last = first.map(|v| v + 7);
        let mut target = target(grid);
        let mut pass = pass(list, width);
        Rasterizer::default().draw(pass.scissor(Rect::new(first, last)), &mut target);
        let part = target.linear().unwrap();
        for (y, x) in (first[1]..last[1]).flat_map(|y| (first[0]..last[0]).map(move |x| (y, x))) {
            let pixel = y as usize * SIDE as usize + x as usize;
            prop_assert_eq!(part[pixel], whole[pixel], "({}, {})", x, y);
        }
    }

    #[test]
    fn explained_pixels_show_their_edges(
        opaque in faces(), grid in grid(), width in width(), x in 0..SIDE, y in 0..SIDE,
    ) {
        let list: &[&Faces] = &[&opaque];
        let drawn = image(list, width, grid, ExecuteSettings::default());
        let target = Target::new(SIDE, SIDE, &[]).unwrap();
        let target = target.with_samples_per_axis(grid.samples_per_axis).unwrap();
        let target = target.with_samples(grid.samples).unwrap();
        let explained = Rasterizer::default().explain_pixel(&pass(list, width), &target, x, y).unwrap();
        prop_assert_eq!(explained.color, drawn[(y * SIDE + x) as usize]);
    }
}

#[test]
fn pixels_beside_an_uncertain_edge_are_uncertain_as_far_as_the_line_reaches() {
    let faces = Faces::rectangles(&[[10.0, 10.0, 30.5, 30.0, 0.5]]);
    let doubtful = |width: f32| {
        let mut rasterizer = Rasterizer::default();
        let certificate =
            rasterizer.certify(&pass(&[&faces], width), &target(PLAIN), Tolerance::default()).unwrap();
        (0..SIDE).filter(|&x| certificate.certainty(x, 20) == Certainty::Visibility).collect::<Vec<_>>()
    };
    // The edge goes through the centres of this column.
    assert_eq!(doubtful(0.0), [30], "without lines");
    assert_eq!(doubtful(3.0), [28, 29, 30, 31, 32], "a line reaches 2 pixels");
}
