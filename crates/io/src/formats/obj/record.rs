//! What the pieces of an OBJ add up to: its vertices and elements as long lists, and the object, material and
//! smoothing group of each element.

use std::collections::BTreeMap;

use trigon_math::{DVec3, Vec2, Vec3};

use super::index::Counts;
use super::lines::{Lines, decode_name, split_keyword, words};
use super::oddities::{Oddities, Oddity};
use super::section::Statement;

/// A run of consecutive elements (faces, edges, points) with the same state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Run {
    /// The ordinal of its first element.
    pub(crate) first: usize,
    /// Which part, an index of [`Record::parts`].
    pub(crate) part: u32,
    /// Which material, an index of [`Record::materials`]; `None` before the
    /// first `usemtl`.
    pub(crate) material: Option<u32>,
    /// The smoothing group; 0 is flat.
    pub(crate) smoothing: u32,
}

/// A list of names without repetition, in the order of their first use.
#[derive(Debug, Default)]
pub(crate) struct NameList {
    list: Vec<String>,
    known: BTreeMap<String, u32>,
}

impl NameList {
    fn index(&mut self, name: String) -> u32 {
        if let Some(&index) = self.known.get(&name) {
            return index;
        }
        let index = u32::try_from(self.list.len()).expect("a name takes a line, and a file has fewer lines");
        self.list.push(name.clone());
        self.known.insert(name, index);
        index
    }

    pub(crate) fn list(&self) -> &[String] {
        &self.list
    }
}

/// Real files name a few libraries; a hostile one could name millions, each a
/// search through the folder.
const MOST_LIBRARIES: usize = 256;

/// Follows the state of an OBJ through its lines.
#[derive(Debug, Default)]
pub(crate) struct Record {
    /// Objects and groups, each named as a node will be.
    pub(crate) parts: NameList,
    /// Names of materials, as `usemtl` wrote them.
    pub(crate) materials: NameList,
    /// The first line that asked for each material.
    pub(crate) material_lines: Vec<u64>,
    /// The arguments of `mtllib` with their lines.
    pub(crate) libraries: Vec<(u64, String)>,
    pub(crate) runs: Vec<Run>,
    /// How many elements there are.
    pub(crate) elements: usize,
    /// Of the statements that are followed here.
    pub(crate) oddities: Oddities,
    object: String,
    group: String,
    part: Option<u32>,
    material: Option<u32>,
    smoothing: u32,
}

impl Record {
    /// Follows the statements of the next piece, which has so many elements.
    pub(crate) fn follow(&mut self, piece: &[u8], statements: &[Statement], elements: usize) {
        let mut done = 0;
        for statement in statements {
            let before = statement.elements_before as usize;
            self.add_elements(before - done);
            done = before;
            let mut lines = Lines::new(&piece[statement.at as usize..]);
            let (_, text) = lines.next().expect("a statement was found there");
            let (keyword, rest) = split_keyword(&text).expect("it was read before");
            self.statement(statement.line, keyword, rest);
        }
        self.add_elements(elements - done);
    }

    fn statement(&mut self, line: u64, keyword: &[u8], rest: &[u8]) {
        match keyword {
            b"o" => self.set_object(rest),
            b"g" => self.set_group(rest),
            b"s" => self.set_smoothing(line, rest),
            b"usemtl" => self.set_material(line, rest),
            _ => self.add_library(line, rest),
        }
    }

    fn set_object(&mut self, rest: &[u8]) {
        self.object = decode_name(rest);
        // A group ends with its object.
        self.group.clear();
        self.part = None;
    }

    fn set_group(&mut self, rest: &[u8]) {
        self.group = decode_name(rest);
        self.part = None;
    }

    fn set_material(&mut self, line: u64, rest: &[u8]) {
        let name = decode_name(rest);
        if name.is_empty() {
            self.material = None;
            return;
        }
        let index = self.materials.index(name);
        if index as usize == self.material_lines.len() {
            self.material_lines.push(line);
        }
        self.material = Some(index);
    }

    fn set_smoothing(&mut self, line: u64, rest: &[u8]) {
        let word = words(rest).next().map(decode_name).unwrap_or_default();
        self.smoothing = match word.as_str() {
            "on" => 1,
            "off" => 0,
            number => number.parse().unwrap_or_else(|_| {
                self.oddities.note(Oddity::Smoothing, line);
                0
            }),
        };
    }

    fn add_library(&mut self, line: u64, rest: &[u8]) {
        let name = decode_name(rest);
        if self.libraries.iter().any(|(_, known)| *known == name) {
            return;
        }
        if self.libraries.len() == MOST_LIBRARIES {
            return self.oddities.note(Oddity::Libraries, line);
        }
        self.libraries.push((line, name));
    }

    /// Notes that so many elements follow, in the state as it is now.
    fn add_elements(&mut self, count: usize) {
        if count == 0 {
            return;
        }
        let part = match self.part {
            Some(part) => part,
            None => {
                let part = self.parts.index(self.part_name());
                *self.part.insert(part)
            }
        };
        let run = Run { first: self.elements, part, material: self.material, smoothing: self.smoothing };
        let same = |last: &Run| Run { first: run.first, ..*last } == run;
        if !self.runs.last().is_some_and(same) {
            self.runs.push(run);
        }
        self.elements += count;
    }

    /// An object with groups has a node for each group, called `object/group`.
    fn part_name(&self) -> String {
        match (self.object.is_empty(), self.group.is_empty()) {
            (_, true) => self.object.clone(),
            (true, false) => self.group.clone(),
            (false, false) => format!("{}/{}", self.object, self.group),
        }
    }
}

/// What a file holds, or a piece of it.
#[derive(Debug, Default)]
pub(crate) struct Content {
    pub(crate) positions: Vec<DVec3>,
    /// sRGB from 0 to 1, NaN where the file has no finite number; empty while no
    /// vertex has a colour.
    pub(crate) colors: Vec<Vec3>,
    /// v counted downwards, as everywhere in trigon.
    pub(crate) coordinates: Vec<Vec2>,
    pub(crate) normals: Vec<Vec3>,
    /// How many corners each element has: 1 for points, 2 for edges.
    pub(crate) arities: Vec<u32>,
    /// The position of each corner.
    pub(crate) position_indices: Vec<u32>,
    /// [`NONE`](super::index::NONE) where a corner has none; empty when the file has none.
    pub(crate) coordinate_indices: Vec<u32>,
    /// Likewise.
    pub(crate) normal_indices: Vec<u32>,
}

impl Content {
    /// Makes room for the vertices of a file.
    pub(crate) fn reserve(&mut self, total: Counts) {
        self.positions.reserve_exact(total.positions);
        self.coordinates.reserve_exact(total.coordinates);
        self.normals.reserve_exact(total.normals);
    }

    /// Moves what a later piece holds to the end.
    pub(crate) fn append(&mut self, mut later: Self) {
        if !later.colors.is_empty() || !self.colors.is_empty() {
            self.colors.resize(self.positions.len(), WHITE);
            later.colors.resize(later.positions.len(), WHITE);
            self.colors.append(&mut later.colors);
        }
        self.positions.append(&mut later.positions);
        self.coordinates.append(&mut later.coordinates);
        self.normals.append(&mut later.normals);
        self.arities.append(&mut later.arities);
        self.position_indices.append(&mut later.position_indices);
        self.coordinate_indices.append(&mut later.coordinate_indices);
        self.normal_indices.append(&mut later.normal_indices);
    }
}

/// Of vertices without a colour, where others have one.
pub(super) const WHITE: Vec3 = Vec3::ONE;
