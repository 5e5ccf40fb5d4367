//! Bevels, loop cuts and slides of grids, with their transactions: of many elements, and of a few of
//! a million quads. `cargo bench -p trigon-modelling --bench edit_bevel`

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use trigon_mesh::primitives;
use trigon_modelling::{BevelSettings, EdgeId, EditMesh, LoopCutSettings};

/// A grid of `side` by `side` quads with texture coordinates.
fn grid(side: u32) -> EditMesh {
    EditMesh::from_mesh(&primitives::grid(2.0, 2.0, side, side)).0
}

/// Runs a change and undoes it, so that the mesh can be used again.
fn there_and_back<T>(mesh: &mut EditMesh, change: impl FnOnce(&mut EditMesh) -> T) -> T {
    let (made, mut difference) =
        mesh.transaction(|mesh| Ok::<_, std::convert::Infallible>(change(mesh))).expect("it is not refused");
    difference.apply(mesh);
    made
}

fn many(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("many");
    group.sample_size(20);
    let whole = grid(200);
    let tenth: Vec<EdgeId> = whole.edges().step_by(10).collect();
    let settings = BevelSettings { width: 0.0005, ..BevelSettings::default() };
    for clamp_overlap in [false, true] {
        let settings = BevelSettings { clamp_overlap, ..settings };
        let name = if clamp_overlap { "with clamp" } else { "without clamp" };
        group.bench_function(format!("bevel a tenth of the edges of 40,000 quads, {name}"), |bencher| {
            bencher.iter_batched_ref(
                || whole.clone(),
                |mesh| mesh.transaction(|mesh| mesh.bevel_edges(&tenth, &settings)).expect("edges"),
                BatchSize::LargeInput,
            );
        });
    }
}

fn few(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("few of a million quads, and undone");
    let mut mesh = grid(1000);
    let face = mesh.faces().nth(500_500).expect("a million");
    let edges: Vec<EdgeId> = mesh.face_edges(face).collect();
    let settings = BevelSettings { width: 0.0005, ..BevelSettings::default() };
    group.bench_function("bevel of the edges of a face", |bencher| {
        bencher
            .iter(|| there_and_back(&mut mesh, |mesh| mesh.bevel_edges(&edges, &settings).expect("edges")));
    });
    group.bench_function("loop cut", |bencher| {
        let cut = LoopCutSettings::default();
        bencher.iter(|| there_and_back(&mut mesh, |mesh| mesh.loop_cut(edges[0], &cut).expect("quads")));
    });
    let made = mesh.loop_cut(edges[0], &LoopCutSettings::default()).expect("quads");
    group.bench_function("slide of a loop", |bencher| {
        bencher
            .iter(|| there_and_back(&mut mesh, |mesh| mesh.slide_edges(&made.edges, 0.5).expect("a loop")));
    });
}

criterion_group!(benches, many, few);
criterion_main!(benches);
