//! The outputs of a frame, how the frame is drawn, and its background: what a frame shows where nothing is drawn.

use std::num::NonZeroUsize;

use trigon_camera::Viewport;
use trigon_math::{DVec3, Vec3, Vec4};
use trigon_raster::FaceEdges;
use trigon_raster::simd::SimdLevel;

use crate::display::Display;
use crate::effect_settings::EffectSettings;
use crate::elements::{Marks, VertexPoints};

/// The largest width or height of an image, in pixels.
pub const MAX_SIZE: u32 = 16384;

/// How surfaces and edges are drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Filled faces.
    #[default]
    Surface,
    /// Filled faces with the edges of the polygons on them.
    SurfaceWithEdges,
    /// The edges of the polygons alone, including hidden ones.
    Wireframe,
    /// The edges that no face hides.
    HiddenLine,
}

/// The lights that a frame uses.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Lighting {
    /// The scene's own lights, plus a tenth of white ambient light if it has none; or the studio
    /// lights if it has no lights at all.
    #[default]
    Automatic,
    /// The scene's own lights only.
    Scene,
    /// A key, a fill and a rim light that move with the camera, and a little ambient light; the
    /// scene's own lights are off. A white plate that faces the camera shows at least 235 of 255,
    /// and no white diffuse surface is clipped.
    Studio,
}

/// Where lighting is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum ShadingModel {
    /// Once per triangle, at its centre.
    Flat,
    /// At the vertices, and interpolated. Only base colour and emissive textures are shown.
    Gouraud,
    /// At each pixel.
    #[default]
    Phong,
}

/// The reflection model of surfaces. Unlit ones stay unlit.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Reflection {
    /// The one of the material.
    #[default]
    Material,
    /// Diffuse light only.
    Lambert,
    /// Diffuse light and Blinn's highlights, as wide as the material's.
    BlinnPhong,
    /// GGX, with a roughness that matches the width of the material's highlights.
    MetallicRoughness,
}

/// The outputs of a frame. Outputs that are not requested are neither computed nor allocated;
/// without `color` and `radiance` nothing is shaded: neither lights nor effects are prepared, and
/// only masks are evaluated.
///
/// All outputs except these two are taken from one sample of each pixel and never averaged. It is the sample
/// in the middle, or with an even number of samples per axis the one to the right and below of the middle.
/// Requesting them changes no byte of the colour.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Outputs {
    /// The image.
    pub color: bool,
    /// The light that reaches the camera, in floating point: `color` before exposure, tone mapping
    /// and outlines.
    pub radiance: bool,
    /// Distance along the view axis.
    pub depth: bool,
    /// The node and the polygon.
    pub ids: bool,
    /// The material.
    pub material_ids: bool,
    /// The triangle of the mesh's triangulation.
    pub triangle_ids: bool,
    /// The barycentrics in that triangle.
    pub barycentrics: bool,
    /// The position in the world, relative to `origin`.
    pub positions: bool,
    /// The shading normal.
    pub normals: bool,
    /// The normal of the triangle's plane.
    pub geometric_normals: bool,
    /// Texture coordinates of the first UV set.
    pub uvs: bool,
    /// The colour of the surface before lighting.
    pub albedo: bool,
    /// Whether blended surfaces appear in all of these outputs, wherever their alpha is above 0. By
    /// default what lies behind them does, and only the colour shows them.
    pub of_blended: bool,
    /// The point that positions are relative to. Positions are rounded to f32 after it is subtracted: in a
    /// world of millions of metres choose a point near the scene.
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

    /// Everything, of surfaces that are not blended.
    pub const ALL: Self = Self {
        color: true,
        radiance: true,
        depth: true,
        ids: true,
        material_ids: true,
        triangle_ids: true,
        barycentrics: true,
        positions: true,
        normals: true,
        geometric_normals: true,
        uvs: true,
        albedo: true,
        of_blended: false,
        origin: DVec3::ZERO,
    };

    /// Whether any output derived from the visible triangle is requested.
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

    /// Whether any output that needs no light is requested.
    pub(crate) fn beside_color(&self) -> bool {
        self.depth || self.ids || self.of_triangles()
    }

    /// Whether a separate pass has to determine visibility in addition to that of the colours.
    pub(crate) fn need_own_pass(&self, has_blended: bool) -> bool {
        self.beside_color() && (!self.of_light() || (self.of_blended && has_blended))
    }
}

