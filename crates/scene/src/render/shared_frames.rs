//! Frames that a renderer shares with those who show them, and draws into again once they are released.
//!
//! A frame of a window takes tens of megabytes: to allocate them for every image would take milliseconds,
//! because the system has to map and clear each page, and to copy them takes as long. So a frame that
//! comes back receives only what was drawn since it was shared.

use std::collections::VecDeque;
use std::sync::Arc;

use trigon_raster::{Rasterizer, Rect};

use crate::frame::Frame;
use crate::settings::RenderSettings;

/// Images whose redrawn parts are remembered. Frames that are older are copied as a whole.
const REMEMBERED: usize = 4;

/// Rows per task when copying.
const ROWS: usize = 32;

/// The frames that are shared or free. Images are numbered if the next one can follow from them.
#[derive(Default)]
pub(super) struct SharedFrames {
    frames: Vec<(Arc<Frame>, Option<u64>)>,
    /// The number of the last numbered image; 0 before the first.
    latest: u64,
    /// The width and height of that image.
    latest_size: [u32; 2],
    /// The parts that the last images of this size redrew, in their order. Parts of images of different sizes mean
    /// nothing together.
    redrawn: VecDeque<Vec<Rect>>,
}

/// A frame that nobody else holds.
#[derive(Default)]
pub(super) struct ReusableFrame {
    pub(super) frame: Frame,
    /// The image in it, if it is known.
    image: Option<u64>,
    /// What was drawn in it since it was taken, if the next image can follow from that.
    pub(super) redrawn: Option<Vec<Rect>>,
}

impl ReusableFrame {
    /// A frame with unknown contents.
    pub(super) fn of(frame: Frame) -> Self {
        Self { frame, ..Self::default() }
    }
}

impl SharedFrames {
    /// A frame that nobody else holds: of several the newest. The others are freed. An empty one if there is none.
    pub(super) fn take(&mut self) -> ReusableFrame {
        let mut newest = ReusableFrame::default();
        for (frame, image) in std::mem::take(&mut self.frames) {
            match Arc::try_unwrap(frame) {
                Ok(frame) if image >= newest.image => newest = ReusableFrame { frame, image, redrawn: None },
                Ok(_) => {}
                Err(held) => self.frames.push((held, image)),
            }
        }
        newest
    }

    /// Shares what was drawn. Its memory comes back once nobody else holds it.
    pub(super) fn share(&mut self, ReusableFrame { frame, redrawn, .. }: ReusableFrame) -> Arc<Frame> {
        let size = [frame.width, frame.height];
        let image = redrawn.map(|parts| {
            self.redrawn.push_back(parts);
            if self.redrawn.len() > REMEMBERED {
                self.redrawn.pop_front();
            }
            if self.latest_size != size {
                self.redrawn.clear();
                self.latest_size = size;
            }
            self.latest += 1;
            self.latest
        });
        let frame = Arc::new(frame);
        self.frames.push((Arc::clone(&frame), image));
        frame
    }

    /// Keeps a copy of a frame that its owner may change, if the next image can follow from it and there is memory
    /// for it.
    pub(super) fn keep(&mut self, drawn: &ReusableFrame, settings: &RenderSettings, rasterizer: &Rasterizer) {
        let Some(redrawn) = &drawn.redrawn else { return };
        let mut reserve = self.take();
        let has_size = [reserve.frame.width, reserve.frame.height] == [drawn.frame.width, drawn.frame.height];
        if reserve.frame.allocate(settings).is_err() {
            return;
        }
        if has_size && reserve.image == Some(self.latest) {
            copy_parts(&drawn.frame, &mut reserve.frame, redrawn, rasterizer);
        } else {
            copy_parts(&drawn.frame, &mut reserve.frame, &[whole(&drawn.frame)], rasterizer);
        }
        reserve.redrawn = Some(redrawn.clone());
        self.share(reserve);
    }

    /// Takes the memory of a frame whose contents do not matter.
    pub(super) fn give_back(&mut self, frame: Frame) {
        self.frames.push((Arc::new(frame), None));
    }

    /// Makes a free frame show the last numbered image, which has its size and outputs. Returns whether it does: an
    /// image that was refused or cancelled since may have taken the memory of that one.
    pub(super) fn bring_up_to_date(&self, free: &mut ReusableFrame, rasterizer: &Rasterizer) -> bool {
        if free.image == Some(self.latest) {
            return true;
        }
        let mut frames = self.frames.iter();
        let Some((latest, _)) = frames.find(|(_, image)| *image == Some(self.latest)) else { return false };
        let known = free.image.and_then(|image| self.redrawn_since(image));
        let parts = known.unwrap_or_else(|| vec![whole(latest)]);
        copy_parts(latest, &mut free.frame, &parts, rasterizer);
        true
    }

