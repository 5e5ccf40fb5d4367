//! What a fisheye lens leaves out of an image.

use std::fmt;

use super::Named;
use crate::elements::Marks;
use crate::scene::Scene;
use crate::settings::{RenderSettings, Style};

/// Something of a scene or of its settings that a fisheye lens does not show: it is drawn by rays, which meet surfaces
/// alone. Lines and points have a width in pixels of a plane.
#[derive(Clone, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Omission {
    /// The settings request edges or a wireframe; surfaces are drawn in their place.
    Edges,
    /// The settings request the vertices of meshes as points.
    VertexPoints,
    /// The settings mark elements.
    Marks,
    /// Objects have loose lines or points.
    LinesAndPoints(Named),
}

impl Omission {
    /// What an image of a scene through a fisheye lens leaves out.
    ///
    /// ```
    /// use trigon_scene::{Omission, RenderSettings, Style, showcase};
    ///
    /// let settings = RenderSettings { style: Style::Wireframe, ..RenderSettings::new(64, 64) };
    /// assert_eq!(Omission::all(&showcase(), &settings), [Omission::Edges]);
    /// ```
    #[must_use]
    pub fn all(scene: &Scene, settings: &RenderSettings) -> Vec<Self> {
        let mut objects = Named::default();
        for (_, node) in scene.nodes().iter() {
            let asset = node.mesh.and_then(|mesh| scene.meshes().get(mesh));
            if asset.is_some_and(|asset| !asset.has_nothing_loose()) {
                objects.add(if node.name.is_empty() { "an unnamed object" } else { &node.name });
            }
        }
        let found = [
            (settings.style != Style::Surface).then_some(Self::Edges),
            settings.vertices.is_some().then_some(Self::VertexPoints),
            (!settings.marks.is_plain()).then_some(Self::Marks),
            (objects.count > 0).then_some(Self::LinesAndPoints(objects)),
        ];
        found.into_iter().flatten().collect()
    }

    /// The settings without what would be left out.
    pub(crate) fn without(settings: &RenderSettings) -> RenderSettings {
        let mut settings = settings.clone();
        (settings.style, settings.vertices, settings.marks) = (Style::Surface, None, Marks::default());
        settings
    }
}

impl fmt::Display for Omission {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Edges => f.write_str("edges of faces are not drawn through a fisheye lens"),
            Self::VertexPoints => f.write_str("vertices are not drawn as points through a fisheye lens"),
            Self::Marks => f.write_str("marks are not drawn through a fisheye lens"),
            Self::LinesAndPoints(Named { count: 1, first }) => {
                write!(f, "the lines and points of `{first}` are not drawn through a fisheye lens")
            }
            Self::LinesAndPoints(Named { count, first }) => write!(
                f,
                "the lines and points of {count} objects, such as `{first}`, are not drawn through a fisheye lens"
            ),
        }
    }
}
