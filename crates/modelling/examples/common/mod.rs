//! What the examples for the scripts in `tests/peers` share.

use std::error::Error;

use trigon_math::Vec3;
use trigon_mesh::MeshBuilder;
use trigon_modelling::EditMesh;

/// Reads an OBJ file, of which only `v` and `f` count.
pub(crate) fn read(path: &str) -> Result<EditMesh, Box<dyn Error>> {
    let mut builder = MeshBuilder::new();
    for line in std::fs::read_to_string(path)?.lines() {
        let mut words = line.split_whitespace();
        match words.next() {
            Some("v") => {
                let position: Vec<f32> = words.take(3).map(str::parse).collect::<Result<_, _>>()?;
                builder.push_vertex(Vec3::from_array(position[..].try_into()?));
            }
            Some("f") => {
                let index =
                    |word: &str| word.split('/').next().unwrap_or(word).parse::<u32>().map(|index| index - 1);
                let face: Vec<u32> = words.map(index).collect::<Result<_, _>>()?;
                builder.push_face(&face)?;
            }
            _ => {}
        }
    }
    Ok(EditMesh::from_mesh(&builder.build()).0)
}
