//! The panels on the right (the outliner above, tabs below), the panel of the last operation at the lower
//! left of the view, and the status line: the keys and numbers of the active tool, results and errors, and
//! the selection.

use trigon_document::{Command, Document, ElementKind};
use trigon_window::egui::{
    Align, Align2, Button, Context, Id, Layout, Panel, Rect, RichText, ScrollArea, Ui, UiBuilder,
};
use trigon_window::{Stage, egui};

use crate::icon::Icon;
use crate::panel;
use crate::panel::{DrawnView, ShownDocument};
use crate::request::Request;
use crate::window::actions;
use crate::window::editor::{Editor, Message};
use crate::window::loading::Loading;
use crate::window::panels::Tab;

/// In points.
const WIDTH: f32 = 280.0;
const LEAST_WIDTH: f32 = 200.0;
const ADJUST_WIDTH: f32 = 260.0;
/// A view in which the panel of the last operation is open at first, in points.
const LEAST_VIEW: f32 = 700.0;
/// What the outliner leaves to the tabs, in points.
const LEAST_TABS: f32 = 160.0;
const LEAST_OUTLINER: f32 = 60.0;

/// The outliner above, the tabs below. Their sizes are the user's: what they show does not change them.
pub(super) fn show(ui: &mut Ui, editor: &mut Editor, stage: &Stage, requests: &mut Vec<Request>) {
    let most = (ui.available_width() * 0.6).max(LEAST_WIDTH);
    // Each size of text has widths and heights of its own.
    let scale = (ui.ctx().pixels_per_point() * 100.0) as u32;
    let side = Panel::right(Id::unique(("side", scale))).default_size(WIDTH).size_range(LEAST_WIDTH..=most);
    side.show(ui, |ui| {
        within_bounds(ui, |ui| {
            let height = ui.available_height();
            let most = (height - LEAST_TABS).max(LEAST_OUTLINER);
            let upper =
                Panel::top(Id::unique(("outliner", scale))).resizable(true).default_size(height * 0.3);
            upper.size_range(LEAST_OUTLINER..=most).show(ui, |ui| {
                within_bounds(ui, |ui| {
                    panel::outliner(ui, &editor.document, &mut editor.panels.outliner, requests);
                });
            });
            tabs(ui, editor, stage, requests);
        });
    });
}

/// Shows contents in all the room that there is, which they do not make larger: a panel would keep the size of what it
/// once showed.
fn within_bounds(ui: &mut Ui, contents: impl FnOnce(&mut Ui)) {
    let bounds = ui.available_rect_before_wrap();
    let mut within = ui.new_child(UiBuilder::new().max_rect(bounds));
    within.set_clip_rect(within.clip_rect().intersect(bounds));
    contents(&mut within);
    ui.advance_cursor_after_rect(bounds);
}

fn tabs(ui: &mut Ui, editor: &mut Editor, stage: &Stage, requests: &mut Vec<Request>) {
    let all = [
        (Tab::Properties, "Properties", Icon::Properties),
        (Tab::Add, "Add", Icon::Add),
        (Tab::Information, "Information", Icon::Information),
    ];
    let development = (Tab::Development, "Development", Icon::Development);
    let development = editor.preferences.get().development.then_some(development);
    if development.is_none() && editor.panels.tab == Tab::Development {
        editor.panels.tab = Tab::Properties;
    }
    ui.horizontal_wrapped(|ui| {
        ui.spacing_mut().item_spacing.x = 2.0;
        for (tab, name, icon) in all.into_iter().chain(development) {
            let shown = ui.add(Button::selectable(editor.panels.tab == tab, (icon.atom(), name)));
            if shown.clicked() {
                editor.panels.tab = tab;
            }
        }
    });
    ui.separator();
    let up = editor.up();
    let Editor { document, panels, tools, keys, .. } = editor;
    let shown = ShownDocument { document, up };
    ScrollArea::vertical().id_salt(panels.tab as usize).auto_shrink([false, false]).show(
        ui,
        |ui| match panels.tab {
            Tab::Information => {
                let is_editing = document.selection().is_editing();
                let of_mode =
                    actions::tools().map(|tool| tool.action).filter(|action| action.fits_mode(is_editing));
                let controls = of_mode.map(|action| (keys.text_of(action), action.label.to_owned()));
                let controls: Vec<_> = controls.filter(|(keys, _)| !keys.is_empty()).collect();
                panel::information(ui, shown, &mut panels.information, &controls);
                egui::CollapsingHeader::new("History").default_open(true).show_unindented(ui, |ui| {
                    panel::history(ui, document, requests);
                });
            }
            Tab::Add => panel::add(ui, shown, &mut panels.add, tools.cursor.to_array(), requests),
            Tab::Properties => panel::properties(ui, shown, &mut panels.properties, requests),
            Tab::Development => {
                panel::development(ui, &DrawnView::of(stage), &mut panels.development, requests);
            }
        },
    );
}

