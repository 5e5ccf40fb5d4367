//! The size of a new window.

use trigon_camera::Viewport;
use winit::dpi::LogicalSize;
use winit::event_loop::ActiveEventLoop;

/// Room for frames and task bars, in points.
const FRAMES: LogicalSize<f64> = LogicalSize::new(40.0, 96.0);

/// What an application wants, in points, as far as it fits on a screen.
pub(super) fn fitting(wanted: Viewport, screen: Option<LogicalSize<f64>>) -> LogicalSize<f64> {
    let wanted = LogicalSize::new(f64::from(wanted.width.max(1)), f64::from(wanted.height.max(1)));
    let Some(screen) = screen else { return wanted };
    let bound = |wanted: f64, screen: f64, frame: f64| wanted.min((screen - frame).max(1.0));
    LogicalSize::new(
        bound(wanted.width, screen.width, FRAMES.width),
        bound(wanted.height, screen.height, FRAMES.height),
    )
}

/// The size of the screen on which windows open, in points; `None` where the system does not say.
pub(super) fn screen(event_loop: &ActiveEventLoop) -> Option<LogicalSize<f64>> {
    let monitor = event_loop.primary_monitor().or_else(|| event_loop.available_monitors().next())?;
    let size = monitor.size().to_logical(monitor.scale_factor());
    (size.width >= 1.0 && size.height >= 1.0).then_some(size)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The right edge and the status line of a window were beyond a screen of 1400×900.
    #[test]
    fn a_new_window_fits_on_the_screen() {
        let wanted = Viewport { width: 1440, height: 900 };
        let on = |width, height| fitting(wanted, Some(LogicalSize::new(width, height)));
        assert_eq!(on(1400.0, 900.0), LogicalSize::new(1360.0, 804.0), "as large as the screen allows");
        assert_eq!(on(2560.0, 1440.0), LogicalSize::new(1440.0, 900.0), "as wanted");
        assert_eq!(on(30.0, 50.0), LogicalSize::new(1.0, 1.0), "never nothing");
        assert_eq!(fitting(wanted, None), LogicalSize::new(1440.0, 900.0), "nothing is known of the screen");
    }
}
