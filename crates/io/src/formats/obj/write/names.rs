//! Names of objects, materials and images.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::MaterialId;

use crate::export::{Gathered, plain_name};

/// Names that are each used once: readers unite what has the same.
#[derive(Default)]
pub(super) struct Names {
    known: BTreeSet<String>,
}

impl Names {
    pub(super) fn unique(&mut self, name: &str, otherwise: &str) -> String {
        let plain = plain_name(name, otherwise);
        let mut unique = plain.clone();
        let mut number = 1;
        while !self.known.insert(unique.clone()) {
            number += 1;
            unique = format!("{plain}_{number}");
        }
        unique
    }
}

/// The names of the materials that faces have: of the default one if others have one of their own.
pub(super) type MaterialNames = BTreeMap<Option<MaterialId>, String>;

pub(super) fn name_materials(gathered: &Gathered<'_>) -> MaterialNames {
    let (mut names, mut materials) = (Names::default(), BTreeMap::new());
    for object in &gathered.objects {
        for &face in &object.sources {
            let id = object.material(face);
            let name =
                id.and_then(|id| gathered.scene.materials.get(id)).map_or("default", |found| &found.name);
            materials.entry(id).or_insert_with(|| names.unique(name, "material"));
        }
    }
    if materials.keys().all(Option::is_none) { MaterialNames::new() } else { materials }
}
