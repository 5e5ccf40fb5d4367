//! The last step of a bevel: marks its rims, and sets normals with which the old faces look as before.

use trigon_math::Vec3;

use super::laid::Laid;
use super::settings::BevelSettings;
use super::shape::Blueprint;
use crate::column::Column;
use crate::edit_mesh::EditMesh;
use crate::ids::{CornerId, EdgeId, FaceId, NONE};
use crate::layers::{Layer, LayerKind, LayerValues};
use crate::records::{SEAM, SHARP};

/// What is to be done, as found before the mesh changes.
pub(super) struct Finish {
    /// Marks for both rims of each beveled edge.
    flags: u32,
    /// With hardened normals: those of all corners around beveled edges, in ascending order of corners.
    normals: Option<Vec<(CornerId, Vec3)>>,
}

impl EditMesh {
    /// Reads what is needed while the old corners are there.
    pub(super) fn plan_bevel_finish(
        &mut self,
        laid: &Laid,
        edges: &[EdgeId],
        settings: &BevelSettings,
    ) -> Finish {
        let flags = if settings.mark_sharp { SHARP } else { 0 } | if settings.mark_seams { SEAM } else { 0 };
        let hardens = settings.harden_normals && !edges.is_empty();
        Finish { flags, normals: hardens.then(|| self.normals_beside_bevel(laid, edges)) }
    }

    /// The normals of the corners around beveled edges, as if these were sharp.
    fn normals_beside_bevel(&mut self, laid: &Laid, edges: &[EdgeId]) -> Vec<(CornerId, Vec3)> {
        let were_sharp: Vec<bool> = edges.iter().map(|&edge| self.is_sharp(edge)).collect();
        edges.iter().for_each(|&edge| self.set_sharp(edge, true));
        let vertices: Vec<_> = laid.rounds.iter().map(|round| round.fan.vertex).collect();
        let mut normals = self.fan_normals_at(&vertices);
        for (&edge, was_sharp) in edges.iter().zip(were_sharp) {
            self.set_sharp(edge, was_sharp);
        }
        normals.sort_unstable_by_key(|&(corner, _)| corner);
        normals
    }

    /// Marks both rims of each beveled edge.
    pub(super) fn mark_bevel_rims(&mut self, finish: &Finish, rims: &[EdgeId]) {
        if finish.flags != 0 {
            rims.iter().for_each(|rim| self.edges.write(rim.0).flags |= finish.flags);
        }
    }

    /// Gives the corners at the rims the normals of the old faces; the other new ones stay computed.
    pub(super) fn harden_bevel_normals(
        &mut self,
        finish: &Finish,
        plan: &Blueprint,
        faces: &[FaceId],
        made: &[CornerId],
    ) {
        let Some(normals) = &finish.normals else { return };
        self.add_normals();
        faces.iter().for_each(|&face| self.set_smooth(face, true));
        let of = |corner: CornerId| {
            let index = normals.binary_search_by_key(&corner, |&(corner, _)| corner);
            index.map_or(Vec3::ZERO, |index| normals[index].1)
        };
        for moved in &plan.laid.moves {
            self.set_custom_normal(moved.corner, of(moved.corner));
        }
        for (&corner, new) in made.iter().zip(&plan.corners) {
            let normal = if new.beside.0 == NONE { Vec3::ZERO } else { of(new.beside) };
            self.set_custom_normal(corner, normal);
        }
    }

    /// Lets corners have given normals; none has one yet.
    fn add_normals(&mut self) {
        if !self.corner_layers.iter().any(|layer| layer.kind == LayerKind::Normal) {
            let values = LayerValues::Vec3(Column::new(vec![Vec3::ZERO; self.corner_capacity()]));
            self.corner_layers.push(Layer { kind: LayerKind::Normal, values });
        }
    }
}
