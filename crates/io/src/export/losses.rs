//! What a format cannot hold of a scene, as data.

use trigon_mesh::Mesh;
use trigon_scene::{Node, NodeId, Scene};

use super::gather::node_location;
use super::{ExportOptions, FaceExport, Gathered, Object};
use crate::loss::Loss;

const POLYGONS: &str = "polygons: they are cut into triangles";
const NOT_FINITE: &str = "faces with vertices that are not finite";

/// Which isolated vertices a format can hold.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum HeldPoints {
    All,
    /// Those of a file with nothing else.
    Clouds,
    None,
}

/// What a format can hold besides vertices and faces.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Holds {
    pub(crate) materials: bool,
    pub(crate) normals: bool,
    pub(crate) uvs: bool,
    pub(crate) colors: bool,
    /// Edges without faces.
    pub(crate) edges: bool,
    pub(crate) points: HeldPoints,
    pub(crate) polygons: bool,
    /// Several named objects.
    pub(crate) objects: bool,
}

/// Adds what will not be in the file.
pub(crate) fn add_losses(gathered: &mut Gathered<'_>, holds: &Holds) {
    let scene = gathered.scene;
    add_of_nodes(gathered);
    let mut losses = Vec::new();
    let mut add = |is_lost: bool, what: &str| losses.extend(is_lost.then(|| Loss::of_scene(what)));
    let any = |has: fn(&Object<'_>) -> bool| gathered.objects.iter().any(has);
    add(!holds.materials && scene.materials.iter().next().is_some(), "materials and their textures");
    add(!holds.objects && gathered.objects.len() > 1, "which faces belong to which object: all become one");
    add(
        any(|object| object.node.parent().is_some()),
        "the node tree: objects are written with their transforms applied",
    );
    add(!scene.animations.is_empty(), "animations");
    add(
        any(|object| object.mesh.attributes().skin.is_some()),
        "skins: meshes are written in their rest pose",
    );
    add(any(|object| !object.mesh.attributes().morph_targets.is_empty()), "morph targets");
    add(!holds.normals && any(|object| object.mesh.attributes().corner_normals.is_some()), "normals");
    add(!holds.uvs && any(|object| !object.mesh.attributes().uv_sets.is_empty()), "texture coordinates");
    add(
        holds.uvs && any(|object| object.mesh.attributes().uv_sets.len() > 1),
        "texture coordinates beyond the first set",
    );
    add(!holds.colors && any(|object| object.mesh.attributes().has_colors()), "vertex colours");
    add(!holds.edges && any(|object| !object.mesh.loose_edges().is_empty()), "edges without faces");
    let is_cloud = !any(|object| object.mesh.face_count() > 0 || !object.mesh.loose_edges().is_empty());
    let keeps_points = match holds.points {
        HeldPoints::All => true,
        HeldPoints::Clouds => is_cloud,
        HeldPoints::None => false,
    };
    add(!keeps_points && any(|object| !object.mesh.loose_points().is_empty()), "points");
    add(!holds.polygons && any(|object| has_polygons(object.mesh)), POLYGONS);
    add(any(|object| has_lost_vertices(object.mesh)), NOT_FINITE);
    gathered.losses.append(&mut losses);
}

/// What is missing in a file that holds everything of a scene except polygons.
pub(crate) fn losses_of_whole(scene: &Scene, options: &ExportOptions<'_>) -> Vec<Loss> {
    let is_wanted = |id: NodeId| options.nodes.as_ref().is_none_or(|wanted| wanted.contains(&id));
    let mesh = |node: &Node| scene.meshes().get(node.mesh?).map(|asset| asset.mesh());
    let meshes = || scene.nodes().iter().filter(|(id, _)| is_wanted(*id)).filter_map(|(_, node)| mesh(node));
    let are_cut = options.faces == FaceExport::Polygons && meshes().any(has_polygons);
    let losses = [(are_cut, POLYGONS), (meshes().any(has_lost_vertices), NOT_FINITE)];
    losses.into_iter().filter(|(is_lost, _)| *is_lost).map(|(_, what)| Loss::of_scene(what)).collect()
}

fn has_lost_vertices(mesh: &Mesh) -> bool {
    mesh.positions().iter().any(|position| !position.is_finite())
}

fn has_polygons(mesh: &Mesh) -> bool {
    mesh.corner_count() > 3 * mesh.face_count()
}

fn add_of_nodes(gathered: &mut Gathered<'_>) {
    for (_, node) in gathered.scene.nodes().iter() {
        let parts = [(node.light.is_some(), "its light"), (node.camera.is_some(), "its camera")];
        for (_, what) in parts.iter().filter(|(is_there, _)| *is_there) {
            gathered.losses.push(Loss { location: node_location(node), what: (*what).to_owned() });
        }
    }
}
