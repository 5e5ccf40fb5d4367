//! The order in which the unknowns of a sparse system are eliminated, so that few new entries arise: nested
//! dissection (A. George, *Nested dissection of a regular finite element mesh*, 1973), with levels of a search in
//! breadth as separators (A. George and J. Liu, *Computer Solution of Large Sparse Positive Definite Systems*,
//! 1981, section 8.3).

use super::lists::SortedLists;

/// Who is next to whom.
pub(super) struct Graph {
    neighbors: SortedLists,
}

impl Graph {
    /// The graph of undirected edges, each given at least once, in either direction.
    pub(super) fn new(nodes: usize, edges: impl Iterator<Item = [u32; 2]> + Clone) -> Self {
        let both = edges.filter(|[a, b]| a != b).flat_map(|[a, b]| [[a, b], [b, a]]);
        Self { neighbors: SortedLists::new(nodes, both) }
    }

    pub(super) fn neighbors(&self, node: u32) -> &[u32] {
        self.neighbors.list(node as usize)
    }

    fn nodes(&self) -> usize {
        self.neighbors.count()
    }
}

/// Parts of at most this many nodes are not divided.
const SMALL: usize = 48;

/// The nodes in the order of elimination.
pub(super) fn elimination_order(graph: &Graph) -> Vec<u32> {
    let count = graph.nodes();
    // Nodes with very many neighbours go last, as in AMD (P. Amestoy, T. Davis and I. Duff, 1996): each would make
    // all its neighbours depend on one another.
    let most = 16.max(10 * (count as f64).sqrt() as usize);
    let is_hub = |&node: &u32| graph.neighbors(node).len() > most;
    let (hubs, others): (Vec<u32>, Vec<u32>) = (0..count as u32).partition(is_hub);
    let mut search = LevelSearch { graph, part: vec![0; count], next_part: 0 };
    let mut order = vec![0; count];
    order[others.len()..].copy_from_slice(&hubs);
    let end = others.len();
    let mut waiting = vec![Waiting { nodes: others, end }];
    while let Some(Waiting { nodes, end }) = waiting.pop() {
        if nodes.len() <= SMALL {
            order[end - nodes.len()..end].copy_from_slice(&nodes);
            continue;
        }
        let divided = search.divide(&nodes);
        let before = end - divided.separator.len();
        order[before..end].copy_from_slice(&divided.separator);
        let first_end = before - divided.second.len();
        waiting.push(Waiting { nodes: divided.first, end: first_end });
        waiting.push(Waiting { nodes: divided.second, end: before });
    }
    order
}

/// Nodes that come before a position of the order.
struct Waiting {
    nodes: Vec<u32>,
    end: usize,
}

/// Two parts that nothing but the separator joins.
struct Dissection {
    first: Vec<u32>,
    second: Vec<u32>,
    separator: Vec<u32>,
}

/// Searches in breadth within parts of the graph.
struct LevelSearch<'g> {
    graph: &'g Graph,
    /// By node: the number of the last part or search that it belonged to.
    part: Vec<u32>,
    next_part: u32,
}

impl LevelSearch<'_> {
    fn divide(&mut self, nodes: &[u32]) -> Dissection {
        let mut levels = self.levels(nodes, nodes[0]);
        // From the far end there are more levels, so that they are smaller.
        let far = *levels.nodes.last().expect("the first node is in it");
        if levels.nodes.len() == nodes.len() {
            levels = self.levels(nodes, far);
        }
        if levels.nodes.len() < nodes.len() {
            // Another component: nothing separates them.
            let reached = self.next_part;
            let second = nodes.iter().copied().filter(|&node| self.part[node as usize] != reached).collect();
            return Dissection { first: levels.nodes, second, separator: Vec::new() };
        }
        let separator = levels.smallest_in_the_middle();
        let (first, rest) = levels.nodes.split_at(separator.start);
        let (separator, second) = rest.split_at(separator.len());
        Dissection { first: first.to_vec(), second: second.to_vec(), separator: separator.to_vec() }
    }

    /// The nodes that can be reached from one of them, by distance.
    fn levels(&mut self, nodes: &[u32], from: u32) -> Levels {
        let inside = self.next_part + 1;
        let reached = self.next_part + 2;
        self.next_part = reached;
        nodes.iter().for_each(|&node| self.part[node as usize] = inside);
        self.part[from as usize] = reached;
        let mut found = vec![from];
        let mut starts = vec![0];
        let mut first = 0;
        while first < found.len() {
            let end = found.len();
            starts.push(end);
            for position in first..end {
                for &neighbor in self.graph.neighbors(found[position]) {
                    if self.part[neighbor as usize] == inside {
                        self.part[neighbor as usize] = reached;
                        found.push(neighbor);
                    }
                }
            }
            first = end;
        }
        Levels { nodes: found, starts }
    }
}

