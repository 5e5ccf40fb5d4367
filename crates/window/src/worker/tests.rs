//! Jobs on other threads: what they end with, and who waits for them.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::mpsc::{Sender, channel};
use std::time::Duration;

use super::gate::Gate;
use super::{
    Cancel, Drawer, Finished, Frame, Job, Outputs, Product, Purpose, Quality, RenderSettings, Scene,
    StageTimes, Task, Unfinished, Worker,
};
use crate::shared_scene::{SceneUpdate, SharedScene};
use trigon_camera::Camera;
use trigon_math::Vec3;
use trigon_mesh::{MeshChange, primitives};
use trigon_scene::{Material, render, showcase};

/// An image of a scene.
fn job_of(scene: Scene, settings: RenderSettings) -> Job {
    let camera = scene.overview(1.0);
    let scene = SceneUpdate::Whole(Box::new(scene));
    let task = Task::Draw { scene, settings: Box::new(settings), drawer: None };
    Job { purpose: Purpose::Image, views: camera.into(), task }
}

/// A square image of a cube.
fn job(side: u32) -> Job {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    job_of(scene, RenderSettings::new(side, side))
}

/// An image of 8 by 8 pixels that somebody else draws.
fn drawn_by(drawer: impl Drawer + 'static) -> Job {
    let mut job = job(8);
    if let Task::Draw { drawer: used, .. } = &mut job.task {
        *used = Some(Arc::new(drawer));
    }
    job
}

/// The image of a job that was finished.
fn image(worker: &mut Worker) -> Option<Frame> {
    match worker.collect()?.product {
        Ok(Product::Frame(frame)) => Some(Arc::unwrap_or_clone(frame)),
        _ => None,
    }
}

/// An image may be of any size, and its memory goes with it.
#[test]
fn whoever_asks_for_an_image_holds_it_alone() {
    let mut worker = Worker::of_caller();
    worker.begin(job(8));
    let Some(Ok(Product::Frame(frame))) = worker.collect().map(|finished| finished.product) else {
        panic!("it is drawn");
    };
    assert!(Arc::try_unwrap(frame).is_ok());
}

#[test]
fn a_thread_draws_what_the_caller_would() {
    let scene = showcase();
    let settings = RenderSettings { samples_per_axis: 2, ..RenderSettings::new(40, 40) };
    let expected = render(&scene, &scene.overview(1.0), &settings).expect("drawn");
    let (mut worker, rung) = Gate::default().worker(|_| false);
    worker.begin(job_of(scene.clone(), settings.clone()));
    rung.recv().expect("it rings when it is done");
    assert!(image(&mut worker).as_ref() == Some(&expected), "the same bytes");
    assert!(!worker.is_busy(), "ready for the next one");
    let mut caller = Worker::of_caller();
    caller.begin(job_of(scene, settings));
    assert!(image(&mut caller) == Some(expected), "the same bytes here");
}

#[test]
fn what_a_job_takes_is_told_by_the_clock_that_was_given() {
    let ((ring, rung), moments) = (channel(), Arc::new(AtomicU32::new(7)));
    let clock = move || Duration::from_secs(1) * moments.fetch_add(5, Ordering::Relaxed);
    let ring = move || ring.send(()).expect("the test waits for it");
    let mut worker = Worker::of_threads(ring, clock);
    worker.begin(job(8));
    rung.recv().expect("it rings when it is done");
    let took = worker.collect().map(|Finished { took, .. }| took);
    assert_eq!(took, Some(Duration::from_secs(5)), "between its beginning and its end");
}

#[test]
fn a_cancelled_job_makes_room_for_the_next() {
    let gate = Gate::default();
    let (mut worker, rung) = gate.worker(|_| true);
    worker.begin(job(8));
    worker.cancel();
    assert!(worker.collect().is_none() && worker.is_busy(), "it is cancelled, but has not ended");
    gate.open();
    rung.recv().expect("it ends");
    let finished = worker.collect().expect("it has ended");
    assert_eq!(finished.product.err(), Some(Unfinished::Cancelled), "without an image");
    worker.begin(job(8));
    rung.recv().expect("it goes on");
    assert!(image(&mut worker).is_some(), "with the next one");
}

