//! Turns a scene to another up axis.

use trigon_camera::UpAxis;
use trigon_math::DAffine3;

use super::{NodeId, Scene};
use crate::node::Node;
use crate::transform::Transform;

impl Scene {
    /// Turns everything so that another axis points up; what is on the right and in front stays there. All roots
    /// get a new node as their parent, which holds the rotation and is named after the old axis; nothing else
    /// changes. Between the six axes of the world the rotation is exact: coordinates are exchanged and negated.
    ///
    /// Returns the new node, or `None` if the axis is up already or there are no nodes.
    ///
    /// ```
    /// use trigon_scene::camera::UpAxis;
    /// use trigon_scene::math::DVec3;
    /// use trigon_scene::{Node, Scene};
    ///
    /// let mut scene = Scene::new();
    /// scene.up = UpAxis::Z;
    /// let top = scene.add(Node::default().at(DVec3::new(1.0, 2.0, 3.0)));
    /// let turned = scene.turn_to(UpAxis::Y).expect("it was turned");
    /// assert_eq!(scene.node(turned).map(|node| node.name.as_str()), Some("+Z up"));
    /// assert_eq!(scene.world_transform(top).translation, DVec3::new(1.0, 3.0, -2.0));
    /// ```
    pub fn turn_to(&mut self, up: UpAxis) -> Option<NodeId> {
        let before = std::mem::replace(&mut self.up, up);
        let roots: Vec<NodeId> = self.roots().collect();
        if before == up || roots.is_empty() {
            return None;
        }
        let turn = Transform::Affine(DAffine3::from_mat3(before.turn_to(up)));
        let id = self.add(Node::default().with_name(format!("{before} up")).with_transform(turn));
        for &root in &roots {
            self.nodes.get_mut(root)?.parent = Some(id);
        }
        self.nodes.get_mut(id)?.children = roots;
        Some(id)
    }
}

#[cfg(test)]
mod tests {
    use trigon_math::DVec3;

    use super::*;

    #[test]
    fn a_scene_is_turned_with_all_that_hangs_on_its_roots() {
        let mut scene = Scene { up: UpAxis::new(DVec3::NEG_X), ..Scene::new() };
        let first = scene.add(Node::default().at(DVec3::new(1.0, 2.0, 3.0)));
        let child = scene.add_child(first, Node::default().at(DVec3::X)).expect("its parent is there");
        let second = scene.add(Node::default());
        scene.order_roots(vec![second]);
        let turned = scene.turn_to(UpAxis::Z).expect("another axis");
        // -X becomes Z, +Y (right) becomes X, and +Z (front) becomes -Y.
        assert_eq!(scene.world_transform(first).translation, DVec3::new(2.0, -3.0, -1.0));
        assert_eq!(scene.world_transform(child).translation, DVec3::new(2.0, -3.0, -2.0));
        assert_eq!(scene.roots().collect::<Vec<_>>(), [turned]);
        assert_eq!(scene.node(turned).map(Node::children), Some(&[second, first][..]), "in their order");
        assert_eq!(scene.up, UpAxis::Z);
        assert_eq!(scene.turn_to(UpAxis::Z), None, "nothing is left to do");
    }

    #[test]
    fn an_empty_scene_gets_no_node() {
        let mut scene = Scene { up: UpAxis::Z, ..Scene::new() };
        assert_eq!((scene.turn_to(UpAxis::Y), scene.up), (None, UpAxis::Y));
        assert!(scene.nodes().is_empty(), "still empty");
    }
}
