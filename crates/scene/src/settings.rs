//! What a picture is to hold and how it is drawn.

use std::num::NonZeroUsize;
use trigon_raster::FaceEdges;
use trigon_raster::simd::SimdLevel;

use trigon_math::{DVec3, Vec3};

use crate::background::Background;
use crate::display::Display;
use crate::effects::EffectSettings;
use crate::marks::{Marks, VertexPoints};

/// The largest width or height of a picture, in pixels.
pub const MAX_SIZE: u32 = 16384;

/// How surfaces and edges are shown.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Filled faces.
    #[default]
    Surface,
    /// Filled faces with the edges of the polygons on them.
    SurfaceWithEdges,
    /// The edges of the polygons alone, hidden ones too.
    Wireframe,
    /// The edges that no face hides.
    HiddenLine,
}

/// Which lights a picture uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lighting {
    /// The scene's own lights, with a tenth of white from everywhere when it has no
    /// ambient light; or the studio lights when it has no lights at all.
    #[default]
    Automatic,
    /// The scene's own lights only.
    Scene,
    /// A key, a fill and a rim light that move with the camera, and a little
    /// ambient light; the scene's own lights are out. A white plate that faces the
    /// camera shows at least 235 of 255, and no white diffuse surface is clipped.
    Studio,
}

/// Where on a surface light is found.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShadingModel {
    /// Once for each triangle, in its middle.
    Flat,
    /// At the vertices, and interpolated. Of the textures only that of the base
    /// colour and that of the emission are shown.
    Gouraud,
    /// At each pixel.
    #[default]
    Phong,
}

/// By which law surfaces answer to light. Unlit ones stay so.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reflection {
    /// By the one that the material names.
    #[default]
    Material,
    /// Diffuse light only.
    Lambert,
    /// Diffuse light and Blinn's highlights, as wide as the material's.
    BlinnPhong,
    /// GGX, as rough as the material's highlights are wide.
    MetallicRoughness,
}

/// What a picture holds. What is not asked for is not computed and not allocated;
/// without `color` and `radiance` nothing is shaded at all: neither lights nor effects are
/// prepared, and only masks are looked up.
///
/// Everything but these two is of one sample of each pixel and never mixed: of
/// the sample in the middle, or with an even number of samples per axis of the one
/// right and below of it. Asking for it changes no byte of the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// What the picture looks like.
    pub color: bool,
    /// The light that reaches the camera, in floating point: what `color` is before
    /// exposure, tone mapping and outlines.
    pub radiance: bool,
    /// Distance along the view axis.
    pub depth: bool,
    /// The node and the polygon.
    pub ids: bool,
    /// The material.
    pub material_ids: bool,
    /// The triangle of the mesh's triangulation.
    pub triangle_ids: bool,
    /// The shares of that triangle's corners.
    pub barycentrics: bool,
    /// The place in the world, relative to `origin`.
    pub positions: bool,
    /// The normal that light falls on.
    pub normals: bool,
    /// The normal of the triangle's plane.
    pub geometric_normals: bool,
    /// Texture coordinates of the first UV set.
    pub uvs: bool,
    /// The colour of the surface before light falls on it.
    pub albedo: bool,
    /// Whether blended surfaces are seen in all of these, wherever their alpha is
    /// above 0. Usually what lies behind them is, and only the colour shows them.
    pub of_blended: bool,
    /// What positions are relative to. They are rounded to f32 after it is
    /// subtracted: in a world of millions of metres choose a point near the scene.
    pub origin: DVec3,
}

impl Default for Outputs {
    /// Colour alone.
    fn default() -> Self {
        Self { color: true, ..Self::NONE }
    }
}

impl Outputs {
    /// Nothing yet.
    pub const NONE: Self = Self {
        color: false,
        radiance: false,
        depth: false,
        ids: false,
        material_ids: false,
        triangle_ids: false,
        barycentrics: false,
        positions: false,
        normals: false,
        geometric_normals: false,
        uvs: false,
        albedo: false,
        of_blended: false,
        origin: DVec3::ZERO,
    };

    /// Whether anything is asked for that follows from the triangle that is seen.
    pub(crate) fn of_triangles(&self) -> bool {
        self.material_ids
            || self.triangle_ids
            || self.barycentrics
            || self.positions
            || self.normals
            || self.geometric_normals
            || self.uvs
            || self.albedo
    }

    /// Whether surfaces are shaded.
    pub(crate) fn of_light(&self) -> bool {
        self.color || self.radiance
    }

    /// Whether anything is asked for that needs no light.
    pub(crate) fn beside_color(&self) -> bool {
        self.depth || self.ids || self.of_triangles()
    }

