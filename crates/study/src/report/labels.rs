//! Positions of the labels in a plot: next to their points, without overlapping each other or any point.

/// A rectangle in whole pixels: its left, top, right and lower edge, the last two outside.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Area {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) right: i32,
    pub(super) bottom: i32,
}

impl Area {
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
    fn distance(&self, [x, y]: [i32; 2]) -> i32 {
        let [u, v] = self.nearest([x, y]);
        (u - x).pow(2) + (v - y).pow(2)
    }
}

/// How far a point reaches from its centre, with some air.
const REACH: i32 = 6;

/// How much farther, as a square of pixels, the usual place may be than another one: what
/// most labels keep to is found at a glance.
const ELSEWHERE: i32 = 100;

/// The places of labels of these widths and this height beside their points, in the order of
/// the points: for each, from left to right, the nearest place in `area` that is clear of all
/// points and of the labels before.
///
/// Where there is no such place the label goes to the right of its point.
pub(super) fn place(points: &[[i32; 2]], widths: &[i32], height: i32, area: Area) -> Vec<Area> {
    let around = |[x, y]: [i32; 2]| Area {
        left: x - REACH,
        top: y - REACH,
        right: x + REACH + 1,
        bottom: y + REACH + 1,
    };
    let obstacles: Vec<Area> = points.iter().map(|&point| around(point)).collect();
    let mut order: Vec<usize> = (0..points.len()).collect();
    order.sort_by_key(|&index| points[index]);
    let mut places: Vec<Option<Area>> = vec![None; points.len()];
    for index in order {
        let (point, width) = (points[index], widths[index]);
        let label = |left: i32, top: i32| Area { left, top, right: left + width, bottom: top + height };
        let is_free = |label: &Area| {
            area.contains(label)
                && !obstacles.iter().chain(places.iter().flatten()).any(|other| other.overlaps(label))
        };
        let beside = label(point[0] + REACH + 2, point[1] - height / 2);
        let rows = (area.top..area.bottom).step_by(3);
        let columns = [beside.left, point[0] - REACH - 2 - width, point[0] - width / 2];
        let shifted = (area.left..area.right).step_by(9);
        let best = rows
            .flat_map(|top| columns.into_iter().chain(shifted.clone()).map(move |left| (left, top)))
            .map(|(left, top)| label(left, top))
            .chain([beside])
            .filter(is_free)
            .min_by_key(|label| {
                let elsewhere = if *label == beside { 0 } else { ELSEWHERE };
                (label.distance(point) + elsewhere, label.top, label.left)
            });
        places[index] = Some(best.unwrap_or(beside));
    }
    places.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    const AREA: Area = Area { left: 80, top: 40, right: 750, bottom: 420 };

    proptest! {
        /// Sixteen variants are more than any plot has; they may lie all in one place.
        #[test]
        fn no_label_covers_a_label_or_a_point(
            points in prop::collection::vec([80..750, 40..420], 1..16),
            gathered in any::<bool>(),
            widths in prop::collection::vec(20..170, 16),
        ) {
            let near = |[x, y]: [i32; 2]| if gathered { [400 + x % 20, 200 + y % 20] } else { [x, y] };
            let points: Vec<[i32; 2]> = points.into_iter().map(near).collect();
            let places = place(&points, &widths, 14, AREA);
            prop_assert_eq!(places.len(), points.len());
            for (index, label) in places.iter().enumerate() {
                prop_assert!(AREA.contains(label), "{:?}", label);
                prop_assert_eq!(label.right - label.left, widths[index]);
                let covers = |[x, y]: [i32; 2]| label.distance([x, y]) == 0;
                prop_assert!(!points.iter().any(|&point| covers(point)), "{:?} covers a point", label);
                let others = places[..index].iter();
                prop_assert!(!others.clone().any(|other| other.overlaps(label)), "{:?} covers a label", label);
            }
        }
    }

    #[test]
    fn a_label_with_room_is_to_the_right_of_its_point() {
        let places = place(&[[300, 200]], &[60], 14, AREA);
        assert_eq!(places, [Area { left: 308, top: 193, right: 368, bottom: 207 }]);
    }
}
