//! The formats that glTF allows for each kind of accessor (glTF 2.0 specification, sections 3.7.2, 3.7.3 and
//! 3.11; KHR_mesh_quantization). Accessors of these formats are read once the meshes are built: for
//! instances, skins and animations.
//!
//! Other formats are read as plain numbers, with a warning: other programs refuse them or read them
//! differently.

use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};

use super::accessor::{Accessors, Doubts, valid};
use super::buffers::{Buffers, Unplaced};
use crate::error::LoadError;
use crate::import::Import;
use crate::warning::Warnings;

/// What an accessor is read as.
pub(crate) struct Usage {
    /// For people: `NORMAL`.
    pub(crate) name: &'static str,
    /// All that are read.
    pub(crate) types: &'static [Type],
    plain: &'static [AccessorFormat],
    /// With KHR_mesh_quantization besides.
    quantized: &'static [AccessorFormat],
}

/// A component type, and whether its integers are normalized.
type AccessorFormat = (ComponentType, bool);

const F32: AccessorFormat = (ComponentType::F32, false);
const U8: AccessorFormat = (ComponentType::U8, false);
const U8_NORMALIZED: AccessorFormat = (ComponentType::U8, true);
const I8: AccessorFormat = (ComponentType::I8, false);
const I8_NORMALIZED: AccessorFormat = (ComponentType::I8, true);
const U16: AccessorFormat = (ComponentType::U16, false);
const U16_NORMALIZED: AccessorFormat = (ComponentType::U16, true);
const I16: AccessorFormat = (ComponentType::I16, false);
const I16_NORMALIZED: AccessorFormat = (ComponentType::I16, true);

const SHARES: &[AccessorFormat] = &[F32, U8_NORMALIZED, U16_NORMALIZED];
const TURNS: &[AccessorFormat] = &[F32, I8_NORMALIZED, U8_NORMALIZED, I16_NORMALIZED, U16_NORMALIZED];
const DIRECTIONS: &[AccessorFormat] = &[I8_NORMALIZED, I16_NORMALIZED];
const DELTAS: &[AccessorFormat] = &[I8, I8_NORMALIZED, I16, I16_NORMALIZED];
const ALL_SMALL: &[AccessorFormat] =
    &[I8, I8_NORMALIZED, U8, U8_NORMALIZED, I16, I16_NORMALIZED, U16, U16_NORMALIZED];

const fn usage(
    name: &'static str,
    types: &'static [Type],
    plain: &'static [AccessorFormat],
    quantized: &'static [AccessorFormat],
) -> Usage {
    Usage { name, types, plain, quantized }
}

pub(crate) const POSITION: Usage = usage("POSITION", &[Type::Vec3], &[F32], ALL_SMALL);
pub(crate) const NORMAL: Usage = usage("NORMAL", &[Type::Vec3], &[F32], DIRECTIONS);
pub(crate) const TANGENT: Usage = usage("TANGENT", &[Type::Vec4], &[F32], DIRECTIONS);
pub(crate) const TEXCOORD: Usage = usage("TEXCOORD", &[Type::Vec2], SHARES, ALL_SMALL);
pub(crate) const COLOR: Usage = usage("COLOR_0", &[Type::Vec3, Type::Vec4], SHARES, &[]);
pub(crate) const JOINTS: Usage = usage("JOINTS", &[Type::Vec4], &[U8, U16], &[]);
pub(crate) const WEIGHTS: Usage = usage("WEIGHTS", &[Type::Vec4], SHARES, &[]);
pub(crate) const TARGET_POSITION: Usage = usage("POSITION of a morph target", &[Type::Vec3], &[F32], DELTAS);
pub(crate) const TARGET_NORMAL: Usage = usage("NORMAL of a morph target", &[Type::Vec3], &[F32], DIRECTIONS);
pub(crate) const TARGET_TANGENT: Usage =
    usage("TANGENT of a morph target", &[Type::Vec3], &[F32], DIRECTIONS);
pub(crate) const BIND_MATRIX: Usage = usage("its bind matrices", &[Type::Mat4], &[F32], &[]);
pub(crate) const TIMES: Usage = usage("its times", &[Type::Scalar], &[F32], &[]);
pub(crate) const VECTORS: Usage = usage("its vectors", &[Type::Vec3], &[F32], &[]);
pub(crate) const ROTATIONS: Usage = usage("its rotations", &[Type::Vec4], TURNS, &[]);
pub(crate) const MORPH_WEIGHTS: Usage = usage("its weights", &[Type::Scalar], TURNS, &[]);

impl Usage {
    /// What to say of an accessor whose format glTF does not allow here.
    pub(crate) fn fault(&self, root: &Root, accessor: usize) -> Option<String> {
        let accessor = &root.accessors[accessor];
        let component = valid(&accessor.component_type)?.0;
        // Normalized floats are floats.
        let format = (component, accessor.normalized && component != ComponentType::F32);
        let quantized = if is_quantized(root) { self.quantized } else { &[] };
        if self.plain.contains(&format) || quantized.contains(&format) {
            return None;
        }
        let name = match component {
            ComponentType::I8 => "BYTE",
            ComponentType::U8 => "UNSIGNED_BYTE",
            ComponentType::I16 => "SHORT",
            ComponentType::U16 => "UNSIGNED_SHORT",
            ComponentType::U32 => "UNSIGNED_INT",
            ComponentType::F32 => "FLOAT",
        };
        let normalized = if format.1 { "normalized " } else { "" };
        let what = self.name;
        Some(format!(
            "the format of {what} is {normalized}{name}, which glTF does not allow; the numbers are used as they are"
        ))
    }
}

fn is_quantized(root: &Root) -> bool {
    let mut declared = root.extensions_used.iter().chain(&root.extensions_required);
    declared.any(|name| name == "KHR_mesh_quantization")
}

/// What accessors are read from.
pub(crate) struct AccessorReader<'r> {
    pub(crate) root: &'r Root,
    pub(crate) buffers: Buffers,
    /// See [`Accessors::spent`].
    pub(crate) spent: usize,
}

impl AccessorReader<'_> {
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
