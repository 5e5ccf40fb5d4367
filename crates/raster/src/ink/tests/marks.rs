//! Edges and faces in colours of their own.

use super::*;
use crate::ink::{Ink, OutlinedHalves};
use crate::{MarkColors, Marks};
use trigon_math::Vec2;

/// Faces with their marks.
#[derive(Debug)]
struct Marked {
    faces: Faces,
    sides: Vec<[u32; 3]>,
    of_edges: Vec<u8>,
    of_faces: Vec<u8>,
}

impl Marked {
    fn record<'a>(&'a self, pass: &mut Pass<'a>) {
        pass.triangles(Draw {
            edge_flags: Some(&self.faces.flags),
            marks: Some(Marks { sides: &self.sides, edges: &self.of_edges, faces: &self.of_faces }),
            culling: Culling::None,
            blend_mode: self.faces.blend_mode,
            ..Draw::new(&self.faces, &self.faces.triangles)
        });
    }

    /// On white, with plain edges of an opacity.
    fn image(
        &self,
        (width, opacity): (f32, f32),
        colors: MarkColors,
        (grid, settings): (Grid, ExecuteSettings),
    ) -> Vec<Vec4> {
        let mut pass = pass(&[], width);
        pass.edges(FaceEdges { width, color: Vec3::ZERO, opacity }).marks(colors);
        self.record(&mut pass);
        let mut target = target(grid);
        Rasterizer::new(settings).unwrap().draw(&pass, &mut target);
        target.linear().unwrap().to_vec()
    }
}

const BLACK: Vec4 = Vec4::W;

/// Different ones, a little transparent.
fn colors() -> MarkColors {
    let mut colors = MarkColors::NONE;
    for mark in 1..4_u8 {
        let value = f32::from(mark);
        colors.edges[usize::from(mark)] = Vec4::new(0.3 * value, 0.9 / value, 0.2, 0.5 + 0.1 * value);
        colors.faces[usize::from(mark)] = Vec4::new(0.5, 0.2 * value, 0.1, 0.2 * value);
    }
    colors
}

/// The same, of which one has outlined edges, if there are to be any.
fn colors_with_outlines(has_outlines: bool) -> MarkColors {
    let mut colors = colors();
    colors.outlined[2] = has_outlines;
    colors
}

fn premultiplied(color: Vec4) -> Vec4 {
    (color.truncate() * color.w).extend(color.w)
}

/// Also beside the rectangle, and along its diagonal.
#[test]
fn the_edge_that_covers_most_of_a_pixel_gives_it_its_colour() {
    let (low, high) = (8.25, 40.0);
    let faces = Faces::rectangles(&[[low, low, high, high, 0.5]]);
    // Left, bottom, right, top; the diagonal is none.
    let sides = vec![[0, 1, u32::MAX], [u32::MAX, 2, 3]];
    let marks = [1_u8, 0, 3, 2];
    let marked = Marked { faces, sides, of_edges: marks.to_vec(), of_faces: Vec::new() };
    let colors = colors();
    for width in [1.0, 4.0_f32] {
        let found = marked.image((width, 0.25), colors, (PLAIN, ExecuteSettings::default()));
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let beside = |v: f32| (low - v).max(v - high).max(0.0);
            let [px, py] = [x, y].map(|v| v as f32 + 0.5);
            let distances = [
                Vec2::new(px - low, beside(py)).length(),
                Vec2::new(py - high, beside(px)).length(),
                Vec2::new(px - high, beside(py)).length(),
                Vec2::new(py - low, beside(px)).length(),
            ];
            let overlap = |distance: f32| (width * 0.5 + 0.5 - distance).clamp(0.0, width.min(1.0));
            let mut shares: Vec<_> = distances.map(overlap).into_iter().zip(marks).collect();
            shares.sort_by(|a, b| b.partial_cmp(a).unwrap());
            let [(share, mark), (next, other), ..] = shares[..] else { unreachable!("four sides") };
            if mark != other && share != next && share - next < ROUNDING {
                // Rounding decides.
                continue;
            }
            let ink =
                if mark == 0 { Vec4::new(0.0, 0.0, 0.0, 0.25) } else { colors.edges[usize::from(mark)] };
            let expected = Vec4::ONE * (1.0 - ink.w * share) + premultiplied(ink) * share;
            let found = found[(y * SIDE + x) as usize];
            let difference = (found - expected).abs().max_element();
            assert!(difference < ROUNDING, "{found} for {expected} at ({x}, {y}), {width} wide");
        }
    }
}