    /// Whether a pass of its own has to find what is seen, beside the colours'.
    pub(crate) fn need_own_pass(&self, has_blended: bool) -> bool {
        self.beside_color() && (!self.of_light() || (self.of_blended && has_blended))
    }
}

/// How a picture is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Pixels, 1 to [`MAX_SIZE`].
    pub width: u32,
    /// Pixels, 1 to [`MAX_SIZE`].
    pub height: u32,
    /// Anti-aliasing by supersampling: this many samples along each side of a
    /// pixel, 1 to 4, each shaded, averaged in linear light.
    pub samples_per_axis: u32,
    /// Anti-aliasing by multisampling: this many samples in each of those, 1, 2,
    /// 4, 8 or 16, of which those of one triangle are shaded together. Smooths
    /// outlines at a lower price, and nothing within a triangle.
    pub samples: u32,
    /// Behind everything.
    pub background: Background,
    /// Faces, edges or both.
    pub style: Style,
    /// What faces show.
    pub display: Display,
    /// Width of edges and of loose lines, in pixels. The edges of faces on surfaces are no
    /// wider than 16 pixels (fewer with supersampling), and narrower on faces that have no
    /// room for them: [`trigon_raster::FaceEdges`] says how much.
    pub line_width: f32,
    /// Linear RGB of the edges in all styles but [`Style::Surface`].
    pub edge_color: Vec3,
    /// How much of what lies below them edges hide in [`Style::SurfaceWithEdges`] and
    /// [`Style::HiddenLine`], 0 to 1.
    pub edge_opacity: f32,
    /// How much faces let show through them in the same two styles, 0 to 1: the edges and
    /// vertices that they hide, and the background (X-ray). What is not hidden stays as it
    /// is. Above 0 the picture is drawn twice, once as a wireframe.
    pub x_ray: f32,
    /// Elements in colours of their own.
    pub marks: Marks,
    /// How the vertices of meshes are shown, if they are, where no face hides them.
    pub vertices: Option<VertexPoints>,
    /// Which lights.
    pub lighting: Lighting,
    /// Factor for every light, the studio's too; 1 leaves them as they are.
    pub light_intensity: f32,
    /// Where on surfaces light is found.
    pub shading: ShadingModel,
    /// By which law surfaces answer to it.
    pub reflection: Reflection,
    /// Everything beyond surfaces in plain light.
    pub effects: EffectSettings,
    /// What the picture holds.
    pub outputs: Outputs,
    /// At most this many threads; `None` for one per core. The picture does
    /// not depend on it.
    pub threads: Option<NonZeroUsize>,
    /// Which vector instructions are used; `None` for the best that the
    /// processor has. The picture does not depend on it.
    pub simd: Option<SimdLevel>,
}

impl RenderSettings {
    /// A picture of a size, with 3×3 samples a pixel, and defaults elsewhere.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            samples_per_axis: 3,
            samples: 1,
            background: Background::default(),
            style: Style::default(),
            display: Display::default(),
            line_width: 1.0,
            edge_color: Vec3::splat(0.02),
            edge_opacity: 1.0,
            x_ray: 0.0,
            marks: Marks::default(),
            vertices: None,
            lighting: Lighting::default(),
            light_intensity: 1.0,
            shading: ShadingModel::default(),
            reflection: Reflection::default(),
            effects: EffectSettings::default(),
            outputs: Outputs::default(),
            threads: None,
            simd: None,
        }
    }

    /// How the edges of faces are painted, in styles that paint them.
    pub(crate) fn face_edges(&self) -> FaceEdges {
        FaceEdges { width: self.line_width, color: self.edge_color, opacity: self.edge_opacity }
    }

    /// What shows through faces, if anything does.
    pub(crate) fn share_through_faces(&self) -> Option<f32> {
        let shows_edges = matches!(self.style, Style::SurfaceWithEdges | Style::HiddenLine);
        (shows_edges && self.x_ray > 0.0).then(|| self.x_ray.min(1.0))
    }

    /// The factor for every light.
    pub(crate) fn light_factor(&self) -> f32 {
        if self.light_intensity > 0.0 && self.light_intensity.is_finite() {
            self.light_intensity
        } else {
            0.0
        }
    }

    /// Which lights, whatever is displayed.
    pub(crate) fn lighting(&self) -> Lighting {
        if self.display == Display::Matcap { Lighting::Studio } else { self.lighting }
    }

    /// Width over height.
    pub fn aspect(&self) -> f64 {
        f64::from(self.width.max(1)) / f64::from(self.height.max(1))
    }
}
