//! Checks of appearance: black, invisible, metal with nothing to mirror, textures that are not
//! shown, lights that emit nothing.

use std::collections::BTreeSet;

use super::{Finding, Severity, locate};
use crate::light_meter::ExposureFault;
use crate::material::{AlphaMode, Material, MaterialId, Shading};
use crate::scene::Scene;
use crate::settings::{Lighting, RenderSettings};

/// Darker than this is black in an 8-bit image.
const BLACK: f32 = 1.0 / 255.0 / 12.92;

/// More transparent than this is invisible.
const INVISIBLE: f32 = 1.0 / 255.0;

pub(super) fn check(scene: &Scene, findings: &mut Vec<Finding>) {
    let visible = visible_materials(scene);
    for &id in &visible {
        let Some(material) = scene.materials.get(id) else { continue };
        one(material, &locate("material", &material.name, id.index()), findings);
    }
    all_metal(scene, &visible, findings);
    lights(scene, findings);
    exposure(scene, findings);
    meshes(scene, findings);
}

/// The materials of visible nodes.
fn visible_materials(scene: &Scene) -> BTreeSet<MaterialId> {
    let visible = scene.visible_transforms();
    let nodes =
        scene.nodes().iter().filter(|(id, node)| visible[id.index()].is_some() && node.mesh.is_some());
    nodes.flat_map(|(_, node)| node.materials.iter().copied()).collect()
}

fn one(material: &Material, location: &str, findings: &mut Vec<Finding>) {
    let mut found = |severity, fault, what: &str, remedy| {
        let (location, what) = (location.to_owned(), what.to_owned());
        findings.push(Finding { severity, fault, location, what, remedy });
    };
    let color = material.base_color;
    if material.alpha_mode == AlphaMode::Blend && color.w < INVISIBLE && material.transmission == 0.0 {
        let what = "it is wholly transparent (its alpha is 0)";
        found(Severity::Error, "invisible", what, "set its alpha to 1, or its alpha mode to opaque");
    } else if color.truncate().max_element() <= BLACK && material.base_color_texture.is_some() {
        let what = "its colour is black, and its texture is multiplied by that";
        found(Severity::Error, "black", what, "set its colour to white");
    } else if !color.truncate().is_finite() || !color.w.is_finite() {
        found(Severity::Error, "not-a-number", "its colour is not a number", "set its colour again");
    }
}

/// Metal shows only what it mirrors. Here that is a studio if there is nothing else, and polished metal is as good as any
/// other material: a note.
fn all_metal(scene: &Scene, visible: &BTreeSet<MaterialId>, findings: &mut Vec<Finding>) {
    let materials: Vec<&Material> = visible.iter().filter_map(|&id| scene.materials.get(id)).collect();
    let is_mirror = |material: &&Material| match &material.shading {
        Shading::MetallicRoughness(surface) => {
            surface.metallic > 0.95 && surface.texture.is_none() && surface.roughness < 0.3
        }
        _ => false,
    };
    if !materials.is_empty() && materials.iter().all(is_mirror) {
        findings.push(Finding {
            severity: Severity::Note,
            fault: "metal-without-environment",
            location: "scene".to_owned(),
            what: "everything is polished metal, which is black in programs without an environment to mirror"
                .to_owned(),
            remedy: "show it with an environment image (--hdri-file), or set metallic to 0",
        });
    }
}

fn lights(scene: &Scene, findings: &mut Vec<Finding>) {
    let mut lights = scene.nodes().iter().filter_map(|(_, node)| node.light.as_ref()).peekable();
    if lights.peek().is_some() && lights.all(|light| light.color.max_element() * light.intensity <= 0.0) {
        findings.push(Finding {
            severity: Severity::Error,
            fault: "no-light",
            location: "scene".to_owned(),
            what: "its lights give no light".to_owned(),
            remedy: "raise their intensity, or leave them out of the export",
        });
    }
}

/// Lamps that a display could not show as they are, and a model that is black or white even when they are
/// exposed.
fn exposure(scene: &Scene, findings: &mut Vec<Finding>) {
    let settings = RenderSettings { lighting: Lighting::Scene, ..RenderSettings::new(1, 1) };
    if let Some(reading) = scene.exposed_by(&settings) {
        findings.push(Finding {
            severity: Severity::Note,
            fault: "lamps-out-of-range",
            location: "scene".to_owned(),
            what: format!(
                "white in the light of its lamps has {} times a display's white, so they are exposed by {} stops",
                reading.white_text(),
                reading.stops
            ),
            remedy: "programs without a light meter show it white or black: change their intensity for these",
        });
    }
    if let Some(warning) = scene.exposure_warning(&settings) {
        let (fault, remedy) = match warning.fault {
            ExposureFault::Clipped => ("overexposed", "make its lamps less different in brightness"),
            ExposureFault::Black => (
                "underexposed",
                "add lamps near the rest or raise their range, or light it with an environment",
            ),
        };
        let what = warning.what();
        findings.push(Finding {
            severity: Severity::Warning,
            fault,
            location: "scene".to_owned(),
            what,
            remedy,
        });
    }
}

/// Textures without coordinates, and vertex colours that make everything black.
fn meshes(scene: &Scene, findings: &mut Vec<Finding>) {
    let visible = scene.visible_transforms();
    let mut known = BTreeSet::new();
    for (id, node) in scene.nodes().iter().filter(|(id, _)| visible[id.index()].is_some()) {
        let Some((mesh_id, asset)) = node.mesh.and_then(|mesh| Some((mesh, scene.meshes().get(mesh)?)))
        else {
            continue;
        };
        if !known.insert(mesh_id) || asset.mesh().face_count() == 0 {
            continue;
        }
        let attributes = asset.mesh().attributes();
        let location = locate("mesh", &asset.name, id.index());
        let materials = node.materials.iter().filter_map(|&id| scene.materials.get(id));
        let mut textures = materials.flat_map(Material::textures);
        if textures.any(|(_, binding)| binding.uv_set >= attributes.uv_sets.len()) {
            findings.push(Finding {
                severity: Severity::Error,
                fault: "no-texture-coordinates",
                location: location.clone(),
                what: "its material has a texture, but the mesh has no coordinates for it".to_owned(),
                remedy: "unwrap it and export UV coordinates, or take the texture off",
            });
        }
        let colors = attributes.corner_colors.as_deref().unwrap_or_default();
        if !colors.is_empty() && colors.iter().all(|color| color.truncate().max_element() <= BLACK) {
            findings.push(Finding {
                severity: Severity::Error,
                fault: "black",
                location,
                what: "the colours of all its vertices are black".to_owned(),
                remedy: "export it without vertex colours",
            });
        }
    }
}
