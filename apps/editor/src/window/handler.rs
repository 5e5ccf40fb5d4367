//! The editor's callbacks for the window.

use std::path::PathBuf;

use trigon_window::scene::Frame;
use trigon_window::scene::camera::Projector;
use trigon_window::scene::math::DVec2;
use trigon_window::{Chord, Handler, Hands, Input, Key, Modifiers, PointerButton, Stage, Taken, egui};

use super::actions::CONTEXT_MENU;
use super::button_start::Click;
use super::dropped::is_image;
use super::editor::{Editor, Message};
use super::loading::Loading;
use super::loading::Saving;
use super::open_file::{Answer, Next, Question};
use super::panes::pane_of;
use super::pointing::Prefetch;
use super::popup::Popup;
use super::running::Running;
use super::{files, interface, pick};
use crate::request::{FileAction, FileRequest, Request};

impl Handler for Editor {
    fn start(&mut self, stage: &mut Stage) {
        self.apply_preferences(stage);
        self.begin(stage);
        self.show(stage);
    }

    fn input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        self.pointer = hands.pointer.or(self.pointer);
        let taken = match self.tool {
            Some(_) => self.tool_input(stage, input, hands),
            None => self.own_input(stage, input, hands),
        };
        stage.wraps_pointer = self.tool.as_ref().is_some_and(Running::goes_on_beyond_borders);
        taken
    }

    fn pointer_jumped(&mut self, stage: &mut Stage, to: DVec2) {
        self.pointer = Some(to);
        if let Some(running) = &mut self.tool {
            let pane = pane_of(stage, running.side());
            running.pointer_jumped(to - pane.area.origin());
        }
    }

    fn interface(&mut self, stage: &mut Stage, ui: &mut egui::Ui) {
        let requests = interface::show(self, stage, ui);
        for request in requests {
            self.perform(stage, request);
            ui.ctx().request_repaint();
        }
    }

    fn dropped(&mut self, stage: &mut Stage, paths: Vec<PathBuf>, modifiers: Modifiers) {
        self.cancel_tool(stage);
        let (images, models): (Vec<_>, Vec<_>) = paths.into_iter().partition(|path| is_image(path));
        // Several are added to the scene, as is one with Shift.
        let imports = modifiers.contains(Modifiers::SHIFT) || models.len() > 1;
        for path in models {
            let request = if imports { FileRequest::Import(path) } else { FileRequest::Open(path) };
            self.perform(stage, Request::File(request));
        }
        for path in images {
            self.drop_image(stage, path);
        }
    }

    fn woken(&mut self, stage: &mut Stage) {
        if let Some(outcome) = self.loading.as_ref().and_then(Loading::outcome)
            && let Some(loading) = self.loading.take()
        {
            self.loaded(stage, &loading.path, loading.version, outcome);
        }
        if let Some(outcome) = self.saving.as_ref().and_then(Saving::outcome) {
            self.saved(stage, outcome);
        }
        self.collect_images();
        if let Some(request) = self.dialog.picked() {
            self.perform(stage, Request::File(request));
        }
    }

    fn image(&mut self, stage: &mut Stage, frame: Frame) {
        self.screenshot_taken(stage, frame);
    }

    fn close_requested(&mut self, stage: &mut Stage) {
        self.cancel_tool(stage);
        self.perform(stage, Request::File(FileRequest::Ask(FileAction::Quit)));
    }
}

impl Editor {
    /// An input while no tool runs.
    fn own_input(&mut self, stage: &mut Stage, input: &Input, hands: Hands) -> Taken {
        match *input {
            Input::Key { logical, physical, repeat: false } => self.key(stage, hands, [logical, physical]),
            Input::Pressed(PointerButton::Left) => self.pressed(stage, hands),
            Input::PointerMoved => self.pointer_moved(stage, hands),
            Input::Released(PointerButton::Left) => self.released(stage),
            Input::Clicked(PointerButton::Left) => self.clicked(stage, hands),
            Input::Clicked(PointerButton::Right) if hands.modifiers.contains(Modifiers::SHIFT) => {
                self.place_cursor(stage, hands)
            }
            Input::Clicked(PointerButton::Right) => {
                self.popup = Some(Popup::new(CONTEXT_MENU));
                Taken::Yes
            }
            Input::FocusLost => {
                self.click = None;
                Taken::No
            }
            Input::FocusGained => {
                self.notice_others();
                Taken::No
            }
            _ => Taken::No,
        }
    }

    fn begin(&mut self, stage: &mut Stage) {
        let mut files = std::mem::take(&mut self.to_open).into_iter();
        match files.next() {
            Some(first) => self.go_on(stage, Next::Open(first)),
            None if !self.document.nodes().nodes().is_empty() => self.look_at_all(stage),
            None => self.go_on(stage, Next::New),
        }
        files.for_each(|file| self.file_request(stage, FileRequest::Import(file)));
        if self.question.is_none() {
            self.question = files::offer_recovery(self.recovery_folder.as_deref());
        }
        if self.question.is_none() && self.preferences.asks_for_up() {
            self.question = Some(Question::Up);
        }
        if let Some(damaged) = files::damaged_recovery(self.recovery_folder.as_deref()) {
            self.message = Message::Refusal(damaged);
        }
        let more = self.notes.len().saturating_sub(1);
        if let Some(note) = self.notes.first() {
            let others = if more == 0 { String::new() } else { format!(" (and {more} more)") };
            self.message = Message::Refusal(format!("{note}{others}"));
        }
    }

