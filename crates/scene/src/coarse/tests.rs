use std::sync::Arc;

use trigon_math::{DVec3, Vec3};
use trigon_mesh::{MeshChange, primitives};

use super::*;
use crate::{
    AmbientOcclusion, ElementSet, FixedBitSet, Frame, Mark, Material, Outline, Outputs, Renderer,
    ShadingModel, Shadows, VertexPoints,
};

/// The triangles that drafts should have.
const MOST: usize = 600;

/// A ring of 4,000 triangles, a small cube, and another ring of the same mesh.
fn scene() -> Scene {
    let mut scene = Scene::new();
    let ring = scene.add_object("ring", primitives::torus(1.0, 0.4, 50, 40), Material::default());
    scene.add_object("cube", primitives::cube(0.3), Material::default());
    let copy = scene.node(ring).expect("it was added").clone();
    scene.add(copy.at(DVec3::new(0.0, 1.5, 0.0)));
    scene
}

fn settings() -> RenderSettings {
    RenderSettings { samples_per_axis: 1, ..RenderSettings::new(48, 36) }
}

/// The image and the draft, and how many triangles the latter has.
fn drawn(scene: &Scene, settings: &RenderSettings) -> (Frame, Frame, u64) {
    let mut renderer = Renderer::new(settings.clone());
    let camera = scene.overview(settings.aspect());
    let whole = renderer.render(scene, &camera).expect("drawn");
    let draft = renderer.render_draft(scene, &camera, None).expect("drawn");
    (whole, Frame::clone(&draft), renderer.stats().primitives)
}

#[test]
fn drafts_show_coarser_meshes_and_other_images_never_do() {
    let scene = scene();
    let (before, draft, count) = drawn(&scene, &settings());
    assert!(before == draft && count == 8_012, "none was made: {count} triangles");
    scene.clone().coarse_mesh_work(MOST).expect("it has many triangles").run();
    assert!(scene.has_coarse_meshes() && scene.coarse_mesh_work(MOST).is_none(), "they are there");
    let (whole, draft, count) = drawn(&scene, &settings());
    assert!(whole == before, "the image is what it was");
    assert!(count > MOST as u64 / 4 && count <= MOST as u64 + 12, "two rings and a cube: {count}");
    let differing = |[a, b]: [&[u8]; 2]| a.iter().zip(b).any(|(a, b)| a.abs_diff(*b) > 40);
    let pixels = whole.color.chunks(4).zip(draft.color.chunks(4));
    let differing = pixels.filter(|&(a, b)| differing([a, b])).count();
    assert!((1..48 * 36 / 20).contains(&differing), "{differing} pixels differ much");
}

/// What is exact comes from the meshes themselves, and so does what is computed once for all images.
#[test]
fn exact_images_have_no_coarser_meshes() {
    let scene = scene();
    scene.coarse_mesh_work(MOST).expect("it has many triangles").run();
    let (ring, _) = scene.nodes().iter().next().expect("it was added");
    let mut elements = ElementSet::default();
    elements.add(ring, FixedBitSet::with_capacity_and_blocks(8, [1 << 7]));
    let faces = Mark { elements: Arc::new(elements), color: Vec3::X, opacity: 1.0, outlined: false };
    let changes: [&dyn Fn(&mut RenderSettings); 10] = [
        &|of| of.outputs.ids = true,
        &|of| of.outputs = Outputs::ALL,
        &|of| of.style = Style::SurfaceWithEdges,
        &|of| of.style = Style::Wireframe,
        &|of| of.style = Style::HiddenLine,
        &|of| of.vertices = Some(VertexPoints::default()),
        &|of| of.marks.faces = vec![faces.clone()],
        &|of| of.effects.outline = Some(Outline { nodes: vec![ring], color: Vec3::X, width: 2 }),
        &|of| of.effects.shadows = Shadows::Maps { resolution: 64 },
        &|of| of.effects.ambient_occlusion = Some(AmbientOcclusion::new(2, 1.0)),
    ];
    for (number, change) in changes.into_iter().enumerate() {
        let mut settings = settings();
        change(&mut settings);
        let (whole, draft, _) = drawn(&scene, &settings);
        assert!(whole == draft, "image {number}");
    }
    let depth = Outputs { depth: true, ..Outputs::default() };
    let (whole, draft, _) = drawn(&scene, &RenderSettings { outputs: depth, ..settings() });
    assert!(whole.depth.is_some() && whole.depth != draft.depth, "depth is that of what is shown");
}

#[test]
fn a_changed_mesh_loses_its_coarser_one() {
    let mut scene = scene();
    let other = scene.clone();
    scene.coarse_mesh_work(MOST).expect("it has many triangles").run();
    let (id, _) = scene.meshes().iter().next().expect("it was added");
    let change = MeshChange { positions: vec![(0, Vec3::ONE)], ..MeshChange::default() };
    scene.change_mesh(id, &change).expect("it exists");
    assert!(!scene.has_coarse_meshes() && other.has_coarse_meshes(), "the clone has the old mesh");
    let (whole, draft, _) = drawn(&scene, &settings());
    assert!(whole == draft, "until there is another one");
    scene.clone().coarse_mesh_work(MOST).expect("it lacks one").run();
    let (_, draft, _) = drawn(&scene, &settings());
    assert!(whole != draft, "that of the changed mesh");
}

/// Light at vertices needs normals that flat meshes do not have: they were those of the mesh itself.
#[test]
fn coarser_meshes_have_normals_and_tangents_of_their_own() {
    let mut mesh = primitives::uv_sphere(1.0, 60, 40);
    let mut attributes = mesh.attributes().clone();
    (attributes.corner_normals, attributes.face_smooth) = (None, None);
    mesh.set_attributes(attributes).expect("fewer");
    let mut scene = Scene::new();
    scene.add_object("ball", mesh, Material::default());
    scene.clone().coarse_mesh_work(MOST).expect("it has many triangles").run();
    let gouraud = RenderSettings { shading: ShadingModel::Gouraud, ..settings() };
    let (whole, draft, count) = drawn(&scene, &gouraud);
    assert!(count <= MOST as u64, "{count} triangles");
    let covered = |frame: &Frame| frame.color.chunks(4).filter(|pixel| pixel[0] > 180).count();
    let [whole, draft] = [covered(&whole), covered(&draft)];
    assert!(draft > whole * 3 / 4 && draft < whole * 5 / 4, "{draft} bright pixels for {whole}");
}

#[test]
fn few_triangles_stay_as_they_are() {
    let scene = scene();
    assert!(scene.coarse_mesh_work(4_006).is_none(), "8,012 are not more than twice as many");
    assert!(scene.coarse_mesh_work(4_005).is_some(), "the mesh counts once for each node");
    let mut hidden = scene.clone();
    let nodes: Vec<_> = hidden.nodes().iter().map(|(id, _)| id).collect();
    hidden.node_mut(nodes[0]).expect("it exists").visible = false;
    assert!(hidden.coarse_mesh_work(2_006).is_none(), "what is hidden does not count");
    assert!(Scene::new().coarse_mesh_work(0).is_none(), "nothing");
}
