//! Triangles much longer than wide, among others, which the kernel `sliver` draws.

use super::{Flat, Heap, check, flats, heap, settings, timed};
use crate::Culling;
use proptest::prelude::*;

/// Twice the area in 1/256 pixel over the length: widths about which a column may hold one pixel more.
const WIDTHS: [i32; 9] = [1, 30, 128, 253, 254, 256, 509, 511, 520];

/// Up to 95 pixels long, along any direction, with a third corner anywhere along it.
fn sliver() -> impl Strategy<Value = Flat> {
    let middle = [-2000..21_200_i32, -2000..13_500];
    let reach = prop_oneof![700..6000_i32, 6000..12_000];
    let across = prop_oneof![Just(0), -700..700_i32, -12_000..12_000];
    let depth = || prop_oneof![(0..=4_u8).prop_map(|step| f32::from(step) / 4.0), 0.0_f32..=1.0];
    let depths = prop_oneof![depth().prop_map(|depth| [depth; 3]), [depth(), depth(), depth()]];
    let width = prop_oneof![prop::sample::select(WIDTHS.to_vec()), 1..600_i32];
    let kind = (0..=256_i32, any::<[bool; 4]>(), prop_oneof![Just(1), Just(128)]);
    (middle, (reach, across), width, kind, depths).prop_map(
        |(
            [x, y],
            (reach, across),
            width,
            (share, [is_steep, is_left, is_turned, is_rising], steps),
            depths,
        )| {
            let across = across.clamp(-reach, reach) * if is_rising { 1 } else { -1 };
            let [start, end] = [[x - reach, y - across], [x + reach, y + across]];
            let along = [0, 1].map(|axis| start[axis] + (end[axis] - start[axis]) * share / 256);
            let third = [along[0], along[1] + if is_left { width } else { -width }];
            let points = if is_turned { [end, third, start] } else { [start, end, third] };
            let on_steps = |v: i32| v / steps * steps;
            let points = points.map(|[x, y]| if is_steep { [y, x] } else { [x, y] }.map(on_steps));
            Flat { points, depths }
        },
    )
}

/// Slivers, with a few other triangles between them.
fn mixed() -> impl Strategy<Value = Vec<Flat>> {
    let slivers = |most: usize| prop::collection::vec(sliver(), 1..most);
    (slivers(40), flats(), slivers(20)).prop_map(|(first, mut others, last)| {
        others.truncate(6);
        [first, others, last].concat()
    })
}

/// Two draws of them, in the order of their keys or in none.
fn heaps() -> impl Strategy<Value = Vec<Heap>> {
    let faces = prop::option::of(prop::collection::vec(0..4_u32, 128));
    ([mixed(), mixed()], faces).prop_map(|(draws, faces)| {
        let heap = |(draw, triangles): (u32, Vec<Flat>)| {
            let faces = faces.as_ref().map_or_else(Vec::new, |faces| faces[..triangles.len()].to_vec());
            let object = if faces.is_empty() { draw } else { 1 };
            Heap { triangles, faces, culling: Culling::None, ..heap(object, 1 + 100 * draw, &[]) }
        };
        (0..).zip(draws).map(heap).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 8, ..ProptestConfig::default() })]

    #[test]
    fn every_sample_of_slivers_shows_what_a_search_finds(heaps in heaps(), settings in settings()) {
        check(&heaps, settings, 1);
    }
}

/// Long edges through samples, on either side, from end to end of several tiles.
#[test]
fn samples_on_the_longest_edge_of_a_sliver_follow_the_top_left_rule() {
    for (slope, width) in [0, 1, 2, 64].into_iter().flat_map(|slope| WIDTHS.map(|width| (slope, width))) {
        for (is_steep, side) in [(false, 1), (false, -1), (true, 1), (true, -1)] {
            let slivers = [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
                let [x, y] = [128 + 256 * i, 128 + 256 * (3 + 4 * i)];
                let [start, end] = [[x, y], [x + 64 * 256, y + slope * 64]];
                let third = [x + 32 * 256, y + slope * 32 + side * width];
                [start, end, third].map(|[x, y]| if is_steep { [y, x] } else { [x, y] })
            });
            check(&[heap(0, 1, &slivers)], timed(), 1);
        }
    }
}

/// A sliver is drawn after others of the same eight, but its key comes first.
#[test]
fn keys_decide_between_slivers_and_what_is_as_deep() {
    let wide = |x: i32| [[x, 2000], [x + 9000, 2000], [x, 9000]];
    let sliver = |y: i32| [[100, y], [18_000, y + 100], [9000, y + 300]];
    for triangles in [[wide(300), sliver(3000), wide(900)], [sliver(3000), wide(300), sliver(3100)]] {
        check(&[heap(0, 1, &triangles)], timed(), 1);
        let faces = vec![2, 0, 1];
        check(&[Heap { faces, ..heap(0, 1, &triangles) }, heap(0, 9, &triangles)], timed(), 1);
    }
}
