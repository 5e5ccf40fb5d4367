//! Draws image after image of one model that is loaded once: the cameras of a file, a turntable, an animation. A view
//! that fails does not keep the others from being drawn.

use trigon_camera::Viewport;
use trigon_io::Sequence;
use trigon_scene::{Frame, Renderer};

use crate::args::{Destination, Mode, Request, Subject};
use crate::drawing::{draw, finished, warn_of_omissions, warn_of_opaque_glass};
use crate::facts::{CameraFacts, ViewFacts, names};
use crate::failure::Failure;
use crate::framing::Shot;
use crate::model::Model;
use crate::outlet::Outlet;
use crate::report::Reporter;
use crate::series::{Series, SeriesView};

/// Draws all views of what the request asks for, to as many files or to one. Returns what is to be told of each, and
/// a failure if one failed, of which everything has been said.
pub(crate) fn draw_series(
    model: &mut Model,
    request: &Request,
    outlet: &mut Outlet<'_>,
    reporter: Reporter,
) -> Result<(Vec<ViewFacts>, Option<Failure>), Failure> {
    let series = Series::new(model, request, reporter)?;
    request.scenery.add_to(&mut model.scene);
    let renderer = Renderer::new(request.settings.clone());
    let mut drawing = SeriesDrawing {
        series: &series,
        model,
        request,
        renderer,
        reporter,
        has_lens: false,
        views: Vec::new(),
    };
    let is_moving = matches!(
        &request.mode,
        Mode::Image { output: Some(Destination::File(template)), .. } if template.is_moving()
    );
    if is_moving {
        drawing.draw_sequence(outlet)?;
    } else {
        (0..series.frames()).for_each(|number| drawing.draw_file(number, outlet));
    }
    drawing.warn();
    let worst = drawing.views.iter().filter_map(|view| view.exit_code).max();
    Ok((drawing.views, worst.map(Failure::Reported)))
}

/// A series that is being drawn.
struct SeriesDrawing<'a> {
    series: &'a Series,
    model: &'a mut Model,
    request: &'a Request,
    renderer: Renderer,
    reporter: Reporter,
    /// Whether any view has a fisheye lens.
    has_lens: bool,
    /// Of the views that were drawn.
    views: Vec<ViewFacts>,
}

impl SeriesDrawing<'_> {
    /// Draws a view to a file of its own, with its outputs beside it.
    fn draw_file(&mut self, number: u32, outlet: &mut Outlet<'_>) {
        let before = outlet.written.len();
        let drawn = self.draw(number).and_then(|frame| {
            let source = &self.model.source;
            let view = self.series.name(number);
            outlet.put(Subject { model: source.image_subject(), frame: number, view }, &frame)
        });
        let view = self.views.last_mut().expect("a view that was begun is in the list");
        view.written = names(&outlet.written[before..]);
        if let Err(failure) = drawn {
            self.reporter.error(format_args!("view {number}: {failure}"));
            view.exit_code = Some(failure.exit_code());
            view.failure = Some(failure.to_string());
        }
    }

    /// Draws all views into one file that shows them in turn.
    fn draw_sequence(&mut self, outlet: &mut Outlet<'_>) -> Result<(), Failure> {
        let Viewport { width, height } = self.series.common_size(self.request)?;
        let frames = self.series.frames();
        let sequence = Sequence { width, height, frames, frames_per_second: self.request.sequence.rate };
        let source = self.model.source.clone();
        let subject = Subject { model: source.image_subject(), ..Subject::default() };
        outlet.put_moving(subject, &sequence, &mut |number| self.draw(number))
    }

    /// Draws a view, and adds it to the list of views.
    fn draw(&mut self, number: u32) -> Result<Frame, Failure> {
        let SeriesView { shot, lens, image, has_clip_planes } =
            self.series.set(&mut self.model.scene, number, self.request);
        let camera = match has_clip_planes {
            true => shot.camera,
            // A pose may come nearer than the first one, and lines beside the model may, too.
            false => self.request.framing.with_wider_clip_planes(&shot.camera, &self.model.scene),
        };
        self.views.push(ViewFacts::new(
            number,
            self.series.name(number),
            CameraFacts::new(&camera, lens.as_ref(), image),
            image,
        ));
        let shot = Shot { camera, ..shot };
        let settings = self.renderer.settings_mut();
        (settings.width, settings.height) = (image.width, image.height);
        self.has_lens |= lens.is_some();
        let drawn = draw(self.model, &shot, lens.as_ref(), &mut self.renderer, self.request, self.reporter)?;
        let view = self.views.last_mut().expect("just added");
        (view.draw_seconds, view.pixels_shaded) = (drawn.seconds, drawn.pixels_shaded);
        view.positions_origin = drawn.frame.positions.as_ref().map(|_| drawn.frame.origin.to_array());
        finished(drawn.frame, self.model, &camera, self.request)
    }

    /// Warns of what is wrong with several images once.
    fn warn(&self) {
        let title = self.model.source.title();
        let is_empty = |view: &&ViewFacts| view.failure.is_none() && view.pixels_shaded == 0;
        let empty: Vec<u32> = self.views.iter().filter(is_empty).map(|view| view.frame).collect();
        if let Some(first) = empty.first() {
            self.reporter.warning(format_args!(
                "{title}: the model is not in view in {} of {} images, first in view {first}; check the cameras and their convention, or show faces that point away (--backface-type=visible)",
                empty.len(),
                self.views.len()
            ));
        }
        if self.has_lens {
            warn_of_omissions(self.model, self.renderer.settings(), self.reporter);
        }
        warn_of_opaque_glass(&self.renderer, &title, self.reporter);
    }
}
