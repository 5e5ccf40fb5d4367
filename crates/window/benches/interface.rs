//! An interface of 1920 by 1080 pixels in which one label changes. Measured are the painter, all of a frame with
//! egui's own part, and the same while an image is drawn beside it, on as many threads as there are cores.

use criterion::{Criterion, criterion_group, criterion_main};
use egui::{ClippedPrimitive, Context};
use std::hint::black_box;
use trigon_scene::{Cancel, Frame, RenderSettings, Renderer, showcase};
use trigon_window::{ChannelOrder, EguiPainter, MAX_TEXTURE_SIDE};

const SIZE: [u32; 2] = [1920, 1080];

/// Panels full of widgets around one label that counts.
fn interface(ui: &mut egui::Ui, count: u32) {
    egui::Panel::top("menu").show(ui, |ui| {
        ui.horizontal(|ui| (0..12).for_each(|i| drop(ui.button(format!("menu {i}")))));
    });
    egui::Panel::left("tree").exact_size(300.0).show(ui, |ui| {
        (0..40).for_each(|i| drop(ui.selectable_label(i == 7, format!("node {i} of the scene"))));
    });
    egui::Panel::right("properties").exact_size(340.0).show(ui, |ui| {
        ui.label(format!("frame {count}"));
        for i in 0..24 {
            ui.horizontal(|ui| {
                ui.label(format!("property {i}"));
                ui.add(egui::Slider::new(&mut (i as f32), 0.0..=30.0));
            });
        }
    });
    egui::Window::new("statistics").default_pos([500.0, 300.0]).show(ui.ctx(), |ui| {
        (0..20).for_each(|i| drop(ui.label(format!("row {i}: nothing new to be told here"))));
    });
}

/// A pass of egui: the triangles.
fn pass(context: &Context, painter: &mut EguiPainter, count: u32) -> Vec<ClippedPrimitive> {
    let size = egui::vec2(SIZE[0] as f32, SIZE[1] as f32);
    let input = egui::RawInput {
        screen_rect: Some(egui::Rect::from_min_size(egui::Pos2::ZERO, size)),
        max_texture_side: Some(MAX_TEXTURE_SIDE),
        ..egui::RawInput::default()
    };
    let mut output = context.run_ui(input, |ui| interface(ui, count));
    painter.update_textures(&mut output.textures_delta);
    context.tessellate(output.shapes, output.pixels_per_point)
}

fn one_label(criterion: &mut Criterion) {
    let context = Context::default();
    let mut painter = EguiPainter::new(ChannelOrder::Bgra);
    let beneath = vec![[40, 40, 40, 255]; (SIZE[0] * SIZE[1]) as usize];
    let mut pixels = beneath.clone();
    let mut paint = |painter: &mut EguiPainter, primitives| {
        painter.set_primitives(primitives, 1.0);
        painter.paint(SIZE, black_box(&mut pixels), &beneath).expect("the sides fit")
    };
    // Windows find their places, and digits into the font's texture.
    for count in 10_000..10_020 {
        let primitives = pass(&context, &mut painter, count * 1111);
        paint(&mut painter, primitives);
    }
    let passes = [11, 12].map(|count| pass(&context, &mut painter, count));
    let mut group = criterion.benchmark_group("one label of 1080p");
    let mut count = 0;
    group.bench_function("painter", |b| {
        b.iter(|| {
            count += 1;
            paint(&mut painter, passes[count % 2].clone())
        });
    });
    group.bench_function("frame", |b| {
        b.iter(|| {
            count += 1;
            let primitives = pass(&context, &mut painter, 11 + count as u32 % 2);
            paint(&mut painter, primitives)
        });
    });
    beside_an_image(|| {
        group.bench_function("frame beside an image", |b| {
            b.iter(|| {
                count += 1;
                let primitives = pass(&context, &mut painter, 11 + count as u32 % 2);
                paint(&mut painter, primitives)
            });
        });
    });
    group.bench_function("all anew", |b| {
        b.iter(|| {
            painter.invalidate();
            paint(&mut painter, passes[0].clone())
        });
    });
    group.finish();
}

/// Runs something while an image is drawn on another thread.
fn beside_an_image(run: impl FnOnce()) {
    let (scene, cancel) = (showcase(), Cancel::default());
    let settings = RenderSettings { samples: 16, ..RenderSettings::new(SIZE[0], SIZE[1]) };
    let camera = scene.overview(settings.aspect());
    std::thread::scope(|scope| {
        // Again and again: how long one takes does not matter.
        scope.spawn(|| {
            let (mut renderer, mut frame) = (Renderer::new(settings), Frame::default());
            while renderer.render_cancellable(&scene, &camera, &cancel, &mut frame).is_ok() {}
        });
        run();
        cancel.cancel();
    });
}

criterion_group!(benches, one_label);
criterion_main!(benches);