/// Tells that it has begun, and draws once the gate is open.
struct Slow(Sender<()>, Gate);

impl Drawer for Slow {
    fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        self.0.send(()).expect("the test waits for it");
        self.1.pass();
        Ok(Frame { width: 8, height: 8, color: vec![7; 4 * 8 * 8], ..Frame::default() })
    }
}

#[test]
fn what_is_cancelled_while_it_is_drawn_is_no_image() {
    let (gate, (begun, has_begun)) = (Gate::default(), channel());
    let (mut worker, rung) = gate.worker(|_| false);
    worker.begin(drawn_by(Slow(begun, gate.clone())));
    has_begun.recv().expect("it is being drawn");
    assert!(worker.collect().is_none() && worker.is_busy(), "and not finished");
    worker.cancel();
    gate.open();
    rung.recv().expect("it ends");
    let finished = worker.collect().expect("it has ended");
    assert_eq!(finished.product.err(), Some(Unfinished::Cancelled), "whatever was drawn");
}

#[test]
fn nobody_waits_for_the_last_tiles_of_what_was_only_better() {
    let gate = Gate::default();
    let (mut worker, rung) = gate.worker(|purpose| purpose == Purpose::Window(Quality::Full(2)));
    worker.begin(Job { purpose: Purpose::Window(Quality::Full(2)), ..job(16) });
    worker.cancel();
    assert!(!worker.is_busy(), "there is room at once");
    let given_up = worker.collect().expect("told at once, too");
    assert_eq!(given_up.product.err(), Some(Unfinished::Cancelled), "without an image");
    worker.begin(job(12));
    rung.recv().expect("images that somebody waits for are drawn meanwhile");
    assert_eq!(image(&mut worker).map(|frame| frame.width), Some(12), "beside it");
    worker.begin(Job { purpose: Purpose::Window(Quality::Full(1)), ..job(8) });
    assert!(worker.collect().is_none() && worker.is_busy(), "what is only better waits for it");
    gate.open();
    let found = std::iter::from_fn(|| {
        rung.recv().expect("it goes on");
        Some(image(&mut worker))
    });
    let found = found.flatten().next().expect("in the end");
    assert_eq!(found.width, 8, "with the next one, and not with what was given up");
}

/// Draws an image of some size with so many bytes of colours.
struct Odd([u32; 2], usize);

impl Drawer for Odd {
    fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let [width, height] = self.0;
        Ok(Frame { width, height, color: vec![7; self.1], ..Frame::default() })
    }
}

#[test]
fn images_of_other_sizes_and_without_all_colours_are_refused() {
    for (size, bytes, is_drawn) in [
        ([8, 8], 256, true),
        ([7, 8], 256, false),
        ([8, 9], 256, false),
        ([8, 8], 252, false),
        ([8, 8], 0, false),
    ] {
        let mut worker = Worker::of_caller();
        worker.begin(drawn_by(Odd(size, bytes)));
        assert_eq!(image(&mut worker).is_some(), is_drawn, "{size:?} with {bytes} bytes");
    }
}

/// Draws an image of some size, or refuses.
struct Other(Result<u32, String>);

impl Drawer for Other {
    fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let side = self.0.clone()?;
        let color = vec![7; 4 * side as usize * side as usize];
        Ok(Frame { width: side, height: side, color, ..Frame::default() })
    }
}

#[test]
fn other_drawers_are_heard_and_not_trusted() {
    let product = |drawer: Other| {
        let mut worker = Worker::of_caller();
        worker.begin(drawn_by(drawer));
        worker.collect().map(|Finished { product, .. }| product)
    };
    let drawn = product(Other(Ok(8)));
    assert!(matches!(drawn, Some(Ok(Product::Frame(frame))) if frame.color[0] == 7), "its image");
    let reason = |product| match product {
        Some(Err(Unfinished::Impossible(reason))) => reason,
        _ => String::new(),
    };
    assert_eq!(reason(product(Other(Err("not convex".into())))), "not convex", "its reason");
    assert!(reason(product(Other(Ok(3)))).contains("3x3"), "an image of the wrong size is none");
}

