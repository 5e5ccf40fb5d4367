//! Figures about images, and details of one pixel.

use std::time::Duration;

use trigon_window::egui::{Grid, RichText, Ui};
use trigon_window::scene::{EffectPlan, Frame, Scene, Stats};
use trigon_window::{Comparison, Refinement, egui};

use super::DrawnView;
use crate::panel::parameters::check_box;
use crate::panel::row::written;
use crate::request::Request;

fn ms(time: Duration) -> String {
    format!("{:.1} ms", time.as_secs_f64() * 1e3)
}

fn line(ui: &mut Ui, text: impl Into<String>) {
    ui.add(egui::Label::new(text.into()).wrap());
}

/// What the last frame took.
pub(super) fn frame(ui: &mut Ui, view: &DrawnView<'_>) {
    line(ui, format!("Drawing: {}", ms(view.report.render)));
    line(ui, format!("Presenting: {}", ms(view.report.present)));
    line(ui, format!("Size: {} × {} pixels", view.settings.width, view.settings.height));
}

/// How far the image at rest is from the reference.
pub(super) fn accuracy(ui: &mut Ui, view: &DrawnView<'_>, requests: &mut Vec<Request>) {
    let mut is_compared = view.comparison != Comparison::Off;
    if check_box(ui, &mut is_compared, "Compare with the reference").changed() {
        let comparison = if is_compared { Comparison::Measured } else { Comparison::Off };
        requests.push(Request::Compare(comparison));
    }
    let mut is_shown = view.comparison == Comparison::Shown;
    if check_box(ui, &mut is_shown, "Show the difference").changed() {
        let comparison = if is_shown { Comparison::Shown } else { Comparison::Measured };
        requests.push(Request::Compare(comparison));
    }
    let mut is_refined = view.refinement == Refinement::Reference;
    if check_box(ui, &mut is_refined, "Refine to the reference at rest").changed() {
        let refinement = if is_refined { Refinement::Reference } else { Refinement::Settings };
        requests.push(Request::Refine(refinement));
    }
    match view.quality.map(|report| (report, report.difference)) {
        None => line(ui, "Error: the image is not finished yet."),
        Some((_, None)) => line(ui, "Error: not compared."),
        Some((_, Some(difference))) if difference.worst_levels == 0 => line(ui, "Error: none."),
        Some((_, Some(difference))) => {
            line(ui, format!("Error: RMSE {:.4} in linear light", difference.rmse));
            line(ui, format!("Worst pixel: {} of 255 levels", difference.worst_levels));
        }
    }
}

/// What went through the stages. Each pixel has so many samples that are shaded.
pub(super) fn stages(ui: &mut Ui, stats: &Stats, frame: &Frame, shades: u64) {
    let rows = [
        ("Vertices", stats.vertices, "Transformed vertices"),
        ("Primitives", stats.primitives, "Triangles, segments and points submitted"),
        ("Outside", stats.outside, "Primitives outside the view"),
        ("Culled", stats.culled, "Triangles without area or sample, or facing away"),
        ("Clipped", stats.clipped, "Clipped primitives"),
        ("Set up", stats.set_up, "Triangles drawn"),
        ("Tiles", stats.tiles, "Tiles with triangles"),
        ("In tiles", stats.binned, "Triangles in tiles, counted once per tile"),
        ("Tiles hidden", stats.tiles_rejected, "Triangles rejected by a whole tile"),
        ("Tiles filled", stats.tiles_filled, "Tiles filled by one triangle"),
        ("Blocks full", stats.blocks_accepted, "Blocks of 8 × 8 pixels fully covered by a triangle"),
        ("Blocks hidden", stats.blocks_rejected, "Blocks that a triangle misses, or that hide it"),
        ("Shaded", stats.pixels_shaded, "Shaded fragments"),
        ("Blended", stats.pixels_blended, "Shaded fragments that are translucent"),
        ("With edges", stats.triangles_edged, "Visible triangles with painted edges, counted once per tile"),
        ("Masked", stats.samples_masked, "Fragments with a mask test"),
    ];
    Grid::new("stages").num_columns(2).spacing([10.0, 2.0]).show(ui, |ui| {
        for (name, count, hover) in rows {
            ui.label(name).on_hover_text(hover);
            ui.label(count.to_string());
            ui.end_row();
        }
    });
    let per = |count: u64, of: u64| if of == 0 { 0.0 } else { count as f64 / of as f64 };
    line(ui, format!("Triangles in a tile: {:.1}", per(stats.binned, stats.tiles)));
    let covered = frame.object_ids.iter().flatten().filter(|&&id| id != u32::MAX).count();
    let overdraw = per(stats.pixels_shaded, covered as u64 * shades);
    line(ui, format!("Overdraw: {overdraw:.2} shaded fragments for each covered sample"));
}

/// Each effect, and why it is on or off.
pub(super) fn effects(ui: &mut Ui, plan: &EffectPlan) {
    for (effect, decision) in plan.iter() {
        let text = RichText::new(format!("{effect}: {decision}"));
        ui.add(egui::Label::new(if plan.is_on(effect) { text.strong() } else { text }).wrap());
    }
}

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
    let mut lines = vec![format!("Pixel {x}, {y}"), format!("Color: {red} {green} {blue}, alpha {alpha}")];
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