    fn key(&mut self, stage: &mut Stage, hands: Hands, keys: [Option<Key>; 2]) -> Taken {
        if self.loading.is_some() || self.closes_after_save() {
            // What was done now would be lost.
            return Taken::Yes;
        }
        if self.question.is_some() {
            if keys[0] == Some(Key::Escape) {
                self.answer(stage, Answer::Cancel);
            }
            return Taken::Yes;
        }
        if keys[0] == Some(Key::Escape) && self.dismiss() {
            return Taken::Yes;
        }
        if let (Some(popup), Some(Key::Character(letter))) = (&mut self.popup, keys[0])
            && !hands.modifiers.contains(Modifiers::CTRL)
        {
            // The menu may not be shown yet: what was typed meanwhile is for it.
            if let Some(action) = popup.typed(&letter.to_string(), &self.document) {
                self.popup = None;
                self.choose(stage, action);
            }
            return Taken::Yes;
        }
        if self.is_typing() && !hands.modifiers.contains(Modifiers::CTRL) {
            // The field may have no focus yet: what was typed meanwhile is text, and no action.
            return Taken::No;
        }
        let is_editing = self.document.selection().is_editing();
        let mut chords = keys.into_iter().flatten().map(|key| Chord::new(hands.modifiers, key));
        let over_uvs = chords.clone().find_map(|chord| self.key_over_uvs(stage, chord));
        let found = over_uvs.or_else(|| chords.find_map(|chord| self.keys.find(chord, is_editing)));
        let Some(action) = found else {
            if let Some(key @ Key::Character(_)) = keys[0] {
                let chord = Chord::new(hands.modifiers, key);
                self.message = Message::Refusal(format!("{chord} does nothing here; F3 finds every command"));
            }
            return Taken::No;
        };
        if self.refuses_over_uvs(stage, action) {
            return Taken::Yes;
        }
        self.choose(stage, action);
        if let Some(tool) = &mut self.tool {
            tool.follow_at_once();
        }
        Taken::Yes
    }

    /// Whether a window is open whose field takes what is typed.
    fn is_typing(&self) -> bool {
        self.search.is_some() || self.dialog.is_open()
    }

    /// Closes what is open over the view; returns whether anything was.
    fn dismiss(&mut self) -> bool {
        let was_open =
            self.popup.is_some() || self.search.is_some() || self.report.is_some() || self.layout.help;
        (self.popup, self.search, self.report, self.layout.help) = (None, None, None, false);
        let was_open = was_open | self.dialog.close() | self.rename.take().is_some();
        was_open || self.images.leave()
    }

    fn pressed(&mut self, stage: &mut Stage, hands: Hands) -> Taken {
        if self.popup.take().is_some() {
            return Taken::Yes;
        }
        if self.preferences.get().emulates_mouse && hands.modifiers.contains(Modifiers::ALT) {
            // A drag moves the camera, and a click is reported as such.
            return Taken::No;
        }
        if !self.press_gizmo(stage, hands) {
            self.click = Click::new(hands);
            if let Some(Click { at, .. }) = self.click {
                self.pointing.prefetch(stage, &stage.pane_at(at), Prefetch::Ids);
            }
        }
        Taken::Yes
    }

    /// A press that becomes a drag draws a box, or with Ctrl a lasso.
    fn pointer_moved(&mut self, stage: &mut Stage, hands: Hands) -> Taken {
        let Some(click) = self.click else { return Taken::No };
        if click.is_drag(hands, stage.scale()) {
            self.click = None;
            self.drag_region(stage, click, hands);
        }
        Taken::Yes
    }

    fn released(&mut self, stage: &mut Stage) -> Taken {
        if let Some(Click { at, modifiers }) = self.click.take() {
            pick::click(self, stage, at, modifiers);
        }
        Taken::Yes
    }

    fn clicked(&mut self, stage: &mut Stage, hands: Hands) -> Taken {
        if let Some(at) = hands.pointer {
            pick::click(self, stage, at, hands.modifiers);
        }
        Taken::Yes
    }

    /// The 3D cursor goes to the surface under the pointer, or as far away as what the view turns around.
    fn place_cursor(&mut self, stage: &mut Stage, hands: Hands) -> Taken {
        let Some(at) = hands.pointer else { return Taken::No };
        let beside = || {
            let pane = stage.pane_at(at);
            let projector = Projector::new(&stage.camera_of(&pane), pane.area.size);
            projector.at_distance(at - pane.area.origin(), stage.orbit.distance())
        };
        let Some(position) = stage.pick(at).map(|(_, position)| position).or_else(beside) else {
            return Taken::No;
        };
        self.tools.cursor = position;
        Taken::Yes
    }
}
