//! The contents of a window, shared by the application and the window: scene, camera, settings,
//! keys, and text over the image.

mod images;

use std::sync::Arc;
use std::time::Duration;

use trigon_camera::{Camera, DEFAULT_MARGIN, Orbit, Viewport};
use trigon_math::{Bounds3, DVec2, DVec3};
use trigon_scene::{Hit, NodeId, RenderSettings, Scene, Snap, StageTimes};

use crate::drawer::Drawer;
use crate::input::InputOwner;
use crate::keymap::Keymap;
use crate::moves::Moves;
use crate::overlay::Overlay;
use crate::pacing::{Progress, USUAL_BUDGET};
use crate::panes::{self, Area, Pane};
use crate::refinement::{Comparison, QualityReport, Refinement};
use crate::shared_scene::SharedScene;
use crate::shown::Shown;
use crate::theme::Theme;
use crate::waker::Waker;
pub(crate) use images::Subject;

/// Size of a new window in logical pixels, as in F3D.
const DEFAULT_SIZE: Viewport = Viewport { width: 1000, height: 600 };

/// From the right, above and front, as in F3D.
const DEFAULT_DIRECTION: DVec3 = DVec3::new(-1.0, -0.5, -1.0);

/// The time of the last image, and of presenting it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct FrameReport {
    /// From the scene to colours, on the worker thread.
    pub render: Duration,
    /// Conversion, interface, and handing it to the window system.
    pub present: Duration,
    /// The stages of `render`. Times of stages in tiles are sums over all threads.
    pub stages: StageTimes,
    /// Whether it is a draft with coarser meshes.
    pub is_coarse: bool,
}

/// Whether something is visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Visibility {
    /// It is hidden.
    #[default]
    Hidden,
    /// It is.
    Shown,
}

impl Visibility {
    /// The opposite.
    #[must_use]
    pub fn toggled(self) -> Self {
        match self {
            Self::Hidden => Self::Shown,
            Self::Shown => Self::Hidden,
        }
    }
}

/// The initial view, and the one to return to.
#[derive(Debug, Clone)]
enum Home {
    /// The whole scene, seen along this direction.
    Fit(DVec3),
    /// As it was set.
    Fixed(Orbit),
}

/// The contents of a window. The contents may be changed before the window opens and from every method of
/// [`crate::Handler`].
pub struct Stage {
    /// What is drawn.
    pub scene: SharedScene,
    /// The camera. A window begins with [`Stage::reset_view`].
    pub orbit: Orbit,
    /// How it is drawn. The window sets width, height and outputs; the line width and the sizes of
    /// vertices are in logical pixels.
    pub settings: RenderSettings,
    /// How far the image is refined at rest.
    pub refinement: Refinement,
    /// Whether it is compared with the reference at rest.
    pub comparison: Comparison,
    /// Draws the image at rest instead of the renderer. It is then not refined, but can be compared
    /// with the renderer's reference.
    pub drawer: Option<Arc<dyn Drawer>>,
    /// The time budget for an image while something moves: images are made as small as this
    /// requires. 33 ms by default; less than 1 ms counts as 1 ms.
    pub frame_budget: Duration,
    /// The part of the window in which the scene is seen, in physical pixels; by default all of it. Panels may cover
    /// the rest.
    pub view_area: Option<Area>,
    /// Whether four views share that part: from the top, the front and the right, and the camera's view at the upper
    /// right.
    pub four_views: bool,
    /// The text over the image.
    pub overlay: Overlay,
    /// What keys and drags do.
    pub keymap: Keymap,
    /// Who receives mouse and key events first.
    pub input_owner: InputOwner,
    /// Whether the pointer wraps around at the window's border, for unlimited drags; if the system does not
    /// let programs move the pointer, it stays. Movements that arrive together count as one then: only where they
    /// lead matters.
    pub wraps_pointer: bool,
    /// The object that keys move and rotate.
    pub selection: Option<NodeId>,
    /// Whether the list of keys is shown.
    pub cheat_sheet: Visibility,
    /// Whether the frame time is shown.
    pub frame_time: Visibility,
    /// Whether the window fills the screen.
    pub full_screen: bool,
    /// Nodes beside the model, such as a grid: views are not fitted to them.
    pub beside: Vec<NodeId>,
    /// The height of what covers the lower edge of the window all the time, such as a bar, in points: fitted
    /// views leave it free, and as much at the upper edge.
    pub covered_below: f32,
    /// In how many columns a drawer shows the scene side by side: views are fitted to one of them.
    pub columns: u32,
    /// Whether the time of each of its stages is shown.
    pub stage_times: Visibility,
    /// Whether panels are light or dark.
    pub theme: Theme,
    /// The size of text and widgets, in addition to the display's own scale: 0.5 to 4.
    pub text_scale: f32,
    /// The search text of the key list.
    pub(crate) command_search: String,
    /// Where the menu is, if it is open.
    pub(crate) menu: Option<Menu>,
    /// How many files are dragged over the window.
    pub(crate) hovered_files: usize,
    moves: Moves,
    title: String,
    home: Home,
    /// The image in the window.
    shown: Option<Shown>,
    waker: Waker,
    viewport: Viewport,
    scale: f64,
    report: FrameReport,
    is_moving: bool,
    is_resting: bool,
    quality_report: Option<QualityReport>,
    progress: Option<Progress>,
    /// How much of the image in progress is drawn, in percent, if it takes long.
    percent: Option<u8>,
    wishes: Wishes,
}

