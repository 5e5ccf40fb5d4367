//! What is found out about an image before its draws are put together: the camera, the background, the shapes and
//! the lights.

mod backdrop;
mod lamp_reach;
mod prepared_scene;

pub(crate) use backdrop::Backdrop;
pub(crate) use prepared_scene::PreparedScene;
