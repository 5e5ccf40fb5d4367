//! Classical visible-surface algorithms: painter's, Roberts', Warnock's, the z-buffer, and ray casting with and
//! without a tree. Source D compares these algorithms (row D5); they are kept for teaching and for measuring
//! against.
//!
//! All methods take a [`Scene`] of bodies whose corners lie on a grid of 1/256 pixel, as in `trigon-raster`. So
//! they agree on what a face covers ([`Edges`]), and differ only in how they find the nearest one. Nothing is
//! clipped: coordinates stay within 2¹⁴ pixels, depths within 2¹⁸ steps of the grid.
//!
//! ```
//! use trigon_classic::{Body, Method, Scene};
//!
//! // Two tetrahedra in an image of 32×32 pixels; z grows towards the eye.
//! let corners = [[0, 0, 0], [8000, 0, 0], [0, 8000, 0], [2000, 2000, 900]];
//! let nearer = corners.map(|[x, y, z]| [x, y, z + 5000]);
//! let scene = Scene::new([32, 32], vec![Body::tetrahedron(corners), Body::tetrahedron(nearer)]);
//!
//! let painted = Method::Painter.draw(&scene)?;
//! assert_eq!(painted.faces, Method::ZBuffer.draw(&scene)?.faces, "nothing intersects");
//! // The second body's faces are numbers 4 to 7.
//! assert!((4..8).contains(&painted.faces[[8, 8]]));
//! assert_eq!(painted.faces[[31, 31]], u32::MAX, "no face");
//! # Ok::<(), trigon_classic::NotConvex>(())
//! ```

#![cfg_attr(test, allow(clippy::unwrap_used, reason = "tests may"))]

mod edges;
mod field;
mod painter;
mod rays;
mod roberts;
mod scene;
mod surface;
mod warnock;
mod z_buffer;

#[cfg(test)]
mod tests;

pub use trigon_mesh as mesh;

pub use edges::{Edges, weighted};
pub use field::{Drawing, Field};
pub use roberts::{Line, Lines, visible_lines};
pub use scene::{Body, Corner, DEPTH_LIMIT, Face, NotConvex, Pose, STEPS_PER_PIXEL, Scene};
pub use surface::Surface;

use painter::Painter;
use rays::{AllFaces, Tree};
use std::hint::black_box;
use z_buffer::Buffers;

/// A way to find the nearest face of each pixel.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Method {
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
}

impl Method {
    /// All of them.
    pub const ALL: [Self; 6] =
        [Self::Painter, Self::Roberts, Self::Warnock, Self::ZBuffer, Self::AllRays, Self::TreeRays];

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
            Self::TreeRays => "",
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
    pub fn keeps_state(self) -> bool {
        ![Self::Roberts, Self::Warnock].contains(&self)
    }
}

/// Runs the README's example as a test.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
