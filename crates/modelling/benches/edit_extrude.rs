//! Extruding, insetting, deleting and dissolving as transactions: much of 250,000 quads with a set of
//! texture coordinates, as `bmesh.ops` in Blender, and one face of a million with its undo.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use trigon_mesh::{Attributes, Mesh, math::Vec2, primitives};
use trigon_modelling::{EditMesh, ExtrudeOffset, FaceId, Inset, LimitedDissolve, Refusal};

fn grid(side: u32) -> Mesh {
    let mut mesh = primitives::grid(2.0, 2.0, side, side);
    let uv = |&vertex: &u32| {
        let position = mesh.positions()[vertex as usize];
        Vec2::new(position.x, position.z)
    };
    let uv_set = mesh.corner_vertices().iter().map(uv).collect();
    let attributes = Attributes { uv_sets: vec![uv_set], ..mesh.attributes().clone() };
    mesh.set_attributes(attributes).expect("one for each corner");
    mesh
}

/// Measures a change of a mesh that is ready, without making and dropping it.
fn change<T>(
    criterion: &mut Criterion,
    name: &str,
    start: &Mesh,
    operation: impl Fn(&mut EditMesh) -> Result<T, Refusal>,
) {
    criterion.bench_function(name, |bencher| {
        bencher.iter_batched(
            || EditMesh::from_mesh(start).0,
            |mut mesh| {
                let done = mesh.transaction(&operation).expect("it is possible");
                (mesh, done)
            },
            BatchSize::PerIteration,
        );
    });
}

/// Measures a change of few elements and undoing it, again and again on the same mesh.
fn local<T>(
    criterion: &mut Criterion,
    name: &str,
    mesh: &mut EditMesh,
    operation: impl Fn(&mut EditMesh) -> Result<T, Refusal>,
) {
    criterion.bench_function(name, |bencher| {
        bencher.iter(|| {
            let (done, mut difference) = mesh.transaction(&operation).expect("it is possible");
            difference.apply(mesh);
            black_box(done)
        });
    });
}

fn rows(criterion: &mut Criterion) {
    let start = grid(500);
    let all: Vec<FaceId> = (0..start.face_count() as u32).map(FaceId::new).collect();
    let tenth: Vec<FaceId> = all.iter().copied().step_by(10).collect();
    let inset = Inset { thickness: 0.0005, ..Inset::default() };
    change(criterion, "extrude region, all faces", &start, |mesh| {
        mesh.extrude_region(&all, ExtrudeOffset::Zero)
    });
    change(criterion, "extrude individual, a tenth", &start, |mesh| {
        mesh.extrude_individual(&tenth, ExtrudeOffset::Zero)
    });
    change(criterion, "inset individual, a tenth", &start, |mesh| mesh.inset_individual(&tenth, inset));
    change(criterion, "inset region, a tenth", &start, |mesh| mesh.inset_region(&tenth, inset));
    change(criterion, "delete a tenth of the faces", &start, |mesh| mesh.delete_faces(&tenth));
    change(criterion, "limited dissolve, all faces", &start, |mesh| {
        mesh.dissolve_limited(&all, LimitedDissolve::default())
    });
}

fn one_of_a_million(criterion: &mut Criterion) {
    let mut mesh = EditMesh::from_mesh(&grid(1000)).0;
    let one = [FaceId::new(500_500)];
    let inset = Inset { thickness: 0.0005, ..Inset::default() };
    local(criterion, "one of a million: extrude", &mut mesh, |mesh| {
        mesh.extrude_region(&one, ExtrudeOffset::Along(0.1))
    });
    local(criterion, "one of a million: inset", &mut mesh, |mesh| mesh.inset_region(&one, inset));
    local(criterion, "one of a million: duplicate", &mut mesh, |mesh| mesh.duplicate(&[], &[], &one));
    local(criterion, "one of a million: delete", &mut mesh, |mesh| mesh.delete_faces(&one));
}

criterion_group! {
    name = all;
    config = Criterion::default().sample_size(10);
    targets = rows, one_of_a_million
}
criterion_main!(all);
