//! The effects that a frame can have, by name.

use std::fmt;

/// Something that a frame shows only if its scene needs it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Lamps: directional, point and spot lights.
    Lamps,
    /// Ambient light.
    AmbientLight,
    /// Lamps exposed by a light meter.
    LightMeter,
    /// Highlights of Blinn-Phong and metallic-roughness surfaces.
    Highlights,
    /// Textures of base colours, highlights and emission, and the coordinates of all textures.
    Textures,
    /// Normal maps.
    NormalMaps,
    /// Occlusion maps.
    OcclusionMaps,
    /// Emitted light.
    Emission,
    /// Vertex colours.
    VertexColors,
    /// Alpha masks.
    Masks,
    /// Blended surfaces.
    Transparency,
    /// Skins and morph targets.
    Poses,
    /// Ambient light from a sky or an environment image.
    Environment,
    /// The built-in studio in metals, if their surroundings are not defined.
    MetalStudio,
    /// Shadows by depth maps.
    ShadowMaps,
    /// Shadows by rays.
    ShadowRays,
    /// Soft edges of the shadows of lamps with an extent.
    SoftShadows,
    /// Ambient occlusion by rays.
    AmbientOcclusion,
    /// Reflections in metals without roughness, by rays.
    Reflection,
    /// Refractions through transmissive surfaces, by rays.
    Refraction,
    /// Mist.
    Fog,
    /// Exposure and tone mapping.
    ToneMapping,
    /// Outlines around nodes.
    Outline,
    /// Edges of polygons.
    Edges,
}

impl Effect {
    /// All of them, in the order in which a plan lists them.
    pub const ALL: [Self; 24] = [
        Self::Lamps,
        Self::AmbientLight,
        Self::LightMeter,
        Self::Highlights,
        Self::Textures,
        Self::NormalMaps,
        Self::OcclusionMaps,
        Self::Emission,
        Self::VertexColors,
        Self::Masks,
        Self::Transparency,
        Self::Poses,
        Self::Environment,
        Self::MetalStudio,
        Self::ShadowMaps,
        Self::ShadowRays,
        Self::SoftShadows,
        Self::AmbientOcclusion,
        Self::Reflection,
        Self::Refraction,
        Self::Fog,
        Self::ToneMapping,
        Self::Outline,
        Self::Edges,
    ];
}

impl fmt::Display for Effect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Lamps => "lamps",
            Self::AmbientLight => "ambient light",
            Self::LightMeter => "light meter",
            Self::Highlights => "highlights",
            Self::Textures => "textures",
            Self::NormalMaps => "normal maps",
            Self::OcclusionMaps => "occlusion maps",
            Self::Emission => "emission",
            Self::VertexColors => "vertex colours",
            Self::Masks => "masks",
            Self::Transparency => "transparency",
            Self::Poses => "poses",
            Self::Environment => "environment",
            Self::MetalStudio => "studio in metals",
            Self::ShadowMaps => "shadow maps",
            Self::ShadowRays => "shadow rays",
            Self::SoftShadows => "soft shadows",
            Self::AmbientOcclusion => "ambient occlusion",
            Self::Reflection => "mirror reflection",
            Self::Refraction => "refraction",
            Self::Fog => "fog",
            Self::ToneMapping => "tone mapping",
            Self::Outline => "outline",
            Self::Edges => "edges",
        })
    }
}
