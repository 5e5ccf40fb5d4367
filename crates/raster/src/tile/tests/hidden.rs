//! Draws that are left out because others hide their boxes, against the same search.

use super::*;

/// Many draws one above the other, most of them opaque, at a few depths each. Some lie over all of the image.
fn piles() -> impl Strategy<Value = Vec<Heap>> {
    let others = [BlendMode::Masked, BlendMode::MaskedPerSample, BlendMode::Translucent];
    let surface = prop_oneof![2 => Just(BlendMode::Opaque), 1 => prop::sample::select(others.to_vec())];
    let reach = prop::sample::select(vec![[2500, 2500], [9000, 9000], [30_000, 30_000], [1 << 18, 3000]]);
    let flats = reach.prop_flat_map(|reach| prop::collection::vec(flat(reach, 1), 1..4));
    let wall =
        (0..=8_u8).prop_map(|eighths| vec![Flat { points: ALL, depths: [f32::from(eighths) / 8.0; 3] }]);
    let triangles = prop_oneof![5 => flats, 1 => wall];
    prop::collection::vec((triangles, surface), 24..40).prop_map(|draws| {
        let mut light = 1;
        let heap = |((triangles, blend_mode), object): ((Vec<Flat>, BlendMode), u32)| {
            let first = light;
            light += triangles.len() as u32;
            Heap { object, blend_mode, culling: Culling::None, triangles, faces: Vec::new(), light: first }
        };
        draws.into_iter().zip(0..).map(heap).collect()
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: ProptestConfig::default().cases / 16, ..ProptestConfig::default() })]

    #[test]
    fn draws_that_are_left_out_would_not_be_visible(
        piles in piles(),
        settings in settings(),
        threads in 1..4_usize,
        samples in prop::sample::select(vec![1, 1, 2, 4]),
    ) {
        check(&piles, ExecuteSettings { threads: NonZeroUsize::new(threads), ..settings }, samples);
    }
}

/// The width of the image.
const WIDTH: i32 = 75 * 256;

/// A wall over the image up to a column, draws behind it up to another, and one before it.
fn behind_a_wall(end: i32, end_behind: i32) -> Vec<Heap> {
    let quad = |[left, right]: [i32; 2]| {
        let bottom = 45 * 256;
        [[[left, 0], [right, 0], [right, bottom]], [[right, bottom], [left, bottom], [left, 0]]]
    };
    let at = |heap: Heap, depth: f32| {
        let flat = |flat: &Flat| Flat { depths: [depth; 3], ..*flat };
        Heap { triangles: heap.triangles.iter().map(flat).collect(), ..heap }
    };
    let layer = |object: u32, end: i32, depth: f32| at(heap(object, 1 + 2 * object, &quad([0, end])), depth);
    let behind = (1..20).map(|object| layer(object, end_behind, 0.5 - 0.01 * object as f32));
    [layer(0, end, 0.75), layer(20, WIDTH / 2, 0.875)].into_iter().chain(behind).collect()
}

#[test]
fn what_lies_behind_a_wall_is_left_out() {
    for (samples, threads) in [(1, 1), (4, 2)] {
        let settings = ExecuteSettings { threads: NonZeroUsize::new(threads), ..timed() };
        let wall = behind_a_wall(WIDTH, WIDTH);
        check(&wall, settings, samples);
        assert_eq!(draw(&wall, settings, samples).1.primitives, 4, "the wall, and what is before it");
        let late = ExecuteSettings { depth_test: DepthTest::Late, ..settings };
        assert_eq!(draw(&wall, late, samples).1.primitives, 42, "late tests leave nothing out");
    }
}

/// Through a gap as wide as the distance of two samples, the nearest of them is visible.
#[test]
fn a_gap_in_a_wall_hides_nothing() {
    for end in [WIDTH - 136, WIDTH - 116, 72 * 256, 10] {
        for samples in [1, 2, 4, 16] {
            check(&behind_a_wall(end, WIDTH), timed(), samples);
        }
    }
}

/// Depths are known for blocks of eight pixels, and here a draw reaches a pixel or less into the next one.
#[test]
fn what_looks_out_from_behind_a_wall_is_drawn() {
    for beyond in [1, 100, 130, 250, 256] {
        for samples in [1, 2, 4, 16] {
            check(&behind_a_wall(48 * 256, 48 * 256 + beyond), timed(), samples);
        }
    }
}

/// Of equal depths the smaller key is visible, also if boxes that are as near lie over it.
#[test]
fn a_draw_at_the_depth_of_what_is_in_front_stays() {
    let mut draws = behind_a_wall(WIDTH, WIDTH);
    let front = draws[0].triangles[0].depths;
    for (behind, object) in draws[2..].iter_mut().zip(100..) {
        behind.triangles.iter_mut().for_each(|flat| flat.depths = front);
        behind.object = object;
    }
    (draws[0].object, draws[12].object) = (500, 1);
    check(&draws, timed(), 1);
}
