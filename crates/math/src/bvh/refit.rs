//! The tree of triangles that have moved.

use glam::Vec3;
use rayon::iter::{IntoParallelRefIterator, IntoParallelRefMutIterator, ParallelIterator};

use super::Bvh;
use super::extent::Extent;
use super::wide::{Child, Inside, Leaf, Node, WIDTH};

/// How many times as long rays may be expected to take after triangles have moved. With more it pays to build the tree anew.
const MOST_COST: f32 = 1.5;

impl Bvh {
    /// The tree of the same triangles at other positions, with the same boxes around them, in a fraction of the time in which
    /// one is built; rays get the same answers. `None` if triangles came or went (those that are not finite do not count),
    /// or if they have moved so far apart that rays would take much longer than in a new tree.
    #[must_use]
    pub fn refit(mut self, triangles: &[[Vec3; 3]]) -> Option<Self> {
        let is_usable = |corners: &[Vec3; 3]| corners.iter().all(|corner| corner.is_finite());
        let is_same = self
            .leaves
            .par_iter()
            .flat_map_iter(|leaf| &leaf.numbers)
            .all(|&number| number == Leaf::NONE || triangles.get(number as usize).is_some_and(is_usable));
        if !is_same || triangles.iter().filter(|corners| is_usable(corners)).count() != self.len {
            return None;
        }
        let move_leaf = |leaf: &mut Leaf| {
            let count = leaf.numbers.iter().filter(|&&number| number != Leaf::NONE).count();
            let numbered = leaf.numbers[..count].iter().map(|&number| (number, triangles[number as usize]));
            *leaf = Leaf::new(numbered);
        };
        self.leaves.par_iter_mut().for_each(move_leaf);
        self.refit_nodes();
        let extent = self.extent_of(self.root);
        self.extent = if self.len == 0 { [Vec3::ZERO; 2] } else { [extent.min, extent.max] };
        (self.expected_cost() <= self.cost * MOST_COST).then_some(self)
    }

    /// Children lie before their parents.
    fn refit_nodes(&mut self) {
        for number in 0..self.nodes.len() {
            let mut node = self.nodes[number];
            for slot in 0..node.count() {
                let extent = self.extent_of(node.children[slot]);
                node.set(slot, extent.min, extent.max, node.children[slot]);
            }
            self.nodes[number] = node;
        }
    }

    fn extent_of(&self, child: Child) -> Extent {
        match child.inside() {
            Inside::Node(number) => self.nodes[number].extent(),
            Inside::Leaf(number) => self.leaves[number].extent(),
        }
    }

    /// The boxes that a ray through the tree is expected to enter: the sum of their areas, by the area of the whole.
    pub(super) fn expected_cost(&self) -> f32 {
        let [min, max] = self.extent;
        let areas: f64 = self.nodes.iter().map(|node| f64::from(node.half_areas())).sum();
        let whole = f64::from(Extent { min, max }.half_area());
        if whole > 0.0 { (areas / whole) as f32 } else { 0.0 }
    }
}

impl Node {
    /// The boxes in use; they come first.
    fn count(&self) -> usize {
        self.sides[0][0].iter().filter(|low| **low < f32::INFINITY).count()
    }

    fn extents(&self) -> impl Iterator<Item = Extent> {
        let corner =
            |side: usize, slot: usize| Vec3::from([0, 1, 2].map(|axis| self.sides[axis][side][slot]));
        (0..self.count()).map(move |slot| Extent { min: corner(0, slot), max: corner(1, slot) })
    }

    fn extent(&self) -> Extent {
        self.extents().fold(Extent::EMPTY, |mut whole, extent| {
            whole.add(extent.min, extent.max);
            whole
        })
    }

    fn half_areas(&self) -> f32 {
        self.extents().map(|extent| extent.half_area()).sum()
    }
}

impl Leaf {
    fn extent(&self) -> Extent {
        let mut extent = Extent::EMPTY;
        for slot in (0..WIDTH).filter(|&slot| self.numbers[slot] != Self::NONE) {
            for corner in &self.corners {
                let corner = Vec3::new(corner[0][slot], corner[1][slot], corner[2][slot]);
                extent.add(corner, corner);
            }
        }
        extent
    }
}
