//! The kinds of elements that clicks and regions select: one, or several at once.

use super::ElementKind;

/// A set of kinds of elements, never empty.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ElementKinds {
    /// Whether vertices, edges and faces are in it.
    contains: [bool; 3],
}

const ALL: [ElementKind; 3] = [ElementKind::Vertex, ElementKind::Edge, ElementKind::Face];

impl ElementKinds {
    /// One kind alone.
    #[must_use]
    pub fn one(kind: ElementKind) -> Self {
        Self { contains: ALL.map(|other| other == kind) }
    }

    /// With a kind added, or removed if it is one of several.
    #[must_use]
    pub fn toggled(self, kind: ElementKind) -> Self {
        let mut contains = self.contains;
        contains[kind as usize] ^= true;
        if contains == [false; 3] { self } else { Self { contains } }
    }

    /// Whether elements of a kind are selected.
    #[must_use]
    pub fn contains(self, kind: ElementKind) -> bool {
        self.contains[kind as usize]
    }

    /// The first kind, in the order vertices, edges, faces: the others consist of elements of it.
    #[must_use]
    pub fn first(self) -> ElementKind {
        self.iter().next().expect("the set is never empty")
    }

    /// The kinds in the order vertices, edges, faces.
    pub fn iter(self) -> impl Iterator<Item = ElementKind> {
        ALL.into_iter().filter(move |&kind| self.contains(kind))
    }
}

impl Default for ElementKinds {
    fn default() -> Self {
        Self::one(ElementKind::default())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn kinds_are_added_and_removed_but_never_the_last() {
        let edges = ElementKinds::one(ElementKind::Edge);
        assert_eq!(edges.toggled(ElementKind::Edge), edges, "it is the only one");
        let both = edges.toggled(ElementKind::Vertex);
        assert_eq!((both.first(), both.iter().count()), (ElementKind::Vertex, 2), "vertices come first");
        assert!(both.contains(ElementKind::Edge) && !both.contains(ElementKind::Face), "two of three");
        assert_eq!(both.toggled(ElementKind::Vertex), edges, "as before");
        assert_eq!(ElementKinds::default().first(), ElementKind::Vertex, "in the beginning");
    }
}
