//! What stands in the middle of the view: how far a load is, what went wrong, a question, and in an empty
//! window how to fill it. All of it is one column, so that nothing covers anything.

use trigon_window::egui::{self, Align2, Area, Context, Id, ProgressBar, ScrollArea, Ui};

/// What is to be told.
pub(super) struct Notices<'a> {
    /// What is being loaded, and how many percent of it are.
    pub(super) loading: Option<(&'a str, u32)>,
    /// What is not shown, and why.
    pub(super) failure: Option<(&'a str, &'a str)>,
    /// So many objects would be put back if the file was loaded again.
    pub(super) moved: Option<usize>,
    /// Whether no model is shown or loaded.
    pub(super) is_empty: bool,
}

/// What a button of them was pressed for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Answer {
    CancelLoading,
    CloseFailure,
    LoadAgain,
    KeepMoved,
    Open,
}

/// What an empty window says.
const EMPTY: &str = "Drop a model here, or press Ctrl+O";

impl Notices<'_> {
    fn is_silent(&self) -> bool {
        self.loading.is_none() && self.failure.is_none() && self.moved.is_none() && !self.is_empty
    }

    /// Shows them in the middle of what no panel covers.
    pub(super) fn show(&self, context: &Context, free: egui::Rect) -> Option<Answer> {
        if self.is_silent() {
            return None;
        }
        let area = Area::new(Id::unique("notices")).fade_in(false).constrain_to(free);
        let area = area.anchor(Align2::CENTER_CENTER, [0.0; 2]);
        let shown = area.show(context, |ui| {
            ui.set_max_width((free.width() - 80.0).clamp(120.0, 480.0));
            let [loading, failure, moved] =
                [self.loading(ui), self.failure(ui, free.height()), self.question(ui)];
            loading.or(failure).or(moved).or(self.empty(ui))
        });
        shown.inner
    }

    fn loading(&self, ui: &mut Ui) -> Option<Answer> {
        let (name, percent) = self.loading?;
        framed(ui, |ui| {
            ui.label(format!("loading {name}"));
            let width = ui.available_width().min(280.0);
            ui.add(
                ProgressBar::new(percent as f32 / 100.0).desired_width(width).text(format!("{percent} %")),
            );
            ui.button("Cancel (Ctrl+.)").clicked().then_some(Answer::CancelLoading)
        })
    }

    fn failure(&self, ui: &mut Ui, height: f32) -> Option<Answer> {
        let (name, text) = self.failure?;
        framed(ui, |ui| {
            ui.strong(format!("{name} is not shown"));
            ScrollArea::vertical().max_height((height - 160.0).max(40.0)).show(ui, |ui| {
                ui.label(text.replace("; ", ".\n"));
            });
            ui.button("Close (Escape)").clicked().then_some(Answer::CloseFailure)
        })
    }

    fn question(&self, ui: &mut Ui) -> Option<Answer> {
        let objects = match self.moved? {
            1 => "1 object was moved and goes".to_owned(),
            count => format!("{count} objects were moved and go"),
        };
        framed(ui, |ui| {
            ui.strong("Load the file again?");
            ui.label(format!("{objects} back to where the file has it."));
            ui.horizontal(|ui| {
                let again = ui.button("Load again (Enter)").clicked().then_some(Answer::LoadAgain);
                again.or(ui.button("Keep (Escape)").clicked().then_some(Answer::KeepMoved))
            })
            .inner
        })
    }

    fn empty(&self, ui: &mut Ui) -> Option<Answer> {
        if !self.is_empty {
            return None;
        }
        framed(ui, |ui| {
            ui.label(EMPTY);
            ui.button("Open…").clicked().then_some(Answer::Open)
        })
    }
}

fn framed(ui: &mut Ui, show: impl FnOnce(&mut Ui) -> Option<Answer>) -> Option<Answer> {
    let frame = egui::Frame::popup(ui.style()).inner_margin(12);
    let answer = frame.show(ui, show).inner;
    ui.add_space(6.0);
    answer
}
