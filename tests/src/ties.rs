//! Triangles in the same place at the same depth, few and many: the smaller (object, face)
//! is seen, whatever the order of draws and of faces in them. Hard case 25.
//!
//! Within a face, the triangle with the smaller index in its draw is seen, then the earlier draw.
//!
//! The search at every sample shares no code with the rasterizer. Depths are constant over a
//! triangle, or those of one slope that all of its copies have, so that no depth has to be
//! computed to know which are equal.

use crate::coverage_support::{NumberedTriangles, clip_position_on, levels, rasterizer};
use crate::effort::cases;
use crate::random::Random;
use proptest::prelude::*;
use std::cmp::Reverse;
use std::num::NonZeroUsize;
use trigon_raster::{
    BlendMode, DepthTest, ExecuteSettings, Output, Pass, Stats, Target, TargetImages, TileSize,
};
use trigon_study::oracle::GridPoint;
use trigon_study::oracle::coverage::{covers, sample_points};

/// The depths of triangles that are flat, and of the corners of the slope, which lies before
/// all of them.
const FLAT: [f32; 3] = [0.25, 0.5, 0.75];
const SLOPE: [f32; 3] = [0.8, 0.85, 0.95];

/// So many layers of whole numbers below 64 are exact in f32, and so is the mean of eight.
const MOST_LAYERS: usize = 12;

/// A triangle of a heap.
#[derive(Clone, Copy, Debug)]
struct Triangle {
    corners: [GridPoint; 3],
    /// An index of [`FLAT`], or one more for the slope: the greater one is nearer.
    level: usize,
    object: u32,
    face: u32,
    /// Its index in its draw.
    index: usize,
    draw: usize,
}

impl Triangle {
    /// The smallest is seen.
    fn key(&self) -> impl Ord {
        (Reverse(self.level), self.object, self.face, self.index, self.draw)
    }
}

/// Triangles in the order in which they are recorded, by draws.
#[derive(Clone, Debug)]
struct Heap {
    side: i32,
    copies: Vec<Triangle>,
    surfaces: Vec<BlendMode>,
    /// Whether faces of one more draw, which is beside the image, descend: then the order of
    /// draws is surely not that of keys.
    descends: bool,
}

impl Heap {
    /// The same with the triangles' indices in their draws.
    fn numbered(mut self) -> Self {
        let mut counts = vec![0; self.surfaces.len()];
        for copy in &mut self.copies {
            copy.index = counts[copy.draw];
            counts[copy.draw] += 1;
        }
        self
    }

    fn draws(&self) -> Vec<NumberedTriangles> {
        let draw = |(draw, &surface): (usize, &BlendMode)| {
            let copies = || self.copies.iter().enumerate().filter(|(_, copy)| copy.draw == draw);
            let object = copies().next_back().map_or(0, |(_, copy)| copy.object);
            let mut triangles = NumberedTriangles::new(object, surface);
            for (number, copy) in copies() {
                let depths = FLAT.get(copy.level).map_or(SLOPE, |&depth| [depth; 3]);
                let position = |corner| clip_position_on(self.side, copy.corners[corner], depths[corner]);
                triangles.push([0, 1, 2].map(position), copy.face, number);
            }
            triangles
        };
        self.surfaces.iter().enumerate().map(draw).collect()
    }

    fn draw(&self, samples: u32, settings: &ExecuteSettings) -> (TargetImages, Stats) {
        let mut draws = self.draws();
        if self.descends {
            let mut beside = NumberedTriangles::new(9, BlendMode::Opaque);
            for face in [1, 0] {
                beside.push([clip_position_on(self.side, [-4096, -4096], 0.5); 3], face, 0);
            }
            draws.push(beside);
        }
        let mut pass = Pass::new();
        for triangles in &draws {
            pass.triangles(triangles.draw());
        }
        let side = self.side as u32;
        let outputs = [Output::Linear, Output::Object, Output::Face];
        let target = Target::new(side, side, &outputs).expect("the size is in range");
        let mut target = target.with_samples(samples).expect("a standard pattern");
        let stats = rasterizer(settings).draw(&pass, &mut target);
        (target.into_images(), stats)
    }

    /// What is seen at a sample without what is translucent, and its colour with that.
    fn search(&self, sample: GridPoint) -> (Option<&Triangle>, f32) {
        let covering = self.copies.iter().enumerate().filter(|(_, copy)| covers(copy.corners, sample));
        let is_layer = |copy: &Triangle| self.surfaces[copy.draw] == BlendMode::Translucent;
        let (mut layers, solid): (Vec<_>, Vec<_>) = covering.partition(|(_, copy)| is_layer(copy));
        let seen = solid.into_iter().min_by_key(|(_, copy)| copy.key());
        layers.retain(|(_, copy)| seen.is_none_or(|(_, seen)| copy.key() < seen.key()));
        layers.sort_by_key(|(_, copy)| Reverse(copy.key()));
        let ground = seen.map_or(0.0, |(number, _)| number as f32);
        let color = layers.iter().fold(ground, |below, (number, _)| *number as f32 * 0.5 + below * 0.5);
        (seen.map(|(_, copy)| copy), color)
    }

