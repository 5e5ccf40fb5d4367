//! One view of the scene, or four in one window: three orthographic ones along the axes, and the camera's own at the
//! upper right.
//!
//! There is still one camera, [`Stage::orbit`](crate::Stage::orbit). The other three look at the same target
//! from the same distance, so moving or zooming one view changes all, and no second state is needed. Each
//! view is drawn separately into its part of one [`Frame`], with its ids and depths, so refinement, picking
//! and everything else still work on a single image.

use std::sync::Arc;

use trigon_camera::{AxisView, Camera, Orbit, Projector, Viewport};
use trigon_math::{Bounds3, DVec2, DVec3};
use trigon_scene::{Frame, Outputs, RenderSettings};

/// Columns and rows between two views, in physical pixels.
const GAP: u32 = 2;

/// A part of the window, in physical pixels from its upper left corner.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Area {
    /// The upper left corner.
    pub min: [u32; 2],
    /// How large it is.
    pub size: Viewport,
}

/// One view of a window; see [`Stage::panes`](crate::Stage::panes).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pane {
    /// The side that it shows; `None` for the camera's own view.
    pub side: Option<AxisView>,
    /// Where it looks from.
    pub orbit: Orbit,
    /// Where it is in the window.
    pub area: Area,
}

impl Area {
    /// The upper left corner.
    #[must_use]
    pub fn origin(&self) -> DVec2 {
        DVec2::new(self.min[0].into(), self.min[1].into())
    }

    /// Whether a point of the window is in it.
    #[must_use]
    pub fn contains(&self, at: DVec2) -> bool {
        let within = at - self.origin();
        within.cmpge(DVec2::ZERO).all() && within.cmplt(self.size.size()).all()
    }

    /// What of it lies in a window of this size.
    pub(crate) fn within(self, window: Viewport) -> Self {
        let min = [self.min[0].min(window.width), self.min[1].min(window.height)];
        let width = self.size.width.min(window.width - min[0]);
        let height = self.size.height.min(window.height - min[1]);
        Self { min, size: Viewport { width, height } }
    }

    /// The same part of an image that is stretched to the window.
    fn scaled(self, window: Viewport, image: Viewport) -> Self {
        let scaled = |at: u32, from: u32, to: u32| {
            u32::try_from(u64::from(at) * u64::from(to) / u64::from(from.max(1))).unwrap_or(to).min(to)
        };
        let across = |x| scaled(x, window.width, image.width);
        let down = |y| scaled(y, window.height, image.height);
        let min = [across(self.min[0]), down(self.min[1])];
        let width = across(self.min[0] + self.size.width) - min[0];
        let height = down(self.min[1] + self.size.height) - min[1];
        Self { min, size: Viewport { width, height } }
    }
}

/// The views in a part of a window: one or four.
pub(crate) fn panes(orbit: Orbit, area: Area, four_views: bool) -> Vec<Pane> {
    if !four_views {
        return vec![Pane { side: None, orbit, area }];
    }
    let Viewport { width, height } = area.size;
    let size = Viewport { width: width.saturating_sub(GAP) / 2, height: height.saturating_sub(GAP) / 2 };
    let [left, top] = area.min;
    let (right, bottom) = (left + size.width + GAP, top + size.height + GAP);
    let corners = [
        (Some(AxisView::Top), [left, top]),
        (None, [right, top]),
        (Some(AxisView::Front), [left, bottom]),
        (Some(AxisView::Right), [right, bottom]),
    ];
    corners
        .map(|(side, min)| Pane {
            side,
            orbit: side.map_or(orbit, |side| viewed_from(orbit, side)),
            area: Area { min, size },
        })
        .into()
}

/// The same target in the same size, from a side, in parallel projection.
fn viewed_from(mut orbit: Orbit, side: AxisView) -> Orbit {
    orbit.set_view(side);
    if !orbit.is_orthographic() {
        orbit.toggle_orthographic();
    }
    orbit
}

/// The view of an image of the window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Views {
    /// The camera's own.
    pub(crate) main: Camera,
    window: Viewport,
    /// The cameras and positions of all views, if there are several.
    parts: Vec<(Camera, Area)>,
}

impl From<Camera> for Views {
    fn from(main: Camera) -> Self {
        Self { main, window: Viewport { width: 0, height: 0 }, parts: Vec::new() }
    }
}

impl Views {
    /// Those of a window.
    pub(crate) fn new(panes: &[Pane], window: Viewport, bounds: &Bounds3) -> Self {
        let cameras: Vec<_> = panes.iter().map(|pane| (pane.orbit.camera(bounds), pane.area)).collect();
        let main = panes.iter().position(|pane| pane.side.is_none()).map_or_else(Camera::default, |own| {
            let (camera, _) = cameras[own];
            camera
        });
        Self { main, window, parts: if panes.len() > 1 { cameras } else { Vec::new() } }
    }

