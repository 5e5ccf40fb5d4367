//! What an image is rendered from, how large, and how well.

use trigon_document::scene::quality::Preset;
use trigon_document::scene::{Background, Light, LightKind, Outputs, RenderSettings, Scene, Shadows};

/// The greatest width and height, in pixels: an image of this size takes about a gigabyte and a half of memory.
pub(crate) const LARGEST: u32 = 8192;

/// Usual widths and heights.
pub(crate) const SIZES: [(&str, [u32; 2]); 5] = [
    ("HD, 1280 × 720", [1280, 720]),
    ("Full HD, 1920 × 1080", [1920, 1080]),
    ("4K, 3840 × 2160", [3840, 2160]),
    ("Square, 1080 × 1080", [1080, 1080]),
    ("Portrait, 1080 × 1920", [1080, 1920]),
];

/// What an image is seen from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub(crate) enum RenderFrom {
    /// The active camera, or else the first of the scene.
    #[default]
    Camera,
    /// The 3D view.
    View,
}

/// How images are rendered. The choices stay until the editor is closed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct RenderChoices {
    pub(crate) from: RenderFrom,
    /// Pixels, 1 to [`LARGEST`].
    pub(crate) width: u32,
    /// Pixels, 1 to [`LARGEST`].
    pub(crate) height: u32,
    pub(crate) preset: Preset,
    /// Whether there is nothing behind the scene, instead of the grey of the view.
    pub(crate) is_transparent: bool,
}

impl Default for RenderChoices {
    fn default() -> Self {
        let preset = Preset::High;
        Self { from: RenderFrom::default(), width: 1920, height: 1080, preset, is_transparent: false }
    }
}

impl RenderChoices {
    /// How a scene is rendered: with its own lights and their shadows, or in the studio's light if it has none.
    pub(crate) fn settings(&self, scene: &Scene) -> RenderSettings {
        let within = |pixels: u32| pixels.clamp(1, LARGEST);
        let mut settings = RenderSettings::new(within(self.width), within(self.height));
        settings.outputs = Outputs { radiance: true, ..Outputs::default() };
        if self.is_transparent {
            settings.background = Background::Transparent;
        }
        if has_lamps(scene) {
            // The preset says how they are computed.
            settings.effects.shadows = Shadows::Rays;
        }
        self.preset.apply(&mut settings);
        settings
    }
}

/// Whether any light of a scene can cast shadows.
pub(crate) fn has_lamps(scene: &Scene) -> bool {
    let casts = |light: &Light| light.kind != LightKind::Ambient;
    scene.nodes().iter().any(|(_, node)| node.visible && node.light.as_deref().is_some_and(casts))
}

#[cfg(test)]
mod tests {
    use trigon_document::scene::Node;

    use super::*;

    #[test]
    fn each_preset_gives_its_samples_and_only_lamps_cast_shadows() {
        let (mut lit, mut ambient) = (Scene::new(), Scene::new());
        lit.add(Node::from_light(Light::point(1.0)));
        ambient.add(Node::from_light(Light::ambient(1.0)));
        for preset in Preset::ALL {
            let choices = RenderChoices { preset, ..RenderChoices::default() };
            let [with, without] = [&lit, &ambient].map(|scene| choices.settings(scene));
            assert_eq!(with.effects.shadows, preset.quality().shadows, "{preset}");
            assert_eq!(without.effects.shadows, Shadows::Off, "{preset} without a lamp");
            assert_eq!(with.samples_per_axis, preset.quality().samples_per_axis, "{preset}");
        }
        let odd =
            RenderChoices { width: 0, height: u32::MAX, is_transparent: true, ..RenderChoices::default() };
        let settings = odd.settings(&lit);
        assert_eq!([settings.width, settings.height], [1, LARGEST], "what can be drawn");
        assert_eq!(settings.background, Background::Transparent);
    }
}
