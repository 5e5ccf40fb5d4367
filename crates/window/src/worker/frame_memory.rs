//! Reuses the memory of frames.
//!
//! A frame of a window takes tens of megabytes. Allocating them for every frame would take milliseconds,
//! because the system has to map and clear each page.

use std::sync::Arc;

use trigon_scene::Frame;

/// Frames that were shared with the window. Those that it no longer holds give their memory to the
/// next ones.
#[derive(Default)]
pub(super) struct FrameMemory {
    shared: Vec<Arc<Frame>>,
}

impl FrameMemory {
    /// A frame that nobody else holds, with whatever was drawn in it last; an empty one if there is none.
    /// All others that nobody holds are freed.
    pub(super) fn take(&mut self) -> Frame {
        let mut free = Frame::default();
        let shared = std::mem::take(&mut self.shared);
        for frame in shared {
            match Arc::try_unwrap(frame) {
                Ok(frame) => free = frame,
                Err(held) => self.shared.push(held),
            }
        }
        free
    }

    /// Shares a frame, whose memory comes back once nobody else holds it.
    pub(super) fn share(&mut self, frame: Frame) -> Arc<Frame> {
        let frame = Arc::new(frame);
        self.shared.push(Arc::clone(&frame));
        frame
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(width: u32) -> Frame {
        Frame { width, color: vec![0; 4 * width as usize], ..Frame::default() }
    }

    #[test]
    fn memory_comes_back_once_nobody_holds_it() {
        let mut memory = FrameMemory::default();
        assert_eq!(memory.take().width, 0, "nothing was shared yet");
        let first = memory.share(frame(7));
        let place = first.color.as_ptr();
        assert_eq!(memory.take().width, 0, "the first one is shown");
        let second = memory.share(frame(8));
        drop(first);
        let free = memory.take();
        assert_eq!((free.width, free.color.as_ptr()), (7, place), "the same memory");
        assert_eq!(memory.shared.len(), 1, "the second one is shown");
        drop(second);
        let _third = memory.share(free);
        assert_eq!(memory.take().width, 8);
    }

    #[test]
    fn no_more_than_one_frame_is_kept_for_nothing() {
        let mut memory = FrameMemory::default();
        let held = [1, 2, 3, 4].map(|width| memory.share(frame(width)));
        drop(held);
        assert_ne!(memory.take().width, 0);
        assert!(memory.shared.is_empty(), "the others were freed");
    }
}
