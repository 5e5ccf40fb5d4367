//! When images are drawn, and how well, without drawing any.

use super::*;

const fn ms(ms: u64) -> Duration {
    Duration::from_millis(ms)
}

/// A frame.
fn begin(pacing: &mut Pacing, now: Duration, animated: AnimationFrames) -> Option<Quality> {
    let quality = pacing.begin(now, animated, || false);
    pacing.composed();
    quality
}

/// A frame of a window whose images have previews.
fn begin_previewed(pacing: &mut Pacing, now: Duration) -> Option<Quality> {
    let quality = pacing.begin(now, AnimationFrames::None, || true);
    pacing.composed();
    quality
}

const DRAFT: Quality = Quality::Draft { shrink: 1.0 };

/// As the settings say.
const FULL: Quality = Quality::Full(0);

/// A pacing whose first image is done: a full one that took this long.
fn rested(full: Duration) -> Pacing {
    let mut pacing = Pacing::new();
    for (quality, took) in [(DRAFT, ms(0)), (FULL, full)] {
        assert_eq!(
            begin(&mut pacing, ms(0), AnimationFrames::None),
            Some(quality),
            "a draft, then a full image"
        );
        pacing.finished(took, took);
    }
    begin(&mut pacing, ms(0), AnimationFrames::None);
    assert_eq!(pacing.next(ms(20), AnimationFrames::None, None), Wake::Never, "and no more");
    pacing
}

/// Draws whenever it is time to, until `end`; images take no time. Returns which
/// were begun when.
fn run(
    pacing: &mut Pacing,
    start: Duration,
    end: Duration,
    frames: AnimationFrames,
) -> Vec<(Duration, Quality)> {
    let (mut now, mut begun) = (start, Vec::new());
    loop {
        match pacing.next(now, frames, None) {
            Wake::Now => {
                if frames == AnimationFrames::Wanted {
                    pacing.changed(Change::Settled, now);
                }
                if let Some(quality) = begin(pacing, now, frames) {
                    begun.push((now, quality));
                    pacing.finished(ms(0), ms(0));
                }
            }
            Wake::At(later) if later < end => now = later,
            _ => return begun,
        }
    }
}

#[test]
fn a_movement_is_drawn_as_a_draft_and_refined_once() {
    let mut pacing = rested(ms(0));
    pacing.changed(Change::Moving, ms(1000));
    let begun = run(&mut pacing, ms(1000), ms(100_000), AnimationFrames::None);
    assert_eq!(begun, [(ms(1000), DRAFT), (ms(1150), FULL)], "a draft at once, refined at rest");
}

/// Whoever stopped moving looked at a draft for as long as the rays took.
#[test]
fn between_a_draft_and_a_slow_image_there_is_a_preview() {
    for (full, begun) in [(PATIENCE, vec![FULL]), (2 * PATIENCE, vec![Quality::Preview, FULL])] {
        let mut pacing = rested(full);
        pacing.changed(Change::Moving, ms(1000));
        assert_eq!(begin_previewed(&mut pacing, ms(1000)), Some(DRAFT), "moving");
        pacing.finished(ms(1), ms(1));
        assert_eq!(
            pacing.next(ms(1001), AnimationFrames::None, None),
            Wake::At(ms(1000) + FRAME),
            "the frame"
        );
        assert_eq!(begin_previewed(&mut pacing, ms(1020)), None, "it may move on");
        let mut now = ms(1000) + REST;
        for quality in begun {
            assert_eq!(pacing.next(now, AnimationFrames::None, None), Wake::Now, "{quality:?}");
            assert_eq!(begin_previewed(&mut pacing, now), Some(quality));
            assert!(!pacing.is_useless() && !pacing.is_resting(now, AnimationFrames::None), "{quality:?}");
            pacing.finished(full / 4, full / 4);
            now += REST;
        }
        begin_previewed(&mut pacing, now);
        assert!(pacing.is_resting(now, AnimationFrames::None), "and no more");
        assert_eq!(pacing.next(now, AnimationFrames::None, None), Wake::Never);
    }
}

