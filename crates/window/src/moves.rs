//! Records how objects were moved by hand, for undo and redo.

use std::collections::BTreeMap;

use trigon_scene::{NodeId, Scene, Transform};

use crate::shared_scene::SharedScene;

/// So many moves are remembered; the oldest are forgotten first.
const MOST: usize = 1000;

/// An object that was moved from one place to another.
#[derive(Debug, Clone, PartialEq)]
struct Move {
    node: NodeId,
    before: Transform,
    after: Transform,
}

/// All moves, the last one last.
#[derive(Debug, Default)]
pub(crate) struct Moves {
    done: Vec<Move>,
    /// The one undone last is the last one.
    undone: Vec<Move>,
    /// What is being moved, and where it was before.
    under_way: Option<(NodeId, Transform)>,
}

impl Moves {
    /// The objects that are not where they were.
    pub(crate) fn moved(&self) -> Vec<NodeId> {
        let nodes = self.done.iter().map(|done| done.node);
        let nodes = nodes.chain(self.under_way.as_ref().map(|(node, _)| *node));
        let distinct: BTreeMap<usize, NodeId> = nodes.map(|node| (node.index(), node)).collect();
        distinct.into_values().collect()
    }

    /// The object is about to be moved; one that is being moved goes on.
    pub(crate) fn begin(&mut self, scene: &Scene, object: Option<NodeId>) {
        if self.under_way.as_ref().map(|(node, _)| *node) == object {
            return;
        }
        self.end(scene);
        let moved = object.and_then(|id| Some((id, scene.node(id)?.transform)));
        self.under_way = moved;
    }

    /// What was being moved stays where it is.
    pub(crate) fn end(&mut self, scene: &Scene) {
        let Some((node, before)) = self.under_way.take() else { return };
        let Some(after) = scene.node(node).map(|node| node.transform) else { return };
        if before == after {
            return;
        }
        self.undone.clear();
        self.done.push(Move { node, before, after });
        let extra = self.done.len().saturating_sub(MOST);
        self.done.drain(..extra);
    }

    /// Puts back what was moved last, and says what it was.
    pub(crate) fn undo(&mut self, scene: &mut SharedScene) -> Option<NodeId> {
        self.end(scene);
        let last = self.done.pop()?;
        put(scene, last.node, last.before);
        let node = last.node;
        self.undone.push(last);
        Some(node)
    }

    /// Moves what was put back last, and says what it was.
    pub(crate) fn redo(&mut self, scene: &mut SharedScene) -> Option<NodeId> {
        self.end(scene);
        let last = self.undone.pop()?;
        put(scene, last.node, last.after);
        let node = last.node;
        self.done.push(last);
        Some(node)
    }
}

/// An object that was removed meanwhile has no place.
fn put(scene: &mut SharedScene, node: NodeId, transform: Transform) {
    if let Some(node) = scene.node_mut(node) {
        node.transform = transform;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::DVec3;
    use trigon_mesh::primitives;
    use trigon_scene::Material;

    /// Moves an object by one hand.
    fn shift(moves: &mut Moves, scene: &mut SharedScene, object: NodeId, steps: u32) {
        for _ in 0..steps {
            moves.begin(scene, Some(object));
            scene.node_mut(object).expect("it is there").transform.translate(DVec3::X);
        }
        moves.end(scene);
    }

    fn at(scene: &SharedScene, object: NodeId) -> f64 {
        scene.node(object).expect("it is there").transform.translation().x
    }

    #[test]
    fn moves_go_back_and_forth_one_at_a_time() {
        let (mut moves, mut scene) = (Moves::default(), SharedScene::default());
        let [one, other] =
            ["one", "other"].map(|name| scene.add_object(name, primitives::cube(1.0), Material::default()));
        shift(&mut moves, &mut scene, one, 3);
        shift(&mut moves, &mut scene, other, 2);
        shift(&mut moves, &mut scene, one, 1);
        assert_eq!(moves.moved().len(), 2, "two objects");
        assert_eq!(moves.undo(&mut scene), Some(one), "the last move");
        assert_eq!((at(&scene, one), at(&scene, other)), (3.0, 2.0), "and no more of it");
        assert_eq!(moves.undo(&mut scene), Some(other), "then the one before");
        assert_eq!(moves.moved().len(), 1, "which is where it was");
        assert_eq!(moves.redo(&mut scene), Some(other), "there again");
        assert_eq!(at(&scene, other), 2.0, "all of it");
        shift(&mut moves, &mut scene, one, 1);
        assert_eq!(moves.redo(&mut scene), None, "another move took the place of what was undone");
        while moves.undo(&mut scene).is_some() {}
        assert_eq!((at(&scene, one), at(&scene, other), moves.moved().len()), (0.0, 0.0, 0), "as it was");
    }

    #[test]
    fn what_did_not_move_is_no_move_and_what_is_gone_does_no_harm() {
        let (mut moves, mut scene) = (Moves::default(), SharedScene::default());
        let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
        shift(&mut moves, &mut scene, cube, 0);
        moves.begin(&scene, Some(cube));
        moves.end(&scene);
        assert_eq!(moves.undo(&mut scene), None, "nothing was moved");
        shift(&mut moves, &mut scene, cube, 1);
        scene.remove(cube);
        assert_eq!(moves.undo(&mut scene), Some(cube), "it is undone");
        assert!(scene.node(cube).is_none(), "and stays gone");
    }
}