/// A menu that is open.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Menu {
    /// Where it was asked for, in physical pixels.
    pub(crate) requested_at: Option<DVec2>,
    /// Where it is, in points, once it was shown.
    pub(crate) at: Option<egui::Pos2>,
}

/// What the application has asked for and the window has not done yet.
#[derive(Debug, Default)]
pub(crate) struct Wishes {
    pub(crate) exit: bool,
    pub(crate) animate: bool,
    pub(crate) images: Vec<RenderSettings>,
}

impl Stage {
    /// An empty scene, seen from the right, above and front.
    #[must_use]
    pub fn new(title: impl Into<String>) -> Self {
        Self {
            scene: SharedScene::default(),
            orbit: Orbit::new(DVec3::Y),
            settings: RenderSettings::new(DEFAULT_SIZE.width, DEFAULT_SIZE.height),
            refinement: Refinement::default(),
            comparison: Comparison::default(),
            drawer: None,
            frame_budget: USUAL_BUDGET,
            view_area: None,
            four_views: false,
            overlay: Overlay::default(),
            keymap: Keymap::default(),
            input_owner: InputOwner::default(),
            wraps_pointer: false,
            selection: None,
            cheat_sheet: Visibility::Hidden,
            frame_time: Visibility::Hidden,
            full_screen: false,
            beside: Vec::new(),
            covered_below: 0.0,
            columns: 1,
            stage_times: Visibility::Hidden,
            theme: Theme::System,
            text_scale: 1.0,
            command_search: String::new(),
            menu: None,
            hovered_files: 0,
            moves: Moves::default(),
            title: title.into(),
            home: Home::Fit(DEFAULT_DIRECTION),
            shown: None,
            waker: Waker::default(),
            viewport: DEFAULT_SIZE,
            scale: 1.0,
            report: FrameReport::default(),
            is_moving: false,
            is_resting: false,
            quality_report: None,
            progress: None,
            percent: None,
            wishes: Wishes::default(),
        }
    }

    /// The window's title.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Sets the window's title.
    pub fn set_title(&mut self, title: impl Into<String>) {
        self.title = title.into();
    }

    /// Size of the window in physical pixels; 0 while the window is minimized.
    #[must_use]
    pub fn viewport(&self) -> Viewport {
        self.viewport
    }

    /// Requests a window of this size, in logical pixels; once it is open, its user decides. The
    /// default is 1000×600, as in F3D.
    pub fn set_size(&mut self, size: Viewport) {
        self.viewport = size;
    }

    /// Physical pixels per logical one.
    #[must_use]
    pub fn scale(&self) -> f64 {
        self.scale
    }

    /// The times of the images at rest and their difference, for the current scene, camera and
    /// settings; `None` before they are drawn.
    #[must_use]
    pub fn quality_report(&self) -> Option<QualityReport> {
        self.quality_report
    }

    /// The time of the last frame: a draft, or the image that the settings define.
    #[must_use]
    pub fn report(&self) -> FrameReport {
        self.report
    }

    /// The current camera, with its planes around the scene.
    #[must_use]
    pub fn camera(&self) -> Camera {
        self.orbit.camera(&self.scene.bounds())
    }

    /// The part of the window in which the scene is seen: [`Stage::view_area`], as far as it lies in the window.
    #[must_use]
    pub fn visible_area(&self) -> Area {
        let whole = Area { min: [0, 0], size: self.viewport };
        self.view_area.map_or(whole, |area| area.within(self.viewport))
    }

    /// The part of the window that its image fills. Four views are parts of one image in all of it.
    pub(crate) fn image_area(&self) -> Area {
        if self.four_views { Area { min: [0, 0], size: self.viewport } } else { self.visible_area() }
    }