/// How a frame is drawn.
#[derive(Clone, Debug, PartialEq)]
pub struct RenderSettings {
    /// Pixels, 1 to [`MAX_SIZE`].
    pub width: u32,
    /// Pixels, 1 to [`MAX_SIZE`].
    pub height: u32,
    /// Anti-aliasing by supersampling: this many samples along each side of a
    /// pixel, 1 to 4, each shaded, averaged in linear light.
    pub samples_per_axis: u32,
    /// Anti-aliasing by multisampling: this many samples in each of those, 1, 2, 4, 8 or 16, shaded
    /// once per triangle. Smooths outlines at a lower cost, but nothing inside a triangle.
    pub samples: u32,
    /// Behind everything.
    pub background: Background,
    /// Faces, edges or both.
    pub style: Style,
    /// What faces show.
    pub display: Display,
    /// Width of edges and of loose lines, in pixels. The edges of faces on surfaces are at most 16
    /// pixels wide (fewer with supersampling), and narrower on small faces:
    /// [`trigon_raster::FaceEdges`] defines how much.
    pub line_width: f32,
    /// Diameter of loose points, in pixels. `None`: three times `line_width`, and less, but not less than `line_width`,
    /// where a scene has so many points that all together would cover the image more than four times.
    pub point_size: Option<f32>,
    /// Linear RGB of the edges in all styles but [`Style::Surface`].
    pub edge_color: Vec3,
    /// Opacity of edges in [`Style::SurfaceWithEdges`] and [`Style::HiddenLine`], 0 to 1.
    pub edge_opacity: f32,
    /// How much faces in the same two styles let hidden edges and vertices and the background show
    /// through, 0 to 1 (X-ray). What is not hidden stays as it is. Above 0 the frame is drawn
    /// twice, once as a wireframe.
    pub x_ray: f32,
    /// Elements in their own colours.
    pub marks: Marks,
    /// How vertices of meshes that no face hides are shown, if they are.
    pub vertices: Option<VertexPoints>,
    /// Which lights.
    pub lighting: Lighting,
    /// Factor for every light, including the studio lights; 1 leaves them as they are.
    pub light_intensity: f32,
    /// Where lighting is computed.
    pub shading: ShadingModel,
    /// The reflection model.
    pub reflection: Reflection,
    /// All effects beyond directly lit surfaces.
    pub effects: EffectSettings,
    /// The outputs of the frame.
    pub outputs: Outputs,
    /// The maximum number of threads; `None` for one per core. The frame does not depend on it.
    pub threads: Option<NonZeroUsize>,
    /// The SIMD level; `None` for the best of the processor. The frame does not depend on it.
    pub simd: Option<SimdLevel>,
}

impl RenderSettings {
    /// An image of a size with 3×3 samples per pixel, and defaults elsewhere.
    #[must_use]
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
            point_size: None,
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

    /// The diameter of loose points in a scene with so many.
    pub(crate) fn size_of_points(&self, count: u64) -> f32 {
        /// What MeshLab shows of a small cloud.
        const POINT_TO_LINE: f32 = 3.0;
        /// How often points may cover the image: a third of it shows the cloud, whose farther half is hidden, so the
        /// nearer one still closes six times over.
        const LAYERS: f64 = 4.0;
        self.point_size.unwrap_or_else(|| {
            let pixels = f64::from(self.width) * f64::from(self.height);
            let closed = (LAYERS * pixels / count.max(1) as f64).sqrt() as f32;
            closed.min(POINT_TO_LINE * self.line_width).max(self.line_width)
        })
    }

    /// How the edges of faces are painted, in styles with edges.
    pub(crate) fn face_edges(&self) -> FaceEdges {
        FaceEdges { width: self.line_width, color: self.edge_color, opacity: self.edge_opacity }
    }

