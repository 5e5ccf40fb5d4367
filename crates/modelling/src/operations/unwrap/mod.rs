//! Unwrapping: charts of a surface are laid flat, and packed into the image as islands.
//!
//! `charts` cuts the surface, `conformal` and `convex` lay a chart flat by means of `factor`, `stretch` improves a
//! layout, with a `scaffold` if its border is a circle, `injective` tests it, `pinned` lays charts around given
//! coordinates, `pack` arranges the shapes of islands (`mask`) in the image (`occupancy`).

mod average_scale;
mod block;
mod charts;
mod conformal;
mod convex;
mod factor;
mod injective;
mod islands;
mod lists;
mod live;
mod mask;
mod occupancy;
mod ordering;
mod pack;
#[cfg(test)]
mod pack_tests;
mod pinned;
#[cfg(test)]
mod pinned_tests;
mod rectangle;
mod scaffold;
mod smart;
mod stitch;
mod stretch;
#[cfg(test)]
mod tests;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use trigon_math::DVec2;

use self::charts::{UvChart, charts};
use self::factor::NoFactor;
use self::injective::is_injective;
use self::islands::{Island, check_margin};
use self::pinned::{Pin, PinnedIsland};
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::refusal::Refusal;

pub use self::islands::PackSettings;
pub use self::smart::SmartProjection;
pub use self::stitch::{StitchSettings, Stitched};

/// How charts are laid flat.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum UnwrapMethod {
    /// Angles are preserved as well as possible, with a free border. Charts that would overlap are laid out as with
    /// `convex`, and then stretched as little as possible.
    #[default]
    Conformal,
    /// The border becomes a circle.
    Convex,
}

/// Parameters of [`EditMesh::unwrap_faces`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct UnwrapSettings {
    /// The set of texture coordinates, from 0; the next one is added if it does not exist.
    pub uv_set: usize,
    /// How charts are laid flat.
    pub method: UnwrapMethod,
    /// In how many steps stretch is made smaller afterwards, at most.
    pub minimize_stretch: u32,
    /// The distance of islands from one another and from the border of the image, in sides of the image; at least 0.
    pub margin: f64,
}

impl Default for UnwrapSettings {
    /// Conformal, with a margin of a hundredth.
    fn default() -> Self {
        Self { uv_set: 0, method: UnwrapMethod::default(), minimize_stretch: 0, margin: 0.01 }
    }
}

/// The result of an unwrapping.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Unwrapped {
    /// How many islands there are.
    pub islands: usize,
    /// How many of them could not be laid out conformally without overlaps.
    pub not_conformal: usize,
    /// How many of them are not packed, because they have pins.
    pub pinned: usize,
    /// How many of those overlap themselves, because of where their pins are.
    pub overlapping: usize,
    /// How many triangles are turned over or have no area, because of pins, or because they are too small for the precision
    /// of texture coordinates.
    pub turned_over: usize,
}

/// A layout in a circle needs this many steps at least: its stretch is great.
const STEPS_FROM_CIRCLE: u32 = 30;

const OPERATION: &str = "unwrapping";