/// Draws something that is not the scene, with depths and ids of its own.
struct Elsewhere;

impl Drawer for Elsewhere {
    fn draw(&self, _: &Scene, _: &Camera, _: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let mut settings = RenderSettings::new(8, 8);
        settings.outputs = Outputs { depth: true, ids: true, ..settings.outputs };
        let other = showcase();
        render(&other, &other.overview(1.0), &settings).map_err(|error| error.to_string())
    }

    fn shows_scene(&self) -> bool {
        false
    }
}

#[test]
fn nothing_can_be_picked_in_an_image_that_does_not_show_the_scene() {
    let mut worker = Worker::of_caller();
    worker.begin(drawn_by(Elsewhere));
    let frame = image(&mut worker).expect("drawn");
    assert_eq!(frame.color.len(), 4 * 8 * 8, "its colours");
    assert!(frame.depth.is_none(), "no distance");
    assert!(frame.object_ids.is_none() && frame.face_ids.is_none(), "no object and no face");
}

/// Draws grey, perhaps with depths and ids of its own.
struct Grey {
    has_own: bool,
}

impl Drawer for Grey {
    fn draw(&self, _: &Scene, _: &Camera, settings: &RenderSettings, _: &Cancel) -> Result<Frame, String> {
        let RenderSettings { width, height, .. } = *settings;
        let pixels = (width * height) as usize;
        let ids = self.has_own.then(|| vec![3; pixels]);
        Ok(Frame {
            width,
            height,
            color: vec![7; 4 * pixels],
            depth: self.has_own.then(|| vec![5.0; pixels]),
            object_ids: ids.clone(),
            face_ids: ids,
            ..Frame::default()
        })
    }
}

/// An image by it, with these outputs and four samples per pixel.
fn grey(has_own: bool, outputs: Outputs) -> Frame {
    let mut job = drawn_by(Grey { has_own });
    if let Task::Draw { settings, .. } = &mut job.task {
        (settings.outputs, settings.samples_per_axis) = (outputs, 2);
    }
    let mut worker = Worker::of_caller();
    worker.begin(job);
    image(&mut worker).expect("drawn")
}

#[test]
fn what_others_draw_gets_ids_unless_it_has_its_own() {
    let mut scene = Scene::new();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    let all = Outputs { depth: true, ids: true, ..Outputs::default() };
    let settings = RenderSettings { samples_per_axis: 1, outputs: all, ..RenderSettings::new(8, 8) };
    let expected = render(&scene, &scene.overview(1.0), &settings).expect("drawn");
    let found = grey(false, all);
    assert!(found.color.iter().all(|&byte| byte == 7), "its colours");
    assert!(found.object_ids.is_some() && found.object_ids == expected.object_ids, "the renderer's ids");
    assert!(found.face_ids == expected.face_ids && found.depth == expected.depth);
    let own = grey(true, all);
    assert_eq!((own.object_ids, own.face_ids), (Some(vec![3; 64]), Some(vec![3; 64])), "its own");
    assert_eq!(own.depth, Some(vec![5.0; 64]));
    assert_eq!(grey(false, Outputs { ids: false, ..all }).object_ids, None, "nobody asked for any");
}

#[test]
fn what_a_dropped_worker_was_drawing_is_cancelled() {
    let (begun, has_begun) = channel();
    let mut worker = Worker::of_runs(
        || {},
        || {
            let begun = begun.clone();
            move |Job { purpose, views, .. }, cancel: &Cancel| {
                begun.send(cancel.clone()).expect("the test waits for it");
                let product = Err(Unfinished::Cancelled);
                Finished {
                    purpose,
                    views,
                    took: Duration::ZERO,
                    pixels: Duration::ZERO,
                    stages: StageTimes::default(),
                    product,
                    is_coarse: false,
                    redrawn: None,
                }
            }
        },
    );
    worker.begin(job(8));
    let cancel = has_begun.recv().expect("it has begun");
    assert!(!cancel.is_cancelled(), "somebody waits for it");
    drop(worker);
    assert!(cancel.is_cancelled(), "and now nobody does");
}

