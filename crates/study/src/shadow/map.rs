//! Shadow maps (L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978): the map stores the
//! depth nearest to the light. Filtering is percentage-closer (W. T. Reeves, D. H. Salesin and R. L. Cook,
//! "Rendering antialiased shadows with depth maps", SIGGRAPH 1987): results of comparisons are averaged, not
//! depths.

use super::MapFilter;
use super::ball_on_floor::{BALL, LIGHT, across, on_floor, triangles};
use trigon_classic::{Edges, Field, weighted};
use trigon_math::DVec3;

/// The distance of the nearest triangle from the light's plane through the origin, by texel; minus
/// infinity where there is none.
pub struct ShadowMap {
    texels: Field<f32>,
}

/// The map reaches so far from the ball's middle: just round it.
const REACH: f64 = 1.05;

impl ShadowMap {
    /// As a light sees the ball, with a square of texels round it: its triangles, drawn with a
    /// z-buffer.
    #[must_use]
    pub fn new(side: usize) -> Self {
        let mut texels = Field::new([side; 2], f32::NEG_INFINITY);
        let across = across();
        let place = |corner: DVec3| {
            across.map(|axis| {
                let texel = ((corner - BALL).dot(axis) / REACH + 1.0) / 2.0 * side as f64;
                (texel * 256.0).round() as i64
            })
        };
        for triangle in triangles() {
            let Some(edges) = Edges::new(triangle.map(place), 256) else { continue };
            let depths = edges.shares(triangle.map(|corner| corner.dot(LIGHT)));
            edges.each_covered(&edges.bounding_box([side as i32; 2]), |[x, y], weights| {
                let nearest = &mut texels[[x as usize, y as usize]];
                let depth = weighted(&depths, weights) as f32;
                if depth > *nearest {
                    *nearest = depth;
                }
            });
        }
        Self { texels }
    }

    /// The share of light that a point of the floor gets.
    #[must_use]
    pub fn light(&self, point: [f64; 2], filter: MapFilter) -> f64 {
        let point = on_floor(point);
        let side = self.texels.size()[0] as f64;
        // In texels, whole numbers at their centres.
        let [u, v] = across().map(|axis| ((point - BALL).dot(axis) / REACH + 1.0) / 2.0 * side - 0.5);
        match filter {
            MapFilter::Nearest => self.is_lit([u.round(), v.round()], point),
            MapFilter::Linear => {
                let [left, top] = [u.floor(), v.floor()];
                let (x, y) = (u - left, v - top);
                let corner = |dx: f64, dy: f64| self.is_lit([left + dx, top + dy], point);
                let [above, below] = [0.0, 1.0].map(|dy| corner(0.0, dy) * (1.0 - x) + corner(1.0, dy) * x);
                above * (1.0 - y) + below * y
            }
        }
    }

    /// 1 unless the texel holds something nearer to the light. The floor lies far enough
    /// from the ball for no bias to be needed.
    fn is_lit(&self, texel: [f64; 2], point: DVec3) -> f64 {
        let nearest = self.texels.get(texel.map(|part| part as i32));
        let is_hidden = nearest.is_some_and(|&depth| f64::from(depth) > point.dot(LIGHT));
        if is_hidden { 0.0 } else { 1.0 }
    }
}
