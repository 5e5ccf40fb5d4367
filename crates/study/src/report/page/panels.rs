//! The picture at the head of the page.

use super::super::chapter::value;
use super::super::chapters::frames::{RMSE, TIME};
use super::super::chapters::rivals;
use super::super::frontier_plot::{Dot, Mark, Panel};
use super::limits;
use super::recorded::{Recorded, settings};
use crate::frames::name;
use trigon_scene::quality::candidates;

/// All settings at both sizes, and other renderers.
pub(in crate::report) fn panels(recorded: &Recorded<'_>) -> Vec<Panel> {
    let chosen = candidates().map(name);
    let sweeps = recorded.sweeps().map(|sweep| {
        let dots = settings(recorded.frames, &sweep.means()).into_iter().map(|setting| {
            let preset =
                setting.name.split_once(" (").map(|(_, preset)| preset.trim_end_matches(')').to_owned());
            let mark = match &preset {
                Some(_) => Mark::Preset,
                None if chosen.contains(&setting.name) => Mark::Candidate,
                None => Mark::Plain,
            };
            Dot { name: preset.unwrap_or(setting.name), point: [setting.time, setting.error], mark }
        });
        Panel {
            name: sweep.name(),
            title: format!("{}, {}×{}", sweep.means(), sweep.size[0], sweep.size[1]),
            axes: [TIME, RMSE],
            dots: dots.collect(),
            floor: limits::floor(recorded, &sweep),
        }
    });
    let rows = recorded.rivals.iter().filter(|row| row.case == rivals::ALL);
    let dots = rows.filter_map(|row| {
        let point = [row.value(rivals::ONE)?, row.value(rivals::IMAGE)?];
        let mark = if row.variant.starts_with("trigon") { Mark::Preset } else { Mark::Rival };
        Some(Dot { name: row.variant.clone(), point, mark })
    });
    let others = Panel {
        name: "others",
        title: format!("other renderers: {}", rivals::ALL),
        axes: [rivals::ONE, rivals::IMAGE],
        dots: dots.collect(),
        floor: value(
            recorded.rivals,
            rivals::ALL,
            "exact mean of each pixel, rounded to bytes",
            rivals::IMAGE,
        ),
    };
    sweeps.into_iter().chain([others]).collect()
}
