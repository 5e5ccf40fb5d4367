//! Coarser meshes for drafts, which show while something moves, of scenes with very many triangles.
//!
//! A draft cannot skip triangles by becoming smaller: each is still transformed and tested. So whoever draws drafts has
//! coarser meshes made beforehand, by [vertex clustering](crate::mesh::Mesh::clustered). They belong to the mesh assets,
//! which clones of a scene share, until the mesh changes. Only [`Renderer::render_draft`](crate::Renderer::render_draft)
//! draws them.

use std::collections::BTreeSet;

use crate::mesh_asset::{MeshAsset, MeshId};
use crate::prepare::is_visible_from_elsewhere;
use crate::scene::Scene;
use crate::settings::{RenderSettings, Style};

/// Meshes of fewer triangles have no coarser one: drawing thousands of them takes long for other reasons.
const FEW: usize = if cfg!(test) { 1 << 6 } else { 1 << 12 };

/// Coarser meshes that are to be made; see [`Scene::coarse_mesh_work`].
#[derive(Debug)]
pub struct CoarseMeshWork(Vec<WorkItem>);

#[derive(Debug)]
struct WorkItem {
    asset: MeshAsset,
    most_triangles: usize,
}

impl Scene {
    /// The coarser meshes that drafts of the scene should have and do not have yet. `None` if its visible nodes have
    /// no more than twice `most_triangles` triangles together, counted once for each node: drawing half of them is hardly
    /// worth the memory. Otherwise all meshes of 4,096 triangles or more become coarser by the same factor, so that
    /// there are at most about so many. Meshes that poses deform stay as they are.
    #[must_use]
    pub fn coarse_mesh_work(&self, most_triangles: usize) -> Option<CoarseMeshWork> {
        let placements = self.visible_placements();
        let visible = self.nodes().iter().filter(|(id, _)| placements[id.index()].is_some());
        let meshes: Vec<_> = visible.filter_map(|(_, node)| node.mesh).collect();
        let count = |id: &MeshId| self.meshes().get(*id).map_or(0, MeshAsset::triangle_count);
        let all: usize = meshes.iter().map(count).sum();
        if all / 2 <= most_triangles {
            return None;
        }
        let meshes: BTreeSet<MeshId> = meshes.into_iter().collect();
        let assets = meshes.into_iter().filter_map(|id| self.meshes().get(id));
        let lacking = assets.filter(|asset| asset.triangle_count() >= FEW && asset.can_be_coarse());
        let of = |asset: &MeshAsset| {
            let share = asset.triangle_count() as u128 * most_triangles as u128 / all as u128;
            WorkItem { asset: asset.clone(), most_triangles: (share as usize).max(FEW / 16) }
        };
        let work: Vec<_> = lacking.map(of).collect();
        (!work.is_empty()).then_some(CoarseMeshWork(work))
    }

    /// Whether a mesh has a coarser one.
    #[must_use]
    pub fn has_coarse_meshes(&self) -> bool {
        self.meshes().iter().any(|(_, asset)| asset.coarse().is_some())
    }

    /// Whether drafts with these settings may show coarser meshes. Not if they show edges, vertices, marked elements or
    /// outlines, or have ids or other outputs of triangles: all these are exact. Nor with shadows or rays: what is computed
    /// for these is computed once for all images, of the meshes themselves.
    #[must_use]
    pub fn allows_coarse_meshes(&self, settings: &RenderSettings) -> bool {
        let RenderSettings { style, vertices, marks, outputs, effects, .. } = settings;
        let is_exact = outputs.ids || outputs.of_triangles() || effects.outline.is_some();
        let is_surface = *style == Style::Surface && vertices.is_none() && marks.is_plain();
        is_surface && !is_exact && !is_visible_from_elsewhere(self, settings)
    }
}

impl CoarseMeshWork {
    /// Makes them, on the calling thread; a mesh of a million triangles takes tenths of a second. All clones of the scene
    /// have them afterwards. Meshes that no scene has any longer are left out.
    pub fn run(self) {
        for WorkItem { asset, most_triangles } in self.0 {
            asset.make_coarse_for_clones(most_triangles);
        }
    }
}

#[cfg(test)]
mod tests;
