//! The menus Mesh and UV.

use super::{Action, Does::*, Needs, actions};
use crate::request::{ToolKind, UiRequest};

actions! {
    "Mesh" "mesh.extrude" "Extrude" "E" Elements Tool(ToolKind::Extrude) => "Extrudes the selection.";
    "Mesh" "mesh.extrude_individual" "Extrude Individual Faces" "Alt+E" Elements Tool(ToolKind::ExtrudeIndividual) => "Extrudes each face individually.";
    "Mesh" "mesh.inset" "Inset Faces" "I" Elements Tool(ToolKind::Inset) => "Makes a border of faces inside the selected ones.";
    "Mesh" "mesh.bevel" "Bevel Edges" "Ctrl+B" Elements Tool(ToolKind::Bevel) => "Replaces edges with faces; the wheel changes the segments.";
    "Mesh" "mesh.bevel_vertices" "Bevel Vertices" "Ctrl+Shift+B" Elements Tool(ToolKind::BevelVertices) => "Replaces vertices with faces.";
    "Mesh" "mesh.loop_cut" "Loop Cut" "Ctrl+R" EditMode Tool(ToolKind::LoopCut) => "Cuts loops across a ring of quads; the wheel changes their number.";
    "Mesh" "mesh.edge_slide" "Slide" "Shift+V" Elements Tool(ToolKind::EdgeSlide) => "Slides edges along their neighbours, or vertices along their edges (G G).";
    "Mesh" "mesh.subdivide" "Subdivide" "" Elements Run(r#"{"op":"subdivide"}"#) => "Cuts the selected edges in half.";
    "Mesh" "mesh.catmull_clark" "Catmull-Clark" "" EditMode Run(r#"{"op":"catmull_clark"}"#) => "Subdivides meshes into smooth surfaces.";
    "Mesh" "mesh.duplicate" "Duplicate" "Shift+D" Elements Run(r#"{"op":"duplicate"}"#) => "Duplicates the selection, and moves the copy.";
    "Mesh" "mesh.split" "Split" "Y Alt+M" Elements Run(r#"{"op":"split_off"}"#) => "Splits the selected faces off.";
    "Mesh" "mesh.rip" "Rip" "V" Elements Ui(UiRequest::Rip { fill: false }) => "Opens the mesh along edges or at vertices, and moves the pointer's side.";
    "Mesh" "mesh.rip_fill" "Rip Fill" "Alt+V" Elements Ui(UiRequest::Rip { fill: true }) => "Rips, and fills the gap with faces.";
    "Mesh" "mesh.separate" "Separate" "P" Elements Run(r#"{"op":"separate"}"#) => "Makes the selected faces a separate object.";
    "Mesh" "mesh.fill" "Make Face / Fill" "F Alt+F" Elements Run(r#"{"op":"fill"}"#) => "Fills loops with faces.";
    "Mesh" "mesh.grid_fill" "Grid Fill" "" Elements Run(r#"{"op":"grid_fill"}"#) => "Fills a closed loop of edges with a grid of quads.";
    "Mesh" "mesh.connect" "Connect Vertices" "J" Elements Run(r#"{"op":"connect_vertices"}"#) => "Connects vertices with edges through faces.";
    "Mesh" "mesh.bridge" "Bridge Edge Loops" "" Elements Run(r#"{"op":"bridge"}"#) => "Joins two edge loops, or the outlines of two faces, with faces.";
    "Mesh" "mesh.triangulate" "Triangulate" "Ctrl+T" Elements Run(r#"{"op":"triangulate"}"#) => "Cuts faces into triangles.";
    "Mesh" "mesh.tris_to_quads" "Tris to Quads" "Alt+J" Elements Run(r#"{"op":"tris_to_quads"}"#) => "Joins triangles into quads.";
    "Mesh" "mesh.symmetrize" "Symmetrize" "" Elements Run(r#"{"op":"symmetrize"}"#) => "Makes faces symmetric about x = 0; adjust the plane with F9.";
    "Mesh" "mesh.repair" "Clean Up" "" EditMode Run(r#"{"op":"repair"}"#) => "Removes loose and duplicate elements.";
    "Mesh" "mesh.reset_vertices" "Reset to Original Positions" "" Elements Run(r#"{"op":"reset_vertices"}"#) => "Moves vertices back to their original positions.";
    "Mesh/Mirror" "mesh.mirror_x" "X" "Ctrl+M" Elements Run(r#"{"op":"mirror"}"#) => "Mirrors the selection about x = 0.";
    "Mesh/Mirror" "mesh.mirror_y" "Y" "" Elements Run(r#"{"op":"mirror","plane":{"normal":[0.0,1.0,0.0]}}"#) => "Mirrors the selection about y = 0.";
    "Mesh/Mirror" "mesh.mirror_z" "Z" "" Elements Run(r#"{"op":"mirror","plane":{"normal":[0.0,0.0,1.0]}}"#) => "Mirrors the selection about z = 0.";

    "Mesh/Delete" "delete.menu" "Delete Menu" "X Delete" Elements Ui(UiRequest::Popup("Mesh/Delete")) => "Chooses what to delete.";
    "Mesh/Delete" "delete.vertices" "Vertices" "" Elements Run(r#"{"op":"delete","what":"vertices"}"#) => "Deletes vertices with their edges and faces.";
    "Mesh/Delete" "delete.edges" "Edges" "" Elements Run(r#"{"op":"delete","what":"edges"}"#) => "Deletes edges with their faces.";
    "Mesh/Delete" "delete.faces" "Faces" "" Elements Run(r#"{"op":"delete","what":"faces"}"#) => "Deletes faces, and edges and vertices that only they use.";
    "Mesh/Delete" "delete.only_faces" "Only Faces" "" Elements Run(r#"{"op":"delete","what":"only_faces"}"#) => "Deletes faces, keeping their edges.";
    "Mesh/Delete" "delete.dissolve" "Dissolve" "Ctrl+X" Elements Run(r#"{"op":"dissolve"}"#) => "Removes elements without leaving holes.";
    "Mesh/Delete" "delete.dissolve_flat" "Limited Dissolve" "" Elements Run(r#"{"op":"dissolve_flat"}"#) => "Dissolves elements in flat areas.";

    "Mesh/Merge" "merge.menu" "Merge Menu" "M" Elements Ui(UiRequest::Popup("Mesh/Merge")) => "Chooses where vertices are merged.";
    "Mesh/Merge" "merge.center" "At Center" "" Elements Run(r#"{"op":"merge","at":"center"}"#) => "Merges vertices at their centre.";
    "Mesh/Merge" "merge.first" "At First" "" Elements Run(r#"{"op":"merge","at":"first"}"#) => "Merges vertices at the one selected first.";
    "Mesh/Merge" "merge.last" "At Last" "" Elements Run(r#"{"op":"merge","at":"last"}"#) => "Merges vertices at the one selected last.";
    "Mesh/Merge" "merge.collapse" "Collapse" "" Elements Run(r#"{"op":"merge","at":"collapse"}"#) => "Merges each connected group at its own centre.";
    "Mesh/Merge" "merge.distance" "By Distance" "" Elements Run(r#"{"op":"merge","at":"distance"}"#) => "Merges vertices that are close to one another.";

    "Mesh/Edge" "edge.menu" "Edge Menu" "Ctrl+E" EditMode Ui(UiRequest::Popup("Mesh/Edge")) => "Lists operations on edges.";
    "Mesh/Edge" "edge.mark_seam" "Mark Seam" "" Elements Run(r#"{"op":"mark_seam"}"#) => "Marks edges as seams.";
    "Mesh/Edge" "edge.clear_seam" "Clear Seam" "" Elements Run(r#"{"op":"mark_seam","seam":false}"#) => "Clears seams.";
    "Mesh/Edge" "edge.mark_sharp" "Mark Sharp" "" Elements Run(r#"{"op":"mark_sharp"}"#) => "Marks edges sharp for shading.";
    "Mesh/Edge" "edge.clear_sharp" "Clear Sharp" "" Elements Run(r#"{"op":"mark_sharp","sharp":false}"#) => "Clears sharp edges.";
    "Mesh/Edge" "edge.crease" "Crease" "Shift+E" Elements Run(r#"{"op":"crease","crease":1.0}"#) => "Keeps edges sharp in subdivision.";
    "Mesh/Edge" "edge.clear_crease" "Clear Crease" "" Elements Run(r#"{"op":"crease"}"#) => "Makes edges smooth in subdivision again.";

    "Mesh/Vertex" "vertex.menu" "Vertex Menu" "Ctrl+V" EditMode Ui(UiRequest::Popup("Mesh/Vertex")) => "Lists operations on vertices.";

    "Mesh/Face" "face.menu" "Face Menu" "Ctrl+F" EditMode Ui(UiRequest::Popup("Mesh/Face")) => "Lists operations on faces.";
    "Mesh/Face" "face.smooth" "Shade Smooth" "" Elements Run(r#"{"op":"shade"}"#) => "Shades faces smooth.";
    "Mesh/Face" "face.flat" "Shade Flat" "" Elements Run(r#"{"op":"shade","smooth":false}"#) => "Shades faces flat.";
    "Mesh/Face" "face.material" "Assign Material" "" Elements Run(r#"{"op":"assign_material"}"#) => "Assigns a material slot to faces; choose it with F9.";
    "Mesh/Normals" "normals.outside" "Recalculate Outside" "Shift+N" Elements Run(r#"{"op":"recalculate_normals"}"#) => "Makes faces point outwards.";
    "Mesh/Normals" "normals.inside" "Recalculate Inside" "Ctrl+Shift+N" Elements Run(r#"{"op":"recalculate_normals","inside":true}"#) => "Makes faces point inwards.";
    "Mesh/Normals" "normals.flip" "Flip" "" Elements Run(r#"{"op":"flip_normals"}"#) => "Flips faces.";
    "Mesh" "mesh.hide" "Hide" "H" Elements Run(r#"{"op":"hide"}"#) => "Hides the selection.";
    "Mesh" "mesh.hide_others" "Hide Unselected" "Shift+H" Elements Run(r#"{"op":"hide","unselected":true}"#) => "Hides everything except the selection.";
    "Mesh" "mesh.reveal" "Reveal Hidden" "Alt+H" EditMode Run(r#"{"op":"reveal"}"#) => "Shows everything hidden.";

    "UV" "uv.project" "Project from Front" "" Elements Run(r#"{"op":"project_uvs"}"#) => "Projects texture coordinates along z; adjust the direction with F9.";
    "UV" "uv.box" "Box Projection" "" Elements Run(r#"{"op":"project_uvs_on_box"}"#) => "Projects texture coordinates from the six sides of a box.";
}
