//! Visits the pixels and fills in the requested outputs.

use trigon_camera::{Camera, FisheyeLens, FisheyeRay, Projector};
use trigon_math::{DVec2, DVec3, Vec2, Vec3};
use trigon_raster::Rasterizer;

use super::VisibleIds;
use super::facet::Beam;
use super::source::{ObjectSource, Point, Triangle};
use crate::frame::Frame;
use crate::prepare::PreparedScene;

/// Rows per task: enough to be worth a worker's while.
const ROWS: usize = 8;

/// Computes everything that is derived from the visible triangles. `sample` is the sample position
/// in each pixel.
pub(crate) fn fill(
    frame: &mut Frame,
    prepared: &PreparedScene<'_>,
    sample: [f64; 2],
    ids: &VisibleIds,
    rasterizer: &Rasterizer,
) {
    let Some(lens) = Lens::new(prepared, sample) else { return };
    let width = frame.width as usize;
    let sources: Vec<Option<ObjectSource<'_>>> = sources(prepared, &ids.objects);
    let pieces: Vec<Strip<'_>> = Strip::cut(frame, width * ROWS, prepared.lens.is_some());
    rasterizer.share(pieces.into_iter().enumerate(), |(number, mut piece)| {
        piece.fill(&lens, &sources, ids, width, number * width * ROWS);
    });
}

/// The visible objects, by their indices.
fn sources<'s>(prepared: &'s PreparedScene<'_>, objects: &[u32]) -> Vec<Option<ObjectSource<'s>>> {
    let scene = prepared.scene;
    let mut is_visible = vec![false; scene.nodes().index_bound()];
    for &object in objects.iter().filter(|&&object| object != u32::MAX) {
        is_visible[object as usize] = true;
    }
    let mut sources: Vec<Option<ObjectSource<'_>>> = Vec::new();
    sources.resize_with(is_visible.len(), || None);
    for (id, node) in scene.nodes().iter().filter(|(id, _)| is_visible[id.index()]) {
        let Some(shape) = prepared.shapes.get(id.index()) else { continue };
        let Some(asset) = node.mesh.and_then(|mesh| scene.meshes().get(mesh)) else { continue };
        sources[id.index()] = Some(ObjectSource::new(prepared, node, shape, asset.mesh()));
    }
    sources
}

/// From pixels to rays, and from camera space to the world.
struct Lens {
    beam: Beam,
    camera: Camera,
    origin: DVec3,
    rays: PixelRays,
}

/// The rays through the samples of pixels.
enum PixelRays {
    /// Of an image on a plane: that of the first pixel, and its change per pixel to the right, and downwards.
    Plane { first: DVec3, steps: [DVec3; 2] },
    /// Through a lens, at this position in each pixel.
    Lens(FisheyeLens, DVec2),
}

impl Lens {
    /// `None` for an image without pixels.
    fn new(prepared: &PreparedScene<'_>, sample: [f64; 2]) -> Option<Self> {
        let camera = prepared.camera;
        let beam = if camera.projection.is_orthographic() { Beam::Parallel } else { Beam::Central };
        let rays = match prepared.lens {
            Some(lens) => PixelRays::Lens(lens, DVec2::from_array(sample)),
            None => PixelRays::of_plane(prepared, sample)?,
        };
        Some(Self { beam, camera: *camera, origin: prepared.settings.outputs.origin, rays })
    }

    /// The ray of a pixel, of any length, and its change per pixel; `None` beyond a fisheye lens.
    fn ray(&self, x: usize, y: usize) -> Option<FisheyeRay> {
        match &self.rays {
            PixelRays::Plane { first, steps } => {
                let direction = *first + steps[0] * x as f64 + steps[1] * y as f64;
                Some(FisheyeRay { direction, steps: *steps })
            }
            PixelRays::Lens(lens, sample) => lens.ray_with_steps(DVec2::new(x as f64, y as f64) + *sample),
        }
    }

    /// A point of camera space as the position output stores it.
    fn world_position(&self, point: DVec3) -> Vec3 {
        (self.camera.orientation * point + (self.camera.position - self.origin)).as_vec3()
    }
}

impl PixelRays {
    fn of_plane(prepared: &PreparedScene<'_>, sample: [f64; 2]) -> Option<Self> {
        let viewport = prepared.settings.viewport();
        let before = Camera { projection: prepared.camera.projection, ..Camera::default() };
        let projector = Projector::new(&before, viewport);
        let ray = |x, y| projector.at_distance(DVec2::new(x, y), 1.0);
        let corner = ray(0.0, 0.0)?;
        let DVec2 { x: width, y: height } = viewport.size();
        // Computed from the whole image's span, so that one pixel's is as exact as possible.
        let [right, down] = [ray(width, 0.0)?, ray(0.0, height)?];
        let steps = [(right - corner) / width, (down - corner) / height];
        Some(Self::Plane { first: corner + steps[0] * sample[0] + steps[1] * sample[1], steps })
    }
}

