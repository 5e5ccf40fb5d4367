//! 3MF, the format of 3D printing (3MF Consortium, Core Specification 1.3, 2021): a zip archive with a model as XML, in
//! units that the file states. Of the Materials and Properties Extension (1.2.1) colour groups are read and written, of
//! the Production Extension (1.2) models in several parts are read.
//!
//! `package` unpacks the parts of the archive, `xml` goes through their elements, `model` holds what they say, `parser`
//! reads it with its `properties`, and `build` makes nodes of it and `mesh` their meshes and materials; `closed` tells
//! whether they are bodies. `write` is the way back, with
//! the objects of `resources` and the colours of a `palette`.

mod build;
mod closed;
mod mesh;
mod model;
mod namespaces;
mod package;
mod palette;
mod parser;
mod properties;
mod resources;
mod text;
mod values;
mod write;
mod xml;

use std::borrow::Cow;
use std::collections::{BTreeMap, VecDeque};

use self::build::build;
use self::model::{Models, ObjectShape};
use self::package::Package;
use self::parser::parse;
use crate::error::LoadError;
use crate::import::Import;
use crate::options::LoadStage;

pub(crate) use write::write_three_mf;

/// Whether a file without a telling name may be a 3MF: whether it is a zip archive. No other format that is read is one.
pub(crate) fn is_three_mf(bytes: &[u8]) -> bool {
    bytes.starts_with(b"PK\x03\x04")
}

/// Reads a 3MF into the scene: a node for each item of its build.
pub(crate) fn import_three_mf(import: &mut Import<'_>, bytes: Cow<'_, [u8]>) -> Result<(), LoadError> {
    import.options.report(import.path, LoadStage::Geometry, 0.0)?;
    let mut package = Package::open(import, &bytes)?;
    let root = package.model_part(import)?;
    let models = read_models(import, &mut package, root)?;
    drop(bytes);
    build(import, &models)?;
    import.options.report(import.path, LoadStage::Geometry, 1.0)
}

/// Reads the model, and those in other parts that it names.
fn read_models(
    import: &mut Import<'_>,
    package: &mut Package<'_>,
    root: String,
) -> Result<Models, LoadError> {
    let mut by_part = BTreeMap::new();
    let mut queue = VecDeque::from([root.clone()]);
    while let Some(part) = queue.pop_front() {
        if by_part.contains_key(&part) {
            continue;
        }
        let bytes = package.read(import, &part)?;
        let model = parse(import, &part, &bytes)?;
        let components = model.objects.values().flat_map(|object| match &object.shape {
            ObjectShape::Components(components) => components.as_slice(),
            ObjectShape::Mesh(_) => &[],
        });
        queue.extend(components.chain(&model.items).filter_map(|placed| placed.part.clone()));
        by_part.insert(part, model);
    }
    Ok(Models { root, by_part })
}
