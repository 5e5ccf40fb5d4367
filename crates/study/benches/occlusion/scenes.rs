//! The scenes whose ambient occlusion is measured.

use trigon_camera::Camera;
use trigon_io::{LoadError, LoadOptions, load};
use trigon_math::{DVec3, Vec3};
use trigon_mesh::primitives::{self, TorusKnot};
use trigon_scene::{Light, Material, Node, NodeId, Scene, Shading, Transform, showcase};

/// A scene, and how it is looked at.
#[derive(Clone)]
pub(crate) struct Subject {
    pub(crate) name: String,
    pub(crate) scene: Scene,
    pub(crate) camera: Camera,
    /// How far surfaces occlude.
    pub(crate) distance: f64,
}

/// The built-in subjects, or those of files.
pub(crate) fn all(files: &[String]) -> Result<Vec<Subject>, LoadError> {
    if files.is_empty() {
        return Ok(vec![exhibition(), boxes(), knots()]);
    }
    files.iter().map(|file| Ok(Subject::whole(file, load(file, &LoadOptions::default())?.scene))).collect()
}

impl Subject {
    /// Seen as a whole. Surfaces occlude within a seventh of its diagonal.
    fn whole(name: &str, scene: Scene) -> Self {
        let (camera, diagonal) = (scene.overview(1.6), scene.bounds().size().length());
        Self { name: name.to_owned(), scene, camera, distance: diagonal / 7.0 }
    }

    /// The same of white matt surfaces, in light from all around.
    pub(crate) fn in_white(&self) -> Self {
        let mut white = self.clone();
        for (_, material) in white.scene.materials.iter_mut() {
            let plain = Material::from_color(Vec3::ONE);
            *material = Material { shading: Shading::Lambert, double_sided: true, ..plain };
        }
        white.in_light(Node::from_light(Light::ambient(1.0)))
    }

    /// The same in another light alone.
    pub(crate) fn in_light(&self, light: Node) -> Self {
        let mut other = self.clone();
        let lit = other.scene.nodes().iter().filter(|(_, node)| node.light.is_some());
        let lit: Vec<NodeId> = lit.map(|(id, _)| id).collect();
        for id in lit {
            other.scene.node_mut(id).expect("it was just there").light = None;
        }
        other.scene.add(light);
        other
    }

    /// All triangles, in the world.
    pub(crate) fn triangles(&self) -> Vec<[DVec3; 3]> {
        let mut triangles = Vec::new();
        for (id, node) in self.scene.nodes().iter() {
            let Some(asset) = node.mesh.and_then(|mesh| self.scene.meshes().get(mesh)) else { continue };
            let (world, mesh) = (self.scene.world_transform(id), asset.mesh());
            let corner = |corner: u32| {
                let vertex = mesh.corner_vertices()[corner as usize] as usize;
                world.transform_point3(mesh.positions()[vertex].as_dvec3())
            };
            triangles.extend(mesh.triangulation().triangles.iter().map(|corners| corners.map(corner)));
        }
        triangles
    }
}

/// The built-in scene.
fn exhibition() -> Subject {
    let scene = showcase();
    let camera = scene.cameras()[0].1;
    Subject { name: "exhibition".to_owned(), scene, camera, distance: 1.0 }
}

fn place(scene: &mut Scene, node: NodeId, at: DVec3) {
    scene.node_mut(node).expect("just added").transform = Transform::from_translation(at);
}

/// Thirty boxes of four sizes on a floor.
fn boxes() -> Subject {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(12.0, 12.0), Material::default());
    for number in 0..30_u8 {
        let side = 0.5 + f64::from(number % 4) * 0.15;
        let cube = scene.add_object("box", primitives::cube(side as f32), Material::default());
        let [column, row] = [number % 6, number / 6].map(|step| f64::from(step) * 1.1 - 3.0);
        place(&mut scene, cube, DVec3::new(column, side / 2.0, row));
    }
    Subject { distance: 1.0, ..Subject::whole("boxes", scene) }
}

/// Three knots of thin tubes above a floor.
fn knots() -> Subject {
    let mut scene = Scene::new();
    scene.add_object("floor", primitives::plane(8.0, 8.0), Material::default());
    for number in 0..3_u8 {
        let mesh = primitives::torus_knot(&TorusKnot::default());
        let knot = scene.add_object("knot", mesh, Material::default());
        place(&mut scene, knot, DVec3::new(f64::from(number) * 2.2 - 2.2, 1.2, 0.0));
    }
    Subject { distance: 1.0, ..Subject::whole("knots", scene) }
}
