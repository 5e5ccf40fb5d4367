//! Images through fisheye lenses, against rays that are traced here in f64, by other formulas.

mod colors;
mod oracle;
mod visibility;

use trigon_camera::{FisheyeCamera, FisheyeLens, PixelCenters, Viewport};
use trigon_math::{DQuat, DVec2, DVec3};
use trigon_scene::mesh::{Mesh, MeshBuilder};
use trigon_scene::{Outputs, RenderSettings};

/// A square image whose lens has its centre in the middle.
fn lens(side: u32, focal: f64, distortion: [f64; 4]) -> FisheyeLens {
    let (image, center) = (Viewport { width: side, height: side }, DVec2::splat(f64::from(side) / 2.0));
    FisheyeLens::new(DVec2::splat(focal), center, image, PixelCenters::AtHalves, distortion).expect("valid")
}

fn camera(position: DVec3, orientation: DQuat, lens: FisheyeLens) -> FisheyeCamera {
    FisheyeCamera { position, orientation, lens }
}

/// One sample in the middle of each pixel.
fn settings(side: u32, outputs: Outputs) -> RenderSettings {
    RenderSettings { samples_per_axis: 1, outputs, ..RenderSettings::new(side, side) }
}

fn mesh(positions: &[[f32; 3]], faces: &[&[u32]]) -> Mesh {
    let mut builder = MeshBuilder::with_capacity(positions.len(), faces.len(), 0);
    for &position in positions {
        builder.push_vertex(position.into());
    }
    for face in faces {
        builder.push_face(face).expect("a face of these vertices");
    }
    builder.build()
}
