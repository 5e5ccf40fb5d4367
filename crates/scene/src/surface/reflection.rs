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
