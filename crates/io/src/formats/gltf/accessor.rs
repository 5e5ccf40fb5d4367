//! Accessors: typed numbers in a buffer, decoded with checked arithmetic.
//!
//! Every claim (count, offset, stride) is compared with the bytes that exist
//! before anything is allocated, so memory stays proportional to the file.
//! Normalized integers follow the glTF 2.0 specification, section 3.6.2.2:
//! c / 255, max(c / 127, −1), and so on.

use std::collections::BTreeSet;

use gltf::json::Root;
use gltf::json::accessor::{ComponentType, Type};
use gltf::json::validation::Checked;

use super::buffers::{Buffers, Bytes, Unplaced, UnreadReason};
use super::packed::{Unpacked, UnpackedAttribute};
use crate::error::{LoadErrorKind, Location};
use crate::folder::Folder;
use crate::warning::Warnings;

/// The maximum number of elements of an accessor without bytes: its elements are zero, and nothing
/// else limits them.
const MOST_ZEROS: usize = 1 << 20;

/// Strips of one-byte indices make three corners per byte; the rest is room for primitives that
/// share vertices.
const CORNERS_PER_BYTE: usize = 8;

/// The allowance for small files.
const CORNERS_ALWAYS: usize = 1 << 24;

/// Reads accessors of one document.
pub(crate) struct Accessors<'a> {
    pub(crate) root: &'a Root,
    pub(crate) buffers: &'a mut Buffers,
    pub(crate) folder: &'a mut Folder,
    /// The maximum number of elements of one accessor.
    pub(crate) most: usize,
    /// How many vertices and corners primitives may use in total, whatever the bytes say.
    pub(crate) most_corners: usize,
    /// The number used so far.
    pub(crate) spent: &'a mut usize,
    /// What the compressed primitive that is being read holds.
    pub(super) unpacked: Option<Unpacked>,
    /// Problems of accessors that were read anyway.
    pub(crate) doubts: Doubts,
}