    /// The views in the window, without overlap: one, or four with [`Stage::four_views`].
    #[must_use]
    pub fn panes(&self) -> Vec<Pane> {
        panes::panes(self.orbit, self.visible_area(), self.four_views)
    }

    /// The view at a point of the window, in physical pixels; the camera's own between and outside views.
    #[must_use]
    pub fn pane_at(&self, at: DVec2) -> Pane {
        let mut panes = self.panes();
        let found = panes.iter().position(|pane| pane.area.contains(at));
        let found = found.or_else(|| panes.iter().position(|pane| pane.side.is_none()));
        panes.swap_remove(found.unwrap_or_default())
    }

    /// The camera of a view, with its planes around the scene.
    #[must_use]
    pub fn camera_of(&self, pane: &Pane) -> Camera {
        pane.orbit.camera(&self.scene.bounds())
    }

    /// Makes this the initial view, and the one to return to: the whole scene, seen along
    /// `direction`.
    pub fn set_home_direction(&mut self, direction: DVec3) {
        self.home = Home::Fit(direction);
    }

    /// Makes this the initial view, and the one to return to.
    pub fn set_home(&mut self, view: Orbit) {
        self.home = Home::Fixed(view);
    }

    /// Returns to the initial view: the one set as home, or the whole scene.
    pub fn reset_view(&mut self) {
        match self.home {
            Home::Fixed(view) => self.orbit = view,
            Home::Fit(direction) => {
                self.orbit.look_along(direction);
                self.fit_view();
            }
        }
    }

    /// Takes the whole scene but for what is beside it into the image, seen from the same side.
    pub fn fit_view(&mut self) {
        let points: Vec<_> = if self.beside.is_empty() {
            self.scene.visible_points().collect()
        } else {
            let mut alone = Scene::clone(&self.scene);
            for &node in &self.beside {
                alone.remove(node);
            }
            alone.visible_points().collect()
        };
        self.fit_points(&points);
    }

    /// Takes points into the part of the image that nothing covers all the time, seen from the same side.
    pub fn fit_points(&mut self, points: &[DVec3]) {
        let fit_share = self.fit_share();
        self.orbit.fit_points(points, self.fit_aspect() / fit_share, DEFAULT_MARGIN);
        self.orbit.zoom(fit_share);
    }

    /// The width of the part of the window that views are fitted to, divided by its height.
    #[must_use]
    pub fn fit_aspect(&self) -> f64 {
        self.visible_area().size.aspect() / f64::from(self.columns.max(1))
    }

    /// The share of the window's height for fitted views, with the middle of the window in its middle: see
    /// [`Stage::covered_below`].
    #[must_use]
    pub fn fit_share(&self) -> f64 {
        /// However low the window is.
        const LEAST: f64 = 0.5;
        let covered = f64::from(self.covered_below) * f64::from(self.text_scale) * self.scale;
        (1.0 - 2.0 * covered / f64::from(self.viewport.height.max(1))).clamp(LEAST, 1.0)
    }

    /// What the image in the window shows at a point, in physical pixels, and its world position.
    /// It is looked up in that image, in constant time. While something moves, that is a draft,
    /// which may be older than scene and camera: then the result is what the draft shows, seen by
    /// the draft's camera. A node that was removed since is not found, and for one whose mesh was
    /// replaced the face is `None`. `None` for background, outside the window, before there is
    /// an image, and while a [draft with coarser meshes](FrameReport::is_coarse) is on screen, which has no ids.
    #[must_use]
    pub fn pick(&self, at: DVec2) -> Option<(Hit, DVec3)> {
        self.shown.as_ref()?.pick(at, self.image_area(), &self.scene)
    }

    /// The distances of what the window shows at points, in physical pixels, in metres along the line of
    /// sight: much cheaper than [`Stage::pick`] where there are many. `None` for background, outside the window, and
    /// before there is an image.
    #[must_use]
    pub fn distances_at(&self, points: impl Iterator<Item = DVec2>) -> Vec<Option<f64>> {
        match &self.shown {
            Some(shown) => shown.distances(points, self.image_area()),
            None => points.map(|_| None).collect(),
        }
    }

    /// What a pointer at this point snaps to, within a radius, both in physical pixels: a vertex, an edge or a face of
    /// the image in the window. `None` on the background, and while that image is a draft.
    #[must_use]
    pub fn snap(&self, at: DVec2, radius: f64) -> Option<Snap> {
        self.shown.as_ref()?.snap(at, radius, self.image_area(), &self.scene)
    }

