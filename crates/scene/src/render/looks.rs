//! What the draws of one image share: a scene may show a mesh in a material at a million nodes, and only their places
//! differ.

use std::cell::RefCell;
use std::collections::HashMap;
use std::sync::Arc;

use super::record::TriangleRun;
use crate::geometry::{Geometry, Run};
use crate::material::{AlphaMode, Material, MaterialId};
use crate::surface::{BoundMaterial, DrawTriangles, Look, MaterialContext};

/// What a look depends on within one image.
#[derive(PartialEq, Eq, Hash)]
pub(super) struct LookKey {
    /// The address of the geometry, which the image holds.
    geometry: usize,
    first_triangle: usize,
    material: Option<MaterialId>,
    /// The node, where the look depends on it.
    node: Option<u32>,
}

/// A look, and what else all its draws have in common.
#[derive(Clone)]
pub(super) struct SharedLook<'s> {
    pub(super) look: Arc<Look<'s>>,
    /// Of a geometry with all that the look reads.
    pub(super) run: Arc<TriangleRun<'s>>,
    /// Whether a triangle has a single colour.
    pub(super) is_flat: bool,
    pub(super) double_sided: bool,
    pub(super) alpha_mode: AlphaMode,
}

/// The looks of one image, each made once.
#[derive(Default)]
pub(super) struct Looks<'s>(RefCell<HashMap<LookKey, SharedLook<'s>>>);

impl LookKey {
    pub(super) fn new(geometry: &Geometry, run: &Run, material: Option<MaterialId>) -> Self {
        let geometry = std::ptr::from_ref(geometry).addr();
        Self { geometry, first_triangle: run.triangles.start, material, node: None }
    }

    /// That of a look which depends on its node, if one is given.
    pub(super) fn at(self, node: Option<u32>) -> Self {
        Self { node, ..self }
    }
}

impl<'s> SharedLook<'s> {
    /// The look of a run of triangles in a material.
    pub(super) fn new(
        run: TriangleRun<'s>,
        material: &Material,
        bound: BoundMaterial<'s>,
        context: &MaterialContext<'s>,
    ) -> Self {
        let TriangleRun { geometry, ref range, .. } = run;
        let drawn = DrawTriangles {
            columns: &geometry.columns,
            triangles: &geometry.triangles[range.clone()],
            faces: geometry.faces_of(range.clone()),
        };
        let (is_flat, alpha_mode) = (bound.is_flat(), material.alpha_mode);
        let look = Arc::new(Look::new(drawn, bound, context));
        Self { look, run: Arc::new(run), is_flat, double_sided: material.double_sided, alpha_mode }
    }
}

impl<'s> Looks<'s> {
    /// How many there are.
    #[cfg(test)]
    fn len(&self) -> usize {
        self.0.borrow().len()
    }

    /// The look of a key.
    pub(super) fn of(&self, key: LookKey, make: impl FnOnce() -> SharedLook<'s>) -> SharedLook<'s> {
        if let Some(known) = self.0.borrow().get(&key) {
            return known.clone();
        }
        let made = make();
        self.0.borrow_mut().insert(key, made.clone());
        made
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use crate::effects::{Counts, LightingEnvironment};
    use crate::material::Material;
    use crate::node::Node;
    use crate::prepare::PreparedScene;
    use crate::render::compose::Composer;
    use crate::render::record::TriangleDraw;
    use crate::render::wire::VertexLists;
    use crate::scene::Scene;
    use crate::settings::RenderSettings;
    use crate::shapes::Shape;
    use crate::surface::Surface;

    /// A draw held 1.4 kB: a copy of its material, and of all else that draws share.
    #[test]
    fn what_each_of_many_nodes_takes_is_small() {
        let draw = size_of::<TriangleDraw<'_, Surface<'_, true>>>();
        assert_eq!(draw, size_of::<TriangleDraw<'_, Surface<'_, false>>>(), "flat or not");
        assert!(draw <= 200, "a draw: {draw} bytes");
        assert!(size_of::<Option<Shape>>() <= 112, "a shape: {} bytes", size_of::<Option<Shape>>());
        assert!(size_of::<Node>() <= 248, "a node: {} bytes", size_of::<Node>());
    }

    #[test]
    fn nodes_with_the_same_mesh_and_material_share_a_look() {
        let mut scene = Scene::new();
        let mesh = scene.add_mesh("cube", primitives::cube(1.0));
        let other = scene.add_mesh("another cube", primitives::cube(2.0));
        let [red, green] = [(); 2].map(|()| scene.add_material(Material::default()));
        for (mesh, material) in [(mesh, red), (mesh, red), (mesh, green), (other, red), (mesh, red)] {
            scene.add(Node::from_mesh(mesh, material));
        }
        let settings = RenderSettings::new(8, 8);
        let camera = scene.overview(1.0);
        let prepared = PreparedScene::new(&scene, &camera, &settings);
        let (lighting, lists) = (LightingEnvironment::default(), VertexLists::default());
        let composer = Composer::new(&prepared, &settings, &lighting, &lists);
        assert_eq!(composer.draws(&mut Counts::default()).len(), 5, "each is drawn");
        assert_eq!(composer.looks().len(), 3, "two materials on one mesh, and another mesh");
    }
}
