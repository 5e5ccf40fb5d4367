//! Checks of position and size (empty scenes, NaN, flat nodes, scale, distance), and of faces and how faces join: inside
//! out, inconsistent winding, non-manifold, without area, with normals that point inwards.

use trigon_math::{Bounds3, DVec3, Vec3};
use trigon_mesh::{Mesh, Surface};

use super::{Finding, Severity, counted, locate};
use crate::scene::Scene;

/// Smaller than a millimetre, or larger than a hundred kilometres: probably the wrong unit.
const TINY: f64 = 1e-3;
const HUGE: f64 = 1e5;

/// At this many times its own size from the origin a model loses detail: the numbers of most files
/// have 24 bits, of which this takes 17.
const FAR: f64 = 131_072.0;

pub(super) fn check(scene: &Scene, findings: &mut Vec<Finding>) {
    not_finite(scene, findings);
    flattened(scene, findings);
    let bounds = scene.tight_bounds();
    if bounds.is_empty() {
        findings.push(Finding {
            severity: Severity::Error,
            fault: "nothing-to-draw",
            location: "scene".to_owned(),
            what: nothing(scene),
            remedy: "check that the right file was exported, with its meshes",
        });
        return;
    }
    size(&bounds, findings);
    distance(&bounds, findings);
}

/// Why nothing is visible.
fn nothing(scene: &Scene) -> String {
    let hidden = scene.nodes().iter().filter(|(_, node)| !node.visible).count();
    match (scene.meshes().len(), hidden) {
        (0, _) => "it has no mesh".to_owned(),
        (_, 0) => "no face, line or point is visible".to_owned(),
        (_, hidden) => format!("everything is hidden, by {}", counted(hidden, "hidden node")),
    }
}

fn not_finite(scene: &Scene, findings: &mut Vec<Finding>) {
    for (id, asset) in scene.meshes().iter() {
        let broken = asset.mesh().positions().iter().filter(|position| !position.is_finite()).count();
        if broken > 0 {
            findings.push(Finding {
                severity: Severity::Error,
                fault: "not-a-number",
                location: locate("mesh", &asset.name, id.index()),
                what: format!("the coordinates of {} are not finite numbers", counted(broken, "vertex")),
                remedy: "their faces are not drawn: repair the file where it was made",
            });
        }
    }
    for (id, node) in scene.nodes().iter() {
        let transform = node.transform.to_affine();
        if !transform.is_finite() {
            findings.push(Finding {
                severity: Severity::Error,
                fault: "not-a-number",
                location: locate("node", &node.name, id.index()),
                what: "its transform is not finite".to_owned(),
                remedy: "its children are not drawn: repair the file where it was made",
            });
        }
    }
}

/// Nodes with a mesh that are scaled to a line or a point.
fn flattened(scene: &Scene, findings: &mut Vec<Finding>) {
    let visible = scene.visible_transforms();
    for (id, node) in scene.nodes().iter() {
        let Some(world) = visible[id.index()].filter(|_| node.mesh.is_some() && node.skin.is_none()) else {
            continue;
        };
        let axes = [world.matrix3.x_axis, world.matrix3.y_axis, world.matrix3.z_axis];
        let flat = axes.into_iter().filter(|axis| *axis == DVec3::ZERO).count();
        if flat > 1 {
            findings.push(Finding {
                severity: Severity::Error,
                fault: "flattened",
                location: locate("node", &node.name, id.index()),
                what: format!("it is scaled to 0 along {flat} axes, so it is invisible"),
                remedy: "give it a scale other than 0, or hide it",
            });
        }
    }
}

fn size(bounds: &Bounds3, findings: &mut Vec<Finding>) {
    let size = bounds.size().length();
    let (what, remedy) = if size > 0.0 && size < TINY {
        ("tiny", "metres were probably not meant: export it with another unit, or scale it by 1000")
    } else if size > HUGE {
        ("huge", "metres were probably not meant: export it with another unit, or scale it by 0.001")
    } else {
        return;
    };
    findings.push(Finding {
        severity: Severity::Warning,
        fault: "scale",
        location: "scene".to_owned(),
        what: format!("it is {what}: {size:.3e} m from corner to corner"),
        remedy,
    });
}

fn distance(bounds: &Bounds3, findings: &mut Vec<Finding>) {
    let (size, center) = (bounds.size().length(), bounds.center().unwrap_or_default());
    if size > 0.0 && center.length() > FAR * size {
        findings.push(Finding {
            severity: Severity::Warning,
            fault: "far-from-origin",
            location: "scene".to_owned(),
            what: format!(
                "it is {:.3e} m away from the origin, and only {size:.3e} m large",
                center.length()
            ),
            remedy: "coordinates lose detail there: move it to the origin, and keep the offset apart",
        });
    }
}

/// From this number of faces on, a fraction without area counts as a fault.
const SHARE_WITHOUT_AREA: f64 = 0.05;

/// Edges of one face.
pub(super) const OPEN_EDGES: &str = "open-edges";

/// Edges of two faces that run along them in the same direction.
pub(super) const MIXED_WINDING: &str = "mixed-winding";

/// Edges of three faces or more.
pub(super) const NON_MANIFOLD: &str = "non-manifold";

pub(super) fn check_faces(scene: &Scene, findings: &mut Vec<Finding>) {
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
