//! Maps option names of F3D's library, which `-D`, configuration files and command scripts use, to
//! flags; and lists F3D flags that trigon lacks, with the reason.

use clap::CommandFactory;

use super::raw::RawArgs;

/// An option of F3D's library, and the flag that sets it.
const LIBRARY: [(&str, &str); 82] = [
    ("interactor.invert_zoom", "invert-zoom"),
    ("interactor.style", "interaction-style"),
    ("model.checkerboard.enable", "checkerboard"),
    ("model.color.opacity", "opacity"),
    ("model.color.rgb", "color"),
    ("model.color.texture", "texture-base-color"),
    ("model.emissive.factor", "emissive-factor"),
    ("model.emissive.texture", "texture-emissive"),
    ("model.matcap.texture", "texture-matcap"),
    ("model.material.base_ior", "base-ior"),
    ("model.material.metallic", "metallic"),
    ("model.material.roughness", "roughness"),
    ("model.material.texture", "texture-material"),
    ("model.normal.scale", "normal-scale"),
    ("model.normal.texture", "texture-normal"),
    ("model.normal_glyphs.enable", "normal-glyphs"),
    ("model.normal_glyphs.scale", "normal-glyphs-scale"),
    ("model.point_sprites.absolute_size", "point-sprites-absolute-size"),
    ("model.point_sprites.size", "point-sprites-size"),
    ("model.point_sprites.type", "point-sprites"),
    ("model.scivis.array_name", "coloring-array"),
    ("model.scivis.cells", "coloring-by-cells"),
    ("model.scivis.colormap", "colormap"),
    ("model.scivis.component", "coloring-component"),
    ("model.scivis.discretization", "colormap-discretization"),
    ("model.scivis.enable", "scalar-coloring"),
    ("model.scivis.range", "coloring-range"),
    ("model.textures_transform", "textures-transform"),
    ("model.unlit", "unlit"),
    ("model.volume.enable", "volume"),
    ("model.volume.inverse", "volume-inverse"),
    ("render.armature.enable", "armature"),
    ("render.axes_grid.enable", "axes-grid"),
    ("render.backface_type", "backface-type"),
    ("render.background.blur.coc", "blur-coc"),
    ("render.background.blur.enable", "blur-background"),
    ("render.background.color", "background-color"),
    ("render.background.skybox", "hdri-skybox"),
    ("render.effect.ambient_occlusion", "ambient-occlusion"),
    ("render.effect.antialiasing.mode", "anti-aliasing"),
    ("render.effect.blending.mode", "blending"),
    ("render.effect.display_depth", "display-depth"),
    ("render.effect.final_shader", "final-shader"),
    ("render.effect.tone_mapping", "tone-mapping"),
    ("render.grid.absolute", "grid-absolute"),
    ("render.grid.color", "grid-color"),
    ("render.grid.enable", "grid"),
    ("render.grid.reflection", "grid-reflection"),
    ("render.grid.subdivisions", "grid-subdivisions"),
    ("render.grid.unit", "grid-unit"),
    ("render.hdri.ambient", "hdri-ambient"),
    ("render.hdri.file", "hdri-file"),
    ("render.light.intensity", "light-intensity"),
    ("render.line_width", "line-width"),
    ("render.point_size", "point-size"),
    ("render.raytracing.denoise", "raytracing-denoise"),
    ("render.raytracing.enable", "raytracing"),
    ("render.raytracing.samples", "raytracing-samples"),
    ("render.show_edges", "edges"),
    ("scene.animation.autoplay", "animation-autoplay"),
    ("scene.animation.index", "animation-indices"),
    ("scene.animation.indices", "animation-indices"),
    ("scene.animation.speed_factor", "animation-speed-factor"),
    ("scene.camera.index", "camera-index"),
    ("scene.camera.orthographic", "camera-orthographic"),
    ("scene.force_reader", "force-reader"),
    ("scene.up.direction", "up"),
    ("scene.up_direction", "up"),
    ("ui.animation_progress", "animation-progress"),
    ("ui.axis", "axis"),
    ("ui.dpi_aware", "dpi-aware"),
    ("ui.filename", "filename"),
    ("ui.fps", "fps"),
    ("ui.hdri_filename", "hdri-filename"),
    ("ui.loader_progress", "loading-progress"),
    ("ui.metadata", "metadata"),
    ("ui.scene_hierarchy", "scene-hierarchy"),
    ("ui.notifications.enable", "notifications"),
    ("ui.scale", "font-scale"),
    ("ui.x_color", "x-color"),
    ("ui.y_color", "y-color"),
    ("ui.z_color", "z-color"),
];

