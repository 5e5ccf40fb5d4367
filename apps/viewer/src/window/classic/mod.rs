//! Draws the loaded model with an algorithm of the sources instead of the renderer.

mod projected;

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use trigon_camera::Camera;
use trigon_classic::{Field, Method};
use trigon_scene::{Cancel, Frame, RenderSettings, Scene};
use trigon_window::{Drawer, Stage, choose, egui};

use projected::Projected;

/// Rays against faces and points against planes that an image may take: about ten
/// seconds.
const MOST_PAIRS: usize = 2_000_000_000;

/// What hides what in the image at rest is found by one of the algorithms; light comes
/// from the eye, on whole triangles.
struct Classic {
    method: Method,
    /// What became of it, for the panel.
    summary: Mutex<String>,
}

/// Which algorithm draws.
#[derive(Default)]
pub(super) struct Classics {
    chosen: Option<Arc<Classic>>,
}

impl Classics {
    /// The choice, and what became of it.
    pub(super) fn show(&mut self, ui: &mut egui::Ui, stage: &mut Stage) {
        ui.separator();
        ui.horizontal(|ui| {
            let label = ui.label("drawn by");
            let name = |method: Option<Method>| method.map_or("the renderer", Method::name);
            let current = self.chosen.as_ref().map(|classic| classic.method);
            let methods = std::iter::once(None).chain(Method::ALL.map(Some));
            let methods: Vec<_> = methods.map(|method| (name(method).to_owned(), method)).collect();
            let list = egui::ComboBox::from_id_salt("drawn by").selected_text(name(current));
            let (list, chosen) = choose(ui, list, &methods, &current);
            list.labelled_by(label.id);
            if let Some(method) = chosen {
                self.choose(method, stage);
            }
        });
        if let Some(classic) = &self.chosen {
            ui.set_max_width(420.0);
            ui.label(classic.summary().as_str());
        }
    }

    fn choose(&mut self, method: Option<Method>, stage: &mut Stage) {
        self.chosen = method.map(|method| Arc::new(Classic { method, summary: Mutex::default() }));
        stage.drawer = self.chosen.clone().map(|classic| classic as Arc<dyn Drawer>);
    }
}

impl Classic {
    fn summary(&self) -> std::sync::MutexGuard<'_, String> {
        self.summary.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The image, and what there is to say of it.
    fn attempt(
        &self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        cancel: &Cancel,
    ) -> Result<(Frame, String), String> {
        let projected = Projected::new(scene, camera, settings)?;
        let bodies = &projected.bodies;
        refuse_long_work(self.method, bodies.face_count(), bodies.size())?;
        let begun = Instant::now();
        let drawing = self.method.draw(bodies).map_err(|refused| refused.to_string())?;
        let took = begun.elapsed().as_secs_f64() * 1e3;
        if cancel.is_cancelled() {
            return Err("cancelled".to_owned());
        }
        // The rule of the renderer: the nearest depth in `f32`.
        let right = Method::ZBuffer.draw(bodies).map_err(|refused| refused.to_string())?;
        let others = drawing.faces.values().iter().zip(right.faces.values()).filter(|(a, b)| a != b).count();
        let work = match self.method.test() {
            "" => String::new(),
            test => format!(", {} {test}", drawing.tests),
        };
        let frame = colored(&drawing.faces, &projected.colors);
        let summary = format!("{took:.1} ms{work}; {others} pixels show another face than the z-buffer's");
        Ok((frame, summary))
    }
}

impl Drawer for Classic {
    fn draw(
        &self,
        scene: &Scene,
        camera: &Camera,
        settings: &RenderSettings,
        cancel: &Cancel,
    ) -> Result<Frame, String> {
        let (frame, summary) = match self.attempt(scene, camera, settings, cancel) {
            Ok((frame, summary)) => (Ok(frame), summary),
            Err(reason) => (Err(format!("{}: {reason}", self.method.name())), reason),
        };
        *self.summary() = summary;
        frame
    }
}

/// What would keep the worker busy for minutes is not begun.
fn refuse_long_work(method: Method, faces: usize, [width, height]: [usize; 2]) -> Result<(), String> {
    let most = match method {
        Method::AllRays | Method::Roberts => MOST_PAIRS / (width * height).max(1),
        Method::Warnock => 100_000,
        Method::Painter | Method::ZBuffer | Method::TreeRays => 2_000_000,
    };
    if faces <= most {
        return Ok(());
    }
    Err(format!(
        "{faces} triangles would take minutes at {width}×{height}; the limit is {most}; choose another algorithm or a smaller model"
    ))
}

/// Faces in their colours on black.
fn colored(faces: &Field<u32>, colors: &[[u8; 4]]) -> Frame {
    let [width, height] = faces.size();
    let color = |face: &u32| colors.get(*face as usize).copied().unwrap_or([0, 0, 0, 255]);
    let color = faces.values().iter().flat_map(color).collect();
    Frame { width: width as u32, height: height as u32, color, ..Frame::default() }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_mesh::primitives;
    use trigon_scene::Material;

    fn drawn(method: Method, scene: &Scene) -> (Result<Frame, String>, String) {
        let classic = Classic { method, summary: Mutex::default() };
        let settings = RenderSettings::new(60, 40);
        let camera = scene.overview(settings.aspect());
        let frame = classic.draw(scene, &camera, &settings, &Cancel::default());
        let summary = classic.summary().clone();
        (frame, summary)
    }

    /// Two balls, one of them behind the other.
    fn balls() -> Scene {
        let mut scene = Scene::new();
        scene.add_object("near", primitives::icosphere(1.0, 2), Material::default());
        let far = scene.add_object("far", primitives::icosphere(1.0, 2), Material::default());
        scene.node_mut(far).unwrap().transform.translate(trigon_scene::math::DVec3::new(1.5, 0.0, -1.5));
        scene
    }

    #[test]
    fn every_algorithm_draws_a_model_and_says_how_well() {
        for method in Method::ALL {
            let (frame, summary) = drawn(method, &balls());
            let frame = frame.unwrap_or_else(|reason| panic!("{}: {reason}", method.name()));
            let seen = frame.color.as_chunks::<4>().0.iter().filter(|pixel| pixel[0] > 0).count();
            assert!((600..2000).contains(&seen), "{}: {seen} pixels of the balls", method.name());
            let sameness = if method == Method::Painter { "" } else { "; 0 pixels" };
            assert!(summary.contains(" ms") && summary.contains(sameness), "{}: {summary}", method.name());
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_refused_with_the_reason() {
        let mut scene = Scene::new();
        scene.add_object("ring", primitives::torus(1.0, 0.3, 24, 12), Material::default());
        let (frame, summary) = drawn(Method::Roberts, &scene);
        let reason = frame.expect_err("a ring is not convex");
        assert!(reason.starts_with("Roberts: ") && reason.contains("not convex"), "{reason}");
        assert!(summary.contains("not convex"), "the panel says so, too: {summary}");
        assert!(drawn(Method::Warnock, &scene).0.is_ok(), "others can");
        let refused = refuse_long_work(Method::AllRays, 1_000_000, [1920, 1080]);
        assert!(refused.is_err_and(|reason| reason.contains("1920×1080")), "nobody waits for hours");
    }
}
