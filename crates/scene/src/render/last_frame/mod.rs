//! What the last image was made from, so that the next one can follow from it. If few vertices of a mesh have
//! moved since, and everything else is unchanged, most of the image is the same.
//!
//! The image itself is a [shared frame](super::shared_frames). Of meshes that were never changed and have no
//! marks nothing is kept.

mod marked;

use std::sync::Arc;

use trigon_camera::{Camera, UpAxis};
use trigon_raster::{DrawChange, Pass, Rasterizer, Rect, Stats, Target, TargetError, Texture};

use self::marked::{MarkOrigin, MarkPalette, MarkedPrimitives};
use super::record::{DrawSource, Record};
use super::shared_frames::{ReusableFrame, SharedFrames};
use crate::arena::Arena;
use crate::effect::Effect;
use crate::elements::Marks;
use crate::environment::Environment;
use crate::frame::Frame;
use crate::geometry::GeometryState;
use crate::material::Material;
use crate::node::Node;
use crate::placement::{DepthToDistance, Placement};
use crate::plan::EffectPlan;
use crate::prepare::PreparedScene;
use crate::settings::RenderSettings;
use crate::texture_asset::TextureId;

/// Effects that make a tile depend on other tiles, on geometry out of view, or on another pass.
/// Frames with them do not reuse the last image.
const COUPLING: [Effect; 10] = [
    Effect::LightMeter,
    Effect::Poses,
    Effect::ShadowMaps,
    Effect::ShadowRays,
    Effect::SoftShadows,
    Effect::AmbientOcclusion,
    Effect::Reflection,
    Effect::Refraction,
    Effect::ToneMapping,
    Effect::Outline,
];

/// Rows per task when depths are converted.
const ROWS: usize = 32;

/// Everything that the last image was made from.
#[derive(Default)]
pub(super) struct LastFrame {
    origin: Option<Box<Origin>>,
    /// Whether the last numbered image was made from this origin, and is complete.
    is_whole: bool,
}

/// Everything that determines a frame, except the values of meshes.
struct Origin {
    /// Without the environment, which takes long to compare, and without marks.
    settings: RenderSettings,
    palette: MarkPalette,
    environment: Option<Same<Environment>>,
    camera: Camera,
    up: UpAxis,
    nodes: Arena<Node>,
    materials: Arena<Material>,
    textures: Vec<(TextureId, Same<Texture>)>,
    effects: [bool; Effect::ALL.len()],
    draws: Vec<DrawOrigin>,
}

/// The same of a draw.
#[derive(PartialEq)]
struct DrawOrigin {
    state: GeometryState,
    first_triangle: usize,
    triangle_count: usize,
    placement: Placement,
    marks: MarkOrigin,
}

/// How a frame differs from the last one.
pub(super) enum Redraw {
    /// Unknown: it is drawn as if nothing were kept.
    Independent,
    /// It is drawn completely, and kept.
    Full,
    /// These are the differences of each draw.
    Partial(Vec<ChangedDraw>),
}

/// How a draw differs from that of the last frame.
#[derive(Default)]
pub(super) struct ChangedDraw {
    vertices: Vec<u32>,
    reshaped: Vec<u32>,
    recolored: Vec<u32>,
}

