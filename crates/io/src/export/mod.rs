//! What all exporters share: they write scenes for other programs, in formats that hold less than a scene.
//!
//! [`export`](crate::export()) chooses the format. `gather` transforms every visible mesh for the file, `losses`
//! lists what the format cannot hold, and the module of the format writes (`obj/write`, `ply/write`, `stl/write`,
//! `off/write`). A GLB holds nearly everything and has its own path (`gltf/write`).

mod files;
mod gather;
mod losses;
mod number;
mod options;
mod plain_name;
mod vertex_table;

pub use files::{Export, ExportedFile};
pub(crate) use gather::{Gathered, Object};
pub(crate) use losses::{HeldPoints, Holds, add_losses, losses_of_whole};
pub(crate) use number::{Precision, number_text, push_number};
pub use options::{Encoding, ExportOptions, FaceExport};
pub(crate) use plain_name::plain_name;
pub(crate) use vertex_table::{Columns, VertexTable};