/// Twice as wide, with a black rim of a line on each side; beyond its ends no wider than others.
#[test]
fn an_outlined_edge_is_wide_with_a_black_rim_and_nothing_sticks_out_at_its_ends() {
    let (low, high) = (8.25, 40.0);
    let faces = Faces::rectangles(&[[low, low, high, high, 0.5]]);
    let sides = vec![[0, 1, u32::MAX], [u32::MAX, 2, 3]];
    // Of left, bottom, right, top.
    let marks = [1_u8, 0, 2, 0];
    let marked = Marked { faces, sides, of_edges: marks.to_vec(), of_faces: Vec::new() };
    let mut colors = MarkColors::NONE;
    colors.edges[1] = Vec4::new(1.0, 0.5, 0.0, 1.0);
    colors.edges[2] = Vec4::new(0.0, 1.0, 0.0, 0.75);
    colors.outlined[1] = true;
    for width in [1.0, 2.0_f32] {
        let found = marked.image((width, 1.0), colors, (PLAIN, ExecuteSettings::default()));
        let covered = |half: f32, distance: f32| (half + 0.5 - distance).clamp(0.0, (2.0 * half).min(1.0));
        let mut rims = 0;
        for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
            let [px, py] = [x, y].map(|v| v as f32 + 0.5);
            let lines = [(px, py, low), (py, px, high), (px, py, high), (py, px, low)];
            let mut strokes: Vec<_> = lines
                .into_iter()
                .zip(marks)
                .map(|((across, along, at), mark)| {
                    let beyond = (low - along).max(along - high).max(0.0);
                    let distance = Vec2::new(across - at, beyond).length();
                    let halves = if mark == 1 && beyond == 0.0 { [2.0, 1.0] } else { [0.5, 0.5] };
                    let [share, core] = halves.map(|half| covered(half * width, distance));
                    (share + core, mark, share, core)
                })
                .collect();
            strokes.sort_by(|a, b| b.partial_cmp(a).unwrap());
            let [(most, mark, share, core), (next, other, ..), ..] = strokes[..] else {
                unreachable!("four")
            };
            if mark != other && most != next && most - next < ROUNDING {
                // Rounding decides.
                continue;
            }
            let ink = if mark == 0 { BLACK } else { colors.edges[usize::from(mark)] };
            let painted = (ink.truncate() * ink.w * core).extend(ink.w * share);
            let expected = Vec4::ONE * (1.0 - ink.w * share) + painted;
            let found = found[(y * SIDE + x) as usize];
            let difference = (found - expected).abs().max_element();
            assert!(difference < 4.0 * ROUNDING, "{found} for {expected} at ({x}, {y}), {width} wide");
            rims += u32::from(mark == 1 && share > core + 0.1);
        }
        assert!(rims > 40, "the rim is seen: {rims}");
    }
}

/// On small faces the rim goes first, then the rest, as of other edges.
#[test]
fn the_rim_of_an_outlined_edge_goes_before_its_core() {
    let colors = MarkColors { outlined: [true; MarkColors::COUNT], ..MarkColors::NONE };
    let black = FaceEdges { width: 1.0, color: Vec3::ZERO, opacity: 1.0 };
    let ink = Ink::new(Some(&black), Some(&colors), 1).unwrap();
    for (radius, whole, core) in
        [(9.0, 2.0, 1.0), (6.0, 2.0, 1.0), (4.5, 1.5, 1.0), (3.0, 1.0, 1.0), (1.5, 0.5, 0.5)]
    {
        assert_eq!(OutlinedHalves::on(&ink, radius), OutlinedHalves { whole, core }, "at {radius}");
    }
    assert_eq!([ink.is_outlined(0), ink.is_outlined(1)], [false, true], "the edges without a mark are plain");
}

#[test]
fn marked_faces_are_tinted_below_their_edges_and_without_any() {
    let faces = Faces::rectangles(&[[4.0, 4.0, 20.0, 40.0, 0.5], [20.0, 4.0, 36.0, 40.0, 0.5]]);
    // Triangles are faces of their own: the first rectangle is marked.
    let marked = Marked { faces, sides: Vec::new(), of_edges: Vec::new(), of_faces: vec![2, 2] };
    let tint = colors().faces[2];
    let tinted = Vec4::ONE * (1.0 - tint.w) + premultiplied(tint);
    for width in [0.0, 2.0] {
        let found = marked.image((width, 1.0), colors(), (PLAIN, ExecuteSettings::default()));
        let at = |x: u32, y: u32| found[(y * SIDE + x) as usize];
        assert!((at(12, 20) - tinted).abs().max_element() < ROUNDING, "{} in the first", at(12, 20));
        assert_eq!([at(28, 20), at(42, 20)], [Vec4::ONE; 2], "in the second, and beside");
        let line = if width > 0.0 { BLACK } else { tinted };
        assert!((at(4, 20) - line).abs().max_element() < ROUNDING, "{} on the edge", at(4, 20));
    }
}