impl LastFrame {
    /// How the next frame differs from the last one, which it replaces.
    pub(super) fn plan_redraw(
        &mut self,
        prepared: &PreparedScene<'_>,
        plan: &EffectPlan,
        draws: &[Box<dyn Record + '_>],
    ) -> Redraw {
        let outputs = &prepared.settings.outputs;
        let is_plain = outputs.color && !outputs.radiance && !outputs.of_triangles();
        // What shows through faces is a pass of its own, too.
        let is_coupled = COUPLING.into_iter().any(|effect| plan.is_on(effect))
            || prepared.settings.xray_opacity().is_some();
        let was_changed = draws.iter().any(|draw| draw.source().geometry.can_follow());
        // Marks may change at any time.
        let is_marked = prepared.settings.vertices.is_some() || !prepared.settings.marks.is_plain();
        if !is_plain || is_coupled || !(was_changed || is_marked) {
            *self = Self::default();
            return Redraw::Independent;
        }
        let sources: Vec<DrawSource<'_>> = draws.iter().map(|draw| draw.source()).collect();
        let is_whole = std::mem::take(&mut self.is_whole);
        let unlike = if is_marked { Redraw::Full } else { Redraw::Independent };
        let Some(origin) = &mut self.origin else {
            self.origin = Some(Box::new(Origin::new(prepared, plan, &sources)));
            return unlike;
        };
        let is_same = origin.update(prepared, plan);
        let changes = origin.replace_draws(&sources);
        match changes {
            _ if !is_same => unlike,
            Some(changes) if is_whole => Redraw::Partial(changes),
            _ => Redraw::Full,
        }
    }

    /// Whether the drawn image can be reused.
    pub(super) fn set_whole(&mut self, is_whole: bool) {
        self.is_whole = is_whole;
    }
}

impl Redraw {
    /// The changes of each draw, if a free frame shows the last image; `None` if all is to be drawn.
    pub(super) fn changes(
        &self,
        frames: &SharedFrames,
        free: &mut ReusableFrame,
        rasterizer: &Rasterizer,
    ) -> Option<Vec<DrawChange<'_>>> {
        match self {
            Self::Partial(draws) if frames.bring_up_to_date(free, rasterizer) => {
                Some(draws.iter().map(DrawChange::from).collect())
            }
            Self::Independent | Self::Full | Self::Partial(_) => None,
        }
    }
}

/// Draws an image that the next one can follow from. The frame has room for it, and shows the last image if the
/// changes since are known.
pub(super) fn redraw(
    pass: &Pass<'_>,
    prepared: &PreparedScene<'_>,
    blank: Target<'_>,
    free: &mut ReusableFrame,
    changes: Option<&[DrawChange<'_>]>,
    rasterizer: &mut Rasterizer,
) -> Result<Stats, TargetError> {
    let mut target = target_of(blank, &mut free.frame)?;
    let redraw = rasterizer.redraw(pass, &mut target, changes);
    measure_depth(&mut free.frame, prepared, &redraw.parts, rasterizer);
    free.redrawn = Some(redraw.parts);
    Ok(redraw.stats)
}

/// A target that writes a frame's colours, depths and ids.
fn target_of<'f>(blank: Target<'f>, frame: &'f mut Frame) -> Result<Target<'f>, TargetError> {
    let mut target = blank.with_srgb8(frame.color.as_chunks_mut().0)?;
    if let Some(depth) = &mut frame.depth {
        target = target.with_depth(depth)?;
    }
    if let Some(objects) = &mut frame.object_ids {
        target = target.with_objects(objects)?;
    }
    if let Some(faces) = &mut frame.face_ids {
        target = target.with_faces(faces)?;
    }
    Ok(target)
}

/// From stored depths to metres, in the parts that were drawn.
fn measure_depth(frame: &mut Frame, prepared: &PreparedScene<'_>, parts: &[Rect], rasterizer: &Rasterizer) {
    let Some(depths) = &mut frame.depth else { return };
    let settings = prepared.settings;
    let distance = DepthToDistance::new(&prepared.camera.projection, settings.aspect());
    let width = settings.width as usize;
    let bands = depths.chunks_mut(width * ROWS).zip((0..).step_by(ROWS));
    rasterizer.share(bands, |(band, top)| {
        for (row, y) in band.chunks_mut(width).zip(top..) {
            for part in parts.iter().filter(|part| (part.min[1]..part.max[1]).contains(&y)) {
                let columns = part.min[0] as usize..part.max[0] as usize;
                row[columns].iter_mut().for_each(|depth| *depth = distance.at(*depth));
            }
        }
    });
}

/// A shared value that is equal only to itself: whoever changes a value that others share makes a copy first.
struct Same<T>(Arc<T>);

impl<T> PartialEq for Same<T> {
    fn eq(&self, other: &Self) -> bool {
        Arc::ptr_eq(&self.0, &other.0)
    }
}

impl<T> Clone for Same<T> {
    fn clone(&self) -> Self {
        Self(Arc::clone(&self.0))
    }
}

impl Origin {
    fn new(prepared: &PreparedScene<'_>, plan: &EffectPlan, sources: &[DrawSource<'_>]) -> Self {
        let scene = prepared.scene;
        Self {
            settings: without_environment_and_marks(prepared.settings),
            palette: MarkPalette::new(&prepared.settings.marks),
            environment: environment_of(prepared),
            camera: *prepared.camera,
            up: scene.up,
            nodes: scene.nodes().clone(),
            materials: scene.materials.clone(),
            textures: textures_of(prepared),
            effects: Effect::ALL.map(|effect| plan.is_on(effect)),
            draws: sources.iter().map(DrawOrigin::new).collect(),
        }
    }

    /// Takes over everything but the draws of another image; returns whether it was the same.
    fn update(&mut self, prepared: &PreparedScene<'_>, plan: &EffectPlan) -> bool {
        // The draws are updated one by one.
        let are_same = [
            keep(&mut self.settings, &without_environment_and_marks(prepared.settings)),
            keep(&mut self.palette, &MarkPalette::new(&prepared.settings.marks)),
            keep(&mut self.environment, &environment_of(prepared)),
            keep(&mut self.camera, prepared.camera),
            keep(&mut self.up, &prepared.scene.up),
            keep(&mut self.nodes, prepared.scene.nodes()),
            keep(&mut self.materials, &prepared.scene.materials),
            keep(&mut self.textures, &textures_of(prepared)),
            keep(&mut self.effects, &Effect::ALL.map(|effect| plan.is_on(effect))),
        ];
        !are_same.contains(&false)
    }

    /// Takes over the draws of another image; returns how they differ, if that is known.
    fn replace_draws(&mut self, sources: &[DrawSource<'_>]) -> Option<Vec<ChangedDraw>> {
        let before = std::mem::replace(&mut self.draws, sources.iter().map(DrawOrigin::new).collect());
        if before.len() != sources.len() {
            return None;
        }
        before
            .iter()
            .zip(&self.draws)
            .zip(sources)
            .map(|((before, now), source)| before.change(now, source))
            .collect()
    }
}

impl<'a> From<&'a ChangedDraw> for DrawChange<'a> {
    fn from(ChangedDraw { vertices, reshaped, recolored }: &'a ChangedDraw) -> Self {
        Self { vertices, reshaped, recolored }
    }
}

