//! Integers that are stored as corrections of what their neighbours let expect.
//!
//! A prediction is made of values that are already known. A transform then adds the stored
//! correction such that the result stays in its range: [`Wrap`] for numbers, [`Octahedron`] for normals.

mod normals;
mod parallelogram;

use normals::FaceNormals;
use parallelogram::Creases;

use self::normals::Octahedron;
use self::parallelogram::Turns;
use super::corners::CornerTable;
use super::order::Order;
use super::symbols::{Budget, Failure, read_symbols};
use crate::formats::gltf::stream::Broken;
use crate::formats::gltf::stream::{Stream, unzigzag};

/// What predictions may look at.
#[derive(Clone, Copy)]
pub(super) struct Neighbours<'m> {
    pub(super) table: &'m CornerTable,
    /// The order of the values.
    pub(super) order: &'m Order,
    /// The point of each corner.
    pub(super) points: &'m [u32],
    pub(super) positions: Option<&'m Positions>,
}

/// The positions of a mesh as integers.
pub(super) struct Positions {
    /// Three for each value.
    pub(super) values: Vec<i32>,
    /// The value of each point.
    pub(super) of_points: Vec<u32>,
}

impl Neighbours<'_> {
    /// The value of an attribute at a corner.
    fn value_at(&self, corner: u32) -> Option<u32> {
        self.order.values.get(self.table.vertex(corner) as usize).copied()
    }

    /// The position where a value was met first.
    fn position_of(&self, value: u32) -> Result<[i64; 3], Broken> {
        let position = || {
            let corner = *self.order.corners.get(value as usize)?;
            let positions = self.positions?;
            let position = *positions.of_points.get(*self.points.get(corner as usize)? as usize)? as usize;
            let position: [i32; 3] = *positions.values.get(3 * position..)?.first_chunk()?;
            Some(position.map(i64::from))
        };
        position().ok_or("an attribute depends on a position that is not known")
    }
}

/// How integers are stored.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Scheme {
    /// As they are.
    Plain,
    /// Corrections of the value before.
    Difference,
    /// Corrections of the fourth corner of a parallelogram.
    Parallelogram,
    /// Corrections of the mean of up to four of them, except across creases.
    Parallelograms,
    /// Corrections of the texture coordinates of a similar triangle.
    TextureCoordinates,
    /// Normals, as corrections of the value before.
    NormalDifference,
    /// Normals, as corrections of those of the triangles.
    Normals,
}

impl Scheme {
    fn read(stream: &mut Stream<'_>) -> Result<Self, Failure> {
        let method = stream.byte()?.cast_signed();
        if method == -2 {
            return Ok(Self::Plain);
        }
        match (method, stream.byte()?) {
            (0, 1) => Ok(Self::Difference),
            (1, 1) => Ok(Self::Parallelogram),
            (4, 1) => Ok(Self::Parallelograms),
            (5, 1) => Ok(Self::TextureCoordinates),
            (0, 3) => Ok(Self::NormalDifference),
            (6, 3) => Ok(Self::Normals),
            _ => Err(Failure::Foreign("a prediction of an old or unknown kind")),
        }
    }
}

/// Reads integers in groups. Without neighbours only the value before can be looked at.
pub(super) fn read_integers(
    stream: &mut Stream<'_>,
    values: usize,
    group: usize,
    neighbours: Option<Neighbours<'_>>,
    budget: &mut Budget,
) -> Result<Vec<i32>, Failure> {
    let scheme = Scheme::read(stream)?;
    let count = values.checked_mul(group).ok_or(Failure::TooLarge)?;
    let stored = read_stored(stream, count, group, budget)?;
    let is_positive = matches!(scheme, Scheme::NormalDifference | Scheme::Normals);
    let signed = |stored: u32| if is_positive { stored } else { unzigzag(stored) };
    let mut integers: Vec<i32> = stored.into_iter().map(|stored| signed(stored).cast_signed()).collect();
    if let Some((mut predictor, transform)) = scheme.open(stream, group, neighbours, budget)? {
        predictor.correct(&mut integers, group, transform)?;
    }
    Ok(integers)
}

impl Scheme {
    /// What predicts values, and how they are corrected; none if they are stored as they are.
    fn open<'m, 'b>(
        self,
        stream: &mut Stream<'b>,
        group: usize,
        neighbours: Option<Neighbours<'m>>,
        budget: &mut Budget,
    ) -> Result<Option<(Predictor<'m, 'b>, Transform)>, Failure> {
        if group != 2 && matches!(self, Self::TextureCoordinates | Self::NormalDifference | Self::Normals) {
            return Err("an attribute has the wrong number of components for its prediction".into());
        }
        let near = || neighbours.ok_or("its triangles are not known to be neighbours");
        // What a transform needs is stored last, except for normals.
        let predictor = match self {
            Self::Plain => return Ok(None),
            Self::Difference | Self::NormalDifference => Predictor::Last,
            Self::Parallelogram => Predictor::Across(near()?),
            Self::Parallelograms => Predictor::Creases(Creases::read(stream, near()?, budget)?),
            Self::TextureCoordinates => Predictor::Turns(Turns::read(stream, near()?, budget)?),
            Self::Normals => {
                let octahedron = Octahedron::read(stream)?;
                let normals = FaceNormals::read(stream, near()?, octahedron)?;
                return Ok(Some((Predictor::Normals(normals), Transform::Octahedron(octahedron))));
            }
        };
        let transform = match self {
            Self::NormalDifference => Transform::Octahedron(Octahedron::read(stream)?),
            _ => Transform::Wrap(Wrap::read(stream)?),
        };
        Ok(Some((predictor, transform)))
    }
}

