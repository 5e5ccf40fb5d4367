//! The order in which an attribute's values are stored: that of a walk over the triangles.

use super::corners::{CornerTable, NONE, next, previous};
use crate::formats::gltf::stream::Broken;

/// The values of an attribute: one for each vertex of its table.
pub(super) struct Order {
    /// The corner at which each value was met first.
    pub(super) corners: Vec<u32>,
    /// The value of each vertex.
    pub(super) values: Vec<u32>,
}

/// How triangles are visited.
#[derive(Clone, Copy)]
pub(super) enum Visit {
    /// As far as possible, and then back.
    DepthFirst,
    /// First those whose last vertex has the most known neighbours.
    MostKnown,
}

/// Visits all triangles.
pub(super) fn find_order(table: &CornerTable, visit: Visit) -> Result<Order, Broken> {
    let mut visitor = Visitor {
        table,
        corners: Vec::with_capacity(table.first.len()),
        values: vec![NONE; table.first.len()],
        is_visited: vec![false; table.vertices.len() / 3],
    };
    let corners = (0..table.vertices.len() as u32).step_by(3);
    match visit {
        Visit::DepthFirst => {
            for corner in corners {
                visitor.go_deep(corner)?;
            }
        }
        Visit::MostKnown => {
            let mut waiting =
                Waiting { lists: Default::default(), best: 0, known: vec![0; table.first.len()] };
            for corner in corners {
                visitor.go_known(corner, &mut waiting)?;
            }
        }
    }
    Ok(Order { corners: visitor.corners, values: visitor.values })
}

struct Visitor<'t> {
    table: &'t CornerTable,
    corners: Vec<u32>,
    values: Vec<u32>,
    is_visited: Vec<bool>,
}

impl Visitor<'_> {
    /// Meets the vertex of a corner; returns whether it is new.
    fn meet(&mut self, corner: u32) -> Result<bool, Broken> {
        let vertex = self.table.vertex(corner);
        let value = self.values.get_mut(vertex as usize).ok_or("a corner has no vertex")?;
        let is_new = *value == NONE;
        if is_new {
            *value = self.corners.len() as u32;
            self.corners.push(corner);
        }
        Ok(is_new)
    }

    /// Whether the triangle of a corner is visited; that of none always is.
    fn is_visited(&self, corner: u32) -> bool {
        self.is_visited.get(corner as usize / 3).copied().unwrap_or(true)
    }

    fn go_deep(&mut self, start: u32) -> Result<(), Broken> {
        if self.is_visited(start) {
            return Ok(());
        }
        self.meet(next(start))?;
        self.meet(previous(start))?;
        let mut waiting = vec![start];
        while let Some(mut corner) = waiting.pop() {
            while !self.is_visited(corner) {
                self.is_visited[corner as usize / 3] = true;
                let is_new = self.meet(corner)?;
                let (left, right) = (self.table.left(corner), self.table.right(corner));
                corner = match (self.is_visited(left), self.is_visited(right)) {
                    // Nothing around a new vertex is visited.
                    _ if is_new && !self.table.is_on_boundary(self.table.vertex(corner)) => right,
                    (false, false) => {
                        waiting.push(left);
                        right
                    }
                    (false, true) => left,
                    _ => right,
                };
            }
        }
        Ok(())
    }

    fn go_known(&mut self, start: u32, waiting: &mut Waiting) -> Result<(), Broken> {
        waiting.lists[0].push(start);
        waiting.best = 0;
        self.meet(next(start))?;
        self.meet(previous(start))?;
        self.meet(start)?;
        while let Some(mut corner) = waiting.pop() {
            while !self.is_visited(corner) {
                self.is_visited[corner as usize / 3] = true;
                self.meet(corner)?;
                corner = self.choose(corner, waiting);
            }
        }
        Ok(())
    }

    /// The next corner after one, or [`NONE`] if a waiting one is better; the others wait.
    fn choose(&self, corner: u32, waiting: &mut Waiting) -> u32 {
        let (left, right) = (self.table.left(corner), self.table.right(corner));
        let is_right_visited = self.is_visited(right);
        if !self.is_visited(left) {
            let priority = self.priority(left, waiting);
            if is_right_visited && priority <= waiting.best {
                return left;
            }
            waiting.push(left, priority);
        }
        if !is_right_visited {
            let priority = self.priority(right, waiting);
            if priority <= waiting.best {
                return right;
            }
            waiting.push(right, priority);
        }
        NONE
    }

    /// 0 is the best.
    fn priority(&self, corner: u32, waiting: &mut Waiting) -> usize {
        let vertex = self.table.vertex(corner) as usize;
        let is_met = self.values.get(vertex).is_none_or(|&value| value != NONE);
        if is_met {
            return 0;
        }
        waiting.known[vertex] += 1;
        if waiting.known[vertex] > 1 { 1 } else { 2 }
    }
}

/// Corners whose triangles wait to be visited.
struct Waiting {
    /// By priority, the best first.
    lists: [Vec<u32>; 3],
    /// No list before this one has corners.
    best: usize,
    /// How often each vertex was beside a visited triangle before it was met.
    known: Vec<u32>,
}

impl Waiting {
    fn push(&mut self, corner: u32, priority: usize) {
        self.lists[priority].push(corner);
        self.best = self.best.min(priority);
    }

    fn pop(&mut self) -> Option<u32> {
        let list = (self.best..self.lists.len()).find(|&list| !self.lists[list].is_empty())?;
        self.best = list;
        self.lists[list].pop()
    }
}
