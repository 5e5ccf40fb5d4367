//! Primitives that KHR_draco_mesh_compression compresses: their accessors describe what a stream
//! holds, and have no bytes of their own, or a plain form for programs that cannot read it.

use std::collections::BTreeMap;
use std::sync::Arc;

use gltf::json::accessor::ComponentType;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;
use serde::Deserialize;
use serde_json::Value;

use super::accessor::{Accessors, valid};
use super::buffers::{Unplaced, UnreadReason};
use super::draco::{self, DecodedAttribute, DecodedMesh, Failure};
use crate::error::{LoadErrorKind, Location};
use crate::warning::Warnings;

/// The extension.
pub(super) const DRACO: &str = "KHR_draco_mesh_compression";

#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct DracoExtension {
    buffer_view: usize,
    /// The number of each attribute in the stream.
    attributes: BTreeMap<String, u32>,
}

/// What the stream of a primitive holds.
pub(super) struct Unpacked {
    /// Three vertices each.
    pub(super) triangles: Vec<u32>,
    /// By the index of their accessors.
    attributes: BTreeMap<usize, UnpackedAttribute>,
}

/// The values of an accessor.
pub(super) struct UnpackedAttribute {
    pub(super) bytes: Arc<[u8]>,
    pub(super) count: usize,
    pub(super) component: ComponentType,
    pub(super) normalized: bool,
}

impl Unpacked {
    pub(super) fn attribute(&self, accessor: usize) -> Option<&UnpackedAttribute> {
        self.attributes.get(&accessor)
    }
}

