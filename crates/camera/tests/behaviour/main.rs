//! How cameras behave, one module per subject. More properties of projecting
//! and unprojecting are with the workspace tests.

mod fisheye;
mod fit;
mod orbit;
mod projecting;
mod projection;
