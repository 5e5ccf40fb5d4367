//! Figures about images.

use std::time::Duration;

use trigon_window::egui::{self, Grid, RichText, Ui};
use trigon_window::scene::{EffectPlan, Frame, Stats};
use trigon_window::{Comparison, Refinement};

use super::super::parameters::check_box;
use super::DrawnView;
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
