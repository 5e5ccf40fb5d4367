//! Draws a frame: runs all stages, from the plan to the finished tiles.
//!
//! | file | what it does |
//! |---|---|
//! | `layout` | what is known before any vertex runs |
//! | `stages` | **the stages of a whole frame**, in their order |
//! | `set_up` | sets up primitives, chunk by chunk |
//! | `occlusion` | which draws are hidden as a whole, before their vertices run |
//! | `tiles` | draws one tile, or only what changed in a cached tile |
//! | `redraw` | **the stages of a frame that differs little from the last one** |
//! | `change` | whether a change can be followed; the set of tiles to draw again |
//! | `changed_vertices` | the vertices that run again, and the primitives that they affect |
//! | `moving` | primitives that move frame after frame, and cached images of their tiles without them |

mod change;
mod changed_vertices;
mod layout;
mod moving;
mod occlusion;
mod redraw;
mod set_up;
mod stages;
mod tiles;

pub use change::{DrawChange, Redraw};
pub(crate) use layout::FrameOptions;
pub(crate) use redraw::redraw;
pub(crate) use stages::{Arena, draw, prepare};
pub(crate) use tiles::outer_ink;