#[test]
fn a_preview_gives_way_to_movement() {
    let mut pacing = rested(2 * PATIENCE);
    for (start, is_done) in [(ms(1000), false), (ms(5000), true)] {
        let after = |millis| start + ms(millis);
        pacing.changed(Change::Settled, start);
        assert_eq!(begin_previewed(&mut pacing, start), Some(DRAFT), "first");
        pacing.finished(ms(1), ms(1));
        assert_eq!(begin_previewed(&mut pacing, after(20)), Some(Quality::Preview), "then");
        assert_eq!(pacing.progress(after(30)), None, "less than a second");
        assert_eq!(pacing.progress(after(1030)), Some(Progress::Drawing { seconds: 1 }));
        if is_done {
            pacing.finished(ms(50), ms(50));
        }
        pacing.changed(Change::Moving, after(1040));
        assert_eq!(pacing.is_useless(), !is_done, "of what was there before");
        if !is_done {
            pacing.cancelled();
        }
        assert_eq!(begin_previewed(&mut pacing, after(1050)), Some(DRAFT), "of what is there now");
        pacing.finished(ms(1), ms(1));
    }
}

#[test]
fn events_faster_than_frames_are_gathered() {
    let mut pacing = rested(ms(0));
    let mut frames = 0;
    for now in (1000..2000).map(ms) {
        pacing.changed(Change::Moving, now);
        if pacing.next(now, AnimationFrames::None, None) == Wake::Now
            && begin(&mut pacing, now, AnimationFrames::None).is_some()
        {
            pacing.finished(ms(0), ms(0));
            frames += 1;
        }
    }
    assert!((55..=61).contains(&frames), "1000 movements in a second gave {frames} images");
}

#[test]
fn a_draft_follows_the_last_one_at_once() {
    let mut pacing = rested(ms(500));
    let (mut begun, mut done) = (Vec::new(), Duration::MAX);
    // The mouse moves a thousand times a second; a draft takes a frame and a half.
    for now in (1000..1100).map(ms) {
        pacing.changed(Change::Moving, now);
        if now >= done {
            pacing.finished(ms(25), ms(25));
            done = Duration::MAX;
        }
        if pacing.next(now, AnimationFrames::None, None) == Wake::Now
            && begin(&mut pacing, now, AnimationFrames::None).is_some()
        {
            begun.push(now);
            done = now + ms(25);
        }
    }
    let expected = [1000, 1025, 1050, 1075].map(ms);
    assert_eq!(begun, expected, "frames for what is written over the image hold up none");
}

#[test]
fn what_moves_waits_in_frames_until_an_image_is_given_up() {
    let mut pacing = rested(ms(500));
    pacing.changed(Change::Settled, ms(1000));
    assert_eq!(
        begin(&mut pacing, ms(1000), AnimationFrames::None),
        Some(DRAFT),
        "it takes long, so first a draft"
    );
    pacing.finished(ms(1), ms(1));
    assert_eq!(begin(&mut pacing, ms(1100), AnimationFrames::None), Some(FULL), "at rest");
    // A key goes down, and the image has not noticed yet that nobody wants it.
    let mut frames = 0;
    for now in (1200..1300).map(ms) {
        pacing.changed(Change::Settled, now);
        if pacing.next(now, AnimationFrames::Wanted, None) == Wake::Now {
            assert_eq!(begin(&mut pacing, now, AnimationFrames::Wanted), None, "another is under way");
            frames += 1;
        }
    }
    assert!((6..=7).contains(&frames), "{frames} frames in a tenth of a second, not as many as fit");
}

#[test]
fn an_animation_is_paced_to_sixty_frames() {
    let mut pacing = rested(ms(0));
    let begun = run(&mut pacing, ms(1000), ms(2000), AnimationFrames::Wanted);
    assert!((59..=61).contains(&begun.len()), "{} images in a second", begun.len());
    assert!(begun.iter().all(|&(_, quality)| quality == DRAFT), "all of them drafts");
    let after = run(&mut pacing, ms(2000), ms(9000), AnimationFrames::None);
    assert_eq!(after.len(), 1, "when it ends, its last image is refined: {after:?}");
    assert_eq!(after[0].1, FULL, "in full");
}