fn marked() -> impl Strategy<Value = Marked> {
    let marks = |count| proptest::collection::vec(0..4_u8, count);
    (faces(), marks(20), marks(40), any::<u8>()).prop_map(|(faces, of_edges, of_faces, first)| {
        let side = |triangle: usize, side: usize| (usize::from(first) + 7 * triangle + 3 * side) as u32 % 24;
        let sides = (0..faces.triangles.len()).map(|triangle| [0, 1, 2].map(|number| side(triangle, number)));
        Marked { sides: sides.collect(), faces, of_edges, of_faces }
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, ..ProptestConfig::default() })]

    #[test]
    fn marks_are_the_same_bytes_for_all_tiles_threads_and_levels(
        marked in marked(), grid in grid(), width in width(), is_glass in any::<bool>(),
        has_outlines in any::<bool>(),
    ) {
        let colors = colors_with_outlines(has_outlines);
        let glass = Faces { color: Vec4::splat(0.5), blend_mode: BlendMode::Translucent, ..marked.faces };
        let faces = if is_glass { glass } else { Faces { color: Vec4::ONE, blend_mode: BlendMode::Opaque, ..glass } };
        let marked = Marked { faces, ..marked };
        let draw = |settings| marked.image((width, 0.5), colors, (grid, settings));
        let expected = draw(ExecuteSettings::default());
        for tile_size in [TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32, TileSize::Pixels64] {
            let settings = ExecuteSettings { tile_size, threads: NonZeroUsize::new(2), ..Default::default() };
            prop_assert!(draw(settings) == expected, "{:?}", tile_size);
        }
        for level in SimdLevel::ALL.into_iter().filter(|level| level.token().is_some()) {
            let settings = ExecuteSettings { simd: Some(level), ..Default::default() };
            prop_assert!(draw(settings) == expected, "{:?}", level);
        }
    }

    /// Each sample shows one mark, so light adds up over marks even where samples are averaged.
    #[test]
    fn an_image_with_marks_is_composed_of_images_of_each_mark_alone(
        marked in marked(), grid in grid(), width in width(),
    ) {
        let marked = Marked { of_faces: Vec::new(), ..marked };
        let draw = |opacity: f32, colors| {
            marked.image((width, opacity), colors, (grid, ExecuteSettings::default()))
        };
        let found = draw(1.0, colors());
        let alone: Vec<_> = (0..4).map(|mark| {
            let mut colors = MarkColors::NONE;
            if mark > 0 {
                colors.edges[mark] = BLACK;
            }
            draw(if mark == 0 { 1.0 } else { 0.0 }, colors)
        }).collect();
        // With all marks alike the marks change nothing.
        let alike = draw(1.0, MarkColors { edges: [BLACK; MarkColors::COUNT], ..MarkColors::NONE });
        let plain = image(&[&marked.faces], width, grid, ExecuteSettings::default());
        prop_assert_eq!(&alike, &plain);
        for (pixel, found) in found.iter().enumerate() {
            let shares = [0, 1, 2, 3].map(|mark| 1.0 - alone[mark][pixel].x);
            prop_assert!((shares.iter().sum::<f32>() - (1.0 - plain[pixel].x)).abs() < ROUNDING);
            let expected = (0..4).fold(Vec4::ONE, |color, mark| {
                let ink = if mark == 0 { BLACK } else { colors().edges[mark] };
                color + (premultiplied(ink) - Vec4::ONE * ink.w) * shares[mark]
            });
            prop_assert!((*found - expected).abs().max_element() < ROUNDING, "{} for {}", found, expected);
        }
    }

    #[test]
    fn explained_pixels_show_their_marks(
        marked in marked(), grid in grid(), width in width(), x in 0..SIDE, y in 0..SIDE, has_outlines in any::<bool>(),
    ) {
        let colors = colors_with_outlines(has_outlines);
        let drawn = marked.image((width, 0.5), colors, (grid, ExecuteSettings::default()));
        let mut pass = pass(&[], width);
        pass.edges(FaceEdges { width, color: Vec3::ZERO, opacity: 0.5 }).marks(colors);
        marked.record(&mut pass);
        let explained = Rasterizer::default().explain_pixel(&pass, &target(grid), x, y).unwrap();
        prop_assert_eq!(explained.color, drawn[(y * SIDE + x) as usize]);
    }
}
