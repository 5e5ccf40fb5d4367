//! Packing of islands: their shapes are arranged in the unit square.
//!
//! Islands are laid one by one, the largest first, each in the quarter turn and at the lowest position in which no cell
//! of it is nearer than the margin to one of those before: B. Lévy, S. Petitjean, N. Ray and J. Maillot, *Least Squares
//! Conformal Maps for Automatic Texture Atlas Generation*, 2002, section 4, but with the cells themselves instead of
//! the horizon above them, so that holes are filled, too. The side of the square is the least that is found in which
//! all have room.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use trigon_math::DVec2;

use super::mask::Mask;
use super::occupancy::{LaidMask, Occupancy};
use crate::refusal::Refusal;

/// An island in its layout: the lower left corner of the rectangle around it is at the origin.
#[derive(Debug, Clone, Copy)]
pub(super) struct IslandShape<'s> {
    pub(super) points: &'s [DVec2],
    pub(super) triangles: &'s [[u32; 3]],
}

/// Whether islands may be turned when they are packed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum PackTurns {
    /// As they are.
    None,
    /// By quarters of a turn.
    Quarters,
}

/// Where islands lie in a square.
#[derive(Debug, PartialEq)]
pub(super) struct Arrangement {
    /// In the order of the islands.
    pub(super) slots: Vec<Slot>,
    /// The side of the square.
    pub(super) side: f64,
}

/// Where an island lies: it is turned first, and then moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Slot {
    /// How many quarters counter-clockwise.
    quarters: usize,
    /// The rectangle that is turned.
    extent: DVec2,
    /// The lower left corner afterwards.
    corner: DVec2,
}

impl Slot {
    /// Where a point of the island's layout lies in the square.
    pub(super) fn apply(&self, point: DVec2) -> DVec2 {
        let turned = match self.quarters {
            0 => point,
            1 => DVec2::new(self.extent.y - point.y, point.x),
            2 => self.extent - point,
            _ => DVec2::new(point.y, self.extent.x - point.x),
        };
        turned + self.corner
    }
}

/// Arranges islands so that they are at least `margin` apart and from the border, measured in sides of the square.
pub(super) fn pack(
    shapes: &[IslandShape<'_>],
    turns: PackTurns,
    margin: f64,
) -> Result<Arrangement, Refusal> {
    if shapes.is_empty() {
        return Ok(Arrangement { slots: Vec::new(), side: 1.0 });
    }
    let cells = cells_across(shapes.len());
    let cell = least_side(shapes) / cells as f64;
    let with_cell = |doublings: u32| {
        let grid = MaskGrid::new(shapes, turns, cell * (1u64 << doublings) as f64);
        grid.pack(margin, MOST_SIDES * cells)
    };
    let found = if can_be_apart(shapes.len(), margin) { (0..DOUBLINGS).find_map(with_cell) } else { None };
    found.ok_or(Refusal::OutOfRange {
        parameter: "the margin",
        value: margin,
        range: "at least 0, and small enough that all islands find room",
    })
}

/// With more islands, it takes long to try everything, and gains little.
const FEW: usize = 256;
/// Squares of more sides of the least one are tried with larger cells.
const MOST_SIDES: usize = 3;
/// After so many squares in a row in which an order fails, it has seldom room in a smaller one.
const MOST_FAILURES: usize = 2;
/// How often cells are doubled, where the margin takes most of the square.
const DOUBLINGS: u32 = 40;

/// Into how many cells the least side is divided that islands could have room in: enough for the space that is lost
/// around a few islands to be a few hundredths, and for most of many islands to be larger than a cell. The time that
/// packing takes grows with their square.
fn cells_across(islands: usize) -> usize {
    const LEAST: usize = 160;
    const ENOUGH_FOR_FEW: usize = 320;
    const MOST: usize = 2048;
    let rows = islands.isqrt();
    (64 * rows).min(ENOUGH_FOR_FEW).max(8 * rows).clamp(LEAST, MOST)
}

/// Whether so many points can be apart in a square, but for the shape of it: N. Oler, *An Inequality in the Geometry of
/// Numbers*, 1961.
fn can_be_apart(count: usize, margin: f64) -> bool {
    let side = 1.0 - 2.0 * margin;
    let ratio = side / margin;
    side >= 0.0 && count as f64 <= 2.0 / 3f64.sqrt() * ratio * ratio + 2.0 * ratio + 1.0
}

/// The side of a square below which islands have no room; 1 if they have no size.
fn least_side(shapes: &[IslandShape<'_>]) -> f64 {
    let double_area = |shape: &IslandShape<'_>| -> f64 {
        let double = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|vertex| shape.points[vertex as usize]);
            (b - a).perp_dot(c - a).abs()
        };
        shape.triangles.iter().map(double).sum()
    };
    let area = shapes.iter().map(double_area).sum::<f64>() / 2.0;
    let coordinates = shapes.iter().flat_map(|shape| shape.points).map(|point| point.max_element());
    let least = coordinates.fold(area.sqrt(), f64::max);
    /// What is smaller has no size.
    const SMALLEST: f64 = 1e-150;
    if least > SMALLEST { least } else { 1.0 }
}

/// The cells of all islands.
struct MaskGrid {
    cell: f64,
    /// By island, and by how many quarters it is turned, until it looks as in the beginning.
    masks: Vec<Vec<Mask>>,
    /// The islands in different orders, with the largest first by one measure or another.
    orders: Vec<Vec<usize>>,
}

