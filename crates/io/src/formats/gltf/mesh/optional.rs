//! Optional attributes of primitives.

use gltf::json::mesh::{Primitive, Semantic};
use gltf::json::validation::Checked;

use crate::error::Location;
use crate::formats::gltf::accessor::Accessors;
use crate::formats::gltf::buffers::Unplaced;
use crate::formats::gltf::formats::{self, Usage};
use crate::warning::Warnings;

/// The number of UV sets always read, and the maximum.
const UV_SETS: u32 = 2;
const MOST_UV_SETS: u32 = 8;

/// The accessor of an attribute.
pub(super) fn find(primitive: &Primitive, semantic: Semantic) -> Option<usize> {
    primitive.attributes.get(&Checked::Valid(semantic)).map(|accessor| accessor.value())
}

/// Reads optional attributes of primitives.
pub(super) struct Optional<'o, 'a> {
    pub(super) accessors: &'o mut Accessors<'a>,
    pub(super) primitive: &'o Primitive,
    pub(super) vertices: usize,
    pub(super) location: &'o Location,
    pub(super) warnings: &'o mut Warnings,
}

impl Optional<'_, '_> {
    pub(super) fn read<const N: usize>(
        &mut self,
        semantic: Semantic,
        usage: &Usage,
    ) -> Result<Option<Vec<[f32; N]>>, Unplaced> {
        find(self.primitive, semantic).map_or(Ok(None), |index| self.read_accessor(index, usage))
    }

    pub(super) fn has(&self, semantic: Semantic) -> bool {
        find(self.primitive, semantic).is_some()
    }

    /// `None`, with a warning, if there is not one value per vertex.
    pub(super) fn read_accessor<const N: usize>(
        &mut self,
        index: usize,
        usage: &Usage,
    ) -> Result<Option<Vec<[f32; N]>>, Unplaced> {
        let (name, count) = (usage.name, self.accessors.count(index));
        if count != self.vertices as u64 {
            let what = format!("{name} has {count} values for {} vertices and is ignored", self.vertices);
            self.warn(what);
            return Ok(None);
        }
        if let Some(what) = usage.fault(self.accessors.root, index) {
            self.warn(what);
        }
        self.accessors.vectors(index, usage.types).map(Some)
    }

    pub(super) fn warn(&mut self, what: impl Into<String>) {
        self.warnings.push(self.location.clone(), what, "export the model again");
    }

    /// A warning about `count` vertices.
    pub(super) fn warn_counted(&mut self, count: usize, what: &str) {
        self.warnings.push_counted(count, self.location.clone(), what, "export the model again");
    }

    /// The UV sets; sets that a material needs and the primitive lacks are copies of the first.
    /// Later sets keep their number: a missing one before them is empty.
    pub(super) fn uv_sets(&mut self, wanted: &[u32]) -> Result<Vec<Vec<[f32; 2]>>, Unplaced> {
        let last = wanted.iter().copied().filter(|&set| set < MOST_UV_SETS).max();
        let mut sets = Vec::new();
        for set in 0..UV_SETS.max(last.map_or(0, |last| last + 1)) {
            sets.push(self.read::<2>(Semantic::TexCoords(set), &formats::TEXCOORD)?);
        }
        for &set in wanted {
            if sets.get(set as usize).is_some_and(Option::is_some) {
                continue;
            }
            let instead = match &sets[0] {
                _ if set >= MOST_UV_SETS => "the texture is not drawn",
                Some(_) => "TEXCOORD_0 is used",
                None => "the texture shows one colour",
            };
            let what = format!("one of its textures needs TEXCOORD_{set}, which is missing; {instead}");
            self.warnings.push(self.location.clone(), what, "export the model with that UV map");
            if (set as usize) < sets.len() {
                sets[set as usize] = sets[0].clone();
            }
        }
        while sets.last().is_some_and(Option::is_none) {
            sets.pop();
        }
        Ok(sets.into_iter().map(Option::unwrap_or_default).collect())
    }
}
