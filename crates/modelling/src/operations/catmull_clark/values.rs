//! Attributes of vertices and corners after a level.

use smallvec::SmallVec;

use super::fill;
use super::numbers::Numbers;
use crate::edit_mesh::EditMesh;
use crate::ids::FaceId;
use crate::layers::{Blend, Layer, LayerKind, LayerValues};

impl EditMesh {
    /// Writes positions and all layers anew; records are the old ones still.
    pub(super) fn refine_values(&mut self, numbers: &Numbers) {
        let positions = self.refined_points(numbers, self.positions.values());
        let is_unmoved = self.first_positions == self.positions;
        let first_positions = if is_unmoved {
            positions.clone()
        } else {
            self.refined_points(numbers, self.first_positions.values())
        };
        self.positions.replace(positions);
        self.first_positions.replace(first_positions);
        // A layer's values follow from its own old ones and the records.
        let mut layers = std::mem::take(&mut self.vertex_layers);
        for layer in &mut layers {
            self.refine_vertex_layer(numbers, layer);
        }
        self.vertex_layers = layers;
        let mut layers = std::mem::take(&mut self.corner_layers);
        for layer in &mut layers {
            self.refine_corner_layer(numbers, layer);
        }
        self.corner_layers = layers;
    }

    fn refine_vertex_layer(&self, numbers: &Numbers, layer: &mut Layer) {
        match &mut layer.values {
            LayerValues::Vec3(column) => {
                let values = self.refined_points(numbers, column.values());
                column.replace(values);
            }
            LayerValues::Vec2(column) => {
                let values = self.interpolated_at_vertices(numbers, column.values());
                column.replace(values);
            }
            LayerValues::Vec4(column) => {
                let values = self.interpolated_at_vertices(numbers, column.values());
                column.replace(values);
            }
            LayerValues::Influences(column) => {
                let values = self.interpolated_at_vertices(numbers, column.values());
                column.replace(values);
            }
            LayerValues::Pins(column) => {
                let values = self.interpolated_at_vertices(numbers, column.values());
                column.replace(values);
            }
            LayerValues::Weights(column) => {
                let values = self.interpolated_at_vertices(numbers, column.values());
                column.replace(values);
            }
        }
    }

    /// The old values, and means at new vertices.
    fn interpolated_at_vertices<T: Blend + Send + Sync>(&self, numbers: &Numbers, old: &[T]) -> Vec<T> {
        fill(numbers.vertex_total(), |index| {
            if index < numbers.vertices {
                return old[index as usize];
            }
            let number = index - numbers.vertices;
            if number < numbers.edges.count() {
                let ends = self.edges[numbers.edges.index(number)].vertices;
                return T::blend(&ends.map(|vertex| (old[vertex as usize], 0.5)));
            }
            let face = FaceId(numbers.faces.index(number - numbers.edges.count()));
            mean(self.face_vertices(face).map(|vertex| old[vertex.0 as usize]))
        })
    }

    fn refine_corner_layer(&self, numbers: &Numbers, layer: &mut Layer) {
        let kind = layer.kind;
        match &mut layer.values {
            LayerValues::Vec2(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
            LayerValues::Vec3(column) if kind == LayerKind::Normal => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| {
                    mean.as_dvec3().normalize_or_zero().as_vec3()
                });
                column.replace(values);
            }
            LayerValues::Vec3(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
            LayerValues::Vec4(column) if kind == LayerKind::Tangent => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, first| {
                    mean.truncate().as_dvec3().normalize_or_zero().as_vec3().extend(first.w)
                });
                column.replace(values);
            }
            LayerValues::Vec4(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
            LayerValues::Influences(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
            LayerValues::Pins(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
            LayerValues::Weights(column) => {
                let values = self.interpolated_at_corners(numbers, column.values(), |mean, _| mean);
                column.replace(values);
            }
        }
    }

    /// The old values, and means at new corners. `mend` gets a mean and the first value in it.
    fn interpolated_at_corners<T: Blend + Send + Sync>(
        &self,
        numbers: &Numbers,
        old: &[T],
        mend: impl Fn(T, T) -> T + Send + Sync,
    ) -> Vec<T> {
        let in_faces = fill(numbers.faces.count(), |rank| {
            let corners = self.face_corners(FaceId(numbers.faces.index(rank)));
            let first = old[self.faces[numbers.faces.index(rank)].corner as usize];
            mend(mean(corners.map(|corner| old[corner.0 as usize])), first)
        });
        let on_side = |from: u32, to: u32| {
            let [first, second] = [old[from as usize], old[to as usize]];
            mend(T::blend(&[(first, 0.5), (second, 0.5)]), first)
        };
        fill(numbers.corner_total(), |index| {
            if index < numbers.corners.capacity() {
                return old[index as usize];
            }
            let number = index - numbers.corners.capacity();
            let corner = numbers.corners.index(number / 3);
            let record = &self.corners[corner];
            match number % 3 {
                0 => on_side(corner, record.next),
                1 => in_faces[numbers.faces.rank(record.face) as usize],
                _ => on_side(record.previous, corner),
            }
        })
    }
}

/// The mean of some values.
fn mean<T: Blend>(values: impl IntoIterator<Item = T>) -> T {
    let mut parts: SmallVec<[(T, f64); 4]> = values.into_iter().map(|value| (value, 0.0)).collect();
    let share = 1.0 / parts.len() as f64;
    parts.iter_mut().for_each(|(_, weight)| *weight = share);
    T::blend(&parts)
}
