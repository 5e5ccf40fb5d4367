//! The menu Select.

use trigon_edit::ElementKind;

use super::{Action, Does::*, Needs, actions};
use crate::request::{ToolKind, UiRequest};

actions! {
    "Select" "select.all" "All" "A" Nothing Run(r#"{"op":"select_all"}"#) => "Selects all that is not hidden.";
    "Select" "select.none" "None" "Alt+A" Nothing Run(r#"{"op":"select_none"}"#) => "Selects nothing.";
    "Select" "select.invert" "Invert" "Ctrl+I" Nothing Run(r#"{"op":"select_inverse"}"#) => "Selects what was not selected.";
    "Select" "select.vertices" "Vertices" "1" EditMode Ui(UiRequest::Select(ElementKind::Vertex)) => "Selects vertices from now on.";
    "Select" "select.edges" "Edges" "2" EditMode Ui(UiRequest::Select(ElementKind::Edge)) => "Selects edges from now on.";
    "Select" "select.faces" "Faces" "3" EditMode Ui(UiRequest::Select(ElementKind::Face)) => "Selects faces from now on.";
    "Select" "select.box" "Box Select" "B" Nothing Tool(ToolKind::SelectBox) => "Selects within a box.";
    "Select" "select.circle" "Circle Select" "C" Nothing Tool(ToolKind::SelectCircle) => "Selects with a brush; the wheel makes it larger.";
    "Select" "select.lasso" "Lasso Select" "" Nothing Tool(ToolKind::SelectLasso) => "Selects within a line drawn by hand.";
    "Select" "select.linked" "Linked" "Ctrl+L" Elements Run(r#"{"op":"select_linked"}"#) => "Selects all that hangs together with what is selected.";
    "Select" "select.linked_at" "Linked at Pointer" "L" EditMode Ui(UiRequest::LinkedAtPointer) => "Adds all that hangs together with what is under the pointer.";
    "Select" "select.more" "More" "Ctrl+Numpad+" Elements Run(r#"{"op":"select_more"}"#) => "Selects what touches the selected.";
    "Select" "select.less" "Less" "Ctrl+Numpad-" Elements Run(r#"{"op":"select_less"}"#) => "Shrinks what is selected by one element.";
    "Select" "select.loops" "Loops" "" Elements Run(r#"{"op":"select_loop"}"#) => "Selects loops of edges or faces (Alt+click).";
    "Select" "select.rings" "Rings" "" Elements Run(r#"{"op":"select_ring"}"#) => "Selects rings of edges (Ctrl+Alt+click).";
    "Select" "select.path" "Shortest Path" "" Elements Run(r#"{"op":"select_path"}"#) => "Selects the shortest way between the last two (Ctrl+click).";
    "Select/By Trait" "select.border" "Border" "" EditMode Run(r#"{"op":"select_border"}"#) => "Selects edges at a border.";
    "Select/By Trait" "select.non_manifold" "Non-Manifold" "" EditMode Run(r#"{"op":"select_non_manifold"}"#) => "Selects edges where not exactly two faces meet.";
    "Select/By Trait" "select.sharp" "Sharp Edges" "" EditMode Run(r#"{"op":"select_sharp"}"#) => "Selects edges whose faces meet at a large angle.";
    "Select/By Trait" "select.normal" "By Direction" "" EditMode Run(r#"{"op":"select_by_normal"}"#) => "Selects faces that look up; adjust the direction with F9.";
    "Select/By Trait" "select.material" "By Material" "" EditMode Run(r#"{"op":"select_by_material"}"#) => "Selects faces of a material slot; adjust which with F9.";
    "Select/By Trait" "select.within" "By Place" "" EditMode Run(r#"{"op":"select_within","min":[0.0,-1e30,-1e30]}"#) => "Selects what lies at positive x; adjust the bounds with F9.";
    "Select/Similar" "select.similar" "Similar Menu" "Shift+G" EditMode Ui(UiRequest::Popup("Select/Similar")) => "Chooses what elements have to have in common.";
    "Select/Similar" "similar.corners" "Corners" "" Elements Run(r#"{"op":"select_similar","by":"corners"}"#) => "Faces with as many corners.";
    "Select/Similar" "similar.material" "Material" "" Elements Run(r#"{"op":"select_similar","by":"material"}"#) => "Faces of the same material.";
    "Select/Similar" "similar.area" "Area" "" Elements Run(r#"{"op":"select_similar","by":"area"}"#) => "Faces about as large.";
    "Select/Similar" "similar.normal" "Direction" "" Elements Run(r#"{"op":"select_similar","by":"normal"}"#) => "Faces that look about the same way.";
    "Select/Similar" "similar.length" "Length" "" Elements Run(r#"{"op":"select_similar","by":"length"}"#) => "Edges about as long.";
    "Select/Similar" "similar.faces" "Faces at Edges" "" Elements Run(r#"{"op":"select_similar","by":"faces"}"#) => "Edges with as many faces.";
    "Select/Similar" "similar.edges" "Edges at Vertices" "" Elements Run(r#"{"op":"select_similar","by":"edges"}"#) => "Vertices with as many edges.";
}
