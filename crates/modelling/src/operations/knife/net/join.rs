//! Joins lines of a net to the outline, so that all parts are simple polygons.
//!
//! A loop within the face gets two lines to what is around it, as in Blender. In general, a part visits a point twice
//! where removing the point would cut lines off from the outline; these then get another line, past the point.

use fixedbitset::FixedBitSet;

use super::FaceNet;
use super::line;

/// Most pairs of points between which the shortest free line is looked for.
const MOST_PAIRS: usize = 4_000_000;

impl FaceNet {
    /// Adds lines until each part visits each of its points once. `None` if there are too many points.
    pub(super) fn join_all(&mut self) -> Option<()> {
        while let Some(island) = self.island() {
            self.join_island(&island)?;
        }
        while let Some(hanging) = self.hanging() {
            let beyond = self.all_but(&hanging.root);
            let new = match self.shortest(&hanging.leaf, &beyond)? {
                Some(new) => new,
                None => self.shortest(&hanging.leaf, &self.all_but(&hanging.around_leaf))??,
            };
            self.lines.insert(new);
        }
        Some(())
    }

    /// The points of lines that are not connected to the outline: those connected to the first such point.
    fn island(&self) -> Option<FixedBitSet> {
        let neighbors = self.neighbors();
        let reached = reach(&neighbors, 0, None);
        let is_lost = |&point: &usize| !neighbors[point].is_empty() && !reached.contains(point);
        let first = (0..neighbors.len()).find(is_lost)?;
        Some(reach(&neighbors, first, None))
    }

    /// By the shortest line, and by the shortest one between two other points.
    fn join_island(&mut self, island: &FixedBitSet) -> Option<()> {
        let mut beyond = self.all_but(island);
        let [a, b] = self.shortest(island, &beyond)??;
        self.lines.insert([a, b]);
        let mut rest = island.clone();
        for point in [a, b] {
            rest.set(point as usize, false);
            beyond.set(point as usize, false);
        }
        if let Some(second) = self.shortest(&rest, &beyond)? {
            self.lines.insert(second);
        }
        Some(())
    }

    /// All points at which something is, but for some.
    fn all_but(&self, left_out: &FixedBitSet) -> FixedBitSet {
        let mut all = FixedBitSet::with_capacity(self.flat.len());
        all.insert_range(..self.outline);
        self.lines.iter().flatten().for_each(|&point| all.insert(point as usize));
        all.difference_with(left_out);
        all
    }

    /// The shortest free line from some points to others, if there is one. `None` if there are too many pairs.
    fn shortest(&self, from: &FixedBitSet, to: &FixedBitSet) -> Option<Option<[u32; 2]>> {
        if from.count_ones(..).saturating_mul(to.count_ones(..)) > MOST_PAIRS {
            return None;
        }
        let mut pairs: Vec<(f64, [u32; 2])> = Vec::new();
        for a in from.ones() {
            let own = self.points[a].position.as_dvec3();
            let length = |b: usize| self.points[b].position.as_dvec3().distance_squared(own);
            pairs.extend(to.ones().filter_map(|b| Some((length(b), line(a as u32, b as u32)?))));
        }
        pairs.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        Some(pairs.into_iter().map(|(_, pair)| pair).find(|&pair| self.is_free(pair)))
    }

    /// What hangs at a point: nothing if each part visits each of its points once.
    fn hanging(&self) -> Option<Hanging> {
        let neighbors = self.neighbors();
        let cut_points = self.points_visited_twice();
        let start = |without: usize| usize::from(without == 0);
        let hanging_at = |&point: &usize| {
            let mut hanging = self.all_but(&reach(&neighbors, start(point), Some(point)));
            hanging.set(point, false);
            (hanging, point)
        };
        let all: Vec<(FixedBitSet, usize)> = cut_points.iter().map(hanging_at).collect();
        let is_some = |(hanging, _): &&(FixedBitSet, usize)| hanging.count_ones(..) > 0;
        let (leaf, at) = all.iter().filter(is_some).min_by_key(|(hanging, _)| hanging.count_ones(..))?;
        let around = all.iter().filter(|(hanging, _)| leaf.is_subset(hanging));
        let (root, root_at) = around.max_by_key(|(hanging, _)| hanging.count_ones(..))?;
        let with = |set: &FixedBitSet, point: usize| {
            let mut set = set.clone();
            set.insert(point);
            set
        };
        Some(Hanging { leaf: leaf.clone(), around_leaf: with(leaf, *at), root: with(root, *root_at) })
    }

    fn points_visited_twice(&self) -> Vec<usize> {
        let mut twice = FixedBitSet::with_capacity(self.flat.len());
        let mut visited = FixedBitSet::with_capacity(self.flat.len());
        for walk in self.trace() {
            visited.clear();
            for point in walk {
                if visited.put(point as usize) {
                    twice.insert(point as usize);
                }
            }
        }
        twice.ones().collect()
    }
}

/// Lines that only one point connects to the outline.
struct Hanging {
    /// The fewest points that one point cuts off.
    leaf: FixedBitSet,
    /// With that point.
    around_leaf: FixedBitSet,
    /// The most points that one point cuts off together with the leaf, and that point.
    root: FixedBitSet,
}

/// The points that are connected to one, without going through another.
fn reach(neighbors: &[Vec<u32>], start: usize, without: Option<usize>) -> FixedBitSet {
    let mut reached = FixedBitSet::with_capacity(neighbors.len());
    reached.insert(start);
    let mut waiting = vec![start];
    while let Some(here) = waiting.pop() {
        for &next in &neighbors[here] {
            let next = next as usize;
            if Some(next) != without && !reached.put(next) {
                waiting.push(next);
            }
        }
    }
    reached
}
