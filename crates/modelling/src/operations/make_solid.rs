//! All repairs one after the other, in the order that closes most, with a report.

use fixedbitset::FixedBitSet;
use trigon_math::DVec3;

use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId, VertexId};
use crate::inspect::{BoundaryLoop, DoubledVertex};
use crate::refusal::Refusal;

/// How much is repaired.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SolidSettings {
    /// Vertices are joined that are no farther from one at an open edge, and edges go that are no longer; in metres,
    /// from 0 on.
    pub within: f64,
    /// Faces no larger than this go, in square metres.
    pub zero_area: f64,
    /// Holes with more edges stay open.
    pub most_hole_edges: usize,
}

impl Default for SolidSettings {
    /// A micrometre, its square, holes of any size.
    fn default() -> Self {
        Self { within: 1e-6, zero_area: 1e-12, most_hole_edges: usize::MAX }
    }
}

/// What was mended, and what is left.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct SolidReport {
    /// Vertices that were joined with others.
    pub merged_vertices: usize,
    /// Faces without area that went.
    pub zero_area_faces: usize,
    /// Faces that lay on others and went.
    pub doubled_faces: usize,
    /// Edges without faces that went.
    pub loose_edges: usize,
    /// Vertices without edges that went.
    pub loose_vertices: usize,
    /// Holes that were filled.
    pub filled_holes: usize,
    /// Faces that were turned over.
    pub turned_faces: usize,
    /// Edges with one side of a face that are left.
    pub open_edges_left: usize,
    /// Edges with three or more sides of faces that are left.
    pub non_manifold_edges_left: usize,
    /// Edges that are left whose two faces run along them in the same direction.
    pub inconsistent_edges_left: usize,
    /// The volume in cubic metres if the mesh is watertight now.
    pub volume: Option<f64>,
}

impl SolidReport {
    /// How many elements were mended.
    #[must_use]
    pub fn mended(&self) -> usize {
        let Self { merged_vertices, zero_area_faces, doubled_faces, loose_edges, loose_vertices, .. } = *self;
        let removed = merged_vertices + zero_area_faces + doubled_faces + loose_edges + loose_vertices;
        removed + self.filled_holes + self.turned_faces
    }
}

impl EditMesh {
    /// Mends what keeps a mesh from bounding a body: joins vertices at open edges that are at one position, takes away
    /// faces without area, faces on others, and loose edges and vertices, fills holes with a face each, and turns faces
    /// outwards.
    ///
    /// Vertices away from open edges are not joined: closed parts that touch stay as they are. A hole is filled unless
    /// its part is flat, as an open sheet is. What stays open is in the report.
    ///
    /// # Errors
    /// A distance or an area is negative or not finite; the result would not fit the memory budget. Then nothing changes.
    pub fn make_solid(&mut self, settings: &SolidSettings) -> Result<SolidReport, Refusal> {
        check_from_zero("the distance", settings.within)?;
        check_from_zero("the area", settings.zero_area)?;
        self.whole(|mesh| {
            let mut report = SolidReport::default();
            mesh.join_open_vertices(settings.within, &mut report)?;
            report.merged_vertices += mesh.collapse_zero_length_edges(settings.within)?;
            report.zero_area_faces += mesh.dissolve_zero_area_faces(settings.zero_area)?;
            report.doubled_faces += mesh.remove_doubled_faces()?;
            report.loose_edges += mesh.remove_loose_edges()?;
            report.loose_vertices += mesh.remove_loose_vertices()?;
            report.filled_holes = mesh.fill_holes(settings.most_hole_edges)?;
            let faces: Vec<FaceId> = mesh.faces().collect();
            if !faces.is_empty() {
                report.turned_faces = mesh.recalculate_normals(&faces)?.turned.len();
            }
            mesh.report_rest(&mut report);
            Ok(report)
        })
    }

    /// Joins vertices at open edges with all at their positions, and takes away what has no area or lies on another
    /// face then.
    fn join_open_vertices(&mut self, within: f64, report: &mut SolidReport) -> Result<(), Refusal> {
        let mut is_open = FixedBitSet::with_capacity(self.vertex_capacity());
        for edge in self.edges().filter(|&edge| self.is_boundary(edge)) {
            is_open.extend(self.edge_vertices(edge).map(|vertex| vertex.0 as usize));
        }
        let doubles = self.doubled_vertices(within);
        let is_at_open = |double: &&DoubledVertex| {
            is_open.contains(double.vertex.0 as usize) || is_open.contains(double.of.0 as usize)
        };
        // All at a position go together, once one of them is at an open edge.
        let mut firsts: Vec<VertexId> = doubles.iter().filter(is_at_open).map(|double| double.of).collect();
        firsts.sort_unstable();
        firsts.dedup();
        let joined = doubles.iter().filter(|double| firsts.binary_search(&double.of).is_ok());
        let mut vertices: Vec<VertexId> = joined.map(|double| double.vertex).collect();
        if vertices.is_empty() {
            return Ok(());
        }
        vertices.extend(&firsts);
        let merged = self.merge_by_distance(&vertices, within)?;
        report.merged_vertices += merged.removed;
        report.doubled_faces += merged.removed_faces;
        Ok(())
    }

