//! All representations give the same answers, at the prices that the report tells.

use super::answer::edge;
use super::*;
use trigon_math::Vec3;

fn all(triangles: &Triangles) -> Vec<Box<dyn Storage>> {
    REPRESENTATIONS.iter().map(|(_, make)| make(triangles)).collect()
}

/// A point of a face that lies nearest to its first side.
fn click(triangles: &Triangles, face: usize) -> Vec3 {
    let [a, b, c] = triangles.triangles[face].map(|vertex| triangles.positions[vertex as usize]);
    a * 0.5 + b * 0.45 + c * 0.05
}

#[test]
fn all_give_the_same_answers() {
    let ball = Triangles::ball(2);
    let storages = all(&ball);
    for vertex in 0..ball.positions.len() as u32 {
        let expected = storages[1].triangles_around(vertex).answer;
        let neighbours = storages[1].neighbours(vertex).answer;
        assert!(expected.len() == neighbours.len() && expected.len() >= 5, "as many triangles as neighbours");
        for (storage, (name, _)) in storages.iter().zip(REPRESENTATIONS) {
            assert_eq!(storage.triangles_around(vertex).answer, expected, "{name}, about {vertex}");
            assert_eq!(storage.neighbours(vertex).answer, neighbours, "{name}, of {vertex}");
        }
    }
    for (face, &[a, b, _]) in ball.triangles.iter().enumerate() {
        for (storage, (name, _)) in storages.iter().zip(REPRESENTATIONS) {
            let found = storage.nearest_edge(face as u32, click(&ball, face)).answer;
            assert_eq!(found, edge(a, b), "{name}, on face {face}");
        }
    }
}

/// Source D's reason to store faces and edges: a pick does not depend on the mesh's size.
#[test]
fn faces_make_picking_a_matter_of_three_edges() {
    let [small, large] = [2, 4].map(Triangles::ball);
    for (name, make) in REPRESENTATIONS {
        let reads = [&small, &large].map(|ball| make(ball).nearest_edge(7, click(ball, 7)).reads);
        let grows = name == "vertex lists";
        assert_eq!(reads[1] > reads[0], grows, "{name}: {reads:?}");
    }
}

#[test]
fn only_what_leads_from_vertices_to_faces_walks_in_constant_time() {
    let [small, large] = [2, 4].map(Triangles::ball);
    for (name, make) in REPRESENTATIONS {
        let reads = [&small, &large].map(|ball| make(ball).triangles_around(20).reads);
        let grows = name == "faces with edges (D, trigon)";
        // Vertices have five or six neighbours.
        assert_eq!(reads[1] > 2 * reads[0], grows, "{name}: {reads:?}");
    }
}

#[test]
fn winged_edges_take_the_most_memory_and_vertex_lists_the_least() {
    let bytes: Vec<usize> = all(&Triangles::ball(3)).iter().map(|storage| storage.bytes()).collect();
    let [least, most] = [bytes.iter().min(), bytes.iter().max()];
    assert_eq!((least, most), (bytes.first(), bytes.get(2)), "{bytes:?}");
}
