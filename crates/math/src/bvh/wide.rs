//! The tree as rays traverse it: boxes and triangles in groups of eight, component by component.

use glam::Vec3;

/// Boxes of a node, and triangles of a leaf.
pub(super) const WIDTH: usize = 8;

/// One number for each element of a group.
pub(super) type Eight = [f32; WIDTH];

/// Up to eight boxes and their contents.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Node {
    /// By axis, then the lower and the upper side.
    pub(super) sides: [[Eight; 2]; 3],
    pub(super) children: [Child; WIDTH],
}

/// The content of a box: a node or, with the topmost bit set, a leaf.
#[derive(Clone, Copy, Debug)]
pub(super) struct Child(u32);

/// The meaning of a [`Child`] number.
pub(super) enum Inside {
    Node(usize),
    Leaf(usize),
}

/// Up to eight triangles.
#[derive(Clone, Copy, Debug)]
#[repr(align(64))]
pub(super) struct Leaf {
    /// By corner, then axis.
    pub(super) corners: [[Eight; 3]; 3],
    /// The numbers of the triangles; [`Leaf::NONE`] after the last.
    pub(super) numbers: [u32; WIDTH],
}

impl Child {
    const LEAF: u32 = 1 << 31;

    pub(super) fn node(number: usize) -> Self {
        Self(number as u32)
    }

    pub(super) fn leaf(number: usize) -> Self {
        Self(number as u32 | Self::LEAF)
    }

    /// The same, with that many nodes and leaves before it.
    pub(super) fn moved(self, nodes: usize, leaves: usize) -> Self {
        match self.inside() {
            Inside::Node(number) => Self::node(number + nodes),
            Inside::Leaf(number) => Self::leaf(number + leaves),
        }
    }

    #[inline(always)]
    pub(super) fn inside(self) -> Inside {
        let number = (self.0 & !Self::LEAF) as usize;
        if self.0 & Self::LEAF != 0 { Inside::Leaf(number) } else { Inside::Node(number) }
    }
}

impl Node {
    /// Boxes that no ray hits.
    pub(super) const EMPTY: Self = Self {
        sides: [[[f32::INFINITY; WIDTH], [f32::NEG_INFINITY; WIDTH]]; 3],
        children: [Child(0); WIDTH],
    };

    pub(super) fn set(&mut self, slot: usize, min: Vec3, max: Vec3, child: Child) {
        for axis in 0..3 {
            self.sides[axis][0][slot] = min[axis];
            self.sides[axis][1][slot] = max[axis];
        }
        self.children[slot] = child;
    }
}

impl Leaf {
    /// The number of an entry without a triangle.
    pub(super) const NONE: u32 = u32::MAX;

    pub(super) fn new(triangles: impl Iterator<Item = (u32, [Vec3; 3])>) -> Self {
        let mut leaf = Self { corners: [[[f32::NAN; WIDTH]; 3]; 3], numbers: [Self::NONE; WIDTH] };
        for (slot, (number, corners)) in triangles.take(WIDTH).enumerate() {
            leaf.numbers[slot] = number;
            for (of_all, corner) in leaf.corners.iter_mut().zip(corners) {
                for axis in 0..3 {
                    of_all[axis][slot] = corner[axis];
                }
            }
        }
        leaf
    }
}
