//! The codes of the group DataError: numbers and images are not what they
//! are said to be.

use serde_json::json;

use super::files::*;
use super::row::{Refused, Row, Silent, Warned, glb, json_file, raw};
use super::schema::IMAGE;
use super::semantic::BOUNDS;
use crate::gltf::push;

pub(super) fn rows() -> Vec<Row> {
    [animations(), bounds(), indices(), floats_of(), joints(), sparse_ones(), buffers(), images()].concat()
}

fn animations() -> Vec<Row> {
    vec![
        glb(
            "ACCESSOR_ANIMATION_INPUT_NEGATIVE",
            "a time before 0",
            Silent("keyframes are used at their times, and playing starts at 0"),
            |doc| {
                let (input, output) = (times(doc, &[-1., 1.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]));
                animate(doc, "translation", input, output);
            },
        ),
        glb("ACCESSOR_ANIMATION_INPUT_NON_INCREASING", "two keys at one time", Warned, |doc| {
            let (input, output) = (times(doc, &[1., 1.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]));
            animate(doc, "translation", input, output);
        }),
        glb(
            "ACCESSOR_ANIMATION_SAMPLER_OUTPUT_NON_NORMALIZED_QUATERNION",
            "an animated rotation of length 2",
            Warned,
            |doc| turned(doc, [0., 0., 0., 2.]),
        ),
    ]
}

fn bounds() -> Vec<Row> {
    let of = |name, what, change| glb(name, what, Silent(BOUNDS), change);
    vec![
        of("ACCESSOR_ELEMENT_OUT_OF_MAX_BOUND", "positions beyond their max", |doc| {
            doc.json["accessors"][0]["max"] = json!([0.5, 0.5, 0]);
        }),
        of("ACCESSOR_ELEMENT_OUT_OF_MIN_BOUND", "positions before their min", |doc| {
            doc.json["accessors"][0]["min"] = json!([0.5, 0.5, 0]);
        }),
        of("ACCESSOR_MAX_MISMATCH", "a max that no position reaches", |doc| {
            doc.json["accessors"][0]["max"] = json!([2, 2, 2]);
        }),
        of("ACCESSOR_MIN_MISMATCH", "a min that no position reaches", |doc| {
            doc.json["accessors"][0]["min"] = json!([-2, -2, -2]);
        }),
    ]
}

fn indices() -> Vec<Row> {
    vec![
        glb("ACCESSOR_INDEX_OOB", "an index beyond the vertices", Refused, |doc| {
            let indices = doc.accessor(5121, "SCALAR", 3, &[0, 1, 9]);
            doc.primitive()["indices"] = json!(indices);
        }),
        glb("ACCESSOR_INDEX_PRIMITIVE_RESTART", "the index that would start a strip anew", Refused, |doc| {
            let indices = doc.accessor(5121, "SCALAR", 3, &[0, 1, 255]);
            doc.primitive()["indices"] = json!(indices);
        }),
    ]
}

fn floats_of() -> Vec<Row> {
    let nan = |name, what, change| glb(name, what, Warned, change);
    vec![
        nan("ACCESSOR_INVALID_FLOAT", "a position that is no number", |doc| {
            let values = [0., 0., 0., 1., 0., 0., 1., 1., 0., 0., f32::NAN, 0.];
            let positions = floats(doc, "POSITION", "VEC3", &values);
            doc.json["accessors"][positions]["min"] = json!([0, 0, 0]);
            doc.json["accessors"][positions]["max"] = json!([1, 1, 0]);
        }),
        nan("ACCESSOR_INVALID_FLOAT-point", "a point at no place, beside the square", |doc| {
            let point = doc.floats("VEC3", &[f32::NAN, 0., 0.]);
            let primitive = json!({"attributes": {"POSITION": point}, "mode": 0});
            push(&mut doc.json["meshes"][0]["primitives"], primitive);
        }),
        nan("ACCESSOR_INVALID_FLOAT-normal", "a normal that is no number", |doc| {
            floats(doc, "NORMAL", "VEC3", &[0., 0., 1., 0., 0., 1., 0., 0., 1., f32::NAN, 0., 1.]);
        }),
        nan("ACCESSOR_INVALID_FLOAT-uv", "texture coordinates that are infinite", |doc| {
            floats(doc, "TEXCOORD_0", "VEC2", &[0., 0., 1., 0., 1., 1., 0., f32::INFINITY]);
        }),
        nan("ACCESSOR_INVALID_FLOAT-color", "a colour that is no number", |doc| {
            floats(doc, "COLOR_0", "VEC3", &[0., 0., 0., 1., 0., 0., 1., 1., 0., f32::NAN, 0., 0.]);
        }),
        nan("ACCESSOR_INVALID_FLOAT-target", "a morph target that leads nowhere", |doc| {
            target(doc);
            let deltas = doc.floats("VEC3", &[f32::NAN; 12]);
            doc.primitive()["targets"][0]["POSITION"] = json!(deltas);
        }),
        nan("ACCESSOR_INVALID_FLOAT-animation", "an animation to a place that is none", |doc| {
            let (input, output) =
                (times(doc, &[0., 1.]), doc.floats("VEC3", &[0., 0., 0., f32::NAN, 0., 0.]));
            animate(doc, "translation", input, output);
        }),
        nan("ACCESSOR_INVALID_IBM", "a bind matrix whose last row is not 0 0 0 1", |doc| {
            skin(doc);
            bound(doc, &bind_matrix(3, 0.5));
        }),
        nan("ACCESSOR_INVALID_SIGN", "tangents with the sign 0", |doc| {
            with_normal_map(doc);
            tangents(doc, 0.0);
        }),
        nan("ACCESSOR_NON_CLAMPED", "a colour of 2", |doc| {
            floats(doc, "COLOR_0", "VEC3", &[2.0; 12]);
        }),
        glb(
            "ACCESSOR_VECTOR3_NON_UNIT",
            "normals of length 2",
            Silent("normals are normalized; only their direction is used"),
            |doc| {
                floats(doc, "NORMAL", "VEC3", &[0., 0., 2.].repeat(4));
            },
        ),
        nan("ACCESSOR_VECTOR3_NON_UNIT-none", "normals of no length", |doc| {
            floats(doc, "NORMAL", "VEC3", &[0.; 12]);
        }),
    ]
}

