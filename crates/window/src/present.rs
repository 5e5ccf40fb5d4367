//! Shows pixels in a window. The only file that knows softbuffer.

use std::num::NonZeroU32;
use std::sync::Arc;

use softbuffer::{Context, SoftBufferError, Surface};
use trigon_raster::paint2d::Rect;
use winit::event_loop::{ActiveEventLoop, OwnedDisplayHandle};
use winit::window::Window;

use crate::WindowError;
use crate::canvas::Canvas;

/// A window's pixels. Must be dropped before its window, which the `Arc` in the surface ensures.
pub(crate) struct Presenter {
    surface: Surface<OwnedDisplayHandle, Arc<Window>>,
    size: Option<(NonZeroU32, NonZeroU32)>,
    /// Whether the window shows all of a canvas of its size.
    whole: bool,
}

impl Presenter {
    /// For a window, at its current size: some systems panic if pixels are requested before a size
    /// was set.
    pub(crate) fn new(event_loop: &ActiveEventLoop, window: &Arc<Window>) -> Result<Self, WindowError> {
        let context = Context::new(event_loop.owned_display_handle()).map_err(refused)?;
        let surface = Surface::new(&context, Arc::clone(window)).map_err(refused)?;
        let mut presenter = Self { surface, size: None, whole: false };
        let size = window.inner_size();
        presenter.resize(size.width, size.height)?;
        Ok(presenter)
    }

    /// The window's new size. While it is minimized to nothing, the surface keeps its size.
    pub(crate) fn resize(&mut self, width: u32, height: u32) -> Result<(), WindowError> {
        let (Some(width), Some(height)) = (NonZeroU32::new(width), NonZeroU32::new(height)) else {
            return Ok(());
        };
        if self.size != Some((width, height)) {
            self.surface.resize(width, height).map_err(refused)?;
            self.size = Some((width, height));
            self.whole = false;
        }
        Ok(())
    }

    /// The window no longer shows the presented pixels.
    pub(crate) fn forget(&mut self) {
        self.whole = false;
    }

    /// Presents the canvas. Only the last painted area is written if the buffer is known to hold
    /// the rest, otherwise everything. A canvas of another size, painted just before a resize, is
    /// cropped or padded with black.
    pub(crate) fn present(&mut self, window: &Window, canvas: &Canvas) -> Result<(), WindowError> {
        let Some((width, height)) = self.size else { return Ok(()) };
        let mut buffer = self.surface.buffer_mut().map_err(refused)?;
        let fits = canvas.size() == [width.get(), height.get()];
        // Age 1: the buffer still holds the last presented pixels.
        let all = Rect::new([0, 0], [width.get() as i32, height.get() as i32]);
        let rects = if fits && self.whole && buffer.age() == 1 { canvas.painted() } else { &[all] };
        if fits {
            rects.iter().for_each(|rect| copy(canvas, *rect, &mut buffer));
        } else {
            fit(canvas, width.get() as usize, &mut buffer);
        }
        self.whole = fits;
        window.pre_present_notify();
        let damage: Vec<softbuffer::Rect> = rects.iter().filter_map(|rect| damage(*rect)).collect();
        buffer.present_with_damage(&damage).map_err(refused)
    }
}

/// Copies a rectangle to the same place.
fn copy(canvas: &Canvas, rect: Rect, buffer: &mut [u32]) {
    let width = canvas.size()[0] as usize;
    for y in rect.min[1] as usize..rect.max[1] as usize {
        let row = y * width + rect.min[0] as usize..y * width + rect.max[0] as usize;
        pack(&canvas.pixels()[row.clone()], &mut buffer[row]);
    }
}

/// Copies what fits; the rest is black.
fn fit(canvas: &Canvas, to: usize, buffer: &mut [u32]) {
    buffer.fill(0);
    let from = canvas.size()[0] as usize;
    let columns = to.min(from);
    let rows = buffer.chunks_exact_mut(to).zip(canvas.pixels().chunks_exact(from.max(1)));
    rows.for_each(|(to, from)| pack(&from[..columns], &mut to[..columns]));
}

/// As `0x00RRGGBB`.
fn pack(pixels: &[[u8; 4]], to: &mut [u32]) {
    to.iter_mut().zip(pixels).for_each(|(to, &[b, g, r, _])| *to = u32::from_be_bytes([0, r, g, b]));
}

fn damage(rect: Rect) -> Option<softbuffer::Rect> {
    let side = |axis: usize| NonZeroU32::new((rect.max[axis] - rect.min[axis]) as u32);
    Some(softbuffer::Rect { x: rect.min[0] as u32, y: rect.min[1] as u32, width: side(0)?, height: side(1)? })
}

fn refused(error: SoftBufferError) -> WindowError {
    WindowError::Surface { reason: error.to_string() }
}
