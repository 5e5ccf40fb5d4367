//! The triangles that all algorithms fill.

use trigon_math::Vec2;

/// A triangle in pixels from the top left, y down, in either winding.
pub type Triangle = [Vec2; 3];

/// The smallest and the largest of three.
pub(crate) fn range<T: PartialOrd + Copy>([a, b, c]: [T; 3]) -> [T; 2] {
    let least = |a, b| if b < a { b } else { a };
    let most = |a, b| if b > a { b } else { a };
    [least(least(a, b), c), most(most(a, b), c)]
}
