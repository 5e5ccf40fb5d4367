//! Modifiers as data: operations on a whole mesh that stay alive, with all their parameters. A mesh has a stack of them, and
//! what is shown and exported is the mesh after all that are on, in their order.
//!
//! Here are the parameters and their ranges alone. `stack` applies them.

mod boolean;
mod copies;
mod surfaces;
mod walls;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::refusal::Refusal;
pub use boolean::{BooleanModifier, BooleanOperation};
pub use copies::{ArrayModifier, MirrorModifier, WeldModifier};
pub use surfaces::{
    BevelModifier, BeveledEdges, DecimateGoal, DecimateSettings, SubdivisionModifier, TriangulateModifier,
};
pub use walls::{ScrewModifier, SolidifySettings};

/// An operation on a whole mesh that stays alive. In JSON an object whose `kind` is the name in lower case with underscores,
/// as `{ "kind": "mirror" }`; missing parameters have their defaults, unknown ones are errors.
///
/// A modifier changes everything that the mesh has, also what is hidden. Where there is nothing for it to do, the mesh stays
/// as it is.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "kind", rename_all = "snake_case")]
pub enum Modifier {
    /// The Catmull-Clark surface.
    Subdivision(SubdivisionModifier),
    /// A mirrored copy beside the mesh.
    Mirror(MirrorModifier),
    /// Copies in a row.
    Array(ArrayModifier),
    /// Faces get a second layer at a distance.
    Solidify(SolidifySettings),
    /// Edges become faces.
    Bevel(BevelModifier),
    /// Vertices that are close to one another become one.
    Weld(WeldModifier),
    /// Faces become triangles.
    Triangulate(TriangulateModifier),
    /// Fewer triangles.
    Decimate(DecimateSettings),
    /// Edges are swept around an axis.
    Screw(ScrewModifier),
    /// The volume is combined with that of another object.
    Boolean(BooleanModifier),
}

/// A modifier in the stack of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct StackedModifier {
    /// The modifier.
    pub modifier: Modifier,
    /// Whether it is evaluated.
    pub is_on: bool,
}

impl StackedModifier {
    /// One that is on.
    #[must_use]
    pub fn new(modifier: impl Into<Modifier>) -> Self {
        Self { modifier: modifier.into(), is_on: true }
    }
}

/// Lists all kinds: variant, parameters, name.
macro_rules! kinds {
    ($($variant:ident($settings:ident) $name:literal),* $(,)?) => {
        impl Modifier {
            /// The name in panels and messages.
            #[must_use]
            pub fn name(&self) -> &'static str {
                match self {
                    $(Self::$variant(_) => $name),*
                }
            }

            /// Refuses parameters out of their range.
            ///
            /// # Errors
            /// The first such parameter.
            pub fn check(&self) -> Result<(), Refusal> {
                match self {
                    $(Self::$variant(settings) => settings.check()),*
                }
            }

            /// One of each kind with the default parameters, in the order of menus.
            #[must_use]
            pub fn of_each_kind() -> Vec<Self> {
                vec![$(Self::$variant($settings::default())),*]
            }
        }

        $(impl From<$settings> for Modifier {
            fn from(settings: $settings) -> Self {
                Self::$variant(settings)
            }
        })*
    };
}

kinds! {
    Subdivision(SubdivisionModifier) "Subdivision Surface",
    Mirror(MirrorModifier) "Mirror",
    Array(ArrayModifier) "Array",
    Solidify(SolidifySettings) "Solidify",
    Bevel(BevelModifier) "Bevel",
    Weld(WeldModifier) "Weld",
    Triangulate(TriangulateModifier) "Triangulate",
    Decimate(DecimateSettings) "Decimate",
    Screw(ScrewModifier) "Screw",
    Boolean(BooleanModifier) "Boolean",
}

impl Modifier {
    /// The name of the other object that it uses.
    #[must_use]
    pub fn object(&self) -> Option<&str> {
        match self {
            Self::Boolean(BooleanModifier { object, .. }) | Self::Array(ArrayModifier { object, .. }) => {
                Some(object.as_str()).filter(|name| !name.is_empty())
            }
            _ => None,
        }
    }

    /// Uses the other object by another name.
    pub fn set_object(&mut self, name: &str) {
        if let Self::Boolean(BooleanModifier { object, .. }) | Self::Array(ArrayModifier { object, .. }) =
            self
        {
            name.clone_into(object);
        }
    }
}

impl Modifier {
    /// Its limit to a vertex group, if it can have one.
    fn group_limit(&mut self) -> Option<&mut String> {
        match self {
            Self::Solidify(SolidifySettings { group, .. })
            | Self::Bevel(BevelModifier { group, .. })
            | Self::Decimate(DecimateSettings { group, .. }) => Some(group),
            _ => None,
        }
    }

    /// Uses a vertex group by its new name.
    pub(crate) fn rename_group(&mut self, before: &str, name: &str) {
        if let Some(group) = self.group_limit().filter(|group| *group == before) {
            name.clone_into(group);
        }
    }
}

/// Refuses a number out of its range, or not finite.
fn check_range(
    parameter: &'static str,
    value: f64,
    range: std::ops::RangeInclusive<f64>,
    words: &'static str,
) -> Result<(), Refusal> {
    if value.is_finite() && range.contains(&value) {
        return Ok(());
    }
    Err(Refusal::OutOfRange { parameter, value, range: words })
}

/// Refuses a distance that is negative or not finite.
fn check_distance(parameter: &'static str, value: f64) -> Result<(), Refusal> {
    check_range(parameter, value, 0.0..=f64::MAX, "at least 0")
}

/// Refuses a vector with a number that is not finite.
fn check_finite(parameter: &'static str, vector: [f64; 3]) -> Result<(), Refusal> {
    vector.iter().try_for_each(|&value| check_range(parameter, value, f64::MIN..=f64::MAX, "finite"))
}
