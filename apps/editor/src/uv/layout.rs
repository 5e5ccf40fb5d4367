//! The outlines of faces over the image as an image of their own, to be painted over in another program.

use trigon_document::Document;
use trigon_document::mesh::math::DVec2;
use trigon_document::scene::Frame;

use super::picking::{meshes, uv};

/// Pixels along each side.
const SIZE: usize = 2048;

/// Of a line, in pixels.
const HALF_WIDTH: f64 = 0.75;

/// Black lines on a transparent ground: the visible faces of what is edited. `None` if that has no texture coordinates.
pub(crate) fn layout(document: &Document) -> Option<Frame> {
    let mut image: Option<Lines> = None;
    for (_, mesh) in meshes(document) {
        let image = image.get_or_insert_with(|| Lines { alpha: vec![0; SIZE * SIZE] });
        for face in mesh.faces().filter(|&face| !mesh.is_face_hidden(face)) {
            for corner in mesh.face_corners(face) {
                let ends = [corner, mesh.next_corner(corner)].map(|end| uv(mesh, end) * SIZE as f64);
                image.draw(ends);
            }
        }
    }
    image.map(Lines::into_frame)
}

/// How much lines cover of each pixel.
struct Lines {
    alpha: Vec<u8>,
}

impl Lines {
    /// Draws a line between two points in pixels: along its longer axis, the pixels around it on the other one.
    fn draw(&mut self, [from, to]: [DVec2; 2]) {
        let way = to - from;
        if !way.is_finite() {
            return;
        }
        let is_steep = way.y.abs() > way.x.abs();
        let turned = |point: DVec2| if is_steep { DVec2::new(point.y, point.x) } else { point };
        let (from, way) = (turned(from), turned(way));
        let slope = if way.x == 0.0 { 0.0 } else { way.y / way.x };
        let reach = HALF_WIDTH + 1.0;
        let within = |low: f64, high: f64| {
            let first = (low - reach).clamp(0.0, SIZE as f64) as usize;
            first..(high + reach).clamp(0.0, SIZE as f64) as usize
        };
        for x in within(from.x.min(from.x + way.x), from.x.max(from.x + way.x)) {
            let middle = from.y + slope * (x as f64 + 0.5 - from.x);
            for y in within(middle - reach, middle + reach) {
                let offset = DVec2::new(x as f64 + 0.5, y as f64 + 0.5) - from;
                let share = (offset.dot(way) / way.length_squared()).clamp(0.0, 1.0);
                let nearest = if share.is_nan() { DVec2::ZERO } else { way * share };
                let covered = (HALF_WIDTH + 0.5 - offset.distance(nearest)).clamp(0.0, 1.0);
                let at = if is_steep { x * SIZE + y } else { y * SIZE + x };
                self.alpha[at] = self.alpha[at].max((covered * 255.0).round() as u8);
            }
        }
    }

    fn into_frame(self) -> Frame {
        let color = self.alpha.iter().flat_map(|&alpha| [0, 0, 0, alpha]).collect();
        Frame { width: SIZE as u32, height: SIZE as u32, color, ..Frame::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn alpha(frame: &Frame, x: usize, y: usize) -> u8 {
        frame.color[4 * (y * SIZE + x) + 3]
    }

    /// A cube has the whole image on each face; scaled to a half, its outline is a square from the upper left corner.
    #[test]
    fn outlines_are_drawn_where_the_image_has_them() {
        let mut document = Document::default();
        assert!(layout(&document).is_none(), "nothing is edited");
        for command in [
            r#"{ "op": "add_object", "object": { "shape": "cube", "edge": 2 } }"#,
            r#"{ "op": "edit_objects" }"#,
            r#"{ "op": "select_all" }"#,
            r#"{ "op": "scale_uvs", "factors": [0.5, 0.5], "center": [0, 0] }"#,
        ] {
            document.run(serde_json::from_str(command).expect("a command")).expect("it can be done");
        }
        let image = layout(&document).expect("it has coordinates");
        let half = SIZE / 2;
        for along in [1, half / 3, half - 2] {
            for [x, y] in [[along, 0], [0, along], [along, half], [half, along]] {
                assert!(alpha(&image, x, y) > 100, "the outline at {x}, {y}: {}", alpha(&image, x, y));
            }
        }
        for [x, y] in [[half / 2, half / 3], [half + 3, half / 2], [SIZE - 1, SIZE - 1]] {
            assert_eq!(alpha(&image, x, y), 0, "nothing at {x}, {y}");
        }
    }

    #[test]
    fn lines_of_any_size_end_at_the_border() {
        let mut lines = Lines { alpha: vec![0; SIZE * SIZE] };
        let far = 1e30;
        for ends in [[[0.0, 0.0], [far, far]], [[f64::NAN, 0.0], [1.0, 1.0]], [[far, 5.0], [far, 6.0]]] {
            lines.draw(ends.map(DVec2::from_array));
        }
        lines.draw([DVec2::splat(100.5); 2]);
        assert_eq!(lines.alpha[100 * SIZE + 100], 255, "a point");
        assert_eq!(lines.alpha[110 * SIZE + 100], 0, "and nothing far from it");
    }
}