/// A square in which all islands have room.
struct Fit {
    side: usize,
    slots: Vec<Slot>,
}

impl MaskGrid {
    fn new(shapes: &[IslandShape<'_>], turns: PackTurns, cell: f64) -> Self {
        let turns = match turns {
            PackTurns::None => 1,
            PackTurns::Quarters if shapes.len() > FEW => 2,
            PackTurns::Quarters => 4,
        };
        let masks_of = |shape: &IslandShape<'_>| -> Vec<Mask> {
            let first = Mask::new(shape.points, shape.triangles, cell);
            let turned =
                std::iter::successors(Some(first.turned()), |mask| Some(mask.turned())).take(turns - 1);
            let others: Vec<Mask> = turned.take_while(|mask| *mask != first).collect();
            std::iter::once(first).chain(others).collect()
        };
        let masks: Vec<Vec<Mask>> = shapes.iter().map(masks_of).collect();
        let order_by = |size: fn(&Mask) -> usize| {
            let mut order: Vec<usize> = (0..shapes.len()).collect();
            order.sort_by_key(|&index| (Reverse(size(&masks[index][0])), index));
            order
        };
        let mut orders = vec![
            order_by(Mask::count),
            order_by(|mask| mask.width.max(mask.height)),
            order_by(|mask| mask.width + mask.height),
        ];
        orders.dedup();
        Self { cell, masks, orders }
    }

    /// An arrangement in the least square that is found, of at most so many cells on a side.
    fn pack(&self, margin: f64, most: usize) -> Option<Arrangement> {
        let first = || self.masks.iter().map(|masks| &masks[0]);
        let area: usize = first().map(Mask::count).sum();
        let longest = first().map(|mask| mask.width.max(mask.height)).max()?;
        let least = longest.max(area.isqrt());
        // Found by trial: most islands fill little more than three fifths.
        let mut side = (area as f64 * 1.6).sqrt() as usize;
        side = side.max(least).min(most);
        let mut best = self.least_square(least, side, most, margin)?;
        // Where one order fails in a square, it may have room in a smaller one, and so may another.
        for order in self.orders.iter().filter(|order| order.len() <= FEW) {
            let mut failures = 0;
            for side in smaller_sides(best.side).take_while(|&side| side >= least) {
                match self.arrange(order, side, margin) {
                    Some(slots) => (best, failures) = (Fit { side, slots }, 0),
                    None => failures += 1,
                }
                if failures == MOST_FAILURES {
                    break;
                }
            }
        }
        Some(Arrangement { slots: best.slots, side: best.side as f64 * self.cell })
    }

    /// The least square found by bisection, with the first order.
    fn least_square(&self, least: usize, guess: usize, most: usize, margin: f64) -> Option<Fit> {
        let mut side = guess;
        let mut fails = least - 1;
        let mut best: Option<Fit> = None;
        let mut step = 1.03;
        // Sides that differ by less are alike.
        let precision = if self.masks.len() > FEW { 64 } else { 256 };
        loop {
            match self.arrange(&self.orders[0], side, margin) {
                Some(slots) => best = Some(Fit { side, slots }),
                None => fails = fails.max(side),
            }
            side = match &best {
                None if side >= most => return None,
                None => ((side as f64 * step).ceil() as usize).min(most),
                Some(fit) if fit.side - fails <= 1.max(fit.side / precision) => return best,
                Some(fit) if fails < least => ((fit.side as f64 / step) as usize).max(least),
                Some(fit) => usize::midpoint(fails, fit.side),
            };
            step *= step;
        }
    }

    /// An arrangement in a square of so many cells, if all have room.
    fn arrange(&self, order: &[usize], side: usize, margin: f64) -> Option<Vec<Slot>> {
        let mut occupancy = Occupancy::new(side, margin * side as f64);
        let mut slots = vec![None; self.masks.len()];
        // Where the last one with the same cells was laid: below there is no room for them.
        let mut rows: BTreeMap<&Mask, usize> = BTreeMap::new();
        let mut last_row = 0usize;
        for (rank, &index) in order.iter().enumerate() {
            let masks = &self.masks[index];
            let lowest = |mask: &Mask| rows.get(mask).copied().unwrap_or(0);
            // Many small ones are seldom laid much below the last one: what is there is full.
            let near_last = |mask: &Mask| lowest(mask).max(last_row.saturating_sub(4 * mask.height));
            let nearby = if rank < FEW { None } else { occupancy.best(masks, near_last) };
            let is_lowest = nearby.is_none();
            let LaidMask { quarters, cell } = nearby.or_else(|| occupancy.best(masks, lowest))?;
            let mask = &masks[quarters];
            if is_lowest {
                rows.insert(mask, cell.y);
            }
            last_row = cell.y;
            occupancy.lay(mask, cell);
            let first = &masks[0];
            slots[index] = Some(Slot {
                quarters,
                extent: DVec2::new(first.width as f64, first.height as f64) * self.cell,
                corner: DVec2::new(cell.x as f64, cell.y as f64) * self.cell,
            });
        }
        slots.into_iter().collect()
    }
}

/// Sides that are less by a hundredth each.
fn smaller_sides(side: usize) -> impl Iterator<Item = usize> {
    (1..=6).map(move |step| side - (side * step).div_ceil(100))
}