/// Draws what it is given, once the gate is open, and tells that it has begun.
struct Waiting(Sender<()>, Gate);

impl Drawer for Waiting {
    fn draw(
        &self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        _: &Cancel,
    ) -> Result<Frame, String> {
        self.0.send(()).expect("the test waits for it");
        self.1.pass();
        render(scene, camera, settings).map_err(|error| error.to_string())
    }
}

#[test]
fn a_mesh_is_changed_while_an_image_of_it_is_under_way() {
    let mut scene = SharedScene::default();
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    let (id, _) = scene.meshes().iter().next().expect("it was added");
    let (settings, camera) = (RenderSettings::new(24, 24), scene.overview(1.0));
    let (gate, (begun, has_begun)) = (Gate::default(), channel());
    let waiting: Arc<dyn Drawer> = Arc::new(Waiting(begun, gate.clone()));
    let (mut worker, rung) = Gate::default().worker(|_| false);
    let begin = |worker: &mut Worker, scene: &mut SharedScene| {
        let purpose = Purpose::Image;
        let update = scene.update(worker.held(purpose));
        let (drawer, settings) = (Some(Arc::clone(&waiting)), Box::new(settings.clone()));
        let task = Task::Draw { scene: update, settings, drawer };
        worker.begin(Job { purpose, views: camera.into(), task });
        has_begun.recv().expect("it is being drawn");
    };
    let pull = |scene: &mut SharedScene, to: f32| {
        let change = MeshChange { positions: vec![(7, Vec3::splat(to))], ..MeshChange::default() };
        scene.change_mesh(id, &change).expect("a cube has 8 vertices");
        render(scene, &camera, &settings).expect("drawn")
    };
    let before = render(&scene, &camera, &settings).expect("drawn");
    begin(&mut worker, &mut scene);
    // The thread waits for this one: a change that waited for the thread would never end.
    let after = pull(&mut scene, 0.9);
    assert!(after != before, "the change is to be seen");
    gate.open();
    rung.recv().expect("it is done");
    assert!(image(&mut worker) == Some(before), "the scene as it was when the image was begun");
    for to in [0.9, 0.2, 0.7] {
        let expected = pull(&mut scene, to);
        begin(&mut worker, &mut scene);
        rung.recv().expect("it is done");
        assert!(image(&mut worker) == Some(expected), "with the vertex at {to}");
    }
}

#[test]
fn nobody_holds_a_scene_that_another_one_replaced() {
    let drawn = |worker: &mut Worker, purpose, scene: &mut SharedScene| {
        let update = scene.update(worker.held(purpose));
        let settings = Box::new(RenderSettings::new(8, 8));
        let task = Task::Draw { scene: update, settings, drawer: None };
        worker.begin(Job { purpose, views: Camera::default().into(), task });
    };
    let (mut worker, rung) = Gate::default().worker(|_| false);
    let mut scene = SharedScene::default();
    let better = Purpose::Window(Quality::Full(1));
    for purpose in [Purpose::Image, better] {
        drawn(&mut worker, purpose, &mut scene);
        rung.recv().expect("it is done");
        assert!(image(&mut worker).is_some(), "by either thread");
    }
    assert!(worker.held(better).is_some(), "the second has the scene");
    scene.add_object("cube", primitives::cube(1.0), Material::default());
    drawn(&mut worker, Purpose::Image, &mut scene);
    assert!(worker.held(better).is_none(), "and gives it up");
    rung.recv().expect("it is done");
    assert!(image(&mut worker).is_some(), "told once, for the image");
    drawn(&mut worker, better, &mut scene);
    rung.recv().expect("it is done");
    assert!(image(&mut worker).is_some(), "and it goes on");
}
