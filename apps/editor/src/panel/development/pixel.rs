//! Details of one pixel.

use trigon_window::egui::{self, Ui};
use trigon_window::scene::{Frame, Scene};

use super::super::row::written;

/// Explains a pixel of an image of a scene, which may have changed since.
pub(super) fn explain(ui: &mut Ui, scene: &Scene, frame: &Frame, at: [u32; 2]) {
    for line in lines(scene, frame, at) {
        ui.add(egui::Label::new(line).wrap());
    }
}

/// A line for each thing that is known.
pub(super) fn lines(scene: &Scene, frame: &Frame, [x, y]: [u32; 2]) -> Vec<String> {
    let at = y as usize * frame.width as usize + x as usize;
    let [red, green, blue, alpha] = frame.pixel(x, y);
    let mut lines = vec![format!("Pixel {x}, {y}"), format!("Colour: {red} {green} {blue}, alpha {alpha}")];
    let Some(hit) = frame.hit(scene.nodes(), x, y) else {
        lines.push("Background".to_owned());
        return lines;
    };
    let name = scene.node(hit.node).map_or("", |node| node.name.as_str());
    lines.push(format!("Object: {name} (number {})", hit.node.index()));
    let id = |ids: &Option<Vec<u32>>| ids.as_ref().map(|ids| ids[at]).filter(|&id| id != u32::MAX);
    lines.extend(id(&frame.face_ids).map(|face| format!("Face: {face}")));
    lines.extend(id(&frame.triangle_ids).map(|triangle| format!("Triangle: {triangle}")));
    let material = id(&frame.material_ids).and_then(|index| scene.materials.id_at(index as usize));
    let name = material.and_then(|id| scene.materials.get(id)).map(|material| material.name.clone());
    lines.extend(name.map(|name| format!("Material: {name}")));
    lines.extend(frame.depth.as_ref().map(|depth| format!("Depth: {} m", short(depth[at]))));
    let vectors = [
        ("Position", &frame.positions),
        ("Normal", &frame.normals),
        ("Barycentrics", &frame.barycentrics),
        ("Albedo", &frame.albedo),
    ];
    for (name, list) in vectors {
        if let Some(list) = list {
            let [x, y, z] = list[at].to_array().map(short);
            lines.push(format!("{name}: {x}, {y}, {z}"));
        }
    }
    if let Some(uvs) = &frame.uvs {
        lines.push(format!("Texture coordinates: {}, {}", short(uvs[at].x), short(uvs[at].y)));
    }
    lines
}

fn short(value: f32) -> String {
    written((f64::from(value) * 1e4).round() / 1e4)
}
