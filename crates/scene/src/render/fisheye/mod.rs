//! Images through a fisheye lens. No matrix maps space to such an image, so rays find what its samples show, exactly
//! along the rays of the lens. All else is as in a rasterized frame: the composer's draws, their pipelines, the effects
//! of the plan, and the outputs that are derived from visible triangles.
//!
//! | file | what it does |
//! |---|---|
//! | `triangles` | a BVH over everything that may be drawn, cached from frame to frame |
//! | `tracer` | **the surfaces that rays meet**, front to back: culling, masks, blended layers |
//! | `picture` | colours of samples, and their mean; ids of pixels |
//!
//! Every sample is traced and shaded by itself, so that no byte depends on threads. `lens_frame.rs` in the folder above has
//! the steps of such a frame.

mod picture;
mod tracer;
mod triangles;

pub(super) use picture::SampleGrid;
pub(super) use tracer::Tracer;
pub(super) use triangles::{EyeTriangleCache, EyeTriangles};