    /// Whether the image in the window shows the scene where the camera sees it; see
    /// [`Drawer::shows_scene`](crate::Drawer::shows_scene).
    #[must_use]
    pub fn shows_scene(&self) -> bool {
        self.drawer.as_ref().is_none_or(|drawer| drawer.shows_scene())
    }

    /// The box around the selected object in the world.
    #[must_use]
    pub fn selection_bounds(&self) -> Option<Bounds3> {
        let id = self.selection?;
        let mesh = self.scene.meshes().get(self.scene.node(id)?.mesh?)?;
        Some(mesh.mesh().bounds().transformed(&self.scene.world_transform(id)))
    }

    /// Opens the menu, at a place in physical pixels or at the pointer.
    pub(crate) fn open_menu(&mut self, at: Option<DVec2>) {
        self.cheat_sheet = Visibility::Hidden;
        self.menu = Some(Menu { requested_at: at, at: None });
    }

    /// The objects that were moved by hand and not put back.
    #[must_use]
    pub fn moved_nodes(&self) -> Vec<NodeId> {
        self.moves.moved()
    }

    /// Puts the object that was moved or turned last back. Returns whether there was one.
    pub fn undo_move(&mut self) -> bool {
        let undone = self.moves.undo(&mut self.scene);
        self.selection = undone.or(self.selection);
        undone.is_some()
    }

    /// Moves or turns the object again that was put back last. Returns whether there was one.
    pub fn redo_move(&mut self) -> bool {
        let redone = self.moves.redo(&mut self.scene);
        self.selection = redone.or(self.selection);
        redone.is_some()
    }

    /// Forgets how objects were moved: the scene is another one.
    pub fn forget_moves(&mut self) {
        self.moves = Moves::default();
    }

    /// The selected object is about to be moved by hand.
    pub(crate) fn begin_move(&mut self) {
        self.moves.begin(&self.scene, self.selection);
    }

    /// A hand has let go of it.
    pub(crate) fn end_move(&mut self) {
        self.moves.end(&self.scene);
    }

    /// Asks for an image with these settings, which [`crate::Handler::image`]
    /// gets when the current call is over. For an image of what is on the
    /// screen, use [`Stage::settings`] with [`Stage::viewport`] for its size.
    pub fn request_image(&mut self, settings: RenderSettings) {
        self.wishes.images.push(settings);
    }

    /// Starts calling [`crate::Handler::frame`] again.
    pub fn animate(&mut self) {
        self.wishes.animate = true;
    }

    /// Closes the window after the current call.
    pub fn exit(&mut self) {
        self.wishes.exit = true;
    }

    /// Wakes this window from other threads.
    #[must_use]
    pub fn waker(&self) -> Waker {
        self.waker.clone()
    }

    pub(crate) fn wishes(&mut self) -> &mut Wishes {
        &mut self.wishes
    }

    pub(crate) fn resize(&mut self, viewport: Viewport) {
        self.viewport = viewport;
    }

    pub(crate) fn rescale(&mut self, scale: f64) {
        if scale.is_finite() && scale > 0.0 {
            self.scale = scale;
        }
    }

    /// The image in the window was replaced.
    pub(crate) fn show(&mut self, shown: Option<Shown>) {
        self.shown = shown;
    }

    /// Whether images follow one another.
    pub(crate) fn is_moving(&self) -> bool {
        self.is_moving
    }

    /// Whether the window neither draws an image of the scene nor is about to: nothing moves, and the image on screen is
    /// refined as far as [`Stage::refinement`] and [`Stage::comparison`] say. For an application that measures times.
    #[must_use]
    pub fn is_resting(&self) -> bool {
        self.is_resting
    }

    pub(crate) fn set_resting(&mut self, is_resting: bool) {
        self.is_resting = is_resting;
    }

    pub(crate) fn set_moving(&mut self, is_moving: bool) {
        self.is_moving = is_moving;
    }

    pub(crate) fn set_report(&mut self, report: FrameReport) {
        self.report = report;
    }

    pub(crate) fn set_quality_report(&mut self, report: Option<QualityReport>) {
        self.quality_report = report;
    }

    /// What is being drawn.
    pub(crate) fn progress(&self) -> Option<Progress> {
        self.progress
    }

    /// How much of the image in progress is drawn, in percent; `None` if that takes no second.
    pub(crate) fn percent(&self) -> Option<u8> {
        self.percent
    }

    pub(crate) fn set_progress(&mut self, progress: Option<Progress>, percent: Option<u8>) {
        (self.progress, self.percent) = (progress, percent);
    }
}

#[cfg(test)]
mod tests;