    /// Fills each hole with a face. How many there were that could be filled.
    fn fill_holes(&mut self, most_edges: usize) -> Result<usize, Refusal> {
        let loops = self.boundary_loops();
        if loops.is_empty() {
            return Ok(0);
        }
        let holes = |rim: &&BoundaryLoop| rim.is_closed && rim.edges.len() <= most_edges;
        self.check_capacity_for_each(loops.iter().filter(holes).map(|rim| rim.edges.len()).sum())?;
        let flat = self.faces_of_flat_parts();
        let mut filled = 0;
        for rim in loops.iter().filter(holes) {
            if !self.is_rim_of(rim, &flat) && self.fill_hole(&rim.edges)? {
                filled += 1;
            }
        }
        Ok(filled)
    }

    /// Fills a loop of open edges; false where it touches itself, or a face lies there.
    fn fill_hole(&mut self, edges: &[EdgeId]) -> Result<bool, Refusal> {
        // An earlier face may have closed it.
        if !edges.iter().all(|&edge| self.is_boundary(edge)) {
            return Ok(false);
        }
        match self.fill_edges(edges) {
            Ok(_) => Ok(true),
            Err(refusal @ (Refusal::Memory { .. } | Refusal::TooMany)) => Err(refusal),
            Err(_) => Ok(false),
        }
    }

    fn is_rim_of(&self, rim: &BoundaryLoop, faces: &[FaceId]) -> bool {
        let first = rim.edges.first().and_then(|&edge| self.edge_faces(edge).next());
        first.is_some_and(|face| faces.binary_search(&face).is_ok())
    }

    /// The faces of all parts that lie in a plane, ascending.
    fn faces_of_flat_parts(&self) -> Vec<FaceId> {
        let parts = self.parts().into_iter();
        let mut faces: Vec<FaceId> = parts.filter(|part| self.is_flat(part)).flatten().collect();
        faces.sort_unstable();
        faces
    }

    fn is_flat(&self, part: &[FaceId]) -> bool {
        /// What rounding to f32 makes of a plane, as a fraction of its size, with a margin.
        const FLAT: f64 = 1e-6;
        let area = |&face: &FaceId| self.face_area_vector(face);
        // Faces may look to either side.
        let largest = part.iter().map(area).fold(DVec3::ZERO, |best, area| {
            if area.length_squared() > best.length_squared() { area } else { best }
        });
        let Some(normal) = largest.try_normalize() else { return true };
        let points =
            || part.iter().flat_map(|&face| self.face_vertices(face)).map(|vertex| self.point(vertex));
        let Some(first) = points().next() else { return true };
        let size = points().map(|point| point.distance(first)).fold(0.0, f64::max);
        points().all(|point| (point - first).dot(normal).abs() <= FLAT * size)
    }

    fn report_rest(&self, report: &mut SolidReport) {
        report.open_edges_left = self.edges().filter(|&edge| self.is_boundary(edge)).count();
        report.non_manifold_edges_left = self.non_manifold_edges().len();
        report.inconsistent_edges_left = self.inconsistent_edges().len();
        report.volume = self.is_watertight().then(|| self.volume());
    }
}

