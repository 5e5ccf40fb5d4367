//! Draws a frame: runs all stages, from the plan to the finished tiles.
//!
//! | file | what it does |
//! |---|---|
//! | `layout` | what is known before any vertex runs |
//! | `stages` | **the stages of a whole frame**, in their order |
//! | `set_up` | sets up primitives, chunk by chunk |
//! | `tiles` | draws one tile, or only what changed in a cached tile |
//! | `redraw` | **the stages of a frame that differs little from the last one** |
//! | `change` | which tiles a change touches |
//! | `changed_vertices` | which vertices run again, and which primitives that affects |
//! | `moving` | primitives that move in several frames, and the cached tiles under them |

mod change;
mod changed_vertices;
mod layout;
mod moving;
mod redraw;
mod set_up;
mod stages;
mod tiles;

pub use change::{DrawChange, Redraw};
pub(crate) use layout::FrameOptions;
pub(crate) use redraw::redraw;
pub(crate) use stages::{Arena, draw, prepare};
pub(crate) use tiles::outer_ink;
