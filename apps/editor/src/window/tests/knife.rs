//! The knife by mouse.

use trigon_window::scene::camera::Viewport;

use super::sessions::at_the_editor;

const SIZE: Viewport = Viewport { width: 1000, height: 700 };

#[test]
fn clicks_on_edges_cut_the_faces_between_them() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play(
            "
            keys Tab K
            hover -0.98 0 1
            click -0.98 0 1
            click 0.98 0.5 1
            keys Enter
            mesh Cube 10 15 7
            keys Ctrl+Z
            mesh Cube 8 12 6
            # Across the edge between the front and the right side.
            keys K
            click -0.98 0 1
            click 1 0 -0.95
            keys Enter
            mesh Cube 11 17 8
            keys Ctrl+Z
            # A point within a face, and one taken back.
            keys K
            click -0.98 0 1
            click 0 0.5 1
            click 0.5 0.9 1
            keys Backspace
            click 0.98 0 1
            keys Enter
            mesh Cube 11 16 7
            ",
        );
    });
}

#[test]
fn an_edge_is_cut_in_its_middle_and_escape_leaves_every_byte() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        let bytes = |user: &super::sessions::User<'_>| {
            user.editor.borrow().document.to_native().encode().expect("it can be").to_bytes()
        };
        user.play("keys Tab");
        let before = bytes(user);
        user.play("keys K\nclick -0.98 0 1\nclick 0.98 0 1\nkeys Escape");
        assert_eq!(bytes(user), before, "nothing is left");
        // Far from the middle.
        user.play("keys K\nclick -0.98 -0.6 1 with Shift\nclick 0.98 0.7 1 with Shift\nkeys Enter\nmesh Cube 10 15 7");
        let editor = user.editor.borrow();
        let (id, _) = editor.document.selection().meshes().next().expect("it is edited");
        let mesh = editor.document.mesh(id).expect("it is");
        let cut = mesh.vertices().filter(|&vertex| mesh.position(vertex).y == 0.0).count();
        assert_eq!(cut, 2, "both new vertices are in the middle");
    });
}

/// Half of what was drawn was lost without a word.
#[test]
fn a_cut_closes_within_a_face_and_across_an_edge() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play(
            "
            keys Tab K
            click -0.5 -0.5 1
            click 0.5 -0.5 1
            click 0.5 0.5 1
            click -0.5 0.5 1
            click -0.5 -0.5 1           # closed
            keys Enter
            mesh Cube 12 18 8           # a window, and a ring of two faces
            keys Ctrl+Z
            mesh Cube 8 12 6
            keys K                      # around the edge between the front and the right side
            click 0.5 -0.5 1
            click 1 -0.5 0.5
            click 1 0.5 0.5
            click 0.5 0.5 1
            click 0.5 -0.5 1
            keys Enter
            mesh Cube 14 20 8           # an outline over two faces, which both lose a corner of it
            keys Ctrl+Z
            keys K A
            see 30° steps of the image
            keys A A X
            see along X
            click -0.5 0 1
            click 0.5 0.3 1             # held to x
            keys E
            see points: 2
            keys Escape
            mesh Cube 8 12 6
            ",
        );
    });
}

/// A click a few pixels beside the outline was refused.
#[test]
fn clicks_beside_the_outline_snap_to_it() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play("keys Tab K\nhover -1 0 1\nmove -5 0\nclick\nclick 1 0.5 1\nkeys Enter\nmesh Cube 10 15 7");
    });
}

#[test]
fn a_cut_that_leaves_the_surface_is_refused_with_the_remedy() {
    let folder = tempfile::tempdir().expect("a folder");
    at_the_editor(folder.path(), &[], SIZE, |user| {
        user.play("keys Tab K\nclick -0.98 0 1\nkeys Enter");
        let said = |user: &super::sessions::User<'_>| {
            user.editor.borrow().tool.as_ref().map(|tool| tool.status()).unwrap_or_default()
        };
        assert!(said(user).contains("at least two points"), "{}", said(user));
        user.play("keys Backspace Backspace");
        assert!(user.editor.borrow().tool.is_none(), "all points are gone, and the tool with them");
    });
}
