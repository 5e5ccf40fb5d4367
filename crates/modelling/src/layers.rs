//! The values of vertices and corners besides positions: texture coordinates and their pins, colours, normals,
//! skin weights, weights in groups, morph targets.

use trigon_math::{DVec2, DVec3, DVec4, Vec2, Vec3, Vec4};

use super::column::{Column, ColumnDifference};
use super::group_weight::GroupWeight;
use super::skin::Influences;

/// What the values of a layer are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum LayerKind {
    /// Texture coordinates; sets count in the order of their layers. On corners.
    Uv,
    /// In which sets texture coordinates are pinned. On corners; there is no such layer before the first pin.
    Pins,
    /// Linear light, straight alpha. On corners, which faces show, and on vertices, which loose edges and
    /// points show.
    Color,
    /// Normals that were given. On corners.
    Normal,
    /// Tangents that were given. On corners.
    Tangent,
    /// What a morph target adds to positions. On vertices, numbered.
    MorphPosition(u16),
    /// What a morph target adds to normals. On corners, numbered.
    MorphNormal(u16),
    /// What a morph target adds to tangents. On corners, numbered.
    MorphTangent(u16),
    /// Joints and their weights. On vertices.
    Skin,
    /// Weights in a vertex group. On vertices, numbered; of a number without a name in the mesh there are none.
    Group(u16),
}

/// One value for each vertex or each corner.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Layer {
    pub(super) kind: LayerKind,
    pub(super) values: LayerValues,
}

#[derive(Debug, Clone, PartialEq)]
pub(super) enum LayerValues {
    Vec2(Column<Vec2>),
    Vec3(Column<Vec3>),
    Vec4(Column<Vec4>),
    Influences(Column<Influences>),
    Pins(Column<Pins>),
    Weights(Column<GroupWeight>),
}

/// The sets of texture coordinates in which a corner is pinned: one bit for each, from the lowest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(super) struct Pins(pub(super) u32);

#[derive(Debug, Clone, PartialEq)]
pub(super) enum LayerDifference {
    Unchanged,
    Vec2(ColumnDifference<Vec2>),
    Vec3(ColumnDifference<Vec3>),
    Vec4(ColumnDifference<Vec4>),
    Influences(ColumnDifference<Influences>),
    Pins(ColumnDifference<Pins>),
    Weights(ColumnDifference<GroupWeight>),
}

/// Runs the same expression for the column of any type.
macro_rules! for_column {
    ($values:expr, $column:ident => $body:expr) => {
        match $values {
            LayerValues::Vec2($column) => $body,
            LayerValues::Vec3($column) => $body,
            LayerValues::Vec4($column) => $body,
            LayerValues::Influences($column) => $body,
            LayerValues::Pins($column) => $body,
            LayerValues::Weights($column) => $body,
        }
    };
}

/// A weighted sum of values: weights add up to one.
pub(super) trait Blend: Copy + Default {
    fn blend(parts: &[(Self, f64)]) -> Self;
}

impl Blend for Vec2 {
    fn blend(parts: &[(Self, f64)]) -> Self {
        parts.iter().fold(DVec2::ZERO, |sum, (value, weight)| sum + value.as_dvec2() * *weight).as_vec2()
    }
}

impl Blend for Vec3 {
    fn blend(parts: &[(Self, f64)]) -> Self {
        parts.iter().fold(DVec3::ZERO, |sum, (value, weight)| sum + value.as_dvec3() * *weight).as_vec3()
    }
}

impl Blend for Vec4 {
    fn blend(parts: &[(Self, f64)]) -> Self {
        parts.iter().fold(DVec4::ZERO, |sum, (value, weight)| sum + value.as_dvec4() * *weight).as_vec4()
    }
}

impl Blend for Influences {
    fn blend(parts: &[(Self, f64)]) -> Self {
        Self::blended(parts)
    }
}

impl Blend for GroupWeight {
    fn blend(parts: &[(Self, f64)]) -> Self {
        Self::blended(parts)
    }
}

impl Blend for Pins {
    /// Between corners of which one is free, a corner is free.
    fn blend(parts: &[(Self, f64)]) -> Self {
        let counted = parts.iter().filter(|(_, weight)| *weight != 0.0).map(|(pins, _)| pins.0);
        Self(counted.reduce(|all, pins| all & pins).unwrap_or(0))
    }
}

