//! Names that no other object has: `Cube`, `Cube.001`, `Cube.002`.

use std::collections::{BTreeMap, BTreeSet};

use trigon_scene::{NodeId, Scene};

/// The names in use. A name that is given out is in use from then on.
pub(crate) struct Names {
    used: BTreeSet<String>,
    /// For each name without its number, the smallest number that may be free.
    free: BTreeMap<String, u32>,
}

impl Names {
    /// The names of all objects of a scene.
    pub(crate) fn of(scene: &Scene) -> Self {
        Self::without(scene, &BTreeSet::new())
    }

    /// The names of all objects but these.
    pub(crate) fn without(scene: &Scene, objects: &BTreeSet<NodeId>) -> Self {
        let others = scene.nodes().iter().filter(|(id, _)| !objects.contains(id));
        Self { used: others.map(|(_, node)| node.name.clone()).collect(), free: BTreeMap::new() }
    }

    /// A name if it is free, otherwise with the smallest free number behind it. An object without a name stays one.
    pub(crate) fn take(&mut self, wanted: &str) -> String {
        if wanted.is_empty() || self.used.insert(wanted.to_owned()) {
            return wanted.to_owned();
        }
        let base = without_number(wanted);
        let free = self.free.entry(base.to_owned()).or_insert(1);
        loop {
            let name = format!("{base}.{free:03}");
            *free += 1;
            if self.used.insert(name.clone()) {
                return name;
            }
        }
    }
}

/// "Cube" for "Cube.012".
fn without_number(name: &str) -> &str {
    match name.rsplit_once('.') {
        Some((base, digits))
            if !digits.is_empty()
                && digits.len() < 10
                && digits.bytes().all(|digit| digit.is_ascii_digit()) =>
        {
            base
        }
        _ => name,
    }
}

#[cfg(test)]
mod tests {
    use trigon_scene::Node;

    use super::*;

    fn names(used: &[&str]) -> Names {
        let mut scene = Scene::new();
        for &name in used {
            scene.add(Node::default().with_name(name));
        }
        Names::of(&scene)
    }

    #[test]
    fn the_lowest_free_number_is_given() {
        let mut known = names(&["Cube", "Cube.002", "a.b", "x.1", "2.5"]);
        for (wanted, expected) in [
            ("Sphere", "Sphere"),
            ("Cube", "Cube.001"),
            ("Cube", "Cube.003"),
            ("Cube.002", "Cube.004"),
            ("Cube.900", "Cube.900"),
            ("a.b", "a.b.001"),
            ("x.1", "x.001"),
            ("2.5", "2.001"),
            ("", ""),
            ("", ""),
        ] {
            assert_eq!(known.take(wanted), expected, "{wanted}");
        }
        let mut many = names(&["Cube"]);
        let last = (0..1000).map(|_| many.take("Cube")).last();
        assert_eq!(last.as_deref(), Some("Cube.1000"), "three digits are the fewest");
    }

    #[test]
    fn an_objects_own_name_is_free_for_it() {
        let mut scene = Scene::new();
        let id = scene.add(Node::default().with_name("Cube"));
        assert_eq!(Names::without(&scene, &BTreeSet::from([id])).take("Cube"), "Cube");
    }
}
