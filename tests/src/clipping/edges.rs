//! Hard case 15: an edge is cut at the same bits, whoever asks.

use proptest::prelude::*;
use trigon_math::{ClipPolygon, Vec4, clip_segment};

use super::check::{bits, clip, weights_are_convex};
use super::input;
use super::vertices::positions_follow_weights;
use crate::effort::cases;

/// The vertices' bits, from the least on: equal for equal cycles.
fn cycle(polygon: &ClipPolygon, order: [usize; 3]) -> Vec<([u32; 4], [u32; 3])> {
    let mut vertices: Vec<_> = polygon
        .vertices()
        .iter()
        .map(|v| (bits(v.position), order.map(|corner| v.weights[corner].to_bits())))
        .collect();
    let first = (0..vertices.len()).min_by_key(|&index| {
        let rotated: Vec<_> = vertices[index..].iter().chain(&vertices[..index]).collect();
        rotated
    });
    vertices.rotate_left(first.unwrap_or(0));
    vertices
}

/// Whether `from` and `to` follow each other in a polygon.
fn has_edge(polygon: &ClipPolygon, from: Vec4, to: Vec4) -> bool {
    let vertices = polygon.vertices();
    (0..vertices.len()).any(|index| {
        let next = &vertices[(index + 1) % vertices.len()];
        bits(vertices[index].position) == bits(from) && bits(next.position) == bits(to)
    })
}

proptest! {
    #![proptest_config(cases(6_000))]

    /// The first vertex of a triangle and its winding change nothing else.
    #[test]
    fn rotations_and_reversal_give_the_same_polygon(
        [a, b, c] in input::triangle(), planes in input::planes(),
    ) {
        let polygon = clip([a, b, c], &planes);
        positions_follow_weights([a, b, c], &planes, polygon.vertices());
        let expected = cycle(&polygon, [0, 1, 2]);
        prop_assert_eq!(&cycle(&clip([b, c, a], &planes), [2, 0, 1]), &expected);
        prop_assert_eq!(&cycle(&clip([c, a, b], &planes), [1, 2, 0]), &expected);
        let mut reversed = cycle(&clip([c, b, a], &planes), [2, 1, 0]);
        reversed.sort();
        let mut sorted = expected;
        sorted.sort();
        prop_assert_eq!(reversed, sorted);
    }

    /// Two triangles at an edge, in both directions, have the same ends of what
    /// is left of it, and a segment has them, too.
    #[test]
    fn both_triangles_at_an_edge_and_the_segment_agree(
        [a, b, c] in input::triangle(), [d, ..] in input::triangle(), planes in input::planes(),
    ) {
        let forward = clip_segment([a, b], &planes.volume());
        let backward = clip_segment([b, a], &planes.volume());
        match (forward, backward) {
            (Some([p, q]), Some([r, s])) => {
                prop_assert_eq!(bits(p.position), bits(s.position));
                prop_assert_eq!(bits(q.position), bits(r.position));
                prop_assert_eq!(p.weights, [s.weights[1], s.weights[0]]);
                weights_are_convex(&p);
                weights_are_convex(&q);
                positions_follow_weights([a, b], &planes, &[p, q]);
                let (left, right) = (clip([a, b, c], &planes), clip([b, a, d], &planes));
                let (p, q) = (p.position, q.position);
                prop_assert!(left.is_empty() || has_edge(&left, p, q), "left triangle");
                prop_assert!(right.is_empty() || has_edge(&right, q, p), "right triangle");
            }
            (forward, backward) => prop_assert!(forward.is_none() && backward.is_none()),
        }
    }
}
