//! What a page tells of a model.

use serde::Serialize;
use trigon_io::{Format, Loaded, Warning};
use trigon_mesh::Mesh;
use trigon_scene::Scene;

/// Counts of what is visible, sizes, and what could not be loaded.
#[derive(Serialize)]
pub(crate) struct Facts {
    format: String,
    files: Vec<String>,
    nodes: usize,
    materials: usize,
    textures: usize,
    vertices: usize,
    faces: usize,
    triangles: usize,
    /// Along X, Y and Z.
    size: [f64; 3],
    animations: Vec<AnimationFacts>,
    warnings: Vec<WarningFacts>,
}

#[derive(Serialize)]
struct AnimationFacts {
    name: String,
    /// In seconds.
    duration: f64,
}

#[derive(Serialize)]
struct WarningFacts {
    file: String,
    message: String,
}

impl Facts {
    pub(crate) fn new(loaded: &Loaded) -> Self {
        let scene = &loaded.scene;
        let bounds = scene.tight_bounds();
        let animations = scene.animations.iter();
        let mut facts = Self {
            format: name_of(loaded.format),
            files: loaded.files.iter().map(|file| file.display().to_string()).collect(),
            nodes: scene.nodes().len(),
            materials: scene.materials.len(),
            textures: scene.textures.len(),
            vertices: 0,
            faces: 0,
            triangles: 0,
            size: if bounds.is_empty() { [0.0; 3] } else { (bounds.max - bounds.min).to_array() },
            animations: animations
                .map(|animation| AnimationFacts {
                    name: animation.name.clone(),
                    duration: animation.duration(),
                })
                .collect(),
            warnings: loaded.warnings.iter().map(WarningFacts::new).collect(),
        };
        for mesh in visible_meshes(scene) {
            facts.vertices += mesh.vertex_count();
            facts.faces += mesh.face_count();
            facts.triangles += mesh.triangulation().triangles.len();
        }
        facts
    }
}

impl WarningFacts {
    fn new(warning: &Warning) -> Self {
        Self { file: warning.file.display().to_string(), message: warning.to_string() }
    }
}

/// The name of a format, for people.
fn name_of(format: Format) -> String {
    trigon_io::readers()
        .find(|reader| reader.format == format)
        .map_or_else(String::new, |reader| reader.name.to_owned())
}

/// The mesh of each visible node.
fn visible_meshes(scene: &Scene) -> impl Iterator<Item = &Mesh> {
    let visible = scene.visible_transforms();
    let drawn = scene.nodes().iter().filter(move |(id, _)| visible[id.index()].is_some());
    drawn.filter_map(|(_, node)| scene.meshes().get(node.mesh?)).map(|asset| asset.mesh())
}
