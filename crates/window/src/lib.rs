//! A window that shows a scene.
//!
//! [`Application`] is the simple way: create objects and run it. Mouse and keys move the camera and
//! the selected object, and nothing runs while nothing changes. Programs that need more implement
//! [`Handler`], which can read and change everything on the [`Stage`]: scene, camera, settings,
//! keys, texts.
//!
//! [`trigon_scene`] draws frames; this crate decides when and in which quality, and presents them on
//! the screen. It knows no file formats and no editing.
//!
//! The path of an event: winit → `input` → `session` → `pacing` → `worker` → `interface` → `egui_painter` →
//! `canvas` → `present`. `input` translates it, and `session` passes it to the interface, the application, or the
//! camera. `pacing` decides when to draw, and in which quality; `worker` draws the scene on its own thread.
//! `interface` lays out the panels, `egui_painter` repaints what changed, and `present` shows the result by
//! softbuffer. Only `shell`, `present` and `input::translate` know the window system; everything else is tested
//! without a display.
//!
//! ```no_run
//! use trigon_window::scene::{Material, math::DVec3, mesh::primitives};
//! use trigon_window::{AnimationState, Application};
//!
//! # fn main() -> Result<(), trigon_window::WindowError> {
//! let mut application = Application::new("A turning cube");
//! let cube = application.stage.scene.add_object("cube", primitives::cube(1.0), Material::default());
//! application.animate(move |stage, tick| {
//!     if let Some(node) = stage.scene.node_mut(cube) {
//!         node.transform.rotate(DVec3::Y, tick.delta.as_secs_f64());
//!     }
//!     AnimationState::Running
//! });
//! application.run()
//! # }
//! ```

mod application;
mod canvas;
mod choice;
mod clip_line;
mod commands;
mod drawer;
mod egui_painter;
mod error;
mod handler;
#[cfg(any(test, feature = "kittest"))]
mod headless;
mod input;
mod interaction;
mod interface;
mod keymap;
mod motion;
mod moves;
mod overlay;
mod pacing;
mod panes;
mod path_line;
mod popup;
mod present;
mod recent;
mod refinement;
mod session;
mod shared_scene;
mod shell;
mod shown;
mod stage;
mod theme;
mod waker;
mod worker;

pub use application::Application;
pub use choice::choose;
pub use clip_line::clip_line;
pub use drawer::Drawer;
#[cfg(any(test, feature = "kittest"))]
pub use egui_painter::EguiTestRenderer;
pub use egui_painter::{ChannelOrder, EguiPainter, MAX_TEXTURE_SIDE};
pub use error::WindowError;
pub use handler::{AnimationState, Handler, Tick};
#[cfg(any(test, feature = "kittest"))]
pub use headless::{DrawnFrame, HeadlessWindow, LiveFrame, Widget};
pub use input::{Chord, ChordError, Hands, Input, InputOwner, Key, Modifiers, PointerButton, Taken};
pub use interaction::{Interaction, InteractionError};
pub use keymap::{
    Action, Binding, CameraMotion, ClickAction, ClickBinding, DragAction, DragBinding, Keymap, MenuEntry,
    Motion, ObjectMotion, SheetRow, matches_search,
};
pub use overlay::{Corner, Overlay};
pub use panes::{Area, Pane};
pub use path_line::{path_from_line, path_to_line};
pub use popup::{PopupEnd, popup_entry, popup_menu};
pub use recent::{RecentFiles, state_folder};
pub use refinement::{Comparison, Difference, QualityReport, Refinement};
pub use shared_scene::{Revision, SharedScene};
pub use stage::{FrameReport, Stage, Visibility};
pub use theme::Theme;
pub use waker::Waker;

/// Re-exports of the crates below, so that an application needs no others.
pub use egui;
pub use trigon_scene as scene;

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