    /// The world point at a point of the window, at a distance from the eye. `image` is the part of the window that the
    /// image fills.
    pub(crate) fn at_distance(&self, at: DVec2, image: Area, distance: f64) -> Option<DVec3> {
        if self.parts.is_empty() {
            return Projector::new(&self.main, image.size).at_distance(at - image.origin(), distance);
        }
        let (camera, area) = self.parts.iter().find(|(_, area)| area.contains(at))?;
        Projector::new(camera, area.size).at_distance(at - area.origin(), distance)
    }

    /// How many images are drawn for it.
    pub(crate) fn count(&self) -> u32 {
        self.parts.len().max(1) as u32
    }

    /// Whether there is one view, in all of the image.
    pub(crate) fn is_one(&self) -> bool {
        self.parts.is_empty()
    }

    /// Draws all views, each by `draw`, and assembles them.
    pub(crate) fn draw<E>(
        &self,
        settings: RenderSettings,
        mut draw: impl FnMut(&Camera, RenderSettings) -> Result<Arc<Frame>, E>,
    ) -> Result<Arc<Frame>, E> {
        if self.parts.is_empty() {
            return draw(&self.main, settings);
        }
        let mut whole = empty(&settings);
        let image = Viewport { width: settings.width, height: settings.height };
        for (camera, area) in &self.parts {
            let area = area.scaled(self.window, image);
            let Viewport { width, height } = area.size;
            if width > 0 && height > 0 {
                let part = draw(camera, RenderSettings { width, height, ..settings.clone() })?;
                copy(&part, area, &mut whole);
            }
        }
        Ok(Arc::new(whole))
    }
}

/// An empty image with colours, depths and ids as the settings require.
fn empty(settings: &RenderSettings) -> Frame {
    let RenderSettings { width, height, outputs, .. } = *settings;
    let Outputs { color, depth, ids, .. } = outputs;
    let pixels = width as usize * height as usize;
    Frame {
        width,
        height,
        color: if color { vec![0; 4 * pixels] } else { Vec::new() },
        depth: depth.then(|| vec![f32::INFINITY; pixels]),
        object_ids: ids.then(|| vec![u32::MAX; pixels]),
        face_ids: ids.then(|| vec![u32::MAX; pixels]),
        ..Frame::default()
    }
}

/// Copies a view to its position.
fn copy(part: &Frame, area: Area, whole: &mut Frame) {
    copy_rows(&part.color, 4, area, whole.width, &mut whole.color);
    let (width, to) = (whole.width, &mut whole.depth);
    if let (Some(from), Some(to)) = (&part.depth, to) {
        copy_rows(from, 1, area, width, to);
    }
    let ids = [(&part.object_ids, &mut whole.object_ids), (&part.face_ids, &mut whole.face_ids)];
    for (from, to) in ids {
        if let (Some(from), Some(to)) = (from, to) {
            copy_rows(from, 1, area, width, to);
        }
    }
}

