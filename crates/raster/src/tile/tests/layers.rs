//! Many triangles of one draw above each other, which are drawn from front to back.

use super::{ALL, Flat, Heap, check, draw, flat, heap, settings, timed};
use crate::{BlendMode, DepthTest, ExecuteSettings};
use proptest::prelude::*;

/// From the farthest to the nearest, each over the whole image.
fn back_to_front(count: usize) -> Heap {
    let depth = |i: usize| (i + 1) as f32 / count as f32;
    let triangles = (0..count).map(|i| Flat { points: ALL, depths: [depth(i); 3] }).collect();
    Heap { triangles, ..heap(0, 1, &[]) }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 16, ..ProptestConfig::default() })]

    /// With ties and without, within faces and between them, below masked triangles and layers.
    #[test]
    fn layers_show_what_a_search_finds(
        reach in prop::sample::select(vec![[2500; 2], [7000; 2], [1000, 9000]]),
        steps in prop_oneof![Just(1), Just(128)],
        seeds in prop::collection::vec(flat([7000; 2], 1), 64..100),
        other in flat([7000; 2], 1),
        blend_mode in prop::sample::select(vec![BlendMode::Masked, BlendMode::Translucent]),
        of_one_face: bool,
        settings in settings(),
        samples in prop_oneof![2 => Just(1_u32), 1 => Just(4)],
    ) {
        // Smaller ones by scaling, so that shrinking keeps their number.
        let scaled = |Flat { points: [a, b, c], depths }: &Flat| {
            let moved = |to: [i32; 2]| [0, 1].map(|axis| (a[axis] + (to[axis] - a[axis]) * reach[axis] / 14_000) / steps * steps);
            Flat { points: [moved(*a), moved(*b), moved(*c)], depths: *depths }
        };
        let triangles: Vec<_> = seeds.iter().map(scaled).collect();
        let faces = if of_one_face { vec![0; triangles.len()] } else { Vec::new() };
        let count = triangles.len() as u32;
        let opaque = Heap { triangles, faces, ..heap(0, 1, &[]) };
        let other = Heap { triangles: vec![other; 3], blend_mode, ..heap(1, count + 1, &[]) };
        check(&[opaque, other], settings, samples);
    }
}

/// What is left behind a tile that is covered is not looked at.
#[test]
fn what_lies_behind_a_covered_tile_is_left_out() {
    for samples in [1, 4] {
        let heaps = [back_to_front(80)];
        check(&heaps, timed(), samples);
        let rejected = |depth_test| {
            let (_, stats) = draw(&heaps, ExecuteSettings { depth_test, ..timed() }, samples);
            (stats.tiles, stats.tiles_rejected)
        };
        let (tiles, hidden) = rejected(DepthTest::Hierarchical);
        // Nearly all: the order is approximate.
        assert!(hidden >= tiles * 70, "{hidden} of 80 in each of {tiles} tiles");
        assert_eq!(rejected(DepthTest::Late).1, 0);
    }
}

/// Half of them have one depth, and a tile has too many ties: it is drawn again in the order of keys, in which triangles of a
/// face come as they were recorded.
#[test]
fn layers_of_one_depth_are_drawn_in_the_order_of_keys() {
    for faces in [vec![0; 200], (0..200).rev().collect()] {
        let mut heap = Heap { faces, ..back_to_front(200) };
        for triangle in &mut heap.triangles[100..] {
            triangle.depths = [1.0; 3];
        }
        check(&[heap.clone()], timed(), 1);
        let (_, stats) = draw(&[heap], timed(), 1);
        assert!(stats.tiles_reordered > 0, "{stats:?}");
    }
}
