//! Checks of position and size: empty scenes, NaN, flat nodes, scale, distance.

use trigon_math::{Bounds3, DVec3};

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
