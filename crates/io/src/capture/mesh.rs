//! Meshes: the data from which they were built; everything else is recomputed.

use trigon_mesh::{Attributes, Deltas, Mesh, MeshBuilder, MeshError, MorphTarget, SkinWeights};

use super::stored::{Stored, record};
use super::stream::{Damage, Reader, Writer};

record!(Attributes {
    corner_normals,
    corner_tangents,
    uv_sets,
    corner_colors,
    vertex_colors,
    face_materials,
    face_smooth,
    skin,
    morph_targets,
});
record!(MorphTarget { name, positions, normals, tangents });

impl Stored for Mesh {
    fn write(&self, to: &mut Writer<'_>) {
        self.positions().to_vec().write(to);
        self.faces().map(|corners| corners.len() as u32).collect::<Vec<_>>().write(to);
        self.corner_vertices().to_vec().write(to);
        self.loose_edges().to_vec().write(to);
        self.loose_points().to_vec().write(to);
        self.attributes().write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let mut builder = MeshBuilder::new();
        for position in Vec::read(from)? {
            builder.push_vertex(position);
        }
        let (sizes, corners) = (Vec::<u32>::read(from)?, Vec::<u32>::read(from)?);
        let mut rest = corners.as_slice();
        for size in sizes {
            let Some((face, after)) = rest.split_at_checked(size as usize) else {
                return Err(Damage::malformed("a face has more corners than there are"));
            };
            builder.push_face(face).map_err(broken)?;
            rest = after;
        }
        for [start, end] in Vec::<[u32; 2]>::read(from)? {
            builder.push_loose_edge(start, end).map_err(broken)?;
        }
        for point in Vec::read(from)? {
            builder.push_loose_point(point).map_err(broken)?;
        }
        let mut mesh = builder.build();
        mesh.set_attributes(Stored::read(from)?).map_err(broken)?;
        Ok(mesh)
    }
}

fn broken(error: MeshError) -> Damage {
    Damage::malformed(error.to_string())
}

impl Stored for Deltas {
    fn write(&self, to: &mut Writer<'_>) {
        self.iter().collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        Stored::read(from).map(Self::new)
    }
}

impl Stored for SkinWeights {
    fn write(&self, to: &mut Writer<'_>) {
        (self.per_vertex() as u32).write(to);
        self.joints().to_vec().write(to);
        self.weights().to_vec().write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let per_vertex = u32::read(from)?;
        let (joints, weights) = (Stored::read(from)?, Stored::read(from)?);
        let skin = Self::from_normalized(per_vertex as usize, joints, weights);
        skin.ok_or_else(|| Damage::malformed("the weights of a skin do not fit each other"))
    }
}
