//! Pivots: the fixed point of rotations and scales.

use trigon_document::mesh::math::DVec3;

use super::selected::Selected;

/// The centre of turns and scales.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Pivot {
    /// The mean of the selected vertices, or of the origins of objects.
    #[default]
    Median,
    /// Each part that hangs together about its own middle, each object about its own origin.
    Individual,
    /// The origin of the active object.
    Origin,
    /// The middle of the box around what is selected.
    Bounds,
    /// What was selected last; the median where nothing is.
    Active,
    /// The 3D cursor.
    Cursor,
}

impl Pivot {
    /// Where the pivot is drawn; of individual ones their median.
    pub(crate) fn point(self, selected: &Selected, cursor: DVec3) -> DVec3 {
        match self {
            Self::Median | Self::Individual => selected.median(),
            Self::Origin => selected.origin,
            Self::Bounds => selected.bounds_center(),
            Self::Active => selected.active.unwrap_or_else(|| selected.median()),
            Self::Cursor => cursor,
        }
    }

    /// The centre for a command; individual ones are left to it.
    pub(crate) fn center(self, selected: &Selected, cursor: DVec3) -> Option<[f64; 3]> {
        (self != Self::Individual).then(|| self.point(selected, cursor).to_array())
    }
}

#[cfg(test)]
mod tests {
    use trigon_document::mesh::math::DMat3;

    use super::*;

    #[test]
    fn each_pivot_is_where_it_says() {
        let selected = Selected {
            points: vec![DVec3::ZERO, DVec3::ZERO, DVec3::X * 6.0],
            active: Some(DVec3::Y),
            origin: DVec3::Z,
            local: DMat3::IDENTITY,
            normal: DMat3::IDENTITY,
            is_editing: true,
        };
        let cursor = DVec3::NEG_X;
        for (pivot, point) in [
            (Pivot::Median, DVec3::X * 2.0),
            (Pivot::Individual, DVec3::X * 2.0),
            (Pivot::Bounds, DVec3::X * 3.0),
            (Pivot::Origin, DVec3::Z),
            (Pivot::Active, DVec3::Y),
            (Pivot::Cursor, cursor),
        ] {
            assert_eq!(pivot.point(&selected, cursor), point, "{pivot:?}");
            assert_eq!(pivot.center(&selected, cursor).is_none(), pivot == Pivot::Individual, "{pivot:?}");
        }
        let none = Selected { active: None, ..selected };
        assert_eq!(Pivot::Active.point(&none, cursor), DVec3::X * 2.0, "nothing was selected one by one");
    }
}
