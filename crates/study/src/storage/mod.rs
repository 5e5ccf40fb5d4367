//! How should a mesh be stored that is picked and edited? The representations of source D, section 1.3 (row D14),
//! on three tasks of an editor: find the edge nearest to the pointer, find the faces that change when a vertex
//! moves, and visit the neighbours of a vertex.

mod answer;
mod representations;

#[cfg(test)]
mod tests;

pub use answer::{Storage, Triangles};
pub use representations::{CornerTable, FaceList, Own, VertexList, WingedEdge};

/// Makes a representation.
pub type Maker = fn(&Triangles) -> Box<dyn Storage>;

/// A representation with its name in tables.
pub struct Representation {
    /// Its name.
    pub name: &'static str,
    /// Makes one that counts nothing, to be timed.
    pub plain: Maker,
    /// Makes one that counts what it reads.
    pub counted: Maker,
}

/// All representations.
pub const REPRESENTATIONS: [Representation; 5] = [
    Representation {
        name: "vertex lists",
        plain: |triangles| Box::new(VertexList::<false>::new(triangles)),
        counted: |triangles| Box::new(VertexList::<true>::new(triangles)),
    },
    Representation {
        name: "face lists",
        plain: |triangles| Box::new(FaceList::<false>::new(triangles)),
        counted: |triangles| Box::new(FaceList::<true>::new(triangles)),
    },
    Representation {
        name: "winged edges",
        plain: |triangles| Box::new(WingedEdge::<false>::new(triangles)),
        counted: |triangles| Box::new(WingedEdge::<true>::new(triangles)),
    },
    Representation {
        name: "corner table",
        plain: |triangles| Box::new(CornerTable::<false>::new(triangles)),
        counted: |triangles| Box::new(CornerTable::<true>::new(triangles)),
    },
    Representation {
        name: "faces with edges (D, trigon)",
        plain: |triangles| Box::new(Own::<false>::new(triangles)),
        counted: |triangles| Box::new(Own::<true>::new(triangles)),
    },
];
