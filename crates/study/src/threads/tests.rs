//! Threads change no pixel.

use super::*;

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
