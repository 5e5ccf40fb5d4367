//! The default lights, for scenes without any.

use trigon_math::Vec3;

use super::{Lamp, Lights};

impl Lights {
    /// A key light from the upper left, a weaker fill from the right, a rim light from behind, and a little
    /// ambient light. All of them move with the camera, so that no side of a model is ever dark.
    ///
    /// They are as bright as a display can show: a white plate that faces the camera shows at least 235 of
    /// 255, and no white diffuse surface is clipped, at any orientation. The darkest side of a white ball has
    /// a fifth of the light of the brightest.
    pub(crate) fn studio() -> Self {
        let key = Lamp::studio(Vec3::new(-0.5, 0.55, 0.75), 0.72);
        let fill = Lamp::studio(Vec3::new(0.75, -0.1, 0.65), 0.25);
        let rim = Lamp::studio(Vec3::new(0.25, 0.75, -0.6), 0.25);
        Self { ambient: Vec3::splat(0.2), lamps: vec![key, fill, rim], ..Self::default() }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::lighting::LampSource;

    /// Over all normals n, the sum of max(0, n · v) over some vectors v is largest where n
    /// points along the sum of some of them: it is the length of the longest such sum.
    fn brightest(lights: &Lights) -> f32 {
        let lamps: Vec<Vec3> = lights.lamps.iter().map(towards).collect();
        let longest = (0..1_u32 << lamps.len()).map(|subset| {
            let chosen = lamps.iter().zip(0..).filter(|(_, bit)| subset >> bit & 1 == 1);
            chosen.map(|(lamp, _)| *lamp).sum::<Vec3>().length()
        });
        lights.ambient.max_element() + longest.fold(0.0, f32::max)
    }

    /// The length is the lamp's brightness.
    fn towards(lamp: &Lamp) -> Vec3 {
        let LampSource::Directional(towards) = lamp.source else {
            panic!("lamps of the studio are parallel")
        };
        towards * lamp.radiance
    }

    #[test]
    fn white_is_bright_and_never_clipped() {
        let studio = Lights::studio();
        let brightest = brightest(&studio);
        assert!(brightest <= 1.0, "no diffuse surface is clipped: {brightest}");
        let facing = studio.ambient.x + studio.lamps.iter().map(|lamp| towards(lamp).z.max(0.0)).sum::<f32>();
        let shown = trigon_math::color::linear_to_srgb8(facing);
        assert!(shown >= 235, "a plate that faces the camera: {shown}");
        assert!(studio.ambient.x < 0.25 * brightest, "shapes can be told by their shade");
    }
}