/// Nodes by distance from one of them.
struct Levels {
    nodes: Vec<u32>,
    /// Where each level begins; one entry more.
    starts: Vec<usize>,
}

impl Levels {
    /// The smallest level with at least a quarter of the nodes on either side; the middle one if there is none.
    fn smallest_in_the_middle(&self) -> std::ops::Range<usize> {
        let count = self.nodes.len();
        let level = |pair: &[usize]| pair[0]..pair[1];
        let is_central =
            |level: &std::ops::Range<usize>| level.start >= count / 4 && count - level.end >= count / 4;
        let levels = || self.starts.windows(2).map(level);
        levels()
            .filter(is_central)
            .min_by_key(std::ops::Range::len)
            .or_else(|| levels().find(|level| level.end > count / 2))
            .unwrap_or(0..count)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn grid(side: u32) -> Graph {
        let node = |x, y| y * side + x;
        let edges = (0..side).flat_map(move |y| (0..side).map(move |x| [x, y]));
        let edges = edges.flat_map(move |[x, y]| {
            let right = (x + 1 < side).then(|| [node(x, y), node(x + 1, y)]);
            let down = (y + 1 < side).then(|| [node(x, y), node(x, y + 1)]);
            [right, down].into_iter().flatten()
        });
        Graph::new((side * side) as usize, edges)
    }

    /// How many entries a factor has below its diagonal: what elimination joins, by its definition.
    fn fill(graph: &Graph, order: &[u32]) -> usize {
        let mut neighbors: Vec<std::collections::BTreeSet<u32>> =
            (0..order.len() as u32).map(|node| graph.neighbors(node).iter().copied().collect()).collect();
        let mut entries = 0;
        for &node in order {
            let later: Vec<u32> = std::mem::take(&mut neighbors[node as usize]).into_iter().collect();
            entries += later.len();
            for &a in &later {
                neighbors[a as usize].remove(&node);
                neighbors[a as usize].extend(later.iter().copied().filter(|&b| b != a));
            }
        }
        entries
    }

    #[test]
    fn every_node_is_eliminated_once_whatever_the_graph() {
        let star = Graph::new(5000, (1..5000).map(|leaf| [0, leaf]));
        let two = Graph::new(300, (0..298).map(|node| [node, node + 2]));
        for graph in [grid(30), star, two, Graph::new(100, std::iter::empty())] {
            let mut order = elimination_order(&graph);
            order.sort_unstable();
            assert!(order.iter().enumerate().all(|(i, &node)| i == node as usize), "a permutation");
        }
    }

    #[test]
    fn a_grid_fills_little_and_a_wheel_none() {
        let grid = grid(40);
        let natural: Vec<u32> = (0..1600).collect();
        let dissected = fill(&grid, &elimination_order(&grid));
        assert!(2 * dissected < fill(&grid, &natural), "{dissected} of {}", fill(&grid, &natural));
        let wheel = Graph::new(2001, (1..2001).flat_map(|rim| [[0, rim], [rim, rim % 2000 + 1]]));
        assert!(fill(&wheel, &elimination_order(&wheel)) < 8 * 2001, "its hub goes last");
    }
}