/// F3D's flags that do nothing here that they could do, by their long and short names.
const REFUSED: [(&str, &str, &str); 22] = [
    (
        "axes-grid",
        "",
        "there is no labelled grid around the model; --grid shows one below it, and --metadata its size",
    ),
    ("backdrop-color", "", "text has its own backdrop, which cannot be changed"),
    ("backdrop-opacity", "", "text has its own backdrop, which cannot be changed"),
    ("blur-background", "u", "the background cannot be blurred; use a blurred image"),
    ("blur-coc", "", "the background cannot be blurred; use a blurred image"),
    ("coloring-array", "", NO_ARRAYS),
    ("coloring-by-cells", "c", NO_ARRAYS),
    ("coloring-component", "y", NO_ARRAYS),
    ("coloring-range", "", NO_ARRAYS),
    ("coloring-scalar-bar", "b", NO_ARRAYS),
    ("colormap", "", NO_ARRAYS),
    ("colormap-discretization", "", NO_ARRAYS),
    ("colormap-file", "", NO_ARRAYS),
    ("final-shader", "", "there is no GPU to run a shader; change the written image instead"),
    ("font-color", "", "the colour of text follows its backdrop"),
    ("font-file", "", "text has its own font"),
    ("grid-reflection", "", "the grid is lines, which reflect nothing"),
    ("invert-zoom", "", "the wheel zooms in when it turns away from you, in every window"),
    ("position", "", "the window manager places the window"),
    ("save-statefile", "", NO_STATE),
    ("scalar-coloring", "s", NO_ARRAYS),
    ("texture-matcap", "", "there are no matcaps; --reflection and --hdri-file change how surfaces are lit"),
];

const NO_ARRAYS: &str =
    "simulation values are not shown as colours; vertex colours in a file are shown without this flag";

const NO_STATE: &str =
    "state files are saved in the window, with Ctrl+S; --statefile=FILE shows what one holds";

/// The flag for an option, by F3D's name for it in its library or on the command line.
///
/// # Errors
/// There is none; with the reason if it is an F3D option.
pub(crate) fn flag(name: &str) -> Result<&str, String> {
    let name = name.trim();
    let flag = LIBRARY.iter().find(|(library, _)| *library == name).map_or(name, |&(_, flag)| flag);
    if let Some(reason) = refusal(flag) {
        return Err(format!("{name}: {reason}"));
    }
    if !is_flag(flag) {
        return Err(format!(
            "{name:?} is not an option; use the name of a flag without its dashes, or F3D's library's"
        ));
    }
    Ok(flag)
}

/// Whether a flag of this name exists.
fn is_flag(name: &str) -> bool {
    RawArgs::command().get_arguments().any(|argument| {
        let aliases = argument.get_all_aliases().unwrap_or_default();
        argument.get_long() == Some(name) || aliases.contains(&name)
    })
}

/// The word that gives an option a value.
///
/// # Errors
/// There is no such option.
pub(crate) fn set(name: &str, value: &str) -> Result<Vec<String>, String> {
    Ok(vec![format!("--{}={}", flag(name)?, value.trim())])
}

/// Why trigon lacks this F3D flag, by its long or short name without dashes.
pub(crate) fn refusal(flag: &str) -> Option<&'static str> {
    let found =
        REFUSED.iter().find(|(long, short, _)| *long == flag || (!short.is_empty() && *short == flag));
    found.map(|&(_, _, reason)| reason)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_leads_to_a_flag_or_a_reason() {
        let command = RawArgs::command();
        for (name, flag) in LIBRARY {
            assert!(is_flag(flag) != refusal(flag).is_some(), "{name} is --{flag}");
        }
        for (flag, short, _) in REFUSED {
            assert!(!is_flag(flag), "--{flag} is there");
            let taken = command.get_arguments().any(|argument| argument.get_short() == short.chars().next());
            assert!(short.is_empty() || !taken, "-{short} is there");
        }
    }

    #[test]
    fn mistakes_say_why() {
        assert!(set("model.matcap.texture", "a.png").expect_err("no").contains("matcap"), "a reason");
        assert!(flag("render.nothing").expect_err("no").contains("is not an option"), "unknown");
        assert_eq!(set("grid", " true "), Ok(vec!["--grid=true".to_owned()]), "as on the command line");
    }
}
