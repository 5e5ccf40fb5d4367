//! The public renderer.

use std::sync::Arc;

use trigon_camera::{Camera, FisheyeCamera};
use trigon_raster::{Cancel, PixelExplanation, Rect, Stats};

use super::RenderError;
use super::RendererBuilder;
use super::engine::{Engine, Request};
use super::lens_frame::FisheyeRequest;
use crate::effect::Effect;
use crate::effects::EffectCounts;
use crate::frame::Frame;
use crate::plan::EffectPlan;
use crate::prepare::MeshDetail;
use crate::scene::Scene;
use crate::settings::RenderSettings;

/// Draws frames one after the other, with its settings, and keeps threads, memory and shadow maps between
/// them. What is kept changes no byte of a frame: the function [`render`](crate::render()) draws the same
/// one, and starts from scratch each time.
///
/// [`Renderer::builder`] takes the most common settings by name;
/// [`settings_mut`](Self::settings_mut) gives access to all of them, at any time.
///
/// It needs no window, no display and no global state; several can draw the same
/// scene at the same time from several threads.
///
/// ```
/// use trigon_scene::{Outputs, Renderer, showcase, views};
///
/// let scene = showcase();
/// let outputs = Outputs { depth: true, ids: true, ..Outputs::default() };
/// let mut renderer = Renderer::builder().size(64, 48).samples(4).outputs(outputs).build();
/// let frame = renderer.render(&scene, &scene.overview(renderer.settings().aspect()))?;
/// assert_eq!(frame.depth.expect("asked for").len(), 64 * 48);
///
/// let cameras = scene.surround(views::hemisphere(3, 7), renderer.settings().aspect());
/// let mut seen = 0;
/// renderer.render_many(&scene, cameras, |_, frame| {
///     let ids = frame.object_ids.as_ref().expect("asked for");
///     seen += ids.iter().filter(|&&id| id != u32::MAX).count();
///     Ok::<(), trigon_scene::RenderError>(())
/// })?;
/// assert!(seen > 1000, "the scene is in all three images");
/// # Ok::<(), trigon_scene::RenderError>(())
/// ```
pub struct Renderer {
    settings: RenderSettings,
    engine: Engine,
}

impl Renderer {
    /// A renderer with these settings that has not allocated memory yet.
    #[must_use]
    pub fn new(settings: RenderSettings) -> Self {
        Self { settings, engine: Engine::default() }
    }

    /// A builder for a renderer from the settings that differ from the defaults.
    #[must_use]
    pub fn builder() -> RendererBuilder {
        RendererBuilder::default()
    }

    /// The current settings.
    #[must_use]
    pub fn settings(&self) -> &RenderSettings {
        &self.settings
    }

    /// The settings of the next frame, mutable. Memory and threads that still fit are reused.
    pub fn settings_mut(&mut self) -> &mut RenderSettings {
        &mut self.settings
    }

    /// Draws what the camera sees of the scene.
    ///
    /// # Errors
    /// The size or the number of samples is out of range, or the processor lacks the requested SIMD
    /// level.
    pub fn render(&mut self, scene: &Scene, camera: &Camera) -> Result<Frame, RenderError> {
        let mut frame = Frame::default();
        self.render_into(scene, camera, &mut frame)?;
        Ok(frame)
    }

    /// As [`render`](Self::render), into an existing frame. Its previous contents do not matter;
    /// after an error they are unspecified.
    ///
    /// # Errors
    /// As [`render`](Self::render).
    pub fn render_into(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let settings = &self.settings;
        self.engine.draw(Request { scene, camera, settings, cancel: None, detail: MeshDetail::Whole }, frame)
    }

