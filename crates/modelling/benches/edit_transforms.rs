//! Moving vertices, turning faces over and mirroring, each within a transaction, so that what undoes
//! it is part of the time.

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use trigon_math::{DMat3, DVec3, Plane, elementary};
use trigon_mesh::primitives;
use trigon_modelling::{
    EditMesh, FaceId, Falloff, FalloffDistance, FalloffShape, MoveSession, Transform, VertexId,
};

/// A wavy grid of so many quads to a side, two metres wide, with a set of texture coordinates.
fn grid(side: u32) -> EditMesh {
    let (mut mesh, _) = EditMesh::from_mesh(&primitives::grid(2.0, 2.0, side, side));
    let vertices: Vec<VertexId> = mesh.vertices().collect();
    for vertex in vertices {
        let mut place = mesh.position(vertex);
        let [x, z] = [place.x, place.z].map(|along| f64::from(along) * 0.5 + 0.5);
        place.y = (0.1 * elementary::sin(9.0 * x) * elementary::cos(7.0 * z)) as f32;
        mesh.set_position(vertex, place);
    }
    mesh
}

fn moving(criterion: &mut Criterion) {
    let mut mesh = grid(1000);
    let all: Vec<VertexId> = mesh.vertices().collect();
    let some = &all[..10_000];
    let lift = Transform::Translate { offset: DVec3::Y * 0.01 };
    let turn =
        Transform::Rotate { center: DVec3::ZERO, axis: DVec3::Y, angle: 0.01, orientation: DMat3::IDENTITY };
    let mut group = criterion.benchmark_group("1,000,000 quads");
    let mut move_once = |vertices: &[VertexId], transform: &Transform, falloff: Option<&Falloff>| {
        mesh.transaction(|mesh| mesh.transform_vertices(vertices, transform, falloff)).expect("possible")
    };
    group.bench_function("move 10,000 vertices", |b| b.iter(|| move_once(some, &lift, None)));
    group.bench_function("rotate all vertices", |b| b.iter(|| move_once(&all, &turn, None)));
    for distance in [FalloffDistance::Straight, FalloffDistance::AlongEdges] {
        let falloff = Falloff { shape: FalloffShape::Smooth, radius: 0.5, distance };
        group.bench_function(format!("move 10,000 vertices, falloff over half a metre {distance:?}"), |b| {
            b.iter(|| move_once(some, &lift, Some(&falloff)));
        });
    }
    let mut mesh = grid(1000);
    let falloff = Falloff { radius: 4.0, ..Falloff::default() };
    let mut session = MoveSession::with_falloff(&mesh, some, &falloff).expect("possible");
    group.bench_function("one step of a session, rotate with falloff over all", |b| {
        b.iter(|| session.apply(&mut mesh, &turn).expect("possible"));
    });
    group.finish();
}

fn faces(criterion: &mut Criterion) {
    let mut mesh = grid(500);
    let all: Vec<FaceId> = mesh.faces().collect();
    let mut group = criterion.benchmark_group("250,000 quads");
    group.bench_function("recalculate normals, all right", |b| {
        b.iter(|| mesh.transaction(|mesh| mesh.recalculate_normals(&all)).expect("possible"));
    });
    let half: Vec<FaceId> = all.iter().copied().step_by(3).collect();
    let mut turned = mesh.clone();
    turned.flip_faces(&half).expect("possible");
    group.bench_function("recalculate normals, a third wrong", |b| {
        b.iter_batched_ref(
            || turned.clone(),
            |mesh| mesh.transaction(|mesh| mesh.recalculate_normals(&all)).expect("possible"),
            BatchSize::PerIteration,
        );
    });
    group.bench_function("flip all", |b| {
        b.iter(|| mesh.transaction(|mesh| mesh.flip_faces(&all)).expect("possible"));
    });
    let middle = Plane::from_point_and_normal(DVec3::ZERO, DVec3::X).expect("a plane");
    group.bench_function("mirror a copy", |b| {
        b.iter(|| {
            let copy = mesh.transaction(|mesh| mesh.mirror_copy(&all, &[], &middle, None));
            let (_, mut difference) = copy.expect("possible");
            difference.apply(&mut mesh);
        });
    });
    group.bench_function("symmetrize", |b| {
        b.iter(|| {
            let made = mesh.transaction(|mesh| mesh.symmetrize(&all, &middle, 1e-6));
            let (_, mut difference) = made.expect("possible");
            difference.apply(&mut mesh);
        });
    });
    group.bench_function("scale", |b| {
        let vertices: Vec<VertexId> = mesh.vertices().collect();
        let factors = DVec3::new(1.0, 1.001, 1.0);
        let scale = Transform::Scale { center: DVec3::ZERO, factors, orientation: DMat3::IDENTITY };
        b.iter(|| {
            mesh.transaction(|mesh| mesh.transform_vertices(&vertices, &scale, None)).expect("possible")
        });
    });
    group.finish();
}

criterion_group!(benches, moving, faces);
criterion_main!(benches);