impl LayerKind {
    /// Whether values are directions on the surface, which say nothing about a face that stands
    /// upright on it.
    pub(super) fn is_direction(self) -> bool {
        matches!(self, Self::Normal | Self::Tangent | Self::MorphNormal(_) | Self::MorphTangent(_))
    }
}

/// Weighted sums for many elements, all taken before any is written.
#[derive(Debug, Default)]
pub(super) struct Blends {
    /// The parts of all, one after the other: elements and their weights.
    parts: Vec<(u32, f64)>,
    /// For each element that gets a sum, the end of its parts.
    targets: Vec<(u32, usize)>,
}

impl Blends {
    /// Adds one: weights sum to 1.
    pub(super) fn push(&mut self, parts: impl IntoIterator<Item = (u32, f64)>, to: u32) {
        self.parts.extend(parts);
        self.targets.push((to, self.parts.len()));
    }

    fn each(&self) -> impl Iterator<Item = (&[(u32, f64)], u32)> {
        let mut start = 0;
        self.targets.iter().map(move |&(to, end)| {
            let parts = &self.parts[start..end];
            start = end;
            (parts, to)
        })
    }
}

impl Layer {
    /// Adds a slot with the value zero.
    pub(super) fn push_default(&mut self) {
        for_column!(&mut self.values, column => column.push(Default::default()));
    }

    pub(super) fn copy(&mut self, from: u32, to: u32) {
        for_column!(&mut self.values, column => {
            let value = column[from];
            *column.write(to) = value;
        });
    }

    pub(super) fn clear(&mut self, to: u32) {
        for_column!(&mut self.values, column => *column.write(to) = Default::default());
    }

    /// Gives an element the value of one that was given none: white for colours, otherwise zero.
    pub(super) fn set_usual(&mut self, to: u32) {
        self.clear(to);
        if let (LayerKind::Color, LayerValues::Vec4(column)) = (self.kind, &mut self.values) {
            *column.write(to) = Vec4::ONE;
        }
    }

    /// Gives an element the weighted sum of the values of others. A direction keeps unit length, as
    /// far as it has any.
    pub(super) fn blend(&mut self, parts: &[(u32, f64)], to: u32) {
        let kind = self.kind;
        match &mut self.values {
            LayerValues::Vec2(column) => blend_column(column, parts, to),
            LayerValues::Vec3(column) => {
                blend_column(column, parts, to);
                if kind == LayerKind::Normal {
                    let normal = column.write(to);
                    *normal = unit_or_zero(*normal);
                }
            }
            LayerValues::Vec4(column) if kind == LayerKind::Tangent => {
                let handedness = column[heaviest(parts)].w;
                blend_column(column, parts, to);
                let tangent = column.write(to);
                *tangent = unit_or_zero(tangent.truncate()).extend(handedness);
            }
            LayerValues::Vec4(column) => blend_column(column, parts, to),
            LayerValues::Influences(column) => blend_column(column, parts, to),
            LayerValues::Pins(column) => blend_column(column, parts, to),
            LayerValues::Weights(column) => blend_column(column, parts, to),
        }
    }

    /// The same for many elements, which may be parts of each other.
    pub(super) fn blend_all(&mut self, blends: &Blends) {
        // The sums are kept in elements past the end, of which the layer then has none again.
        let own = self.len();
        for (parts, _) in blends.each() {
            self.push_default();
            let last = self.len() - 1;
            self.blend(parts, last);
        }
        for (sum, (_, to)) in (own..).zip(blends.each()) {
            self.copy(sum, to);
        }
        for_column!(&mut self.values, column => column.truncate(own));
    }

    pub(super) fn begin(&mut self) {
        for_column!(&mut self.values, column => column.begin());
    }

    pub(super) fn finish(&mut self) -> LayerDifference {
        match &mut self.values {
            LayerValues::Vec2(column) => column.finish().map(LayerDifference::Vec2),
            LayerValues::Vec3(column) => column.finish().map(LayerDifference::Vec3),
            LayerValues::Vec4(column) => column.finish().map(LayerDifference::Vec4),
            LayerValues::Influences(column) => column.finish().map(LayerDifference::Influences),
            LayerValues::Pins(column) => column.finish().map(LayerDifference::Pins),
            LayerValues::Weights(column) => column.finish().map(LayerDifference::Weights),
        }
        .unwrap_or(LayerDifference::Unchanged)
    }

