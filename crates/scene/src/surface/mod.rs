//! The pipeline that draws faces, eight pixels at a time.
//!
//! One pipeline serves all materials. A part that a material or its lighting does not need costs one branch
//! for each group of eight pixels; its values are neither fetched nor interpolated. A second variant of the
//! pipeline, `FLAT`, is evaluated once for each visible triangle, for faces of one colour.
//!
//! Varyings and texture look-ups of a draw are counted for the effects that need them.

mod bound_material;
mod layout;
mod light;
mod material_params;
mod points;
mod traced;

use std::ops::Deref;
use std::sync::Arc;

use trigon_math::{Mat3, Vec3};
use trigon_raster::simd::prelude::*;
use trigon_raster::simd::{F32, InlineMap, Mask, Simd};
use trigon_raster::{FragmentLanes, LanePipeline, VertexLanes};

use crate::effect::Effect;
use crate::effects::{Counts, LightingEnvironment, Optics};
use crate::geometry::Columns;
use crate::lanes::{V3, normalized, saturated, splat, sum, turned};
use crate::lighting::Reflected;
use crate::material::MaterialTexture;
use crate::placement::{Placement, Rays};
use crate::work::{Work, note};

pub(crate) use bound_material::{BoundMaterial, MaterialContext};
pub(crate) use layout::{Illumination, Layout, LightSlots};
pub(crate) use material_params::{Coverage, Maps, MaterialParams, MicrofacetModel, Model, TextureMap};

/// The triangles of a draw.
#[derive(Clone, Copy)]
pub(crate) struct DrawTriangles<'a> {
    pub(crate) columns: &'a Columns,
    /// All of them, and the polygon of each; draws without light need neither.
    pub(crate) triangles: &'a [[u32; 3]],
    /// `None` if each is the polygon with its number.
    pub(crate) faces: Option<&'a [u32]>,
}

/// Faces of one mesh in one material, wherever they are: nodes that draw the same share it.
pub(crate) struct Look<'a> {
    pub(crate) columns: &'a Columns,
    /// The whole draw, for flat faces.
    pub(crate) triangles: &'a [[u32; 3]],
    /// The polygon of each triangle; `None` if each is the polygon with its number.
    pub(crate) faces: Option<&'a [u32]>,
    pub(crate) layout: Layout,
    pub(crate) params: MaterialParams<'a>,
    pub(crate) illumination: Illumination,
    /// Whether the projection is perspective or orthographic.
    pub(crate) rays: Rays,
    pub(crate) lighting: &'a LightingEnvironment,
    /// From camera space.
    pub(crate) to_world: Mat3,
}

/// Faces of one mesh in one material at one node. A scene may have millions: what does not depend on the node is shared.
pub(crate) struct Surface<'a, const FLAT: bool> {
    pub(crate) placement: Placement,
    look: Arc<Look<'a>>,
}

impl<'a, const FLAT: bool> Deref for Surface<'a, FLAT> {
    type Target = Look<'a>;

    #[inline(always)]
    fn deref(&self) -> &Look<'a> {
        &self.look
    }
}

impl<const FLAT: bool> LanePipeline for Surface<'_, FLAT> {
    /// The layout, made with the draw.
    const VARYINGS: usize = 0;
    const FLAT: bool = FLAT;
    const MASKED: bool = !FLAT;

    #[inline(always)]
    fn varyings(&self) -> usize {
        self.layout.count
    }

    fn vertex_count(&self) -> usize {
        self.columns.vertex_count()
    }

    #[inline(always)]
    fn vertices<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>) -> [F32<S>; 4] {
        let position = load(simd, vertices, &self.columns.positions);
        // Flat faces interpolate nothing: the rest is not even compiled.
        if !FLAT && self.layout.count > 0 {
            self.set_varyings(simd, vertices, position);
        }
        self.placement.clip(simd, position)
    }

    #[inline(always)]
    fn fragments<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        if FLAT { self.facet_color(simd, fragments) } else { self.color(simd, fragments) }
    }

    #[inline(always)]
    fn masks<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> Mask<S> {
        note(Work::Mask);
        let alpha = self.params.albedo(simd, self.layout.color, fragments)[3];
        alpha.simd_ge(F32::splat(simd, self.params.cutoff))
    }
}

