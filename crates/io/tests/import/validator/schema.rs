//! The codes of the groups IoError and SchemaError: the JSON is not of the form
//! that it must have.

use serde_json::json;

use super::files::*;
use super::row::{Refused, Row, Silent, Warned, glb, json_file};
use crate::gltf::push;

pub(super) fn rows() -> Vec<Row> {
    [io(), lists(), forms(), presence(), values()].concat()
}

fn io() -> Vec<Row> {
    vec![
        json_file("IO_ERROR", "a buffer's file is missing", Refused, || {
            gltf_with_uri(&square(), "missing.bin")
        }),
        json_file("IO_ERROR-image", "an image's file is missing", Warned, || with_image_uri("missing.png")),
    ]
}

fn lists() -> Vec<Row> {
    vec![
        glb("ARRAY_LENGTH_NOT_IN_LIST", "a translation of two numbers", Refused, |doc| {
            node(doc)["translation"] = json!([0, 0]);
        }),
        glb("ARRAY_LENGTH_NOT_IN_LIST-bounds", "a POSITION whose min has two numbers", Refused, |doc| {
            doc.json["accessors"][0]["min"] = json!([0, 0]);
        }),
        glb("ARRAY_TYPE_MISMATCH", "a translation with text in it", Refused, |doc| {
            node(doc)["translation"] = json!([0, 0, "0"]);
        }),
        glb(
            "DUPLICATE_ELEMENTS",
            "a scene lists a node twice",
            Silent("each node of a scene is drawn once"),
            |doc| doc.json["scenes"][0]["nodes"] = json!([0, 0]),
        ),
        glb("DUPLICATE_ELEMENTS-child", "a node lists a child twice", Refused, |doc| {
            push(&mut doc.json["nodes"], json!({}));
            node(doc)["children"] = json!([1, 1]);
        }),
        glb(
            "DUPLICATE_ELEMENTS-joint",
            "a skin lists a joint twice",
            Silent("both entries are the same node, and vertices may use either"),
            |doc| {
                skin(doc);
                doc.json["skins"][0]["joints"] = json!([1, 1]);
            },
        ),
        glb(
            "EMPTY_ENTITY",
            "an empty list of materials",
            Silent("an empty list is as good as none"),
            |doc| doc.json["materials"] = json!([]),
        ),
        glb("EMPTY_ENTITY-primitives", "a mesh without primitives", Refused, |doc| {
            doc.json["meshes"][0]["primitives"] = json!([]);
        }),
    ]
}

fn forms() -> Vec<Row> {
    vec![
        glb("INVALID_INDEX", "a node with mesh −1", Refused, |doc| node(doc)["mesh"] = json!(-1)),
        json_file("INVALID_JSON", "an object that is not closed", Refused, || {
            let mut bytes = gltf(&square());
            bytes.pop();
            bytes
        }),
        json_file("INVALID_URI", "a buffer with a malformed URI", Refused, || {
            gltf_with_uri(&square(), "http://[")
        }),
        json_file("INVALID_URI-image", "an image with a malformed URI", Warned, || {
            with_image_uri("http://[")
        }),
        json_file("INVALID_URI-content", "a data URI says PNG and is WebP", Silent(IMAGE), || {
            with_image_uri(&data_uri("image/png", WEBP))
        }),
        glb("ONE_OF_MISMATCH", "an image with a URI and a bufferView", Warned, |doc| {
            textured(doc, &png(), "image/png");
            doc.json["images"][0]["uri"] = json!(data_uri("image/png", &png()));
        }),
        glb("ONE_OF_MISMATCH-neither", "an image with neither of them", Warned, |doc| {
            textured(doc, &png(), "image/png");
            doc.json["images"] = json!([{}]);
        }),
        glb(
            "ONE_OF_MISMATCH-camera",
            "a camera that is perspective and orthographic",
            Silent("its type says which it is"),
            |doc| {
                let projection = json!({"xmag": 1, "ymag": 1, "znear": 1, "zfar": 9});
                camera(
                    doc,
                    json!({"type": "perspective", "orthographic": projection,
                        "perspective": {"yfov": 1, "znear": 1}}),
                );
            },
        ),
        glb("PATTERN_MISMATCH", "the version 2 in place of 2.0", Silent("the major version is 2"), |doc| {
            doc.json["asset"]["version"] = json!("2");
        }),
        glb("TYPE_MISMATCH", "text in place of true or false", Refused, |doc| {
            material(doc, json!({"doubleSided": "yes"}));
        }),
        glb("TYPE_MISMATCH-transform", "a normal map moved by text", Warned, |doc| {
            with_normal_map(doc);
            uses(doc, &["KHR_texture_transform"]);
            doc.json["materials"][0]["normalTexture"]["extensions"] =
                json!({"KHR_texture_transform": {"offset": "left"}});
        }),
    ]
}

