//! Picking against rays in f64 that know nothing of it.

mod areas;
mod grid;
mod oracle;
mod points;
mod regions;
mod scenes;
mod target;