fn joints() -> Vec<Row> {
    vec![
        glb(
            "ACCESSOR_JOINTS_INDEX_DUPLICATE",
            "vertices that follow a joint twice",
            Silent("the weights of the joint add up"),
            |doc| {
                skin(doc);
                weights(doc, &[0, 0, 0, 0], &[0.5, 0.5, 0., 0.]);
            },
        ),
        glb("ACCESSOR_JOINTS_INDEX_OOB", "vertices that follow joint 5 of one", Warned, |doc| {
            skin(doc);
            weights(doc, &[5, 0, 0, 0], &[1., 0., 0., 0.]);
        }),
        glb(
            "ACCESSOR_JOINTS_USED_ZERO_WEIGHT",
            "a joint with the weight 0",
            Silent("a weight of 0 moves nothing"),
            |doc| {
                skin(doc);
                doc.json["nodes"][1]["children"] = json!([2]);
                push(&mut doc.json["nodes"], json!({}));
                doc.json["skins"][0]["joints"] = json!([1, 2]);
                weights(doc, &[0, 1, 0, 0], &[1., 0., 0., 0.]);
            },
        ),
        glb("ACCESSOR_WEIGHTS_NEGATIVE", "a negative weight", Warned, |doc| {
            skin(doc);
            doc.json["nodes"][1]["children"] = json!([2]);
            push(&mut doc.json["nodes"], json!({}));
            doc.json["skins"][0]["joints"] = json!([1, 2]);
            weights(doc, &[0, 1, 0, 0], &[1.5, -0.5, 0., 0.]);
        }),
        glb("ACCESSOR_WEIGHTS_NON_NORMALIZED", "weights that are ½ in all", Warned, |doc| {
            skin(doc);
            weights(doc, &[0, 0, 0, 0], &[0.5, 0., 0., 0.]);
        }),
    ]
}

fn sparse_ones() -> Vec<Row> {
    vec![
        glb("ACCESSOR_SPARSE_INDEX_OOB", "a sparse index beyond the elements", Refused, |doc| {
            sparse(doc, &[0, 9]);
        }),
        glb("ACCESSOR_SPARSE_INDICES_NON_INCREASING", "sparse indices 1 and 1", Warned, |doc| {
            sparse(doc, &[1, 1]);
        }),
    ]
}

fn buffers() -> Vec<Row> {
    vec![
        json_file("BUFFER_BYTE_LENGTH_MISMATCH", "a data URI that ends too early", Refused, || {
            let doc = square();
            gltf_with_uri(&doc, &data_uri("application/octet-stream", &doc.bytes[..9]))
        }),
        raw(
            "BUFFER_GLB_CHUNK_TOO_BIG",
            "a binary chunk with eight bytes more than its buffer",
            Silent("no bufferView reaches the extra bytes"),
            || {
                let (json, mut binary) = chunks();
                binary.extend([0; 8]);
                container(&[(JSON_CHUNK, &json), (BIN_CHUNK, &binary)])
            },
        ),
        glb(
            "DATA_URI_GLB",
            "an image in a data URI, in a GLB",
            Silent("the bytes are read from there"),
            |doc| {
                textured(doc, &png(), "image/png");
                doc.json["images"] = json!([{"uri": data_uri("image/png", &png())}]);
            },
        ),
    ]
}

fn images() -> Vec<Row> {
    vec![
        glb("IMAGE_DATA_INVALID", "a PNG with a header that is too long", Warned, |doc| {
            textured(doc, &png_with_long_header(), "image/png");
        }),
        glb(
            "IMAGE_FEATURES_UNSUPPORTED",
            "a PNG with a gamma of its own",
            Silent("by the specification, colour space information in images is ignored"),
            |doc| textured(doc, &png_with_gamma(), "image/png"),
        ),
        glb("IMAGE_MIME_TYPE_INVALID", "a PNG that is said to be a JPEG", Silent(IMAGE), |doc| {
            textured(doc, &png(), "image/jpeg");
        }),
        glb("IMAGE_NON_ENABLED_MIME_TYPE", "a WebP image without EXT_texture_webp", Silent(IMAGE), |doc| {
            textured(doc, WEBP, "image/png");
        }),
        glb("IMAGE_UNEXPECTED_EOS", "a PNG that ends after its header", Warned, |doc| {
            textured(doc, &png_without_data(), "image/png");
        }),
        glb("IMAGE_UNRECOGNIZED_FORMAT", "a text in place of an image", Warned, |doc| {
            textured(doc, b"This is no picture.", "image/png");
        }),
    ]
}