#[test]
fn a_single_change_is_drawn_in_full_if_that_is_quick() {
    let mut pacing = rested(ms(50));
    pacing.changed(Change::Settled, ms(500));
    let begun = run(&mut pacing, ms(500), ms(9000), AnimationFrames::None);
    assert_eq!(begun, [(ms(500), FULL)], "no draft before");
    let mut pacing = rested(ms(5000));
    pacing.changed(Change::Settled, ms(500));
    let begun: Vec<_> =
        run(&mut pacing, ms(500), ms(9000), AnimationFrames::None).into_iter().map(|(_, q)| q).collect();
    assert_eq!(begun, [DRAFT, FULL], "nobody waits five seconds to see anything");
}

#[test]
fn an_image_that_takes_longer_than_was_known_is_given_up_for_a_draft() {
    let mut pacing = rested(ms(20));
    pacing.changed(Change::Settled, ms(1000));
    assert_eq!(begin(&mut pacing, ms(1000), AnimationFrames::None), Some(FULL), "it is expected in 20 ms");
    assert_eq!(
        pacing.next(ms(1020), AnimationFrames::None, None),
        Wake::At(ms(1200)),
        "what if it is not there?"
    );
    pacing.lose_patience(ms(1199));
    assert!(!pacing.is_useless(), "not yet");
    pacing.lose_patience(ms(1200));
    assert!(pacing.is_useless(), "nobody waits for it");
    assert_eq!(pacing.next(ms(1200), AnimationFrames::None, None), Wake::Never, "its end will be told");
    pacing.cancelled();
    let begun = run(&mut pacing, ms(1201), ms(100_000), AnimationFrames::None);
    assert_eq!(begun.iter().map(|&(_, quality)| quality).collect::<Vec<_>>(), [DRAFT, FULL], "a draft first");
    pacing.changed(Change::Settled, ms(200_000));
    begin(&mut pacing, ms(200_000), AnimationFrames::None);
    pacing.finished(ms(0), ms(0));
    pacing.changed(Change::Settled, ms(300_000));
    assert_eq!(
        begin(&mut pacing, ms(300_000), AnimationFrames::None),
        Some(FULL),
        "what it took is known again"
    );
}

#[test]
fn writing_over_an_image_draws_none() {
    let mut pacing = rested(ms(0));
    pacing.changed(Change::Overlay, ms(1000));
    assert_eq!(pacing.next(ms(1000), AnimationFrames::None, None), Wake::Now, "it is to be seen");
    assert_eq!(run(&mut pacing, ms(1000), ms(9000), AnimationFrames::None), [], "and no image is drawn");
    pacing.changed(Change::Moving, ms(9000));
    assert_eq!(begin(&mut pacing, ms(9000), AnimationFrames::None), Some(DRAFT), "over a draft");
    pacing.finished(ms(0), ms(0));
    pacing.changed(Change::Overlay, ms(9020));
    let begun = run(&mut pacing, ms(9020), ms(20_000), AnimationFrames::None);
    assert_eq!(begun, [(ms(9150), FULL)], "it does not pass for refining it");
}

#[test]
fn a_message_is_taken_away_in_time() {
    let mut pacing = rested(ms(0));
    assert_eq!(
        pacing.next(ms(10), AnimationFrames::None, Some(ms(3000))),
        Wake::At(ms(3000)),
        "wakes for it"
    );
    assert_eq!(pacing.next(ms(3000), AnimationFrames::None, Some(ms(3000))), Wake::Now, "and draws");
    assert_eq!(begin(&mut pacing, ms(3000), AnimationFrames::None), None, "no image");
    assert_eq!(pacing.next(ms(3000), AnimationFrames::None, None), Wake::Never, "once");
}

