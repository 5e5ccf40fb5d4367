//! The models and other files that the examples name.

pub(crate) const CORNER: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 0 1 1\n\
    f 1 4 3 2\nf 1 2 6 5\nf 1 5 7 4\n";

pub(crate) const DOTS_PLY: &str = "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n\
    property float z\nend_header\n0 0 0\n1 0 0\n0 1 0\n";

/// The first example of 06-CONFIGURATION_FILE: some of its names have gone from F3D, too.
pub(crate) const TYPICAL: &str = r#"[
  {"options": {"background-color": "0.7,0.7,0.7", "color": "0.5,0.1,0.1", "anti-aliasing": true,
    "timer": true, "progress": true, "axis": true, "bar": true, "roughness": 0.2, "grid": true,
    "scalar-coloring": true}},
  {"match": ".*vt.", "options": {"edges": true}},
  {"match": ".*gl(tf|b)", "options": {"raytracing": true, "denoise": true, "samples": 3}},
  {"match": ".*mhd", "options": {"volume": true}}
]"#;

/// Light from above and darkness below, as a Radiance image.
pub(crate) fn room() -> Vec<u8> {
    let mut bytes = b"#?RADIANCE\nFORMAT=32-bit_rle_rgbe\n\n-Y 8 +X 16\n".to_vec();
    bytes.extend((0..128).flat_map(|index| if index < 64 { [0, 0, 128, 129] } else { [128, 0, 0, 129] }));
    bytes
}

/// The bytes of numbers as a URI.
fn uri(numbers: &[f32]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
    let length = bytes.len();
    bytes.resize(length.next_multiple_of(3), 0);
    let text = bytes.chunks(3).flat_map(|three| {
        let bits = u32::from_be_bytes([0, three[0], three[1], three[2]]);
        [18, 12, 6, 0].map(|shift| char::from(LETTERS[(bits >> shift) as usize & 63]))
    });
    let mut text: String = text.collect();
    let extra = bytes.len() - length;
    text.replace_range(text.len() - extra.., &"=".repeat(extra));
    format!("data:application/octet-stream;base64,{text}")
}

/// A metallic quad with texture coordinates, a translucent one before it, and more nodes.
pub(crate) fn quad(nodes: &str) -> String {
    let positions =
        [-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, -1.0, 0.0, 1.0, 1.0, 0.0, -1.0, 1.0, 0.0];
    let uvs = [0.0, 1.0, 1.0, 1.0, 1.0, 0.0, 0.0, 1.0, 1.0, 0.0, 0.0, 0.0];
    let numbers: Vec<f32> = positions.into_iter().chain(uvs).collect();
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0, 1{more}]}}],
        "nodes": [{{"mesh": 0}}, {{"mesh": 1, "translation": [0.3, 0.3, 0.5], "scale": [0.5, 0.5, 0.5]}}{nodes}],
        "cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.5, "znear": 0.1}}}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 0}}]}},
            {{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}, "material": 1}}]}}],
        "materials": [{{"pbrMetallicRoughness": {{"metallicFactor": 1.0, "roughnessFactor": 0.5}}, "doubleSided": true}},
            {{"pbrMetallicRoughness": {{"baseColorFactor": [1, 0, 0, 0.5], "metallicFactor": 1.0}}, "alphaMode": "BLEND", "doubleSided": true}}],
        "buffers": [{{"byteLength": 120, "uri": "{uri}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 72}}, {{"buffer": 0, "byteOffset": 72, "byteLength": 48}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 6, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 6, "type": "VEC2"}}]}}"#,
        more = if nodes.is_empty() { "" } else { ", 2" },
        uri = uri(&numbers)
    )
}

/// A triangle that goes 3 m to the right within a second.
pub(crate) fn slide() -> String {
    let numbers = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0];
    format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}], "nodes": [{{"mesh": 0}}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"byteLength": 68, "uri": "{}"}}],
        "bufferViews": [{{"buffer": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 8}},
            {{"buffer": 0, "byteOffset": 44, "byteLength": 24}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}},
            {{"bufferView": 1, "componentType": 5126, "count": 2, "type": "SCALAR", "min": [0], "max": [1]}},
            {{"bufferView": 2, "componentType": 5126, "count": 2, "type": "VEC3"}}],
        "animations": [{{"name": "slide", "samplers": [{{"input": 1, "output": 2}}],
            "channels": [{{"sampler": 0, "target": {{"node": 0, "path": "translation"}}}}]}}]}}"#,
        uri(&numbers)
    )
}

/// A quad beside two joints, one above the other.
pub(crate) fn bones() -> String {
    let quad = quad(r#", {"children": [3]}, {"translation": [0.5, 1.5, 0.2]}"#);
    let quad = quad.replacen(r#"{"mesh": 0}"#, r#"{"mesh": 0, "skin": 0}"#, 1);
    quad.replacen(r#""materials""#, r#""skins": [{"joints": [2, 3]}], "materials""#, 1)
}

/// The configuration file with bindings that the manual shows, but for the files of its second block.
pub(crate) const BINDINGS: &str = r#"[
  {"bindings": {"Ctrl+Shift+O": "toggle ui.filename", "Any+3": "roll_camera -90", "O": "set_camera isometric"}},
  {
    "match": ".*vtp.obj",
    "bindings": {
      "Any+3": "roll_camera 90",
      "Shift+O": "set model.point_sprites.type circle",
      "Ctrl+O": ["toggle render.grid.enable", "toggle scene.camera.orthographic"],
      "None+I": "toggle ui.axis"
    }
  }
]"#;
