//! Meshes: the data from which they were built, with the colours of elements and the named sets of them. Everything
//! else is recomputed.

use trigon_mesh::{Attributes, Deltas, Mesh, MeshBuilder, MeshError, MorphTarget, SkinWeights};
use trigon_scene::{ElementSet, FixedBitSet, Mark, Marks, NodeId, VertexPoints};

use super::stored::{CaptureReader, CaptureWriter, Damage, Stored, record};

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
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.positions().to_vec().write(to);
        self.faces().map(|corners| corners.len() as u32).collect::<Vec<_>>().write(to);
        self.corner_vertices().to_vec().write(to);
        self.loose_edges().to_vec().write(to);
        self.loose_points().to_vec().write(to);
        self.attributes().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
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
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.iter().collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        Stored::read(from).map(Self::new)
    }
}

impl Stored for SkinWeights {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        (self.per_vertex() as u32).write(to);
        self.joints().to_vec().write(to);
        self.weights().to_vec().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let per_vertex = u32::read(from)?;
        let (joints, weights) = (Stored::read(from)?, Stored::read(from)?);
        let skin = Self::from_normalized(per_vertex as usize, joints, weights);
        skin.ok_or_else(|| Damage::malformed("the weights of a skin do not fit each other"))
    }
}

/// Elements in a word of a set.
const BITS: usize = u32::BITS as usize;

record!(Marks { edges, faces, vertices });
record!(Mark { elements, color, opacity, outlined });
record!(VertexPoints { size, marked_size, color });

/// For each node its number of elements, and a bit for each, from the lowest of a word on.
impl Stored for ElementSet {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        let of_nodes = self.nodes().map(|(node, bits)| (node, (bits.len() as u32, words(bits))));
        of_nodes.collect::<Vec<_>>().write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let mut set = Self::default();
        for (node, (count, words)) in Vec::<(NodeId, (u32, Vec<u32>))>::read(from)? {
            set.add(node, bits(count as usize, &words)?);
        }
        Ok(set)
    }
}

fn words(bits: &FixedBitSet) -> Vec<u32> {
    let mut words = vec![0; bits.len().div_ceil(BITS)];
    bits.ones().for_each(|element| words[element / BITS] |= 1 << (element % BITS));
    words
}

/// They take no more memory than was read.
fn bits(count: usize, words: &[u32]) -> Result<FixedBitSet, Damage> {
    let mut bits = FixedBitSet::with_capacity(words.len() * BITS);
    let elements = words.iter().enumerate().flat_map(|(index, word)| {
        (0..BITS).filter(move |bit| word >> bit & 1 != 0).map(move |bit| index * BITS + bit)
    });
    bits.extend(elements);
    let is_whole = words.len() == count.div_ceil(BITS) && bits.maximum().is_none_or(|last| last < count);
    if !is_whole {
        return Err(Damage::malformed("a set of elements has another length than it says"));
    }
    let mut exact = FixedBitSet::with_capacity(count);
    exact.extend(bits.ones());
    Ok(exact)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sets_of_any_length_come_back() {
        for count in [0, 1, 31, 32, 33, 100] {
            let mut set = FixedBitSet::with_capacity(count);
            set.extend((0..count).filter(|element| element % 3 == 0));
            assert_eq!(bits(count, &words(&set)), Ok(set), "{count} elements");
        }
    }

    #[test]
    fn elements_beyond_the_end_are_refused() {
        for (count, words) in [(3, &[0b1000][..]), (33, &[0]), (1_000_000_000, &[1]), (0, &[0])] {
            assert!(bits(count, words).is_err(), "{words:?} for {count} elements");
        }
    }
}
