//! Alpha masks seen from far away: a fence whose bars are narrower than a pixel.

use proptest::prelude::*;
use trigon_camera::{Camera, Projection};
use trigon_math::DVec3;
use trigon_mesh::primitives;
use trigon_raster::Wrap;
use trigon_scene::{
    AlphaMode, Filter, Material, MipFilter, RenderSettings, Sampler, Scene, Texture, TextureFormat, render,
};

use super::flight::settings;
use crate::effort::cases;

/// Texels on a side of the fence, which is as many millimetres large.
const TEXELS: u32 = 64;

/// Which pixels show a fence of solid and open texels, each pixel as large as 2^`level` of them.
fn fence(is_solid: &[bool], level: u32, cutoff: f32, mip: MipFilter) -> Vec<bool> {
    let texels = is_solid.iter().map(|&solid| [255, 255, 255, if solid { 255 } else { 0 }]).collect();
    let texture = Texture::new(TEXELS, TEXELS, texels, TextureFormat::Srgb).expect("a size in range");
    let mut scene = Scene::new();
    let id = scene.add_texture("fence", texture);
    let mut material =
        Material { alpha_mode: AlphaMode::Mask { cutoff }, double_sided: true, ..Material::from_texture(id) };
    let binding = material.base_color_texture.as_mut().expect("just set");
    let wrap = Wrap::ClampToEdge;
    binding.sampler = Sampler {
        wrap_u: wrap,
        wrap_v: wrap,
        magnification: Filter::Nearest,
        minification: Filter::Linear,
        mip,
    };
    let size = TEXELS as f32 / 1000.0;
    scene.add_object("fence", primitives::plane(size, size), material);
    // From above, with the top of the texture at the top of the image.
    let projection = Projection::orthographic(size.into(), 0.1, 20.0).expect("in range");
    let camera = Camera::look_at(DVec3::Y, DVec3::ZERO, DVec3::NEG_Z).with_projection(projection);
    let pixels = TEXELS >> level;
    let settings = RenderSettings { ..settings([pixels; 2]) };
    let ids = render(&scene, &camera, &settings).expect("in range").object_ids.expect("asked for");
    ids.iter().map(|&id| id == 0).collect()
}

proptest! {
    #![proptest_config(cases(24))]

    /// A pixel shows the fence where so much of what it covers is solid as the cutoff says, from as near as a texel for a
    /// pixel to as far as the whole fence: counted in integers. A level holds bytes, so a hundredth is left open.
    #[test]
    fn a_pixel_of_a_fence_from_afar_is_there_if_enough_of_it_is_solid(
        density in 0.05_f64..0.95,
        seeds in prop::collection::vec(0.0_f64..1.0, (TEXELS * TEXELS) as usize),
        in_bars in any::<bool>(),
        cutoff in 0.05_f32..0.95,
        mip in prop::sample::select(vec![MipFilter::Nearest, MipFilter::Linear, MipFilter::Anisotropic(16)]),
    ) {
        let seed = |i: usize| seeds[if in_bars { i % TEXELS as usize } else { i }];
        let is_solid: Vec<bool> = (0..seeds.len()).map(|i| seed(i) < density).collect();
        for level in 0..=6 {
            let (side, pixels) = (1_usize << level, (TEXELS >> level) as usize);
            for (index, shown) in fence(&is_solid, level, cutoff, mip).into_iter().enumerate() {
                let (x, y) = (index % pixels * side, index / pixels * side);
                let texels = (y..y + side).flat_map(|y| (x..x + side).map(move |x| y * TEXELS as usize + x));
                let solid = texels.filter(|&texel| is_solid[texel]).count() as f64 / (side * side) as f64;
                if (solid - f64::from(cutoff)).abs() > 0.01 {
                    prop_assert_eq!(shown, solid > cutoff.into(), "{} of pixel {} at level {}", solid, index, level);
                }
            }
        }
    }
}
