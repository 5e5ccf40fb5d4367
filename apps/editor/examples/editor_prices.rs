//! What working on a mesh of a million triangles takes in the editor's window, from an event to the finished
//! image, at 1920×1080 with edges shown.
//!
//! ```text
//! cargo run --release -p trigon-editor --example editor_prices [-- PART OF A NAME]
//! ```
//! The window has no display, and works through the same session as behind a real one. There is one difference:
//! images are drawn on the thread that asks, and the interface is laid out after them. Behind a real window both
//! happen at once. Prints milliseconds from the event to the image in full size, and where they went. The rows
//! "live drag" do the same as behind a real window, and tell how many images a second come to the screen.

use std::time::{Duration, Instant};

use serde_json::{Value, json};
use trigon_document::mesh::math::elementary::sin_cos;
use trigon_document::mesh::{Mesh, primitives};
use trigon_document::scene::camera::Viewport;
use trigon_document::scene::math::DVec2;
use trigon_document::scene::{Material, Scene};
use trigon_document::{Command, Document};
use trigon_editor::measured_editor;
use trigon_window::{Chord, DrawnFrame, HeadlessWindow, Key, LiveFrame, Modifiers, PointerButton};

const SIZE: Viewport = Viewport { width: 1920, height: 1080 };

/// Quads along the sides: half a million, a million triangles.
const SIDES: [u32; 2] = [1000, 500];

/// How often each thing is done.
const RUNS: usize = 20;

/// The moves of the pointer that draw a box, each with its frame.
const MOVES: u32 = 16;

fn main() {
    let part = std::env::args().nth(1).unwrap_or_default();
    let compact = || block([450, 200], [100, 100]);
    let scattered = || (0..10_000).map(|index| index * 50).collect();
    let rows: [(&str, Vec<u32>, Work); 6] = [
        ("click", Vec::new(), click),
        ("box of half", Vec::new(), box_of_half),
        ("drag 10000 vertices, compact", compact(), drag),
        ("drag 10000 vertices, scattered", scattered(), drag),
        ("undo a move of 10000, scattered", scattered(), undo_moves),
        ("undo after 10000 actions", compact(), undo_after_many),
    ];
    tell(["", "best", "middle", "worst", "events", "image", "interface"].map(str::to_owned));
    for (name, selected, work) in rows {
        if name.contains(&part) {
            measure(name, &selected, work);
        }
    }
    for (name, selected) in [("compact", compact()), ("scattered", scattered())] {
        for rate in [60, 125, 1000] {
            let name = format!("live drag of 10000, {name}, {rate} events/s");
            if name.contains(&part) {
                drag_live(&name, &selected, rate);
            }
        }
    }
    tell_memory();
}

/// Drags for some seconds in a window whose images are drawn on threads of their own, with so many events a second.
fn drag_live(name: &str, selected: &[u32], rate: u32) {
    const LASTS: Duration = Duration::from_secs(4);
    let folder = tempfile::tempdir().expect("a folder for the recovery file");
    let (stage, mut editor) = measured_editor(document(selected), Some(folder.path().into()));
    let mut window = HeadlessWindow::open_live(stage, &mut *editor, SIZE);
    window.move_to(MIDDLE);
    window.key(Chord::new(Modifiers::NONE, Key::Character('g')));
    let place = |time: Duration| {
        // To and fro, about as far as in the rows above.
        let share = (time.as_secs_f64() % 2.0 - 1.0).abs();
        MIDDLE + DVec2::new(100.0, 27.0) - DVec2::new(60.0, 30.0) * share
    };
    let frames = window.drag_live(LASTS, Duration::from_secs(1) / rate, place);
    tell_frames(name, &frames);
    window.key(Chord::new(Modifiers::NONE, Key::Escape));
}

