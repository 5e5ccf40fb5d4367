//! What is kept from frame to frame. What each algorithm gets right or wrong is tested where it is measured, in
//! `trigon-study`.

use super::*;

/// Two tetrahedra that cross.
fn crossing() -> Scene {
    let one = [[1000, 1000, 0], [15000, 2000, 9000], [2000, 15000, 4000], [3000, 3000, 5000]];
    let other = [[15000, 1000, 500], [1000, 3000, 9000], [14000, 15000, 4000], [9000, 9000, 1000]];
    Scene::new([64; 2], vec![Body::tetrahedron(one), Body::tetrahedron(other)])
}

#[test]
fn the_second_image_is_the_first() {
    let scene = crossing();
    let (mut painter, mut buffers) = (Painter::new(&scene), Buffers::new(&scene));
    let firsts = [painter.draw(&scene).clone(), buffers.draw(&scene).clone()];
    for Drawing { faces, .. } in &firsts {
        let bodies = |body: u32| faces.values().iter().filter(|&&face| face / 4 == body).count();
        assert!(bodies(0) > 100 && bodies(1) > 100, "both bodies are seen");
    }
    assert!(painter.draw(&scene) == &firsts[0], "the painter's");
    assert!(buffers.draw(&scene) == &firsts[1], "the z-buffer's");
}
