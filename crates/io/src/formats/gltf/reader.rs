//! Reading accessors once the meshes are built: for instances, skins and
//! animations.

use gltf::json::Root;

use super::accessor::{Accessors, Doubts};
use super::buffers::{Buffers, Unplaced};
use crate::error::LoadError;
use crate::import::Import;
use crate::warning::Warnings;

/// What accessors are read from.
pub(crate) struct Reader<'r> {
    pub(crate) root: &'r Root,
    pub(crate) buffers: Buffers,
    /// See [`Accessors::spent`].
    pub(crate) spent: usize,
}

impl Reader<'_> {
    /// Calls back with accessors, and with the warnings to add to.
    pub(crate) fn read<T>(
        &mut self,
        import: &mut Import<'_>,
        read: impl FnOnce(&mut Accessors<'_>, &mut Warnings) -> Result<T, Unplaced>,
    ) -> Result<T, LoadError> {
        let limits = &import.options.limits;
        let mut accessors = Accessors {
            root: self.root,
            buffers: &mut self.buffers,
            folder: &mut import.folder,
            most: limits.vertices.max(limits.corners),
            most_corners: limits.corners,
            spent: &mut self.spent,
            unpacked: None,
            doubts: Doubts::default(),
        };
        let read = read(&mut accessors, &mut import.warnings);
        accessors.doubts.tell(&mut import.warnings);
        read.map_err(|unplaced| unplaced.into_error(import.path))
    }
}
