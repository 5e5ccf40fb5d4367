//! L. Williams, "Casting curved shadows on curved surfaces", SIGGRAPH 1978: what the light
//! sees nearest is kept in a map. Filtered as in W. T. Reeves, D. H. Salesin and R. L. Cook,
//! "Rendering antialiased shadows with depth maps", SIGGRAPH 1987: answers are averaged,
//! not depths.

use super::MapFilter;
use super::stage::{BALL, LIGHT, across, on_floor};
use crate::field::Field;
use trigon_math::DVec3;

/// The distance of the ball from the light's plane through the origin, by texel; no number
/// where it is not.
pub struct ShadowMap {
    texels: Field<f32>,
}

/// The map reaches so far from the ball's middle: just round it.
const REACH: f64 = 1.05;

impl ShadowMap {
    /// As a light sees the ball, with a square of texels round it.
    pub fn new(side: usize) -> Self {
        let texel = |place: [usize; 2]| {
            let [u, v] = place.map(|part| ((part as f64 + 0.5) / side as f64 * 2.0 - 1.0) * REACH);
            let height = 1.0 - u * u - v * v;
            if height > 0.0 { (BALL.dot(LIGHT) + height.sqrt()) as f32 } else { f32::NAN }
        };
        Self { texels: Field::from_fn([side; 2], texel) }
    }

    /// The share of light that a point of the floor gets.
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