/// Tells how many images a second came to the screen after the first second, how many of them in full size, and the
/// times between them.
fn tell_frames(name: &str, frames: &[LiveFrame]) {
    let warm = frames.first().map_or(Duration::ZERO, |first| first.shown) + Duration::from_secs(1);
    let steady: Vec<_> = frames.iter().filter(|frame| frame.shown >= warm).collect();
    let mut gaps: Vec<_> = steady.windows(2).map(|pair| pair[1].shown - pair[0].shown).collect();
    gaps.sort_unstable();
    let Some(&last) = gaps.last() else {
        return tell_line(&format!("{name}: less than two images after the first second"));
    };
    let rate = gaps.len() as f64 / gaps.iter().sum::<Duration>().as_secs_f64();
    let whole = steady.iter().filter(|frame| frame.size == [SIZE.width, SIZE.height]).count();
    let [middle, late] =
        [50, 95].map(|part| milliseconds(gaps.get(gaps.len() * part / 100).copied().unwrap_or(last)));
    tell_line(&format!(
        "{name}: {rate:.1} images/s, {whole} of {} in full size, {middle} ms between them in the middle, {late} for one in 20",
        steady.len()
    ));
}

/// What is done and measured.
type Work = fn(&mut Worked<'_>);

/// A window on the sheet, and what was measured in it.
struct Worked<'a> {
    window: HeadlessWindow<'a>,
    started: Instant,
    results: Vec<Stages>,
}

/// From an event to an image.
#[derive(Clone, Copy)]
struct Stages {
    events: Duration,
    image: Duration,
    interface: Duration,
}

impl Stages {
    fn all(&self) -> Duration {
        self.events + self.image + self.interface
    }
}

impl Worked<'_> {
    /// Does something, and measures until an image is finished.
    fn time(&mut self, is_finished: fn(&DrawnFrame) -> bool, act: impl FnOnce(&mut Self)) {
        self.window.take_frames();
        let start = self.started.elapsed();
        act(self);
        let frames = self.window.take_frames();
        let finished = frames.iter().position(is_finished).expect("an image follows");
        let mut stages = Stages { events: Duration::ZERO, image: Duration::ZERO, interface: Duration::ZERO };
        let mut last = start;
        for frame in &frames[..=finished] {
            stages.events += frame.begun - last;
            stages.image += frame.drawn - frame.begun;
            stages.interface += frame.ended - frame.drawn;
            last = frame.ended;
        }
        self.results.push(stages);
    }

    fn key(&mut self, key: Key, modifiers: Modifiers) {
        self.window.key(Chord::new(modifiers, key));
    }
}