/// Problems of accessors, by their index; each once, however often it is read.
#[derive(Default)]
pub(crate) struct Doubts(BTreeSet<(usize, &'static str)>);

impl Doubts {
    pub(crate) fn tell(self, warnings: &mut Warnings) {
        for (index, what) in self.0 {
            warnings.push(Location::Item("accessor", index), what, "export the model again");
        }
    }
}

/// The result of [`Accessors::tight_bytes`].
pub(crate) struct TightBytes {
    pub(crate) bytes: Bytes,
    pub(crate) component: ComponentType,
    pub(crate) kind: Type,
    pub(crate) normalized: bool,
    pub(crate) count: usize,
}

const ALL_TYPES: &[Type] =
    &[Type::Scalar, Type::Vec2, Type::Vec3, Type::Vec4, Type::Mat2, Type::Mat3, Type::Mat4];

/// The location of an accessor's elements in the bytes of a view.
#[derive(Clone, Copy)]
struct AccessorLayout {
    count: usize,
    /// Bytes from one element to the next.
    stride: usize,
    start: usize,
    component: ComponentType,
    components: usize,
    normalized: bool,
}

impl Accessors<'_> {
    /// The number of elements: the claimed one, unless they are compressed.
    pub(crate) fn count(&self, index: usize) -> u64 {
        let unpacked = self.unpacked.as_ref().and_then(|unpacked| unpacked.attribute(index));
        unpacked.map_or(self.root.accessors[index].count.0, |unpacked| unpacked.count as u64)
    }

    /// Counts the vertices or corners of a primitive. Thousands of primitives may share one
    /// accessor and so use thousands of times what the file holds; no legitimate file goes far in
    /// that.
    pub(crate) fn spend(&mut self, corners: usize, location: &Location) -> Result<(), Unplaced> {
        let sharing = self.buffers.bytes_read().saturating_mul(CORNERS_PER_BYTE).max(CORNERS_ALWAYS);
        let most = sharing.min(self.most_corners);
        *self.spent = self.spent.saturating_add(corners);
        if *self.spent <= most {
            return Ok(());
        }
        let what = format!("the primitives up to here make more than {most} corners of what the file holds");
        let remedy = "let nodes share a mesh instead of repeating its primitives";
        Err(Unplaced(location.clone(), UnreadReason { kind: LoadErrorKind::Limit, what, remedy }))
    }

    /// Decodes an accessor of a vector type to f32. `allowed` are the valid types; `N` is the size
    /// of the largest. Missing components are 1, as for alpha.
    pub(crate) fn vectors<const N: usize>(
        &mut self,
        index: usize,
        allowed: &[Type],
    ) -> Result<Vec<[f32; N]>, Unplaced> {
        let (mut layout, bytes) = self.open(index, allowed)?;
        let (count, components) = (layout.count, layout.components);
        let mut elements = vec![[0.0; N]; count];
        for element in &mut elements {
            element[components..].fill(1.0);
        }
        if let Some((buffer, range)) = bytes {
            read_vectors(&buffer[range], &layout, elements.iter_mut());
        }
        if let Some((targets, start, values)) = self.sparse(index, &layout)? {
            (layout.stride, layout.start) = (layout.component.size() * components, start);
            let mut at = values.1.start + layout.start;
            for target in targets {
                let one = &values.0[at..at + layout.stride];
                read_vectors(
                    one,
                    &AccessorLayout { count: 1, start: 0, ..layout },
                    std::iter::once(&mut elements[target]),
                );
                at += layout.stride;
            }
        }
        Ok(elements)
    }

    /// The bytes of an accessor whose elements are contiguous; `None` for others, and for sparse or
    /// missing storage.
    pub(crate) fn tight_bytes(&mut self, index: usize) -> Result<Option<TightBytes>, Unplaced> {
        let accessor = &self.root.accessors[index];
        if accessor.sparse.is_some() {
            return Ok(None);
        }
        let (layout, bytes) = self.open(index, ALL_TYPES)?;
        let size = layout.component.size() * layout.components;
        let (Some((buffer, range)), Some(kind)) = (bytes, valid(&accessor.type_)) else { return Ok(None) };
        let start = range.start + layout.start;
        let AccessorLayout { count, component, normalized, .. } = layout;
        let bytes = (buffer, start..start + count * size);
        Ok((layout.stride == size).then_some(TightBytes { bytes, component, kind, normalized, count }))
    }

    /// Records a stride in a view that may not have one: glTF allows strides for attributes only,
    /// and other programs read past them.
    pub(crate) fn doubt_stride(&mut self, index: usize) {
        let accessor = &self.root.accessors[index];
        let (Some(view), Some(type_), Some(component)) =
            (accessor.buffer_view, valid(&accessor.type_), valid(&accessor.component_type))
        else {
            return;
        };
        let size = component.0.size() * components_of(type_);
        let stride = self.root.buffer_views[view.value()].byte_stride;
        if stride.is_some_and(|stride| stride.0 != size) {
            let what = "its bufferView has a byteStride, which is allowed for vertex attributes only; the stride is followed";
            self.doubts.0.insert((index, what));
        }
    }

    /// Decodes an accessor of indices.
    pub(crate) fn indices(&mut self, index: usize) -> Result<Vec<u32>, Unplaced> {
        self.doubt_stride(index);
        let (layout, bytes) = self.open(index, &[Type::Scalar])?;
        if !matches!(layout.component, ComponentType::U8 | ComponentType::U16 | ComponentType::U32) {
            return Err(malformed(index, "indices must be unsigned integers".to_owned()));
        }
        let mut indices = match &bytes {
            Some((buffer, range)) => read_indices(&buffer[range.clone()], &layout),
            None => vec![0; layout.count],
        };
        if let Some((targets, start, values)) = self.sparse(index, &layout)? {
            let tight =
                AccessorLayout { count: targets.len(), stride: layout.component.size(), start, ..layout };
            for (target, value) in targets.into_iter().zip(read_indices(&values.0[values.1], &tight)) {
                indices[target] = value;
            }
        }
        Ok(indices)
    }

    /// Checks an accessor against its view; the bytes are `None` if it has no view and so is all
    /// zero.
    fn open(&mut self, index: usize, allowed: &[Type]) -> Result<(AccessorLayout, Option<Bytes>), Unplaced> {
        let accessor = &self.root.accessors[index];
        let type_ = valid(&accessor.type_).filter(|type_| allowed.contains(type_));
        let type_ =
            type_.ok_or_else(|| malformed(index, format!("its type must be {}", type_names(allowed))))?;
        let component = valid(&accessor.component_type)
            .ok_or_else(|| malformed(index, "its componentType is unknown".to_owned()))?
            .0;
        let components = components_of(type_);
        if let Some(unpacked) = self.unpacked.as_ref().and_then(|unpacked| unpacked.attribute(index)) {
            let UnpackedAttribute { bytes, count, component, normalized } = unpacked;
            let (&component, &normalized, stride) = (component, normalized, component.size() * components);
            let layout =
                AccessorLayout { count: *count, stride, start: 0, component, components, normalized };
            return Ok((layout, Some((bytes.clone(), 0..bytes.len()))));
        }
        let count = self.checked_count(index)?;
        let size = component.size() * components;
        let layout = |start, stride| AccessorLayout {
            count,
            stride,
            start,
            component,
            components,
            normalized: accessor.normalized,
        };
        let Some(view) = accessor.buffer_view.map(|view| view.value()) else {
            if accessor.byte_offset.is_some_and(|offset| offset.0 > 0) {
                let what = "it has a byteOffset and no bufferView; all of its numbers are 0";
                self.doubts.0.insert((index, what));
            }
            if count > MOST_ZEROS {
                let what =
                    format!("{count} elements and no bufferView; at most {MOST_ZEROS} may be all zero");
                return Err(malformed(index, what));
            }
            return Ok((layout(0, size), None));
        };
        let stride = self.root.buffer_views[view].byte_stride.map_or(size, |stride| stride.0);
        let start = accessor.byte_offset.map_or(0, |offset| offset.0);
        let length = self.root.buffer_views[view].byte_length.0;
        if stride < size {
            return Err(malformed(index, format!("elements of {size} bytes are only {stride} bytes apart")));
        }
        let needed = (count as u64 - 1)
            .checked_mul(stride as u64)
            .and_then(|bytes| bytes.checked_add(size as u64))
            .and_then(|bytes| bytes.checked_add(start));
        if needed.is_none_or(|needed| needed > length) {
            let what = format!(
                "{count} elements from byte {start}, {stride} bytes apart, lie outside bufferView {view}, which has {length} bytes"
            );
            return Err(malformed(index, what));
        }
        let bytes = self.buffers.view(self.root, view, self.folder)?;
        Ok((layout(start as usize, stride), Some(bytes)))
    }

    fn checked_count(&self, index: usize) -> Result<usize, Unplaced> {
        let count = self.count(index);
        let count = usize::try_from(count).ok().filter(|&count| count <= self.most);
        match count {
            Some(0) => Err(malformed(index, "its count is 0".to_owned())),
            Some(count) => Ok(count),
            None => {
                let what = format!("{} elements are more than the limit of {}", self.count(index), self.most);
                let remedy = "raise the limit if you trust the file";
                Err(Unplaced(
                    Location::Item("accessor", index),
                    UnreadReason { kind: LoadErrorKind::Limit, what, remedy },
                ))
            }
        }
    }

    /// The elements that sparse storage replaces, the offset of their values in the bytes, and
    /// those bytes.
    fn sparse(
        &mut self,
        index: usize,
        layout: &AccessorLayout,
    ) -> Result<Option<(Vec<usize>, usize, Bytes)>, Unplaced> {
        let Some(sparse) = &self.root.accessors[index].sparse else { return Ok(None) };
        let count = usize::try_from(sparse.count.0).ok().filter(|&count| count <= layout.count);
        let count = count
            .ok_or_else(|| malformed(index, "it replaces more sparse elements than it has".to_owned()))?;
        let component = valid(&sparse.indices.component_type);
        let component =
            component.ok_or_else(|| malformed(index, "its sparse componentType is unknown".to_owned()))?.0;
        let indices = self.range(
            index,
            sparse.indices.buffer_view.value(),
            sparse.indices.byte_offset.0,
            count,
            component.size(),
        )?;
        let tight = AccessorLayout {
            count,
            stride: component.size(),
            start: sparse.indices.byte_offset.0 as usize,
            component,
            components: 1,
            normalized: false,
        };
        let targets: Vec<usize> =
            read_indices(&indices.0[indices.1], &tight).into_iter().map(|target| target as usize).collect();
        if let Some(target) = targets.iter().find(|&&target| target >= layout.count) {
            return Err(malformed(
                index,
                format!("its sparse index {target} is not below its count {}", layout.count),
            ));
        }
        if targets.windows(2).any(|pair| pair[0] >= pair[1]) {
            let what = "its sparse indices do not increase; of values for the same element, the last counts";
            self.doubts.0.insert((index, what));
        }
        let size = layout.component.size() * layout.components;
        for (view, size) in
            [(sparse.indices.buffer_view, component.size()), (sparse.values.buffer_view, size)]
        {
            let stride = self.root.buffer_views[view.value()].byte_stride;
            if stride.is_some_and(|stride| stride.0 != size) {
                let what = "a bufferView of its sparse data has a byteStride, which is not allowed there; the stride is ignored";
                self.doubts.0.insert((index, what));
            }
        }
        let values =
            self.range(index, sparse.values.buffer_view.value(), sparse.values.byte_offset.0, count, size)?;
        Ok(Some((targets, sparse.values.byte_offset.0 as usize, values)))
    }

    /// A view that holds `count` tight elements from an offset.
    fn range(
        &mut self,
        index: usize,
        view: usize,
        offset: u64,
        count: usize,
        size: usize,
    ) -> Result<Bytes, Unplaced> {
        let length = self.root.buffer_views[view].byte_length.0;
        let needed = (count as u64).checked_mul(size as u64).and_then(|bytes| bytes.checked_add(offset));
        if needed.is_none_or(|needed| needed > length) {
            return Err(malformed(
                index,
                format!(
                    "its {count} sparse elements lie outside bufferView {view}, which has {length} bytes"
                ),
            ));
        }
        self.buffers.view(self.root, view, self.folder)
    }
}

fn malformed(index: usize, what: String) -> Unplaced {
    Unplaced(
        Location::Item("accessor", index),
        UnreadReason { kind: LoadErrorKind::Malformed, what, remedy: "export the model again" },
    )
}

pub(super) fn valid<T: Copy>(checked: &Checked<T>) -> Option<T> {
    match checked {
        Checked::Valid(value) => Some(*value),
        Checked::Invalid => None,
    }
}

/// Types as glTF names them.
fn type_names(types: &[Type]) -> String {
    let name = |type_: &Type| match type_ {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    };
    types.iter().map(name).collect::<Vec<_>>().join(" or ")
}

fn components_of(type_: Type) -> usize {
    match type_ {
        Type::Scalar => 1,
        Type::Vec2 => 2,
        Type::Vec3 => 3,
        Type::Vec4 | Type::Mat2 => 4,
        Type::Mat3 => 9,
        Type::Mat4 => 16,
    }
}

fn read_vectors<'e, const N: usize>(
    bytes: &[u8],
    layout: &AccessorLayout,
    elements: impl Iterator<Item = &'e mut [f32; N]>,
) {
    let size = layout.component.size();
    for (index, element) in elements.enumerate() {
        let start = layout.start + index * layout.stride;
        let parts = bytes[start..start + size * layout.components].chunks_exact(size);
        for (value, part) in element.iter_mut().zip(parts) {
            *value = component(part, layout.component, layout.normalized);
        }
    }
}