impl DrawOrigin {
    fn new(source: &DrawSource<'_>) -> Self {
        let DrawSource { geometry, triangles, placement, marked } = source;
        Self {
            state: geometry.state.clone(),
            first_triangle: triangles.start,
            triangle_count: triangles.len(),
            placement: *placement,
            marks: MarkOrigin::new(marked),
        }
    }

    /// How the draw differs from another one; `None` if that is unknown.
    fn change(&self, now: &Self, source: &DrawSource<'_>) -> Option<ChangedDraw> {
        let Self { first_triangle, triangle_count, placement, .. } = self;
        let is_alike = (first_triangle, triangle_count, placement)
            == (&now.first_triangle, &now.triangle_count, &now.placement);
        if !is_alike {
            return None;
        }
        let MarkedPrimitives { recolored, resized } = self.marks.difference(&now.marks, source)?;
        let change = ChangedDraw { vertices: Vec::new(), reshaped: resized, recolored };
        if self.state == now.state {
            return Some(change);
        }
        let moved = source.geometry.change.as_ref().filter(|change| change.before == self.state)?;
        // Lines and points have the vertices of the mesh.
        if *triangle_count == 0 {
            return Some(ChangedDraw { vertices: moved.mesh_vertices.clone(), ..change });
        }
        let first = *first_triangle as u32;
        let at = |triangle: u32| moved.triangles.partition_point(|&other| other < triangle);
        let own = &moved.triangles[at(first)..at(first + *triangle_count as u32)];
        let reshaped = own.iter().map(|triangle| triangle - first).collect();
        Some(ChangedDraw { vertices: moved.vertices.clone(), reshaped, ..change })
    }
}

/// Replaces a value; returns whether both are equal.
fn keep<T: PartialEq + Clone>(own: &mut T, other: &T) -> bool {
    let is_same = own == other;
    if !is_same {
        own.clone_from(other);
    }
    is_same
}

fn without_environment_and_marks(settings: &RenderSettings) -> RenderSettings {
    let mut settings = RenderSettings { marks: Marks::default(), ..settings.clone() };
    settings.effects.environment = None;
    settings
}

fn environment_of(prepared: &PreparedScene<'_>) -> Option<Same<Environment>> {
    prepared.settings.effects.environment.clone().map(Same)
}

fn textures_of(prepared: &PreparedScene<'_>) -> Vec<(TextureId, Same<Texture>)> {
    prepared.scene.textures.iter().map(|(id, asset)| (id, Same(Arc::clone(&asset.texture)))).collect()
}

#[cfg(test)]
mod tests;
