//! Composes the draws of a frame: each gets a pipeline of the parts that its material and mesh need, and no
//! others.

use std::borrow::Cow;
use std::cell::OnceCell;
use std::ops::Range;
use std::sync::Arc;

use trigon_math::{Mat3, Vec3, Vec4};
use trigon_mesh::Mesh;
use trigon_raster::{BlendMode, Culling, EdgeFlags};

use super::looks::{LookKey, Looks, SharedLook};
use super::record::{Dots, MarkNumbers, ObjectMarks, PointList, Record, Segments, TriangleDraw, TriangleRun};
use super::wire::{ColoredLines, HiddenLine, PointColors, Wire, WireMarks, WirePaint};
use super::wire::{VertexList, VertexLists};
use crate::display::Display;
use crate::effect::Effect;
use crate::effects::{Counts, LightingEnvironment, OpennessOf, Optics};
use crate::elements;
use crate::geometry::{Geometry, Run};
use crate::material::{AlphaMode, Material, MaterialTexture, Shading};
use crate::mesh_asset::MeshAsset;
use crate::node::{Node, NodeId};
use crate::placement::{Eye, Placement, Rays};
use crate::prepare::{Backdrop, PreparedScene};
use crate::scene::Scene;
use crate::settings::{RenderSettings, ShadingModel, Style};
use crate::shapes::{Shape, Shapes};
use crate::surface::{BoundMaterial, Illumination, MaterialContext, Surface};
use crate::unseen::Canvas;

/// The fraction of their distance by which vertex points are drawn nearer, so that faces that slope
/// towards the eye around a vertex do not cut its point. Points hidden by more than that stay
/// hidden.
const VERTEX_DEPTH_BIAS: f32 = 1.0 / 256.0;

/// Everything that all draws of an image share.
pub(super) struct Composer<'s> {
    scene: &'s Scene,
    settings: &'s RenderSettings,
    shapes: &'s Shapes,
    lighting: &'s LightingEnvironment,
    eye: &'s Eye,
    backdrop: &'s Backdrop,
    rays: Rays,
    /// From camera space.
    to_world: Mat3,
    default_material: Material,
    vertex_lists: &'s VertexLists,
    looks: Looks<'s>,
    /// Of loose points, once it is asked for.
    point_size: OnceCell<f32>,
    purpose: Purpose,
}

/// The purpose of a pass.
#[derive(Clone, Copy, PartialEq)]
enum Purpose {
    /// Colours.
    Colors,
    /// Depth and ids only: nothing is shaded.
    Shapes,
    /// How open surfaces are.
    Openness(OpennessOf),
}

/// One mesh at one node.
struct DrawnObject<'s> {
    id: NodeId,
    index: u32,
    node: &'s Node,
    asset: &'s MeshAsset,
    geometry: &'s Geometry,
    /// What the geometry is made of.
    source: &'s Mesh,
    placement: Placement,
    /// For faces, and for edges on faces.
    marks: Option<Arc<MarkNumbers>>,
}

impl DrawnObject<'_> {
    /// What the look of a run depends on.
    fn key(&self, run: &Run) -> LookKey {
        LookKey::new(self.geometry, run, self.node.materials.get(run.slot as usize).copied())
    }
}

impl<'s> Composer<'s> {
    /// For a colour pass of a scene, with settings whose style may differ from the scene's.
    pub(super) fn new(
        prepared: &'s PreparedScene<'_>,
        settings: &'s RenderSettings,
        lighting: &'s LightingEnvironment,
        vertex_lists: &'s VertexLists,
    ) -> Self {
        let rays = if prepared.camera.projection.is_orthographic() { Rays::Parallel } else { Rays::Meeting };
        let default_material = Material::default();
        Self {
            scene: prepared.scene,
            settings,
            shapes: &prepared.shapes,
            lighting,
            eye: &prepared.eye,
            backdrop: &prepared.backdrop,
            rays,
            to_world: Mat3::from_quat(prepared.camera.orientation.as_quat()),
            default_material,
            vertex_lists,
            looks: Looks::default(),
            point_size: OnceCell::new(),
            purpose: Purpose::Colors,
        }
    }