/// Why what is said about an image does not matter.
pub(super) const IMAGE: &str = "an image's format is found from its first bytes";

fn presence() -> Vec<Row> {
    vec![
        glb("UNDEFINED_PROPERTY", "an accessor without count", Refused, |doc| {
            doc.json["accessors"][0].as_object_mut().expect("an object").remove("count");
        }),
        glb("UNDEFINED_PROPERTY-texture", "a texture of a material without index", Refused, |doc| {
            material(doc, json!({"normalTexture": {}}));
        }),
        glb(
            "UNDEFINED_PROPERTY-spot",
            "a spot light without spot",
            Silent("both angles have defaults in KHR_lights_punctual, which are used"),
            |doc| light(doc, json!({"type": "spot"})),
        ),
        glb(
            "UNEXPECTED_PROPERTY",
            "a property that glTF does not know",
            Silent("the property means nothing in glTF, so nothing is missing from the image"),
            |doc| node(doc)["colour"] = json!("red"),
        ),
        glb(
            "UNSATISFIED_DEPENDENCY",
            "texture coordinates with a byteOffset and no bufferView",
            Warned,
            |doc| {
                uv(doc);
                doc.json["accessors"][2] =
                    json!({"componentType": 5126, "type": "VEC2", "count": 4, "byteOffset": 4});
            },
        ),
        glb("UNSATISFIED_DEPENDENCY-skin", "a node with a skin and no mesh", Warned, |doc| {
            skin(doc);
            push(&mut doc.json["nodes"], json!({"skin": 0}));
            doc.json["scenes"][0]["nodes"] = json!([0, 1, 2]);
        }),
        glb(
            "UNSATISFIED_DEPENDENCY-weights",
            "a node with weights and no mesh",
            Silent("the node has no morph targets to weight"),
            |doc| {
                push(&mut doc.json["nodes"], json!({"weights": [1]}));
                doc.json["scenes"][0]["nodes"] = json!([0, 1]);
            },
        ),
        glb(
            "UNSATISFIED_DEPENDENCY-mime",
            "an image in a bufferView without mimeType",
            Silent(IMAGE),
            |doc| {
                textured(doc, &png(), "image/png");
                doc.json["images"][0].as_object_mut().expect("an object").remove("mimeType");
            },
        ),
        glb(
            "UNSATISFIED_DEPENDENCY-extensions",
            "extensionsRequired without extensionsUsed",
            Warned,
            |doc| doc.json["extensionsRequired"] = json!(["KHR_texture_transform"]),
        ),
    ]
}

fn values() -> Vec<Row> {
    [unknown_values(), ranges()].concat()
}

fn unknown_values() -> Vec<Row> {
    vec![
        glb("VALUE_NOT_IN_LIST", "an unknown alphaMode", Warned, |doc| {
            material(doc, json!({"alphaMode": "GLASS"}));
        }),
        glb("VALUE_NOT_IN_LIST-camera", "a camera of an unknown type", Warned, |doc| {
            camera(doc, json!({"type": "fisheye"}));
        }),
        glb("VALUE_NOT_IN_LIST-wrap", "an unknown wrapS", Warned, |doc| {
            sampled(doc, json!({"wrapS": 1}));
        }),
        glb("VALUE_NOT_IN_LIST-filter", "unknown filters", Warned, |doc| {
            sampled(doc, json!({"magFilter": 1, "minFilter": 2}));
        }),
        glb("VALUE_NOT_IN_LIST-interpolation", "an unknown interpolation", Warned, |doc| {
            moved(doc);
            doc.json["animations"][0]["samplers"][0]["interpolation"] = json!("BEZIER");
        }),
        glb("VALUE_NOT_IN_LIST-path", "an unknown path", Warned, |doc| {
            moved(doc);
            doc.json["animations"][0]["channels"][0]["target"]["path"] = json!("colour");
        }),
        glb("VALUE_NOT_IN_LIST-light", "a light of an unknown type", Warned, |doc| {
            light(doc, json!({"type": "laser"}));
        }),
        glb("VALUE_NOT_IN_LIST-component", "a POSITION of an unknown componentType", Refused, |doc| {
            doc.json["accessors"][0]["componentType"] = json!(5130);
        }),
        glb(
            "VALUE_NOT_IN_LIST-target",
            "a bufferView with an unknown target",
            Silent("target is a hint for graphics cards and is not used"),
            |doc| doc.json["bufferViews"][0]["target"] = json!(1),
        ),
        glb("VALUE_NOT_IN_LIST-mime", "a PNG with the mimeType image/gif", Silent(IMAGE), |doc| {
            textured(doc, &png(), "image/gif");
        }),
    ]
}

