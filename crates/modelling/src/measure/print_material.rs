//! Materials of printers with their densities, and what a mesh weighs.

use crate::edit_mesh::EditMesh;

/// A material that parts are made of.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct PrintMaterial {
    /// Its usual name.
    pub name: &'static str,
    /// In kilograms per cubic metre: a thousand times that in g/cm³.
    pub density: f64,
}

const fn material(name: &'static str, density: f64) -> PrintMaterial {
    PrintMaterial { name, density }
}

/// The usual materials, with rounded densities as makers state them. Products differ by some percent.
pub const PRINT_MATERIALS: [PrintMaterial; 12] = [
    material("PLA", 1240.0),
    material("PETG", 1270.0),
    material("ABS", 1040.0),
    material("ASA", 1070.0),
    material("TPU", 1210.0),
    material("PC", 1200.0),
    material("Nylon (PA 12)", 1010.0),
    material("Resin", 1100.0),
    material("Steel", 7850.0),
    material("Aluminium", 2700.0),
    material("Titanium", 4510.0),
    material("Copper", 8960.0),
];

impl EditMesh {
    /// What the body weighs when it is filled, in kilograms: its volume times a density in kilograms per cubic metre.
    /// `None` unless the mesh [is watertight](Self::is_watertight). Where faces look inwards the volume counts all the same.
    #[must_use]
    pub fn weight(&self, density: f64) -> Option<f64> {
        self.is_watertight().then(|| self.volume().abs() * density)
    }
}

#[cfg(test)]
mod tests {
    use trigon_mesh::primitives;

    use super::*;

    #[test]
    fn a_cube_of_two_centimetres_of_pla_weighs_ten_grams() {
        let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(0.02));
        let pla = PRINT_MATERIALS[0];
        let weight = cube.weight(pla.density).expect("it is closed");
        // 8 cm³ of 1.24 g/cm³; 0.02 is rounded to f32.
        assert!((weight - 0.00992).abs() < 1e-9, "{weight} kg of {}", pla.name);
        let faces: Vec<_> = cube.faces().collect();
        cube.flip_faces(&faces).expect("they exist");
        assert_eq!(cube.weight(pla.density), Some(weight), "inside out");
        cube.delete_faces(&faces[..1]).expect("it exists");
        assert_eq!(cube.weight(pla.density), None, "open");
    }
}
