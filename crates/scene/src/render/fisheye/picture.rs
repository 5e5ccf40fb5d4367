//! Colours and ids of pixels from what the rays of their samples meet.

use trigon_math::{DVec2, UVec2, Vec4};
use trigon_raster::{BlendMode, PointScratch, Rasterizer};

use super::tracer::{EyeFragment, EyeSample, Tracer};
use crate::outputs::VisibleIds;
use crate::prepare::Backdrop;
use crate::settings::RenderSettings;

/// Pixels per task: enough to be worth a worker's while, and few enough that their samples fit into its cache.
const PIECE: usize = 256;

/// The samples of each pixel, on a grid.
#[derive(Clone, Copy)]
pub(in crate::render) struct SampleGrid {
    pub(super) axis: u32,
    width: usize,
}

impl SampleGrid {
    /// Those of multisampling lie on a grid that has at least as many.
    pub(in crate::render) fn new(settings: &RenderSettings) -> Self {
        let multisampling = (1..=4).find(|side| side * side >= settings.samples).unwrap_or(4);
        Self { axis: settings.samples_per_axis * multisampling, width: settings.width as usize }
    }

    /// The position of depth and ids in each pixel: the middle, or with an even number to the right and below of it.
    pub(in crate::render) fn visibility_sample(self) -> [f64; 2] {
        [(f64::from(self.axis / 2) + 0.5) / f64::from(self.axis); 2]
    }

    fn per_pixel(self) -> usize {
        (self.axis * self.axis) as usize
    }

    fn pixel(self, number: usize) -> [u32; 2] {
        [(number % self.width) as u32, (number / self.width) as u32]
    }
}

impl Tracer<'_> {
    /// The light of all pixels, premultiplied, on a background.
    pub(in crate::render) fn paint(&self, pixels: &mut [Vec4], backdrop: &Backdrop, rasterizer: &Rasterizer) {
        rasterizer.share(pixels.chunks_mut(PIECE).enumerate(), |(number, piece)| {
            self.paint_piece(number * PIECE, piece, backdrop);
        });
    }

    fn paint_piece(&self, first: usize, pixels: &mut [Vec4], backdrop: &Backdrop) {
        let per_pixel = self.grid.per_pixel();
        let samples: Vec<EyeSample> = (0..pixels.len() * per_pixel)
            .filter_map(|slot| {
                let (at, number) = ((slot % per_pixel) as u32, first + slot / per_pixel);
                self.sample(slot, number, [at % self.grid.axis, at / self.grid.axis])
            })
            .collect();
        let mut scratch = PointScratch::default();
        let fragments = self.fragments(&samples, &mut scratch);
        let colors = self.shaded(&fragments, &mut scratch);
        self.count(fragments.len());
        let behind = |slot: usize| backdrop.at(UVec2::from_array(self.grid.pixel(first + slot)));
        let mut light: Vec<Vec4> =
            (0..pixels.len()).flat_map(|slot| std::iter::repeat_n(behind(slot), per_pixel)).collect();
        // Of each sample the last one is the farthest.
        for (fragment, color) in fragments.iter().zip(colors).rev() {
            let (color, below) = (Vec4::from_array(color), &mut light[samples[fragment.index].slot]);
            *below = match self.run(fragment.run).blend_mode == BlendMode::Translucent {
                true => color + *below * (1.0 - color.w),
                false => color,
            };
        }
        for (pixel, light) in pixels.iter_mut().zip(light.chunks_exact(per_pixel)) {
            *pixel = mean(light);
        }
    }

    /// A sample of a pixel, by its column and row there; `None` beyond the lens.
    fn sample(&self, slot: usize, pixel: usize, [column, row]: [u32; 2]) -> Option<EyeSample> {
        let (axis, [x, y]) = (self.grid.axis, self.grid.pixel(pixel));
        let sample = [x * axis + column, y * axis + row];
        let position = (DVec2::new(sample[0].into(), sample[1].into()) + 0.5) / f64::from(axis);
        Some(EyeSample { slot, sample, ray: self.lens.ray_with_steps(position)? })
    }

    /// The colours of surfaces, those of one draw together.
    fn shaded(&self, fragments: &[EyeFragment], scratch: &mut PointScratch) -> Vec<[f32; 4]> {
        let draw = |&number: &usize| self.run(fragments[number].run).draw;
        let mut order: Vec<usize> = (0..fragments.len()).collect();
        order.sort_by_key(draw);
        let mut colors = vec![[0.0; 4]; fragments.len()];
        let (mut points, mut shaded) = (Vec::new(), Vec::new());
        for same in order.chunk_by(|one, next| draw(one) == draw(next)) {
            points.clear();
            points.extend(same.iter().map(|&number| fragments[number].point));
            shaded.clear();
            shaded.resize(same.len(), [0.0; 4]);
            self.shader.shade(draw(&same[0]), &points, scratch, &mut shaded);
            for (&number, &color) in same.iter().zip(&shaded) {
                colors[number] = color;
            }
        }
        colors
    }

    /// The triangles that pixels show.
    pub(in crate::render) fn find(&self, ids: &mut VisibleIds, rasterizer: &Rasterizer) {
        let VisibleIds { objects, faces, triangles } = ids;
        let pieces = objects.chunks_mut(PIECE).zip(faces.chunks_mut(PIECE)).zip(triangles.chunks_mut(PIECE));
        rasterizer.share(pieces.enumerate(), |(number, ((objects, faces), triangles))| {
            [&mut *objects, faces, triangles].into_iter().for_each(|ids| ids.fill(u32::MAX));
            let middle = [self.grid.axis / 2; 2];
            let samples: Vec<EyeSample> = (0..objects.len())
                .filter_map(|slot| self.sample(slot, number * PIECE + slot, middle))
                .collect();
            for EyeFragment { index, run, point } in self.fragments(&samples, &mut PointScratch::default()) {
                let (run, slot) = (self.run(run), samples[index].slot);
                objects[slot] = run.node;
                faces[slot] = run.geometry.face((run.triangles.start + point.triangle) as usize);
                triangles[slot] = point.triangle;
            }
        });
    }
}

/// The mean of samples; of equal ones exactly that.
fn mean(light: &[Vec4]) -> Vec4 {
    let sum: Vec4 = light.iter().copied().sum();
    if light.iter().all(|sample| *sample == light[0]) { light[0] } else { sum / light.len() as f32 }
}
