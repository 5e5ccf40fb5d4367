//! A mesh of a scene, with data derived from it.

use std::sync::{Arc, Mutex, OnceLock, PoisonError};

use trigon_math::{Bounds3, Vec3};
use trigon_mesh::{ChangeError, ChangedElements, Mesh, MeshChange};

use crate::arena::Id;
use crate::geometry::{Geometry, StillBounds, box_around, made_once, runs_without};

/// Names a mesh.
pub type MeshId = Id<MeshAsset>;

/// A mesh as the scene shares it between nodes.
#[derive(Clone, Debug)]
pub struct MeshAsset {
    /// For people; need not be unique.
    pub name: String,
    mesh: Arc<Mesh>,
    /// Shared by clones, so that none finds out again what another one knows.
    derived: Arc<Derived>,
    /// Spares whoever drags an outermost vertex the search through all others for each change.
    still_bounds: StillBounds,
}

/// What is found out about a mesh when somebody asks for it.
#[derive(Debug, Default)]
struct Derived {
    used: OnceLock<Arc<Vec<bool>>>,
    bounds: OnceLock<Bounds3>,
    geometry: OnceLock<Arc<Geometry>>,
    coarse: OnceLock<CoarseMesh>,
    /// What `geometry` is made of after a change. The lock is held only to take it out.
    outdated: Mutex<Option<Outdated>>,
}

/// A coarser mesh, which drafts show.
#[derive(Debug)]
pub(crate) struct CoarseMesh {
    /// What the geometry is made of.
    pub(crate) mesh: Mesh,
    pub(crate) geometry: Arc<Geometry>,
}

/// What was known before one or several changes.
#[derive(Clone, Debug)]
struct Outdated {
    /// `None` if there was none, or none that can follow.
    geometry: Option<Arc<Geometry>>,
    changed: ChangedElements,
}

impl MeshAsset {
    pub(crate) fn new(name: String, mesh: Mesh) -> Self {
        Self { name, mesh: Arc::new(mesh), derived: Arc::default(), still_bounds: StillBounds::default() }
    }

    pub(crate) fn replace(&mut self, mesh: Mesh) {
        (self.mesh, self.derived) = (Arc::new(mesh), Arc::default());
        self.still_bounds = StillBounds::default();
    }

    /// The polygons.
    #[must_use]
    pub fn mesh(&self) -> &Mesh {
        &self.mesh
    }

    /// The same, to be held on to: another one after [`Scene::replace_mesh`] and
    /// [`Scene::change_mesh`].
    ///
    /// [`Scene::replace_mesh`]: crate::Scene::replace_mesh
    /// [`Scene::change_mesh`]: crate::Scene::change_mesh
    #[must_use]
    pub fn shared_mesh(&self) -> &Arc<Mesh> {
        &self.mesh
    }

    /// The smallest box around the vertices that faces, edges or points use.
    #[must_use]
    pub fn bounds(&self) -> Bounds3 {
        *self.derived.bounds.get_or_init(|| match self.derived.geometry.get() {
            // The same vertices, where they are found faster.
            Some(geometry) if self.has_nothing_loose() => geometry.bounds(),
            _ => self.bounds_of(self.mesh.positions()),
        })
    }

    /// The same with the vertices at other places. Stray vertices of a file must not push
    /// the model out of the image.
    pub(crate) fn bounds_of(&self, positions: &[Vec3]) -> Bounds3 {
        let used = positions.iter().zip(self.used_vertices().iter()).filter(|&(_, &used)| used);
        box_around(used.map(|(point, _)| *point))
    }

    /// Whether it consists of faces alone.
    pub(crate) fn has_nothing_loose(&self) -> bool {
        self.mesh.loose_points().is_empty() && self.mesh.loose_edges().is_empty()
    }

    /// Which vertices faces, edges or points use.
    pub(crate) fn used_vertices(&self) -> &Arc<Vec<bool>> {
        self.derived.used.get_or_init(|| Arc::new(self.mesh.used_vertices()))
    }

    /// What is drawn of it; made, or brought up to date, at the first use.
    pub(crate) fn geometry(&self) -> &Arc<Geometry> {
        let make = || match self.derived.take_outdated() {
            None => Geometry::new(&self.mesh),
            Some(Outdated { geometry: None, .. }) => Geometry::that_follows(&self.mesh),
            Some(Outdated { geometry: Some(before), changed }) => {
                Geometry::after_change(before, &self.mesh, &changed)
            }
        };
        made_once(&self.derived.geometry, || Arc::new(make()))
    }

    /// The number of triangles of all faces: fewer by the faces without area.
    pub(crate) fn triangle_count(&self) -> usize {
        self.mesh.corner_count() - 2 * self.mesh.face_count()
    }

    /// Whether it has no coarser mesh and no pose deforms it.
    pub(crate) fn can_be_coarse(&self) -> bool {
        let attributes = self.mesh.attributes();
        self.coarse().is_none() && attributes.skin.is_none() && attributes.morph_targets.is_empty()
    }

    /// The coarser mesh, if it was made.
    pub(crate) fn coarse(&self) -> Option<&CoarseMesh> {
        self.derived.coarse.get()
    }

