//! Threads change no pixel.

use super::*;
use trigon_math::DVec3;

const SIZE: [usize; 2] = [300, 200];

#[test]
fn any_number_of_threads_draws_the_same_image() {
    let faces = square(SIZE);
    let alone = draw_by_face(&faces, SIZE, 0);
    let shown = alone.values().iter().filter(|&&face| face != u32::MAX).count();
    assert!(shown > 40_000, "{shown} pixels of 60,000");
    for threads in THREADS {
        assert!(draw_by_face(&faces, SIZE, threads) == alone, "the source's way with {threads}");
        let mut shared = Shared::new(&faces, SIZE, threads);
        shared.draw();
        let differing = shared.faces().values().iter().zip(alone.values()).filter(|(a, b)| a != b).count();
        // The source takes in what lies on an edge, and does not snap corners: only
        // pixels on the outlines differ, 1500 in all.
        assert!(differing < 30, "the engine with {threads}: {differing} pixels differ");
    }
}

/// Depth is linear over the distance: the face that is nearer in a pixel is seen there, whatever their order.
#[test]
fn the_nearer_of_two_crossing_faces_is_seen() {
    let size = [40, 40];
    // One recedes to the right from 2 to 8, the other one to the left.
    let face = |left: f64, right: f64| [[0.0, 0.0, left], [39.0, 0.0, right], [39.0, 39.0, right]];
    let (one, other) = (face(2.0, 8.0), face(8.0, 2.0));
    for faces in [[one, other], [other, one]] {
        let drawn = draw_by_face(&faces, size, 2);
        for (x, y) in (0..40).flat_map(|y| (y..40).map(move |x| (x, y))) {
            let share = x as f64 / 39.0;
            let distance = |left: f64, right: f64| 1.0 / ((1.0 - share) / left + share / right);
            let first = usize::from(faces[0] != one);
            let expected = if distance(2.0, 8.0) < distance(8.0, 2.0) { first } else { 1 - first };
            assert_eq!(drawn[[x, y]], expected as u32, "{x}, {y}");
        }
        assert_eq!(drawn[[3, 20]], u32::MAX, "beside both");
    }
}

#[test]
fn the_faces_of_the_square_lie_in_one_tilted_plane_and_share_a_diagonal() {
    for size in [SIZE, [64, 64]] {
        let [[a, b, c], [d, e, f]] = square(size).map(|face| face.map(DVec3::from_array));
        assert_eq!((a, c), (d, e), "the diagonal");
        let normal = (b - a).cross(c - a);
        let off = normal.normalize().dot(f - a);
        assert!(off.abs() < 1e-9, "the fourth corner lies {off} beside the plane of the others");
        let is_before_the_eye = |corner: DVec3| (2.0..4.0).contains(&corner.z);
        assert!([a, b, c, f].into_iter().all(is_before_the_eye), "between two and four metres away");
        assert!(a.z < b.z.min(f.z) && c.z > b.z.max(f.z), "it recedes from the upper left");
    }
}