fn read_indices(bytes: &[u8], layout: &AccessorLayout) -> Vec<u32> {
    match layout.component.size() {
        1 => read_each(bytes, layout, |[byte]| u32::from(byte)),
        2 => read_each(bytes, layout, |bytes| u32::from(u16::from_le_bytes(bytes))),
        _ => read_each(bytes, layout, u32::from_le_bytes),
    }
}

/// Numbers of `N` bytes.
fn read_each<const N: usize>(bytes: &[u8], layout: &AccessorLayout, number: fn([u8; N]) -> u32) -> Vec<u32> {
    let one = |index: usize| {
        let start = layout.start + index * layout.stride;
        number(*bytes[start..].first_chunk().expect("checked against the view"))
    };
    (0..layout.count).map(one).collect()
}

fn component(part: &[u8], kind: ComponentType, normalized: bool) -> f32 {
    let fit = || <[u8; 2]>::try_from(part).expect("a component of two bytes");
    let fit4 = || <[u8; 4]>::try_from(part).expect("a component of four bytes");
    let (value, largest) = match kind {
        ComponentType::I8 => (f32::from(part[0] as i8), 127.0),
        ComponentType::U8 => (f32::from(part[0]), 255.0),
        ComponentType::I16 => (f32::from(i16::from_le_bytes(fit())), 32767.0),
        ComponentType::U16 => (f32::from(u16::from_le_bytes(fit())), 65535.0),
        ComponentType::U32 => return u32::from_le_bytes(fit4()) as f32,
        ComponentType::F32 => return f32::from_le_bytes(fit4()),
    };
    if !normalized {
        value
    } else if value < -largest {
        -1.0
    } else {
        value / largest
    }
}
