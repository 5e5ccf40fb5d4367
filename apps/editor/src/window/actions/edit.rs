//! The menu Edit, with actions for both objects and elements, and the settings menus.

use super::{Action, Does::*, Needs, actions};
use crate::request::{Orientation, Pivot, SnapTarget, ToolKind, UiRequest};

actions! {
    "Edit" "edit.undo" "Undo" "Ctrl+Z" SomethingDone Undo => "Undoes the last action.";
    "Edit" "edit.redo" "Redo" "Ctrl+Shift+Z Ctrl+Y" SomethingUndone Redo => "Redoes the last undone action.";
    "Edit" "edit.repeat" "Repeat Last" "Shift+R" SomethingToRepeat RepeatLast => "Runs the last command again.";
    "Edit" "edit.adjust" "Adjust Last Operation" "F9" SomethingDone Ui(UiRequest::AdjustPanel) => "Shows the values of the last command for adjusting.";
    "Edit" "edit.mode" "Edit Mode" "Tab" Nothing Ui(UiRequest::ToggleEditMode) => "Edits the elements of the selected objects, or whole objects again.";
    "Edit" "edit.rename" "Rename…" "F2" Objects Ui(UiRequest::Rename) => "Renames the active object.";

    "Edit/Transform" "tool.move" "Move" "G" Selected Tool(ToolKind::Move) => "Moves the selection; X, Y, Z lock an axis.";
    "Edit/Transform" "tool.rotate" "Rotate" "R" Selected Tool(ToolKind::Rotate) => "Rotates the selection.";
    "Edit/Transform" "tool.scale" "Scale" "S" Selected Tool(ToolKind::Scale) => "Scales the selection.";
    "Edit/Transform" "tool.shear" "Shear" "Ctrl+Shift+Alt+S" Elements Tool(ToolKind::Shear) => "Shears the selection.";
    "Edit/Transform" "tool.to_sphere" "To Sphere" "Shift+Alt+S" Elements Tool(ToolKind::ToSphere) => "Moves the selection towards a sphere.";
    "Edit/Transform" "tool.shrink_fatten" "Shrink/Fatten" "Alt+S" Elements Tool(ToolKind::ShrinkFatten) => "Moves the selection along its normals.";
    "Edit/Transform" "tool.push_pull" "Push/Pull" "" Elements Tool(ToolKind::PushPull) => "Moves the selection towards or away from its centre.";

    "Edit/Subdivision Surface" "subdivision.0" "Off" "Ctrl+0" Meshes Run(r#"{"op":"set_subdivision","levels":0}"#) => "Shows meshes as they are.";
    "Edit/Subdivision Surface" "subdivision.1" "1 Level" "Ctrl+1" Meshes Run(r#"{"op":"set_subdivision","levels":1}"#) => "Shows meshes as smooth surfaces of 1 level, with their cage over them.";
    "Edit/Subdivision Surface" "subdivision.2" "2 Levels" "Ctrl+2" Meshes Run(r#"{"op":"set_subdivision","levels":2}"#) => "Shows meshes as smooth surfaces of 2 levels, with their cage over them.";
    "Edit/Subdivision Surface" "subdivision.3" "3 Levels" "Ctrl+3" Meshes Run(r#"{"op":"set_subdivision","levels":3}"#) => "Shows meshes as smooth surfaces of 3 levels, with their cage over them.";
    "Edit/Subdivision Surface" "subdivision.4" "4 Levels" "Ctrl+4" Meshes Run(r#"{"op":"set_subdivision","levels":4}"#) => "Shows meshes as smooth surfaces of 4 levels, with their cage over them.";
    "Edit/Subdivision Surface" "subdivision.5" "5 Levels" "Ctrl+5" Meshes Run(r#"{"op":"set_subdivision","levels":5}"#) => "Shows meshes as smooth surfaces of 5 levels, with their cage over them.";
    "Edit/Subdivision Surface" "subdivision.apply" "Apply" "" Meshes Run(r#"{"op":"apply_subdivision"}"#) => "Makes meshes the smooth surfaces that they are shown as.";
    "Edit" "edit.duplicate" "Duplicate Objects" "Shift+D" Objects Run(r#"{"op":"duplicate_objects"}"#) => "Copies objects with their meshes, and moves the copies.";
    "Edit" "edit.duplicate_linked" "Duplicate Linked" "Alt+D" Objects Run(r#"{"op":"duplicate_objects","linked":true}"#) => "Copies objects that go on sharing their meshes.";
    "Edit" "edit.join" "Join Objects" "Ctrl+J" TwoObjects Run(r#"{"op":"join_objects"}"#) => "Puts the selected objects into the active one.";
    "Edit/Parent" "parent.menu" "Parent Menu" "Ctrl+P" Objects Ui(UiRequest::Popup("Edit/Parent")) => "Chooses how objects hang on the active one.";
    "Edit/Parent" "parent.keep" "Object, Stay in Place" "" TwoObjects Ui(UiRequest::Parent { keeps_transform: true }) => "Hangs the selected objects on the active one; they stay where they are.";
    "Edit/Parent" "parent.take" "Object, Take Its Space" "" TwoObjects Ui(UiRequest::Parent { keeps_transform: false }) => "Hangs the selected objects on the active one; their values count from there, so that they move.";
    "Edit/Clear Parent" "parent.clear_menu" "Clear Parent Menu" "Alt+P" Objects Ui(UiRequest::Popup("Edit/Clear Parent")) => "Chooses how objects are taken off what they hang on.";
    "Edit/Clear Parent" "edit.parent_clear" "Clear Parent, Stay in Place" "" Objects Run(r#"{"op":"set_parent","keep_transform":true}"#) => "Takes objects off what they hang on; they stay where they are.";
    "Edit/Clear Parent" "parent.clear" "Clear Parent, Keep Values" "" Objects Run(r#"{"op":"set_parent"}"#) => "Takes objects off what they hang on; their values count from the world, so that they move.";
    "Edit/Clear" "clear.location" "Clear Location" "Alt+G" Objects Run(r#"{"op":"clear_transform","location":true}"#) => "Moves objects back to the origin.";
    "Edit/Clear" "clear.rotation" "Clear Rotation" "Alt+R" Objects Run(r#"{"op":"clear_transform","rotation":true}"#) => "Turns objects back.";
    "Edit/Clear" "clear.scale" "Clear Scale" "Alt+S" Objects Run(r#"{"op":"clear_transform","scale":true}"#) => "Gives objects their own size again.";
    "Edit/Apply" "apply.menu" "Apply Menu" "Ctrl+A" Objects Ui(UiRequest::Popup("Edit/Apply")) => "Chooses which part of a placement becomes places of vertices.";
    "Edit/Apply" "apply.location" "Location" "" Objects Run(r#"{"op":"apply_transform","location":true}"#) => "Moves the origins of objects to the world's; nothing is seen to move.";
    "Edit/Apply" "apply.rotation" "Rotation" "" Objects Run(r#"{"op":"apply_transform","rotation":true}"#) => "Turns the axes of objects to those of the world; nothing is seen to move.";
    "Edit/Apply" "apply.scale" "Scale" "" Objects Run(r#"{"op":"apply_transform","scale":true}"#) => "Makes the sizes of objects 1; nothing is seen to move.";
    "Edit/Apply" "apply.rotation_and_scale" "Rotation & Scale" "" Objects Run(r#"{"op":"apply_transform","rotation":true,"scale":true}"#) => "Takes turn and size of objects back; nothing is seen to move.";
    "Edit/Apply" "apply.all" "All Transforms" "" Objects Run(r#"{"op":"apply_transform","location":true,"rotation":true,"scale":true}"#) => "Takes the whole placement of objects back; nothing is seen to move.";
    "Edit" "edit.hide" "Hide Objects" "H" Objects Run(r#"{"op":"show_objects","visible":false}"#) => "Hides the selected objects.";
    "Edit" "edit.hide_others" "Hide Other Objects" "Shift+H" Objects Run(r#"{"op":"hide_others"}"#) => "Hides all objects except the selected ones.";
    "Edit" "edit.reveal" "Show Hidden Objects" "Alt+H" ObjectMode Run(r#"{"op":"reveal_objects"}"#) => "Shows all hidden objects, and selects them.";
    "Edit" "edit.delete" "Delete Objects" "X Delete" Objects Run(r#"{"op":"delete_objects"}"#) => "Deletes the selected objects and their descendants.";

    "Edit/Snap To" "snap.toggle" "Snapping" "Shift+Tab" Nothing Ui(UiRequest::Snapping) => "Toggles snapping; Ctrl inverts it while moving.";
    "Edit/Snap To" "snap.increment" "Increment" "" Nothing Ui(UiRequest::Snap(SnapTarget::Increment)) => "Snaps to increments.";
    "Edit/Snap To" "snap.grid" "Grid" "" Nothing Ui(UiRequest::Snap(SnapTarget::Grid)) => "Snaps to the grid.";
    "Edit/Snap To" "snap.vertex" "Vertex" "" Nothing Ui(UiRequest::Snap(SnapTarget::Vertex)) => "Snaps to vertices.";
    "Edit/Snap To" "snap.edge" "Edge" "" Nothing Ui(UiRequest::Snap(SnapTarget::Edge)) => "Snaps to edges.";
    "Edit/Snap To" "snap.face" "Face" "" Nothing Ui(UiRequest::Snap(SnapTarget::Face)) => "Snaps to faces.";
    "Edit" "edit.proportional" "Proportional Editing" "O" Nothing Ui(UiRequest::Proportional) => "Toggles moving nearby elements along.";
    "Edit/Pivot" "pivot.menu" "Pivot Menu" "." Nothing Ui(UiRequest::Popup("Edit/Pivot")) => "Chooses the pivot for rotating and scaling.";
    "Edit/Pivot" "pivot.bounds" "Bounding Box Center" "" Nothing Ui(UiRequest::Pivot(Pivot::Bounds)) => "Rotates and scales about the centre of the bounding box.";
    "Edit/Pivot" "pivot.origin" "Origin" "" Nothing Ui(UiRequest::Pivot(Pivot::Origin)) => "Rotates and scales about the origin of the active object.";
    "Edit/Pivot" "pivot.cursor" "3D Cursor" "" Nothing Ui(UiRequest::Pivot(Pivot::Cursor)) => "Rotates and scales about the 3D cursor.";
    "Edit/Pivot" "pivot.individual" "Individual Origins" "" Nothing Ui(UiRequest::Pivot(Pivot::Individual)) => "Rotates and scales each individually.";
    "Edit/Pivot" "pivot.median" "Median Point" "" Nothing Ui(UiRequest::Pivot(Pivot::Median)) => "Rotates and scales about the mean of the selection.";
    "Edit/Pivot" "pivot.active" "Active Element" "" Nothing Ui(UiRequest::Pivot(Pivot::Active)) => "Rotates and scales about the last selected element.";
    "Edit/Orientation" "orientation.menu" "Orientation Menu" "," Nothing Ui(UiRequest::Popup("Edit/Orientation")) => "Chooses the axes of tools.";
    "Edit/Orientation" "orientation.global" "Global" "" Nothing Ui(UiRequest::Orientation(Orientation::Global)) => "Axes of the world.";
    "Edit/Orientation" "orientation.local" "Local" "" Nothing Ui(UiRequest::Orientation(Orientation::Local)) => "Axes of the active object.";
    "Edit/Orientation" "orientation.normal" "Normal" "" Nothing Ui(UiRequest::Orientation(Orientation::Normal)) => "Axes of the selection, Z along its normal.";
    "Edit/Orientation" "orientation.view" "View" "" Nothing Ui(UiRequest::Orientation(Orientation::View)) => "Axes of the view.";
}
