//! Checks attribute values over the vertices of a primitive; `draft` corrects invalid ones.

use super::movement::PartTarget;
use super::optional::Optional;

/// How far a colour may be outside 0 to 1 without a warning: half an 8-bit step, which no image
/// shows.
const COLOR_TOLERANCE: f32 = 0.5 / 255.0;
/// How far the sign of a tangent may be from 1 or −1: one step of a normalized byte.
const SIGN_TOLERANCE: f32 = 1.0 / 127.0;

pub(super) fn warn_of_normals(from: &mut Optional<'_, '_>, normals: Option<&[[f32; 3]]>) {
    let count = normals.map_or(0, |list| list.iter().filter(|normal| !is_direction(normal)).count());
    from.warn_counted(
        count,
        "a vertex has a normal that is zero or not finite; the normal of its face is used",
    );
}

pub(super) fn warn_of_tangents(from: &mut Optional<'_, '_>, tangents: Option<&[[f32; 4]]>) {
    let is_sound = |tangent: &[f32; 4]| {
        let [x, y, z, sign] = *tangent;
        is_direction(&[x, y, z]) && (sign.abs() - 1.0).abs() <= SIGN_TOLERANCE
    };
    let count = tangents.map_or(0, |list| list.iter().filter(|tangent| !is_sound(tangent)).count());
    from.warn_counted(
        count,
        "a vertex has a tangent that is zero or not finite, or whose w is not 1 or −1; it is corrected",
    );
}

pub(super) fn warn_of_colors(from: &mut Optional<'_, '_>, colors: Option<&[[f32; 4]]>) {
    let sound = -COLOR_TOLERANCE..=1.0 + COLOR_TOLERANCE;
    let is_sound = |color: &[f32; 4]| color.iter().all(|channel| sound.contains(channel));
    let count = colors.map_or(0, |list| list.iter().filter(|color| !is_sound(color)).count());
    from.warn_counted(count, "a vertex has a colour that is not between 0 and 1; it is clamped");
}

pub(super) fn warn_of_uv_sets(from: &mut Optional<'_, '_>, sets: &[Vec<[f32; 2]>]) {
    let count = sets.iter().flatten().filter(|uv| !are_finite(&uv[..])).count();
    from.warn_counted(count, "a vertex has texture coordinates that are not finite; they count as 0");
}

pub(super) fn warn_of_targets(from: &mut Optional<'_, '_>, targets: &[PartTarget]) {
    let lists = targets.iter().flat_map(|target| [&target.positions, &target.normals, &target.tangents]);
    let count = lists.flatten().flatten().filter(|delta| !are_finite(&delta[..])).count();
    from.warn_counted(count, "a morph target has a value that is not finite; it counts as 0");
}

/// Whether it is longer than 0; the length itself does not matter.
fn is_direction(vector: &[f32; 3]) -> bool {
    are_finite(vector) && vector.iter().any(|&value| value != 0.0)
}

fn are_finite(values: &[f32]) -> bool {
    values.iter().all(|value| value.is_finite())
}
