//! Two models in one window.

use trigon_camera::Viewport;
use trigon_math::DVec2;
use trigon_window::{Chord, HeadlessWindow, Key, Modifiers};

use super::{click_at, key, says, shift, with_window};

const SIZE: Viewport = Viewport { width: 600, height: 240 };

const TRIANGLE: &str = "v 0 0 0\nv 2 0 0\nv 0 2 0\nf 1 2 3\n";
const SQUARE: &str = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 0 2 0\nf 1 2 3 4\n";

/// Pixels of a part of the window's columns, without what is written above.
fn columns(window: &HeadlessWindow<'_>, columns: std::ops::Range<usize>) -> Vec<[u8; 4]> {
    let pixels = window.pixels();
    (90..240).flat_map(|y| pixels[y * 600 + columns.start..y * 600 + columns.end].to_vec()).collect()
}

/// Opens two models, `one.obj` and `two.obj`, side by side.
fn with_pair(texts: [&str; 2], test: impl FnOnce(&mut HeadlessWindow<'_>)) {
    let folder = tempfile::tempdir().expect("a folder");
    let [one, other] = ["one.obj", "two.obj"].map(|name| folder.path().join(name));
    for (path, text) in [&one, &other].into_iter().zip(texts) {
        std::fs::write(path, text).expect("written");
    }
    let flags = format!("{} --compare={} --view=front", one.display(), other.display());
    with_window(&flags, SIZE, |window| {
        while says(window, "loading two.obj") {
            window.wait();
        }
        test(window);
    });
}

/// Each half cut off what would have fitted into the whole window.
#[test]
fn side_by_side_the_sides_of_wide_models_were_cut_off() {
    const WIDE: &str = "v 0 0 0\nv 8 0 0\nv 8 1 0\nv 0 1 0\nf 1 2 3 4\n";
    with_pair([WIDE, WIDE], |window| {
        for keys in ["", "1"] {
            keys.chars().for_each(|chord| key(window, chord));
            for left in [0, 300] {
                let edges = [left + 2, left + 297].map(|column| columns(window, column..column + 1));
                assert!(edges[0] == edges[1], "nothing of it at the edges of its half");
                assert!(columns(window, left + 150..left + 151) != edges[0], "but in the middle");
            }
        }
    });
}

#[test]
fn two_models_are_seen_side_by_side_in_turn_and_where_they_differ() {
    with_pair([TRIANGLE, SQUARE], |window| {
        assert!(says(window, "one.obj | two.obj"), "what is where");
        assert!(columns(window, 0..300) != columns(window, 300..600), "two images");
        key(window, 'b');
        let first = columns(window, 0..600);
        key(window, 'b');
        let second = columns(window, 0..600);
        assert!(first != second, "the other one");
        key(window, 'b');
        assert!(columns(window, 0..600) == first, "and the first again");
        shift(window, 'b');
        assert!(says(window, "pixels differ"), "how much");
        let heat = columns(window, 0..600);
        assert!(heat[0][..3] == [0; 3], "black where they are the same");
        assert!(heat.iter().any(|pixel| pixel[0] > 100), "and light where they differ");
        shift(window, 'b');
        let beside = columns(window, 0..300);
        window.key(Chord::new(Modifiers::SHIFT, Key::Left));
        assert!(columns(window, 0..300) != beside, "both turn");
    });
}

/// The camera was fitted to the first model alone: of a larger one beside it, or one at another place, nothing was seen.
#[test]
fn both_models_are_in_view() {
    const AWAY: &str = "v 40 0 0\nv 42 0 0\nv 40 2 0\nf 1 2 3\n";
    with_pair([TRIANGLE, AWAY], |window| {
        let differs = |window: &HeadlessWindow<'_>, part: std::ops::Range<usize>| {
            let pixels = columns(window, part.clone());
            pixels.chunks(part.len()).any(|row| row.iter().any(|pixel| *pixel != row[0]))
        };
        assert!(differs(window, 0..300) && differs(window, 300..600), "each in its half");
        shift(window, 'b');
        assert!(differs(window, 0..300) && differs(window, 300..600), "at both ends of what they fill");
    });
}

#[test]
fn without_another_model_the_keys_say_what_to_do() {
    with_window("", SIZE, |window| {
        key(window, 'b');
        assert!(says(window, "--compare"), "the flag");
    });
}

/// Clicks side by side picked in an image of the first model alone, which fills the window and is not shown.
#[test]
fn clicks_beside_another_model_picked_what_was_not_there() {
    with_pair([SQUARE, SQUARE], |window| {
        let middles = [150.0, 300.0, 450.0].map(|x| DVec2::new(x, 140.0));
        for at in middles {
            click_at(window, at);
            assert_eq!(window.stage().selection, None, "side by side, at {at}");
        }
        key(window, 'r');
        click_at(window, middles[1]);
        assert!(says(window, "Press B until one model is shown."), "nothing is measured");
        window.key(Key::Escape.into());
        key(window, 'b');
        click_at(window, middles[1]);
        assert!(window.stage().selection.is_some(), "the first model alone");
        window.key(Key::Escape.into());
        key(window, 'b');
        click_at(window, middles[1]);
        assert_eq!(window.stage().selection, None, "the other one is not the window's");
    });
}
