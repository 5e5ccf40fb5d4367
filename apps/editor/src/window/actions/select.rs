//! The menu Select.

use trigon_document::ElementKind;

use super::{Action, Does::*, Needs, actions};
use crate::request::{ToolKind, UiRequest};

actions! {
    "Select" "select.all" "All" "A" Nothing Run(r#"{"op":"select_all"}"#) => "Selects everything that is not hidden.";
    "Select" "select.none" "None" "Alt+A" Nothing Run(r#"{"op":"select_none"}"#) => "Selects nothing.";
    "Select" "select.invert" "Invert" "Ctrl+I" Nothing Run(r#"{"op":"select_inverse"}"#) => "Inverts the selection.";
    "Select" "select.vertices" "Vertices" "1" EditMode Ui(UiRequest::Select { kind: ElementKind::Vertex, extend: false }) => "Switches to selecting vertices.";
    "Select" "select.edges" "Edges" "2" EditMode Ui(UiRequest::Select { kind: ElementKind::Edge, extend: false }) => "Switches to selecting edges.";
    "Select" "select.faces" "Faces" "3" EditMode Ui(UiRequest::Select { kind: ElementKind::Face, extend: false }) => "Switches to selecting faces.";
    "Select" "select.also_vertices" "Also Vertices" "Shift+1" EditMode Ui(UiRequest::Select { kind: ElementKind::Vertex, extend: true }) => "Adds vertices to the kinds of elements that are selected, or removes them.";
    "Select" "select.also_edges" "Also Edges" "Shift+2" EditMode Ui(UiRequest::Select { kind: ElementKind::Edge, extend: true }) => "Adds edges to the kinds of elements that are selected, or removes them.";
    "Select" "select.also_faces" "Also Faces" "Shift+3" EditMode Ui(UiRequest::Select { kind: ElementKind::Face, extend: true }) => "Adds faces to the kinds of elements that are selected, or removes them.";
    "Select" "select.box" "Box Select" "B" Nothing Tool(ToolKind::SelectBox) => "Selects within a box.";
    "Select" "select.circle" "Circle Select" "C" Nothing Tool(ToolKind::SelectCircle) => "Selects with a brush; the wheel makes it larger.";
    "Select" "select.lasso" "Lasso Select" "" Nothing Tool(ToolKind::SelectLasso) => "Selects within a freehand line.";
    "Select" "select.linked" "Linked" "Ctrl+L" Elements Run(r#"{"op":"select_linked"}"#) => "Selects everything connected to the selection.";
    "Select" "select.linked_at" "Linked at Pointer" "L" EditMode Ui(UiRequest::LinkedAtPointer) => "Adds everything connected to the element under the pointer.";
    "Select" "select.more" "More" "Ctrl+Numpad+" Elements Run(r#"{"op":"select_more"}"#) => "Grows the selection by its neighbours.";
    "Select" "select.less" "Less" "Ctrl+Numpad-" Elements Run(r#"{"op":"select_less"}"#) => "Shrinks the selection at its boundary.";
    "Select" "select.loops" "Loops" "" Elements Run(r#"{"op":"select_loop"}"#) => "Selects loops of edges or faces (Alt+click).";
    "Select" "select.rings" "Rings" "" Elements Run(r#"{"op":"select_ring"}"#) => "Selects rings of edges (Ctrl+Alt+click).";
    "Select" "select.path" "Shortest Path" "" Elements Run(r#"{"op":"select_path"}"#) => "Selects the shortest path between the last two (Ctrl+click).";
    "Select/By Trait" "select.border" "Border" "" EditMode Run(r#"{"op":"select_border"}"#) => "Selects boundary edges.";
    "Select/By Trait" "select.non_manifold" "Non-Manifold" "" EditMode Run(r#"{"op":"select_non_manifold"}"#) => "Selects edges where the number of faces is not two.";
    "Select/By Trait" "select.sharp" "Sharp Edges" "" EditMode Run(r#"{"op":"select_sharp"}"#) => "Selects edges whose faces meet at a large angle.";
    "Select/By Trait" "select.normal" "By Direction" "" EditMode Run(r#"{"op":"select_by_normal"}"#) => "Selects faces that point up; adjust the direction with F9.";
    "Select/By Trait" "select.material" "By Material" "" EditMode Run(r#"{"op":"select_by_material"}"#) => "Selects faces of a material slot; choose it with F9.";
    "Select/By Trait" "select.within" "By Place" "" EditMode Run(r#"{"op":"select_within","min":[0.0,-1e30,-1e30]}"#) => "Selects elements at positive x; adjust the bounds with F9.";
    "Select/Similar" "select.similar" "Similar Menu" "Shift+G" EditMode Ui(UiRequest::Popup("Select/Similar")) => "Chooses the property that elements must share.";
    "Select/Similar" "similar.corners" "Corners" "" Elements Run(r#"{"op":"select_similar","by":"corners"}"#) => "Faces with the same number of corners.";
    "Select/Similar" "similar.material" "Material" "" Elements Run(r#"{"op":"select_similar","by":"material"}"#) => "Faces of the same material.";
    "Select/Similar" "similar.area" "Area" "" Elements Run(r#"{"op":"select_similar","by":"area"}"#) => "Faces of about the same area.";
    "Select/Similar" "similar.normal" "Direction" "" Elements Run(r#"{"op":"select_similar","by":"normal"}"#) => "Faces with about the same direction.";
    "Select/Similar" "similar.length" "Length" "" Elements Run(r#"{"op":"select_similar","by":"length"}"#) => "Edges of about the same length.";
    "Select/Similar" "similar.faces" "Faces at Edges" "" Elements Run(r#"{"op":"select_similar","by":"faces"}"#) => "Edges with the same number of faces.";
    "Select/Similar" "similar.edges" "Edges at Vertices" "" Elements Run(r#"{"op":"select_similar","by":"edges"}"#) => "Vertices with the same number of edges.";
}