    /// The parts in which the last image may differ from an earlier one; `None` if that is not known.
    pub(super) fn redrawn_between(&self, before: &Frame, last: &Frame) -> Option<Vec<Rect>> {
        let number = |frame: &Frame| {
            let (_, image) = self.frames.iter().find(|(held, _)| std::ptr::eq(&raw const **held, frame))?;
            *image
        };
        let is_last = number(last).is_some_and(|last| last == self.latest);
        let have_one_size = [before.width, before.height] == [last.width, last.height];
        let before = number(before).filter(|_| is_last && have_one_size)?;
        self.redrawn_since(before)
    }

    /// The parts that differ between an image and the last one; `None` if that is forgotten.
    fn redrawn_since(&self, image: u64) -> Option<Vec<Rect>> {
        let since = (self.latest - image) as usize;
        let first = self.redrawn.len().checked_sub(since)?;
        Some(self.redrawn.range(first..).flatten().copied().collect())
    }
}

fn whole(frame: &Frame) -> Rect {
    Rect { min: [0, 0], max: [frame.width, frame.height].map(|size| size as i32) }
}

/// Copies parts of colours, depths and ids to a frame that has the same, in parallel.
fn copy_parts(from: &Frame, to: &mut Frame, parts: &[Rect], rasterizer: &Rasterizer) {
    let width = from.width as usize;
    copy_list(&from.color, &mut to.color, 4, width, parts, rasterizer);
    if let (Some(from), Some(to)) = (&from.depth, &mut to.depth) {
        copy_list(from, to, 1, width, parts, rasterizer);
    }
    let ids = [(&from.object_ids, &mut to.object_ids), (&from.face_ids, &mut to.face_ids)];
    for (from, to) in ids {
        if let (Some(from), Some(to)) = (from, to) {
            copy_list(from, to, 1, width, parts, rasterizer);
        }
    }
}

