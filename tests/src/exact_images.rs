//! Whole images of many triangles, in any order and with any settings, against a search through all triangles at
//! every sample.
//!
//! Coverage is [`trigon_study::oracle::coverage`]'s, in whole numbers. A triangle's depth is the sum of its corners'
//! by areas in whole numbers, divided in f64; where two depths are nearer to each other than what rounding may do, the
//! sample stays open, but for depths that are the same at all corners, which are compared exactly. Colours are whole
//! numbers or their halves, so that every sum and mean of them is exact in f32.

use crate::coverage_support::{NumberedTriangles, clip_position_on, levels, rasterizer};
use crate::effort::cases;
use proptest::prelude::*;
use std::num::NonZeroUsize;
use trigon_math::Vec4;
use trigon_raster::{
    Background, BlendMode, DepthTest, ExecuteSettings, Output, Pass, Rect, Target, TargetImages, TileSize,
};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, doubled_area, sample_points};

/// Two tiles of 64 pixels each way, and many smaller ones.
const SIDE: i32 = 128;

/// What the caller sees where nothing is drawn.
const EMPTY: f32 = 77.0;

/// So many halves of whole numbers, and the mean of eight of them, are exact in f32.
const MOST_LAYERS: usize = 12;

/// One triangle, and the draw that it is in.
#[derive(Clone, Debug)]
struct Sheet {
    corners: [GridPoint; 3],
    depths: [f32; 3],
    face: u32,
    draw: usize,
    /// A corner, its axis and a coordinate that is no position, which drops the triangle.
    broken: Option<(usize, usize, f32)>,
}

/// What is drawn, and how.
#[derive(Clone, Debug)]
struct Case {
    sheets: Vec<Sheet>,
    modes: Vec<BlendMode>,
    /// In which order the draws are recorded.
    order: Vec<usize>,
    samples: u32,
    scissor: Option<[[i32; 2]; 2]>,
    settings: ExecuteSettings,
}

impl Case {
    fn triangles(&self, draw: usize) -> NumberedTriangles {
        let mut triangles = NumberedTriangles::new(draw as u32, self.modes[draw]);
        for (number, sheet) in self.sheets.iter().enumerate().filter(|(_, sheet)| sheet.draw == draw) {
            let position = |corner| clip_position_on(SIDE, sheet.corners[corner], sheet.depths[corner]);
            let mut positions = [0, 1, 2].map(position);
            if let Some((corner, axis, value)) = sheet.broken {
                positions[corner][axis] = value;
            }
            triangles.push(positions, sheet.face, number);
        }
        triangles
    }

    fn draw(&self) -> TargetImages {
        let draws: Vec<NumberedTriangles> = self.order.iter().map(|&draw| self.triangles(draw)).collect();
        let outputs = [Output::Linear, Output::Depth, Output::Object, Output::Face];
        let target = Target::new(SIDE as u32, SIDE as u32, &outputs).expect("the size is in range");
        let mut target = target.with_samples(self.samples).expect("a standard pattern");
        let rasterizer = &mut rasterizer(&self.settings);
        // What lies outside of the scissor.
        let mut before = Pass::new();
        before.background(Background::Color(Vec4::new(EMPTY, 0.0, 0.0, 1.0)));
        rasterizer.draw(&before, &mut target);
        let mut pass = Pass::new();
        for triangles in &draws {
            pass.triangles(triangles.draw());
        }
        if let Some([min, max]) = self.scissor {
            pass.scissor(Rect::new(min, max));
        }
        rasterizer.draw(&pass, &mut target);
        target.into_images()
    }