impl<'a> Look<'a> {
    /// Triangles in one material.
    pub(crate) fn new(
        DrawTriangles { columns, triangles, faces }: DrawTriangles<'a>,
        bound: BoundMaterial<'a>,
        context: &MaterialContext<'a>,
    ) -> Self {
        let BoundMaterial { params, layout, illumination } = bound;
        let MaterialContext { rays, lighting, to_world, .. } = *context;
        Self { columns, triangles, faces, layout, params, illumination, rays, lighting, to_world }
    }
}

impl<'a, const FLAT: bool> Surface<'a, FLAT> {
    /// Triangles of a placed mesh.
    pub(crate) fn new(placement: Placement, look: Arc<Look<'a>>) -> Self {
        Self { placement, look }
    }

    #[inline(always)]
    fn set_varyings<S: Simd>(&self, simd: S, vertices: &mut VertexLanes<'_>, position: V3<S>) {
        let Look { layout, columns, .. } = &**self;
        let placement = &self.placement;
        for coordinates in &layout.coordinates {
            let [u, v] = load(simd, vertices, &columns.uv_sets[coordinates.uv_set]);
            let (matrix, offset) = (coordinates.transform.matrix2, coordinates.transform.translation);
            vertices.set(coordinates.at, u * matrix.x_axis.x + v * matrix.y_axis.x + offset.x);
            vertices.set(coordinates.at + 1, u * matrix.x_axis.y + v * matrix.y_axis.y + offset.y);
        }
        if let Some(at) = layout.position {
            set(vertices, at, placement.camera(simd, position));
        }
        if let Some(at) = layout.normal {
            let normal = load(simd, vertices, &columns.normals);
            set(vertices, at, normalized(turned(&placement.normal_to_camera, normal)));
        }
        if let (Some(at), Some([x, y, z, sign])) = (layout.tangent, &columns.tangents) {
            note(Work::Tangents);
            let tangent = [x, y, z].each(
                #[inline(always)]
                |column| vertices.load(simd, column),
            );
            set(vertices, at, normalized(turned(&placement.tangent_to_camera(), tangent)));
            vertices.set(at + 3, vertices.load(simd, sign) * placement.handedness());
        }
        if let (Some(at), Some(colors)) = (layout.color, &columns.colors) {
            set(vertices, at, load(simd, vertices, colors));
        }
        if let Some(slots) = layout.light {
            self.set_light(simd, vertices, slots, position);
        }
    }

    /// The colour of eight pixels.
    #[inline(always)]
    fn color<S: Simd>(&self, simd: S, fragments: &FragmentLanes<'_, S>) -> [F32<S>; 4] {
        let [r, g, b, alpha] = self.params.albedo(simd, self.layout.color, fragments);
        let shaded = match self.illumination {
            Illumination::None => [r, g, b],
            Illumination::AtVertices => self.interpolated(fragments, [r, g, b]),
            Illumination::InPixels => self.lit(simd, fragments, [r, g, b]),
            Illumination::OnFacets => self.lit_facets(simd, fragments, [r, g, b]),
            Illumination::Value(display) => {
                let value = self.value(simd, fragments, display, [r, g, b, alpha]);
                return self.finished(simd, value, alpha);
            }
            Illumination::Openness(of) => return self.openness(simd, fragments, of),
        };
        let mut shaded = self.with_emission(simd, fragments, shaded);
        if let (Some(fog), Some(at)) = (&self.lighting.fog, self.layout.position) {
            shaded = fog.over(simd, points::three(fragments, at), shaded);
        }
        self.finished(simd, shaded, alpha)
    }

