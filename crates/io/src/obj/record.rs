//! What the feed keeps of an OBJ beside what tobj reads: which faces belong
//! together, in which material, and how smooth.

use std::collections::HashMap;

use super::lines::decode_name;

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
pub(crate) struct Names {
    list: Vec<String>,
    known: HashMap<String, u32>,
}

impl Names {
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
    pub(crate) parts: Names,
    /// Names of materials, as `usemtl` wrote them.
    pub(crate) materials: Names,
    /// The first line that asked for each material.
    pub(crate) material_lines: Vec<u64>,
    /// The arguments of `mtllib` with their lines.
    pub(crate) libraries: Vec<(u64, String)>,
    pub(crate) runs: Vec<Run>,
    /// How many elements there are.
    pub(crate) elements: usize,
    /// How many of them are faces.
    pub(crate) faces: usize,
    object: String,
    group: String,
    part: Option<u32>,
    material: Option<u32>,
    smoothing: u32,
}

impl Record {
    pub(crate) fn set_object(&mut self, rest: &[u8]) {
        self.object = decode_name(rest);
        // A group ends with its object.
        self.group.clear();
        self.part = None;
    }

    pub(crate) fn set_group(&mut self, rest: &[u8]) {
        self.group = decode_name(rest);
        self.part = None;
    }

    pub(crate) fn set_material(&mut self, line: u64, rest: &[u8]) {
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

    pub(crate) fn set_smoothing(&mut self, rest: &[u8]) {
        let word = decode_name(rest);
        // "off" and anything that is no number is flat; "on" is group 1.
        self.smoothing = if word == "on" { 1 } else { word.parse().unwrap_or(0) };
    }

    pub(crate) fn add_library(&mut self, line: u64, rest: &[u8]) {
        let name = decode_name(rest);
        if self.libraries.len() < MOST_LIBRARIES && !self.libraries.iter().any(|(_, known)| *known == name) {
            self.libraries.push((line, name));
        }
    }

    /// Notes that an element follows, in the state as it is now.
    pub(crate) fn add_element(&mut self) {
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
        self.elements += 1;
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
