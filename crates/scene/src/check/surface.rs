//! Checks of faces and how they join: inside out, inconsistent winding, non-manifold, without area,
//! with normals that point inwards.

use trigon_math::{DVec3, Vec3};
use trigon_mesh::{Mesh, Surface};

use super::{Finding, Severity, counted, locate};
use crate::scene::Scene;

/// From this number of faces on, a fraction without area counts as a fault.
const SHARE_WITHOUT_AREA: f64 = 0.05;

/// Edges of one face.
pub(super) const OPEN_EDGES: &str = "open-edges";

/// Edges of two faces that run along them in the same direction.
pub(super) const MIXED_WINDING: &str = "mixed-winding";

/// Edges of three faces or more.
pub(super) const NON_MANIFOLD: &str = "non-manifold";

pub(super) fn check(scene: &Scene, findings: &mut Vec<Finding>) {
    for (id, asset) in scene.meshes().iter() {
        let mesh = asset.mesh();
        if mesh.face_count() == 0 {
            continue;
        }
        let location = locate("mesh", &asset.name, id.index());
        joins(mesh, &location, findings);
        without_area(mesh, &location, findings);
        normals(mesh, &location, findings);
    }
}

/// How its faces join.
fn joins(mesh: &Mesh, location: &str, findings: &mut Vec<Finding>) {
    let Surface { open_edges, turned_edges, non_manifold_edges, volume, .. } = mesh.surface();
    let mut found = |severity, fault, what: String, remedy| {
        findings.push(Finding { severity, fault, location: location.to_owned(), what, remedy });
    };
    if volume < 0.0 {
        let remedy = "flip its faces (in Blender: Mesh, Normals, Recalculate Outside)";
        found(Severity::Error, "inside-out", "its faces point inwards".to_owned(), remedy);
    }
    let faces = counted(mesh.face_count(), "face");
    if let Some(at) = first(mesh, &turned_edges) {
        let edges = counted(turned_edges.len(), "edge");
        let what = format!("its faces are turned against each other along {edges} (of {faces}), {at}");
        let remedy = "make them face the same way (in Blender: Mesh, Normals, Recalculate Outside)";
        found(Severity::Warning, MIXED_WINDING, what, remedy);
    }
    if let Some(at) = first(mesh, &non_manifold_edges) {
        let what = format!("three faces or more share {}, {at}", counted(non_manifold_edges.len(), "edge"));
        let remedy = "it is not a surface there: remove faces inside it before printing or cutting it";
        found(Severity::Note, NON_MANIFOLD, what, remedy);
    }
    if let Some(at) = first(mesh, &open_edges) {
        let what = format!("{} of one face (of {faces}), {at}", counted(open_edges.len(), "open edge"));
        let remedy = "it encloses no volume: fill its holes before printing it";
        found(Severity::Note, OPEN_EDGES, what, remedy);
    }
}

/// Where the first one is.
fn first(mesh: &Mesh, edges: &[[u32; 2]]) -> Option<String> {
    let ends = edges.first()?.map(|vertex| mesh.positions()[vertex as usize]);
    let [from, to] = ends.map(|Vec3 { x, y, z }| format!("({x}, {y}, {z})"));
    Some(format!("the first from {from} to {to}"))
}

fn without_area(mesh: &Mesh, location: &str, findings: &mut Vec<Finding>) {
    let is_flat = |&face: &usize| mesh.face_area_vector(face) == DVec3::ZERO;
    let flat = (0..mesh.face_count()).filter(is_flat).count();
    if flat as f64 > SHARE_WITHOUT_AREA * mesh.face_count() as f64 {
        findings.push(Finding {
            severity: Severity::Warning,
            fault: "no-area",
            location: location.to_owned(),
            what: format!("no area: {} of {}", counted(flat, "face"), mesh.face_count()),
            remedy: "merge vertices that lie at the same place",
        });
    }
}

/// Normals of the file compared with the faces.
fn normals(mesh: &Mesh, location: &str, findings: &mut Vec<Finding>) {
    let Some(normals) = &mesh.attributes().corner_normals else { return };
    let (mut useless, mut against) = (0, 0);
    for (face, corners) in mesh.faces().enumerate() {
        let across = mesh.face_area_vector(face);
        for normal in &normals[corners] {
            let is_direction = normal.is_finite() && *normal != Vec3::ZERO;
            useless += usize::from(!is_direction);
            against += usize::from(is_direction && normal.as_dvec3().dot(across) < 0.0);
        }
    }
    let mut found = |fault, what: String, remedy| {
        findings.push(Finding {
            severity: Severity::Error,
            fault,
            location: location.to_owned(),
            what,
            remedy,
        });
    };
    if useless * 2 > normals.len() {
        let what = format!("zero or not a number: {} of {}", counted(useless, "normal"), normals.len());
        found("broken-normals", what, "export it without normals, or recalculate them");
    }
    if against * 2 > normals.len() {
        let what = format!(
            "pointing to the back of their faces: {} of {}",
            counted(against, "normal"),
            normals.len()
        );
        found("inverted-normals", what, "it is lit from the wrong side: flip the normals or the faces");
    }
}
