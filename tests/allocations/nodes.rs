//! What a scene of very many nodes takes: as many bytes for each as a node, its place and its draw have.

use dhat::HeapStats;
use std::num::NonZeroUsize;
use trigon_io::{Limits, LoadOptions};
use trigon_scene::{RenderSettings, Scene, render};

/// The most bytes at a time for each node while a file is read, and then while it is drawn. 10^6 of them are to
/// stay in reach of small machines.
const MOST: [usize; 2] = [900, 1000];

/// So many nodes fill the lists that grow by doubling.
const COUNTS: [usize; 2] = [1 << 14, 1 << 15];

pub(crate) fn assert_nodes_are_small() {
    let peaks = COUNTS.map(|count| {
        let text = nodes(count);
        let _profiler = super::profiler();
        let scene = load(&text);
        let read = HeapStats::get().max_bytes;
        draw(&scene);
        [read, HeapStats::get().max_bytes]
    });
    // What does not depend on the nodes is in both.
    let bytes = [0, 1].map(|stage| (peaks[1][stage] - peaks[0][stage]) / (COUNTS[1] - COUNTS[0]));
    assert!(
        bytes[0] <= MOST[0] && bytes[1] <= MOST[1],
        "bytes for each node read and drawn: {bytes:?} of {MOST:?}"
    );
}

fn load(text: &str) -> Scene {
    let options =
        LoadOptions { threads: NonZeroUsize::new(1), limits: Limits::default(), ..LoadOptions::default() };
    trigon_io::load_from_slice("nodes.gltf", text.as_bytes(), &options).expect("it is sound").scene
}

fn draw(scene: &Scene) {
    let settings = RenderSettings { threads: NonZeroUsize::new(1), ..RenderSettings::new(64, 48) };
    render(scene, &scene.overview(settings.aspect()), &settings).expect("it has a size");
}

/// Copies of one triangle, side by side.
fn nodes(count: usize) -> String {
    let roots: Vec<String> = (0..count).map(|node| node.to_string()).collect();
    let node = |index: usize| {
        format!(r#"{{"mesh":0,"name":"n{index}","translation":[{index}.5,{}.25,0]}}"#, index % 100)
    };
    let nodes: Vec<String> = (0..count).map(node).collect();
    let (roots, nodes) = (roots.join(","), nodes.join(","));
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[{roots}]}}],"nodes":[{nodes}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}}}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3","min":[0,0,0],"max":[1,1,0]}}],
        "bufferViews":[{{"buffer":0,"byteLength":36}}],
        "buffers":[{{"byteLength":36,"uri":"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}}"#
    )
}
