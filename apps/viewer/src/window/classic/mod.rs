//! Draws the loaded model with an algorithm of the sources instead of the renderer.

mod projected;

use std::sync::{Arc, Mutex, PoisonError};
use std::time::Instant;

use trigon_camera::Camera;
use trigon_scene::{Cancel, Frame, RenderSettings, Scene};
use trigon_study::Field;
use trigon_study::visibility::Visibility;
use trigon_window::{Drawer, Stage, choose, egui};

use projected::Projected;

/// Those that can be chosen.
const WAYS: [Visibility; 6] = [
    Visibility::Painter,
    Visibility::Roberts,
    Visibility::Warnock,
    Visibility::ZBuffer,
    Visibility::AllRays,
    Visibility::TreeRays,
];

/// Rays against faces and points against planes that an image may take: about ten
/// seconds.
const MOST_PAIRS: usize = 2_000_000_000;

/// What hides what in the image at rest is found by one of the algorithms; light comes
/// from the eye, on whole triangles.
struct Classic {
    way: Visibility,
    /// What became of it, for the panel.
    told: Mutex<String>,
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
            let name = |way: Option<Visibility>| way.map_or("the renderer", Visibility::name);
            let current = self.chosen.as_ref().map(|classic| classic.way);
            let ways = std::iter::once(None).chain(WAYS.map(Some));
            let ways: Vec<_> = ways.map(|way| (name(way).to_owned(), way)).collect();
            let list = egui::ComboBox::from_id_salt("drawn by").selected_text(name(current));
            let (list, chosen) = choose(ui, list, &ways, &current);
            list.labelled_by(label.id);
            if let Some(way) = chosen {
                self.choose(way, stage);
            }
        });
        if let Some(classic) = &self.chosen {
            ui.set_max_width(420.0);
            ui.label(classic.told().as_str());
        }
    }

    fn choose(&mut self, way: Option<Visibility>, stage: &mut Stage) {
        self.chosen = way.map(|way| Arc::new(Classic { way, told: Mutex::default() }));
        stage.drawer = self.chosen.clone().map(|classic| classic as Arc<dyn Drawer>);
    }
}

impl Classic {
    fn told(&self) -> std::sync::MutexGuard<'_, String> {
        self.told.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The image, and what there is to say of it.
    fn attempt(
        &self,
        (scene, camera): (&Scene, &Camera),
        settings: &RenderSettings,
        cancel: &Cancel,
    ) -> Result<(Frame, String), String> {
        let projected = Projected::new(scene, camera, settings)?;
        let bodies = &projected.bodies;
        refuse_long_work(self.way, bodies.face_count(), bodies.size())?;
        let begun = Instant::now();
        let drawing = self.way.draw(bodies).map_err(|refused| refused.to_string())?;
        let took = begun.elapsed().as_secs_f64() * 1e3;
        if cancel.is_cancelled() {
            return Err("cancelled".to_owned());
        }
        let right = Visibility::Engine.draw(bodies).map_err(|refused| refused.to_string())?;
        let others = drawing.faces.values().iter().zip(right.faces.values()).filter(|(a, b)| a != b).count();
        let work = match self.way.test() {
            "" => String::new(),
            test => format!(", {} {test}", drawing.tests),
        };
        let frame = colored(&drawing.faces, &projected.colors);
        let told = format!("{took:.1} ms{work}; {others} pixels show another face than the engine's");
        Ok((frame, told))
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
        let (frame, told) = match self.attempt((scene, camera), settings, cancel) {
            Ok((frame, told)) => (Ok(frame), told),
            Err(reason) => (Err(format!("{}: {reason}", self.way.name())), reason),
        };
        *self.told() = told;
        frame
    }
}

/// What would keep the worker busy for minutes is not begun.
fn refuse_long_work(way: Visibility, faces: usize, [width, height]: [usize; 2]) -> Result<(), String> {
    let most = match way {
        Visibility::AllRays | Visibility::Roberts => MOST_PAIRS / (width * height).max(1),
        Visibility::Warnock => 100_000,
        Visibility::Painter | Visibility::ZBuffer | Visibility::TreeRays | Visibility::Engine => 2_000_000,
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

    fn drawn(way: Visibility, scene: &Scene) -> (Result<Frame, String>, String) {
        let classic = Classic { way, told: Mutex::default() };
        let settings = RenderSettings::new(60, 40);
        let camera = scene.overview(settings.aspect());
        let frame = classic.draw(scene, &camera, &settings, &Cancel::default());
        let told = classic.told().clone();
        (frame, told)
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
        for way in WAYS {
            let (frame, told) = drawn(way, &balls());
            let frame = frame.unwrap_or_else(|reason| panic!("{}: {reason}", way.name()));
            let seen = frame.color.as_chunks::<4>().0.iter().filter(|pixel| pixel[0] > 0).count();
            assert!((600..2000).contains(&seen), "{}: {seen} pixels of the balls", way.name());
            let sameness = if way == Visibility::Painter { "" } else { "; 0 pixels" };
            assert!(told.contains(" ms") && told.contains(sameness), "{}: {told}", way.name());
        }
    }

    #[test]
    fn what_cannot_be_drawn_is_refused_with_the_reason() {
        let mut scene = Scene::new();
        scene.add_object("ring", primitives::torus(1.0, 0.3, 24, 12), Material::default());
        let (frame, told) = drawn(Visibility::Roberts, &scene);
        let reason = frame.expect_err("a ring is not convex");
        assert!(reason.starts_with("Roberts: ") && reason.contains("not convex"), "{reason}");
        assert!(told.contains("not convex"), "the panel says so, too: {told}");
        assert!(drawn(Visibility::Warnock, &scene).0.is_ok(), "others can");
        let refused = refuse_long_work(Visibility::AllRays, 1_000_000, [1920, 1080]);
        assert!(refused.is_err_and(|reason| reason.contains("1920×1080")), "nobody waits for hours");
    }
}
