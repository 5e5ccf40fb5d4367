//! Cameras of the file; invalid ones are left out.

use gltf::json::camera::Type;
use gltf::json::{Node, Root};
use trigon_camera::Projection;

use super::accessor::valid;
use crate::error::Location;
use crate::warning::Warnings;

/// The camera of a node, if it has one that works.
pub(crate) fn convert_camera(root: &Root, node: &Node, warnings: &mut Warnings) -> Option<Projection> {
    let index = node.camera?.value();
    let camera = &root.cameras[index];
    let projection = match (valid(&camera.type_), &camera.perspective, &camera.orthographic) {
        (Some(Type::Perspective), Some(from), _) => {
            Projection::perspective(from.yfov.into(), from.znear.into(), from.zfar.map(f64::from))
                .map_err(|error| error.to_string())
        }
        (Some(Type::Orthographic), _, Some(from)) if from.xmag <= 0.0 => {
            Err("its xmag must be more than 0".to_owned())
        }
        // The magnifications are half extents.
        (Some(Type::Orthographic), _, Some(from)) => {
            Projection::orthographic(2.0 * f64::from(from.ymag), from.znear.into(), from.zfar.into())
                .map_err(|error| error.to_string())
        }
        _ => Err("it is neither perspective nor orthographic".to_owned()),
    };
    match projection {
        Ok(projection) => Some(projection),
        Err(why) => {
            warnings.push(
                Location::Item("camera", index),
                format!("the camera is left out: {why}"),
                "correct the camera in the model",
            );
            None
        }
    }
}