/// `values` for each pixel.
fn copy_rows<T: Copy>(from: &[T], values: usize, area: Area, width: u32, to: &mut [T]) {
    let row = area.size.width as usize * values;
    for (y, from) in from.chunks_exact(row).enumerate() {
        let start = ((area.min[1] as usize + y) * width as usize + area.min[0] as usize) * values;
        if let Some(to) = to.get_mut(start..start + row) {
            to.copy_from_slice(from);
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    #[test]
    fn four_views_look_at_the_same_target_as_large() {
        let (orbit, window) = (Orbit::new(DVec3::Y), Viewport { width: 202, height: 102 });
        let area = Area { min: [0, 0], size: window };
        assert_eq!(panes(orbit, area, false).len(), 1, "usually one");
        let four = panes(orbit, area, true);
        let sides: Vec<_> = four.iter().map(|pane| pane.side).collect();
        assert_eq!(sides, [Some(AxisView::Top), None, Some(AxisView::Front), Some(AxisView::Right)]);
        for pane in &four {
            assert_eq!(pane.area.size, Viewport { width: 100, height: 50 }, "a quarter");
            assert_eq!(pane.orbit.target(), orbit.target());
            assert_eq!(pane.orbit.height_at_target(), orbit.height_at_target(), "as large");
            assert_eq!(pane.orbit.is_orthographic(), pane.side.is_some());
        }
        assert_eq!(four[1].orbit, orbit, "the camera's own");
    }

    #[test]
    fn an_area_holds_its_first_pixels_and_not_those_after_its_last() {
        let area = Area { min: [10, 20], size: Viewport { width: 5, height: 3 } };
        assert_eq!(area.origin(), DVec2::new(10.0, 20.0));
        for (x, y) in (0..40).flat_map(|y| (0..40).map(move |x| (x, y))) {
            let expected = (10..15).contains(&x) && (20..23).contains(&y);
            assert_eq!(area.contains(DVec2::new(x.into(), y.into())), expected, "{x}, {y}");
        }
        assert!(area.contains(DVec2::new(14.9, 22.9)) && !area.contains(DVec2::new(9.9, 21.0)));
    }

    /// Four views beside a panel of 10 by 6 pixels.
    fn four() -> (Vec<Pane>, Viewport, Views) {
        let window = Viewport { width: 52, height: 38 };
        let area = Area { min: [10, 6], size: Viewport { width: 42, height: 32 } };
        let panes = panes(Orbit::new(DVec3::Y), area, true);
        let bounds = Bounds3 { min: DVec3::splat(-1.0), max: DVec3::ONE };
        let views = Views::new(&panes, window, &bounds);
        (panes, window, views)
    }

    #[test]
    fn four_images_are_put_together() {
        let (panes, window, views) = four();
        assert_eq!((views.count(), views.is_one()), (4, false));
        let settings = RenderSettings {
            outputs: Outputs { depth: true, ids: true, ..Outputs::default() },
            ..RenderSettings::new(window.width, window.height)
        };
        let mut number = 0;
        let whole = views.draw(settings, |_, RenderSettings { width, height, .. }| {
            number += 1;
            let pixels = (width * height) as usize;
            let ids = Some(vec![number; pixels]);
            let color = vec![number as u8; 4 * pixels];
            let depth = Some(vec![number as f32; pixels]);
            Ok::<_, ()>(Arc::new(Frame {
                width,
                height,
                color,
                depth,
                object_ids: ids.clone(),
                face_ids: ids,
                ..Frame::default()
            }))
        });
        let whole = whole.expect("all were drawn");
        let pixels =
            (0..window.height).flat_map(|y| (0..window.width).map(move |x| DVec2::new(x.into(), y.into())));
        for (pixel, at) in pixels.enumerate() {
            let pane = panes.iter().position(|pane| pane.area.contains(at));
            let (id, depth) =
                pane.map_or((u32::MAX, f32::INFINITY), |pane| (pane as u32 + 1, pane as f32 + 1.0));
            let color = pane.map_or(0, |pane| pane as u8 + 1);
            assert_eq!(whole.color[4 * pixel..][..4], [color; 4], "{at}");
            assert_eq!(whole.depth.as_ref().map(|depths| depths[pixel]), Some(depth), "{at}");
            for ids in [&whole.object_ids, &whole.face_ids] {
                assert_eq!(ids.as_ref().map(|ids| ids[pixel]), Some(id), "{at}");
            }
        }
        let failed = views.draw(RenderSettings::new(52, 38), |_, _| Err("no image"));
        assert_eq!(failed.err(), Some("no image"));
    }

    #[test]
    fn points_of_a_window_are_seen_through_the_view_there() {
        let (panes, window, views) = four();
        let whole = Area { min: [0, 0], size: window };
        assert_eq!(views.at_distance(DVec2::new(5.0, 20.0), whole, 1.0), None, "the panel shows nothing");
        for (pane, (camera, area)) in panes.iter().zip(&views.parts) {
            assert_eq!(pane.area, *area);
            let middle = area.origin() + area.size.size() / 2.0;
            let expected = camera.position + camera.orientation * DVec3::NEG_Z * 2.5;
            let found = views.at_distance(middle, whole, 2.5).expect("it is in the view");
            assert!(found.distance(expected) < 1e-6, "{:?}: {found}, not {expected}", pane.side);
        }
        let alone = Views::from(views.main);
        assert_eq!((alone.count(), alone.is_one()), (1, true));
        let part = Area { min: [10, 6], size: window };
        let middle = part.origin() + window.size() / 2.0;
        let found = alone.at_distance(middle, part, 2.5).expect("it is the middle");
        let expected = views.main.position + views.main.orientation * DVec3::NEG_Z * 2.5;
        assert!(found.distance(expected) < 1e-6, "{found}, not {expected}");
    }

    proptest! {
        /// Whatever a panel leaves, also beside the window.
        #[test]
        fn views_lie_in_the_window_and_apart(
            min in prop::array::uniform2(0u32..300), size in prop::array::uniform2(0u32..300),
            image in prop::array::uniform2(1u32..250)
        ) {
            let window = Viewport { width: 200, height: 100 };
            let image = Viewport { width: image[0], height: image[1] };
            let area = Area { min, size: Viewport { width: size[0], height: size[1] } };
            let mut taken = vec![false; (image.width * image.height) as usize];
            for pane in panes(Orbit::new(DVec3::Y), area.within(window), true) {
                let Area { min, size } = pane.area.scaled(window, image);
                prop_assert!(min[0] + size.width <= image.width && min[1] + size.height <= image.height);
                for y in min[1]..min[1] + size.height {
                    for x in min[0]..min[0] + size.width {
                        let pixel = &mut taken[(y * image.width + x) as usize];
                        prop_assert!(!std::mem::replace(pixel, true), "({x}, {y}) is in two");
                    }
                }
            }
        }
    }
}
