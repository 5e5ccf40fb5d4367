//! The model shown at one time: a scene from one file, from several, or the built-in one, with the
//! flags' changes applied.

use std::path::PathBuf;

use trigon_math::{Bounds3, DVec3};
use trigon_mesh::Mesh;
use trigon_scene::{NodeId, Scene};

use crate::args::{PlacedNode, Request};
use crate::failure::Failure;
use crate::framing::{Eye, Framing, Shot};
use crate::report::Reporter;
use crate::source::Source;
use crate::stdout::{report_failure, write_failure};

impl Source {
    /// What the command line names, in the order in which it is shown.
    pub(crate) fn all(request: &Request) -> Vec<Self> {
        match Self::group(&request.files, &request.grouping) {
            sources if sources.is_empty() => vec![Self::BuiltIn],
            sources => sources,
        }
    }

    /// Visits everything that is named, with what is asked for it; one that fails is
    /// reported and does not keep the others from being visited. The worst exit code is
    /// returned.
    pub(crate) fn visit_all(
        request: &Request,
        reporter: Reporter,
        mut visit: impl FnMut(&Self, &Request) -> Result<(), Failure>,
    ) -> u8 {
        let mut worst = 0;
        for source in Self::all(request) {
            match request.for_source(&source).and_then(|request| visit(&source, &request)) {
                Ok(()) => {}
                Err(empty @ Failure::Empty(_)) if request.skip_empty => {
                    reporter.info(format_args!("{empty}; skipped"));
                    if request.json {
                        worst = worst.max(write_failure(source.first_file(), &empty, reporter));
                    }
                }
                Err(failure) => {
                    worst = worst.max(report_failure(&source, &failure, request.json, reporter));
                }
            }
        }
        worst
    }
}

/// A scene that has something to draw.
pub(crate) struct Model {
    pub(crate) scene: Scene,
    pub(crate) source: Source,
    /// Of all scenes of its files, also of those that are not shown.
    pub(crate) scene_names: Vec<String>,
    /// Of all variants of its files' materials.
    pub(crate) variant_names: Vec<String>,
    /// All that were read for it: what to watch for changes.
    pub(crate) files: Vec<PathBuf>,
    /// What is odd about how its files stand together, about the time at which it is shown, and about its light.
    pub(crate) odd: Vec<String>,
    bounds: Bounds3,
}

impl Model {
    /// The model, or an error when nothing in it can be drawn.
    pub(crate) fn new(mut scene: Scene, source: Source, request: &Request) -> Result<Self, Failure> {
        request.look.apply(&mut scene)?;
        let bounds = scene.tight_bounds();
        if bounds.is_empty() {
            return Err(Failure::Empty(format!(
                "{}: nothing to draw: there is no face, line or point in it; check that the right file was exported, with its meshes",
                source.title()
            )));
        }
        request.scenery.replace(&mut scene)?;
        Ok(Self::within(bounds, scene, source))
    }

    /// The model of a scene that is shown already.
    #[cfg(feature = "window")]
    pub(crate) fn shown(scene: Scene, source: Source) -> Self {
        let bounds = scene.tight_bounds();
        Self::within(bounds, scene, source)
    }

    fn within(bounds: Bounds3, scene: Scene, source: Source) -> Self {
        Self {
            scene,
            source,
            scene_names: Vec::new(),
            variant_names: Vec::new(),
            files: Vec::new(),
            odd: Vec::new(),
            bounds,
        }
    }

    /// The camera that the flags ask for. The built-in scene is composed for
    /// its own camera.
    pub(crate) fn shot(&self, framing: &Framing, aspect: f64) -> Result<Shot, Failure> {
        self.composed(framing).shot(&self.scene, aspect)
    }

    /// The same camera for this model and another one beside it: both are in view.
    pub(crate) fn shot_with(&self, other: &Scene, framing: &Framing, aspect: f64) -> Result<Shot, Failure> {
        let mut both = self.scene.clone();
        both.append(other);
        self.composed(framing).shot(&both, aspect)
    }

    /// The same with what is shown beside the model added to it, and room for that in front of the camera.
    pub(crate) fn shot_with_scenery(&mut self, request: &Request) -> Result<Shot, Failure> {
        let shot = self.shot(&request.framing, request.settings.aspect())?;
        if request.scenery.add_to(&mut self.scene).is_empty() {
            return Ok(shot);
        }
        Ok(Shot { camera: request.framing.with_wider_clip_planes(&shot.camera, &self.scene), ..shot })
    }

    /// Views once around it.
    pub(crate) fn turntable(&self, framing: &Framing, aspect: f64, views: u32) -> Result<Vec<Shot>, Failure> {
        self.composed(framing).turntable(&self.scene, aspect, views)
    }

    fn composed(&self, framing: &Framing) -> Framing {
        let own = self.source == Source::BuiltIn && framing.eye == Eye::Default;
        if own { Framing { eye: Eye::SceneCamera(0), ..framing.clone() } } else { framing.clone() }
    }

    /// The mesh of each visible node.
    fn visible_meshes(&self) -> impl Iterator<Item = &Mesh> {
        let visible = self.scene.visible_transforms();
        let drawn = self.scene.nodes().iter().filter(move |(id, _)| visible[id.index()].is_some());
        drawn.filter_map(|(_, node)| self.scene.meshes().get(node.mesh?)).map(|asset| asset.mesh())
    }

    /// How many faces are visible.
    pub(crate) fn face_count(&self) -> usize {
        self.visible_meshes().map(Mesh::face_count).sum()
    }

