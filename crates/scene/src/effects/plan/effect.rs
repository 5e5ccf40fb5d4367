//! The effects that a picture can have, by name.

use std::fmt;

/// Something that a picture shows only if its scene calls for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Effect {
    /// Lamps: directional, point and spot lights.
    Lamps,
    /// Light from everywhere alike.
    AmbientLight,
    /// Highlights of Blinn-Phong and metallic-roughness surfaces.
    Highlights,
    /// Textures of base colours, highlights and emission; and the coordinates that
    /// any texture is looked up at.
    Textures,
    /// Normals that are bent by textures.
    NormalMaps,
    /// Ambient light that textures take away.
    OcclusionMaps,
    /// Light that surfaces send out.
    Emission,
    /// Colours of the meshes' corners.
    VertexColors,
    /// Surfaces with holes.
    Masks,
    /// Surfaces that let what is behind shine through.
    Transparency,
    /// Meshes that follow joints or move towards other shapes.
    Poses,
    /// Ambient light from a sky or a picture of one.
    Environment,
    /// The built-in sky in metals, where nothing says what is around them.
    MetalSky,
    /// Shadows by maps of depth.
    ShadowMaps,
    /// Shadows by rays.
    ShadowRays,
    /// Ambient light that the surroundings keep away, by rays.
    AmbientOcclusion,
    /// What metals without roughness mirror, by rays.
    Reflection,
    /// What is seen through transmissive surfaces, by rays.
    Refraction,
    /// Mist.
    Fog,
    /// Exposure and tone mapping.
    ToneMapping,
    /// A line around nodes.
    Outline,
    /// Edges of polygons.
    Edges,
}

impl Effect {
    /// All of them, in the order in which a plan lists them.
    pub const ALL: [Self; 22] = [
        Self::Lamps,
        Self::AmbientLight,
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
        Self::MetalSky,
        Self::ShadowMaps,
        Self::ShadowRays,
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
            Self::MetalSky => "sky in metals",
            Self::ShadowMaps => "shadow maps",
            Self::ShadowRays => "shadow rays",
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
