//! glTF 2.0 and GLB.

use crate::error::{LoadError, LoadErrorKind};
use crate::import::Import;

pub(crate) fn import_glb(import: &mut Import<'_>, _bytes: &[u8]) -> Result<(), LoadError> {
    Err(LoadError::new(LoadErrorKind::Unsupported, import.path, "not yet", "soon"))
}

pub(crate) fn import_gltf(import: &mut Import<'_>, bytes: &[u8]) -> Result<(), LoadError> {
    import_glb(import, bytes)
}