    /// One line for each scene, variant and animation, with what names it.
    pub(crate) fn choices(&self) -> Vec<String> {
        let scenes = self.scene_names.iter().enumerate();
        let scenes = scenes.map(|(index, name)| format!("scene {index}   {name:?}"));
        let animations = self.scene.animations.iter().enumerate().map(|(index, animation)| {
            format!("animation {index} {:?}, {} s", animation.name, short(animation.duration()))
        });
        let variants = self.variant_names.iter().map(|name| format!("variant   {name:?}"));
        scenes.chain(variants).chain(animations).collect()
    }

    /// Hides nodes by their numbers in the tree, or by their names.
    pub(crate) fn hide(&mut self, nodes: &[String]) -> Result<(), Failure> {
        let tree: Vec<NodeId> = self.scene.tree().into_iter().map(|(id, _)| id).collect();
        for wanted in nodes {
            let is_named = |id: &NodeId| self.scene.node(*id).is_some_and(|node| node.name == *wanted);
            let numbered = wanted.parse().ok().and_then(|number: usize| tree.get(number).copied());
            let named = tree.iter().copied().filter(is_named);
            let found: Vec<NodeId> = numbered.into_iter().chain(named).collect();
            if found.is_empty() {
                return Err(Failure::work(format!(
                    "--hide-nodes={wanted}: there is no such node; --scene-hierarchy shows the {} that there are, numbered from 0",
                    tree.len()
                )));
            }
            for id in found {
                if let Some(node) = self.scene.node_mut(id) {
                    node.visible = false;
                }
            }
        }
        Ok(())
    }

    /// Puts nodes where somebody has moved them.
    pub(crate) fn place_nodes(&mut self, placed: &[PlacedNode]) -> Result<(), Failure> {
        let tree = self.scene.tree();
        for placed in placed {
            let id = tree.get(placed.number).map(|(id, _)| *id);
            let Some(node) = id.and_then(|id| self.scene.node_mut(id)) else {
                return Err(Failure::work(format!(
                    "--place-node={placed}: there is no node {}; --scene-hierarchy shows the {} that there are, numbered from 0",
                    placed.number,
                    tree.len()
                )));
            };
            node.transform = placed.transform;
        }
        Ok(())
    }

    /// The names of its nodes, children moved to the right; the first ones if there are many.
    pub(crate) fn tree(&self) -> Vec<String> {
        /// As many as most images have room for.
        const MOST: usize = 40;
        let nodes = self.scene.tree();
        let line = |&(id, depth): &(NodeId, usize)| {
            let name = self.scene.node(id).map_or("", |node| node.name.as_str());
            format!("{:1$}{2}", "", 2 * depth, if name.is_empty() { "(no name)" } else { name })
        };
        let mut lines: Vec<String> = nodes.iter().take(MOST).map(line).collect();
        if nodes.len() > MOST {
            lines.push(format!("and {} more", nodes.len() - MOST));
        }
        lines
    }

    /// The middle of the box around what is visible.
    pub(crate) fn center(&self) -> Option<DVec3> {
        self.bounds.center()
    }

    /// Counts and sizes of what is visible.
    pub(crate) fn summary(&self) -> Summary {
        let mut summary = Summary {
            vertices: 0,
            edges: 0,
            faces: 0,
            nodes: self.scene.nodes().len(),
            materials: self.scene.materials.len(),
            textures: self.scene.textures.len(),
            size: self.bounds.max - self.bounds.min,
        };
        for mesh in self.visible_meshes() {
            summary.vertices += mesh.vertex_count();
            summary.edges += mesh.edge_count();
            summary.faces += mesh.face_count();
        }
        summary
    }
}

/// Counts and sizes of a model; what several nodes share is counted for each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Summary {
    pub(crate) vertices: usize,
    pub(crate) edges: usize,
    pub(crate) faces: usize,
    pub(crate) nodes: usize,
    pub(crate) materials: usize,
    pub(crate) textures: usize,
    /// Along X, Y and Z.
    pub(crate) size: DVec3,
}

impl Summary {
    /// One line per fact.
    pub(crate) fn lines(&self) -> Vec<String> {
        let DVec3 { x, y, z } = self.size;
        let facts = [
            ("vertices", self.vertices.to_string()),
            ("edges", self.edges.to_string()),
            ("faces", self.faces.to_string()),
            ("nodes", self.nodes.to_string()),
            ("materials", self.materials.to_string()),
            ("textures", self.textures.to_string()),
            ("size", format!("{} x {} x {}", short(x), short(y), short(z))),
        ];
        facts.map(|(name, value)| format!("{name:9} {value}")).to_vec()
    }
}

/// A length or another amount to a ten-thousandth of itself, without needless zeros.
pub(crate) fn short(length: f64) -> String {
    if length != 0.0 && !(1e-3..1e7).contains(&length) {
        return format!("{length:.3e}");
    }
    let decimals = [1000.0, 100.0, 10.0, 1.0, 0.1, 0.01].iter().take_while(|&&bound| length < bound).count();
    let text = format!("{length:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_are_short_and_true() {
        let cases = [
            (0.0, "0"),
            (1.0, "1"),
            (0.1 + 0.2, "0.3"),
            (12.3456, "12.35"),
            (123_456.7, "123457"),
            (0.001234, "0.001234"),
            (1e-9, "1.000e-9"),
        ];
        for (length, expected) in cases {
            assert_eq!(short(length), expected, "{length}");
        }
    }
}