    /// Makes the coarser mesh of at most so many triangles for all clones; takes long. Nothing if there are no others.
    pub(crate) fn make_coarse_for_clones(&self, most_triangles: usize) {
        if Arc::strong_count(&self.derived) > 1 {
            made_once(&self.derived.coarse, || {
                let mesh = self.mesh.clustered(most_triangles).mesh;
                CoarseMesh { geometry: Arc::new(Geometry::new(&mesh)), mesh }
            });
        }
    }

    /// See [`Scene::change_mesh`](crate::Scene::change_mesh).
    pub(crate) fn change(&mut self, change: &MeshChange) -> Result<(), ChangeError> {
        change.check(&self.mesh)?;
        let inside = self.bounds_without(change);
        Arc::make_mut(&mut self.mesh).change(change)?;
        let bounds = inside.map(|bounds| self.bounds_with(bounds, change));
        let derived = Arc::make_mut(&mut self.derived);
        derived.bounds = bounds.map_or_else(OnceLock::new, OnceLock::from);
        derived.coarse = OnceLock::new();
        let outdated = derived.take_outdated();
        let mut outdated = outdated.unwrap_or_else(|| Outdated {
            geometry: derived.geometry.take().filter(|geometry| geometry.can_follow()),
            changed: ChangedElements::default(),
        });
        outdated.changed.add(change);
        derived.outdated = Mutex::new(Some(outdated));
        Ok(())
    }

    /// The box around all used vertices but those that are about to move, if it is known.
    fn bounds_without(&mut self, change: &MeshChange) -> Option<Bounds3> {
        let (bounds, used) = (self.derived.bounds.get().copied(), Arc::clone(self.used_vertices()));
        let positions = self.mesh.positions();
        let moved = change.positions.iter().map(|&(vertex, _)| vertex);
        let position = |vertex: u32| used[vertex as usize].then_some(positions[vertex as usize]);
        self.still_bounds.without(bounds, moved, position, |moved| {
            let still = runs_without(positions.len(), moved).flatten();
            box_around(still.filter(|&vertex| used[vertex]).map(|vertex| positions[vertex]))
        })
    }

    /// The box with the vertices that were moved.
    fn bounds_with(&self, bounds: Bounds3, change: &MeshChange) -> Bounds3 {
        let moved = change.positions.iter().map(|&(vertex, _)| vertex as usize);
        let used = moved.filter(|&vertex| self.used_vertices()[vertex]);
        bounds.union(box_around(used.map(|vertex| self.mesh.positions()[vertex])))
    }
}

impl Derived {
    fn take_outdated(&self) -> Option<Outdated> {
        self.outdated.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl Clone for Derived {
    fn clone(&self) -> Self {
        let outdated = self.outdated.lock().unwrap_or_else(PoisonError::into_inner).clone();
        Self {
            used: self.used.clone(),
            bounds: self.bounds.clone(),
            geometry: self.geometry.clone(),
            // Only who is about to change is cloned.
            coarse: OnceLock::new(),
            outdated: Mutex::new(outdated),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::DVec3;
    use trigon_mesh::MeshBuilder;

    /// A triangle, perhaps an edge and a point beside it, and a vertex that nothing uses.
    fn asset(has_edge: bool, has_point: bool) -> MeshAsset {
        let mut builder = MeshBuilder::new();
        for position in
            [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 7.0], [-5.0, 0.0, 0.0], [99.0; 3]]
        {
            builder.push_vertex(Vec3::from_array(position));
        }
        builder.push_face(&[0, 1, 2]).expect("three vertices");
        if has_edge {
            builder.push_loose_edge(0, 3).expect("two vertices");
        }
        if has_point {
            builder.push_loose_point(4).expect("a vertex");
        }
        MeshAsset::new("mesh".to_owned(), builder.build())
    }

    #[test]
    fn bounds_hold_what_is_used_whether_or_not_it_was_drawn_before() {
        for (has_edge, has_point) in [(false, false), (true, false), (false, true), (true, true)] {
            let expected = Bounds3 {
                min: DVec3::new(if has_point { -5.0 } else { 0.0 }, 0.0, 0.0),
                max: DVec3::new(1.0, 2.0, if has_edge { 7.0 } else { 0.0 }),
            };
            for is_drawn in [false, true] {
                let asset = asset(has_edge, has_point);
                if is_drawn {
                    asset.geometry();
                }
                assert_eq!(asset.bounds(), expected, "edge {has_edge}, point {has_point}, drawn {is_drawn}");
            }
        }
    }

    /// As in drags of outermost and other vertices, one after the other, also of the one that nothing uses.
    #[test]
    fn bounds_follow_vertices_that_move_again_and_again() {
        for has_point in [false, true] {
            let mut asset = asset(true, has_point);
            let drags: [&[u32]; 5] = [&[1], &[3, 1], &[5, 0], &[0], &[2, 4]];
            for (drag, vertices) in drags.into_iter().enumerate() {
                for step in [3.0_f32, -4.0, 0.5, 0.25] {
                    let position = |vertex: u32| Vec3::new(step, vertex as f32 - step, step * drag as f32);
                    let positions = vertices.iter().map(|&vertex| (vertex, position(vertex))).collect();
                    asset.change(&MeshChange { positions, ..MeshChange::default() }).expect("they exist");
                    let mut fresh = asset.clone();
                    fresh.replace(asset.mesh().clone());
                    assert_eq!(asset.bounds(), fresh.bounds(), "drag {drag}, step {step}, point {has_point}");
                }
            }
        }
    }
}
