//! Which sides of a material's faces are drawn, and whether they hide what is behind them.

/// How faces of a material are drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Facing {
    /// Whether backs are drawn, too.
    pub(super) double_sided: bool,
    /// Whether there are no holes, and nothing shines through.
    pub(super) is_opaque: bool,
    /// Whether fronts wind clockwise because the object is mirrored.
    pub(super) is_mirrored: bool,
}

impl Facing {
    /// Whether a triangle of this area on the screen, where y points down, is drawn.
    pub(super) fn draws(&self, area: f64) -> bool {
        area != 0.0 && (self.double_sided || (area < 0.0) != self.is_mirrored)
    }
}
