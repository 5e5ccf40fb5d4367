//! Shared helpers of panel tests: a document, a panel on it, and its requests.

use egui_kittest::kittest::Queryable;
use egui_kittest::{Harness, HarnessBuilder};
use trigon_document::{Command, Document};
use trigon_window::EguiTestRenderer;
use trigon_window::egui::{self, Key, Role, Shape, Ui};

use super::ShownDocument;
use crate::request::Request;
use crate::up::Up;

/// All that a pass of a panel sees.
pub(super) struct Shown<S> {
    pub(super) document: Document,
    pub(super) state: S,
    pub(super) up: Up,
    pub(super) requests: Vec<Request>,
}

/// A panel under test. Requests are done at once, as the editor does them, and kept.
pub(super) struct Case<S: 'static> {
    pub(super) harness: Harness<'static, Shown<S>>,
}

impl<S> Case<S> {
    /// A panel of a size in points, on a document.
    pub(super) fn new(
        size: [f32; 2],
        document: Document,
        state: S,
        panel: impl Fn(&mut Ui, ShownDocument<'_>, &mut S, &mut Vec<Request>) + 'static,
    ) -> Self {
        let builder: HarnessBuilder<Shown<S>> = Harness::builder();
        let builder = builder.with_size(size).with_max_steps(32).renderer(EguiTestRenderer::default());
        let show = move |ui: &mut Ui, shown: &mut Shown<S>| {
            let mut requests = Vec::new();
            let subject = ShownDocument { document: &shown.document, up: shown.up };
            panel(ui, subject, &mut shown.state, &mut requests);
            requests.iter().for_each(|request| apply(&mut shown.document, request));
            shown.requests.extend(requests);
        };
        let mut harness =
            builder.build_ui_state(show, Shown { document, state, up: Up::Y, requests: Vec::new() });
        harness.run();
        Self { harness }
    }

    pub(super) fn run(&mut self) {
        self.harness.run();
    }

    pub(super) fn document(&mut self) -> &mut Document {
        &mut self.harness.state_mut().document
    }

    pub(super) fn take_requests(&mut self) -> Vec<Request> {
        std::mem::take(&mut self.harness.state_mut().requests)
    }

    /// Runs a command beside the panel.
    pub(super) fn command(&mut self, json: serde_json::Value) {
        let command: Command = serde_json::from_value(json).expect("a command");
        self.document().run(command).expect("it can be done");
        self.run();
    }

    /// Clicks what has a name.
    pub(super) fn click(&mut self, label: &str) {
        self.harness.get_by_label(label).click();
        self.run();
    }

    /// Types a number into a field with a name.
    pub(super) fn type_number(&mut self, label: &str, text: &str) {
        self.harness.get_by_role_and_label(Role::SpinButton, label).click();
        self.run();
        self.harness.event(egui::Event::Text(text.to_owned()));
        self.run();
        self.harness.key_press(Key::Enter);
        self.run();
    }

    /// Chooses from a list with a name.
    pub(super) fn choose(&mut self, label: &str, choice: &str) {
        self.harness.get_by_role_and_label(Role::ComboBox, label).click();
        self.run();
        // The list lies over what else has this name.
        self.harness.get_all_by_label(choice).last().expect("the list is open").click();
        self.run();
    }

    /// Whether all text has to be visible.
    pub(super) fn assert_nothing_is_clipped(&self) {
        let width = self.harness.ctx.content_rect().width();
        for clipped in &self.harness.output().shapes {
            let Shape::Text(text) = &clipped.shape else { continue };
            // Nothing has no position.
            if text.galley.text().trim().is_empty() {
                continue;
            }
            let rect = text.visual_bounding_rect();
            let (left, right) = (clipped.clip_rect.left().max(0.0), clipped.clip_rect.right().min(width));
            let is_within = rect.left() >= left - 0.5 && rect.right() <= right + 0.5;
            assert!(is_within && !text.galley.elided, "{:?} at {rect:?} is clipped", text.galley.text());
        }
    }

    /// `TRIGON_IMAGES=folder` writes what the panel looks like, to be looked at.
    pub(super) fn image(&mut self, name: &str) {
        if let Some(folder) = std::env::var_os("TRIGON_IMAGES") {
            let path = std::path::Path::new(&folder).join(format!("{name}.png"));
            self.harness.render().expect("it can be drawn").save(path).expect("the folder exists");
        }
    }
}

/// As the editor does.
fn apply(document: &mut Document, request: &Request) {
    match request {
        Request::Run(command) => drop(document.run(command.clone())),
        Request::Adjust(command) => drop(document.adjust_last(command.clone())),
        Request::Undo => drop(document.undo()),
        Request::Redo => drop(document.redo()),
        _ => {}
    }
}
