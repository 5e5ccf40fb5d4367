//! The painter against exact arithmetic, and what it leaves out against painting
//! everything.

mod oracle;
mod scenes;
mod widgets;

use egui::ClippedPrimitive;
use proptest::prelude::*;

use super::*;
use scenes::{HEIGHT, WIDTH, any_scale, any_scene, changed, textures};

const SIZE: [u32; 2] = [WIDTH, HEIGHT];
const COUNT: usize = (WIDTH * HEIGHT) as usize;

/// What lies beneath: all levels, opaque.
fn beneath() -> Vec<[u8; 4]> {
    (0..COUNT).map(|i| [(i % 256) as u8, (i / 7 % 256) as u8, (i * 31 % 256) as u8, 255]).collect()
}

/// A painter with the test's textures.
fn painter() -> EguiPainter {
    let mut painter = EguiPainter::new(ChannelOrder::Rgba);
    painter.update_textures(&mut textures());
    painter
}

/// Everything, painted at once.
fn whole(primitives: &[ClippedPrimitive], scale: f32) -> Vec<[u8; 4]> {
    let (mut painter, mut pixels) = (painter(), vec![[0; 4]; COUNT]);
    painter.set_primitives(primitives.to_vec(), scale);
    let painted = painter.paint(SIZE, &mut pixels, &beneath()).expect("the sides fit");
    assert_eq!(painted, [Rect::new([0, 0], SIZE.map(|side| side as i32))], "all of it");
    pixels
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(96))]

    /// Both round to bytes after each triangle. Where the exact value is near the
    /// middle of two levels they may differ by one: filtering is off by less than 1/8
    /// level, all else by less than 1/1000 (`paint2d`). What comes over it keeps
    /// 1 − alpha of the difference, so after rounding it is one level again at most:
    /// where an image is filtered, if alpha is above 1/8, which the scenes see to; and
    /// elsewhere always, for a source of less than 1/4 level is not near the middle.
    #[test]
    fn no_channel_is_more_than_one_level_off(scene in any_scene(), scale in any_scale()) {
        let painted = whole(&scene, scale);
        let mut textures = textures();
        let exact = oracle::paint(&scene, scale, &textures, [WIDTH as i32, HEIGHT as i32], beneath());
        // egui wants to be told that they were looked at.
        textures.clear();
        for (i, (painted, exact)) in painted.iter().zip(&exact).enumerate() {
            let off = (0..4).map(|c| painted[c].abs_diff(exact[c])).max();
            let at = (i as u32 % WIDTH, i as u32 / WIDTH);
            prop_assert!(off <= Some(1), "{painted:?} instead of {exact:?} at {at:?}");
        }
    }

    #[test]
    fn what_is_left_out_would_change_nothing(
        scene in any_scene(),
        changes in prop::collection::vec(changed(), 1..5),
        scale in any_scale(),
    ) {
        let (mut painter, mut pixels) = (painter(), vec![[0; 4]; COUNT]);
        painter.set_primitives(scene.clone(), scale);
        painter.paint(SIZE, &mut pixels, &beneath()).expect("the sides fit");
        let after = changes.into_iter().fold(scene, |scene, change| change.apply(scene));
        painter.set_primitives(after.clone(), scale);
        painter.paint(SIZE, &mut pixels, &beneath()).expect("the sides fit");
        prop_assert!(pixels == whole(&after, scale), "the same bytes as all of it");
        painter.set_primitives(after, scale);
        prop_assert!(!painter.is_damaged(), "the same again is nothing to do");
    }

    #[test]
    fn channels_are_painted_alike_in_either_order(scene in any_scene(), scale in any_scale()) {
        let mut painter = EguiPainter::new(ChannelOrder::Bgra);
        painter.update_textures(&mut textures());
        painter.set_primitives(scene.clone(), scale);
        let turned: Vec<_> = beneath().into_iter().map(|rgba| ChannelOrder::Bgra.arrange(rgba)).collect();
        let mut pixels = vec![[0; 4]; COUNT];
        painter.paint(SIZE, &mut pixels, &turned).expect("the sides fit");
        let back: Vec<_> = pixels.into_iter().map(|bgra| ChannelOrder::Bgra.arrange(bgra)).collect();
        prop_assert!(back == whole(&scene, scale), "red is red");
    }
}

#[test]
fn sizes_that_do_not_fit_are_refused() {
    let mut painter = painter();
    let (mut pixels, beneath) = (vec![[0; 4]; COUNT], beneath());
    assert!(painter.paint([0, HEIGHT], &mut pixels, &beneath).is_err(), "no width");
    assert!(painter.paint(SIZE, &mut pixels, &beneath[1..]).is_err(), "a pixel is missing beneath");
    assert!(painter.paint(SIZE, &mut pixels, &beneath).is_ok(), "and these fit");
}
