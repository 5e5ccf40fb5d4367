//! Region selection: box, circle and lasso, as state machines.

#[cfg(test)]
mod tests;

use trigon_document::mesh::math::{DVec2, elementary};
use trigon_document::scene::Region;
use trigon_window::{Hands, Input, Key, Modifiers, PointerButton};

/// What becomes of what was selected before.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RegionMode {
    /// It is selected no more.
    Set,
    /// It stays selected.
    Extend,
    /// What is in the region is selected no more.
    Subtract,
    /// Only what is in the region stays selected.
    Intersect,
}

/// Which gesture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum GestureKind {
    /// Dragged from corner to corner.
    Box,
    /// Painted with a circle, until it is ended.
    Circle,
    /// Drawn freely.
    Lasso,
}

/// What an input did.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum GestureState {
    /// It continues.
    Running,
    /// Selects this; a circle continues afterwards.
    Selects(Region, RegionMode),
    /// It is over, with what the last region selects, if there is one.
    Ended(Option<(Region, RegionMode)>),
}

/// A gesture that runs.
#[derive(Debug, Clone)]
pub(crate) struct Gesture {
    kind: GestureKind,
    /// Where the pointer is.
    position: DVec2,
    /// The button that draws, and how it selects.
    drawing: Option<(PointerButton, RegionMode)>,
    /// Where a box began, or all places of a lasso.
    points: Vec<DVec2>,
    /// In physical pixels.
    radius: f64,
    /// Whether Space is down: a box moves as a whole.
    is_moving: bool,
}

/// A circle's first radius, and the least and the most, in logical pixels.
const RADIUS: f64 = 25.0;
const RADII: [f64; 2] = [1.0, 1000.0];
/// A lasso records a point each time the pointer has moved this far, in pixels, and at most this many points.
const LASSO_STEP: f64 = 2.0;
const LASSO_POINTS: usize = 20_000;

impl Gesture {
    /// Starts to wait for a press. `scale` is physical pixels per logical one.
    pub(crate) fn waiting(kind: GestureKind, hands: Hands, scale: f64) -> Self {
        let position = hands.pointer.unwrap_or(DVec2::ZERO);
        let (points, radius) = (Vec::new(), RADIUS * scale);
        Self { kind, position, drawing: None, points, radius, is_moving: false }
    }

    /// Starts with a button that is held already: dragged without a key before.
    pub(crate) fn drawing(kind: GestureKind, button: PointerButton, hands: Hands, scale: f64) -> Self {
        let mut gesture = Self::waiting(kind, hands, scale);
        // Of Ctrl with the left button a user expects a lasso, not less of a selection.
        let is_lasso = kind == GestureKind::Lasso && !hands.modifiers.contains(Modifiers::SHIFT);
        let mode = if is_lasso { RegionMode::Set } else { mode_of(button, hands.modifiers) };
        gesture.press(button, mode);
        gesture
    }

    fn press(&mut self, button: PointerButton, mode: RegionMode) {
        self.drawing = Some((button, mode));
        self.points = vec![self.position];
    }

    /// Takes an input.
    pub(crate) fn input(&mut self, input: &Input, hands: Hands) -> GestureState {
        match *input {
            Input::PointerMoved => return self.moved(hands.pointer),
            Input::Pressed(PointerButton::Right) | Input::FocusLost => return GestureState::Ended(None),
            Input::Pressed(button) if self.drawing.is_none() => {
                self.press(button, mode_of(button, hands.modifiers));
                if self.kind == GestureKind::Circle {
                    return self.selects();
                }
            }
            Input::Released(button) if self.drawing.is_some_and(|(drawing, _)| drawing == button) => {
                return self.released();
            }
            Input::Wheel(lines) if self.kind == GestureKind::Circle => {
                let radius = self.radius * elementary::pow(1.1, -lines);
                self.radius = radius.clamp(RADII[0], RADII[1]);
            }
            Input::Key { logical: Some(key), .. } => return self.key(key),
            Input::KeyReleased { logical: Some(Key::Space), .. } => self.is_moving = false,
            _ => {}
        }
        GestureState::Running
    }

    fn key(&mut self, key: Key) -> GestureState {
        match key {
            Key::Escape => return GestureState::Ended(None),
            Key::Enter if self.kind == GestureKind::Circle => return GestureState::Ended(None),
            Key::Space if self.drawing.is_some() => self.is_moving = true,
            _ => {}
        }
        GestureState::Running
    }

    fn moved(&mut self, to: Option<DVec2>) -> GestureState {
        let Some(to) = to else { return GestureState::Running };
        let from = std::mem::replace(&mut self.position, to);
        if self.drawing.is_none() {
            return GestureState::Running;
        }
        if self.is_moving {
            self.points.iter_mut().for_each(|point| *point += to - from);
            return GestureState::Running;
        }
        match self.kind {
            GestureKind::Circle => return self.selects(),
            GestureKind::Lasso => self.extend_lasso(),
            GestureKind::Box => {}
        }
        GestureState::Running
    }

    fn extend_lasso(&mut self) {
        let is_far = self.points.last().is_none_or(|last| last.distance(self.position) >= LASSO_STEP);
        if is_far && self.points.len() < LASSO_POINTS {
            self.points.push(self.position);
        }
    }

    fn released(&mut self) -> GestureState {
        if self.kind == GestureKind::Circle {
            // The next press of a circle adds to what this one selected.
            self.drawing = None;
            return GestureState::Running;
        }
        let selects = self.drawing.map(|(_, mode)| (self.region(), mode));
        GestureState::Ended(selects)
    }

    fn selects(&self) -> GestureState {
        let Some((_, mode)) = self.drawing else { return GestureState::Running };
        // A circle paints: what it passed stays selected.
        let mode = if mode == RegionMode::Set { RegionMode::Extend } else { mode };
        GestureState::Selects(self.region(), mode)
    }

    /// The region as it is now.
    fn region(&self) -> Region {
        let start = self.points.first().copied().unwrap_or(self.position);
        match self.kind {
            GestureKind::Box => {
                Region::Rectangle { min: start.min(self.position), max: start.max(self.position) }
            }
            GestureKind::Circle => Region::Circle { center: self.position, radius: self.radius },
            GestureKind::Lasso => Region::Lasso(self.points.clone()),
        }
    }

    /// The region to be drawn; `None` while there is none. A circle is shown before it paints.
    pub(crate) fn shown(&self) -> Option<Region> {
        let is_shown = self.drawing.is_some() || self.kind == GestureKind::Circle;
        is_shown.then(|| self.region())
    }

    /// A line for the status bar.
    pub(crate) fn status(&self) -> &'static str {
        match self.kind {
            GestureKind::Box => {
                "Box: drag to select, Shift: extend, Ctrl or middle button: subtract, Shift+Ctrl: intersect, Space: \
                 move the box"
            }
            GestureKind::Circle => {
                "Circle: paint to select, Shift or middle button: subtract, wheel: size, Enter: done"
            }
            GestureKind::Lasso => "Lasso: draw around what to select, Shift: extend, Shift+Ctrl: subtract",
        }
    }
}

/// Modifiers as in Blender.
fn mode_of(button: PointerButton, modifiers: Modifiers) -> RegionMode {
    let [shift, ctrl] = [Modifiers::SHIFT, Modifiers::CTRL].map(|modifier| modifiers.contains(modifier));
    match (button, shift, ctrl) {
        (PointerButton::Left, true, true) => RegionMode::Intersect,
        (PointerButton::Left, false, false) => RegionMode::Set,
        (PointerButton::Left, true, false) => RegionMode::Extend,
        _ => RegionMode::Subtract,
    }
}