    /// What a sample shows: the triangle if one is surely the nearest, and the light; none where rounding decides.
    fn search(&self, boxes: &[[[i32; 2]; 2]], sample: GridPoint) -> Option<(Option<usize>, f32)> {
        let covering = |&number: &usize| {
            let ([low, high], sheet) = (boxes[number], &self.sheets[number]);
            let is_near = (0..2).all(|axis| (low[axis]..=high[axis]).contains(&sample[axis]));
            is_near && sheet.broken.is_none() && covers(sheet.corners, sample)
        };
        let mut found: Vec<usize> = (0..self.sheets.len()).filter(covering).collect();
        for (at, &a) in found.iter().enumerate() {
            for &b in &found[..at] {
                self.nearer(a, b, sample)?;
            }
        }
        found.sort_by(|&a, &b| self.nearer(a, b, sample).expect("all pairs are decided"));
        let is_layer = |&&number: &&usize| self.modes[self.sheets[number].draw] == BlendMode::Translucent;
        let solid = found.iter().position(|number| !is_layer(&number));
        let ground = solid.map_or(0.0, |at| found[at] as f32);
        let layers = found[..solid.unwrap_or(found.len())].iter().rev();
        let light = layers.fold(ground, |below, &number| number as f32 * 0.5 + below * 0.5);
        Some((solid.map(|at| found[at]), light))
    }

    /// Which of two triangles is before the other one; none where rounding decides.
    fn nearer(&self, a: usize, b: usize, sample: GridPoint) -> Option<std::cmp::Ordering> {
        let [first, second] = [a, b].map(|number| &self.sheets[number]);
        let [(near, off), (far, also_off)] = [first, second].map(|sheet| sheet.depth(sample));
        let key = |sheet: &Sheet, number: usize| (sheet.draw, sheet.face, number);
        if off == 0.0 && also_off == 0.0 && near == far {
            return Some(key(first, a).cmp(&key(second, b)));
        }
        // Reversed depth: the greater one is nearer.
        ((near - far).abs() > off + also_off).then(|| far.total_cmp(&near))
    }
}

impl Sheet {
    /// The depth at a sample, and how far the rasterizer's may be from it by its documentation: half a unit of f32,
    /// and 9/8 · 2⁻⁵⁰ · Δz · XY/A. Nothing for a depth that is the same everywhere.
    fn depth(&self, point: GridPoint) -> (f64, f64) {
        let ([a, b, c], [first, ..]) = (self.corners, self.depths);
        if self.depths == [first; 3] {
            return (f64::from(first), 0.0);
        }
        let shares =
            [[point, b, c], [a, point, c], [a, b, point]].map(|corners| doubled_area(corners) as f64);
        let area = doubled_area(self.corners) as f64;
        let depth = (0..3).map(|i| shares[i] * f64::from(self.depths[i])).sum::<f64>() / area;
        let extent = |axis: usize| {
            let [a, b, c] = self.corners.map(|corner| f64::from(corner[axis]));
            a.max(b).max(c) - a.min(b).min(c)
        };
        let stretch = extent(0) * extent(1) / (area.abs() / 2.0);
        (depth, f64::from(f32::EPSILON) + stretch * 4.0 * f64::EPSILON)
    }
}

fn sheet(draws: usize) -> impl Strategy<Value = Sheet> {
    let reach = prop::sample::select(vec![200, 2000, 12_000, 60_000, 400_000]);
    let corners = (reach, [0..SIDE * 256, 0..SIDE * 256]).prop_flat_map(|(reach, middle)| {
        // Half of them on samples, and on lines through them.
        let axis = move |axis: usize| {
            let range = middle[axis] - reach..=middle[axis] + reach;
            prop_oneof![range.clone(), range.prop_map(|at| at.div_euclid(128) * 128)]
        };
        let corner = move || [axis(0), axis(1)];
        [corner(), corner(), corner()]
    });
    let level = || prop::sample::select(vec![0.25_f32, 0.5, 0.75]);
    let depths =
        prop_oneof![level().prop_map(|depth| [depth; 3]), [0.0_f32..1.0, 0.0_f32..1.0, 0.0_f32..1.0]];
    let worst = prop::sample::select(vec![f32::NAN, f32::INFINITY, f32::NEG_INFINITY]);
    let broken = prop::option::weighted(0.1, (0..3_usize, 0..4_usize, worst));
    (corners, depths, 0..4_u32, 0..draws, broken).prop_map(|(corners, depths, face, draw, broken)| Sheet {
        corners,
        depths,
        face,
        draw,
        broken,
    })
}

