//! The image by pipelines, each of which is written for its class of material and knows all of it when it is compiled.

mod lit;
mod mapped;
mod metal;
mod plain;
mod shadow;
mod surface;
mod textured;

use std::error::Error;
use std::num::NonZeroUsize;

use trigon_raster::{Background, Culling, Draw, ExecuteSettings, LanePipeline, Pass, Rasterizer, Target};
use trigon_scene::mesh::RenderMesh;

use crate::by_scene::Drawing;
use crate::image::{BEHIND, Class, SIZE, bumps, camera, checker, knot, metal_and_roughness};
use crate::{check, shortest};
use lit::Lit;
use mapped::Mapped;
use metal::Metal;
use plain::Plain;
use shadow::ShadowMap;
use surface::{Columns, NormalMapped};
use textured::Textured;

/// The shortest time of a frame in milliseconds.
///
/// # Errors
///
/// The image is not that of the scene renderer.
pub(crate) fn time(class: Class, frames: u32) -> Result<f64, Box<dyn Error>> {
    let mesh = RenderMesh::from_mesh(&knot(class));
    let triangles = mesh.triangles.as_slice();
    let columns = &Columns::new(&mesh, &camera());
    let timing = Timing { triangles, class, frames };
    let base = &checker();
    match class {
        Class::Plain => timing.of(&Plain(columns)),
        Class::Textured => timing.of(&Textured { columns, base }),
        Class::Lit => timing.of(&Lit(columns)),
        Class::Mapped => {
            let shadow = ShadowMap::new(columns, triangles, &camera())?;
            timing.of(&Mapped { surface: NormalMapped { columns, bumps: &bumps() }, base, shadow: &shadow })
        }
        Class::Metal => timing.of(&Metal {
            surface: NormalMapped { columns, bumps: &bumps() },
            base,
            metal: &metal_and_roughness(),
        }),
    }
}

struct Timing<'a> {
    triangles: &'a [[u32; 3]],
    class: Class,
    frames: u32,
}

impl Timing<'_> {
    fn of<P: LanePipeline>(&self, pipeline: &P) -> Result<f64, Box<dyn Error>> {
        let mut rasterizer = Rasterizer::new(one_thread())?;
        let mut pixels = vec![[0; 4]; SIZE[0] as usize * SIZE[1] as usize];
        let mut draw = || -> Result<(), Box<dyn Error>> {
            let mut target = Target::new(SIZE[0], SIZE[1], &[])?.with_srgb8(&mut pixels)?;
            let mut pass = Pass::new();
            pass.background(Background::Color(BEHIND.extend(1.0)));
            pass.triangles(Draw { culling: Culling::Back, ..Draw::new(pipeline, self.triangles) });
            rasterizer.draw(&pass, &mut target);
            Ok(())
        };
        draw()?;
        let time = shortest(self.frames, draw)?;
        check(pixels.as_flattened(), Drawing::new(self.class)?.pixels())?;
        Ok(time)
    }
}

fn one_thread() -> ExecuteSettings {
    ExecuteSettings { threads: NonZeroUsize::new(1), ..ExecuteSettings::default() }
}
