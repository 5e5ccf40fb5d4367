//! Reflection models: the material's own, or another one for comparison.

use crate::material::{Material, MetallicRoughness, Shading};
use crate::settings::Reflection;

/// The reflectance of a dielectric at normal incidence: ((n − 1) / (n + 1))².
pub(super) fn f0(ior: f32) -> f32 {
    let root = (ior - 1.0) / (ior + 1.0);
    root * root
}

impl Reflection {
    /// The shading model that replaces a material's own.
    pub(crate) fn of(self, material: &Material) -> Shading {
        let shading = material.shading;
        match self {
            _ if shading == Shading::Unlit => shading,
            Self::Material => shading,
            Self::Lambert => Shading::Lambert,
            Self::BlinnPhong => blinn_phong(material),
            Self::MetallicRoughness => Shading::MetallicRoughness(metallic_roughness(&shading)),
        }
    }
}

/// The exponent for which Blinn's highlight is as wide as that of GGX with this roughness: 2 / α² − 2 (B.
/// Walter et al. 2007, section 5.2, for Beckmann's, which is close to it).
fn blinn_phong(material: &Material) -> Shading {
    /// Above it, highlights are smaller than a pixel.
    const SHARPEST: f32 = 2000.0;
    match material.shading {
        Shading::MetallicRoughness(model) => {
            let square = model.roughness * model.roughness * model.roughness * model.roughness;
            let exponent = 2.0 / square - 2.0;
            let shininess = if exponent < SHARPEST { exponent } else { SHARPEST };
            let dielectric = f0(material.ior) * model.specular_color * model.specular;
            let reflected = dielectric.lerp(material.base_color.truncate(), model.metallic);
            // (n + 8) / 8 normalizes the highlight, so that its total light does not depend on the exponent.
            Shading::blinn_phong(reflected * ((shininess + 8.0) / 8.0), shininess)
        }
        Shading::BlinnPhong { .. } => material.shading,
        Shading::Unlit | Shading::Lambert => Material::default().shading,
    }
}

fn metallic_roughness(shading: &Shading) -> MetallicRoughness {
    match shading {
        Shading::MetallicRoughness(model) => *model,
        Shading::BlinnPhong { shininess, .. } => {
            let square = (2.0 / (shininess + 2.0)).sqrt();
            MetallicRoughness { roughness: square.sqrt(), ..MetallicRoughness::default() }
        }
        Shading::Unlit | Shading::Lambert => MetallicRoughness::default(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use trigon_math::Vec3;

    fn rough(model: MetallicRoughness, base_color: Vec3) -> Material {
        let shading = Shading::MetallicRoughness(model);
        Material { base_color: base_color.extend(1.0), ior: 1.5, shading, ..Material::default() }
    }

    fn highlight(material: &Material) -> (Vec3, f32) {
        match Reflection::BlinnPhong.of(material) {
            Shading::BlinnPhong { specular, shininess, .. } => (specular, shininess),
            other => panic!("{other:?} is not by Blinn and Phong"),
        }
    }

    /// α is the square of the roughness, the exponent 2 / α² − 2.
    #[test]
    fn highlights_are_as_wide_as_those_of_microfacets() {
        let base_color = Vec3::new(0.5, 0.25, 0.125);
        let plastic = MetallicRoughness { metallic: 0.0, ..MetallicRoughness::default() };
        for (roughness, exponent) in [(0.5, 30.0), (1.0, 0.0), (0.75, 4.32098), (0.01, 2000.0)] {
            let model = MetallicRoughness { roughness, ..plastic };
            let (specular, shininess) = highlight(&rough(model, base_color));
            assert!((shininess - exponent).abs() < 1e-3, "{shininess} of {roughness}");
            // Glass reflects 4 % head-on.
            let expected = Vec3::splat(0.04 * (exponent + 8.0) / 8.0);
            assert!((specular - expected).abs().max_element() < 1e-4, "{specular} of {roughness}");
            let metal = MetallicRoughness { roughness, metallic: 1.0, ..plastic };
            let (specular, _) = highlight(&rough(metal, base_color));
            let expected = base_color * ((exponent + 8.0) / 8.0);
            assert!((specular / expected - Vec3::ONE).abs().max_element() < 1e-4, "{specular} of metal");
        }
    }

    #[test]
    fn a_model_keeps_the_width_of_a_highlight() {
        for shininess in [0.5, 3.0, 30.0, 900.0] {
            let glossy =
                Material { shading: Shading::blinn_phong(Vec3::ONE, shininess), ..Material::default() };
            assert_eq!(Reflection::BlinnPhong.of(&glossy), glossy.shading, "its own");
            let Shading::MetallicRoughness(model) = Reflection::MetallicRoughness.of(&glossy) else {
                panic!("another model");
            };
            let (_, found) = highlight(&rough(model, Vec3::ONE));
            assert!((found / shininess - 1.0).abs() < 1e-3, "{found} of {shininess}");
        }
    }

    #[test]
    fn what_has_no_highlight_gets_the_usual_one() {
        let lambert = Material { shading: Shading::Lambert, ..Material::default() };
        assert_eq!(Reflection::BlinnPhong.of(&lambert), Material::default().shading);
        let usual = Shading::MetallicRoughness(MetallicRoughness::default());
        assert_eq!(Reflection::MetallicRoughness.of(&lambert), usual);
        let unlit = Material { shading: Shading::Unlit, ..Material::default() };
        for reflection in
            [Reflection::Material, Reflection::Lambert, Reflection::BlinnPhong, Reflection::MetallicRoughness]
        {
            assert_eq!(reflection.of(&unlit), Shading::Unlit, "what has no light stays so");
        }
        assert_eq!(Reflection::Material.of(&lambert), Shading::Lambert);
        assert_eq!(Reflection::Lambert.of(&Material::default()), Shading::Lambert);
    }
}
