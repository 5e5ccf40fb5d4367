//! How should a mesh be stored that is to be picked and edited? The representations of
//! source D, section 1.3 (row D14), on the tasks that it has: find the edge that is
//! nearest to a point under the mouse, find the faces that change when a vertex moves,
//! and walk to a vertex's neighbours.

mod answer;
mod corner_table;
mod face_list;
mod groups;
mod own;
mod triangles;
mod vertex_list;
mod winged_edge;

#[cfg(test)]
mod tests;

pub use answer::{Found, Storage};
pub use corner_table::CornerTable;
pub use face_list::FaceList;
pub use own::Own;
pub use triangles::Triangles;
pub use vertex_list::VertexList;
pub use winged_edge::WingedEdge;

/// Makes a representation.
pub type Maker = fn(&Triangles) -> Box<dyn Storage>;

/// The name of each representation in tables, with how it is made.
pub const REPRESENTATIONS: [(&str, Maker); 5] = [
    ("vertex lists", |triangles| Box::new(VertexList::new(triangles))),
    ("face lists", |triangles| Box::new(FaceList::new(triangles))),
    ("winged edges", |triangles| Box::new(WingedEdge::new(triangles))),
    ("corner table", |triangles| Box::new(CornerTable::new(triangles))),
    ("faces with edges (D, trigon)", |triangles| Box::new(Own::new(triangles))),
];