    /// Holds every `step`th pixel against the search.
    fn check(&self, images: &TargetImages, samples: u32, step: usize, settings: &ExecuteSettings) {
        let linear = images.linear.as_ref().expect("asked for");
        let objects = images.objects.as_ref().expect("asked for");
        let faces = images.faces.as_ref().expect("asked for");
        for index in (0..linear.len()).step_by(step) {
            let pixel = [index as i32 % self.side, index as i32 / self.side];
            let found: Vec<_> = sample_points(samples, pixel).map(|sample| self.search(sample)).collect();
            let color = found.iter().map(|(_, color)| color).sum::<f32>() / samples as f32;
            assert_eq!(linear[index].x, color, "{pixel:?}, {samples} samples, {settings:?}");
            if samples == 1 {
                let ids = found[0].0.map_or((u32::MAX, u32::MAX), |copy| (copy.object, copy.face));
                assert_eq!((objects[index], faces[index]), ids, "{pixel:?}, {settings:?}");
            }
        }
    }
}

/// Triangles from a pixel to all of an image of 64 pixels.
fn corners() -> impl Strategy<Value = [GridPoint; 3]> {
    let reach = prop::sample::select(vec![300, 900, 3000, 12_000, 60_000]);
    (reach, [0..64 * 256, 0..64 * 256]).prop_flat_map(|(reach, middle)| {
        let corner = move || [0, 1].map(|axis| middle[axis] - reach..=middle[axis] + reach);
        [corner(), corner(), corner()]
    })
}

/// Draws of three objects, whose faces are in no order, and copies of a few triangles. Faces
/// may be shared by triangles of one draw and of several.
fn heap() -> impl Strategy<Value = Heap> {
    const DRAWS: usize = 9;
    let solid = || {
        prop::sample::select(vec![
            BlendMode::Opaque,
            BlendMode::Opaque,
            BlendMode::Masked,
            BlendMode::MaskedPerSample,
        ])
    };
    let surface = prop_oneof![4 => solid(), 1 => Just(BlendMode::Translucent)];
    let shapes = prop::collection::vec(corners(), 1..5);
    let copy = (any::<prop::sample::Index>(), prop_oneof![Just(1_usize), 0..4_usize], 0..DRAWS);
    let copies = prop::collection::vec(copy, 2..60);
    let faces = Just((0..60_u32).collect::<Vec<_>>()).prop_shuffle();
    let distinct = prop::sample::select(vec![1_u32, 4, 60]);
    (shapes, copies, faces, distinct, prop::collection::vec(surface, DRAWS), any::<bool>()).prop_map(
        |(shapes, copies, faces, distinct, surfaces, descends)| {
            let mut layers = 0;
            let copy = |((shape, level, draw), face): (&(prop::sample::Index, usize, usize), u32)| {
                // All copies of the slope lie in the first place.
                let corners = if level == &3 { shapes[0] } else { *shape.get(&shapes) };
                let (object, face) = (*draw as u32 % 3, face % distinct);
                Triangle { corners, level: *level, object, face, index: 0, draw: *draw }
            };
            let is_left = |copy: &Triangle| {
                layers += usize::from(surfaces[copy.draw] == BlendMode::Translucent);
                surfaces[copy.draw] != BlendMode::Translucent || layers <= MOST_LAYERS
            };
            let copies = copies.iter().zip(faces).map(copy).filter(is_left).collect();
            Heap { side: 64, copies, surfaces, descends }.numbered()
        },
    )
}

/// Every level of the machine, with other threads, tiles and tests of depth each time.
fn settings() -> impl Iterator<Item = ExecuteSettings> {
    let tiles = [TileSize::Automatic, TileSize::Pixels8, TileSize::Pixels16, TileSize::Pixels32];
    let ways = move |level| {
        tiles.into_iter().enumerate().map(move |(number, tile_size)| ExecuteSettings {
            simd: Some(level),
            threads: NonZeroUsize::new(1 + number % 3),
            tile_size,
            depth_test: if number == 3 { DepthTest::Late } else { DepthTest::Hierarchical },
            timed: false,
        })
    };
    levels().flat_map(ways)
}

