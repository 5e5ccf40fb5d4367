//! Parameters of commands that follow the axes in which a document is shown.

use serde_json::Value;
use trigon_document::Rotation;
use trigon_document::mesh::math::{DQuat, DVec3};

use crate::up::Up;

/// What numbers mean in space.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Spatial {
    /// Nothing, such as those of a colour.
    None,
    /// A position or a direction.
    Vector,
    /// Factors along the three axes.
    Factors,
    /// Angles about the three axes, one after another, in degrees.
    Angles,
    /// A rotation: the imaginary part and the real one.
    Quaternion,
}

impl Spatial {
    /// What a parameter is, by its name and the other parameters of its group.
    pub(super) fn of(name: &str, count: usize, group: &Value) -> Self {
        match (name, count) {
            ("xyzw", 4) => Self::Quaternion,
            ("angles", 3) => Self::Angles,
            ("scale", 3) => Self::Factors,
            // Otherwise they are factors along axes of their own.
            ("factors", 3) if group["orientation"].is_null() => Self::Factors,
            ("color" | "emissive" | "specular" | "factors", _) => Self::None,
            (_, 3) => Self::Vector,
            _ => Self::None,
        }
    }

    /// Numbers of the document as they are shown.
    pub(super) fn shown(self, up: Up, numbers: &mut [f64]) {
        self.change(numbers, |vector| up.shown(vector), |rotation| up.shown_rotation(rotation), up);
    }

    /// Shown numbers as the document has them.
    pub(super) fn stored(self, up: Up, numbers: &mut [f64]) {
        self.change(numbers, |vector| up.stored(vector), |rotation| up.stored_rotation(rotation), up);
    }

    fn change(
        self,
        numbers: &mut [f64],
        vector: impl Fn(DVec3) -> DVec3,
        rotation: impl Fn(DQuat) -> DQuat,
        up: Up,
    ) {
        if up == Up::Y {
            return;
        }
        match (self, &mut *numbers) {
            (Self::Vector, [x, y, z]) => [*x, *y, *z] = vector(DVec3::new(*x, *y, *z)).to_array(),
            (Self::Factors, [x, y, z]) => [*x, *y, *z] = up.exchanged(DVec3::new(*x, *y, *z)).to_array(),
            (Self::Angles, [x, y, z]) => {
                let turned = rotation(Rotation::Euler { angles: [*x, *y, *z] }.to_quaternion());
                if let Rotation::Euler { angles } = Rotation::euler(turned) {
                    [*x, *y, *z] = angles;
                }
            }
            (Self::Quaternion, [x, y, z, w]) => {
                [*x, *y, *z, *w] = rotation(DQuat::from_xyzw(*x, *y, *z, *w)).to_array();
            }
            _ => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use super::*;

    #[test]
    fn every_vector_of_a_command_is_shown_in_the_axes_on_the_screen_and_colours_are_not() {
        let as_shown = |name: &str, group: Value| {
            let list: Vec<f64> = serde_json::from_value(group[name].clone()).expect("numbers");
            let spatial = Spatial::of(name, list.len(), &group);
            let mut numbers = list.clone();
            spatial.shown(Up::Z, &mut numbers);
            let shown = numbers.clone();
            spatial.stored(Up::Z, &mut numbers);
            for (back, number) in numbers.iter().zip(&list) {
                // Rounding of angles.
                assert!((back - number).abs() < 1e-9, "{name} comes back");
            }
            shown
        };
        assert_eq!(as_shown("offset", json!({ "offset": [1.0, 2.0, 3.0] })), [1.0, -3.0, 2.0]);
        assert_eq!(as_shown("scale", json!({ "scale": [1.0, 2.0, 3.0] })), [1.0, 3.0, 2.0]);
        let factors = json!({ "factors": [1.0, 2.0, 3.0], "orientation": null });
        assert_eq!(as_shown("factors", factors), [1.0, 3.0, 2.0], "along the axes of the space");
        let axes = [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]];
        let factors = json!({ "factors": [1.0, 2.0, 3.0], "orientation": axes });
        assert_eq!(as_shown("factors", factors), [1.0, 2.0, 3.0], "along axes that are given");
        assert_eq!(as_shown("color", json!({ "color": [0.1, 0.2, 0.3] })), [0.1, 0.2, 0.3]);
        assert_eq!(
            as_shown("base_color", json!({ "base_color": [0.1, 0.2, 0.3, 1.0] })),
            [0.1, 0.2, 0.3, 1.0]
        );
        let upright = as_shown("angles", json!({ "angles": [0.0, 90.0, 0.0] }));
        assert!((upright[2] - 90.0).abs() < 1e-9 && upright[0].abs() < 1e-9, "about what is up: {upright:?}");
        let turned = as_shown("xyzw", json!({ "xyzw": [0.0, 0.6, 0.0, 0.8] }));
        assert_eq!(turned, [0.0, 0.0, 0.6, 0.8], "about what is up");
    }
}