    /// For a pass of which only depth and ids are kept. The lighting environment must be empty.
    pub(super) fn of_shapes(
        prepared: &'s PreparedScene<'_>,
        dark: &'s LightingEnvironment,
        vertex_lists: &'s VertexLists,
    ) -> Self {
        let colors = Self::new(prepared, prepared.settings, dark, vertex_lists);
        Self { purpose: Purpose::Shapes, ..colors }
    }

    /// For a pass over the surfaces that finds how open they are.
    pub(super) fn of_openness(
        of: OpennessOf,
        prepared: &'s PreparedScene<'_>,
        lighting: &'s LightingEnvironment,
        vertex_lists: &'s VertexLists,
    ) -> Self {
        let colors = Self::new(prepared, prepared.settings, lighting, vertex_lists);
        Self { purpose: Purpose::Openness(of), ..colors }
    }

    /// What they share.
    #[cfg(test)]
    pub(super) fn looks(&self) -> &Looks<'s> {
        &self.looks
    }

    /// All draws of the frame.
    pub(super) fn draws(&self, counts: &mut Counts) -> Vec<Box<dyn Record + '_>> {
        let mut draws: Vec<Box<dyn Record>> = Vec::new();
        for (id, node) in self.scene.nodes().iter() {
            let Some(shape) = self.shapes.get(id.index()) else { continue };
            let Some(asset) = node.mesh.and_then(|mesh| self.scene.meshes().get(mesh)) else { continue };
            if !self.may_show(asset, shape) {
                continue;
            }
            // A posed mesh is where its joints place it, however large it is at rest.
            let bounds = match shape.is_posed {
                true => shape.geometry.bounds(),
                false => shape.geometry.bounds().union(asset.bounds()),
            };
            let (index, placement) = (id.index() as u32, self.eye.placement(&shape.placement(), &bounds));
            let (geometry, source, marks) = (&shape.geometry, shape.source(asset), self.marks(id));
            let object = DrawnObject { id, index, node, asset, geometry, source, placement, marks };
            self.object(&object, &mut draws, counts);
        }
        draws
    }

    /// Objects out of view are not prepared. Lines and points extend beyond their vertices by their
    /// width, so only surfaces are culled.
    fn may_show(&self, asset: &MeshAsset, shape: &Shape) -> bool {
        let mesh = asset.mesh();
        let wires = !mesh.loose_edges().is_empty() || !mesh.loose_points().is_empty();
        wires
            || self.settings.style == Style::Wireframe
            || self.settings.vertices.is_some()
            || self.eye.may_see(&shape.geometry.bounds(), &shape.world)
    }

    fn object<'c>(
        &'c self,
        object: &DrawnObject<'s>,
        draws: &mut Vec<Box<dyn Record + 'c>>,
        counts: &mut Counts,
    ) {
        if let Purpose::Openness(of) = self.purpose {
            let runs = object.geometry.runs.iter();
            return draws.extend(runs.filter_map(|run| self.openness(object, run, of)));
        }
        match self.settings.style {
            Style::Surface | Style::SurfaceWithEdges => {
                let runs = object.geometry.runs.iter();
                draws.extend(runs.filter_map(|run| match self.purpose {
                    Purpose::Colors => Some(self.surface(object, run, counts)),
                    Purpose::Shapes | Purpose::Openness(_) => self.shape(object, run),
                }));
            }
            Style::HiddenLine => {
                draws.push(self.hidden_line(object));
                counts.of(Effect::Edges).bytes += size_of_val(self.edge_flags(object)) as u64;
            }
            Style::Wireframe => {
                let edges = &object.asset.mesh().edges()[..object.asset.mesh().face_edge_count()];
                counts.of(Effect::Edges).bytes += size_of_val(edges) as u64;
                let paint = WirePaint::of_color(self.settings.edge_color);
                draws.extend(self.segments(object, EdgeRange { first: 0, edges }, paint, None));
            }
        }
        if self.shows_edges() {
            counts.of(Effect::Edges).bytes += size_of_val(self.edge_flags(object)) as u64;
        }
        if let Some(marks) = &object.marks {
            let sides = size_of_val(self.sides(object, marks)) as u64;
            counts.of(Effect::Edges).bytes += sides + (marks.edges.len() + marks.faces.len()) as u64;
        }
        self.loose(object, draws);
        draws.extend(self.vertices(object));
    }

    /// The marks of a node's faces, and of the edges on them.
    fn marks(&self, node: NodeId) -> Option<Arc<MarkNumbers>> {
        let RenderSettings { marks, style, .. } = self.settings;
        if self.purpose != Purpose::Colors || marks.is_plain() {
            return None;
        }
        let paints_edges = matches!(style, Style::SurfaceWithEdges | Style::HiddenLine);
        let edges = if paints_edges { elements::numbers(&marks.edges, node) } else { Vec::new() };
        let faces = elements::numbers(&marks.faces, node);
        let is_marked = !edges.is_empty() || !faces.is_empty();
        is_marked.then(|| Arc::new(MarkNumbers { edges, faces }))
    }

    /// The mesh edges of triangle sides, if some of them are marked.
    fn sides(&self, object: &DrawnObject<'s>, marks: &MarkNumbers) -> &'s [[u32; 3]] {
        if marks.edges.is_empty() { &[] } else { object.geometry.side_edges(object.source) }
    }

    /// The marks of some triangles.
    fn marks_of(&self, object: &DrawnObject<'s>, triangles: &Range<usize>) -> Option<Box<ObjectMarks<'s>>> {
        let numbers = Arc::clone(object.marks.as_ref()?);
        let sides = self.sides(object, &numbers).get(triangles.clone()).unwrap_or_default();
        Some(Box::new(ObjectMarks { sides, numbers }))
    }

    /// The material of a slot; the default if there is none.
    fn material(&self, object: &DrawnObject<'s>, slot: u32) -> &Material {
        let id = object.node.materials.get(slot as usize);
        id.and_then(|&id| self.scene.materials.get(id)).unwrap_or(&self.default_material)
    }

    /// The material in which the faces of a slot are displayed, as far as its alpha can be seen.
    fn displayed(&self, object: &DrawnObject<'s>, slot: u32) -> Cow<'_, Material> {
        let material = self.material(object, slot);
        let mut material =
            self.settings.display.replaced(material).map_or(Cow::Borrowed(material), Cow::Owned);
        let alpha_mode = self.settings.visible_alpha(self.canvas(object), &material);
        if alpha_mode != material.alpha_mode {
            material.to_mut().alpha_mode = alpha_mode;
        }
        material
    }

    fn canvas(&self, object: &DrawnObject<'s>) -> Canvas<'s> {
        Canvas { scene: self.scene, columns: &object.geometry.columns }
    }

    /// How the rasterizer treats the faces of a slot, which are displayed with this alpha mode. Blended surfaces write
    /// neither depth nor ids unless the outputs ask for that, also those that are drawn as opaque ones.
    fn blend_mode(&self, object: &DrawnObject<'s>, slot: u32, displayed: AlphaMode) -> BlendMode {
        let outputs = &self.settings.outputs;
        let is_unseen = outputs.beside_color() && !outputs.of_blended;
        match displayed {
            AlphaMode::Opaque if self.settings.display == Display::Shaded && is_unseen => {
                match self.material(object, slot).alpha_mode {
                    AlphaMode::Blend => BlendMode::Overlay,
                    AlphaMode::Opaque | AlphaMode::Mask { .. } => BlendMode::Opaque,
                }
            }
            mode => blend_mode_of(mode),
        }
    }

    fn context(&self) -> MaterialContext<'s> {
        let RenderSettings { shading, reflection, display, .. } = *self.settings;
        let Self { scene, lighting, rays, to_world, .. } = *self;
        MaterialContext { scene, lighting, rays, shading, reflection, display, to_world }
    }

    /// The triangles of one slot with their material.
    fn surface<'c>(&'c self, object: &DrawnObject<'s>, run: &Run, counts: &mut Counts) -> Box<dyn Record + 'c>
    where
        's: 'c,
    {
        let key = object.key(run).at(self.node_of_glass(object, run.slot));
        let shared = self.looks.of(key, || self.shaded(object, run));
        let masked = matches!(shared.alpha_mode, AlphaMode::Mask { .. });
        shared.look.count(self.lighting, masked, counts);
        if shared.is_flat && !self.shows_edges() && !masked {
            self.placed::<true>(object, run, shared)
        } else {
            self.placed::<false>(object, run, shared)
        }
    }

    /// The node of an object whose slot is glass: a node's scale makes that thicker.
    fn node_of_glass(&self, object: &DrawnObject<'s>, slot: u32) -> Option<u32> {
        let optics = self.lighting.traced(self.material(object, slot));
        matches!(optics, Some(Optics::Glass(_))).then_some(object.index)
    }

    /// The look of the triangles of one slot.
    fn shaded(&self, object: &DrawnObject<'s>, run: &Run) -> SharedLook<'s> {
        let material = &*self.displayed(object, run.slot);
        let bent = material.normal_map.filter(|_| self.shows_normal_map(material));
        let geometry = match &bent {
            Some(map) => object.geometry.with_tangents(object.source, map.binding.uv_set),
            None => object.geometry,
        };
        let mut bound = BoundMaterial::new(material, &geometry.columns, &self.context());
        bound.place_glass(self.lighting, object.index, run.slot);
        let geometry = match bound.illumination {
            Illumination::AtVertices => geometry.with_vertex_normals(object.source),
            _ => geometry,
        };
        SharedLook::new(self.triangle_run(object, geometry, run), material, bound, &self.context())
    }

    /// Whether a normal map can be seen: tangents are made for no other.
    fn shows_normal_map(&self, material: &Material) -> bool {
        let is_lit = material.shading != Shading::Unlit && self.settings.shading == ShadingModel::Phong;
        (is_lit || self.settings.display == Display::Normal) && MaterialTexture::Normal.matters(material)
    }

    /// The same triangles without shading: positions and alpha masks. `None` if outputs see through blended
    /// surfaces.
    fn shape<'c>(&'c self, object: &DrawnObject<'s>, run: &Run) -> Option<Box<dyn Record + 'c>>
    where
        's: 'c,
    {
        let is_blended = self.material(object, run.slot).alpha_mode == AlphaMode::Blend;
        if is_blended && !self.settings.outputs.of_blended {
            return None;
        }
        let shared = self.looks.of(object.key(run), || self.bare(object, run));
        Some(match shared.alpha_mode {
            AlphaMode::Opaque => self.placed::<true>(object, run, shared),
            AlphaMode::Mask { .. } | AlphaMode::Blend => self.placed::<false>(object, run, shared),
        })
    }

    /// The look of the triangles of one slot of which only alpha is needed.
    fn bare(&self, object: &DrawnObject<'s>, run: &Run) -> SharedLook<'s> {
        let material = self.material(object, run.slot);
        let mut bare = bare(material);
        if bare.alpha_mode == AlphaMode::Blend {
            bare.alpha_mode = AlphaMode::Mask { cutoff: f32::MIN_POSITIVE };
        }
        bare.alpha_mode = self.canvas(object).visible_alpha(&bare);
        let context = MaterialContext { display: Display::Shaded, ..self.context() };
        let mut bound = BoundMaterial::new(&bare, &object.geometry.columns, &context);
        if bare.alpha_mode == AlphaMode::Opaque {
            bound.strip();
        }
        SharedLook::new(self.triangle_run(object, object.geometry, run), &bare, bound, &context)
    }

    /// The same triangles with how open they are. Those that are seen through are left out.
    fn openness<'c>(
        &'c self,
        object: &DrawnObject<'s>,
        run: &Run,
        of: OpennessOf,
    ) -> Option<Box<dyn Record + 'c>>
    where
        's: 'c,
    {
        let shared = self.looks.of(object.key(run), || self.opened(object, run, of));
        (shared.alpha_mode != AlphaMode::Blend).then(|| self.placed::<false>(object, run, shared))
    }

    fn opened(&self, object: &DrawnObject<'s>, run: &Run, of: OpennessOf) -> SharedLook<'s> {
        let context = self.context();
        let displayed = self.displayed(object, run.slot);
        let is_lit = context.reflection.of(&displayed) != Shading::Unlit;
        let mut bare = bare(&displayed);
        // What is not lit leaves no normal.
        bare.base_color *= Vec4::W;
        let columns = &object.geometry.columns;
        let mut bound = BoundMaterial::new(&bare, columns, &context);
        if bare.alpha_mode == AlphaMode::Opaque {
            bound.strip();
        }
        if is_lit {
            bound.measure_openness(columns, of);
        }
        SharedLook::new(self.triangle_run(object, object.geometry, run), &bare, bound, &context)
    }

    /// Triangles at their node.
    fn placed<'c, const FLAT: bool>(
        &'c self,
        object: &DrawnObject<'s>,
        run: &Run,
        shared: SharedLook<'s>,
    ) -> Box<dyn Record + 'c>
    where
        's: 'c,
    {
        Box::new(TriangleDraw {
            pipeline: Surface::<FLAT>::new(object.placement, shared.look),
            run: shared.run,
            marks: self.marks_of(object, &run.triangles),
            object: object.index,
            culling: if shared.double_sided { Culling::None } else { object.placement.cull_back },
            blend_mode: self.blend_mode(object, run.slot, shared.alpha_mode),
        })
    }

    /// The triangles of one slot, of a geometry of the object.
    fn triangle_run(&self, object: &DrawnObject<'s>, geometry: &'s Geometry, run: &Run) -> TriangleRun<'s> {
        let range = run.triangles.clone();
        let edge_flags = self.shows_edges().then(|| &self.edge_flags(object)[range.clone()]);
        TriangleRun { geometry, range, edge_flags }
    }

    /// Whether faces show their edges.
    fn shows_edges(&self) -> bool {
        self.purpose == Purpose::Colors && self.settings.style == Style::SurfaceWithEdges
    }

    /// Which edges of the triangles are edges of faces. (Tangents change none.)
    fn edge_flags(&self, object: &DrawnObject<'s>) -> &'s [EdgeFlags] {
        object.geometry.edge_flags(object.source)
    }

    fn hidden_line<'c>(&'c self, object: &DrawnObject<'s>) -> Box<dyn Record + 'c> {
        let geometry = object.geometry;
        let pipeline =
            HiddenLine { columns: &geometry.columns, placement: object.placement, backdrop: self.backdrop };
        let range = 0..geometry.triangles.len();
        let marks = self.marks_of(object, &range);
        let edge_flags = Some(self.edge_flags(object));
        Box::new(TriangleDraw {
            pipeline,
            run: Arc::new(TriangleRun { geometry, range, edge_flags }),
            marks,
            object: object.index,
            culling: Culling::None,
            blend_mode: BlendMode::Opaque,
        })
    }

    fn wire(&self, object: &DrawnObject<'s>, paint: WirePaint, marks: WireMarks) -> Wire<'s> {
        let positions = object.asset.mesh().positions();
        Wire { positions, placement: object.placement, paint, colors: None, marks }
    }

    /// Loose edges and points, in the material of the first slot.
    fn loose<'c>(&'c self, object: &DrawnObject<'s>, draws: &mut Vec<Box<dyn Record + 'c>>) {
        let mesh = object.asset.mesh();
        let (edges, points) = (mesh.loose_edges(), mesh.loose_points());
        if edges.is_empty() && points.is_empty() {
            return;
        }
        let mut paint = WirePaint::of(self.material(object, 0));
        if self.purpose == Purpose::Shapes && paint.alpha_mode() == AlphaMode::Blend {
            if !self.settings.outputs.of_blended {
                return;
            }
            paint = paint.masked();
        }
        // Counting the edges of faces means to find them all.
        let first = if edges.is_empty() { 0 } else { mesh.face_edge_count() };
        let colors = mesh.attributes().vertex_colors.as_deref();
        draws.extend(self.segments(object, EdgeRange { first, edges }, paint, colors));
        draws.extend(self.points(object, paint));
    }

    /// Lines along edges of a mesh, in the colours of its vertices if there are any.
    fn segments<'c>(
        &'c self,
        object: &DrawnObject<'s>,
        EdgeRange { first, edges: segments }: EdgeRange<'s>,
        paint: WirePaint,
        colors: Option<&'s [Vec4]>,
    ) -> Option<Box<dyn Record + 'c>> {
        let edges = &self.settings.marks.edges;
        let mut numbers = elements::numbers(edges, object.id);
        numbers.drain(..first.min(numbers.len()));
        let marks = WireMarks { numbers: Arc::new(numbers), colors: elements::colors(edges) };
        let (wire, geometry) = (self.wire(object, paint, marks), object.geometry);
        let (object, width, blend_mode) =
            (object.index, self.settings.line_width, blend_mode_of(paint.alpha_mode()));
        (!segments.is_empty()).then(|| match colors {
            Some(colors) => {
                let pipeline = ColoredLines { wire, colors };
                Box::new(Segments { pipeline, geometry, segments, object, width, blend_mode }) as _
            }
            None => Box::new(Segments { pipeline: wire, geometry, segments, object, width, blend_mode }) as _,
        })
    }

    fn points<'c>(&'c self, object: &DrawnObject<'s>, paint: WirePaint) -> Option<Box<dyn Record + 'c>> {
        let mesh = object.asset.mesh();
        let points = mesh.loose_points();
        let colors = mesh.attributes().vertex_colors.as_deref();
        let colors = colors.map(|of_vertices| PointColors { of_vertices, points });
        let dots = || Dots {
            pipeline: Wire { colors, ..self.wire(object, paint, WireMarks::default()) },
            geometry: object.geometry,
            points: PointList::Loose(points),
            object: object.index,
            size: self.point_size(),
            marked: None,
            blend_mode: blend_mode_of(paint.alpha_mode()),
            depth_bias: 0.0,
        };
        (!points.is_empty()).then(|| Box::new(dots()) as Box<dyn Record>)
    }

    /// The size of loose points.
    fn point_size(&self) -> f32 {
        let count = || {
            let shown = self.scene.nodes().iter().filter(|(id, _)| self.shapes.get(id.index()).is_some());
            let assets = shown.filter_map(|(_, node)| self.scene.meshes().get(node.mesh?));
            assets.map(|asset| asset.mesh().loose_points().len() as u64).sum()
        };
        *self.point_size.get_or_init(|| self.settings.size_of_points(count()))
    }

    /// The vertices of faces, edges and points. They write neither depth nor ids, so that what lies
    /// below them can be picked.
    fn vertices<'c>(&'c self, object: &DrawnObject<'s>) -> Option<Box<dyn Record + 'c>> {
        let shown = self.settings.vertices.filter(|_| self.purpose == Purpose::Colors)?;
        let listed = &self.settings.marks.vertices;
        let list = self.vertex_lists.of(object.id, object.asset.used_vertices(), listed);
        if list.points.is_empty() {
            return None;
        }
        let VertexList { points, numbers, marked } = list;
        let marks = WireMarks { numbers, colors: elements::colors(listed) };
        Some(Box::new(Dots {
            pipeline: self.wire(object, WirePaint::of_color(shown.color), marks),
            geometry: object.geometry,
            points: PointList::Listed(points),
            object: object.index,
            size: shown.size,
            marked: Some((marked, shown.marked_size)),
            blend_mode: BlendMode::Overlay,
            depth_bias: VERTEX_DEPTH_BIAS,
        }))
    }
}

/// Some edges of a mesh.
struct EdgeRange<'s> {
    /// The number of the first.
    first: usize,
    edges: &'s [[u32; 2]],
}

/// A material of which only alpha matters.
fn bare(material: &Material) -> Material {
    Material {
        shading: Shading::Unlit,
        emissive: Vec3::ZERO,
        normal_map: None,
        occlusion: None,
        ..material.clone()
    }
}

/// How the rasterizer treats an alpha mode.
fn blend_mode_of(mode: AlphaMode) -> BlendMode {
    match mode {
        AlphaMode::Opaque => BlendMode::Opaque,
        AlphaMode::Mask { .. } => BlendMode::Masked,
        AlphaMode::Blend => BlendMode::Translucent,
    }
}