impl EditMesh {
    /// Lays faces flat and packs them into the image. Each part that seams and the border of the faces enclose
    /// becomes an island, which is not mirrored when seen from outside. Areas of islands are proportional to their
    /// areas on the surface. Faces are also cut where more than two of them meet, or two with opposite windings. If
    /// there are `uv_set` sets, one is added, with zero at all other corners. Given tangents are unchanged.
    ///
    /// Pinned coordinates stay as they are to the bit ([`Self::pin_uvs`]), and islands with pins are not packed. With two
    /// pins or more the others follow conformally, whatever the method, in the size that the pins give; where pins do not
    /// allow that, islands may overlap themselves. With one pin an island has the size and direction that it had before.
    ///
    /// # Errors
    /// No face is given, one does not exist; there are fewer than `uv_set` sets; the margin is out of range; a
    /// position or pin is not finite; a vertex is pinned at two positions without a seam between them; a part is closed or
    /// has handles, so that it cannot be laid flat; or memory is not sufficient.
    pub fn unwrap_faces(
        &mut self,
        faces: &[FaceId],
        settings: &UnwrapSettings,
    ) -> Result<Unwrapped, Refusal> {
        self.check_faces(faces, OPERATION)?;
        self.check_uv_set(settings.uv_set)?;
        check_margin(settings.margin)?;
        let charts = charts(self, faces, |edge, _| !self.is_seam(edge));
        charts.iter().try_for_each(check_chart)?;
        let mut unwrapped = Unwrapped { islands: charts.len(), ..Unwrapped::default() };
        let (mut islands, mut pinned) = (Vec::new(), Vec::new());
        for chart in charts {
            let pins = pinned::pins(self, &chart, settings.uv_set)?;
            if !pins.is_empty() {
                pinned.push(self.lay_around_pins(chart, pins, settings, &mut unwrapped)?);
                continue;
            }
            let (layout, is_as_wanted) =
                lay_flat(&chart, settings, self.memory).map_err(|error| self.no_layout(error))?;
            unwrapped.not_conformal += usize::from(!is_as_wanted);
            islands.push(Island::with_area_of(chart, layout));
        }
        unwrapped.turned_over = self.write_islands(
            islands,
            settings.uv_set,
            &PackSettings { margin: settings.margin, ..PackSettings::default() },
        )?;
        for island in &pinned {
            island.write(self, settings.uv_set);
            unwrapped.turned_over += island.turned_over();
            unwrapped.overlapping += usize::from(island.overlaps());
        }
        unwrapped.pinned = pinned.len();
        Ok(unwrapped)
    }

    fn lay_around_pins(
        &self,
        mut chart: UvChart,
        pins: Vec<Pin>,
        settings: &UnwrapSettings,
        unwrapped: &mut Unwrapped,
    ) -> Result<PinnedIsland, Refusal> {
        let layout = if let [pin] = &pins[..] {
            let (mut layout, is_as_wanted) =
                lay_flat(&chart, settings, self.memory).map_err(|error| self.no_layout(error))?;
            unwrapped.not_conformal += usize::from(!is_as_wanted);
            pinned::move_to_pin(self, &chart, pin, settings.uv_set, &mut layout);
            layout
        } else {
            pinned::lay_between(&mut chart, &pins, settings.minimize_stretch, self.memory)
                .map_err(|error| self.no_layout(error))?
        };
        PinnedIsland::new(chart, pins, &layout)
    }

    fn no_layout(&self, error: NoFactor) -> Refusal {
        match error {
            NoFactor::Memory(needed) => Refusal::Memory { needed, allowed: self.memory },
            NoFactor::NotPositive => Refusal::NotPossible {
                operation: OPERATION,
                reason: "sizes of edges differ too much; merge vertices by distance, or mark seams around such parts",
            },
        }
    }
}

/// A layout without overlaps, if one is found, and whether it is the one that was asked for.
fn lay_flat(chart: &UvChart, settings: &UnwrapSettings, memory: u64) -> Result<(Vec<DVec2>, bool), NoFactor> {
    let steps = settings.minimize_stretch;
    if settings.method == UnwrapMethod::Conformal {
        let found = match conformal::conformal(chart, memory) {
            Ok(layout) => Some(layout).filter(|layout| is_injective(chart, layout)),
            Err(NoFactor::NotPositive) => None,
            Err(error) => return Err(error),
        };
        if let Some(mut layout) = found {
            stretch::minimize_stretch(chart, &mut layout, steps, memory)?;
            return Ok((layout, true));
        }
    }
    let is_requested = settings.method == UnwrapMethod::Convex;
    let steps = if is_requested { steps } else { steps.max(STEPS_FROM_CIRCLE) };
    let mut layout = convex::convex(chart, memory)?;
    scaffold::minimize_stretch_from_circle(chart, &mut layout, steps, memory)?;
    Ok((layout, is_requested))
}

fn check_chart(chart: &UvChart) -> Result<(), Refusal> {
    let not_possible = |reason| Err(Refusal::NotPossible { operation: OPERATION, reason });
    if !chart.points.iter().all(|point| point.is_finite()) {
        return not_possible("a vertex has no finite position; move it");
    }
    if chart.loops.iter().all(|border| border.len() < 3) {
        return not_possible("a part is closed; mark seams that open it, or use Smart Projection");
    }
    if !chart.is_disc_with_holes() {
        return not_possible("a part has a handle; mark seams that cut it open, or use Smart Projection");
    }
    Ok(())
}
