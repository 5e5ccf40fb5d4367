//! Labels beside points, without overlapping each other or any point.

use std::cmp::Reverse;

/// A rectangle in whole pixels: its left, top, right and lower edge, the last two outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct LabelBox {
    /// The first column.
    pub(super) left: i32,
    /// The first row.
    pub(super) top: i32,
    /// The column after the last.
    pub(super) right: i32,
    /// The row after the last.
    pub(super) bottom: i32,
}

impl LabelBox {
    fn overlaps(&self, other: &Self) -> bool {
        self.left < other.right
            && other.left < self.right
            && self.top < other.bottom
            && other.top < self.bottom
    }

    fn contains(&self, other: &Self) -> bool {
        self.left <= other.left
            && other.right <= self.right
            && self.top <= other.top
            && other.bottom <= self.bottom
    }

    /// The pixel in it that is nearest to a point.
    pub(super) fn nearest(&self, [x, y]: [i32; 2]) -> [i32; 2] {
        [x.clamp(self.left, self.right - 1), y.clamp(self.top, self.bottom - 1)]
    }

    /// The square of the distance to a point.
    pub(super) fn square_distance(&self, [x, y]: [i32; 2]) -> i32 {
        let [u, v] = self.nearest([x, y]);
        (u - x).pow(2) + (v - y).pow(2)
    }
}

/// How far a point reaches from its centre, with some air.
const REACH: i32 = 6;

/// How much farther, as a square of pixels, the usual position may be than another one: what
/// most labels keep to is found at a glance.
const ELSEWHERE: i32 = 100;

/// Labels to be put beside points.
#[derive(Clone, Copy, Debug)]
pub(super) struct LabelLayout<'a> {
    /// Points without a label, which no label may cover either.
    pub(super) others: &'a [[i32; 2]],
    /// What else no label may cover.
    pub(super) obstacles: &'a [LabelBox],
    /// The height of each label.
    pub(super) height: i32,
    /// Where labels may be.
    pub(super) area: LabelBox,
}

impl LabelLayout<'_> {
    /// The boxes of labels of these widths beside their points, in the order of the points: for each, from left to
    /// right, the nearest one in the area that is clear of all points, of obstacles and of the labels before.
    ///
    /// Where there is none, the label goes to the right of its point.
    pub(super) fn boxes(&self, points: &[[i32; 2]], widths: &[i32]) -> Vec<LabelBox> {
        let around = |&[x, y]: &[i32; 2]| LabelBox {
            left: x - REACH,
            top: y - REACH,
            right: x + REACH + 1,
            bottom: y + REACH + 1,
        };
        let mut occupied: Vec<LabelBox> = points.iter().chain(self.others).map(around).collect();
        occupied.extend(self.obstacles);
        let mut order: Vec<usize> = (0..points.len()).collect();
        order.sort_by_key(|&index| points[index]);
        let mut boxes: Vec<Option<LabelBox>> = vec![None; points.len()];
        for index in order {
            let label = self.free_box(points[index], widths[index], &occupied);
            occupied.push(label);
            boxes[index] = Some(label);
        }
        boxes.into_iter().flatten().collect()
    }

    /// The nearest box of a width that is clear of what is occupied.
    fn free_box(&self, point: [i32; 2], width: i32, occupied: &[LabelBox]) -> LabelBox {
        let (area, height) = (self.area, self.height);
        let label = |left: i32, top: i32| LabelBox { left, top, right: left + width, bottom: top + height };
        let is_free =
            |label: &LabelBox| area.contains(label) && !occupied.iter().any(|other| other.overlaps(label));
        let beside = label(point[0] + REACH + 2, point[1] - height / 2);
        let rows = (area.top..area.bottom).step_by(3);
        let columns = [beside.left, point[0] - REACH - 2 - width, point[0] - width / 2];
        let shifted = (area.left..area.right).step_by(9);
        let free = rows
            .flat_map(|top| columns.into_iter().chain(shifted.clone()).map(move |left| (left, top)))
            .map(|(left, top)| label(left, top))
            .chain([beside])
            .filter(is_free);
        let nearest = free.min_by_key(|label| {
            let elsewhere = if *label == beside { 0 } else { ELSEWHERE };
            // Lines mostly fall, and leave the upper right free.
            (label.square_distance(point) + elsewhere, label.top, Reverse(label.left))
        });
        nearest.unwrap_or(beside)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const AREA: LabelBox = LabelBox { left: 80, top: 40, right: 750, bottom: 420 };
    const LEGEND: LabelBox = LabelBox { left: 600, top: 50, right: 740, bottom: 120 };

    fn layout<'a>(others: &'a [[i32; 2]], obstacles: &'a [LabelBox]) -> LabelLayout<'a> {
        LabelLayout { others, obstacles, height: 14, area: AREA }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// Sixteen labels are more than most plots have; their points may lie all in one spot.
        #[test]
        fn no_label_covers_a_label_or_a_point(
            points in prop::collection::vec([80..750, 40..420], 1..16),
            others in prop::collection::vec([80..750, 40..420], 0..8),
            gathered in any::<bool>(),
            widths in prop::collection::vec(20..170, 16),
        ) {
            let near = |[x, y]: [i32; 2]| if gathered { [400 + x % 20, 200 + y % 20] } else { [x, y] };
            let points: Vec<[i32; 2]> = points.into_iter().map(near).collect();
            let boxes = layout(&others, &[LEGEND]).boxes(&points, &widths);
            prop_assert_eq!(boxes.len(), points.len());
            for (index, label) in boxes.iter().enumerate() {
                prop_assert!(AREA.contains(label), "{:?}", label);
                prop_assert_eq!(label.right - label.left, widths[index]);
                let covers = |[x, y]: [i32; 2]| label.square_distance([x, y]) == 0;
                let mut all = points.iter().chain(&others);
                prop_assert!(!all.any(|&point| covers(point)), "{:?} covers a point", label);
                let mut before = boxes[..index].iter().chain([&LEGEND]);
                prop_assert!(!before.any(|other| other.overlaps(label)), "{:?} covers a label", label);
            }
        }
    }

    #[test]
    fn a_label_with_free_space_is_to_the_right_of_its_point() {
        let boxes = layout(&[], &[]).boxes(&[[300, 200]], &[60]);
        assert_eq!(boxes, [LabelBox { left: 308, top: 193, right: 368, bottom: 207 }]);
    }
}
