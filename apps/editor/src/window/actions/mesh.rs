//! The menus Mesh and UV.

use super::{Action, Does::*, Needs, actions};
use crate::request::{ToolKind, UiRequest};

actions! {
    "Mesh" "mesh.extrude" "Extrude" "E" Elements Tool(ToolKind::Extrude) => "Pulls new faces out of what is selected.";
    "Mesh" "mesh.extrude_individual" "Extrude Individual Faces" "Alt+E" Elements Tool(ToolKind::ExtrudeIndividual) => "Extrudes each face by itself.";
    "Mesh" "mesh.inset" "Inset Faces" "I" Elements Tool(ToolKind::Inset) => "Makes a rim inside the selected faces.";
    "Mesh" "mesh.bevel" "Bevel Edges" "Ctrl+B" Elements Tool(ToolKind::Bevel) => "Replaces edges by faces; the wheel changes the segments.";
    "Mesh" "mesh.bevel_vertices" "Bevel Vertices" "Ctrl+Shift+B" Elements Tool(ToolKind::BevelVertices) => "Replaces vertices by faces.";
    "Mesh" "mesh.loop_cut" "Loop Cut" "Ctrl+R" EditMode Tool(ToolKind::LoopCut) => "Cuts a loop across a ring of quads; the wheel changes how many.";
    "Mesh" "mesh.edge_slide" "Slide" "Shift+V" Elements Tool(ToolKind::EdgeSlide) => "Slides edges along their neighbours, or vertices along their edges (G G).";
    "Mesh" "mesh.subdivide" "Subdivide" "" Elements Run(r#"{"op":"subdivide"}"#) => "Cuts the selected edges in halves.";
    "Mesh" "mesh.catmull_clark" "Catmull-Clark" "" EditMode Run(r#"{"op":"catmull_clark"}"#) => "Subdivides meshes to smooth surfaces.";
    "Mesh" "mesh.duplicate" "Duplicate" "Shift+D" Elements Run(r#"{"op":"duplicate"}"#) => "Copies what is selected, and moves the copy.";
    "Mesh" "mesh.split" "Split" "Y Alt+M" Elements Run(r#"{"op":"split_off"}"#) => "Splits the selected faces off.";
    "Mesh" "mesh.separate" "Separate" "P" Elements Run(r#"{"op":"separate"}"#) => "Makes the selected faces an object.";
    "Mesh" "mesh.fill" "Make Face / Fill" "F Alt+F" Elements Run(r#"{"op":"fill"}"#) => "Makes faces where there are none.";
    "Mesh" "mesh.grid_fill" "Grid Fill" "" Elements Run(r#"{"op":"grid_fill"}"#) => "Fills a closed loop of edges with a grid of quads.";
    "Mesh" "mesh.connect" "Connect Vertices" "J" Elements Run(r#"{"op":"connect_vertices"}"#) => "Joins vertices by edges through faces.";
    "Mesh" "mesh.bridge" "Bridge Edge Loops" "" Elements Run(r#"{"op":"bridge"}"#) => "Joins two loops of edges, or the outlines of two faces, by faces.";
    "Mesh" "mesh.triangulate" "Triangulate" "Ctrl+T" Elements Run(r#"{"op":"triangulate"}"#) => "Cuts faces into triangles.";
    "Mesh" "mesh.tris_to_quads" "Tris to Quads" "Alt+J" Elements Run(r#"{"op":"tris_to_quads"}"#) => "Joins triangles to quads.";
    "Mesh" "mesh.symmetrize" "Symmetrize" "" Elements Run(r#"{"op":"symmetrize"}"#) => "Makes faces symmetric about x = 0; adjust the plane with F9.";
    "Mesh" "mesh.repair" "Clean Up" "" EditMode Run(r#"{"op":"repair"}"#) => "Removes loose and doubled elements.";
    "Mesh" "mesh.reset_vertices" "Reset to Original Positions" "" Elements Run(r#"{"op":"reset_vertices"}"#) => "Takes vertices back to where they were first.";
    "Mesh/Mirror" "mesh.mirror_x" "X" "Ctrl+M" Elements Run(r#"{"op":"mirror"}"#) => "Mirrors what is selected about x = 0.";
    "Mesh/Mirror" "mesh.mirror_y" "Y" "" Elements Run(r#"{"op":"mirror","plane":{"normal":[0.0,1.0,0.0]}}"#) => "Mirrors what is selected about y = 0.";
    "Mesh/Mirror" "mesh.mirror_z" "Z" "" Elements Run(r#"{"op":"mirror","plane":{"normal":[0.0,0.0,1.0]}}"#) => "Mirrors what is selected about z = 0.";

    "Mesh/Delete" "delete.menu" "Delete Menu" "X Delete" Elements Ui(UiRequest::Popup("Mesh/Delete")) => "Chooses what is deleted.";
    "Mesh/Delete" "delete.vertices" "Vertices" "" Elements Run(r#"{"op":"delete","what":"vertices"}"#) => "Deletes vertices with all at them.";
    "Mesh/Delete" "delete.edges" "Edges" "" Elements Run(r#"{"op":"delete","what":"edges"}"#) => "Deletes edges with the faces at them.";
    "Mesh/Delete" "delete.faces" "Faces" "" Elements Run(r#"{"op":"delete","what":"faces"}"#) => "Deletes faces and what belongs to them alone.";
    "Mesh/Delete" "delete.only_faces" "Only Faces" "" Elements Run(r#"{"op":"delete","what":"only_faces"}"#) => "Deletes faces; their edges stay.";
    "Mesh/Delete" "delete.dissolve" "Dissolve" "Ctrl+X" Elements Run(r#"{"op":"dissolve"}"#) => "Removes elements and leaves the surface.";
    "Mesh/Delete" "delete.dissolve_flat" "Limited Dissolve" "" Elements Run(r#"{"op":"dissolve_flat"}"#) => "Unites what lies flat.";

    "Mesh/Merge" "merge.menu" "Merge Menu" "M" Elements Ui(UiRequest::Popup("Mesh/Merge")) => "Chooses where vertices are merged.";
    "Mesh/Merge" "merge.center" "At Center" "" Elements Run(r#"{"op":"merge","at":"center"}"#) => "Merges vertices in their middle.";
    "Mesh/Merge" "merge.first" "At First" "" Elements Run(r#"{"op":"merge","at":"first"}"#) => "Merges vertices at the one selected first.";
    "Mesh/Merge" "merge.last" "At Last" "" Elements Run(r#"{"op":"merge","at":"last"}"#) => "Merges vertices at the one selected last.";
    "Mesh/Merge" "merge.collapse" "Collapse" "" Elements Run(r#"{"op":"merge","at":"collapse"}"#) => "Merges what hangs together, each in its own middle.";
    "Mesh/Merge" "merge.distance" "By Distance" "" Elements Run(r#"{"op":"merge","at":"distance"}"#) => "Merges vertices that are near one another.";

    "Mesh/Edge" "edge.menu" "Edge Menu" "Ctrl+E" EditMode Ui(UiRequest::Popup("Mesh/Edge")) => "Shows what can be done with edges.";
    "Mesh/Edge" "edge.mark_seam" "Mark Seam" "" Elements Run(r#"{"op":"mark_seam"}"#) => "Marks edges as seams.";
    "Mesh/Edge" "edge.clear_seam" "Clear Seam" "" Elements Run(r#"{"op":"mark_seam","seam":false}"#) => "Takes seams away.";
    "Mesh/Edge" "edge.mark_sharp" "Mark Sharp" "" Elements Run(r#"{"op":"mark_sharp"}"#) => "Shades faces apart at edges.";
    "Mesh/Edge" "edge.clear_sharp" "Clear Sharp" "" Elements Run(r#"{"op":"mark_sharp","sharp":false}"#) => "Shades faces together again.";
    "Mesh/Edge" "edge.crease" "Crease" "Shift+E" Elements Run(r#"{"op":"crease","crease":1.0}"#) => "Keeps edges sharp when they are subdivided.";
    "Mesh/Edge" "edge.clear_crease" "Clear Crease" "" Elements Run(r#"{"op":"crease"}"#) => "Lets edges become smooth when they are subdivided.";

    "Mesh/Vertex" "vertex.menu" "Vertex Menu" "Ctrl+V" EditMode Ui(UiRequest::Popup("Mesh/Vertex")) => "Shows what can be done with vertices.";

    "Mesh/Face" "face.menu" "Face Menu" "Ctrl+F" EditMode Ui(UiRequest::Popup("Mesh/Face")) => "Shows what can be done with faces.";
    "Mesh/Face" "face.smooth" "Shade Smooth" "" Elements Run(r#"{"op":"shade"}"#) => "Shades faces smoothly.";
    "Mesh/Face" "face.flat" "Shade Flat" "" Elements Run(r#"{"op":"shade","smooth":false}"#) => "Shades each face by itself.";
    "Mesh/Face" "face.material" "Assign Material" "" Elements Run(r#"{"op":"assign_material"}"#) => "Gives faces a material slot; adjust which with F9.";
    "Mesh/Normals" "normals.outside" "Recalculate Outside" "Shift+N" Elements Run(r#"{"op":"recalculate_normals"}"#) => "Lets faces look outwards.";
    "Mesh/Normals" "normals.inside" "Recalculate Inside" "Ctrl+Shift+N" Elements Run(r#"{"op":"recalculate_normals","inside":true}"#) => "Lets faces look inwards.";
    "Mesh/Normals" "normals.flip" "Flip" "" Elements Run(r#"{"op":"flip_normals"}"#) => "Turns faces over.";
    "Mesh" "mesh.hide" "Hide" "H" Elements Run(r#"{"op":"hide"}"#) => "Hides what is selected.";
    "Mesh" "mesh.hide_others" "Hide Unselected" "Shift+H" Elements Run(r#"{"op":"hide","unselected":true}"#) => "Hides what is not selected.";
    "Mesh" "mesh.reveal" "Reveal Hidden" "Alt+H" EditMode Run(r#"{"op":"reveal"}"#) => "Shows all that is hidden.";

    "UV" "uv.project" "Project from Front" "" Elements Run(r#"{"op":"project_uvs"}"#) => "Projects a picture along z; adjust the side with F9.";
    "UV" "uv.box" "Box Projection" "" Elements Run(r#"{"op":"project_uvs_on_box"}"#) => "Projects a picture from the six sides of a box.";
}