    /// Draws what a fisheye lens sees of the scene, with the same outputs. A ray of the lens through every sample finds the
    /// triangle that it shows; materials, lights, shadows and all other effects are those of other frames. Depth is the
    /// distance from the eye, because along the axis there is none beyond 90°. Pixels beyond the lens show the background;
    /// an environment is black there. Lines, points, edges and marks are not drawn: [`Omission::all`](crate::Omission::all)
    /// tells which of them a scene has.
    ///
    /// Triangles are found in f32 around the middle of the scene: a sample within 2⁻²² of the scene's size, or of its
    /// distance, of an edge may show the triangle beyond it. All else is computed in f64.
    ///
    /// ```
    /// use trigon_scene::camera::{FisheyeCamera, FisheyeLens, PixelCenters, Viewport};
    /// use trigon_scene::math::DVec2;
    /// use trigon_scene::{Renderer, showcase};
    ///
    /// let scene = showcase();
    /// let image = Viewport { width: 60, height: 60 };
    /// let (focal, center) = (DVec2::splat(18.0), DVec2::splat(30.0));
    /// let lens = FisheyeLens::new(focal, center, image, PixelCenters::AtHalves, [0.0; 4])?;
    /// let camera = FisheyeCamera::at(&scene.cameras()[0].1, lens.with_fov(190_f64.to_radians())?);
    /// let frame = Renderer::builder().size(60, 60).build().render_fisheye(&scene, &camera)?;
    /// assert_ne!(frame.pixel(30, 40), frame.pixel(0, 0), "the corner is beyond the lens");
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// As [`render`](Self::render).
    pub fn render_fisheye(&mut self, scene: &Scene, camera: &FisheyeCamera) -> Result<Frame, RenderError> {
        let mut frame = Frame::default();
        let request = FisheyeRequest { scene, camera, settings: &self.settings };
        self.engine.draw_fisheye(request, &mut frame)?;
        Ok(frame)
    }

    /// As [`render_into`](Self::render_into), but returns soon after `cancel` is cancelled: when the
    /// current tiles are done, or the stage before the tiles. For frames that nobody will see, because
    /// the camera has moved on.
    ///
    /// # Errors
    /// The errors of [`render`](Self::render), and [`RenderError::Cancelled`].
    pub fn render_cancellable(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        cancel: &Cancel,
        frame: &mut Frame,
    ) -> Result<(), RenderError> {
        let (settings, cancel) = (&self.settings, Some(cancel));
        self.engine.draw(Request { scene, camera, settings, cancel, detail: MeshDetail::Whole }, frame)
    }

    /// As [`render`](Self::render), or with `cancel` as [`render_cancellable`](Self::render_cancellable), into a
    /// frame that the renderer holds, too. Once everybody else has dropped it, a later frame is drawn into the
    /// same memory; if little has changed in between, only the parts that differ are. To show one image after
    /// the other without copying them, drop each one when the next one is there.
    ///
    /// ```
    /// use trigon_scene::{Renderer, showcase};
    ///
    /// let scene = showcase();
    /// let mut renderer = Renderer::builder().size(32, 24).build();
    /// let camera = scene.overview(renderer.settings().aspect());
    /// let mut shown = renderer.render_shared(&scene, &camera, None)?;
    /// for _ in 0..3 {
    ///     let next = renderer.render_shared(&scene, &camera, None)?;
    ///     assert!(next == shown, "nothing has changed");
    ///     shown = next;
    /// }
    /// # Ok::<(), trigon_scene::RenderError>(())
    /// ```
    ///
    /// # Errors
    /// The errors of [`render`](Self::render), and [`RenderError::Cancelled`].
    pub fn render_shared(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        cancel: Option<&Cancel>,
    ) -> Result<Arc<Frame>, RenderError> {
        let settings = &self.settings;
        self.engine.draw_shared(Request { scene, camera, settings, cancel, detail: MeshDetail::Whole })
    }

