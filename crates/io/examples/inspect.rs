//! Prints what is in model files, without drawing them:
//! `cargo run -p trigon-io --example inspect -- model.glb …`

#![expect(clippy::print_stdout, clippy::print_stderr, reason = "printing is what this example is for")]

use std::process::ExitCode;

use trigon_io::{LoadOptions, Loaded, load};

fn main() -> ExitCode {
    let mut failed = false;
    for path in std::env::args_os().skip(1) {
        match load(&path, &LoadOptions::default()) {
            Ok(loaded) => print(&loaded),
            Err(error) => {
                eprintln!("error: {error}");
                failed = true;
            }
        }
    }
    if failed { ExitCode::FAILURE } else { ExitCode::SUCCESS }
}

fn print(loaded: &Loaded) {
    let Loaded { scene, warnings, files, format, .. } = loaded;
    println!("{}: {format:?}", files[0].display());
    for (id, node) in scene.nodes().iter() {
        let mesh = node.mesh.and_then(|mesh| scene.meshes().get(mesh));
        let shape = mesh.map_or("no mesh".to_owned(), |mesh| {
            let mesh = mesh.mesh();
            let (vertices, edges, faces) = (mesh.vertex_count(), mesh.edge_count(), mesh.face_count());
            format!("{vertices} vertices, {edges} edges, {faces} faces")
        });
        println!("  {id:?} \"{}\": {shape}, {} materials", node.name, node.materials.len());
    }
    println!(
        "  {} meshes, {} materials, {} textures",
        scene.meshes().len(),
        scene.materials.len(),
        scene.textures.len()
    );
    for file in &files[1..] {
        println!("  reads {}", file.display());
    }
    for warning in warnings {
        println!("  warning: {warning}");
    }
}
