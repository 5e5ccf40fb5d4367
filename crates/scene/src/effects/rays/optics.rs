//! Surfaces from which sight rays continue: mirrors and glass.

use trigon_math::{Vec3, elementary};

use crate::material::{Material, Shading};

/// Surfaces from which sight rays continue.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Optics {
    /// A metal without roughness.
    Mirror,
    /// A transmissive surface.
    Glass(Glass),
}

/// A transmissive surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Glass {
    /// The transmitted fraction.
    pub(crate) transmission: f32,
    /// Index of refraction.
    pub(crate) ior: f32,
    /// What is beneath the surface; `None` if it is thin.
    pub(crate) volume: Option<Volume>,
}

/// What is beneath a transmissive surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Volume {
    /// The natural logarithm of the fraction of light that is left after a metre, negated.
    pub(crate) absorption: Vec3,
    /// In metres.
    pub(crate) thickness: f32,
    /// Whether the surface encloses it. A ray that enters through one with open edges would never
    /// leave it: such a surface stands for a plate with parallel faces.
    pub(crate) is_enclosed: bool,
}

/// A volume that a ray is in.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Medium {
    pub(crate) ior: f32,
    pub(crate) absorption: Vec3,
}

impl Optics {
    /// `None` for surfaces at which rays end. Whether a volume is enclosed depends on the mesh: here
    /// it is not.
    pub(crate) fn of(material: &Material) -> Option<Self> {
        let Shading::MetallicRoughness(model) = &material.shading else { return None };
        let is_metal = model.metallic == 1.0 && model.texture.is_none();
        if material.transmission > 0.0 && material.ior >= 1.0 && !is_metal {
            let Material { transmission, ior, .. } = *material;
            return Some(Self::Glass(Glass { transmission, ior, volume: Volume::of(material) }));
        }
        (model.metallic == 1.0 && model.roughness == 0.0).then_some(Self::Mirror)
    }

    /// Whether back faces matter that are not drawn: light leaves a volume through them.
    pub(crate) fn has_back(&self) -> bool {
        match self {
            Self::Mirror => false,
            Self::Glass(glass) => glass.medium().is_some(),
        }
    }

    /// The glass, if it is that.
    pub(crate) fn glass(&self) -> Option<&Glass> {
        match self {
            Self::Mirror => None,
            Self::Glass(glass) => Some(glass),
        }
    }
}

impl Glass {
    /// The medium beneath a surface that encloses one.
    pub(crate) fn medium(&self) -> Option<Medium> {
        let volume = self.volume.filter(|volume| volume.is_enclosed)?;
        Some(Medium { ior: self.ior, absorption: volume.absorption })
    }

    /// The plate that a surface with open edges stands for.
    pub(crate) fn plate(&self) -> Option<&Volume> {
        self.volume.as_ref().filter(|volume| !volume.is_enclosed)
    }
}

impl Volume {
    fn of(material: &Material) -> Option<Self> {
        /// Of a colour that lets nothing through: half a byte of white after a hundredth of the
        /// distance.
        const MOST: f32 = 624.0;
        if material.thickness.is_nan() || material.thickness <= 0.0 {
            return None;
        }
        let distance = material.attenuation_distance;
        let per_distance = material.attenuation_color.to_array().map(|left| match left {
            left if left >= 1.0 => 0.0,
            left if left > 0.0 => (-elementary::ln_f32(left)).min(MOST),
            _ => MOST,
        });
        let absorbs = distance > 0.0 && distance.is_finite();
        let absorption = if absorbs { Vec3::from(per_distance) / distance } else { Vec3::ZERO };
        let absorption = if absorption.is_finite() { absorption } else { Vec3::splat(f32::MAX) };
        Some(Self { absorption, thickness: material.thickness, is_enclosed: false })
    }

    /// The fraction of light that is left behind a plate, where `cosine` is that of the light
    /// before it and `share` the fraction of the thickness at this point.
    pub(crate) fn left_behind_plate(&self, ior: f32, cosine: f32, share: f32) -> Vec3 {
        let square = 1.0 - (1.0 - cosine * cosine) / (ior * ior);
        let inside = if square > 1e-6 { square.sqrt() } else { 1e-3 };
        left_after(self.absorption, self.thickness * share / inside)
    }
}

/// The fraction of light that is left after a distance in metres (A. Beer, 1852).
pub(crate) fn left_after(absorption: Vec3, distance: f32) -> Vec3 {
    if absorption == Vec3::ZERO {
        return Vec3::ONE;
    }
    let left = |absorption: f32| {
        let exponent = absorption * distance;
        if exponent > 0.0 { elementary::exp_f32(-exponent) } else { 1.0 }
    };
    Vec3::from(absorption.to_array().map(left))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::material::MetallicRoughness;

    fn volume(material: Material) -> Option<Volume> {
        let shading = Shading::MetallicRoughness(MetallicRoughness::default());
        Optics::of(&Material { transmission: 1.0, shading, ..material })?.glass()?.volume
    }

    /// The specification: after the attenuation distance white light has the attenuation colour,
    /// and after twice the distance its square.
    #[test]
    fn light_loses_its_colour_with_the_distance() {
        let attenuation_color = Vec3::new(0.25, 0.5, 1.0);
        let material =
            Material { thickness: 1.0, attenuation_distance: 0.3, attenuation_color, ..Material::default() };
        let absorption = volume(material).expect("a volume").absorption;
        for (times, expected) in
            [(0.0, Vec3::ONE), (1.0, attenuation_color), (2.0, attenuation_color * attenuation_color)]
        {
            let left = left_after(absorption, 0.3 * times);
            assert!((left - expected).abs().max_element() < 1e-6, "{left} after {times} distances");
        }
    }

    #[test]
    fn what_is_out_of_range_absorbs_nothing_or_everything() {
        let plain = Material { thickness: 1.0, attenuation_color: Vec3::splat(0.5), ..Material::default() };
        assert_eq!(volume(Material { thickness: 0.0, ..plain.clone() }), None, "thin");
        assert_eq!(volume(Material { thickness: f32::NAN, ..plain.clone() }), None, "no number");
        for attenuation_distance in [0.0, -1.0, f32::INFINITY, f32::NAN] {
            let found = volume(Material { attenuation_distance, ..plain.clone() }).expect("a volume");
            assert_eq!(found.absorption, Vec3::ZERO, "after {attenuation_distance} m");
        }
        let black = Material { attenuation_distance: 1e-38, attenuation_color: Vec3::ZERO, ..plain };
        let absorption = volume(black).expect("a volume").absorption;
        assert_eq!(left_after(absorption, 1.0), Vec3::ZERO, "nothing is left");
        assert_eq!(left_after(absorption, 0.0), Vec3::ONE, "of no distance all is");
    }

    /// Snell's law: at 60° in air a plate of index √3 is crossed at 30°.
    #[test]
    fn a_plate_is_longer_for_slanting_light() {
        let material = Material {
            thickness: 0.2,
            attenuation_distance: 1.0,
            attenuation_color: Vec3::splat(0.5),
            ..Material::default()
        };
        let plate = volume(material).expect("a volume");
        let expected = elementary::exp2(-0.2 / (3.0_f64.sqrt() / 2.0)) as f32;
        let left = plate.left_behind_plate(3.0_f32.sqrt(), 0.5, 1.0);
        assert!((left.x - expected).abs() < 1e-6, "{left}, not {expected}");
    }
}