    pub(super) fn swap(&mut self, difference: &mut LayerDifference) {
        match (&mut self.values, difference) {
            (_, LayerDifference::Unchanged) => {}
            (LayerValues::Vec2(column), LayerDifference::Vec2(difference)) => column.swap(difference),
            (LayerValues::Vec3(column), LayerDifference::Vec3(difference)) => column.swap(difference),
            (LayerValues::Vec4(column), LayerDifference::Vec4(difference)) => column.swap(difference),
            (LayerValues::Influences(column), LayerDifference::Influences(difference)) => {
                column.swap(difference);
            }
            (LayerValues::Pins(column), LayerDifference::Pins(difference)) => column.swap(difference),
            (LayerValues::Weights(column), LayerDifference::Weights(difference)) => column.swap(difference),
            _ => unreachable!("a difference is applied to the layer that it came from"),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        for_column!(&self.values, column => column.bytes())
    }

    /// The memory of one value, in bytes.
    pub(super) fn bytes_of_one(&self) -> u64 {
        for_column!(&self.values, column => column.bytes_of_one())
    }

    /// How many slots it has.
    pub(super) fn len(&self) -> u32 {
        for_column!(&self.values, column => column.len())
    }

    /// Of an element that is seen in a mirror with this unit normal: directions and what morph
    /// targets add are mirrored, and bitangents turn to the other side.
    pub(super) fn reflect(&mut self, index: u32, normal: DVec3) {
        let reflected = |vector: Vec3| {
            let vector = vector.as_dvec3();
            (vector - normal * (2.0 * normal.dot(vector))).as_vec3()
        };
        match (&mut self.values, self.kind) {
            (LayerValues::Vec3(column), _) => {
                let vector = column.write(index);
                *vector = reflected(*vector);
            }
            (LayerValues::Vec4(column), LayerKind::Tangent) => {
                let tangent = column.write(index);
                *tangent = reflected(tangent.truncate()).extend(-tangent.w);
            }
            _ => {}
        }
    }

    /// [`Self::turn_over`] for many corners.
    pub(super) fn turn_over_all(&mut self, corners: &[u32]) {
        use LayerKind::{MorphNormal, Normal, Tangent};
        if matches!(self.kind, Normal | MorphNormal(_) | Tangent) {
            for_column!(&mut self.values, column => drop(column.write_all()));
            corners.iter().for_each(|&corner| self.turn_over(corner));
        }
    }

    /// Of a corner whose face turns over: normals point the other way, so bitangents would, too.
    pub(super) fn turn_over(&mut self, index: u32) {
        match (&mut self.values, self.kind) {
            (LayerValues::Vec3(column), LayerKind::Normal | LayerKind::MorphNormal(_)) => {
                let normal = column.write(index);
                *normal = -*normal;
            }
            (LayerValues::Vec4(column), LayerKind::Tangent) => {
                let tangent = column.write(index);
                tangent.w = -tangent.w;
            }
            _ => {}
        }
    }
}

impl LayerDifference {
    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Unchanged => 0,
            Self::Vec2(difference) => difference.bytes(),
            Self::Vec3(difference) => difference.bytes(),
            Self::Vec4(difference) => difference.bytes(),
            Self::Influences(difference) => difference.bytes(),
            Self::Pins(difference) => difference.bytes(),
            Self::Weights(difference) => difference.bytes(),
        }
    }
}

/// A direction with length 1, computed in f64; zero where it has none.
pub(super) fn unit_or_zero(direction: Vec3) -> Vec3 {
    direction.as_dvec3().normalize_or_zero().as_vec3()
}

/// The element with the largest weight, the first of several.
pub(super) fn heaviest(parts: &[(u32, f64)]) -> u32 {
    let mut best = parts[0];
    for &part in parts {
        if part.1 > best.1 {
            best = part;
        }
    }
    best.0
}

fn blend_column<T: Blend>(column: &mut Column<T>, parts: &[(u32, f64)], to: u32) {
    *column.write(to) = blended(column, parts);
}

/// The weighted sum of some elements' values.
pub(super) fn blended<T: Blend>(column: &Column<T>, parts: &[(u32, f64)]) -> T {
    /// Most sums have few parts: these need no memory of their own.
    const FEW: usize = 8;
    let value = |&(index, weight): &(u32, f64)| (column[index], weight);
    if parts.len() <= FEW {
        let mut values = [(T::default(), 0.0); FEW];
        for (to, from) in values.iter_mut().zip(parts) {
            *to = value(from);
        }
        T::blend(&values[..parts.len()])
    } else {
        T::blend(&parts.iter().map(value).collect::<Vec<_>>())
    }
}
