//! What is wrong with a scene: why it would be black, inside out, invisible or tiny.
//!
//! Nothing is drawn for it. Each finding says what was found, where, and what to do about it;
//! a scene that is as it should be has none.

mod look;
mod space;
mod surface;

use std::fmt;

use crate::scene::Scene;

/// How bad a finding is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// It may be meant so.
    Warning,
    /// The picture is wrong, here or in other programs.
    Error,
}

/// Something that is wrong with a scene. Its `Display` is one line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Finding {
    /// How bad it is.
    pub severity: Severity,
    /// A short name of the fault for programs, such as `inside-out`.
    pub fault: &'static str,
    /// The mesh, the material or the node, by its kind and name.
    pub place: String,
    /// What was found.
    pub what: String,
    /// What a person can do about it.
    pub remedy: &'static str,
}

impl fmt::Display for Finding {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let severity = match self.severity {
            Severity::Warning => "warning",
            Severity::Error => "error",
        };
        write!(f, "{severity}: {}: {} ({}); {}", self.place, self.what, self.fault, self.remedy)
    }
}

/// At most this many findings of one fault are listed.
const MOST_OF_A_KIND: usize = 5;

impl Scene {
    /// What is wrong with the scene as it stands, errors first; of each fault at most five.
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
        let mut findings = Vec::new();
        space::check(self, &mut findings);
        surface::check(self, &mut findings);
        look::check(self, &mut findings);
        let mut counts: Vec<(&str, usize)> = Vec::new();
        findings.retain(|finding| {
            let index = counts.iter().position(|(fault, _)| *fault == finding.fault).unwrap_or_else(|| {
                counts.push((finding.fault, 0));
                counts.len() - 1
            });
            counts[index].1 += 1;
            counts[index].1 <= MOST_OF_A_KIND
        });
        // Stable: within a severity in the order in which they were found.
        findings.sort_by_key(|finding| std::cmp::Reverse(finding.severity));
        findings
    }
}

/// `mesh "wheel"`, or by its number where it has no name.
fn place(kind: &str, name: &str, index: usize) -> String {
    if name.is_empty() { format!("{kind} {index}") } else { format!("{kind} {name:?}") }
}

/// `1 face`, `2 faces`.
fn counted(count: usize, what: &str) -> String {
    let plural = if what == "vertex" { "vertices".to_owned() } else { format!("{what}s") };
    format!("{count} {}", if count == 1 { what } else { &plural })
}

#[cfg(test)]
mod tests;
