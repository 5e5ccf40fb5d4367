//! Commands as data: what was done, with all its parameters, so that it can be written down, run
//! again, and adjusted.
//!
//! A command is one variant of [`Command`] and one file with its parameters and what it does.
//! Its description, for scripts and for the documentation, is made from the comments of its
//! parameters.

mod action;
mod apply_transform;
mod bevel;
mod camera;
mod clear_transform;
mod cut;
mod delete;
mod dissolve;
mod extrude;
mod grid_fill;
mod hierarchy;
mod import;
mod join;
mod knife;
mod marks;
mod material;
mod merge;
mod mirror;
mod mode;
mod normals;
mod objects;
mod outcome;
mod parts;
mod place;
mod reference;
mod repair;
mod rotation;
mod scale;
mod scene;
mod select;
mod select_elements;
mod select_property;
mod select_related;
mod select_within;
mod set_light;
mod set_transform;
mod shape;
mod space;
mod subdivision;
mod surface;
mod texture;
mod texture_slot;
mod transform;
mod uvs;
mod visibility;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) use action::Action;
pub use apply_transform::ApplyTransform;
pub use bevel::Bevel;
pub use camera::AddCamera;
pub use clear_transform::ClearTransform;
pub use cut::{LoopCut, SlideEdges, SlideVertices, Subdivide, edge_towards};
pub use delete::{Delete, DeleteObjects, Deleted};
pub use dissolve::{Dissolve, DissolveFlat};
pub use extrude::{Extrude, Inset, InsetMode};
pub use grid_fill::GridFill;
pub use hierarchy::{ReorderObject, SetParent};
pub use import::ImportFile;
pub use join::JoinObjects;
pub use knife::{Knife, PathPoint};
pub use marks::{AssignMaterial, Crease, Hide, MarkSeam, MarkSharp, Reveal, Shade};
pub use material::{AddMaterial, MaterialName, SetMaterial, SetMaterialSlot, SurfaceAlpha, SurfaceShading};
pub use merge::{Merge, MergeAt};
pub use mirror::{Mirror, MirrorPlane, Symmetrize};
pub use mode::{EditObjects, LeaveEditMode, SetElementKind};
pub use normals::{FlipNormals, RecalculateNormals};
pub use objects::ObjectName;
pub use outcome::Outcome;
pub use parts::{Duplicate, Separate, SplitOff};
pub use place::{Rotate, Translate};
pub use reference::{command_reference, command_schema};
pub use repair::Repair;
pub use rotation::Rotation;
pub use scale::Scale;
pub use scene::{AddEmpty, AddLight, AddObject, DuplicateObjects, LightShape, RenameObject, ShowObjects};
pub use select::{Select, SelectAction, SelectAll, SelectInverse, SelectNone};
pub use select_elements::{ElementsOf, SelectElements};
pub use select_property::{
    SelectBorder, SelectByMaterial, SelectByNormal, SelectNonManifold, SelectSharp, SelectSimilar,
};
pub use select_related::{SelectLess, SelectLinked, SelectLoop, SelectMore, SelectPath, SelectRing};
pub use select_within::SelectWithin;
pub use set_light::SetLight;
pub use set_transform::SetTransform;
pub use shape::Shape;
pub use space::TransformSpace;
pub use subdivision::{ApplySubdivision, SetSubdivision};
pub use surface::{Bridge, CatmullClark, ConnectVertices, Fill, Triangulate, TrisToQuads};
pub use texture::{AssignTexture, TextureSource};
pub use texture_slot::TextureSlot;
pub use transform::{
    Proportional, ProportionalShape, PushPull, ResetVertices, Shear, ShrinkFatten, ToSphere,
};
pub use uvs::{ProjectUvs, ProjectUvsOnBox};
pub use visibility::{HideOthers, RevealObjects};

