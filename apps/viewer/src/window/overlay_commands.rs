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
}

impl OverlayCommand {
    pub(super) const ALL: [Self; 6] =
        [Self::Tree, Self::Pixel, Self::Effects, Self::StageTimes, Self::Axes, Self::Grid];

    /// Its name in the keymap, its key, and what the cheat sheet says.
    pub(super) fn binding(self) -> (&'static str, Chord, &'static str) {
        let shift = |key| Chord::new(Modifiers::SHIFT, Key::Character(key));
        match self {
            Self::Tree => ("scene.tree", shift('h'), "scene tree: hide, show, select, look at"),
            Self::Pixel => {
                ("pixel.explain", 'i'.into(), "explain the pixel at the pointer; a click, another")
            }
            Self::Effects => ("effects.plan", shift('p'), "effects, and why they are on or off"),
            Self::StageTimes => ("frame_time.stages", shift('z'), "frame time of each stage"),
            Self::Axes => ("axis", 'x'.into(), "directions of the axes"),
            Self::Grid => ("grid", 'g'.into(), "grid below the model"),
        }
    }
}

impl FromStr for OverlayCommand {
    type Err = ();

    fn from_str(name: &str) -> Result<Self, ()> {
        Self::ALL.into_iter().find(|command| command.binding().0 == name).ok_or(())
    }
}
