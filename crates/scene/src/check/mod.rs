//! Faults of a scene: why it would be black, inside out, invisible or tiny.
//!
//! Nothing is drawn for these checks. Each finding states what was found, where, and how to fix it;
//! a correct scene has none but notes.

mod look;
mod space;

use std::fmt;

use crate::scene::Scene;

/// The severity of a finding.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// Nothing is wrong, but people may wonder.
    Note,
    /// It may be intended.
    Warning,
    /// The image is wrong, here or in other programs.
    Error,
}

/// A fault of a scene. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// Its severity.
    pub severity: Severity,
    /// A short name of the fault for programs, such as `inside-out`.
    pub fault: &'static str,
    /// The mesh, the material or the node, by its kind and name.
    pub location: String,
    /// What was found.
    pub what: String,
    /// A remedy for people.
    pub remedy: &'static str,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{severity}: {}: {} ({}); {}", self.location, self.what, self.fault, self.remedy)
    }
}

/// The maximum number of listed findings per fault.
const MOST_OF_A_KIND: usize = 5;

impl Scene {
    /// The faults of the scene, errors first; at most five of each fault.
    ///
    /// ```
    /// use trigon_scene::{Material, Scene, Severity, mesh::primitives};
    ///
    /// let mut cube = primitives::cube(1.0);
    /// cube.flip_faces();
    /// let mut scene = Scene::new();
    /// scene.add_object("cube", cube, Material::default());
    /// let findings = scene.check();
    /// assert_eq!(findings[0].fault, "inside-out");
    /// assert_eq!(findings[0].severity, Severity::Error);
    /// ```
    #[must_use]
    pub fn check(&self) -> Vec<Finding> {
        self.check_with(|_| {})
    }

    /// As [`Scene::check`], for a model that is to be printed: whatever keeps a mesh from enclosing a volume
    /// is an error.
    #[must_use]
    pub fn check_for_printing(&self) -> Vec<Finding> {
        self.check_with(|finding| {
            if matches!(finding.fault, space::OPEN_EDGES | space::NON_MANIFOLD | space::MIXED_WINDING) {
                finding.severity = Severity::Error;
            }
        })
    }

    fn check_with(&self, judge: impl FnMut(&mut Finding)) -> Vec<Finding> {
        let mut findings = Vec::new();
        space::check(self, &mut findings);
        space::check_faces(self, &mut findings);
        look::check(self, &mut findings);
        findings.iter_mut().for_each(judge);
        let mut counts: Vec<(&str, usize)> = Vec::new();
        findings.retain(|finding| {
            let index = counts.iter().position(|(fault, _)| *fault == finding.fault).unwrap_or_else(|| {
                counts.push((finding.fault, 0));
                counts.len() - 1
            });
            counts[index].1 += 1;
            counts[index].1 <= MOST_OF_A_KIND
        });
        // Stable: within a severity in the order of discovery.
        findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        findings
    }
}

/// `mesh "wheel"`, or its number if it has no name.
fn locate(kind: &str, name: &str, index: usize) -> String {
    if name.is_empty() { format!("{kind} {index}") } else { format!("{kind} {name:?}") }
}

/// `1 face`, `2 faces`.
fn counted(count: usize, what: &str) -> String {
    let plural = if what == "vertex" { "vertices".to_owned() } else { format!("{what}s") };
    format!("{count} {}", if count == 1 { what } else { &plural })
}

#[cfg(test)]
mod tests;
