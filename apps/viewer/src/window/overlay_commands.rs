//! The keys of what is shown over the picture and beside it.

use std::str::FromStr;

use trigon_window::{Chord, Key, Modifiers};

/// What the keys of panels and overlays do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum OverlayCommand {
    Tree,
    Pixel,
    Effects,
    StageTimes,
    Axes,
    Grid,
    Displays,
    NextDisplay,
    PreviousDisplay,
    Matcap,
    Depth,
    Measure,
    Copy,
    SaveState,
    LoadState,
    Blink,
    Heat,
}

impl OverlayCommand {
    pub(super) const ALL: [Self; 17] = [
        Self::Tree,
        Self::Pixel,
        Self::Effects,
        Self::StageTimes,
        Self::Axes,
        Self::Grid,
        Self::Displays,
        Self::NextDisplay,
        Self::PreviousDisplay,
        Self::Matcap,
        Self::Depth,
        Self::Measure,
        Self::Copy,
        Self::SaveState,
        Self::LoadState,
        Self::Blink,
        Self::Heat,
    ];

    /// Its name in the keymap, its key, and what the cheat sheet says.
    pub(super) fn binding(self) -> (&'static str, Chord, &'static str) {
        let shift = |key| Chord::new(Modifiers::SHIFT, Key::Character(key));
        let ctrl = |key| Chord::new(Modifiers::CTRL, Key::Character(key));
        match self {
            Self::Tree => ("scene.tree", shift('h'), "scene tree: hide, show, select, look at"),
            Self::Pixel => {
                ("pixel.explain", 'i'.into(), "explain the pixel at the pointer; a click, another")
            }
            Self::Effects => ("effects.plan", shift('p'), "effects, and why they are on or off"),
            Self::StageTimes => ("frame_time.stages", shift('z'), "frame time of each stage"),
            Self::Axes => ("axis", 'x'.into(), "directions of the axes"),
            Self::Grid => ("grid", 'g'.into(), "grid below the model"),
            Self::Displays => ("display", 'v'.into(), "what faces show: materials, values of them, depth"),
            Self::NextDisplay => ("display.next", 'c'.into(), "the next, the one before"),
            Self::PreviousDisplay => ("display.previous", shift('c'), "the next, the one before"),
            Self::Matcap => ("display.matcap", shift('m'), "one clay for all (matcap)"),
            Self::Measure => ("measure", 'r'.into(), "measure: clicks snap to vertices, edges and faces"),
            Self::Depth => ("display.depth", ctrl('d'), "depth in grey"),
            Self::Copy => ("command.copy", ctrl('c'), "copy the command line that draws this picture"),
            Self::SaveState => ("state.save", ctrl('s'), "save, load files, camera and settings"),
            Self::Blink => ("compare.blink", 'b'.into(), "with --compare: one model, the other"),
            Self::Heat => ("compare.heat", shift('b'), "with --compare: where they differ, side by side"),
            Self::LoadState => ("state.load", ctrl('l'), "save, load files, camera and settings"),
        }
    }
}

impl FromStr for OverlayCommand {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|command| command.binding().0 == name).ok_or(())
    }
}
