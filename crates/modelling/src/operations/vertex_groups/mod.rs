//! Vertex groups: adding and removing them, and which vertices are in them.

#[cfg(test)]
mod tests;

use super::delete::require;
use super::transform::{Falloff, Weighted, sorted};
use crate::edit_mesh::EditMesh;
use crate::group_weight::{GroupName, GroupWeight};
use crate::ids::VertexId;
use crate::refusal::Refusal;

const OPERATION: &str = "assigning vertices to a group";

/// How vertices get weights.
#[derive(Debug, Clone, PartialEq)]
pub struct GroupAssignment {
    /// The weight of the given vertices, 0 to 1.
    pub weight: f64,
    /// How vertices near them follow: with the weight times what the falloff leaves of it. Default: none.
    pub falloff: Option<Falloff>,
    /// Whether those near them get lower weights than they have. The given ones always do.
    pub replace: bool,
}

impl Default for GroupAssignment {
    fn default() -> Self {
        Self { weight: 1.0, falloff: None, replace: false }
    }
}

impl EditMesh {
    /// Adds an empty vertex group after the others.
    ///
    /// # Errors
    /// The name is empty, or another group has it; there are [`Self::MOST_VERTEX_GROUPS`]; the weights would take more
    /// memory than is allowed.
    pub fn add_vertex_group(&mut self, name: &str) -> Result<(), Refusal> {
        self.check_new_group(name)?;
        Self::check_group_count(self.groups.len() + 1)?;
        let needed = (self.bytes() + self.vertex_capacity() * size_of::<GroupWeight>()) as u64;
        if needed > self.memory {
            return Err(Refusal::Memory { needed, allowed: self.memory });
        }
        self.push_group(name);
        Ok(())
    }

    /// Removes a vertex group; its vertices stay. Modifiers that it limits are left out until they have another.
    ///
    /// # Errors
    /// There is no such group.
    pub fn remove_vertex_group(&mut self, name: &str) -> Result<(), Refusal> {
        self.group_weights_mut(name)?.write_all().fill(GroupWeight::default());
        self.groups.retain(|group| group.name != name);
        Ok(())
    }

    /// Gives a vertex group another name, also in the modifiers that it limits.
    ///
    /// # Errors
    /// There is no such group; the new name is empty, or another group has it.
    pub fn rename_vertex_group(&mut self, name: &str, to: &str) -> Result<(), Refusal> {
        if self.group_named(name).is_none() {
            return Err(Refusal::NoSuchGroup(name.to_owned()));
        }
        if name == to {
            return Ok(());
        }
        self.check_new_group(to)?;
        let renamed = self.groups.iter_mut().filter(|group| group.name == name);
        renamed.for_each(|group: &mut GroupName| to.clone_into(&mut group.name));
        for stacked in &mut self.modifiers {
            stacked.modifier.rename_group(name, to);
        }
        Ok(())
    }

    /// Gives vertices a weight in a group, and with a falloff others near them a part of it: hidden ones never. Returns how
    /// many vertices have another weight than before.
    ///
    /// ```
    /// use trigon_mesh::primitives;
    /// use trigon_modelling::{EditMesh, GroupAssignment, Refusal, VertexId};
    ///
    /// let (mut cube, _) = EditMesh::from_mesh(&primitives::cube(2.0));
    /// cube.add_vertex_group("top")?;
    /// let half = GroupAssignment { weight: 0.5, ..GroupAssignment::default() };
    /// cube.assign_to_vertex_group("top", &[VertexId::new(3)], &half)?;
    /// let top = cube.vertex_group("top").expect("it was added");
    /// assert_eq!(top.weight(VertexId::new(3)), Some(0.5));
    /// assert_eq!(top.weight(VertexId::new(0)), None);
    /// # Ok::<(), Refusal>(())
    /// ```
    ///
    /// # Errors
    /// There is no such group; no vertex is given, or one does not exist; the weight is not from 0 to 1, or the radius of
    /// the falloff not above 0 and finite.
    pub fn assign_to_vertex_group(
        &mut self,
        name: &str,
        vertices: &[VertexId],
        assignment: &GroupAssignment,
    ) -> Result<usize, Refusal> {
        let &GroupAssignment { weight, falloff, replace } = assignment;
        if !(0.0..=1.0).contains(&weight) {
            return Err(Refusal::OutOfRange { parameter: "a weight", value: weight, range: "0 to 1" });
        }
        require(vertices, OPERATION, "at least one vertex")?;
        let given = sorted(self, vertices)?;
        let weighted = match &falloff {
            Some(falloff) => falloff.weigh(self, &given)?,
            None => Weighted { weights: vec![1.0; given.len()], vertices: given.clone() },
        };
        let column = self.group_weights_mut(name)?;
        let mut changed = 0;
        for (vertex, part) in weighted.vertices.iter().zip(&weighted.weights) {
            let new = (weight * part) as f32;
            let is_larger = || column[vertex.0].get().is_some_and(|old| old > new);
            let is_held = !replace && is_larger() && given.binary_search(vertex).is_err();
            let new = GroupWeight::new(Some(new));
            if !is_held && column[vertex.0] != new {
                *column.write(vertex.0) = new;
                changed += 1;
            }
        }
        Ok(changed)
    }

    /// Takes vertices out of a group. Returns how many were in it.
    ///
    /// # Errors
    /// There is no such group; no vertex is given, or one does not exist.
    pub fn remove_from_vertex_group(&mut self, name: &str, vertices: &[VertexId]) -> Result<usize, Refusal> {
        require(vertices, "removing vertices from a group", "at least one vertex")?;
        let given = sorted(self, vertices)?;
        let column = self.group_weights_mut(name)?;
        let mut removed = 0;
        for vertex in given {
            if column[vertex.0].get().is_some() {
                *column.write(vertex.0) = GroupWeight::default();
                removed += 1;
            }
        }
        Ok(removed)
    }

    fn check_new_group(&self, name: &str) -> Result<(), Refusal> {
        if name.is_empty() {
            let reason = "its name is empty: write one";
            return Err(Refusal::NotPossible { operation: "a vertex group", reason });
        }
        match self.group_named(name) {
            Some(_) => Err(Refusal::GroupExists(name.to_owned())),
            None => Ok(()),
        }
    }
}