/// An image that takes long must not keep what is written over it from the screen.
#[test]
fn the_overlay_waits_for_no_image() {
    let mut pacing = rested(ms(5000));
    pacing.changed(Change::Settled, ms(1000));
    assert_eq!(begin(&mut pacing, ms(1000), AnimationFrames::None), Some(DRAFT), "under way");
    pacing.changed(Change::Overlay, ms(1010));
    assert_eq!(pacing.next(ms(1020), AnimationFrames::None, None), Wake::Now, "a key was pressed");
    assert_eq!(begin(&mut pacing, ms(1020), AnimationFrames::None), None, "one image at a time");
    assert_eq!(
        pacing.next(ms(1020), AnimationFrames::None, None),
        Wake::Never,
        "and nothing spins meanwhile"
    );
    assert_eq!(
        pacing.next(ms(1020), AnimationFrames::Wanted, None),
        Wake::Never,
        "not for an animation either"
    );
}

#[test]
fn no_image_is_begun_while_another_is_drawn_for_a_file() {
    for (change, frames) in [
        (Change::Settled, AnimationFrames::None),
        (Change::Moving, AnimationFrames::None),
        (Change::Settled, AnimationFrames::Wanted),
    ] {
        let mut pacing = rested(ms(50));
        pacing.occupy(Some(ms(900)));
        pacing.changed(change, ms(1000));
        assert_eq!(begin(&mut pacing, ms(1000), frames), None, "{change:?}: it waits");
        assert_eq!(pacing.next(ms(1020), frames, None), Wake::At(ms(1900)), "{change:?}: to tell a second");
        pacing.occupy(None);
        assert_eq!(pacing.next(ms(1020), frames, None), Wake::Now, "{change:?}: and then its turn comes");
        assert!(begin(&mut pacing, ms(1020), frames).is_some(), "{change:?}: at once");
    }
}

#[test]
fn full_images_that_nobody_will_see_are_useless_and_drafts_are_not() {
    let mut pacing = rested(ms(50));
    pacing.changed(Change::Moving, ms(1000));
    assert_eq!(begin(&mut pacing, ms(1000), AnimationFrames::None), Some(DRAFT), "a draft");
    pacing.changed(Change::Moving, ms(1010));
    assert!(!pacing.is_useless(), "a movement that never shows is none");
    pacing.finished(ms(10), ms(10));
    assert_eq!(begin(&mut pacing, ms(1020), AnimationFrames::None), Some(DRAFT), "the movement went on");
    pacing.finished(ms(10), ms(10));
    assert_eq!(begin(&mut pacing, ms(2000), AnimationFrames::None), Some(FULL), "at rest");
    assert!(!pacing.is_useless(), "it is the right image");
    pacing.changed(Change::Moving, ms(2010));
    assert!(pacing.is_useless(), "it was");
    assert_eq!(pacing.next(ms(2050), AnimationFrames::None, None), Wake::Now, "the overlay may have changed");
    assert_eq!(begin(&mut pacing, ms(2050), AnimationFrames::None), None, "it has to end first");
    pacing.cancelled();
    assert_eq!(begin(&mut pacing, ms(2060), AnimationFrames::None), Some(DRAFT), "then the movement shows");
}

#[test]
fn what_cannot_be_drawn_is_not_tried_again_and_again() {
    let mut pacing = rested(ms(50));
    pacing.changed(Change::Settled, ms(1000));
    begin(&mut pacing, ms(1000), AnimationFrames::None);
    pacing.failed();
    assert_eq!(run(&mut pacing, ms(1000), ms(9000), AnimationFrames::None), [], "it would fail again");
    pacing.changed(Change::Settled, ms(9000));
    assert!(begin(&mut pacing, ms(9000), AnimationFrames::None).is_some(), "something else may not");
}