/// Lists all commands: variant, type, name for people.
macro_rules! commands {
    ($($(#[$doc:meta])* $variant:ident($name:literal, $selects:literal)),* $(,)?) => {
        /// A command with its parameters. In JSON an object whose `op` is the command's name in lower
        /// case with underscores, as `{ "op": "select_all" }`; parameters that are not
        /// given have their defaults, unknown ones are refused.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "op", rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum Command {
            $($(#[$doc])* $variant($variant)),*
        }

        impl Command {
            /// What a user sees in menus and in the history.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name),*
                }
            }

            /// Whether it changes only what is selected.
            #[must_use]
            pub fn is_selection(&self) -> bool {
                match self {
                    $(Self::$variant(_) => $selects),*
                }
            }

            pub(crate) fn action(&self) -> &dyn Action {
                match self {
                    $(Self::$variant(command) => command),*
                }
            }
        }

        $(impl From<$variant> for Command {
            fn from(command: $variant) -> Self {
                Self::$variant(command)
            }
        })*
    };
}

commands! {
    /// Starts to edit the meshes of objects.
    EditObjects("Edit Mode", true),
    /// Goes back to whole objects.
    LeaveEditMode("Object Mode", true),
    /// Selects vertices, edges or faces from now on.
    SetElementKind("Select Mode", true),
    /// Selects, adds to or takes from what is selected.
    Select("Select", true),
    /// Selects many elements of objects at once.
    SelectElements("Select Region", true),
    /// Selects all that is not hidden.
    SelectAll("Select All", true),
    /// Selects nothing.
    SelectNone("Select None", true),
    /// Selects what was not selected.
    SelectInverse("Invert Selection", true),
    /// Selects all that hangs together with what is selected.
    SelectLinked("Select Linked", true),
    /// Selects what touches the selected.
    SelectMore("Select More", true),
    /// Selects no more what touches something that is not selected.
    SelectLess("Select Less", true),
    /// Selects loops of edges or faces.
    SelectLoop("Select Loops", true),
    /// Selects rings of edges.
    SelectRing("Select Rings", true),
    /// Selects the shortest path between the last two.
    SelectPath("Select Shortest Path", true),
    /// Selects edges at a border.
    SelectBorder("Select Border", true),
    /// Selects edges where not exactly two faces meet.
    SelectNonManifold("Select Non-Manifold", true),
    /// Selects sharp edges.
    SelectSharp("Select Sharp Edges", true),
    /// Selects faces by direction.
    SelectByNormal("Select by Normal", true),
    /// Selects faces by material.
    SelectByMaterial("Select by Material", true),
    /// Selects what has something in common with the selected.
    SelectSimilar("Select Similar", true),
    /// Selects by place.
    SelectWithin("Select Within", true),
    /// Deletes what is selected of meshes.
    Delete("Delete", false),
    /// Deletes the selected objects and what hangs on them.
    DeleteObjects("Delete Objects", false),
    /// Moves what is selected.
    Translate("Move", false),
    /// Turns what is selected.
    Rotate("Rotate", false),
    /// Scales what is selected.
    Scale("Scale", false),
    /// Shears the selected vertices.
    Shear("Shear", false),
    /// Moves the selected vertices towards a sphere.
    ToSphere("To Sphere", false),
    /// Moves the selected vertices along their normals.
    ShrinkFatten("Shrink/Fatten", false),
    /// Moves the selected vertices away from a centre.
    PushPull("Push/Pull", false),
    /// Takes the selected vertices back to their first positions.
    ResetVertices("Reset to First Positions", false),
    /// Extrudes what is selected.
    Extrude("Extrude", false),
    /// Makes a rim inside the selected faces.
    Inset("Inset", false),
    /// Replaces edges or vertices by new faces.
    Bevel("Bevel", false),
    /// Copies what is selected within its mesh.
    Duplicate("Duplicate", false),
    /// Splits the selected faces off.
    SplitOff("Split", false),
    /// Makes the selected faces an object.
    Separate("Separate", false),
    /// Puts several objects into one.
    JoinObjects("Join", false),
    /// Subdivides meshes to smooth surfaces.
    CatmullClark("Catmull-Clark", false),
    /// Shows meshes as smooth surfaces while they are edited.
    SetSubdivision("Subdivision Surface", false),
    /// Makes meshes the smooth surfaces that they are shown as.
    ApplySubdivision("Apply Subdivision", false),
    /// Cuts faces into triangles.
    Triangulate("Triangulate", false),
    /// Joins triangles to quads.
    TrisToQuads("Tris to Quads", false),
    /// Makes faces where there are none.
    Fill("Fill", false),
    /// Fills a loop with a grid.
    GridFill("Grid Fill", false),
    /// Removes elements, and leaves the surface.
    Dissolve("Dissolve", false),
    /// Unites what lies flat.
    DissolveFlat("Limited Dissolve", false),
    /// Cuts the selected edges into pieces.
    Subdivide("Subdivide", false),
    /// Cuts loops across a ring of quads.
    LoopCut("Loop Cut", false),
    /// Slides loops of edges.
    SlideEdges("Slide Edges", false),
    /// Cuts faces along a path.
    Knife("Knife", false),
    /// Slides vertices along their edges.
    SlideVertices("Slide Vertices", false),
    /// Merges the selected vertices.
    Merge("Merge", false),
    /// Marks edges sharp.
    MarkSharp("Mark Sharp", false),
    /// Marks edges as seams.
    MarkSeam("Mark Seam", false),
    /// Sets the crease of edges.
    Crease("Crease", false),
    /// Shades faces smoothly or flat.
    Shade("Shade Smooth/Flat", false),
    /// Gives faces a material slot.
    AssignMaterial("Assign Material", false),
    /// Hides what is selected.
    Hide("Hide", false),
    /// Shows all that is hidden.
    Reveal("Reveal", false),
    /// Turns faces over.
    FlipNormals("Flip Normals", false),
    /// Lets faces look outwards.
    RecalculateNormals("Recalculate Normals", false),
    /// Mirrors what is selected.
    Mirror("Mirror", false),
    /// Makes faces symmetric.
    Symmetrize("Symmetrize", false),
    /// Joins two loops of edges by faces; selected faces are removed and their outlines joined.
    Bridge("Bridge Edge Loops", false),
    /// Joins vertices by edges through faces.
    ConnectVertices("Connect Vertices", false),
    /// Projects a picture from one side.
    ProjectUvs("Project from View", false),
    /// Projects a picture from the sides of a box.
    ProjectUvsOnBox("Box Projection", false),
    /// Repairs what an inspection finds.
    Repair("Repair", false),
    /// Adds what a file holds.
    ImportFile("Import", false),
    /// Adds a standard object.
    AddObject("Add Object", false),
    /// Adds an empty object.
    AddEmpty("Add Empty", false),
    /// Adds a light.
    AddLight("Add Light", false),
    /// Adds a camera.
    AddCamera("Add Camera", false),
    /// Gives an object another name.
    RenameObject("Rename", false),
    /// Shows or hides objects.
    ShowObjects("Show/Hide Objects", false),
    /// Hides all objects but the selected ones.
    HideOthers("Hide Others", false),
    /// Shows all hidden objects and selects them.
    RevealObjects("Show Hidden Objects", false),
    /// Hangs objects on another one.
    SetParent("Set Parent", false),
    /// Lists an object at another place.
    ReorderObject("Reorder", false),
    /// Places an object exactly.
    SetTransform("Set Transform", false),
    /// Takes placements back.
    ClearTransform("Clear Transform", false),
    /// Moves vertices to where the placement of their object shows them.
    ApplyTransform("Apply Transform", false),
    /// Changes a light.
    SetLight("Set Light", false),
    /// Gives an object a new material.
    AddMaterial("Add Material", false),
    /// Changes a material.
    SetMaterial("Set Material", false),
    /// Shows a slot of an object in another material.
    SetMaterialSlot("Set Material Slot", false),
    /// Gives a material a picture, or takes it off.
    AssignTexture("Assign Texture", false),
    /// Copies objects.
    DuplicateObjects("Duplicate Objects", false),
}