    /// What shows through faces, if anything.
    pub(crate) fn xray_opacity(&self) -> Option<f32> {
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

    /// The image as cameras know it.
    pub(crate) fn viewport(&self) -> Viewport {
        Viewport { width: self.width, height: self.height }
    }

    /// Width over height.
    #[must_use]
    pub fn aspect(&self) -> f64 {
        f64::from(self.width.max(1)) / f64::from(self.height.max(1))
    }
}

/// What a frame shows where nothing is drawn. Colours are linear RGB.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Background {
    /// One colour.
    Color(Vec3),
    /// A gradient from one colour at the top edge of the image to another at the bottom.
    Gradient {
        /// The colour at the top edge.
        top: Vec3,
        /// The colour at the bottom edge.
        bottom: Vec3,
    },
    /// Nothing: the image's alpha is 0 there.
    Transparent,
    /// The [environment](crate::EffectSettings::environment) that lights the scene, black without
    /// one. Like the light of surfaces, it is subject to exposure and tone mapping, but not to fog.
    Environment,
}

impl Default for Background {
    /// A neutral grey-blue gradient on which light and dark models both stand out.
    fn default() -> Self {
        Self::Gradient { top: Vec3::new(0.16, 0.19, 0.24), bottom: Vec3::new(0.52, 0.55, 0.58) }
    }
}

impl Background {
    /// The colours at the top and the bottom edge of the image; black where it has no colour.
    pub(crate) fn edges(&self) -> [Vec3; 2] {
        match *self {
            Self::Color(color) => [color; 2],
            Self::Gradient { top, bottom } => [top, bottom],
            Self::Transparent | Self::Environment => [Vec3::ZERO; 2],
        }
    }

    /// Premultiplied linear colour of row `y` of `height`. Transparent if there are no rows.
    pub(crate) fn row(&self, y: u32, height: u32) -> Vec4 {
        match *self {
            Self::Color(color) => color.extend(1.0),
            Self::Gradient { top, bottom } => {
                let down = (y as f32 + 0.5) / height as f32;
                (top + (bottom - top) * down).extend(1.0)
            }
            Self::Transparent | Self::Environment => Vec4::ZERO,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn each_output_is_of_its_kind() {
        let none = Outputs::NONE;
        assert!(!none.of_light() && !none.of_triangles() && !none.beside_color());
        for light in [Outputs { color: true, ..none }, Outputs { radiance: true, ..none }] {
            assert!(light.of_light() && !light.of_triangles() && !light.beside_color(), "{light:?}");
        }
        for visible in [Outputs { depth: true, ..none }, Outputs { ids: true, ..none }] {
            assert!(!visible.of_light() && !visible.of_triangles() && visible.beside_color(), "{visible:?}");
        }
        for triangles in [
            Outputs { material_ids: true, ..none },
            Outputs { triangle_ids: true, ..none },
            Outputs { barycentrics: true, ..none },
            Outputs { positions: true, ..none },
            Outputs { normals: true, ..none },
            Outputs { geometric_normals: true, ..none },
            Outputs { uvs: true, ..none },
            Outputs { albedo: true, ..none },
        ] {
            assert!(triangles.of_triangles() && triangles.beside_color(), "{triangles:?}");
            assert!(!triangles.of_light(), "{triangles:?}");
        }
        assert_eq!(Outputs::default(), Outputs { color: true, ..none }, "colour alone");
    }

    #[test]
    fn a_pass_of_its_own_is_for_what_colours_do_not_find() {
        let of = |color, ids, of_blended| Outputs { color, ids, of_blended, ..Outputs::NONE };
        for has_blended in [false, true] {
            assert!(!of(true, false, true).need_own_pass(has_blended), "colour alone");
            assert!(!of(true, true, false).need_own_pass(has_blended), "both see what is opaque");
            assert_eq!(of(true, true, true).need_own_pass(has_blended), has_blended);
            assert!(of(false, true, false).need_own_pass(has_blended), "no colours are drawn");
            assert!(!of(false, false, true).need_own_pass(has_blended), "nothing is");
        }
    }
}