/// Some rows of the outputs; empty if not requested.
struct Strip<'f> {
    length: usize,
    /// From the eye, where the rasterizer has not stored depths.
    distances: &'f mut [f32],
    material_ids: &'f mut [u32],
    triangle_ids: &'f mut [u32],
    barycentrics: &'f mut [Vec3],
    positions: &'f mut [Vec3],
    normals: &'f mut [Vec3],
    geometric_normals: &'f mut [Vec3],
    uvs: &'f mut [Vec2],
    albedo: &'f mut [Vec3],
}

impl<'f> Strip<'f> {
    fn cut(frame: &'f mut Frame, size: usize, fills_depth: bool) -> Vec<Self> {
        let pixels = frame.width as usize * frame.height as usize;
        let depth = frame.depth.as_deref_mut().filter(|_| fills_depth).unwrap_or_default();
        let mut distances = depth.chunks_mut(size);
        let mut material_ids = chunks(&mut frame.material_ids, size);
        let mut triangle_ids = chunks(&mut frame.triangle_ids, size);
        let mut barycentrics = chunks(&mut frame.barycentrics, size);
        let mut positions = chunks(&mut frame.positions, size);
        let mut normals = chunks(&mut frame.normals, size);
        let mut geometric_normals = chunks(&mut frame.geometric_normals, size);
        let mut uvs = chunks(&mut frame.uvs, size);
        let mut albedo = chunks(&mut frame.albedo, size);
        let piece = |start: usize| Self {
            length: size.min(pixels - start),
            distances: distances.next().unwrap_or_default(),
            material_ids: material_ids.next().unwrap_or_default(),
            triangle_ids: triangle_ids.next().unwrap_or_default(),
            barycentrics: barycentrics.next().unwrap_or_default(),
            positions: positions.next().unwrap_or_default(),
            normals: normals.next().unwrap_or_default(),
            geometric_normals: geometric_normals.next().unwrap_or_default(),
            uvs: uvs.next().unwrap_or_default(),
            albedo: albedo.next().unwrap_or_default(),
        };
        (0..pixels).step_by(size).map(piece).collect()
    }

    fn fill(
        &mut self,
        lens: &Lens,
        sources: &[Option<ObjectSource<'_>>],
        ids: &VisibleIds,
        width: usize,
        start: usize,
    ) {
        // Neighbours mostly show the same triangle.
        let mut last: Option<([u32; 3], Option<Triangle<'_>>)> = None;
        for at in 0..self.length {
            let pixel = start + at;
            let visible @ [object, face, number] =
                [ids.objects[pixel], ids.faces[pixel], ids.triangles[pixel]];
            if last.is_none_or(|(known, _)| known != visible) {
                let source = sources.get(object as usize).and_then(Option::as_ref);
                last = Some((visible, source.and_then(|source| source.triangle(face, number, lens.beam))));
            }
            match last {
                Some((_, Some(triangle))) => self.put(at, &triangle, lens, [pixel % width, pixel / width]),
                _ => self.clear(at),
            }
        }
    }

    fn put(&mut self, at: usize, triangle: &Triangle<'_>, lens: &Lens, [x, y]: [usize; 2]) {
        let facet = &triangle.facet;
        let Some(FisheyeRay { direction: ray, steps }) = lens.ray(x, y) else { return self.clear(at) };
        let weights = facet.weights(ray);
        let slopes = steps.map(|step| facet.slope(ray, weights, step));
        let point = Point { weights, slopes };
        let to_world = |normal: DVec3| (lens.camera.orientation * normal).as_vec3();
        put(self.distances, at, || facet.at(weights).length() as f32);
        put(self.material_ids, at, || triangle.material());
        put(self.triangle_ids, at, || triangle.index());
        put(self.barycentrics, at, || weights.as_vec3());
        put(self.positions, at, || lens.world_position(facet.at(weights)));
        put(self.normals, at, || triangle.normal(&point));
        put(self.geometric_normals, at, || to_world(triangle.plane_normal()));
        put(self.uvs, at, || triangle.uv(weights));
        put(self.albedo, at, || triangle.albedo(&point));
    }

    /// Background, or an object without faces.
    fn clear(&mut self, at: usize) {
        for ids in [&mut *self.material_ids, self.triangle_ids] {
            put(ids, at, || u32::MAX);
        }
        for vectors in
            [&mut *self.barycentrics, self.positions, self.normals, self.geometric_normals, self.albedo]
        {
            put(vectors, at, || Vec3::ZERO);
        }
        put(self.uvs, at, || Vec2::ZERO);
        put(self.distances, at, || f32::INFINITY);
    }
}

fn chunks<T>(list: &mut Option<Vec<T>>, size: usize) -> std::slice::ChunksMut<'_, T> {
    list.as_deref_mut().unwrap_or_default().chunks_mut(size)
}

/// Stores a value if its output is requested.
fn put<T>(list: &mut [T], at: usize, value: impl FnOnce() -> T) {
    if let Some(slot) = list.get_mut(at) {
        *slot = value();
    }
}