fn measure(name: &str, selected: &[u32], work: fn(&mut Worked<'_>)) {
    let mut document = document(selected);
    if name.contains("after") {
        act_often(&mut document);
    }
    let folder = tempfile::tempdir().expect("a folder for the recovery file");
    let (mut stage, mut editor) = measured_editor(document, Some(folder.path().into()));
    // Of an image at rest only the first is measured: with one sample in a pixel, as while something moves.
    stage.settings.samples_per_axis = 1;
    let started = Instant::now();
    let window = HeadlessWindow::open_measured(stage, &mut *editor, SIZE, move || started.elapsed());
    let mut worked = Worked { window, started, results: Vec::new() };
    work(&mut worked);
    let results = &mut worked.results;
    results.sort_by_key(Stages::all);
    let middle = results[results.len() / 2];
    let all = [results[0].all(), middle.all(), results[results.len() - 1].all()];
    let [best, middle_all, worst] = all.map(milliseconds);
    let [events, image, interface] = [middle.events, middle.image, middle.interface].map(milliseconds);
    tell([name.to_owned(), best, middle_all, worst, events, image, interface]);
}

/// The middle of what no panel covers.
const MIDDLE: DVec2 = DVec2::new(880.0, 540.0);

fn click(worked: &mut Worked<'_>) {
    for run in 0..RUNS {
        worked.window.move_to(MIDDLE + DVec2::new(7.0, 5.0) * run as f64);
        worked.window.press(PointerButton::Left);
        worked.time(|frame| frame.is_full, |worked| worked.window.release(PointerButton::Left));
    }
}

fn box_of_half(worked: &mut Worked<'_>) {
    for run in 0..RUNS {
        let start = DVec2::new(200.0, 120.0);
        worked.window.move_to(start);
        worked.window.press(PointerButton::Left);
        let end = MIDDLE + DVec2::new(9.0 * run as f64, 400.0);
        for step in 1..=MOVES {
            let share = f64::from(step) / f64::from(MOVES);
            worked.window.move_on_to(start.lerp(end, share));
        }
        worked.time(|frame| frame.is_full, |worked| worked.window.release(PointerButton::Left));
    }
}

fn drag(worked: &mut Worked<'_>) {
    worked.window.move_to(MIDDLE);
    worked.key(Key::Character('g'), Modifiers::NONE);
    for run in 0..3 * RUNS {
        let to = MIDDLE + DVec2::new(40.0, -3.0) + DVec2::new(1.0, 0.5) * run as f64;
        worked.time(|_| true, |worked| worked.window.move_on_to(to));
    }
    worked.key(Key::Escape, Modifiers::NONE);
}

fn undo_moves(worked: &mut Worked<'_>) {
    for run in 0..RUNS {
        worked.window.move_to(MIDDLE);
        worked.key(Key::Character('g'), Modifiers::NONE);
        worked.window.move_to(MIDDLE + DVec2::new(40.0 + run as f64, -30.0));
        worked.key(Key::Enter, Modifiers::NONE);
        worked.time(|frame| frame.is_full, |worked| worked.key(Key::Character('z'), Modifiers::CTRL));
    }
}

fn undo_after_many(worked: &mut Worked<'_>) {
    for _ in 0..3 * RUNS {
        worked.time(|frame| frame.is_full, |worked| worked.key(Key::Character('z'), Modifiers::CTRL));
    }
}

/// Ten thousand actions: by turns another block is selected, and moved.
fn act_often(document: &mut Document) {
    for action in 0..10_000_u32 {
        if action % 2 == 0 {
            let from = [action / 2 % 900, action / 20 % 400];
            run(document, json!({ "op": "select", "elements": block(from, [40, 40]) }));
        } else {
            run(document, json!({ "op": "translate", "offset": [0, 0.001, 0] }));
        }
    }
    let history = document.history();
    let (mebibytes, kept) = (history.bytes() >> 20, history.done().len());
    tell_line(&format!("10000 actions: {kept} can be undone, which take {mebibytes} MiB"));
}

/// The vertices of a block of the sheet.
fn block(from: [u32; 2], size: [u32; 2]) -> Vec<u32> {
    let rows = from[1]..from[1] + size[1];
    rows.flat_map(|row| (from[0]..from[0] + size[0]).map(move |column| row * (SIDES[0] + 1) + column))
        .collect()
}

/// The sheet in edit mode, with these vertices selected.
fn document(selected: &[u32]) -> Document {
    let mut scene = Scene::new();
    scene.add_object("sheet", sheet(), Material::default());
    let mut document = Document::new(scene);
    run(&mut document, json!({ "op": "edit_objects", "objects": ["sheet"] }));
    if !selected.is_empty() {
        run(&mut document, json!({ "op": "select", "elements": selected }));
    }
    document
}

/// A wavy sheet.
fn sheet() -> Mesh {
    let mut sheet = primitives::grid(4.0, 2.0, SIDES[0], SIDES[1]);
    for position in sheet.positions_mut() {
        let (sine, _) = sin_cos(4.5 * (f64::from(position.x) + 1.0));
        let (_, cosine) = sin_cos(3.5 * (f64::from(position.z) + 1.0));
        position.y = (0.1 * sine * cosine) as f32;
    }
    sheet
}

fn run(document: &mut Document, command: Value) {
    let command: Command = serde_json::from_value(command).expect("a command");
    document.run(command).expect("it is possible");
}

fn milliseconds(time: Duration) -> String {
    format!("{:.1}", time.as_secs_f64() * 1e3)
}

fn tell([name, numbers @ ..]: [String; 7]) {
    let numbers = numbers.map(|number| format!("{number:>10}"));
    tell_line(&format!("{name:<34}{}", numbers.concat()));
}

/// What the process takes, where the system tells.
fn tell_memory() {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    for line in status.lines().filter(|line| line.starts_with("VmHWM") || line.starts_with("VmRSS")) {
        tell_line(line);
    }
}

#[expect(clippy::print_stdout, reason = "this is what it is for")]
fn tell_line(line: &str) {
    println!("{line}");
}