/// The numbers in the stream: as symbols, or in a fixed number of bytes.
fn read_stored(
    stream: &mut Stream<'_>,
    count: usize,
    group: usize,
    budget: &mut Budget,
) -> Result<Vec<u32>, Failure> {
    if stream.byte()? > 0 {
        return read_symbols(stream, count, group, budget);
    }
    let size = usize::from(stream.byte()?);
    if size > 4 {
        return Err("its numbers have more than four bytes".into());
    }
    budget.spend(count)?;
    let bytes = stream.take(count.checked_mul(size).ok_or(Failure::TooLarge)?)?;
    let number = |index: usize| {
        let mut word = [0; 4];
        word[..size].copy_from_slice(&bytes[index * size..][..size]);
        u32::from_le_bytes(word)
    };
    Ok((0..count).map(number).collect())
}

/// What predicts values.
enum Predictor<'m, 'b> {
    /// The value before.
    Last,
    /// The parallelogram across an edge.
    Across(Neighbours<'m>),
    Creases(Creases<'m>),
    Turns(Turns<'m>),
    Normals(FaceNormals<'m, 'b>),
}

impl Predictor<'_, '_> {
    /// Turns corrections into values, in groups.
    fn correct(&mut self, integers: &mut [i32], group: usize, transform: Transform) -> Result<(), Broken> {
        let mut predicted = vec![0; group];
        for value in 0..integers.len() / group {
            let (known, rest) = integers.split_at_mut(value * group);
            self.predict(value as u32, known, &mut predicted)?;
            transform.correct(&predicted, &mut rest[..group]);
        }
        Ok(())
    }

    /// Predicts a value; all before it are known.
    fn predict(&mut self, value: u32, known: &[i32], predicted: &mut [i32]) -> Result<(), Broken> {
        match self {
            Self::Last => last(known, predicted),
            Self::Across(near) => parallelogram::predict(*near, value, known, predicted),
            Self::Creases(creases) => creases.predict(value, known, predicted)?,
            Self::Turns(turns) => turns.predict(value, known, predicted)?,
            Self::Normals(normals) => normals.predict(value, predicted)?,
        }
        Ok(())
    }
}

/// How corrections are added to predictions.
#[derive(Clone, Copy)]
enum Transform {
    Wrap(Wrap),
    Octahedron(Octahedron),
}

impl Transform {
    /// Adds predicted numbers to corrections.
    fn correct(self, predicted: &[i32], corrections: &mut [i32]) {
        match (self, predicted, &mut *corrections) {
            (Self::Octahedron(octahedron), &[s, t], [to_s, to_t]) => {
                [*to_s, *to_t] = octahedron.correct([s, t], [*to_s, *to_t]);
            }
            // Normals have two numbers.
            (Self::Octahedron(_), ..) => {}
            (Self::Wrap(wrap), ..) => wrap.correct(predicted, corrections),
        }
    }
}

/// Predicts the value before; zero for the first.
fn last(known: &[i32], predicted: &mut [i32]) {
    match known.len().checked_sub(predicted.len()) {
        Some(start) => predicted.copy_from_slice(&known[start..]),
        None => predicted.fill(0),
    }
}

/// The range of all values.
#[derive(Clone, Copy)]
struct Wrap {
    min: i32,
    max: i32,
    /// How many values are in the range.
    size: i32,
}

impl Wrap {
    fn read(stream: &mut Stream<'_>) -> Result<Self, Broken> {
        let (min, max) = (i32::from_le_bytes(stream.array()?), i32::from_le_bytes(stream.array()?));
        let size = max.checked_sub(min).filter(|&size| size >= 0).and_then(|size| size.checked_add(1));
        Ok(Self { min, max, size: size.ok_or("an attribute has an impossible range")? })
    }

    /// Adds predicted numbers to corrections.
    fn correct(self, predicted: &[i32], corrections: &mut [i32]) {
        for (&predicted, value) in predicted.iter().zip(corrections) {
            *value = self.inside(predicted.clamp(self.min, self.max).wrapping_add(*value));
        }
    }

    fn inside(self, value: i32) -> i32 {
        if value > self.max {
            value.wrapping_sub(self.size)
        } else if value < self.min {
            value.wrapping_add(self.size)
        } else {
            value
        }
    }
}
