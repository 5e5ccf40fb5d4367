//! Axis and plane locks, as in Blender: X, Shift+X, the key once more for other axes and once more for none,
//! C for none, the middle button for the nearest axis. Here are also the kinds of transforms.

use trigon_document::mesh::math::{DMat3, DVec2, DVec3};

use super::view::ToolView;

/// In whose axes a tool works.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum Orientation {
    /// The world's.
    #[default]
    Global,
    /// Those of the object that was selected last.
    Local,
    /// z along the mean normal of what is selected.
    Normal,
    /// Right, up and towards the viewer.
    View,
}

/// One of three axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Axis {
    X,
    Y,
    Z,
}

impl Axis {
    pub(crate) const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// The axis of a key.
    pub(crate) fn of_key(key: char) -> Option<Self> {
        Self::ALL.into_iter().find(|axis| axis.letter().eq_ignore_ascii_case(&key))
    }

    pub(crate) fn letter(self) -> char {
        ['X', 'Y', 'Z'][self.index()]
    }

    pub(crate) fn index(self) -> usize {
        self as usize
    }
}

/// What is left free.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Freedom {
    /// Only this axis.
    Along(Axis),
    /// The other two axes.
    Across(Axis),
}

impl Freedom {
    pub(crate) fn axis(self) -> Axis {
        match self {
            Self::Along(axis) | Self::Across(axis) => axis,
        }
    }
}

/// The axes that a tool may be locked to, in columns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frames {
    /// The chosen orientation.
    pub(crate) chosen: DMat3,
    /// What the second press of a key means: the world's, or the object's where the world's are chosen.
    pub(crate) other: DMat3,
    /// Their names, for the status line.
    pub(crate) names: [&'static str; 2],
}

impl Frames {
    /// The axes of an orientation for a selection with these own axes and normals.
    pub(crate) fn new(orientation: Orientation, local: DMat3, normal: DMat3, view: &ToolView) -> Self {
        let camera = &view.camera;
        let axes = view.up.axes();
        let (global, local) = ((axes, "global"), (local * axes, "local"));
        let (chosen, name) = match orientation {
            Orientation::Global => global,
            Orientation::Local => local,
            Orientation::Normal => (normal, "normal"),
            Orientation::View => {
                (DMat3::from_cols(camera.right(), camera.up(), view.towards_viewer()), "view")
            }
        };
        let (other, other_name) = if orientation == Orientation::Global { local } else { global };
        Self { chosen, other, names: [name, other_name] }
    }
}

/// A lock, if there is one.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Constraint {
    lock: Option<Lock>,
}

#[derive(Debug, Clone, Copy, PartialEq)]
struct Lock {
    freedom: Freedom,
    in_other: bool,
}

impl Constraint {
    /// Locks by a key: the same one again changes the axes, and then ends the lock.
    pub(crate) fn press(&mut self, freedom: Freedom) {
        self.lock = match self.lock {
            Some(lock) if lock.freedom == freedom => {
                (!lock.in_other).then_some(Lock { in_other: true, ..lock })
            }
            _ => Some(Lock { freedom, in_other: false }),
        };
    }

    /// Locks to an axis or plane of the chosen orientation, or to none.
    pub(crate) fn set(&mut self, freedom: Option<Freedom>) {
        self.lock = freedom.map(|freedom| Lock { freedom, in_other: false });
    }

    pub(crate) fn clear(&mut self) {
        self.lock = None;
    }

    /// What is left free.
    pub(crate) fn freedom(&self) -> Option<Freedom> {
        self.lock.map(|lock| lock.freedom)
    }

    /// The axes that count.
    pub(crate) fn axes(&self, frames: &Frames) -> DMat3 {
        if self.lock.is_some_and(|lock| lock.in_other) { frames.other } else { frames.chosen }
    }

    /// The axis that is free or, of a plane, the one that is not; unit length.
    pub(crate) fn axis(&self, frames: &Frames) -> Option<DVec3> {
        let axis = self.freedom()?.axis();
        Some(self.axes(frames).col(axis.index()).normalize_or(DVec3::AXES[axis.index()]))
    }

