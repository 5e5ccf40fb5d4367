//! Where the item that a path names is defined.

use crate::module::{Crate, Names};
use std::collections::BTreeSet;

/// What a name stands for.
#[derive(Clone, Copy)]
enum Entity {
    Module(usize),
    /// An item of that module.
    Item(usize),
}

impl Crate {
    /// The module that defines the item which a path in `module` names; none for a path that leads out of the
    /// crate or to a module itself.
    pub(crate) fn definition(&self, module: usize, path: &Names) -> Option<usize> {
        match self.entity(module, path, &mut BTreeSet::new())? {
            Entity::Module(_) => None,
            Entity::Item(module) => Some(module),
        }
    }

    /// `visited` holds the names that are being looked up, as imports may lead back to themselves.
    fn entity(
        &self,
        module: usize,
        path: &[String],
        visited: &mut BTreeSet<(usize, String)>,
    ) -> Option<Entity> {
        let (first, mut rest) = path.split_first()?;
        let mut entity = match first.as_str() {
            "crate" => Entity::Module(0),
            "self" => Entity::Module(module),
            "super" => Entity::Module(self.modules[module].parent?),
            name => self.lookup(module, name, visited)?,
        };
        while let (Entity::Module(inside), Some((name, after))) = (entity, rest.split_first()) {
            entity = match name.as_str() {
                "super" => Entity::Module(self.modules[inside].parent?),
                _ => self.lookup(inside, name, visited)?,
            };
            rest = after;
        }
        Some(entity)
    }

    /// What a name means in a module.
    fn lookup(&self, module: usize, name: &str, visited: &mut BTreeSet<(usize, String)>) -> Option<Entity> {
        if !visited.insert((module, name.to_owned())) {
            return None;
        }
        let inside = &self.modules[module];
        let found = if inside.items.contains(name) {
            Some(Entity::Item(module))
        } else if let Some(&child) = inside.children.get(name) {
            Some(Entity::Module(child))
        } else if let Some(path) = inside.imports.get(name) {
            self.entity(module, path, visited)
        } else {
            self.globbed(module, name, visited)
        };
        visited.remove(&(module, name.to_owned()));
        found
    }

    fn globbed(&self, module: usize, name: &str, visited: &mut BTreeSet<(usize, String)>) -> Option<Entity> {
        self.modules[module].globs.iter().find_map(|path| match self.entity(module, path, visited)? {
            Entity::Module(source) => self.lookup(source, name, visited),
            Entity::Item(_) => None,
        })
    }
}
