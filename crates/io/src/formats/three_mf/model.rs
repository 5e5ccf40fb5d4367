//! What a model part says, in its own units and numbers.

use std::collections::BTreeMap;

use trigon_math::{DAffine3, DVec3, Vec4};

use crate::error::Location;

/// A model part.
#[derive(Default)]
pub(super) struct Model {
    pub(super) unit: Unit,
    pub(super) objects: BTreeMap<u32, PartObject>,
    /// What properties name.
    pub(super) groups: BTreeMap<u32, PropertyGroup>,
    /// What is to be printed.
    pub(super) items: Vec<PlacedObject>,
}

/// A unit of length. Two numbers, so that a length in metres is rounded once.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Unit {
    times: f64,
    per: f64,
}

impl Default for Unit {
    fn default() -> Self {
        Self::MILLIMETER
    }
}

impl Unit {
    pub(super) const MILLIMETER: Self = Self { times: 1.0, per: 1000.0 };

    /// The unit of a name (3MF Core Specification, 3.4).
    pub(super) fn named(name: &str) -> Option<Self> {
        let (times, per) = match name {
            "micron" => (1.0, 1e6),
            "millimeter" => return Some(Self::MILLIMETER),
            "centimeter" => (1.0, 100.0),
            "inch" => (254.0, 10_000.0),
            "foot" => (3048.0, 10_000.0),
            "meter" => (1.0, 1.0),
            _ => return None,
        };
        Some(Self { times, per })
    }

    /// A length or a position in metres.
    pub(super) fn meters(self, value: DVec3) -> DVec3 {
        value * self.times / self.per
    }
}

/// An object that items and components name.
pub(super) struct PartObject {
    pub(super) name: String,
    pub(super) part_number: String,
    pub(super) shape: ObjectShape,
    /// Where it begins.
    pub(super) location: Location,
}

/// What an object is made of.
pub(super) enum ObjectShape {
    Mesh(Triangles),
    Components(Vec<PlacedObject>),
}

/// A mesh.
#[derive(Default)]
pub(super) struct Triangles {
    pub(super) vertices: Vec<DVec3>,
    /// Three different vertices each.
    pub(super) triangles: Vec<[u32; 3]>,
    /// The properties of each triangle.
    pub(super) properties: Vec<TriangleProperty>,
}

/// What the corners of a triangle show: items of a group.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct TriangleProperty {
    /// 0 where it has none: numbers of resources begin at 1.
    pub(super) group: u32,
    pub(super) items: [u32; 3],
}

/// A group of properties.
pub(super) enum PropertyGroup {
    /// Materials of the core specification.
    Bases(Vec<Base>),
    /// Linear, with alpha.
    Colors(Vec<Vec4>),
    /// One that is not drawn, such as textures.
    Other,
}

/// A base material.
pub(super) struct Base {
    pub(super) name: String,
    /// Linear, with alpha.
    pub(super) color: Vec4,
}

/// An object with its place: an item of the build, or a component of another object.
pub(super) struct PlacedObject {
    /// The part with the object, if it is another one.
    pub(super) part: Option<String>,
    pub(super) object: u32,
    pub(super) transform: DAffine3,
    /// Of an item.
    pub(super) part_number: String,
    pub(super) location: Location,
}

/// The models of a file by the names of their parts.
pub(super) struct Models {
    pub(super) root: String,
    pub(super) by_part: BTreeMap<String, Model>,
}

/// An object that an item or a component names.
#[derive(Clone, Copy)]
pub(super) struct FoundObject<'m> {
    pub(super) part: &'m str,
    pub(super) model: &'m Model,
    pub(super) number: u32,
    pub(super) object: &'m PartObject,
}
