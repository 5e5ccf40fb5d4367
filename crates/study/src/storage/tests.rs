//! All representations give the right answers, at the prices that the report tells.

use super::*;
use std::collections::BTreeSet;
use trigon_math::Vec3;

/// Each representation by its name, made by one of its makers.
fn all(triangles: &Triangles, maker: fn(&Representation) -> Maker) -> Vec<(&'static str, Box<dyn Storage>)> {
    REPRESENTATIONS.iter().map(|way| (way.name, maker(way)(triangles))).collect()
}

/// A point of a face that lies nearest to its first side.
fn click(triangles: &Triangles, face: usize) -> Vec3 {
    let [a, b, c] = triangles.triangles[face].map(|vertex| triangles.positions[vertex as usize]);
    a * 0.5 + b * 0.45 + c * 0.05
}

/// How many indices a question makes a representation read.
fn reads(storage: &dyn Storage, ask: impl Fn(&dyn Storage)) -> u64 {
    let before = storage.reads();
    ask(storage);
    storage.reads() - before
}

/// Found in the triangles themselves, by the definition of each answer.
#[test]
fn all_give_the_answers_that_follow_from_the_triangles() {
    let ball = Triangles::ball(2);
    let storages = [all(&ball, |way| way.plain), all(&ball, |way| way.counted)].into_iter().flatten();
    for (name, storage) in storages {
        for vertex in 0..ball.positions.len() as u32 {
            let around = ball.triangles.iter().filter(|triangle| triangle.contains(&vertex));
            let vertices: BTreeSet<u32> = around.clone().flatten().copied().collect();
            let neighbours: Vec<u32> = vertices.into_iter().filter(|other| *other != vertex).collect();
            let mut triangles: Vec<[u32; 3]> = around.copied().collect();
            triangles.iter_mut().for_each(|triangle| triangle.sort());
            triangles.sort();
            assert_eq!(storage.triangles_around(vertex), triangles, "{name}, about {vertex}");
            assert_eq!(storage.neighbours(vertex), neighbours, "{name}, of {vertex}");
        }
        for (face, &[a, b, _]) in ball.triangles.iter().enumerate() {
            let found = storage.nearest_edge(face as u32, click(&ball, face));
            assert_eq!(found, [a.min(b), a.max(b)], "{name}, on face {face}");
        }
    }
}

/// Counted on paper for an octahedron, whose 6 vertices have 4 neighbours each, and whose 8 faces have 3 edges of 12.
#[test]
fn reads_are_those_counted_on_paper() {
    let at = |x: f32, y: f32, z: f32| Vec3::new(x, y, z);
    let octahedron = Triangles {
        positions: vec![
            at(0.0, 0.0, 1.0),
            at(1.0, 0.0, 0.0),
            at(0.0, 1.0, 0.0),
            at(-1.0, 0.0, 0.0),
            at(0.0, -1.0, 0.0),
            at(0.0, 0.0, -1.0),
        ],
        triangles: (0..4).flat_map(|i| [[0, 1 + i, 1 + (i + 1) % 4], [5, 1 + (i + 1) % 4, 1 + i]]).collect(),
    };
    // Picking an edge, the triangles around a vertex, its neighbours.
    let expected = [
        // All neighbours of all vertices. Then those of the upper vertex, of each of these all four (16), and for each of
        // these that is later in the list of the first a search through it: 2 is found as the 2nd entry and 4 as the 4th
        // from 1, 3 as the 3rd from 2, 4 as the 4th from 3, and 5, from each of the four, nowhere after 4 entries.
        ["vertex lists", "24", "49", "4"],
        // Three vertices; four faces and three vertices of each; four neighbours.
        ["face lists", "3", "16", "4"],
        // Three edges and two ends of each; for each of four edges its number, its ends, a wing and the wing's ends;
        // four numbers and two ends of each.
        ["winged edges", "9", "24", "12"],
        // Three vertices; the vertex's corner, then for each of four corners three vertices and the opposite; one vertex
        // and the opposite.
        ["corner table", "3", "17", "9"],
        // As winged edges; all corners; the ends of all edges.
        ["faces with edges (D, trigon)", "9", "24", "24"],
    ];
    for ((name, storage), row) in all(&octahedron, |way| way.counted).into_iter().zip(expected) {
        let counted = [
            reads(&*storage, |storage| _ = storage.nearest_edge(0, click(&octahedron, 0))),
            reads(&*storage, |storage| _ = storage.triangles_around(0)),
            reads(&*storage, |storage| _ = storage.neighbours(0)),
        ]
        .map(|reads| reads.to_string());
        assert_eq!((name, counted), (row[0], [1, 2, 3].map(|i| row[i].to_owned())));
    }
    for (name, storage) in all(&octahedron, |way| way.plain) {
        assert_eq!(reads(&*storage, |storage| _ = storage.neighbours(0)), 0, "{name} is only timed");
    }
}

/// Source D's reason to store faces and edges: a pick does not depend on the mesh's size.
#[test]
fn faces_make_picking_a_matter_of_three_edges() {
    let [small, large] = [2, 4].map(Triangles::ball);
    for way in REPRESENTATIONS {
        let reads = [&small, &large]
            .map(|ball| reads(&*(way.counted)(ball), |storage| _ = storage.nearest_edge(7, click(ball, 7))));
        let grows = way.name == "vertex lists";
        assert_eq!(reads[1] > reads[0], grows, "{}: {reads:?}", way.name);
    }
}

#[test]
fn only_what_leads_from_vertices_to_faces_walks_in_constant_time() {
    let [small, large] = [2, 4].map(Triangles::ball);
    for way in REPRESENTATIONS {
        let reads = [&small, &large]
            .map(|ball| reads(&*(way.counted)(ball), |storage| _ = storage.triangles_around(20)));
        let grows = way.name == "faces with edges (D, trigon)";
        // Vertices have five or six neighbours.
        assert_eq!(reads[1] > 2 * reads[0], grows, "{}: {reads:?}", way.name);
    }
}

#[test]
fn winged_edges_take_the_most_memory_and_vertex_lists_the_least() {
    let ball = Triangles::ball(3);
    let bytes: Vec<usize> = all(&ball, |way| way.plain).iter().map(|(_, storage)| storage.bytes()).collect();
    let [least, most] = [bytes.iter().min(), bytes.iter().max()];
    assert_eq!((least, most), (bytes.first(), bytes.get(2)), "{bytes:?}");
    let counted: Vec<usize> =
        all(&ball, |way| way.counted).iter().map(|(_, storage)| storage.bytes()).collect();
    assert_eq!(bytes, counted, "counting is no part of a representation");
}
