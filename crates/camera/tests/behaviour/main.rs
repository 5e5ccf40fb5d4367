//! How cameras behave, one module per subject. The properties of projecting
//! and unprojecting are with the workspace tests.

mod fit;
mod orbit;
mod projection;
