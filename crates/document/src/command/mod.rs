//! Commands as data: an action with all its parameters, so that it can be recorded, run again, and
//! adjusted.
//!
//! A command is one variant of [`Command`]. Each file of this folder holds one family of commands.
//! The description of a command in scripts and documentation is generated from the comments of its parameters.

mod action;
mod apply_transform;
mod boolean;
mod cut;
mod cut_by_others;
mod delete;
mod edit_uvs;
mod element_marks;
mod extrude;
mod hierarchy;
mod import;
mod light;
mod material;
mod mirror;
mod modifier;
mod move_uvs;
mod parts;
mod paste;
mod poke;
mod print;
mod project_around;
mod reference;
mod scene;
mod select;
mod select_by_trait;
mod select_elements;
mod select_related;
mod separate;
mod set_origin;
mod set_transform;
mod solid;
mod space;
mod spin;
mod surface;
mod texture;
mod transfer_uvs;
mod transform;
mod translate;
mod unwrap;
mod vertex_group;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

pub(crate) use action::Action;
pub use action::{ObjectName, Outcome};
pub use apply_transform::ApplyTransform;
pub use boolean::Boolean;
pub use cut::{Knife, LoopCut, PathPoint, SlideEdges, SlideVertices, Subdivide};
pub use cut_by_others::{IntersectFaces, KnifeProject};
pub use delete::{Delete, DeleteObjects, Deleted, Dissolve, DissolveFlat, Merge, MergeAt};
pub use edit_uvs::{AlignUvs, AverageIslandScale, PinUvs, StitchUvs, StraightenUvs};
pub use element_marks::{AssignMaterial, Crease, Hide, MarkSeam, MarkSharp, Reveal, Shade};
pub use extrude::{Bevel, Extrude, Inset, InsetMode};
pub use hierarchy::{HideOthers, ReorderObject, RevealObjects, SetParent};
pub use import::ImportFile;
pub use light::{AddCamera, SetLight};
pub use material::{AddMaterial, MaterialName, SetMaterial, SetMaterialSlot, SurfaceAlpha, SurfaceShading};
pub use mirror::{FlipNormals, Mirror, MirrorPlane, RecalculateNormals, Repair, Symmetrize};
pub use modifier::{
    AddModifier, ApplyModifier, ApplySubdivision, MoveModifier, RemoveModifier, SetModifier, SetSubdivision,
    ShowModifier,
};
pub use move_uvs::{FollowActiveQuad, RotateUvs, ScaleUvs, TranslateUvs, selected_uv_corners};
pub use parts::{Duplicate, ExtendVertices, JoinObjects, Rip, SplitOff};
pub use paste::{Glb, Paste};
pub use poke::{ConvexHull, Poke};
pub use print::{MakeSolid, SelectOverhangs, SelectThin};
pub use project_around::{ProjectUvsCylinder, ProjectUvsSphere};
pub use reference::{command_reference, command_schema};
pub use scene::{
    AddEmpty, AddLight, AddObject, DuplicateObjects, LightShape, RenameObject, Shape, ShowObjects,
};
pub use select::{
    EditObjects, LeaveEditMode, Select, SelectAction, SelectAll, SelectInverse, SelectNone, SelectWithin,
    SetElementKind,
};
pub use select_by_trait::{ElementTrait, SelectByTrait, SideComparison};
pub use select_elements::{ElementsOf, SelectElements};
pub use select_related::{
    SelectBorder, SelectByMaterial, SelectByNormal, SelectLess, SelectLinked, SelectLoop, SelectMore,
    SelectNonManifold, SelectPath, SelectRing, SelectSharp, SelectSimilar,
};
pub use separate::{Separate, SeparateBy};
pub use set_origin::{GeometryCenter, OriginTarget, SetOrigin};
pub(crate) use set_transform::transform_of;
pub use set_transform::{ClearTransform, SetTransform};
pub use solid::{Decimate, Solidify, Tube, UnSubdivide, Wireframe};
pub use space::TransformSpace;
pub use spin::{Bisect, Spin};
pub use surface::{
    Bridge, CatmullClark, ConnectVertices, Fill, GridFill, Triangulate, TrisToQuads, VoxelRemesh,
};
pub use texture::{AssignTexture, ProjectUvs, ProjectUvsOnBox, TextureSlot, TextureSource};
pub use transfer_uvs::TransferUvs;
pub use transform::{
    Proportional, ProportionalShape, PushPull, ResetVertices, Shear, ShrinkFatten, ToSphere,
};
pub use translate::{Rotate, Rotation, Scale, Translate};
pub use trigon_modelling::{
    ArrayModifier, BevelModifier, BevelWidth, BeveledEdges, BooleanModifier, BooleanOperation, BridgePath,
    BridgeProfile, DecimateGoal, DecimateSettings, InnerMiter, MirrorModifier, Modifier, OuterMiter,
    QuadLength, ScrewModifier, SolidifySettings, SubdivisionModifier, TransferMapping, TriangulateModifier,
    UnwrapMethod, UvAlignment, WeldModifier,
};
pub use unwrap::{PackIslands, SmartProject, Unwrap};
pub use vertex_group::{
    AddVertexGroup, AssignToVertexGroup, RemoveFromVertexGroup, RemoveVertexGroup, RenameVertexGroup,
    SelectVertexGroup,
};

