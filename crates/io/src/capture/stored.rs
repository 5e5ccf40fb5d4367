//! The encoding of captured values: one after the other, in the order in which they are listed, with nothing
//! between them. Numbers are little-endian, floats their bits. The lists in this folder are the file format.
//! An id in a capture becomes the item of that index after reading; an id of a removed item becomes one that
//! finds nothing.

use std::io::{BufRead, BufReader, Read};
use std::sync::Arc;

use flate2::read::ZlibDecoder;
use trigon_math::glam::{Affine2, DAffine3, DMat3, Mat2};
use trigon_math::{DQuat, DVec3, Vec2, Vec3, Vec4};
use trigon_scene::{
    Arena, Id, Material, MaterialId, MeshAsset, MeshId, Node, NodeId, Scene, Skin, SkinId, TextureAsset,
    TextureId,
};

use crate::options::Limits;

/// A value that a capture can contain.
pub(super) trait Stored: Sized {
    fn write(&self, to: &mut CaptureWriter<'_>);
    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage>;
}

/// A struct with all its fields. Omitting one does not compile.
macro_rules! record {
    ($type:ty { $($field:ident),+ $(,)? }) => {
        impl Stored for $type {
            fn write(&self, to: &mut CaptureWriter<'_>) {
                let Self { $($field),+ } = self;
                $($field.write(to);)+
            }

            fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
                Ok(Self { $($field: Stored::read(from)?),+ })
            }
        }
    };
}
pub(super) use record;

/// An enum: a byte for the variant, then its fields.
macro_rules! choice {
    ($type:ty { $($number:literal => $variant:ident $({ $($field:ident),+ })? $(($inner:ident))?),+ $(,)? }) => {
        impl Stored for $type {
            fn write(&self, to: &mut CaptureWriter<'_>) {
                match self {
                    $(Self::$variant $({ $($field),+ })? $(($inner))? => {
                        to.bytes.push($number);
                        $($($field.write(to);)+)?
                        $($inner.write(to);)?
                    })+
                }
            }

            fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
                Ok(match u8::read(from)? {
                    $($number => {
                        $(let $inner = Stored::read(from)?;)?
                        Self::$variant $({ $($field: Stored::read(from)?),+ })? $(($inner))?
                    })+
                    number => {
                        let kind = stringify!($type);
                        return Err(Damage::malformed(format!("there is no {kind} of number {number}")));
                    }
                })
            }
        }
    };
}
pub(super) use choice;

macro_rules! number {
    ($($type:ty),+) => {$(
        impl Stored for $type {
            fn write(&self, to: &mut CaptureWriter<'_>) {
                to.bytes.extend(self.to_le_bytes());
            }

            fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
                from.bytes().map(Self::from_le_bytes)
            }
        }
    )+};
}
number!(u8, u16, u32, u64, f32, f64);

/// A vector of numbers by its own conversions to and from an array.
macro_rules! vector {
    ($($type:ty: $to:ident, $from:ident, $array:ty;)+) => {$(
        impl Stored for $type {
            fn write(&self, to: &mut CaptureWriter<'_>) {
                self.$to().write(to);
            }

            fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
                <$array>::read(from).map(Self::$from)
            }
        }
    )+};
}
vector! {
    Vec2: to_array, from_array, [f32; 2];
    Vec3: to_array, from_array, [f32; 3];
    Vec4: to_array, from_array, [f32; 4];
    DVec3: to_array, from_array, [f64; 3];
    DQuat: to_array, from_array, [f64; 4];
}
record!(Mat2 { x_axis, y_axis });
record!(Affine2 { matrix2, translation });
record!(DMat3 { x_axis, y_axis, z_axis });
record!(DAffine3 { matrix3, translation });

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let mut items = Vec::with_capacity(N);
        for _ in 0..N {
            items.push(T::read(from)?);
        }
        Self::try_from(items).map_err(|_| Damage::malformed("a list is too short"))
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.0.write(to);
        self.1.write(to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

impl Stored for () {
    fn write(&self, _: &mut CaptureWriter<'_>) {}

    fn read(_: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        Ok(())
    }
}

impl Stored for bool {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        to.bytes.push(u8::from(*self));
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Damage::malformed(format!("{other} is not a boolean"))),
        }
    }
}

impl<T: Stored> Stored for Option<T> {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        self.is_some().write(to);
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        bool::read(from)?.then(|| T::read(from)).transpose()
    }
}

impl<T: Stored> Stored for Arc<T> {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        T::write(self, to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        T::read(from).map(Self::new)
    }
}

impl<T: Stored> Stored for Box<T> {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        T::write(self, to);
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        T::read(from).map(Self::new)
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        (self.len() as u64).write(to);
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        // Not reserved: a length is trusted only as far as its items arrive.
        (0..from.count(size_of::<T>())?).map(|_| T::read(from)).collect()
    }
}

impl Stored for String {
    fn write(&self, to: &mut CaptureWriter<'_>) {
        (self.len() as u64).write(to);
        to.bytes.extend(self.as_bytes());
    }

    fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
        let length = from.count(1)?;
        Self::from_utf8(from.run(length)?).map_err(|_| Damage::malformed("a name is not text"))
    }
}

/// Receives the parts of a capture, uncompressed.
pub(super) struct CaptureWriter<'a> {
    pub(super) bytes: Vec<u8>,
    /// Ids are written relative to the existing items of this.
    pub(super) scene: &'a Scene,
}

/// Returns them.
pub(super) struct CaptureReader<'a> {
    /// That of the format.
    pub(super) version: u32,
    stream: BufReader<ZlibDecoder<&'a [u8]>>,
    /// The remaining memory budget in bytes.
    left: u64,
    pub(super) limits: &'a Limits,
    /// What has been read so far, for ids.
    pub(super) ids: Ids,
}

/// Why a part cannot be read.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Damage {
    /// The parts are inconsistent or invalid.
    Malformed(String),
    /// A limit is exceeded.
    Limit(String),
}

impl Damage {
    pub(super) fn malformed(what: impl Into<String>) -> Self {
        Self::Malformed(what.into())
    }
}

impl<'a> CaptureReader<'a> {
    /// Reads compressed parts. Their memory is limited by that for all files of a model.
    pub(super) fn new(version: u32, compressed: &'a [u8], limits: &'a Limits) -> Self {
        let stream = BufReader::new(ZlibDecoder::new(compressed));
        Self { version, stream, left: limits.total_bytes, limits, ids: Ids::default() }
    }

    pub(super) fn bytes<const N: usize>(&mut self) -> Result<[u8; N], Damage> {
        let mut bytes = [0; N];
        self.stream.read_exact(&mut bytes).map_err(|_| Damage::malformed("it ends too early"))?;
        Ok(bytes)
    }

    /// The number of items that follow, each of which takes this many bytes of memory.
    pub(super) fn count(&mut self, each: usize) -> Result<usize, Damage> {
        let count = u64::from_le_bytes(self.bytes()?);
        let wanted = count.checked_mul(each.max(1) as u64).filter(|&wanted| wanted <= self.left);
        let wanted = wanted.ok_or_else(|| {
            let allowed = self.limits.total_bytes;
            Damage::Limit(format!("{count} items of {each} bytes are more than the {allowed} bytes allowed"))
        })?;
        self.left -= wanted;
        usize::try_from(count).map_err(|_| Damage::malformed("a list is too large for memory"))
    }

    /// This many bytes in a row, already counted. Memory is allocated as they arrive.
    pub(super) fn run(&mut self, length: usize) -> Result<Vec<u8>, Damage> {
        let mut bytes = Vec::new();
        let read = (&mut self.stream).take(length as u64).read_to_end(&mut bytes);
        match read {
            Ok(read) if read == length => Ok(bytes),
            _ => Err(Damage::malformed("it ends too early")),
        }
    }

    /// Whether nothing follows.
    pub(super) fn is_at_end(&mut self) -> bool {
        self.stream.fill_buf().is_ok_and(<[u8]>::is_empty)
    }

    /// Whether everything has been read, including the checksum.
    pub(super) fn finish(mut self) -> Result<(), Damage> {
        match self.stream.read(&mut [0]) {
            Ok(0) => Ok(()),
            _ => Err(Damage::malformed("more follows where it should end")),
        }
    }
}

/// Stands for an item that was removed.
const GONE: u32 = u32::MAX;

/// The ids of one kind of item read so far, by their indices, and one that finds nothing.
pub(super) struct Table<T> {
    pub(super) ids: Vec<Id<T>>,
    pub(super) gone: Option<Id<T>>,
}

impl<T> Default for Table<T> {
    fn default() -> Self {
        Self { ids: Vec::new(), gone: None }
    }
}

/// All ids that have been read.
#[derive(Default)]
pub(super) struct Ids {
    pub(super) textures: Table<TextureAsset>,
    pub(super) meshes: Table<MeshAsset>,
    pub(super) materials: Table<Material>,
    pub(super) skins: Table<Skin>,
    pub(super) nodes: Table<Node>,
}

macro_rules! id {
    ($($type:ty: $table:ident, $arena:expr;)+) => {$(
        impl Stored for $type {
            fn write(&self, to: &mut CaptureWriter<'_>) {
                let arena: fn(&Scene) -> &Arena<_> = $arena;
                let is_alive = arena(to.scene).get(*self).is_some();
                if is_alive { self.index() as u32 } else { GONE }.write(to);
            }

            fn read(from: &mut CaptureReader<'_>) -> Result<Self, Damage> {
                let index = u32::read(from)?;
                let table = &from.ids.$table;
                let found = if index == GONE { table.gone } else { table.ids.get(index as usize).copied() };
                let what = stringify!($table);
                found.ok_or_else(|| Damage::malformed(format!("{what} has no item {index}")))
            }
        }
    )+};
}
id! {
    TextureId: textures, |scene| &scene.textures;
    MeshId: meshes, Scene::meshes;
    MaterialId: materials, |scene| &scene.materials;
    SkinId: skins, |scene| &scene.skins;
    NodeId: nodes, Scene::nodes;
}