    /// As [`render_shared`](Self::render_shared), for an image that shows while something moves: meshes are replaced by
    /// the coarser ones that [`Scene::coarse_mesh_work`] has made, if the settings
    /// [allow](Scene::allows_coarse_meshes) that. Shapes differ by the error of
    /// [`Mesh::clustered`](crate::mesh::Mesh::clustered) at most, and so does the depth. No other image shows coarser meshes.
    ///
    /// ```
    /// use trigon_scene::mesh::primitives;
    /// use trigon_scene::{Material, Renderer, Scene};
    ///
    /// let mut scene = Scene::new();
    /// scene.add_object("torus", primitives::torus(1.0, 0.4, 200, 100), Material::default());
    /// scene.clone().coarse_mesh_work(5_000).expect("it has 40,000 triangles").run();
    ///
    /// let mut renderer = Renderer::builder().size(64, 48).build();
    /// let camera = scene.overview(renderer.settings().aspect());
    /// renderer.render_draft(&scene, &camera, None)?;
    /// assert!(renderer.stats().primitives <= 5_000);
    /// renderer.render_shared(&scene, &camera, None)?;
    /// assert_eq!(renderer.stats().primitives, 40_000);
    /// # Ok::<(), trigon_scene::RenderError>(())
    /// ```
    ///
    /// # Errors
    /// As [`render_shared`](Self::render_shared).
    pub fn render_draft(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        cancel: Option<&Cancel>,
    ) -> Result<Arc<Frame>, RenderError> {
        let settings = &self.settings;
        let is_allowed = scene.allows_coarse_meshes(settings);
        let detail = if is_allowed { MeshDetail::Coarse } else { MeshDetail::Whole };
        self.engine.draw_shared(Request { scene, camera, settings, cancel, detail })
    }

    /// The parts in which the last frame of [`render_shared`](Self::render_shared) may differ from an earlier one, for
    /// whoever shows one after the other. Only frames of one size that somebody holds are known. `None` if it may
    /// differ anywhere.
    ///
    /// ```
    /// use trigon_scene::mesh::primitives;
    /// use trigon_scene::{Material, Renderer, Scene, VertexPoints};
    ///
    /// let mut scene = Scene::new();
    /// scene.add_object("cube", primitives::cube(1.0), Material::default());
    /// let mut renderer = Renderer::builder().size(320, 240).samples_per_axis(1).build();
    /// renderer.settings_mut().vertices = Some(VertexPoints::default());
    /// let camera = scene.overview(renderer.settings().aspect());
    /// let before = renderer.render_shared(&scene, &camera, None)?;
    /// let last = renderer.render_shared(&scene, &camera, None)?;
    /// assert_eq!(renderer.redrawn_between(&before, &last), Some(vec![]), "nothing has changed");
    /// # Ok::<(), trigon_scene::RenderError>(())
    /// ```
    #[must_use]
    pub fn redrawn_between(&self, before: &Frame, last: &Frame) -> Option<Vec<Rect>> {
        self.engine.redrawn_between(before, last)
    }

    /// Draws what each of these cameras sees, one after the other, and passes every frame with its number
    /// from 0 to `visit`. All frames use the memory of one: `visit` clones or writes what it wants to keep.
    ///
    /// # Errors
    /// The first error of drawing, as for [`render`](Self::render), or of `visit`; no more frames
    /// are drawn then.
    pub fn render_many<E: From<RenderError>>(
        &mut self,
        scene: &Scene,
        cameras: impl IntoIterator<Item = Camera>,
        mut visit: impl FnMut(usize, &Frame) -> Result<(), E>,
    ) -> Result<(), E> {
        let mut frame = Frame::default();
        for (index, camera) in cameras.into_iter().enumerate() {
            self.render_into(scene, &camera, &mut frame)?;
            visit(index, &frame)?;
        }
        Ok(())
    }

    /// Explains the pixel in column `x` and row `y` of the image that [`render`](Self::render) draws: all
    /// triangles that touch it, sample by sample, with exact edge values and depths. Says which of them is
    /// visible, and why. Object ids are indices of nodes. `None` outside the image.
    ///
    /// It costs about as much as all stages before the tiles, and then a test of each triangle.
    ///
    /// ```
    /// use trigon_scene::mesh::primitives;
    /// use trigon_scene::{Material, Renderer, Scene};
    ///
    /// let mut scene = Scene::new();
    /// let cube = scene.add_object("cube", primitives::cube(1.0), Material::default());
    /// let mut renderer = Renderer::builder().size(40, 30).build();
    /// let camera = scene.overview(renderer.settings().aspect());
    /// let pixel = renderer.explain_pixel(&scene, &camera, 20, 15)?.expect("inside the image");
    /// let visible = pixel.reported().visible().expect("the cube is in the middle");
    /// assert_eq!(scene.nodes().id_at(visible.object as usize), Some(cube));
    /// # Ok::<(), trigon_scene::RenderError>(())
    /// ```
    ///
    /// # Errors
    /// As [`render`](Self::render).
    pub fn explain_pixel(
        &mut self,
        scene: &Scene,
        camera: &Camera,
        x: u32,
        y: u32,
    ) -> Result<Option<PixelExplanation>, RenderError> {
        self.engine.explain(scene, camera, &self.settings, [x, y])
    }

