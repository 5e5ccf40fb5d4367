//! The encoding of values: one after the other, in the order in which they are listed, with nothing
//! between them. The lists in this folder are the format.

use std::sync::Arc;

use trigon_math::glam::{Affine2, DAffine3, DMat3, Mat2};
use trigon_math::{DQuat, DVec3, Vec2, Vec3, Vec4};

use super::stream::{Damage, Reader, Writer};

/// A value that a capture can contain.
pub(super) trait Stored: Sized {
    fn write(&self, to: &mut Writer<'_>);
    fn read(from: &mut Reader<'_>) -> Result<Self, Damage>;
}

/// A struct with all its fields. Omitting one does not compile.
macro_rules! record {
    ($type:ty { $($field:ident),+ $(,)? }) => {
        impl Stored for $type {
            fn write(&self, to: &mut Writer<'_>) {
                let Self { $($field),+ } = self;
                $($field.write(to);)+
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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
            fn write(&self, to: &mut Writer<'_>) {
                match self {
                    $(Self::$variant $({ $($field),+ })? $(($inner))? => {
                        to.bytes.push($number);
                        $($($field.write(to);)+)?
                        $($inner.write(to);)?
                    })+
                }
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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
            fn write(&self, to: &mut Writer<'_>) {
                to.bytes.extend(self.to_le_bytes());
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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
            fn write(&self, to: &mut Writer<'_>) {
                self.$to().write(to);
            }

            fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
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
    fn write(&self, to: &mut Writer<'_>) {
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let mut items = Vec::with_capacity(N);
        for _ in 0..N {
            items.push(T::read(from)?);
        }
        Self::try_from(items).map_err(|_| Damage::malformed("a list is too short"))
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn write(&self, to: &mut Writer<'_>) {
        self.0.write(to);
        self.1.write(to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        Ok((A::read(from)?, B::read(from)?))
    }
}

impl Stored for () {
    fn write(&self, _: &mut Writer<'_>) {}

    fn read(_: &mut Reader<'_>) -> Result<Self, Damage> {
        Ok(())
    }
}

impl Stored for bool {
    fn write(&self, to: &mut Writer<'_>) {
        to.bytes.push(u8::from(*self));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        match u8::read(from)? {
            0 => Ok(false),
            1 => Ok(true),
            other => Err(Damage::malformed(format!("{other} is not a boolean"))),
        }
    }
}

impl<T: Stored> Stored for Option<T> {
    fn write(&self, to: &mut Writer<'_>) {
        self.is_some().write(to);
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        bool::read(from)?.then(|| T::read(from)).transpose()
    }
}

impl<T: Stored> Stored for Arc<T> {
    fn write(&self, to: &mut Writer<'_>) {
        T::write(self, to);
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        T::read(from).map(Self::new)
    }
}

impl<T: Stored> Stored for Vec<T> {
    fn write(&self, to: &mut Writer<'_>) {
        (self.len() as u64).write(to);
        self.iter().for_each(|item| item.write(to));
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        // Not reserved: a length is trusted only as far as its items arrive.
        (0..from.count(size_of::<T>())?).map(|_| T::read(from)).collect()
    }
}

impl Stored for String {
    fn write(&self, to: &mut Writer<'_>) {
        (self.len() as u64).write(to);
        to.bytes.extend(self.as_bytes());
    }

    fn read(from: &mut Reader<'_>) -> Result<Self, Damage> {
        let length = from.count(1)?;
        Self::from_utf8(from.run(length)?).map_err(|_| Damage::malformed("a name is not text"))
    }
}
