//! Triangles of a pixel or a few, eight side by side.

use super::{ALL, Flat, Heap, check, heap, timed};

/// Eight triangles of some size in 1/256 pixel, none on another.
fn eight(side: i32) -> [[[i32; 2]; 3]; 8] {
    [0, 1, 2, 3, 4, 5, 6, 7].map(|i| {
        let [x, y] = [1000 + (side + 80) * i, 900 + 300 * i];
        [[x, y], [x + side, y], [x, y + side]]
    })
}

fn at_depths(mut heap: Heap, depths: [f32; 3]) -> Heap {
    for triangle in &mut heap.triangles {
        triangle.depths = depths;
    }
    heap
}

/// A block's nearest depth is that of the nearest corners, not of the farthest.
#[test]
fn small_triangles_are_seen_before_a_farther_one_that_covers_their_block() {
    for samples in [1, 4] {
        for side in [600, 1700] {
            let small = at_depths(heap(0, 1, &eight(side)), [0.125, 1.0, 1.0]);
            let all = at_depths(heap(1, 9, &[ALL]), [0.5; 3]);
            check(&[small, all], timed(), samples);
        }
    }
}

#[test]
fn keys_decide_between_equal_small_triangles() {
    for samples in [1, 4] {
        for side in [600, 1700] {
            for objects in [[0, 1], [1, 0]] {
                check(
                    &[heap(objects[0], 1, &eight(side)), heap(objects[1], 9, &eight(side))],
                    timed(),
                    samples,
                );
            }
        }
    }
}

/// A smaller key decides where depths are equal, and nowhere else.
#[test]
fn farther_small_triangles_take_nothing_by_their_keys() {
    for samples in [1, 4] {
        for side in [600, 900, 1700] {
            let at = |x: i32| [[x, 900], [x + side, 900], [x, 900 + side]];
            // Descending, so that the order of the triangles is not that of the keys.
            let mut there = Heap { faces: vec![2, 1], ..heap(0, 1, &[at(900), at(900 + side / 2)]) };
            there.triangles[0].depths = [0.5; 3];
            there.triangles[1].depths = [0.75; 3];
            let later = Heap { faces: vec![0], ..heap(0, 9, &[at(900 + side / 4)]) };
            check(&[there, at_depths(later, [0.5; 3])], timed(), samples);
        }
    }
}

/// As deep as what stands for nobody is not before it.
#[test]
fn what_is_as_deep_as_the_background_is_not_seen() {
    for samples in [1, 4] {
        for objects in [[0, 1], [1, 0]] {
            let sides = [600, 1700, 9000].into_iter().enumerate();
            let of_side = |(i, side): (usize, i32)| heap(objects[i % 2], 1 + 8 * i as u32, &eight(side));
            let heaps: Vec<_> =
                sides.map(of_side).map(|heap| at_depths(heap, [-f32::MIN_POSITIVE; 3])).collect();
            check(&heaps, timed(), samples);
        }
    }
}

/// Where the first sample of a pixel lies.
fn first_sample(samples: u32) -> [i32; 2] {
    if samples == 1 { [128, 128] } else { [96, 32] }
}

/// All edge functions are less than 256 there.
#[test]
fn triangles_of_a_speck_cover_the_sample_that_they_hold() {
    for samples in [1, 4] {
        let offset = first_sample(samples);
        let specks = [2, 3, 4, 5, 6, 7, 8].map(|i| {
            let [x, y] = offset.map(|v| v + 1024 * i);
            [[x - i, y - i], [x + 2 * i, y - i], [x - i, y + 2 * i]]
        });
        let larger = [[600, 600], [3000, 600], [600, 3000]];
        check(&[heap(0, 1, &specks)], timed(), samples);
        check(&[heap(0, 1, &specks), heap(1, 9, &[larger])], timed(), samples);
        check(&[heap(0, 1, &[&specks[..], &[larger]].concat())], timed(), samples);
    }
}

/// Planes of depth as steep as can be, where rounding leaves the range of the corners'
/// depths: samples on a side whose ends are equally deep, of triangles that are 1/256 pixel
/// wide.
#[test]
fn depths_of_slivers_keep_to_those_of_their_corners() {
    for samples in [1, 4] {
        let [x, y] = first_sample(samples).map(|v| v + 256 * 20);
        // In the far plane rounding would leave the image, too.
        let depths = [[0.7, 0.0], [0.7, 1.0], [0.0, 1.0]];
        for (reach, [ends_depth, third]) in [1, 3, 9].into_iter().flat_map(|reach| depths.map(|d| (reach, d)))
        {
            let slivers = (1..=40).flat_map(|i| {
                let [dx, dy] = [41 * reach + i, 7 * i * reach % 431 - 200];
                let ends = [[x - dx, y - dy], [x + dx, y + dy]];
                [-1, 1].map(|side| Flat {
                    points: [ends[0], ends[1], [x - dx, y - dy + side]],
                    depths: [ends_depth, ends_depth, third],
                })
            });
            for triangle in slivers {
                check(&[Heap { triangles: vec![triangle], ..heap(0, 1, &[]) }], timed(), samples);
            }
        }
    }
}