proptest! {
    #![proptest_config(cases(40))]

    #[test]
    fn the_smaller_key_is_seen_wherever_depths_are_equal(heap in heap(), samples in prop::sample::select(vec![1, 4, 8])) {
        for settings in settings() {
            heap.check(&heap.draw(samples, &settings).0, samples, 1, &settings);
        }
    }
}

/// One object's triangles, all in one place, whose faces go round so many draws in an order
/// that is none: large enough an image to be shared among threads.
fn coincident(corners: [GridPoint; 3], surface: BlendMode) -> Heap {
    const DRAWS: usize = 10;
    let mut random = Random(25);
    let mut faces: Vec<u32> = (0..60).collect();
    for last in (1..faces.len()).rev() {
        let other = random.within(1 << 20).unsigned_abs() as usize % (last + 1);
        faces.swap(last, other);
    }
    let copy = |(number, face): (usize, u32)| {
        let (index, draw) = (number / DRAWS, number % DRAWS);
        Triangle { corners, level: 1, object: 7, face, index, draw }
    };
    Heap {
        side: 192,
        copies: faces.into_iter().enumerate().map(copy).collect(),
        surfaces: vec![surface; DRAWS],
        descends: false,
    }
}

const ALL: [GridPoint; 3] = [[-1000, -1000], [300_000, -1000], [-1000, 300_000]];

#[test]
fn many_coincident_triangles_show_the_smallest_key() {
    let small = [[30_000, 30_000], [34_000, 30_000], [30_000, 33_000]];
    let tiny = [[30_000, 30_000], [30_700, 30_000], [30_000, 30_700]];
    for surface in [BlendMode::Opaque, BlendMode::Masked, BlendMode::MaskedPerSample] {
        for (corners, samples) in [(ALL, 1), (ALL, 4), (small, 1), (small, 8), (tiny, 1), (tiny, 4)] {
            let heap = coincident(corners, surface);
            let first = heap.draw(samples, &ExecuteSettings::default());
            heap.check(&first.0, samples, 97, &ExecuteSettings::default());
            for settings in settings() {
                let (images, _) = heap.draw(samples, &settings);
                assert!(images == first.0, "{corners:?}, {samples} samples, {surface:?}, {settings:?}");
            }
        }
    }
}

/// Whether draws come in the order of keys decided between a face's triangles in two draws,
/// although the smaller index is to be seen.
#[test]
fn a_face_of_two_draws_is_decided_alike_whatever_else_is_drawn() {
    let triangle = |level, face, index, draw| Triangle { corners: ALL, level, object: 7, face, index, draw };
    let copies = vec![triangle(0, 0, 0, 0), triangle(1, 1, 1, 0), triangle(1, 1, 0, 1), triangle(0, 2, 1, 1)];
    for descends in [false, true] {
        let surfaces = vec![BlendMode::Opaque; 2];
        let heap = Heap { side: 64, copies: copies.clone(), surfaces, descends };
        for settings in settings() {
            heap.check(&heap.draw(1, &settings).0, 1, 1, &settings);
        }
    }
}

/// What draws coincident triangles in time: each tile gives up deciding every sample by
/// itself, whatever the settings.
#[test]
fn tiles_with_many_ties_are_drawn_in_the_order_of_keys() {
    let heap = coincident(ALL, BlendMode::Opaque);
    for samples in [1, 4, 8] {
        for settings in settings() {
            let (_, stats) = heap.draw(samples, &settings);
            assert_eq!(stats.tiles_reordered, stats.tiles, "{samples} samples, {settings:?}");
        }
    }
}

/// In the order of their keys, at different depths or side by side they need no second time.
#[test]
fn tiles_with_few_ties_are_drawn_once() {
    let coincident = coincident(ALL, BlendMode::Opaque);
    let mut in_order = coincident.clone();
    for (copy, face) in in_order.copies.iter_mut().zip(0..) {
        (copy.face, copy.draw) = (face, 0);
    }
    in_order.surfaces.truncate(1);
    let mut apart = coincident.clone();
    apart.copies.truncate(4);
    for (copy, level) in apart.copies.iter_mut().zip(0..) {
        copy.level = level;
    }
    let mut beside = coincident;
    for (copy, place) in beside.copies.iter_mut().zip(0..) {
        let corner = [place % 8 * 6_144, place / 8 * 6_144];
        copy.corners = [[0, 0], [6_144, 0], [0, 6_144]].map(|[x, y]| [corner[0] + x, corner[1] + y]);
    }
    for heap in [in_order, apart, beside] {
        let (images, stats) = heap.draw(1, &ExecuteSettings::default());
        heap.check(&images, 1, 97, &ExecuteSettings::default());
        assert_eq!(stats.tiles_reordered, 0, "{heap:?}");
    }
}