/// Copies parts of a list with so many items for each pixel.
fn copy_list<T: Copy + Send + Sync>(
    from: &[T],
    to: &mut [T],
    items: usize,
    width: usize,
    parts: &[Rect],
    rasterizer: &Rasterizer,
) {
    let band = (ROWS * items * width).max(1);
    let bands = from.chunks(band).zip(to.chunks_mut(band)).zip((0..).step_by(ROWS));
    rasterizer.share(bands, |((from, to), top)| {
        let bottom = top + (from.len() / (items * width)) as i32;
        for &Rect { min: [left, upper], max: [right, lower] } in parts {
            for row in upper.max(top)..lower.min(bottom) {
                let start = (row - top) as usize * width;
                let own = items * (start + left as usize)..items * (start + right as usize);
                to[own.clone()].copy_from_slice(&from[own]);
            }
        }
    });
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Three rows of two pixels, all of one byte.
    fn filled(mut free: ReusableFrame, byte: u8, redrawn: Option<Vec<Rect>>) -> ReusableFrame {
        let ids = Some(vec![u32::from(byte); 6]);
        free.frame = Frame {
            width: 2,
            height: 3,
            color: vec![byte; 24],
            face_ids: ids.clone(),
            object_ids: ids,
            depth: Some(vec![f32::from(byte); 6]),
            ..Frame::default()
        };
        ReusableFrame { redrawn, ..free }
    }

    fn part(min: [i32; 2], max: [i32; 2]) -> Vec<Rect> {
        vec![Rect { min, max }]
    }

    fn rasterizer() -> Rasterizer {
        Rasterizer::new(trigon_raster::ExecuteSettings::default()).expect("threads")
    }

    /// The bytes of a frame's pixels, which every output has.
    fn shown(frame: &Frame) -> Vec<u8> {
        let shown: Vec<u8> = frame.color.as_chunks::<4>().0.iter().map(|[first, ..]| *first).collect();
        let ids: Vec<u32> = shown.iter().map(|&byte| byte.into()).collect();
        assert_eq!(frame.face_ids.as_ref(), Some(&ids));
        assert_eq!(frame.object_ids.as_ref(), Some(&ids));
        let depths = shown.iter().map(|&byte| byte.into()).collect();
        assert_eq!(frame.depth.as_ref(), Some(&depths));
        shown
    }

    #[test]
    fn memory_comes_back_once_nobody_holds_it() {
        let mut frames = SharedFrames::default();
        assert_eq!(frames.take().frame.width, 0, "nothing was shared yet");
        let first = frames.share(filled(ReusableFrame::default(), 1, None));
        let place = first.color.as_ptr();
        assert_eq!(frames.take().frame.width, 0, "the first one is shown");
        drop(first);
        assert_eq!(frames.take().frame.color.as_ptr(), place, "the same memory");
        for byte in 0..4 {
            drop(frames.share(filled(ReusableFrame::default(), byte, None)));
        }
        frames.take();
        assert!(frames.frames.is_empty(), "all others were freed");
        frames.give_back(Frame { width: 9, ..Frame::default() });
        assert_eq!(frames.take().frame.width, 9);
    }

    /// Parts of a wide image were copied into a narrow one, beyond its end.
    #[test]
    fn parts_of_another_size_are_forgotten() {
        let (mut frames, rasterizer) = (SharedFrames::default(), rasterizer());
        let narrow = |frame: &mut Frame| {
            (frame.width, frame.height) = (1, 3);
            frame.color.truncate(12);
            [&mut frame.object_ids, &mut frame.face_ids]
                .into_iter()
                .flatten()
                .for_each(|ids| ids.truncate(3));
            frame.depth.iter_mut().for_each(|depth| depth.truncate(3));
        };
        let first = frames.share(filled(ReusableFrame::default(), 1, Some(part([0, 0], [2, 3]))));
        let shown = frames.share(filled(ReusableFrame::default(), 2, Some(part([1, 0], [2, 1]))));
        let mut last = filled(ReusableFrame::default(), 3, Some(part([0, 0], [1, 3])));
        narrow(&mut last.frame);
        let last = frames.share(last);
        drop(first);
        let mut free = frames.take();
        narrow(&mut free.frame);
        assert!(frames.bring_up_to_date(&mut free, &rasterizer), "there is a last image");
        assert!(free.frame == *last, "all of it, and nothing of the wide ones");
        drop(shown);
    }

    #[test]
    fn a_frame_that_comes_back_receives_what_was_drawn_since() {
        let (mut frames, rasterizer) = (SharedFrames::default(), rasterizer());
        let first = frames.share(filled(ReusableFrame::default(), 1, Some(part([0, 0], [2, 3]))));
        let second = frames.share(filled(ReusableFrame::default(), 2, Some(part([1, 0], [2, 1]))));
        drop(first);
        let mut free = frames.take();
        assert!(frames.bring_up_to_date(&mut free, &rasterizer));
        assert_eq!(shown(&free.frame), [1, 2, 1, 1, 1, 1], "the first image, and the part of the second");
        free.redrawn = Some(part([0, 1], [1, 3]));
        let third = frames.share(filled(free, 3, Some(part([0, 1], [1, 3]))));
        drop(second);
        let mut free = frames.take();
        assert!(frames.bring_up_to_date(&mut free, &rasterizer));
        assert_eq!(shown(&free.frame), [2, 2, 3, 2, 3, 2], "the second image, and the part of the third");
        frames.give_back(free.frame);
        drop(third);
        let mut newest = frames.take();
        assert!(frames.bring_up_to_date(&mut newest, &rasterizer));
        assert_eq!(shown(&newest.frame), [3; 6], "the last image needs nothing");
        frames.give_back(newest.frame);
        let mut unknown = frames.take();
        assert!(!frames.bring_up_to_date(&mut unknown, &rasterizer), "the last image is gone");
    }

    #[test]
    fn parts_between_images_are_known_while_somebody_holds_both() {
        let mut frames = SharedFrames::default();
        let rects = [part([0, 0], [2, 3]), part([1, 0], [2, 1]), part([0, 1], [1, 3])];
        let images = [1_u8, 2, 3].map(|byte| {
            let redrawn = rects[usize::from(byte) - 1].clone();
            frames.share(filled(ReusableFrame::default(), byte, Some(redrawn)))
        });
        let [first, second, third] = &images;
        assert_eq!(frames.redrawn_between(second, third), Some(rects[2].clone()), "of the last one");
        assert_eq!(frames.redrawn_between(first, third), Some(rects[1..].concat()), "of the last two");
        assert_eq!(frames.redrawn_between(third, third), Some(Vec::new()), "none");
        assert_eq!(frames.redrawn_between(first, second), None, "only the last one is of interest");
        let unknown = frames.share(filled(ReusableFrame::default(), 4, None));
        assert_eq!(frames.redrawn_between(third, &unknown), None, "it may differ anywhere");
        assert_eq!(frames.redrawn_between(&Frame::default(), third), None, "of another renderer");
        let mut larger = filled(ReusableFrame::default(), 5, Some(part([0, 0], [2, 9])));
        larger.frame.height = 9;
        let larger = frames.share(larger);
        assert_eq!(frames.redrawn_between(third, &larger), None, "of another size");
    }

    #[test]
    fn frames_of_unknown_contents_and_old_ones_are_copied_as_a_whole() {
        let (mut frames, rasterizer) = (SharedFrames::default(), rasterizer());
        let old = frames.share(filled(ReusableFrame::default(), 1, Some(part([0, 0], [2, 3]))));
        let mut held = Vec::new();
        for byte in 2..=REMEMBERED as u8 + 2 {
            held.push(frames.share(filled(ReusableFrame::default(), byte, Some(Vec::new()))));
        }
        drop(old);
        for mut free in [frames.take(), filled(ReusableFrame::default(), 0, None)] {
            assert!(frames.bring_up_to_date(&mut free, &rasterizer));
            assert_eq!(shown(&free.frame), [REMEMBERED as u8 + 2; 6]);
        }
    }
}
