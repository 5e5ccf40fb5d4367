//! The ids of elements. Each kind has its own type, so that a vertex cannot be used as a face.

use std::fmt;

/// What a record holds in place of an index where there is no element.
pub(super) const NONE: u32 = u32::MAX;

macro_rules! id {
    ($name:ident, $kind:literal, $doc:literal) => {
        #[doc = $doc]
        ///
        /// It stays the same while the element lives, whatever is edited around it. After the
        /// element was removed, a new one may get the same id.
        #[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
        pub struct $name(pub(super) u32);

        impl $name {
            /// The id with this index, whether there is such an element or not.
            pub const fn new(index: u32) -> Self {
                Self(index)
            }

            /// Its index: below the capacity that the mesh tells for this kind.
            pub const fn index(self) -> u32 {
                self.0
            }
        }

        impl fmt::Debug for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                write!(f, concat!($kind, " {}"), self.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                fmt::Debug::fmt(self, f)
            }
        }
    };
}

id!(VertexId, "vertex", "A vertex of an [`EditMesh`](super::EditMesh).");
id!(EdgeId, "edge", "An edge of an [`EditMesh`](super::EditMesh).");
id!(CornerId, "corner", "A corner of an [`EditMesh`](super::EditMesh): one vertex of one face.");
id!(FaceId, "face", "A face of an [`EditMesh`](super::EditMesh).");