fn ranges() -> Vec<Row> {
    vec![
        glb("VALUE_MULTIPLE_OF", "a byteStride of 14", Silent("any stride is followed"), |doc| {
            let values = square().bytes[..48].to_vec();
            let spread: Vec<u8> = values.chunks(12).flat_map(|one| [one, &[0, 0]].concat()).collect();
            let view = doc.view(&spread);
            doc.json["bufferViews"][view]["byteStride"] = json!(14);
            doc.json["accessors"][0]["bufferView"] = json!(view);
        }),
        glb("VALUE_NOT_IN_RANGE", "a metallicFactor of 2", Warned, |doc| {
            material(doc, json!({"pbrMetallicRoughness": {"metallicFactor": 2}}));
        }),
        glb("VALUE_NOT_IN_RANGE-color", "a baseColorFactor of 2", Warned, |doc| {
            material(doc, json!({"pbrMetallicRoughness": {"baseColorFactor": [2, 0, 0, 1]}}));
        }),
        glb(
            "VALUE_NOT_IN_RANGE-emissive",
            "an emissiveFactor of 2",
            Silent("the value is used as it is"),
            |doc| material(doc, json!({"emissiveFactor": [2, 2, 2]})),
        ),
        glb("VALUE_NOT_IN_RANGE-ior", "an index of refraction of 0.5", Warned, |doc| {
            extended(doc, "KHR_materials_ior", json!({"ior": 0.5}));
        }),
        glb(
            "VALUE_NOT_IN_RANGE-cutoff",
            "an alphaCutoff of −1",
            Silent("every alpha is above it, so the whole surface is drawn, as the value says"),
            |doc| material(doc, json!({"alphaMode": "MASK", "alphaCutoff": -1})),
        ),
        glb("VALUE_NOT_IN_RANGE-light", "a light of negative intensity", Warned, |doc| {
            light(doc, json!({"type": "point", "intensity": -1}));
        }),
        glb("VALUE_NOT_IN_RANGE-range", "a light with a range of −1", Warned, |doc| {
            light(doc, json!({"type": "point", "range": -1}));
        }),
        glb("VALUE_NOT_IN_RANGE-camera", "a camera that is −1 from what it sees", Warned, |doc| {
            camera(doc, json!({"type": "perspective", "perspective": {"yfov": 1, "znear": -1}}));
        }),
        glb(
            "VALUE_NOT_IN_RANGE-aspect",
            "a camera with an aspectRatio of −1",
            Silent("the aspect ratio is the image's own"),
            |doc| {
                camera(
                    doc,
                    json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 1, "aspectRatio": -1}}),
                );
            },
        ),
        glb("VALUE_NOT_IN_RANGE-count", "a POSITION of no elements", Refused, |doc| {
            doc.json["accessors"][0]["count"] = json!(0);
        }),
        glb("VALUE_NOT_IN_RANGE-rotation", "a rotation with the number 2", Warned, |doc| {
            node(doc)["rotation"] = json!([0, 0, 0, 2]);
        }),
        glb("VALUE_NOT_IN_RANGE-mode", "a primitive of the mode 9 beside a sound one", Warned, |doc| {
            let mut other = doc.primitive().clone();
            other["mode"] = json!(9);
            push(&mut doc.json["meshes"][0]["primitives"], other);
        }),
    ]
}
