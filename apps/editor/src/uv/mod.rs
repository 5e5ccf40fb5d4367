//! The view of texture coordinates: the plane of the image with the faces of what is edited. What is selected there is
//! what is selected in the mesh.
//!
//! `canvas` maps coordinates to points of the window, `backdrop` draws the image behind, `shapes` draws faces, edges and
//! vertices, `picking` turns points and boxes into commands that select, and `layout` makes an image of it all.

mod backdrop;
mod canvas;
mod layout;
mod picking;
mod shapes;

use trigon_document::mesh::math::DVec2;
use trigon_document::{Document, selected_uv_corners};
use trigon_window::egui::{Painter, Pos2};

pub(crate) use backdrop::Backdrop;
pub(crate) use canvas::{UvCamera, UvCanvas};
pub(crate) use layout::layout;
pub(crate) use picking::{click, island, within};
pub(crate) use shapes::UvColors;

use backdrop::ShownImage;
use picking::{UV_SET, meshes};
use shapes::KnownOverlaps;

/// The view, shown or not.
#[derive(Default)]
pub(crate) struct UvView {
    pub(crate) is_open: bool,
    pub(crate) camera: UvCamera,
    pub(crate) backdrop: Backdrop,
    pub(crate) colors: UvColors,
    /// Whether islands are unwrapped again while pins move and when seams are marked.
    pub(crate) live_unwrap: bool,
    /// Where it was drawn last, while it is open.
    pub(crate) canvas: Option<UvCanvas>,
    /// Where a box that selects began.
    pub(crate) box_from: Option<Pos2>,
    image: ShownImage,
    overlaps: KnownOverlaps,
}

impl UvView {
    /// Draws it.
    pub(crate) fn draw(&mut self, painter: &Painter, canvas: &UvCanvas, document: &Document) -> Drawing {
        if !document.selection().is_editing() {
            return Drawing::NotEditing;
        }
        self.image.draw(painter, canvas, document, self.backdrop);
        if meshes(document).next().is_none() {
            return Drawing::NoCoordinates;
        }
        let is_partial = shapes::draw(painter, canvas, document, self.colors, &mut self.overlaps);
        if is_partial { Drawing::SelectedOnly } else { Drawing::All }
    }

    /// Where it is under a point of the window.
    pub(crate) fn canvas_at(&self, at: Pos2) -> Option<&UvCanvas> {
        self.canvas.as_ref().filter(|canvas| self.is_open && canvas.rect.contains(at))
    }
}

/// What a drawing shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Drawing {
    All,
    /// There is too much else.
    SelectedOnly,
    /// What is edited has no coordinates yet.
    NoCoordinates,
    /// Nothing is edited.
    NotEditing,
}

/// The box around the coordinates of what is selected, or of all if nothing is.
pub(crate) fn bounds(document: &Document) -> Option<[DVec2; 2]> {
    let kind = document.selection().kind();
    let (mut selected, mut all) = (Vec::new(), Vec::new());
    for (id, mesh) in meshes(document) {
        let Some(selection) = document.selection().of(id) else { continue };
        let corners = selected_uv_corners(mesh, selection, kind, UV_SET);
        selected.extend(corners.into_iter().map(|corner| picking::uv(mesh, corner)));
        all.extend(mesh.corners().map(|corner| picking::uv(mesh, corner)));
    }
    let all = if selected.is_empty() { all } else { selected };
    let low = all.iter().copied().reduce(DVec2::min)?;
    let high = all.iter().copied().reduce(DVec2::max)?;
    Some([low, high])
}