    #[inline(always)]
    fn with_emission<S: Simd>(&self, simd: S, values: &FragmentLanes<'_, S>, shaded: V3<S>) -> V3<S> {
        let emissive = self.params.material.emissive;
        if emissive != Vec3::ZERO {
            note(Work::Emission);
        }
        match self.params.maps.get(MaterialTexture::Emissive) {
            Some(map) => {
                let [r, g, b, _] = map.look_up_apart(simd, values);
                sum(shaded, [r * emissive.x, g * emissive.y, b * emissive.z])
            }
            None if emissive == Vec3::ZERO => shaded,
            None => sum(shaded, splat(simd, emissive)),
        }
    }

    /// With its alpha, premultiplied.
    #[inline(always)]
    fn finished<S: Simd>(&self, simd: S, [r, g, b]: V3<S>, alpha: F32<S>) -> [F32<S>; 4] {
        match self.params.coverage {
            Coverage::Opaque => [r, g, b, F32::splat(simd, 1.0)],
            Coverage::Translucent => {
                note(Work::Blend);
                let alpha = saturated(alpha);
                [r * alpha, g * alpha, b * alpha, alpha]
            }
        }
    }
}

/// Sums of linear light.
#[inline(always)]
fn shown<S: Simd>(reflected: &Reflected<S>, [r, g, b]: V3<S>) -> V3<S> {
    let [[dr, dg, db], [sr, sg, sb]] = [reflected.diffuse, reflected.specular];
    [r * dr + sr, g * dg + sg, b * db + sb]
}

#[inline(always)]
fn load<S: Simd, const N: usize>(
    simd: S,
    vertices: &VertexLanes<'_>,
    columns: &[Vec<f32>; N],
) -> [F32<S>; N] {
    let mut values = [F32::splat(simd, 0.0); N];
    for (value, column) in values.iter_mut().zip(columns) {
        *value = vertices.load(simd, column);
    }
    values
}

#[inline(always)]
fn set<S: Simd, const N: usize>(vertices: &mut VertexLanes<'_>, at: usize, values: [F32<S>; N]) {
    for (index, value) in values.into_iter().enumerate() {
        vertices.set(at + index, value);
    }
}

impl Look<'_> {
    /// Adds the varyings of each vertex and the look-ups of each pixel.
    pub(crate) fn count(&self, lighting: &LightingEnvironment, masked: bool, counts: &mut Counts) {
        let Self { params, layout, .. } = self;
        let some = |there: bool, count: u64| if there { count } else { 0 };
        let light = if !lighting.lights.lamps.is_empty() {
            Effect::Lamps
        } else if lighting.surroundings.is_some() {
            Effect::Environment
        } else if lighting.has_ambient() {
            Effect::AmbientLight
        } else if matches!(params.optics, Some(Optics::Glass(_))) {
            Effect::Refraction
        } else {
            Effect::Reflection
        };
        let specular = !matches!(params.model, Model::Lambert);
        let position = match () {
            () if lighting.fog.is_some() => Effect::Fog,
            () if specular && self.illumination != Illumination::None => Effect::Highlights,
            () if lighting.shadow_maps.is_some() => Effect::ShadowMaps,
            () if lighting.shadow_rays => Effect::ShadowRays,
            () if lighting.ambient_rays.is_some() => Effect::AmbientOcclusion,
            () => light,
        };
        let of_light = layout.light.map_or(0, |slots| slots.len() as u64) + some(layout.normal.is_some(), 3);
        counts.of(light).attributes += of_light;
        counts.of(position).attributes += some(layout.position.is_some(), 3);
        counts.of(Effect::NormalMaps).attributes += some(layout.tangent.is_some(), 4);
        counts.of(Effect::VertexColors).attributes += some(layout.color.is_some(), 4);
        counts.of(Effect::Textures).attributes += 2 * layout.coordinates.len() as u64;
        for slot in params.maps.slots() {
            counts.of(slot.row().effect).look_ups += 1;
        }
        let has_holes = masked && params.maps.get(MaterialTexture::BaseColor).is_some();
        counts.of(Effect::Masks).look_ups += some(has_holes, 1);
        counts.of(Effect::Transparency).passes += some(params.coverage == Coverage::Translucent, 1);
    }
}