    /// Makes later frames measure the time of each stage ([`Stats::times`]). Measuring takes a little time
    /// itself.
    pub fn time_stages(&mut self) {
        self.engine.is_timed = true;
    }

    /// Makes later frames measure no times.
    pub fn stop_timing(&mut self) {
        self.engine.is_timed = false;
    }

    /// The plan of the last frame; `None` before the first.
    #[must_use]
    pub fn plan(&self) -> Option<&EffectPlan> {
        self.engine.plan()
    }

    /// The cost of an effect in the last frame.
    #[must_use]
    pub fn effect_counts(&self, effect: Effect) -> EffectCounts {
        self.engine.effect_counts(effect)
    }

    /// The cost of the last frame, in counts.
    #[must_use]
    pub fn stats(&self) -> &Stats {
        self.engine.stats()
    }

    /// For tests: the capacity kept for objects, faces and triangles.
    #[cfg(test)]
    pub(crate) fn id_capacities(&self) -> [usize; 3] {
        self.engine.id_capacities()
    }
}

#[cfg(test)]
mod tests {
    use std::num::NonZeroUsize;

    use trigon_camera::Camera;

    use super::*;
    use crate::{Outputs, render, showcase, views};

    /// Several threads may share a scene, and renderers may move between threads.
    #[test]
    fn whatever_takes_part_can_be_sent_and_shared() {
        fn check<T: Send + Sync>() {}
        check::<Scene>();
        check::<Camera>();
        check::<RenderSettings>();
        check::<Frame>();
        check::<Renderer>();
        check::<RenderError>();
    }

