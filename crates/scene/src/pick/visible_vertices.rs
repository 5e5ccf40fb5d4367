//! The vertices of a scene that are visible in an image, so that a region need not find out again.

use fixedbitset::FixedBitSet;

use super::kept::PointOrigin;
use super::kind::Kind;
use super::object::{Facing, Object};
use super::picker::Picker;
use super::region::Region;
use super::screen::Screen;
use crate::elements::ElementSet;

/// Which vertices no face but their own hides, of all that lie in an image.
#[derive(Clone, Debug)]
pub(super) struct VisibleVertices {
    origins: Vec<Option<VisibleOrigin>>,
    vertices: ElementSet,
}

/// What the visibility of points depends on, of one object.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct VisibleOrigin {
    pub(super) points: PointOrigin,
    pub(super) facings: Vec<Facing>,
}

/// Of all objects, by the indices of their nodes. `None` if it also depends on something else: a pose, or the
/// pixels in which a face with holes or a translucent one is visible.
fn origins(objects: &[Option<Object<'_>>], screen: &Screen) -> Option<Vec<Option<VisibleOrigin>>> {
    let of_object = |object: &Option<Object<'_>>| match object {
        Some(object) => object.visible_origin(screen).map(Some),
        None => Some(None),
    };
    objects.iter().map(of_object).collect()
}

impl VisibleVertices {
    /// Decides about all vertices of a picker's image.
    pub(super) fn find(picker: &Picker<'_>) -> Option<Self> {
        let origins = origins(picker.objects(), &picker.screen)?;
        let size = picker.projector.viewport().size();
        let whole = Region::Rectangle { min: trigon_math::DVec2::ZERO, max: size };
        Some(Self { origins, vertices: picker.decided(Kind::Vertex, &whole) })
    }

    /// Whether they are the visible ones of these objects, too.
    pub(super) fn hold(&self, objects: &[Option<Object<'_>>], screen: &Screen) -> bool {
        origins(objects, screen).is_some_and(|origins| origins == self.origins)
    }

    /// Those of an object; `None` if it has none.
    pub(super) fn of(&self, object: &Object<'_>) -> Option<&FixedBitSet> {
        self.vertices.of(object.node)
    }
}
