//! Operations on all of a grid of 500 by 500 quads with texture coordinates, as transactions that can
//! be undone: merging, subdivision, triangles and back.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use trigon_mesh::primitives;
use trigon_modelling::{EdgeId, EditMesh, FaceId, QuadLimits, Refusal, VertexId};

/// Times an operation and the record for undo, not the copy that it works on and its end.
fn bench<T>(
    criterion: &mut Criterion,
    name: &str,
    start: &EditMesh,
    operation: impl Fn(&mut EditMesh) -> Result<T, Refusal>,
) {
    criterion.benchmark_group("250,000 quads").sample_size(10).bench_function(name, |bencher| {
        bencher.iter_batched(
            || start.clone(),
            |mut mesh| {
                let done = mesh.transaction(&operation);
                (mesh, done)
            },
            BatchSize::PerIteration,
        );
    });
}

fn operations(criterion: &mut Criterion) {
    let (mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, 500, 500));
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    let edges: Vec<EdgeId> = mesh.edges().collect();
    let faces: Vec<FaceId> = mesh.faces().collect();
    bench(criterion, "merge by distance, nothing to merge", &mesh, |mesh| {
        mesh.merge_by_distance(&vertices, 1e-6)
    });
    // The distance is a little more than a side: each vertex that stays takes one or two neighbours.
    bench(criterion, "merge by distance, half of the vertices", &mesh, |mesh| {
        mesh.merge_by_distance(&vertices, 0.0041)
    });
    bench(criterion, "subdivide flat", &mesh, |mesh| mesh.subdivide(&edges, 1));
    bench(criterion, "Catmull-Clark, one level", &mesh, |mesh| mesh.catmull_clark(1));
    bench(criterion, "triangulate", &mesh, |mesh| mesh.triangulate_faces(&faces));
    let mut triangles = mesh;
    triangles.triangulate_faces(&faces).expect("the faces exist");
    let faces: Vec<FaceId> = triangles.faces().collect();
    bench(criterion, "triangles to quads", &triangles, |mesh| {
        mesh.tris_to_quads(&faces, QuadLimits::default())
    });
}

criterion_group!(benches, operations);
criterion_main!(benches);
