//! Requests of panels, menus, keys and tools to the editor. Code that shows the document never changes it: it
//! adds requests, and the editor executes them one after the other.

use std::path::PathBuf;

use trigon_document::{Command, ElementKind, MaterialName, TextureSlot};
use trigon_window::scene::camera::AxisView;
use trigon_window::{Comparison, Refinement, Theme};

use crate::up::Up;

pub(crate) use crate::overlay::GizmoKind;
pub(crate) use crate::tool::{Orientation, Pivot, SnapSource, SnapTarget};

/// One thing to be done.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Request {
    /// Runs a command: one entry in the history.
    Run(Command),
    /// Runs a command instead of the last one.
    Adjust(Command),
    Undo,
    Redo,
    /// Runs the last command that was not a selection again.
    RepeatLast,
    /// Asks for an image file and assigns it to a material.
    ChooseTexture {
        /// Which material.
        material: MaterialName,
        /// What the image says.
        slot: TextureSlot,
    },
    /// Compares the image at rest with the reference, or stops it.
    Compare(Comparison),
    /// Refines the image at rest up to this level.
    Refine(Refinement),
    /// Starts a tool that follows the pointer.
    StartTool(ToolKind),
    /// Changes the view of the document.
    View(ViewRequest),
    /// Opens, saves, closes.
    File(FileRequest),
    /// Changes what the window shows besides the document, and how its tools work.
    Ui(UiRequest),
}

/// The tools that follow the pointer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ToolKind {
    Move,
    Rotate,
    Scale,
    Extrude,
    ExtrudeIndividual,
    Inset,
    Bevel,
    BevelVertices,
    LoopCut,
    Knife,
    EdgeSlide,
    ShrinkFatten,
    PushPull,
    Shear,
    ToSphere,
    Measure,
    SelectBox,
    SelectCircle,
    SelectLasso,
}

/// The view of the document.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum ViewRequest {
    Axis(AxisView),
    /// The same from the other side.
    Opposite,
    ToggleOrthographic,
    /// Shows three sides beside the camera's view, or that alone again.
    ToggleFourViews,
    /// By degrees to the right and up.
    Orbit(f64, f64),
    /// In shares of the image's height to the right and up.
    Pan(f64, f64),
    /// By degrees counter-clockwise.
    Roll(f64),
    /// By a factor.
    Zoom(f64),
    FrameSelected,
    FrameAll,
    /// Shows only what is selected, or all again.
    ToggleLocal,
    /// Looks through the first camera of the scene, or back.
    Camera,
    /// Puts the active camera, or else the first, where the view looks from.
    CameraToView,
    Display(DisplayMode),
    ToggleWireframe,
    /// What colours surfaces in the mode Solid.
    Solid(SolidColor),
    ToggleXRay,
    ToggleOverlays,
    /// Renders an image through the scene's camera.
    Render,
    /// Asks where to write what the view shows.
    Screenshot,
    /// Asks where to write the outlines of faces in the plane of their texture coordinates.
    UvLayout,
}

/// How surfaces are shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum DisplayMode {
    Wireframe,
    /// Plain shading by studio lights.
    #[default]
    Solid,
    /// Everything in clay, whose look depends on the direction of its surface alone.
    Matcap,
    /// Materials and textures in studio lights.
    Textured,
    /// The scene's own lights and effects.
    Rendered,
}

/// What gives surfaces their colours in the mode Solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum SolidColor {
    /// The colour of the material, without images.
    #[default]
    Material,
    /// The material with the image of its base colour.
    Texture,
}

/// An image that is written to a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ImageKind {
    /// What the view shows.
    Screenshot,
    /// What was rendered last.
    Render,
    /// The texture coordinates of what is edited.
    UvLayout,
}

/// What happens to files.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum FileRequest {
    Ask(FileAction),
    Open(PathBuf),
    SaveAs(PathBuf),
    Import(PathBuf),
    Export(PathBuf),
    /// Gives a material an image.
    Texture {
        material: MaterialName,
        slot: TextureSlot,
        path: PathBuf,
    },
    /// Adds an image to the scene, to model after.
    Reference(PathBuf),
    /// Writes an image, in the format that the ending of its name says.
    SaveImage {
        kind: ImageKind,
        path: PathBuf,
    },
}

/// What a menu entry or a key does about files, without a path yet.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FileAction {
    New,
    Open,
    Save,
    SaveAs,
    Import,
    Export,
    /// Asks for an image to model after.
    Reference,
    Quit,
}

/// What goes where the 3D cursor or something else is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Placing {
    CursorToOrigin,
    CursorToSelected,
    CursorToActive,
    CursorToGrid,
    SelectionToCursor,
    SelectionToGrid,
}

/// What the window shows besides the document, and how its tools work.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum UiRequest {
    /// Shows the actions of a menu at the pointer.
    Popup(&'static str),
    Search,
    Help,
    AdjustPanel,
    ToggleEditMode,
    /// Selects elements of a kind, or adds the kind to those that are selected, or removes it.
    Select {
        kind: ElementKind,
        extend: bool,
    },
    /// Extrudes, and then moves what came of it along its normals.
    ExtrudeAlongNormals,
    /// Opens the mesh on the pointer's side of the selection.
    Rip {
        /// Whether faces fill the gap.
        fill: bool,
    },
    /// Projects texture coordinates in the direction of the view.
    ProjectFromView,
    ToolBar,
    SideBar,
    /// Shows or hides texture coordinates beside the view.
    UvView,
    /// Remembers what is selected.
    Copy,
    /// Adds what was copied last.
    Paste,
    /// Moves the 3D cursor, or what is selected to it.
    Placing(Placing),
    /// Puts the origins of objects at the 3D cursor.
    OriginToCursor,
    /// Shows or hides the tab *Development*.
    Development,
    EmulateMouse,
    EmulateNumpad,
    Snapping,
    Snap(SnapTarget),
    SnapWith(SnapSource),
    Proportional,
    Pivot(Pivot),
    Orientation(Orientation),
    Gizmo(Option<GizmoKind>),
    Rename,
    /// Hangs the selected objects on the active one.
    Parent {
        /// Whether they stay where they are in the world.
        keeps_transform: bool,
    },
    /// Selects what hangs together with what is under the pointer.
    LinkedAtPointer,
    /// Shows light or dark panels.
    Theme(Theme),
    /// Shows this axis as up.
    Up(Up),
    LargerText,
    SmallerText,
    NormalText,
}

impl UiRequest {
    /// Whether it leaves the document and its image as they are.
    pub(crate) fn is_about_window(self) -> bool {
        !matches!(
            self,
            Self::ToggleEditMode
                | Self::Select { .. }
                | Self::Rip { .. }
                | Self::ExtrudeAlongNormals
                | Self::ProjectFromView
                | Self::LinkedAtPointer
                | Self::Parent { .. }
                | Self::Paste
                | Self::Placing(_)
                | Self::OriginToCursor
        )
    }
}
