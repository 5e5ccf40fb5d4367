//! Which faces cover and win which pixels' centres, one sample for each pixel.

use trigon_window::scene::math::DVec2;

use super::lens::{Answer, Lens, Triangle};
use super::oracle::Key;

/// What the rasterizer moves corners by, in pixels: half a step of its grid in x and in y.
const SNAPPING: f64 = 0.003;
/// Depths of f32 are equal if nearer than that, as a share.
const SAME_DEPTH: f64 = 1e-5;

/// A face at a pixel.
pub(super) struct AtPixel {
    /// The pixel's centre.
    pub(super) at: DVec2,
    pub(super) face: Key,
    pub(super) wins: Answer,
    pub(super) covers: Answer,
}

/// A triangle at a pixel.
struct Met {
    pixel: usize,
    at: DVec2,
    face: Key,
    covers: Answer,
    /// Infinite where it is not drawn.
    distance: f64,
}

/// All faces at all pixels.
pub(super) fn at_pixels(lens: &Lens, triangles: &[Triangle]) -> Vec<AtPixel> {
    let [width, height] = lens.size.to_array().map(|side| side as usize);
    let mut nearest = vec![f64::INFINITY; width * height];
    let mut met: Vec<Met> = Vec::new();
    for triangle in triangles {
        let [min, max] = triangle.bounds();
        let [left, top] = (min - 1.0).max(DVec2::ZERO).to_array().map(|side| side as usize);
        let [right, bottom] = (max + 1.0).max(DVec2::ZERO).to_array().map(|side| side as usize);
        for y in top..bottom.min(height) {
            for x in left..right.min(width) {
                let (pixel, at) = (y * width + x, DVec2::new(x as f64 + 0.5, y as f64 + 0.5));
                let covers = Answer::of(triangle.depth_within(at), SNAPPING);
                if covers == Answer::No {
                    continue;
                }
                let distance = if triangle.is_drawn { triangle.distance(lens, at) } else { f64::INFINITY };
                if covers == Answer::Yes {
                    nearest[pixel] = nearest[pixel].min(distance);
                }
                met.push(Met { pixel, at, face: triangle.face, covers, distance });
            }
        }
    }
    met.sort_unstable_by_key(|met| (met.pixel, met.face));
    met.chunk_by(|a, b| a.pixel == b.pixel).flat_map(|all| faces_of(all, nearest[all[0].pixel])).collect()
}

/// The faces at one pixel. It is open who wins where several may.
fn faces_of(all: &[Met], nearest: f64) -> Vec<AtPixel> {
    let limit = nearest * (1.0 + SAME_DEPTH);
    let may_win = |met: &&Met| met.distance.is_finite() && met.distance <= limit;
    let mut rivals: Vec<Key> = all.iter().filter(may_win).map(|met| met.face).collect();
    rivals.dedup();
    let most = if rivals.len() > 1 { Answer::Open } else { Answer::Yes };
    let of_face = |own: &[Met]| {
        let best = own.iter().filter(may_win).map(|met| met.covers).max().unwrap_or(Answer::No);
        let covers = own.iter().map(|met| met.covers).max().unwrap_or(Answer::No);
        AtPixel { at: own[0].at, face: own[0].face, wins: best.min(most), covers }
    };
    all.chunk_by(|a, b| a.face == b.face).map(of_face).collect()
}