    /// As "along global X".
    pub(crate) fn status(&self, frames: &Frames) -> String {
        let Some(lock) = self.lock else { return String::new() };
        let name = frames.names[usize::from(lock.in_other)];
        match lock.freedom {
            Freedom::Along(axis) => format!(" along {name} {}", axis.letter()),
            Freedom::Across(axis) => format!(" in the plane across {name} {}", axis.letter()),
        }
    }
}

/// The axis of which the image runs most nearly as the pointer went; `None` where it hardly moved.
pub(crate) fn nearest_axis(view: &ToolView, point: DVec3, axes: &DMat3, way: DVec2) -> Option<Axis> {
    /// In logical pixels: less is a hand that trembles.
    const LEAST: f64 = 4.0;
    if way.length() < LEAST * view.scale {
        return None;
    }
    let center = view.screen(point)?;
    // A step of one pixel, so that it stays in front of the eye.
    let step = view.metres_per_pixel(point);
    let alike = |axis: &Axis| {
        let end = view.screen(point + axes.col(axis.index()) * step);
        // Axes towards the viewer have hardly any direction in the image; their length shows it.
        end.map_or(0.0, |end| (end - center).dot(way).abs())
    };
    Axis::ALL.into_iter().max_by(|a, b| alike(a).total_cmp(&alike(b)))
}

/// What a transform does to the selection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum TransformKind {
    Translate,
    Rotate,
    /// Turns about both axes of the image.
    Trackball,
    Scale,
    ShrinkFatten,
    /// Away from the middle.
    PushPull,
    ToSphere,
    /// Along edges; a tool that starts so needs [`TransformTool::sliding`](super::TransformTool::sliding).
    Slide,
}

impl TransformKind {
    /// In the status line before anything has moved.
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Translate => "Move",
            Self::Rotate => "Rotate",
            Self::Trackball => "Trackball",
            Self::Scale => "Scale",
            Self::ShrinkFatten => "Shrink/Fatten",
            Self::PushPull => "Push/Pull",
            Self::ToSphere => "To Sphere",
            Self::Slide => "Slide",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::view::tests::front;
    use super::*;

    fn frames(orientation: Orientation) -> Frames {
        let local = DMat3::from_cols(DVec3::Y, DVec3::Z, DVec3::X);
        let normal = DMat3::from_cols(DVec3::Z, DVec3::X, DVec3::Y);
        Frames::new(orientation, local, normal, &front())
    }

    #[test]
    fn a_key_locks_then_changes_the_axes_then_ends_the_lock() {
        for (orientation, first, second) in [
            (Orientation::Global, DVec3::X, DVec3::Y),
            (Orientation::Local, DVec3::Y, DVec3::X),
            (Orientation::Normal, DVec3::Z, DVec3::X),
            (Orientation::View, DVec3::X, DVec3::X),
        ] {
            let (frames, mut lock) = (frames(orientation), Constraint::default());
            let along = Freedom::Along(Axis::X);
            lock.press(along);
            assert_eq!(lock.axis(&frames), Some(first), "{orientation:?}: the chosen axes");
            lock.press(along);
            assert_eq!(lock.axis(&frames), Some(second), "{orientation:?}: the others");
            lock.press(along);
            assert_eq!(lock.axis(&frames), None, "{orientation:?}: none");
        }
    }

    #[test]
    fn another_key_starts_anew() {
        let mut lock = Constraint::default();
        lock.press(Freedom::Along(Axis::X));
        lock.press(Freedom::Along(Axis::X));
        lock.press(Freedom::Across(Axis::X));
        assert_eq!(lock.status(&frames(Orientation::Global)), " in the plane across global X", "a plane");
        lock.press(Freedom::Along(Axis::Z));
        assert_eq!(lock.status(&frames(Orientation::Local)), " along local Z", "another axis");
        lock.clear();
        assert_eq!((lock.freedom(), lock.status(&frames(Orientation::Local)).as_str()), (None, ""), "C");
    }

    #[test]
    fn the_pointer_picks_the_axis_along_which_it_goes() {
        let (view, axes) = (front(), DMat3::IDENTITY);
        let pick = |x, y| nearest_axis(&view, DVec3::ZERO, &axes, DVec2::new(x, y));
        assert_eq!(pick(-50.0, 10.0), Some(Axis::X), "leftwards");
        assert_eq!(pick(10.0, 50.0), Some(Axis::Y), "downwards");
        assert_eq!(pick(1.0, 1.0), None, "hardly moved");
    }
}
