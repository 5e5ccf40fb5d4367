//! What images hash to.

use trigon_raster::TargetImages;
use trigon_scene::Frame;

/// FNV-1a (Fowler, Noll, Vo), 64 bits.
pub(super) fn fnv1a(bytes: impl IntoIterator<Item = u8>) -> u64 {
    let step = |hash: u64, byte: u8| (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01b3);
    bytes.into_iter().fold(0xcbf2_9ce4_8422_2325, step)
}

pub(super) fn hash(images: &TargetImages) -> String {
    let TargetImages { srgb8, unorm8, linear, depth, objects, faces, triangles } = images;
    let codes = [srgb8, unorm8].into_iter().flatten().flatten().flatten().copied();
    let colors = linear.iter().flatten().flat_map(|color| color.to_array());
    let floats = colors.chain(depth.iter().flatten().copied()).map(f32::to_bits);
    let ids = [objects, faces, triangles].into_iter().flatten().flatten().copied();
    format!("{:016x}", fnv1a(codes.chain(floats.chain(ids).flat_map(u32::to_le_bytes))))
}

pub(super) fn hash_frame(frame: &Frame) -> String {
    let Frame { color, radiance, depth, object_ids, face_ids, .. } = frame;
    let colors = radiance.iter().flatten().flat_map(|color| color.to_array());
    let floats = colors.chain(depth.iter().flatten().copied()).map(f32::to_bits);
    let ids = [object_ids, face_ids].into_iter().flatten().flatten().copied();
    let bytes = color.iter().copied().chain(floats.chain(ids).flat_map(u32::to_le_bytes));
    format!("{:016x}", fnv1a(bytes))
}
