//! What is in the way of printing a mesh, all together.

use super::{BoundaryLoop, FaceThickness, InspectionSettings, OverhangSettings, TouchingFaces};
use crate::edit_mesh::EditMesh;
use crate::ids::{EdgeId, FaceId};

/// What a printer can do.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PrintSettings {
    /// From when on a face has no area, and how many touching faces are looked for.
    pub inspection: InspectionSettings,
    /// Walls thinner than this are too thin, in metres.
    pub least_thickness: f64,
    /// Which faces overhang.
    pub overhang: OverhangSettings,
}

impl Default for PrintSettings {
    /// Walls of 0.8 mm: two lines of a nozzle of 0.4 mm.
    fn default() -> Self {
        Self {
            inspection: InspectionSettings::default(),
            least_thickness: 0.0008,
            overhang: OverhangSettings::default(),
        }
    }
}

/// What may fail to print. Lists are in ascending order of ids.
#[derive(Debug, Clone, PartialEq, Default)]
#[non_exhaustive]
pub struct PrintReport {
    /// The rims of holes.
    pub open_edges: Vec<BoundaryLoop>,
    /// Edges with three or more sides of faces.
    pub non_manifold_edges: Vec<EdgeId>,
    /// Edges one of whose faces shows its inside.
    pub inconsistent_edges: Vec<EdgeId>,
    /// Faces without area.
    pub zero_area_faces: Vec<FaceId>,
    /// Faces that touch or cross others.
    pub touching_faces: TouchingFaces,
    /// Faces behind which the body is too thin.
    pub thin_faces: Vec<FaceThickness>,
    /// Faces with nothing below them.
    pub overhanging_faces: Vec<FaceId>,
    /// The volume in cubic metres if the mesh is watertight; negative if it looks inwards.
    pub volume: Option<f64>,
}

impl PrintReport {
    /// Whether the mesh bounds a body: closed, not inside out, and without faces that cross. Thin walls and overhangs do
    /// not count: they depend on the printer.
    #[must_use]
    pub fn is_body(&self) -> bool {
        self.volume.is_some_and(|volume| volume > 0.0)
            && self.zero_area_faces.is_empty()
            && self.touching_faces.pairs.is_empty()
    }
}

impl EditMesh {
    /// Looks for everything that is in the way of printing.
    #[must_use]
    pub fn print_report(&self, settings: &PrintSettings) -> PrintReport {
        PrintReport {
            open_edges: self.boundary_loops(),
            non_manifold_edges: self.non_manifold_edges(),
            inconsistent_edges: self.inconsistent_edges(),
            zero_area_faces: self.zero_area_faces(settings.inspection.zero_area),
            touching_faces: self.touching_faces(settings.inspection.most_touches),
            thin_faces: self.thin_faces(settings.least_thickness),
            overhanging_faces: self.overhanging_faces(&settings.overhang),
            volume: self.is_watertight().then(|| self.volume()),
        }
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_cube_is_a_body_and_an_open_one_is_none() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(0.02));
        let report = cube.print_report(&PrintSettings::default());
        let touching_faces = TouchingFaces { pairs: vec![], is_complete: true };
        let volume = Some(cube.volume());
        assert_eq!(report, PrintReport { touching_faces, volume, ..PrintReport::default() }, "nothing");
        assert!(report.is_body(), "closed");
        cube.delete_faces(&[FaceId(0)]).expect("it exists");
        let report = cube.print_report(&PrintSettings::default());
        assert_eq!((report.open_edges.len(), report.is_body()), (1, false), "a hole");
        let (thin, _) = EditMesh::from_mesh(&primitives::cube(0.0007));
        assert_eq!(thin.print_report(&PrintSettings::default()).thin_faces.len(), 6, "less than 0.8 mm");
    }
}