impl Accessors<'_> {
    /// Decodes the stream of a primitive, if it has one: its accessors are read from there until
    /// the next call. A plain form is used, with a warning, if the stream cannot be read.
    pub(super) fn unpack(
        &mut self,
        primitive: &Primitive,
        location: &Location,
        warnings: &mut Warnings,
    ) -> Result<(), Unplaced> {
        self.unpacked = None;
        let extensions = primitive.extensions.as_ref().map(|extensions| &extensions.others);
        let Some(value) = extensions.and_then(|extensions| extensions.get(DRACO)) else { return Ok(()) };
        match self.read_stream(primitive, value, location, warnings) {
            Ok(unpacked) => self.unpacked = Some(unpacked),
            Err(unread) if self.has_plain_form(primitive) => {
                let what = format!("{}; its uncompressed form is used", unread.what);
                warnings.push(location.clone(), what, unread.remedy);
            }
            Err(unread) => return Err(Unplaced(location.clone(), unread)),
        }
        Ok(())
    }

    /// Whether all accessors of a primitive have bytes of their own.
    fn has_plain_form(&self, primitive: &Primitive) -> bool {
        let has_bytes = |accessor: usize| {
            let accessor = &self.root.accessors[accessor];
            accessor.buffer_view.is_some() || accessor.sparse.is_some()
        };
        let attributes = primitive.attributes.values().map(|accessor| accessor.value());
        let indices = primitive.indices.map(|indices| indices.value());
        attributes.chain(indices).all(has_bytes)
    }

    fn read_stream(
        &mut self,
        primitive: &Primitive,
        value: &Value,
        location: &Location,
        warnings: &mut Warnings,
    ) -> Result<Unpacked, UnreadReason> {
        let extension = DracoExtension::deserialize(value)
            .map_err(|error| malformed(format!("its Draco compression is not described: {error}")))?;
        let mesh = self.decode_view(extension.buffer_view)?;
        let mut warn = |what: String| warnings.push(location.clone(), what, "export the model again");
        if !matches!(valid(&primitive.mode), Some(Mode::Triangles | Mode::TriangleStrip)) {
            warn("its mode does not fit its Draco data, which are triangles; they are drawn".to_owned());
        }
        if let Some(indices) = primitive.indices {
            let (claim, found) = (self.root.accessors[indices.value()].count.0, mesh.triangles.len());
            if claim != found as u64 {
                warn(format!(
                    "it should have {claim} indices, but its Draco data have {found}, which are used"
                ));
            }
        }
        let DecodedMesh { points, triangles, attributes: decoded } = mesh;
        let decoded: BTreeMap<u32, DecodedAttribute> =
            decoded.into_iter().map(|attribute| (attribute.id, attribute)).collect();
        let mut attributes = BTreeMap::new();
        for (name, id) in &extension.attributes {
            let Some(accessor) = accessor_of(primitive, name) else { continue };
            let found = decoded.get(id).ok_or_else(|| {
                malformed(format!("its {name} is attribute {id} of its Draco data, which have none"))
            })?;
            let claim = self.root.accessors[accessor].count.0;
            if claim != points as u64 {
                warn(format!(
                    "its {name} should have {claim} values, but its Draco data have {points}, which are used"
                ));
            }
            attributes.insert(accessor, self.attribute(accessor, name, points, found)?);
        }
        Ok(Unpacked { triangles, attributes })
    }

    fn decode_view(&mut self, view: usize) -> Result<DecodedMesh, UnreadReason> {
        if view >= self.root.buffer_views.len() {
            return Err(malformed(format!("its Draco data are in bufferView {view}, which does not exist")));
        }
        let (buffer, range) =
            self.buffers.view(self.root, view, self.folder).map_err(|unplaced| unplaced.1)?;
        let read = self.buffers.bytes_read();
        let budget = &mut self.buffers.budget;
        budget.allow(read);
        let mesh = draco::decode(&buffer[range], budget).map_err(failed)?;
        let bytes = |attribute: &DecodedAttribute| attribute.values.bytes.len();
        let bytes = 4 * mesh.triangles.len() + mesh.attributes.iter().map(bytes).sum::<usize>();
        self.buffers.unpacked += bytes;
        self.folder.account(bytes as u64).map_err(|refusal| UnreadReason {
            kind: LoadErrorKind::Limit,
            what: refusal.to_string(),
            remedy: refusal.remedy(),
        })?;
        if mesh.points > self.most || mesh.triangles.len() > self.most {
            let what =
                format!("its Draco data have more than the limit of {} vertices or corners", self.most);
            return Err(UnreadReason {
                kind: LoadErrorKind::Limit,
                what,
                remedy: "raise the limit if you trust the file",
            });
        }
        Ok(mesh)
    }

    fn attribute(
        &self,
        accessor: usize,
        name: &str,
        count: usize,
        found: &DecodedAttribute,
    ) -> Result<UnpackedAttribute, UnreadReason> {
        let accessor = &self.root.accessors[accessor];
        let components = valid(&accessor.type_).map(|kind| kind.multiplicity());
        let values = &found.values;
        if components.is_some_and(|components| components != values.components) {
            let (has, should) = (values.components, components.unwrap_or(0));
            let what = format!("its {name} has {has} components in its Draco data and should have {should}");
            return Err(malformed(what));
        }
        // The accessor says what integers mean; where it promises floating point, the stream does.
        let is_float = valid(&accessor.component_type).is_some_and(|kind| kind.0 == ComponentType::F32);
        let normalized = if is_float { values.normalized } else { accessor.normalized };
        Ok(UnpackedAttribute {
            bytes: values.bytes.as_slice().into(),
            count,
            component: values.component,
            normalized,
        })
    }
}

/// The accessor of an attribute by its name.
fn accessor_of(primitive: &Primitive, name: &str) -> Option<usize> {
    let is_named =
        |key: &Checked<Semantic>| matches!(key, Checked::Valid(known) if known.to_string() == name);
    Some(primitive.attributes.iter().find(|(key, _)| is_named(key))?.1.value())
}

fn malformed(what: String) -> UnreadReason {
    UnreadReason { kind: LoadErrorKind::Malformed, what, remedy: "compress or export the model again" }
}

fn failed(failure: Failure) -> UnreadReason {
    let remedy = "export the model without Draco compression";
    match failure {
        Failure::Broken(why) => malformed(format!("its Draco data are invalid: {why}")),
        Failure::Foreign(what) => {
            let what = format!("its Draco data have {what}, which trigon does not read");
            UnreadReason { kind: LoadErrorKind::Unsupported, what, remedy }
        }
        Failure::TooLarge => {
            let what = "its Draco data stand for much more than such a file can hold".to_owned();
            UnreadReason { kind: LoadErrorKind::Limit, what, remedy }
        }
    }
}