#[test]
fn at_rest_all_that_is_wanted_follows_and_then_nothing() {
    let mut pacing = rested(ms(50));
    pacing.want(vec![0, 2, 5]);
    assert_eq!(
        pacing.progress(ms(0)),
        Some(Progress::Refining { step: 2, of: 3, seconds: 0 }),
        "the first one is there"
    );
    let steps =
        |begun: Vec<(Duration, Quality)>| begun.into_iter().map(|(_, quality)| quality).collect::<Vec<_>>();
    let begun = steps(run(&mut pacing, ms(100), ms(99_000), AnimationFrames::None));
    assert_eq!(begun, [Quality::Full(2), Quality::Full(5)], "those that were not wanted before");
    assert_eq!(pacing.progress(ms(0)), None, "done");
    pacing.changed(Change::Moving, ms(100_000));
    assert_eq!(pacing.progress(ms(0)), None, "nothing is refined while it moves");
    let begun = steps(run(&mut pacing, ms(100_000), ms(200_000), AnimationFrames::None));
    assert_eq!(begun, [DRAFT, FULL, Quality::Full(2), Quality::Full(5)], "and again from the start");
    pacing.want(vec![0]);
    assert_eq!(pacing.next(ms(300_000), AnimationFrames::None, None), Wake::Never, "silence");
}

#[test]
fn refining_gives_way_and_goes_on_where_it_was() {
    let mut pacing = rested(ms(50));
    pacing.want(vec![0, 1, 2]);
    assert_eq!(begin(&mut pacing, ms(100), AnimationFrames::None), Some(Quality::Full(1)), "a better one");
    assert!(pacing.is_refining() && !pacing.is_useless(), "is under way, and wanted");
    pacing.cancelled();
    assert_eq!(
        begin(&mut pacing, ms(200), AnimationFrames::None),
        Some(Quality::Full(1)),
        "it is begun again"
    );
    pacing.want(vec![0, 2]);
    assert!(pacing.is_useless(), "nobody wants it any more");
    pacing.cancelled();
    assert_eq!(begin(&mut pacing, ms(300), AnimationFrames::None), Some(Quality::Full(2)), "but another");
    pacing.failed();
    assert_eq!(
        run(&mut pacing, ms(400), ms(9000), AnimationFrames::None),
        [],
        "what cannot be drawn is not tried again"
    );
    assert_eq!(pacing.progress(ms(0)), None, "and not waited for");
}

#[test]
fn an_image_that_takes_long_is_told_of_every_second() {
    let mut pacing = rested(ms(50));
    pacing.changed(Change::Settled, ms(1000));
    assert_eq!(begin(&mut pacing, ms(1000), AnimationFrames::None), Some(FULL), "expected soon");
    pacing.lose_patience(ms(1100));
    // Refining goes on for as long as it takes.
    pacing.finished(ms(0), ms(0));
    pacing.want(vec![0, 1, 2]);
    assert_eq!(begin(&mut pacing, ms(2000), AnimationFrames::None), Some(Quality::Full(1)), "a better one");
    let refining = |seconds| Some(Progress::Refining { step: 2, of: 3, seconds });
    assert_eq!(pacing.progress(ms(2500)), refining(0), "not long yet");
    for second in 1..4 {
        let due = ms(2000 + 1000 * second);
        assert_eq!(pacing.next(due - ms(1), AnimationFrames::None, None), Wake::At(due), "a second later");
        assert_eq!(pacing.next(due, AnimationFrames::None, None), Wake::Now, "there is something to tell");
        assert_eq!(pacing.progress(due), refining(second), "what it took so far");
        assert_eq!(begin(&mut pacing, due, AnimationFrames::None), None, "it goes on");
    }
    pacing.finished(ms(3000), ms(3000));
    assert_eq!(
        pacing.progress(ms(5000)),
        Some(Progress::Refining { step: 3, of: 3, seconds: 0 }),
        "the next"
    );
    pacing.want(vec![0]);
    pacing.occupy(Some(ms(5000)));
    assert_eq!(pacing.progress(ms(5999)), None, "an image to be saved");
    assert_eq!(pacing.progress(ms(6000)), Some(Progress::Image { seconds: 1 }), "takes long");
    pacing.occupy(None);
    begin(&mut pacing, ms(6000), AnimationFrames::None);
    assert_eq!(pacing.next(ms(7000), AnimationFrames::None, None), Wake::Never, "and then nothing is told");
}