fn case() -> impl Strategy<Value = Case> {
    const DRAWS: usize = 4;
    let mode = prop_oneof![3 => Just(BlendMode::Opaque), 1 => Just(BlendMode::Masked), 2 => Just(BlendMode::Translucent)];
    let tiles = vec![
        TileSize::Automatic,
        TileSize::Pixels8,
        TileSize::Pixels16,
        TileSize::Pixels32,
        TileSize::Pixels64,
    ];
    let depth_tests = vec![DepthTest::Hierarchical, DepthTest::Late];
    let settings = (
        1..9_usize,
        prop::sample::select(tiles),
        prop::sample::select(levels().collect::<Vec<_>>()),
        prop::sample::select(depth_tests),
    )
        .prop_map(|(threads, tile_size, level, depth_test)| ExecuteSettings {
            threads: NonZeroUsize::new(threads),
            tile_size,
            simd: Some(level),
            depth_test,
            ..Default::default()
        });
    let at = || -20..SIDE + 20;
    let scissor = prop::option::of([[at(), at()], [at(), at()]]);
    (
        prop::collection::vec(sheet(DRAWS), 1..40),
        prop::collection::vec(mode, DRAWS),
        Just((0..DRAWS).collect::<Vec<_>>()).prop_shuffle(),
        prop::sample::select(vec![1_u32, 1, 4, 8]),
        scissor,
        settings,
    )
        .prop_map(|(mut sheets, modes, order, samples, scissor, settings)| {
            let mut layers = 0;
            sheets.retain(|sheet| {
                layers += usize::from(modes[sheet.draw] == BlendMode::Translucent);
                modes[sheet.draw] != BlendMode::Translucent || layers <= MOST_LAYERS
            });
            Case { sheets, modes, order, samples, scissor, settings }
        })
}

proptest! {
    #![proptest_config(cases(24))]

    #[test]
    fn every_setting_and_order_gives_the_image_that_a_search_finds(case in case()) {
        let TargetImages { linear, depth: depths, objects, faces, .. } = case.draw();
        let (linear, depths) = (linear.expect("asked for"), depths.expect("asked for"));
        let (objects, faces) = (objects.expect("asked for"), faces.expect("asked for"));
        let boxes: Vec<_> = case.sheets.iter().map(|sheet| {
            let [a, b, c] = sheet.corners;
            [[0, 1].map(|i| a[i].min(b[i]).min(c[i])), [0, 1].map(|i| a[i].max(b[i]).max(c[i]))]
        }).collect();
        let mut decided = 0;
        for (index, color) in linear.iter().enumerate() {
            let pixel = [index as i32 % SIDE, index as i32 / SIDE];
            let is_inside = case.scissor.is_none_or(|[min, max]| (0..2).all(|i| (min[i]..max[i]).contains(&pixel[i])));
            if !is_inside {
                prop_assert_eq!(color.x, EMPTY, "outside of the scissor at {:?}", pixel);
                continue;
            }
            let found: Option<Vec<_>> = sample_points(case.samples, pixel).map(|sample| case.search(&boxes, sample)).collect();
            let Some(found) = found else { continue };
            decided += 1;
            let light = found.iter().map(|(_, light)| light).sum::<f32>() / case.samples as f32;
            prop_assert_eq!(color.x, light, "at {:?}, {:?}", pixel, case.settings);
            if case.samples == 1 {
                let ids = found[0].0.map_or((u32::MAX, u32::MAX), |number| {
                    let sheet = &case.sheets[number];
                    (sheet.draw as u32, sheet.face)
                });
                prop_assert_eq!((objects[index], faces[index]), ids, "at {:?}, {:?}", pixel, case.settings);
                if let Some(number) = found[0].0 {
                    let (depth, off) = case.sheets[number].depth([256 * pixel[0] + 128, 256 * pixel[1] + 128]);
                    let shown = f64::from(depths[index]);
                    prop_assert!((shown - depth).abs() <= off, "depth {} instead of {} at {:?}", shown, depth, pixel);
                }
            }
        }
        // Of what lies inside, hardly anything hangs on rounding.
        let inside = (0..SIDE * SIDE).filter(|&at| {
            case.scissor.is_none_or(|[min, max]| (min[0]..max[0]).contains(&(at % SIDE)) && (min[1]..max[1]).contains(&(at / SIDE)))
        }).count();
        prop_assert!(decided * 100 >= inside * 98, "{} of {} pixels are decided", decided, inside);
    }
}
