//! Scenes elsewhere that follow a scene.

use proptest::prelude::*;
use trigon_scene::math::Vec3;
use trigon_scene::mesh::{MeshChange, primitives};
use trigon_scene::{Material, Node};

use super::*;

/// A scene with one mesh.
fn with_cube() -> (SharedScene, MeshId) {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    let (id, _) = scene.meshes().iter().next().expect("it was added");
    (scene.into(), id)
}

fn moved(vertex: u32, to: f32) -> MeshChange {
    MeshChange { positions: vec![(vertex, Vec3::splat(to))], ..MeshChange::default() }
}

/// A scene elsewhere.
#[derive(Default)]
struct Elsewhere {
    held: Option<Revision>,
    scene: Scene,
}

impl Elsewhere {
    /// Whether only meshes were reported to it.
    fn update(&mut self, from: &mut SharedScene) -> bool {
        let update = from.update(&mut self.held);
        let of_meshes = matches!(update, SceneUpdate::Meshes(_));
        update.apply(&mut self.scene);
        of_meshes
    }
}

fn positions(scene: &Scene) -> Vec<&[Vec3]> {
    scene.meshes().iter().map(|(_, asset)| asset.mesh().positions()).collect()
}

#[test]
fn what_is_drawn_stays_and_what_is_changed_is_known() {
    let mut scene = SharedScene::default();
    scene.add(Node::default());
    let (mut drawn, before) = (Elsewhere::default(), scene.revision());
    drawn.update(&mut scene);
    assert_eq!(scene.nodes().len(), 1, "looking changes nothing");
    assert_eq!(scene.revision(), before, "and is not taken for a change");
    scene.add(Node::default());
    assert_eq!(
        (drawn.scene.nodes().len(), scene.nodes().len()),
        (1, 2),
        "the image under way is of one node"
    );
    assert_ne!(scene.revision(), before, "the next one has to be drawn");
    assert_ne!(
        SharedScene::default().revision(),
        SharedScene::default().revision(),
        "another scene is another"
    );
}

#[test]
fn each_holder_copies_a_mesh_once() {
    let (mut scene, id) = with_cube();
    let mut holders = [Elsewhere::default(), Elsewhere::default()];
    for holder in &mut holders {
        assert!(!holder.update(&mut scene), "all of it at first");
    }
    let addresses = |scene: &SharedScene, holders: &[Elsewhere; 2]| {
        let scenes = [&**scene, &holders[0].scene, &holders[1].scene];
        scenes.map(|scene| positions(scene)[0].as_ptr())
    };
    let shared = addresses(&scene, &holders);
    assert!(shared.iter().all(|&address| address == shared[0]), "one mesh for all");
    let mut owned = None;
    for step in 1..5 {
        scene.change_mesh(id, &moved(3, step as f32)).expect("a vertex of the cube");
        for holder in &mut holders {
            assert!(holder.update(&mut scene), "values alone");
        }
        let now = addresses(&scene, &holders);
        assert!(now[0] != now[1] && now[1] != now[2] && now[0] != now[2], "each has its own");
        assert_eq!(*owned.get_or_insert(now), now, "which it keeps");
    }
}

#[test]
fn a_change_that_is_refused_is_told_to_nobody() {
    let (mut scene, id) = with_cube();
    let (mut holder, before) = (Elsewhere::default(), scene.revision());
    holder.update(&mut scene);
    assert!(scene.change_mesh(id, &moved(8, 1.0)).is_err(), "a cube has 8 vertices");
    assert_eq!(scene.revision(), before, "there is nothing to be drawn");
    assert!(holder.update(&mut scene), "and nothing to be told");
}

/// What may happen to two scenes, one of which is shown, and to two holders.
#[derive(Clone, Debug)]
enum Step {
    Move(u32, f32),
    /// By mutable access.
    Add,
    Update(usize),
    /// Shows the other scene.
    Swap,
    /// Puts a clone in the place of the other scene.
    Clone,
}

fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        4 => (0..8_u32, 0.0_f32..9.0).prop_map(|(vertex, to)| Step::Move(vertex, to)),
        1 => Just(Step::Add),
        4 => (0..2_usize).prop_map(Step::Update),
        1 => Just(Step::Swap),
        1 => Just(Step::Clone),
    ]
}

proptest! {
    #[test]
    fn holders_have_the_scene_that_is_shown(steps in prop::collection::vec(step(), 1..40)) {
        let ((mut shown, id), (mut other, _)) = (with_cube(), with_cube());
        let mut holders = [Elsewhere::default(), Elsewhere::default()];
        for step in steps {
            match step {
                Step::Move(vertex, to) => shown.change_mesh(id, &moved(vertex, to)).expect("a cube"),
                Step::Add => drop(shown.add(Node::default())),
                Step::Swap => std::mem::swap(&mut shown, &mut other),
                Step::Clone => other = shown.clone(),
                Step::Update(holder) => {
                    let holder = &mut holders[holder];
                    holder.update(&mut shown);
                    prop_assert_eq!(positions(&holder.scene), positions(&shown), "meshes");
                    prop_assert_eq!(holder.scene.nodes().len(), shown.nodes().len(), "nodes");
                }
            }
        }
    }
}