/// The values of the last operation, while there are some that could be changed.
pub(super) fn adjust(context: &Context, editor: &Editor, free: Rect, requests: &mut Vec<Request>) {
    let last = editor.document.history().done().last().map(|entry| entry.command());
    let is_over = editor.tool.is_none() && editor.question.is_none() && editor.loading.is_none();
    // What was pasted has no values, and may be large.
    let can_adjust = last.is_some_and(|last| !last.is_selection() && !matches!(last, Command::Paste(_)));
    if !(can_adjust && is_over && editor.layout.adjust) {
        return;
    }
    let at = free.left_bottom() + egui::vec2(8.0, -8.0);
    let window = egui::Window::new("Last Operation").id(Id::unique("adjust")).resizable(false);
    let window = window.pivot(Align2::LEFT_BOTTOM).fixed_pos(at).default_width(ADJUST_WIDTH);
    // In a small view it would lie over what is modelled.
    let window = window.default_open(free.width() > LEAST_VIEW);
    window.show(context, |ui| {
        ui.set_width(ADJUST_WIDTH);
        ScrollArea::vertical().max_height((free.height() * 0.6).max(80.0)).show(ui, |ui| {
            let shown = ShownDocument { document: &editor.document, up: editor.up() };
            panel::adjust(ui, shown, requests);
        });
    });
}

/// Shows it.
pub(super) fn line(ui: &mut Ui, editor: &Editor) {
    ui.horizontal(|ui| {
        ui.with_layout(Layout::right_to_left(Align::Center), |ui| {
            ui.label(counts(&editor.document));
            ui.separator();
            if let Some(text) = under_way(editor) {
                ui.label(text);
                ui.separator();
            }
            ui.with_layout(Layout::left_to_right(Align::Center), |ui| {
                let text = match (&editor.tool, &editor.message) {
                    (Some(tool), _) => RichText::new(tool.status()),
                    (None, Message::Hint(text) | Message::Info(text)) => RichText::new(text),
                    (None, Message::Refusal(text)) => RichText::new(text).color(ui.visuals().warn_fg_color),
                };
                ui.add(egui::Label::new(text).truncate());
            });
        });
    });
}

/// What other threads are at.
fn under_way(editor: &Editor) -> Option<String> {
    let loading = editor.loading.as_ref().map(Loading::text);
    let saving = || Some(format!("Saving {}", editor.saving.as_ref()?.order.path.display()));
    loading.or_else(saving).or_else(|| editor.images.under_way())
}

/// As "3 of 8 vertices".
fn counts(document: &Document) -> String {
    let selection = document.selection();
    if !selection.is_editing() {
        let all = document.nodes().nodes().len();
        return format!("{} of {all} objects selected", selection.objects.len());
    }
    let counts = selection.kinds().iter().map(|kind| count(document, kind));
    format!("{} selected", counts.collect::<Vec<_>>().join(", "))
}

/// How many elements of a kind are selected, and how many there are.
fn count(document: &Document, kind: ElementKind) -> String {
    let selection = document.selection();
    let (own, mut selected, mut all) = (selection.kind(), 0, 0);
    for (id, elements) in selection.meshes() {
        let Some(mesh) = document.mesh(id) else { continue };
        selected += match kind {
            _ if kind == own => elements.len(),
            ElementKind::Vertex => elements.vertices(mesh, own).len(),
            ElementKind::Edge => elements.edges(mesh, own).len(),
            ElementKind::Face => elements.faces(mesh, own).len(),
        };
        all += match kind {
            ElementKind::Vertex => mesh.vertex_count(),
            ElementKind::Edge => mesh.edge_count(),
            ElementKind::Face => mesh.face_count(),
        };
    }
    let name = match kind {
        ElementKind::Vertex => "vertices",
        ElementKind::Edge => "edges",
        ElementKind::Face => "faces",
    };
    format!("{selected} of {all} {name}")
}
