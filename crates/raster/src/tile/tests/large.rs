//! Few and large triangles, where a heap seldom has them.

use super::{Flat, Heap, SIZE, check, heap, timed};
use crate::{BlendMode, Output, Pass, Points, Rasterizer, Target};

/// Walls of one draw.
fn walls(triangles: &[Flat]) -> Heap {
    Heap { triangles: triangles.to_vec(), ..heap(0, 1, &[]) }
}

#[test]
fn walls_that_cross_are_seen_at_each_sample_by_itself() {
    let all = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];
    let steep = [[-2000, -2000], [22_000, -2000], [-2000, 22_000]];
    let ways = [[1.0, 0.0, 0.0], [0.0, 1.0, 1.0], [0.0, 1.0, 0.0]];
    for first in ways {
        for second in ways {
            let [first, second] = [first, second].map(|depths| Flat { points: steep, depths });
            let flat = Flat { points: all, depths: [0.5; 3] };
            for samples in [1, 4] {
                check(&[walls(&[flat, first, second])], timed(), samples);
                check(&[walls(&[first, second])], timed(), samples);
            }
        }
    }
}

#[test]
fn edges_between_the_samples_of_a_tiles_first_pixels() {
    for points in
        [[[128, -100_000], [128, 100_000], [200_000, 0]], [[-100_000, 128], [100_000, 128], [0, 200_000]]]
    {
        check(&[walls(&[Flat { points, depths: [0.5; 3] }])], timed(), 4);
    }
}

#[test]
fn equally_deep_masked_walls_are_seen_by_their_keys() {
    let all = [[-100_000, -100_000], [200_000, -100_000], [-100_000, 200_000]];
    let wall = Flat { points: all, depths: [0.5; 3] };
    for blend_mode in [BlendMode::Masked, BlendMode::MaskedPerSample] {
        for faces in [vec![1, 0], vec![0, 1]] {
            check(&[Heap { blend_mode, faces, ..walls(&[wall; 2]) }], timed(), 4);
        }
    }
}

/// Tiles lie within half of the square around a disc and not within the disc.
#[test]
fn a_disc_larger_than_tiles_is_round() {
    let [centre, diameter] = [[-100, 190], [400; 2]];
    let point = walls(&[Flat { points: [centre.map(|pixels| pixels * 256); 3], depths: [0.5; 3] }]);
    let [width, height] = SIZE.map(|side| side as u32);
    let mut target = Target::new(width, height, &[Output::Linear]).unwrap();
    let mut pass = Pass::new();
    pass.points(Points::new(&point, &[0], diameter[0] as f32));
    Rasterizer::new(timed()).unwrap().draw(&pass, &mut target);
    for (index, shown) in target.linear().unwrap().iter().enumerate() {
        let pixel = [index as i32 % SIZE[0], index as i32 / SIZE[0]];
        let [x, y] = [0, 1].map(|axis| 2 * (pixel[axis] - centre[axis]) + 1);
        let within = x * x + y * y < diameter[0] * diameter[1];
        assert_eq!(shown.x != 0.0, within, "pixel {pixel:?}");
    }
}
