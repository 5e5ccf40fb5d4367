//! Which face is visible in each pixel? The algorithms that source D discusses (row D5), and two that it
//! leaves out.
//!
//! All take a [`Scene`] of bodies whose corners lie on a grid as fine as the engine's. So they agree on what
//! a face covers, and differ only in how they find the nearest one.

mod cases;
mod drawing;
mod engine;
mod errors;
mod painter;
mod rays;
mod roberts;
mod scene;
mod surface;
mod warnock;
mod z_buffer;

#[cfg(test)]
mod tests;

pub use cases::{Case, balls, sheets};
pub use drawing::Drawing;
pub use errors::OrderErrors;
pub use roberts::{Line, Lines};
pub use scene::{Body, Corner, NotConvex, Pose, Scene};

pub(crate) use engine::clip_corners;
pub(crate) use surface::Surface;

use painter::Painter;
use rays::{AllFaces, Tree};
use std::hint::black_box;
use z_buffer::Buffers;

/// A way to find what is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Visibility {
    /// Faces from the farthest to the nearest, one over the other.
    Painter,
    /// Bodies that hide each other, in object space; convex ones only.
    Roberts,
    /// Windows that are divided until they are simple.
    Warnock,
    /// The nearest depth so far in each pixel.
    ZBuffer,
    /// A ray through each pixel, tested against every face.
    AllRays,
    /// The same with a bounding volume hierarchy.
    TreeRays,
    /// The renderer.
    Engine,
}

impl Visibility {
    /// All of them.
    pub const ALL: [Self; 7] = [
        Self::Painter,
        Self::Roberts,
        Self::Warnock,
        Self::ZBuffer,
        Self::AllRays,
        Self::TreeRays,
        Self::Engine,
    ];

    /// The name in tables and plots.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Painter => "painter",
            Self::Roberts => "Roberts",
            Self::Warnock => "Warnock",
            Self::ZBuffer => "z-buffer",
            Self::AllRays => "rays, every face",
            Self::TreeRays => "rays, tree",
            Self::Engine => "engine",
        }
    }

    /// What is counted as a test; empty where nothing is.
    #[must_use]
    pub fn test(self) -> &'static str {
        match self {
            Self::Painter => "comparisons of the sort",
            Self::Roberts => "points or edges against planes",
            Self::Warnock => "faces against windows",
            Self::ZBuffer => "pixels against edges",
            Self::AllRays => "rays against faces",
            Self::TreeRays | Self::Engine => "",
        }
    }

    /// Draws a scene.
    ///
    /// # Errors
    /// Roberts' algorithm refuses bodies that are not convex.
    pub fn draw(self, scene: &Scene) -> Result<Drawing, NotConvex> {
        match self {
            Self::Painter => Ok(Painter::new(scene).draw(scene).clone()),
            Self::Roberts => roberts::draw(scene),
            Self::Warnock => Ok(warnock::draw(scene)),
            Self::ZBuffer => Ok(Buffers::new(scene).draw(scene).clone()),
            Self::AllRays => Ok(AllFaces::new(scene).draw().clone()),
            Self::TreeRays => Ok(Tree::new(scene).draw().clone()),
            Self::Engine => Ok(engine::draw(scene)),
        }
    }

    /// What draws a scene again and again, with memory, trees and what else is the same for any
    /// ray kept; a scene that is refused takes no time.
    #[must_use]
    pub fn repeated(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        match self {
            Self::Painter => {
                let mut painter = Painter::new(scene);
                Box::new(move || {
                    black_box(painter.draw(scene));
                })
            }
            Self::ZBuffer => {
                let mut buffers = Buffers::new(scene);
                Box::new(move || {
                    black_box(buffers.draw(scene));
                })
            }
            Self::AllRays => {
                let mut faces = AllFaces::new(scene);
                Box::new(move || {
                    black_box(faces.draw());
                })
            }
            Self::TreeRays => {
                let mut tree = Tree::new(scene);
                Box::new(move || {
                    black_box(tree.draw());
                })
            }
            Self::Engine => Box::new(engine::repeated(scene)),
            Self::Roberts | Self::Warnock => self.repeated_anew(scene),
        }
    }

    /// What draws a scene again and again with nothing kept.
    #[must_use]
    pub fn repeated_anew(self, scene: &Scene) -> Box<dyn FnMut() + '_> {
        Box::new(move || drop(self.draw(scene)))
    }

    /// Whether [`repeated`](Self::repeated) keeps anything.
    #[must_use]
    pub fn is_kept(self) -> bool {
        ![Self::Roberts, Self::Warnock].contains(&self)
    }
}

/// The lines that Roberts' algorithm shows of a scene's edges.
///
/// # Errors
/// A body that is not convex.
pub fn visible_lines(scene: &Scene) -> Result<Lines, NotConvex> {
    roberts::visible_lines(scene)
}