    #[test]
    fn threads_draw_one_scene_at_the_same_time() {
        let scene = showcase();
        let camera = scene.overview(1.0);
        let settings = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(24, 24) };
        let expected = render(&scene, &camera, &settings).expect("drawn");
        std::thread::scope(|scope| {
            let draw = || render(&scene, &camera, &settings).expect("drawn");
            for drawing in [(); 3].map(|()| scope.spawn(draw)) {
                assert!(drawing.join().expect("no panic") == expected, "the same bytes");
            }
        });
    }

    /// The triangle that the explanation calls visible is the one in the image's ids.
    #[test]
    fn explanations_tell_what_the_image_shows() {
        let scene = showcase();
        let outputs = Outputs { ids: true, ..Outputs::default() };
        let mut renderer = Renderer::builder().size(36, 24).samples_per_axis(2).outputs(outputs).build();
        let camera = scene.overview(renderer.settings().aspect());
        let frame = renderer.render(&scene, &camera).expect("drawn");
        let ids = frame.object_ids.clone().expect("asked for");
        for [x, y] in [[18, 12], [3, 20], [30, 16], [0, 0]] {
            let explained = renderer.explain_pixel(&scene, &camera, x, y).expect("drawn").expect("inside");
            let visible = explained.reported().visible().map_or(u32::MAX, |visible| visible.object);
            assert_eq!(visible, ids[(y * 36 + x) as usize], "pixel {x}, {y}");
        }
        assert_eq!(renderer.explain_pixel(&scene, &camera, 36, 0), Ok(None), "outside");
        assert!(renderer.render(&scene, &camera).expect("drawn") == frame, "no trace is left");
    }

    #[test]
    fn stages_are_timed_when_that_is_asked_for() {
        let scene = showcase();
        let mut renderer = Renderer::builder().size(64, 64).build();
        let camera = scene.overview(1.0);
        let frame = renderer.render(&scene, &camera).expect("drawn");
        assert_eq!(renderer.stats().times, trigon_raster::StageTimes::default(), "usually not");
        renderer.time_stages();
        assert!(renderer.render(&scene, &camera).expect("drawn") == frame, "the same bytes");
        assert!(!renderer.stats().times.shading.is_zero(), "measured");
        renderer.stop_timing();
        renderer.render(&scene, &camera).expect("drawn");
        assert!(renderer.stats().times.shading.is_zero(), "not any more");
    }

    #[test]
    fn a_cancelled_image_leaves_no_trace() {
        let (scene, cancel) = (showcase(), Cancel::default());
        let camera = scene.overview(1.0);
        let mut renderer = Renderer::builder().size(48, 48).build();
        renderer.settings_mut().effects.shadows = crate::Shadows::Maps { resolution: 64 };
        let expected = render(&scene, &camera, renderer.settings()).expect("drawn");
        let mut frame = Frame::default();
        renderer.render_cancellable(&scene, &camera, &cancel, &mut frame).expect("nobody cancelled it");
        assert_eq!(cancel.progress(), 1.0, "all of it is drawn");
        assert!(frame == expected, "the same bytes");
        let mut renderer = Renderer::new(renderer.settings().clone());
        cancel.cancel();
        let cancelled = renderer.render_cancellable(&scene, &camera, &cancel, &mut frame);
        assert_eq!(cancelled.err(), Some(RenderError::Cancelled), "as the token says");
        assert!(renderer.render(&scene, &camera) == Ok(expected), "no half-drawn shadow was kept");
    }

    #[test]
    fn the_builder_names_settings() {
        let outputs = Outputs { depth: true, ..Outputs::default() };
        let builder = Renderer::builder().size(30, 20).threads(2).outputs(outputs);
        let expected =
            RenderSettings { outputs, threads: NonZeroUsize::new(2), ..RenderSettings::new(30, 20) };
        assert_eq!(builder.clone().build().settings(), &expected, "size, threads and outputs");
        let samples = |builder: RendererBuilder| {
            let renderer = builder.build();
            [renderer.settings().samples_per_axis, renderer.settings().samples]
        };
        assert_eq!(samples(builder.clone()), [3, 1], "as everywhere");
        assert_eq!(samples(builder.clone().samples(4)), [1, 4], "in all");
        assert_eq!(samples(builder.clone().samples(4).samples_per_axis(2)), [2, 1], "the last one counts");
        assert_eq!(builder.threads(0).build().settings().threads, None, "one for each core");
    }

    #[test]
    fn many_images_in_one_memory_are_those_drawn_one_by_one() {
        let scene = showcase();
        let settings = RenderSettings { samples_per_axis: 1, ..RenderSettings::new(20, 16) };
        let cameras: Vec<Camera> = scene.surround(views::turntable(4, 0.3), settings.aspect()).collect();
        let mut renderer = Renderer::new(settings.clone());
        let (mut places, mut numbers) = (Vec::new(), Vec::new());
        let visit = |number, frame: &Frame| {
            numbers.push(number);
            places.push(frame.color.as_ptr());
            let alone = render(&scene, &cameras[number], &settings)?;
            assert!(*frame == alone, "image {number}");
            Ok::<(), RenderError>(())
        };
        renderer.render_many(&scene, cameras.iter().copied(), visit).expect("drawn");
        assert_eq!(numbers, [0, 1, 2, 3], "in their order");
        assert!(places.iter().all(|&place| place == places[0]), "one memory");
    }

    #[test]
    fn whoever_has_seen_enough_stops() {
        let scene = showcase();
        let cameras = scene.surround(views::turntable(5, 0.0), 1.0);
        let (mut renderer, mut drawn) = (Renderer::builder().size(8, 8).build(), 0);
        let stopped = renderer.render_many(&scene, cameras, |_, _| {
            drawn += 1;
            if drawn == 2 { Err(Box::<dyn std::error::Error>::from("enough")) } else { Ok(()) }
        });
        assert_eq!((stopped.map_err(|error| error.to_string()), drawn), (Err("enough".to_owned()), 2), "two");
    }
}