fn check_from_zero(parameter: &'static str, value: f64) -> Result<(), Refusal> {
    match value >= 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(Refusal::OutOfRange { parameter, value, range: "at least 0" }),
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use trigon_math::Vec3;
    use trigon_mesh::{Mesh, primitives};

    use super::*;
    use crate::tests::meshes;

    /// Closed meshes whose faces are planar.
    fn bodies() -> impl Strategy<Value = Mesh> {
        prop_oneof![
            Just(primitives::cube(2.0)),
            Just(primitives::icosphere(1.0, 1)),
            Just(primitives::dodecahedron(1.0)),
            Just(primitives::cylinder(1.0, 2.0, 7)),
            Just(primitives::torus(2.0, 0.5, 8, 6)),
        ]
    }

    /// Breaks a face in one of several ways.
    fn broken(mesh: &mut EditMesh, face: FaceId, kind: u8) {
        let vertices: Vec<VertexId> = mesh.face_vertices(face).collect();
        match kind {
            0 => mesh.delete_faces(&[face]).map(drop).expect("it exists"),
            1 => mesh.flip_faces(&[face]).expect("it exists"),
            // Refused where nothing is joined to it any more.
            2 => drop(mesh.split_off(&[face])),
            3 => drop(mesh.add_face(&vertices).expect("a second one")),
            _ => {
                let loose = mesh.add_vertex(Vec3::splat(9.0)).expect("room");
                mesh.add_edge(vertices[0], loose).expect("two vertices");
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(48))]

        /// Breaks that leave enough to know the body by are mended, and it has its volume again.
        #[test]
        fn broken_bodies_are_closed_again(
            body in bodies(),
            breaks in prop::collection::vec((any::<prop::sample::Index>(), 0u8..5), 0..6),
        ) {
            let (mut mesh, _) = EditMesh::from_mesh(&body);
            let expected = mesh.volume();
            let faces: Vec<FaceId> = mesh.faces().collect();
            let mut deleted: Vec<FaceId> = Vec::new();
            for (index, kind) in breaks {
                let face = *index.get(&faces);
                // Holes beside each other are one, which is not planar.
                let beside = |other: &FaceId| {
                    let own: Vec<EdgeId> = mesh.face_edges(face).collect();
                    mesh.has_face(*other) && mesh.face_edges(*other).any(|edge| own.contains(&edge))
                };
                if !mesh.has_face(face) || (kind == 0 && !deleted.is_empty()) || deleted.iter().any(beside) {
                    continue;
                }
                if kind == 0 {
                    deleted.push(face);
                }
                broken(&mut mesh, face, kind);
            }
            let report = mesh.make_solid(&SolidSettings::default()).expect("room");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            let left = [report.open_edges_left, report.non_manifold_edges_left, report.inconsistent_edges_left];
            prop_assert_eq!(left, [0; 3], "{:?}", report);
            let volume = report.volume.expect("closed");
            prop_assert!((volume - expected).abs() < 1e-6 * expected, "{volume} instead of {expected}");
            let again = mesh.make_solid(&SolidSettings::default()).expect("room");
            prop_assert_eq!(again.mended(), 0, "{:?}", again);
        }

        /// Whatever is mended, the structure is whole, what the report says is left is left, and it can be undone.
        #[test]
        fn making_solid_can_be_undone(start in meshes(), within in 0.0f64..0.3) {
            let (mut mesh, _) = EditMesh::from_mesh(&start);
            let before = mesh.clone();
            let settings = SolidSettings { within, ..SolidSettings::default() };
            let (report, mut difference) = mesh.transaction(|mesh| mesh.make_solid(&settings)).expect("room");
            prop_assert_eq!(mesh.check_structure(), Ok(()));
            prop_assert_eq!(report.volume.is_some(), mesh.is_watertight());
            prop_assert!(mesh.loose_edges().is_empty() && mesh.loose_vertices().is_empty());
            difference.apply(&mut mesh);
            prop_assert!(mesh == before);
        }
    }

    #[test]
    fn each_fault_is_counted_and_a_sheet_stays_open() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
        let faces: Vec<FaceId> = cube.faces().collect();
        cube.delete_faces(&faces[..1]).expect("it exists");
        cube.flip_faces(&faces[5..]).expect("it exists");
        let vertices: Vec<VertexId> = cube.face_vertices(faces[4]).collect();
        cube.add_face(&vertices).expect("a second one");
        let ends = [5.0, 6.0].map(|x| cube.add_vertex(Vec3::X * x).expect("room"));
        cube.add_edge(ends[0], ends[1]).expect("two vertices");
        let report = cube.make_solid(&SolidSettings::default()).expect("room");
        let expected = SolidReport {
            doubled_faces: 1,
            loose_edges: 1,
            loose_vertices: 2,
            filled_holes: 1,
            turned_faces: 1,
            volume: Some(cube.volume()),
            ..SolidReport::default()
        };
        assert_eq!((report.mended(), report), (6, expected));
        assert!((cube.volume() - 8.0).abs() < 1e-12, "{}", cube.volume());
        let (mut sheet, _) = EditMesh::from_mesh(&primitives::grid(1.0, 1.0, 2, 2));
        let report = sheet.make_solid(&SolidSettings::default()).expect("room");
        assert_eq!((report.filled_holes, report.open_edges_left), (0, 8), "it has no inside");
        assert!(
            sheet.make_solid(&SolidSettings { within: -1.0, ..SolidSettings::default() }).is_err(),
            "negative"
        );
    }
}
