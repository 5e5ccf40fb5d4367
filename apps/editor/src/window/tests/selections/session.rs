//! What a user selects on one model, each time held against the oracle.

use std::collections::{BTreeMap, BTreeSet};

use trigon_document::PICK_RADIUS;
use trigon_document::modelling::{EditMesh, ElementMap};
use trigon_window::scene::math::DVec2;
use trigon_window::scene::mesh::Mesh;
use trigon_window::{Modifiers, PointerButton};

use super::super::sessions::User;
use super::Tally;
use super::lens::Answer;
use super::oracle::{Key, Kind, Oracle};
use super::shape::Shape;
use super::topology::Topology;

/// Somebody selects on one model.
struct Session<'u, 'w> {
    user: &'u mut User<'w>,
    oracle: Oracle,
    tally: Tally,
    kind: Kind,
    through: bool,
}

const KINDS: [(Kind, &str); 3] = [(Kind::Vertex, "1"), (Kind::Edge, "2"), (Kind::Face, "3")];

/// All selections on what the editor shows; an error says why the oracle knows nothing of it.
pub(super) fn select_everywhere(user: &mut User<'_>) -> Result<Tally, String> {
    // More of the image, and less that has to be drawn.
    user.play("keys T N Home A Tab");
    let oracle = Oracle::new(user.window.stage())?;
    let mut session = Session { user, oracle, tally: Tally::default(), kind: Kind::Vertex, through: false };
    for (kind, key) in KINDS {
        session.user.play(&format!("keys {key}"));
        session.kind = kind;
        for through in [false, true] {
            session.through = through;
            session.regions();
            session.clicks();
            session.user.play("keys Alt+Z");
        }
        session.through = false;
        session.along_edges();
        session.paths();
    }
    Ok(session.tally)
}

impl Session<'_, '_> {
    /// A place of the window in the view.
    fn in_view(&self, place: DVec2) -> DVec2 {
        place - self.user.window.stage().visible_area().origin()
    }

    /// Places spread over the middle of the view.
    fn places(&self) -> Vec<DVec2> {
        let middle = DVec2::new(320.0, 265.0);
        let offsets = [(-90.3, 12.6), (-36.0, -42.5), (6.2, 24.9), (72.7, 3.1), (36.4, -21.0)];
        offsets.into_iter().map(|(x, y)| middle + DVec2::new(x, y)).collect()
    }

    fn drag(&mut self, places: &[DVec2], held: Modifiers) {
        let window = &mut self.user.window;
        window.move_to(places[0]);
        window.hold(held);
        window.press(PointerButton::Left);
        places[1..].iter().for_each(|place| window.move_to(*place));
        window.release(PointerButton::Left);
        window.hold(Modifiers::NONE);
    }

    fn click(&mut self, place: DVec2, held: Modifiers) {
        self.drag(&[place], held);
    }

    fn nothing(&mut self) {
        self.user.play("keys Alt+A");
    }

    fn regions(&mut self) {
        let corner = |x, y| DVec2::new(x, y);
        let boxed = [corner(60.5, 110.25), corner(330.75, 270.5)];
        let circle = Shape::Circle(self.in_view(self.places()[2]), 25.0);
        let lasso =
            vec![corner(90.0, 120.0), corner(500.0, 200.5), corner(420.25, 400.0), corner(310.0, 220.0)];
        self.nothing();
        self.drag(&boxed, Modifiers::NONE);
        self.check_region("box", &Shape::Box(boxed.map(|place| self.in_view(place))));
        self.nothing();
        self.user.play("keys C");
        self.click(self.places()[2], Modifiers::NONE);
        self.user.play("keys Enter");
        self.check_region("circle", &circle);
        self.nothing();
        self.drag(&lasso, Modifiers::CTRL);
        let lasso = lasso.into_iter().map(|place| self.in_view(place)).collect();
        self.check_region("lasso", &Shape::Lasso(lasso));
    }

    fn check_region(&mut self, name: &str, shape: &Shape) {
        let selected = self.selected();
        let expected = self.oracle.region(self.kind, shape, self.through);
        let open = |key: &Key| expected.get(key) == Some(&Answer::Open);
        let sure = expected.iter().filter(|(_, answer)| **answer == Answer::Yes).map(|(key, _)| *key);
        let sure: BTreeSet<Key> = sure.collect();
        let differ: Vec<Key> =
            selected.symmetric_difference(&sure).filter(|key| !open(key)).copied().collect();
        self.tally.open += expected.values().filter(|answer| **answer == Answer::Open).count();
        self.tally.agreed += sure.len() - differ.len().min(sure.len());
        self.tell(name, differ.is_empty(), format!("{} differ: {:?}", differ.len(), differ.first()));
    }