/// Lists all commands: variant, type, display name.
macro_rules! commands {
    ($($(#[$doc:meta])* $variant:ident($name:literal, $selects:literal)),* $(,)?) => {
        /// A command with its parameters. In JSON an object whose `op` is the command's name in lower case
        /// with underscores, as `{ "op": "select_all" }`; missing parameters have their defaults, unknown
        /// ones are errors.
        #[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
        #[serde(tag = "op", rename_all = "snake_case")]
        #[non_exhaustive]
        pub enum Command {
            $($(#[$doc])* $variant($variant)),*
        }

        impl Command {
            /// The name in menus and in the history.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name),*
                }
            }

            /// Whether it changes only the selection.
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
    /// Enters edit mode with objects' meshes.
    EditObjects("Edit Mode", true),
    /// Returns to object mode.
    LeaveEditMode("Object Mode", true),
    /// Sets which of vertices, edges and faces are selected.
    SetElementKind("Select Mode", true),
    /// Replaces or changes the selection by name or number.
    Select("Select", true),
    /// Replaces or changes the selection in several objects at once.
    SelectElements("Select Region", true),
    /// Selects everything that is not hidden.
    SelectAll("Select All", true),
    /// Selects nothing.
    SelectNone("Select None", true),
    /// Inverts the selection.
    SelectInverse("Invert Selection", true),
    /// Selects everything connected to the selection.
    SelectLinked("Select Linked", true),
    /// Grows the selection by its neighbours.
    SelectMore("Select More", true),
    /// Shrinks the selection at its boundary.
    SelectLess("Select Less", true),
    /// Selects loops of edges or faces.
    SelectLoop("Select Loops", true),
    /// Selects rings of edges.
    SelectRing("Select Rings", true),
    /// Selects the shortest path between the last two elements.
    SelectPath("Select Shortest Path", true),
    /// Selects boundary edges.
    SelectBorder("Select Border", true),
    /// Selects edges where the number of faces is not two.
    SelectNonManifold("Select Non-Manifold", true),
    /// Selects elements by what they are.
    SelectByTrait("Select by Trait", true),
    /// Selects faces behind which the body is thin.
    SelectThin("Select Thin Walls", true),
    /// Selects faces that would be printed in the air.
    SelectOverhangs("Select Overhangs", true),
    /// Selects sharp edges.
    SelectSharp("Select Sharp Edges", true),
    /// Selects faces by direction.
    SelectByNormal("Select by Normal", true),
    /// Selects faces by material.
    SelectByMaterial("Select by Material", true),
    /// Selects elements with the same property as the selection.
    SelectSimilar("Select Similar", true),
    /// Selects the vertices of a vertex group.
    SelectVertexGroup("Select Vertex Group", true),
    /// Selects by position.
    SelectWithin("Select Within", true),
    /// Deletes selected elements of meshes.
    Delete("Delete", false),
    /// Deletes the selected objects and their descendants.
    DeleteObjects("Delete Objects", false),
    /// Moves the selection.
    Translate("Move", false),
    /// Rotates the selection.
    Rotate("Rotate", false),
    /// Scales the selection.
    Scale("Scale", false),
    /// Shears the selected vertices.
    Shear("Shear", false),
    /// Moves the selected vertices towards a sphere.
    ToSphere("To Sphere", false),
    /// Moves the selected vertices along their normals.
    ShrinkFatten("Shrink/Fatten", false),
    /// Moves the selected vertices away from a centre.
    PushPull("Push/Pull", false),
    /// Moves the selected vertices back to their original positions.
    ResetVertices("Reset to Original Positions", false),
    /// Extrudes the selection.
    Extrude("Extrude", false),
    /// Makes a border inside the selected faces.
    Inset("Inset", false),
    /// Replaces edges or vertices with new faces.
    Bevel("Bevel", false),
    /// Gives faces a second layer, so that they become walls.
    Solidify("Solidify", false),
    /// Makes struts of edges.
    Wireframe("Wireframe", false),
    /// Makes tubes around chains of edges.
    Tube("Tube", false),
    /// Sweeps elements around an axis.
    Spin("Spin", false),
    /// Duplicates the selection within its mesh.
    Duplicate("Duplicate", false),
    /// Splits off the selected faces.
    SplitOff("Split", false),
    /// Opens meshes along the selected edges or at selected vertices.
    Rip("Rip", false),
    /// Gives vertices new ones on their edges.
    ExtendVertices("Extend Vertices", false),
    /// Makes parts of meshes separate objects.
    Separate("Separate", false),
    /// Joins several objects into one.
    JoinObjects("Join", false),
    /// Combines the volumes of objects, or of parts of a mesh.
    Boolean("Boolean", false),
    /// Subdivides meshes into smooth surfaces.
    CatmullClark("Catmull-Clark", false),
    /// Replaces the faces of closed meshes with quads of equal size.
    VoxelRemesh("Voxel Remesh", false),
    /// Shows meshes as subdivision surfaces while their cage is edited.
    SetSubdivision("Subdivision Surface", false),
    /// Replaces meshes with their subdivision surfaces.
    ApplySubdivision("Apply Subdivision", false),
    /// Adds a modifier to the stack of an object's mesh.
    AddModifier("Add Modifier", false),
    /// Gives a modifier other parameters.
    SetModifier("Set Modifier", false),
    /// Switches a modifier on or off.
    ShowModifier("Show/Hide Modifier", false),
    /// Changes the order of modifiers.
    MoveModifier("Move Modifier", false),
    /// Removes a modifier.
    RemoveModifier("Remove Modifier", false),
    /// Changes a mesh as a modifier says.
    ApplyModifier("Apply Modifier", false),
    /// Cuts faces into triangles.
    Triangulate("Triangulate", false),
    /// Cuts faces into triangles around new vertices.
    Poke("Poke Faces", false),
    /// Joins triangles into quads.
    TrisToQuads("Tris to Quads", false),
    /// Reduces the number of triangles.
    Decimate("Decimate", false),
    /// Reverses a subdivision.
    UnSubdivide("Un-Subdivide", false),
    /// Fills loops with faces.
    Fill("Fill", false),
    /// Fills a loop with a grid.
    GridFill("Grid Fill", false),
    /// Makes the smallest convex solid around vertices.
    ConvexHull("Convex Hull", false),
    /// Removes elements without leaving holes.
    Dissolve("Dissolve", false),
    /// Dissolves elements in flat areas.
    DissolveFlat("Limited Dissolve", false),
    /// Cuts the selected edges into pieces.
    Subdivide("Subdivide", false),
    /// Cuts loops across a ring of quads.
    LoopCut("Loop Cut", false),
    /// Slides loops of edges.
    SlideEdges("Slide Edges", false),
    /// Cuts faces along strokes.
    Knife("Knife", false),
    /// Cuts faces along the lines in which they cross others.
    IntersectFaces("Intersect (Knife)", false),
    /// Cuts faces along the outlines of other objects.
    KnifeProject("Knife Project", false),
    /// Cuts faces along a plane.
    Bisect("Bisect", false),
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
    /// Adds a named set of weighted vertices.
    AddVertexGroup("Add Vertex Group", false),
    /// Removes a vertex group.
    RemoveVertexGroup("Remove Vertex Group", false),
    /// Gives a vertex group another name.
    RenameVertexGroup("Rename Vertex Group", false),
    /// Gives vertices a weight in a group.
    AssignToVertexGroup("Assign to Vertex Group", false),
    /// Takes vertices out of a group.
    RemoveFromVertexGroup("Remove from Vertex Group", false),
    /// Shades faces smoothly or flat.
    Shade("Shade Smooth/Flat", false),
    /// Assigns a material slot to faces.
    AssignMaterial("Assign Material", false),
    /// Hides the selection.
    Hide("Hide", false),
    /// Shows everything hidden.
    Reveal("Reveal", false),
    /// Flips faces.
    FlipNormals("Flip Normals", false),
    /// Makes faces point outwards.
    RecalculateNormals("Recalculate Normals", false),
    /// Mirrors the selection.
    Mirror("Mirror", false),
    /// Makes faces symmetric.
    Symmetrize("Symmetrize", false),
    /// Joins two edge loops with faces; selected faces are removed and their outlines joined.
    Bridge("Bridge Edge Loops", false),
    /// Connects vertices with edges through faces.
    ConnectVertices("Connect Vertices", false),
    /// Projects texture coordinates from one side.
    ProjectUvs("Project from View", false),
    /// Projects texture coordinates from the sides of a box.
    ProjectUvsOnBox("Cube Projection", false),
    /// Projects texture coordinates from a cylinder around the faces.
    ProjectUvsCylinder("Cylinder Projection", false),
    /// Projects texture coordinates from a sphere around the faces.
    ProjectUvsSphere("Sphere Projection", false),
    /// Lays faces flat along seams.
    Unwrap("Unwrap", false),
    /// Projects faces that face similarly together.
    SmartProject("Smart Projection", false),
    /// Gives meshes the texture coordinates of another object.
    TransferUvs("Transfer UVs", false),
    /// Arranges islands of texture coordinates in the image.
    PackIslands("Pack Islands", false),
    /// Moves texture coordinates.
    TranslateUvs("Move UVs", false),
    /// Turns texture coordinates.
    RotateUvs("Rotate UVs", false),
    /// Scales texture coordinates.
    ScaleUvs("Scale UVs", false),
    /// Lays quads beside the active one.
    FollowActiveQuad("Follow Active Quad", false),
    /// Pins texture coordinates, or frees them.
    PinUvs("Pin UVs", false),
    /// Brings islands together along edges.
    StitchUvs("Stitch UVs", false),
    /// Moves texture coordinates to an upright or level line.
    AlignUvs("Align UVs", false),
    /// Straightens chains of edges in the image.
    StraightenUvs("Straighten UVs", false),
    /// Gives islands even sizes.
    AverageIslandScale("Average Island Scale", false),
    /// Repairs faults found by inspection.
    Repair("Repair", false),
    /// Closes meshes for printing.
    MakeSolid("Make Solid", false),
    /// Adds the contents of a file.
    ImportFile("Import", false),
    /// Adds a standard object.
    AddObject("Add Object", false),
    /// Adds an empty object.
    AddEmpty("Add Empty", false),
    /// Adds a light.
    AddLight("Add Light", false),
    /// Adds a camera.
    AddCamera("Add Camera", false),
    /// Renames an object.
    RenameObject("Rename", false),
    /// Shows or hides objects.
    ShowObjects("Show/Hide Objects", false),
    /// Hides all objects except the selected ones.
    HideOthers("Hide Others", false),
    /// Shows all hidden objects and selects them.
    RevealObjects("Show Hidden Objects", false),
    /// Sets the parent of objects.
    SetParent("Set Parent", false),
    /// Changes an object's position in the list.
    ReorderObject("Reorder", false),
    /// Moves the origins of objects, or meshes onto their origins.
    SetOrigin("Set Origin", false),
    /// Sets an object's exact placement.
    SetTransform("Set Transform", false),
    /// Clears placements.
    ClearTransform("Clear Transform", false),
    /// Applies the placement of objects to their vertices.
    ApplyTransform("Apply Transform", false),
    /// Changes a light.
    SetLight("Set Light", false),
    /// Gives an object a new material.
    AddMaterial("Add Material", false),
    /// Changes a material.
    SetMaterial("Set Material", false),
    /// Sets the material of an object's slot.
    SetMaterialSlot("Set Material Slot", false),
    /// Sets or removes a texture of a material.
    AssignTexture("Assign Texture", false),
    /// Copies objects.
    DuplicateObjects("Duplicate Objects", false),
    /// Adds what was copied.
    Paste("Paste", false),
}
