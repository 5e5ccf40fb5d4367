//! What does each effect cost? One setting at a time, against the truth of the whole image.

use super::frames::sweep::{ImageCost, image_costs};
use super::frames::{RMSE, TIME};
use super::*;
use crate::frames::{FrameCase, Repeated};
use crate::truth::Truth;
use trigon_scene::quality::{Preset, Quality};
use trigon_scene::{Filter, MipFilter, RaySampling, Sampler, Shadows};

/// The tables, as the page of frontiers shows them.
pub(in crate::report) const SHADOWS: &str = "shadows of knots";
pub(in crate::report) const OCCLUSION: &str = "ambient occlusion in a corner";
pub(in crate::report) const TEXTURES: &str = "textures of a passage";

/// A setting of an effect.
struct EffectSetting {
    name: String,
    quality: Quality,
    sampler: Sampler,
}

impl EffectSetting {
    fn new(name: impl Into<String>, quality: Quality) -> Self {
        Self { name: name.into(), quality, sampler: Sampler::default() }
    }
}

pub(super) fn measure(effort: Effort) -> Chapter {
    let size = effort.pick([120, 72], [480, 288]);
    let tables = [
        (SHADOWS, FrameCase::Shadows, shadows()),
        (OCCLUSION, FrameCase::Corner, occlusion()),
        (TEXTURES, FrameCase::Passage, textures()),
    ];
    let rows = tables.iter().flat_map(|(table, case, ways)| {
        let truth = case.truth(size, &crate::truth::folder());
        table_rows(table, *case, &truth, ways, effort)
    });
    let rows: Vec<Row> = rows.collect();
    let plots = [("shadows", SHADOWS), ("occlusion", OCCLUSION), ("textures", TEXTURES)];
    Chapter {
        name: "effects",
        title: "What does each effect cost?",
        text: "Whole images on all threads, against their truth. Shadows are of maps with so many texels a side, and of rays. Rays of \
               ambient occlusion start at every sample, or those of a small image are shared. Textures are looked up through each \
               filter, at several numbers of samples.",
        findings: Vec::new(),
        plots: plots.map(|(name, case)| Plot::trade(name, &rows, case, [TIME, RMSE])).into(),
        images: Vec::new(),
        rows,
    }
}

fn shadows() -> Vec<EffectSetting> {
    let at = |axis: u32| {
        let quality = Quality { samples_per_axis: axis, ..Preset::Standard.quality() };
        let maps = [512, 1024, 2048, 4096].map(|resolution| {
            let shadows = Shadows::Maps { resolution };
            EffectSetting::new(format!("{axis}×{axis}, maps of {resolution}"), Quality { shadows, ..quality })
        });
        let rays = Quality { shadows: Shadows::Rays, ..quality };
        maps.into_iter().chain([EffectSetting::new(format!("{axis}×{axis}, rays"), rays)])
    };
    [2, 4].into_iter().flat_map(at).collect()
}

fn occlusion() -> Vec<EffectSetting> {
    let standard = Preset::Standard.quality();
    let with =
        |occlusion_rays: u32, occlusion_sampling| Quality { occlusion_rays, occlusion_sampling, ..standard };
    let shared = [16, 64, 256]
        .map(|rays| EffectSetting::new(format!("{rays} shared rays"), with(rays, RaySampling::Shared)));
    let full = [1, 4, 16, 64].map(|rays| {
        EffectSetting::new(
            if rays == 1 { "1 ray a sample".to_owned() } else { format!("{rays} rays a sample") },
            with(rays, RaySampling::Full),
        )
    });
    shared.into_iter().chain(full).collect()
}

fn textures() -> Vec<EffectSetting> {
    let nearest = Sampler {
        magnification: Filter::Nearest,
        minification: Filter::Nearest,
        mip: MipFilter::None,
        ..Sampler::default()
    };
    let mip = |mip| Sampler { mip, ..Sampler::default() };
    let filters = [
        ("nearest texel", nearest),
        ("bilinear", mip(MipFilter::None)),
        ("trilinear", Sampler::default()),
        ("anisotropic 4", mip(MipFilter::Anisotropic(4))),
        ("anisotropic 16", mip(MipFilter::Anisotropic(16))),
    ];
    let at = |axis: u32| {
        let quality = Quality { samples_per_axis: axis, ..Preset::Standard.quality() };
        filters.map(|(name, sampler)| EffectSetting {
            name: format!("{axis}×{axis}, {name}"),
            quality,
            sampler,
        })
    };
    [1, 2, 4].into_iter().flat_map(at).collect()
}

fn table_rows(
    table: &str,
    case: FrameCase,
    truth: &Truth,
    ways: &[EffectSetting],
    effort: Effort,
) -> Vec<Row> {
    let size = truth.size();
    let scene = case.scene();
    let costs = image_costs(truth, effort.rounds().div_ceil(2), ways.len(), &|number| {
        let EffectSetting { quality, sampler, .. } = ways[number];
        Repeated::of(case, scene.clone(), size, quality).with_sampler(sampler)
    });
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let row = |(way, cost): (&EffectSetting, ImageCost)| {
        let row = Row::new(table, way.name.clone()).of(case.name()).sized(size.map(|side| side as usize));
        cost.on(row.with_threads(threads))
    };
    ways.iter().zip(costs).map(row).collect()
}

pub(super) fn headlines() -> Vec<Headline> {
    let of = |table: &str, ways: [&str; 2]| Headline::within(table, ways, [TIME, RMSE]);
    vec![
        of(SHADOWS, ["4×4, rays", "4×4, maps of 2048"]),
        of(OCCLUSION, ["16 rays a sample", "64 shared rays"]),
        of(TEXTURES, ["1×1, anisotropic 16", "1×1, trilinear"]),
    ]
}