    fn clicks(&mut self) {
        let mut expected: BTreeSet<Key> = BTreeSet::new();
        self.nothing();
        for (place, held) in
            self.places().into_iter().zip([Modifiers::NONE].into_iter().chain([Modifiers::SHIFT; 4]))
        {
            let may = self.oracle.nearest(self.kind, self.in_view(place), PICK_RADIUS, self.through);
            self.click(place, held);
            let selected = self.selected();
            let toggled: Vec<Key> = selected.symmetric_difference(&expected).copied().collect();
            let is_right = match (&toggled[..], &may[..]) {
                ([], []) => true,
                ([one], may) => may.contains(one),
                _ => false,
            };
            self.tally.open += may.len().saturating_sub(1);
            self.tally.agreed += usize::from(is_right && may.len() == 1);
            self.tell("click", is_right, format!("{toggled:?} at {place}, not one of {may:?}"));
            expected = selected;
        }
    }

    /// Loops and rings, through the edges that are nearest to some places.
    fn along_edges(&mut self) {
        for (place, held) in self
            .places()
            .into_iter()
            .flat_map(|place| [(place, Modifiers::ALT), (place, Modifiers::ALT | Modifiers::CTRL)])
        {
            let [(id, edge)] = self.oracle.nearest(Kind::Edge, self.in_view(place), PICK_RADIUS, false)[..]
            else {
                continue;
            };
            self.nothing();
            self.click(place, held);
            let selected = self.selected();
            let mesh = self.mesh(id);
            let topology = Topology::new(&mesh);
            let (ring, faces) = topology.ring(edge);
            let edges = if held == Modifiers::ALT { topology.edge_loop(edge) } else { ring };
            let vertices = edges.iter().flat_map(|edge| mesh.edges()[*edge as usize]).collect();
            let expected = match self.kind {
                Kind::Vertex => vertices,
                Kind::Edge => edges,
                Kind::Face => faces,
            };
            let expected: BTreeSet<Key> = expected.into_iter().map(|element| (id, element)).collect();
            self.tally.agreed += expected.intersection(&selected).count();
            let name = if held == Modifiers::ALT { "loop" } else { "ring" };
            self.tell(
                name,
                expected == selected,
                format!("{} of {} at {place}", selected.len(), expected.len()),
            );
        }
    }

    /// From what a click selects to what the next one with Ctrl is on.
    fn paths(&mut self) {
        let places = self.places();
        for pair in places.windows(2) {
            let ends = [pair[0], pair[1]]
                .map(|place| self.oracle.nearest(self.kind, self.in_view(place), PICK_RADIUS, false));
            let ([(id, from)], [(other, to)]) = (&ends[0][..], &ends[1][..]) else { continue };
            if id != other {
                continue;
            }
            self.nothing();
            self.click(pair[0], Modifiers::NONE);
            self.click(pair[1], Modifiers::CTRL);
            let selected: BTreeSet<u32> = self.selected().into_iter().map(|(_, element)| element).collect();
            let mesh = self.mesh(*id);
            let is_right = Topology::new(&mesh).is_shortest(self.kind, [*from, *to], &selected);
            self.tally.agreed += usize::from(is_right) * selected.len();
            self.tell("path", is_right, format!("from {from} to {to}: {selected:?}"));
        }
    }

    fn tell(&mut self, name: &str, is_right: bool, what: String) {
        self.tally.selections += 1;
        if !is_right {
            let reach = if self.through { "through" } else { "visible" };
            self.tally.wrong.push(format!("{name}, {:?}, {reach}: {what}", self.kind));
        }
    }

    fn mesh(&self, id: usize) -> Mesh {
        let meshes = self.user.window.stage().scene.meshes();
        let (_, asset) = meshes.iter().find(|(mesh, _)| mesh.index() == id).expect("it is shown");
        asset.mesh().clone()
    }

    /// What is selected, by the numbers of the meshes on the stage.
    fn selected(&self) -> BTreeSet<Key> {
        let editor = self.user.editor.borrow();
        let (document, stage) = (&editor.document, self.user.window.stage());
        let mut selected = BTreeSet::new();
        for (id, elements) in document.selection().meshes() {
            let shown = stage.scene.meshes().get(id).expect("it is shown").mesh();
            let edited = document.mesh(id).expect("it is edited");
            let numbers =
                numbers(self.kind, document.shown_elements(id).expect("it is shown"), shown, edited);
            selected.extend(elements.indices().map(|element| (id.index(), numbers[&element])));
        }
        selected
    }
}

/// From the numbers of a mesh that is edited to those of the one that is shown.
fn numbers(kind: Kind, map: &ElementMap, shown: &Mesh, edited: &EditMesh) -> BTreeMap<u32, u32> {
    match kind {
        Kind::Vertex => map.vertices.iter().map(|id| id.index()).zip(0..).collect(),
        Kind::Edge => map.edges(shown, edited).iter().map(|id| id.index()).zip(0..).collect(),
        Kind::Face => map.faces.iter().map(|id| id.index()).zip(0..).collect(),
    }
}
