//! The actions that a key or a drag can have.

use trigon_camera::AxisView;
use trigon_math::DVec3;

/// What a key does.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Action {
    /// Shows a named side of the scene, and all of it.
    View(AxisView),
    /// Moves the eye up about the target, by radians.
    Elevate(f64),
    /// Turns the camera about its line of sight, by radians counter-clockwise.
    Roll(f64),
    /// Goes back to the view that the window began with.
    ResetView,
    /// Switches between perspective and parallel lines of sight.
    ToggleOrthographic,
    /// Switches between turntable and trackball.
    ToggleOrbitStyle,
    /// Shows or hides the edges of the polygons.
    ToggleEdges,
    /// Surfaces, wireframe, hidden lines, and again.
    CycleWireframe,
    /// More samples per pixel, and after the most the fewest again.
    CycleSamples,
    /// Shows or hides the list of keys.
    ToggleCheatSheet,
    /// Opens the menu at the pointer.
    OpenMenu,
    /// Puts the object that was moved or turned last back.
    UndoMove,
    /// Moves or turns it again.
    RedoMove,
    /// Fills the screen with the window, or gives it its size back.
    ToggleFullScreen,
    /// Makes text and widgets larger, by this factor.
    ScaleText(f32),
    /// Gives the keyboard to the first widget of the interface; Escape gives it back.
    EnterInterface,
    /// Shows or hides what a frame takes.
    ToggleFrameTime,
    /// Selects the next object.
    SelectNext,
    /// Selects the one before.
    SelectPrevious,
    /// Turns the camera's target to the middle of the selected object.
    LookAtSelected,
    /// Hides the list of keys, or else selects nothing, or else leaves the full screen.
    Dismiss,
    /// Closes the window.
    Quit,
    /// Goes on for as long as the key is down.
    Hold(Motion),
    /// Something of the application's own: [`crate::Handler::command`] gets the
    /// binding's name.
    Command,
}

/// What a key does for as long as it is down. All rates are per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Of the camera.
    Camera(CameraMotion),
    /// Of the selected object.
    Object(ObjectMotion),
}

/// How a held key moves the camera, per second.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum CameraMotion {
    /// About the target: radians to the right and up.
    Orbit(f64, f64),
    /// Over the scene: heights of the image to the right and up.
    Pan(f64, f64),
    /// Closer: natural logarithm of the magnification.
    Zoom(f64),
    /// About its line of sight: radians counter-clockwise.
    Roll(f64),
}

/// How a held key moves the selected object, per second, in axes of the
/// image: x to the right, y up, z towards the viewer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ObjectMotion {
    /// In heights of the image at the camera's target.
    Move(DVec3),
    /// Radians about the object's origin, around each axis.
    Turn(DVec3),
}

/// What a drag of the mouse does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DragAction {
    /// Turns the camera about its target.
    Orbit,
    /// Moves the scene under the pointer.
    Pan,
    /// Turns the image.
    Roll,
    /// Up is closer.
    Zoom,
    /// Up is closer to what was under the pointer.
    ZoomToPointer,
}

/// What a click does: a press and a release at one place.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ClickAction {
    /// Opens the menu there.
    OpenMenu,
    /// Selects the object under the pointer, or nothing.
    Select,
    /// Makes the point under the pointer the camera's target.
    LookAt,
    /// The same, from as near as the point was.
    LookAtFromAsNear,
}
