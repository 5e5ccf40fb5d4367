//! Pixels into a window. The only file that knows softbuffer.

use std::num::NonZeroU32;
use std::sync::Arc;

use softbuffer::{Context, SoftBufferError, Surface};
use winit::event_loop::{ActiveEventLoop, OwnedDisplayHandle};
use winit::window::Window;

use crate::WindowError;
use crate::canvas::Canvas;

/// A window's pixels. Has to be dropped before its window, which the `Arc` in
/// the surface sees to.
pub(crate) struct Presenter {
    surface: Surface<OwnedDisplayHandle, Arc<Window>>,
    size: Option<(NonZeroU32, NonZeroU32)>,
}

impl Presenter {
    /// For a window, at its current size: some systems panic when pixels are
    /// asked for before a size was set.
    pub(crate) fn new(event_loop: &ActiveEventLoop, window: &Arc<Window>) -> Result<Self, WindowError> {
        let context = Context::new(event_loop.owned_display_handle()).map_err(refused)?;
        let surface = Surface::new(&context, Arc::clone(window)).map_err(refused)?;
        let mut presenter = Self { surface, size: None };
        let size = window.inner_size();
        presenter.resize(size.width, size.height)?;
        Ok(presenter)
    }

    /// The window has this size now. While it is minimised to nothing, the
    /// surface keeps the size that it had.
    pub(crate) fn resize(&mut self, width: u32, height: u32) -> Result<(), WindowError> {
        let (Some(width), Some(height)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            return Ok(());
        };
        if self.size != Some((width, height)) {
            self.surface.resize(width, height).map_err(refused)?;
            self.size = Some((width, height));
        }
        Ok(())
    }

    /// Shows the canvas. Every pixel is written: what the buffer held before is
    /// not ours. A canvas of another size, drawn just before a resize, is cut
    /// off or padded with black.
    pub(crate) fn present(&mut self, window: &Window, canvas: &Canvas) -> Result<(), WindowError> {
        let Some((width, height)) = self.size else { return Ok(()) };
        let mut buffer = self.surface.buffer_mut().map_err(refused)?;
        let (to, from) = (width.get() as usize, canvas.width() as usize);
        if (to, height.get() as i32) == (from, canvas.height()) {
            buffer.copy_from_slice(canvas.pixels());
        } else {
            buffer.fill(0);
            let columns = to.min(from);
            let rows = buffer.chunks_exact_mut(to).zip(canvas.pixels().chunks_exact(from.max(1)));
            rows.for_each(|(to, from)| to[..columns].copy_from_slice(&from[..columns]));
        }
        window.pre_present_notify();
        buffer.present().map_err(refused)
    }
}

fn refused(error: SoftBufferError) -> WindowError {
    WindowError::Surface { reason: error.to_string() }
}
