//! The codes of the group SemanticError: one object contradicts itself or the
//! specification.

use serde_json::json;

use super::files::*;
use super::row::{Refused, Row, Silent, Warned, glb, json_file};
use crate::gltf::push;

pub(super) fn rows() -> Vec<Row> {
    [accessors(), assets(), cameras(), extensions(), materials(), meshes(), nodes(), skins()].concat()
}

/// Why the alignment of bytes does not matter.
pub(super) const ALIGNMENT: &str = "values are read at any offset";

fn accessors() -> Vec<Row> {
    vec![
        glb("ACCESSOR_MATRIX_ALIGNMENT", "bind matrices from byte 2", Silent(ALIGNMENT), |doc| {
            skin(doc);
            let accessor = bound(doc, &[&[0.0][..], &bind_matrix(0, 1.0)].concat());
            let from = &mut doc.json["accessors"][accessor];
            (from["count"], from["byteOffset"]) = (json!(1), json!(2));
            // The matrix starts at byte 4 of the view; now at byte 2 of it.
            let start = view(doc, accessor)["byteOffset"].as_u64().expect("a number") as usize;
            doc.bytes.copy_within(start + 4..start + 68, start + 2);
        }),
        glb(
            "ACCESSOR_NORMALIZED_INVALID",
            "normalized floats",
            Silent("normalized means nothing for floats, and they are read as they are"),
            |doc| doc.json["accessors"][0]["normalized"] = json!(true),
        ),
        glb("ACCESSOR_OFFSET_ALIGNMENT", "floats from byte 2", Silent(ALIGNMENT), |doc| {
            let accessor = floats(doc, "TEXCOORD_0", "VEC2", &[0.5; 9]);
            let from = &mut doc.json["accessors"][accessor];
            (from["count"], from["byteOffset"]) = (json!(4), json!(2));
        }),
        glb("ACCESSOR_SPARSE_COUNT_OUT_OF_RANGE", "five sparse values for four elements", Refused, |doc| {
            sparse(doc, &[0, 1, 2, 3, 4]);
        }),
        glb(
            "ANIMATION_CHANNEL_TARGET_NODE_SKIN",
            "an animation of a node whose mesh follows a skin",
            Silent("by the specification, a skinned mesh follows its joints and not its node"),
            |doc| {
                skin(doc);
                moved(doc);
            },
        ),
        glb("INVALID_GL_VALUE", "a min of 300 for bytes", Silent(BOUNDS), |doc| {
            doc.json["accessors"][1]["min"] = json!([300]);
            doc.json["accessors"][1]["max"] = json!([3]);
        }),
    ]
}

/// Why min and max do not matter.
pub(super) const BOUNDS: &str = "min and max are not used: bounds are computed from the values";

fn assets() -> Vec<Row> {
    vec![
        glb("ASSET_MIN_VERSION_GREATER_THAN_VERSION", "minVersion 2.1 of version 2.0", Refused, |doc| {
            doc.json["asset"]["minVersion"] = json!("2.1");
        }),
        json_file(
            "BUFFER_DATA_URI_MIME_TYPE_INVALID",
            "a buffer in a data URI of text/plain",
            Silent("the bytes are the same whatever the type says"),
            || {
                let text = String::from_utf8(gltf(&square())).expect("UTF-8");
                text.replace("application/octet-stream", "text/plain").into_bytes()
            },
        ),
        glb("BUFFER_VIEW_INVALID_BYTE_STRIDE", "sparse values with a byteStride", Warned, |doc| {
            sparse(doc, &[0, 1]);
            let values = doc.json["bufferViews"].as_array().expect("a list").len() - 1;
            doc.json["bufferViews"][values]["byteStride"] = json!(12);
        }),
        glb(
            "BUFFER_VIEW_TOO_BIG_BYTE_STRIDE",
            "a byteStride that is longer than its bufferView",
            Silent("a single element needs no stride"),
            |doc| {
                let accessor = doc.floats("VEC3", &[0., 0., 0.]);
                view(doc, accessor)["byteStride"] = json!(16);
                doc.json["accessors"][accessor]["min"] = json!([0, 0, 0]);
                doc.json["accessors"][accessor]["max"] = json!([0, 0, 0]);
                let point = json!({"attributes": {"POSITION": accessor}, "mode": 0});
                push(&mut doc.json["meshes"][0]["primitives"], point);
            },
        ),
        json_file("NON_RELATIVE_URI", "a buffer on the network", Refused, || {
            gltf_with_uri(&square(), "https://example.invalid/a.bin")
        }),
        json_file("NON_RELATIVE_URI-image", "an image on the network", Warned, || {
            with_image_uri("https://example.invalid/a.png")
        }),
        glb("UNKNOWN_ASSET_MAJOR_VERSION", "version 3.0", Refused, |doc| {
            doc.json["asset"]["version"] = json!("3.0");
        }),
        glb("UNKNOWN_ASSET_MINOR_VERSION", "version 2.1", Warned, |doc| {
            doc.json["asset"]["version"] = json!("2.1");
        }),
    ]
}

fn cameras() -> Vec<Row> {
    vec![
        glb("CAMERA_XMAG_YMAG_NEGATIVE", "a camera with a negative ymag", Warned, |doc| {
            orthographic(doc, 1.0, -1.0, 9.0);
        }),
        glb("CAMERA_XMAG_YMAG_NEGATIVE-x", "a camera with a negative xmag", Warned, |doc| {
            orthographic(doc, -1.0, 1.0, 9.0);
        }),
        glb("CAMERA_XMAG_YMAG_ZERO", "a camera whose xmag is 0", Warned, |doc| {
            orthographic(doc, 0.0, 1.0, 9.0);
        }),
        glb("CAMERA_YFOV_GEQUAL_PI", "a camera that sees more than half of everything", Warned, |doc| {
            camera(doc, json!({"type": "perspective", "perspective": {"yfov": 3.5, "znear": 1}}));
        }),
        glb("CAMERA_ZFAR_LEQUAL_ZNEAR", "a camera whose zfar is its znear", Warned, |doc| {
            orthographic(doc, 1.0, 1.0, 1.0);
        }),
    ]
}

fn extensions() -> Vec<Row> {
    vec![
        glb("INVALID_EXTENSION_NAME_FORMAT", "an extension without a prefix", Warned, |doc| {
            uses(doc, &["sparkle"]);
        }),
        glb(
            "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_NODE",
            "an animation pointer and a node in one channel",
            Warned,
            |doc| point(doc, json!({"node": 0, "path": "pointer"})),
        ),
        glb(
            "KHR_ANIMATION_POINTER_ANIMATION_CHANNEL_TARGET_PATH",
            "an animation pointer with the path rotation",
            Warned,
            |doc| point(doc, json!({"path": "rotation"})),
        ),
        glb("MULTIPLE_EXTENSIONS", "a material that is unlit and shiny", Warned, |doc| {
            uses(doc, &["KHR_materials_unlit", "KHR_materials_specular"]);
            material(doc, json!({"extensions": {"KHR_materials_unlit": {}, "KHR_materials_specular": {}}}));
        }),
        glb(
            "NON_REQUIRED_EXTENSION",
            "KHR_mesh_quantization that is used and not required",
            Silent("trigon reads it, required or not"),
            |doc| uses(doc, &["KHR_mesh_quantization"]),
        ),
        glb(
            "UNUSED_EXTENSION_REQUIRED-read",
            "a required extension that is not among the used ones, and that trigon reads",
            Warned,
            |doc| {
                uses(doc, &["KHR_materials_unlit"]);
                doc.json["extensionsRequired"] = json!(["KHR_texture_transform"]);
            },
        ),
        glb(
            "UNUSED_EXTENSION_REQUIRED",
            "a required extension that is not among the used ones",
            Warned,
            |doc| {
                uses(doc, &["KHR_materials_unlit"]);
                doc.json["extensionsRequired"] = json!(["KHR_texture_basisu"]);
            },
        ),
    ]
}

fn materials() -> Vec<Row> {
    vec![
        glb(
            "KHR_LIGHTS_PUNCTUAL_LIGHT_SPOT_ANGLES",
            "a spot light whose inner cone is the wider one",
            Warned,
            |doc| {
                let spot = json!({"innerConeAngle": 0.5, "outerConeAngle": 0.25});
                light(doc, json!({"type": "spot", "spot": spot}));
            },
        ),
        glb(
            "KHR_MATERIALS_ANISOTROPY_ANISOTROPY_TEXTURE_TEXCOORD",
            "anisotropy and normals with different texture coordinates",
            Warned,
            |doc| {
                with_normal_map(doc);
                second_uv(doc);
                tangents(doc, 1.0);
                uses(doc, &["KHR_materials_anisotropy"]);
                doc.json["materials"][0]["extensions"] =
                    json!({"KHR_materials_anisotropy": {"anisotropyTexture": {"index": 0, "texCoord": 1}}});
            },
        ),
        glb(
            "KHR_MATERIALS_CLEARCOAT_CLEARCOAT_NORMAL_TEXTURE_TEXCOORD",
            "a clear coat and normals with different texture coordinates",
            Warned,
            |doc| {
                with_normal_map(doc);
                second_uv(doc);
                tangents(doc, 1.0);
                uses(doc, &["KHR_materials_clearcoat"]);
                let texture = json!({"index": 0, "texCoord": 1});
                doc.json["materials"][0]["extensions"] =
                    json!({"KHR_materials_clearcoat": {"clearcoatNormalTexture": texture}});
            },
        ),
        glb("KHR_MATERIALS_DISPERSION_NO_VOLUME", "dispersion in a surface without volume", Warned, |doc| {
            extended(doc, "KHR_materials_dispersion", json!({"dispersion": 1}));
        }),
        glb(
            "KHR_MATERIALS_EMISSIVE_STRENGTH_ZERO_FACTOR",
            "an emissive strength of a material that does not glow",
            Silent("the emissive factor is zero, so the strength changes nothing"),
            |doc| extended(doc, "KHR_materials_emissive_strength", json!({"emissiveStrength": 5})),
        ),
        glb(
            "KHR_MATERIALS_VOLUME_DOUBLE_SIDED",
            "a double-sided volume",
            Silent("light meets both sides of the surface of a volume anyway"),
            |doc| {
                uses(doc, &["KHR_materials_volume", "KHR_materials_transmission"]);
                let extensions = json!({"KHR_materials_volume": {"thicknessFactor": 1},
                "KHR_materials_transmission": {"transmissionFactor": 1}});
                material(doc, json!({"doubleSided": true, "extensions": extensions}));
            },
        ),
        glb("KHR_MATERIALS_VOLUME_NO_TRANSMISSION", "a volume that no light enters", Warned, |doc| {
            extended(doc, "KHR_materials_volume", json!({"thicknessFactor": 1}));
        }),
        glb(
            "MATERIAL_ALPHA_CUTOFF_INVALID_MODE",
            "an alphaCutoff of an opaque material",
            Silent("by the specification, only the mode MASK uses the cutoff"),
            |doc| material(doc, json!({"alphaCutoff": 0.25})),
        ),
    ]
}

fn meshes() -> Vec<Row> {
    vec![
        glb("MESH_INVALID_WEIGHTS_COUNT", "two weights of a mesh for one morph target", Warned, |doc| {
            target(doc);
            doc.json["meshes"][0]["weights"] = json!([0, 1]);
        }),
        glb(
            "MESH_PRIMITIVES_UNEQUAL_TARGETS_COUNT",
            "one of two primitives has a morph target",
            Warned,
            |doc| {
                let other = doc.primitive().clone();
                target(doc);
                push(&mut doc.json["meshes"][0]["primitives"], other);
            },
        ),
        glb(
            "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY",
            "TEXCOORD_1 without TEXCOORD_0",
            Silent("textures name the set that they use by its number"),
            |doc| {
                floats(doc, "TEXCOORD_1", "VEC2", &[0.5; 8]);
            },
        ),
        glb(
            "MESH_PRIMITIVE_INDEXED_SEMANTIC_CONTINUITY-joints",
            "the sets 0 and 2 of joints and weights, without set 1",
            Warned,
            |doc| {
                skin(doc);
                let of = |name: &str, doc: &crate::gltf::Doc| {
                    doc.json["meshes"][0]["primitives"][0]["attributes"][name].clone()
                };
                let (joints, weights) = (of("JOINTS_0", doc), of("WEIGHTS_0", doc));
                doc.primitive()["attributes"]["JOINTS_2"] = joints;
                doc.primitive()["attributes"]["WEIGHTS_2"] = weights;
            },
        ),
        glb("MESH_PRIMITIVE_INVALID_ATTRIBUTE", "the attribute COLOR", Warned, |doc| {
            floats(doc, "COLOR", "VEC3", &[1.0; 12]);
        }),
        glb("MESH_PRIMITIVE_INVALID_ATTRIBUTE-target", "a morph target of WEIGHTS_0", Warned, |doc| {
            target(doc);
            floats(doc, "TEXCOORD_0", "VEC2", &[0.5; 8]);
            let deltas = doc.floats("VEC2", &[0.5; 8]);
            doc.primitive()["targets"][0]["WEIGHTS_0"] = json!(deltas);
        }),
        glb("MESH_PRIMITIVE_JOINTS_WEIGHTS_MISMATCH", "joints without weights", Warned, |doc| {
            let joints = doc.accessor(5121, "VEC4", 4, &[0; 16]);
            attribute(doc, "JOINTS_0", joints);
        }),
        glb("MESH_PRIMITIVE_NO_POSITION", "a primitive without POSITION", Warned, |doc| {
            let other = json!({"attributes": {"_ID": 0}});
            push(&mut doc.json["meshes"][0]["primitives"], other);
        }),
        glb(
            "MESH_PRIMITIVE_TANGENT_WITHOUT_NORMAL",
            "tangents without normals",
            Silent("by the specification, tangents without normals are ignored"),
            |doc| tangents(doc, 1.0),
        ),
    ]
}

fn nodes() -> Vec<Row> {
    vec![
        glb(
            "NODE_MATRIX_NON_TRS",
            "a matrix that shears",
            Silent("the matrix is applied as it is, shear included"),
            |doc| node(doc)["matrix"] = json!([1, 0, 0, 0, 0.5, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]),
        ),
        glb("NODE_MATRIX_NON_TRS-projective", "a matrix whose last row is not 0 0 0 1", Warned, |doc| {
            node(doc)["matrix"] = json!([1, 0, 0, 0.5, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1]);
        }),
        glb(
            "NODE_MATRIX_NON_TRS-flat",
            "a matrix that flattens",
            Silent("the matrix is applied as it is"),
            |doc| node(doc)["matrix"] = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1]),
        ),
        glb("NODE_MATRIX_TRS", "a node with a matrix and a translation", Warned, |doc| {
            node(doc)["matrix"] = json!([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]);
            node(doc)["translation"] = json!([1, 0, 0]);
        }),
        glb("ROTATION_NON_UNIT", "a rotation of length ½", Warned, |doc| {
            node(doc)["rotation"] = json!([0, 0, 0, 0.5]);
        }),
        glb("ROTATION_NON_UNIT-none", "a rotation of no length", Warned, |doc| {
            node(doc)["rotation"] = json!([0, 0, 0, 0]);
        }),
    ]
}

fn skins() -> Vec<Row> {
    const IN_PLACE: &str = "by the specification, only joints place a skinned mesh";
    vec![
        glb(
            "NODE_SKINNED_MESH_LOCAL_TRANSFORMS",
            "a skinned mesh on a moved node",
            Silent(IN_PLACE),
            |doc| {
                skin(doc);
                node(doc)["translation"] = json!([1, 0, 0]);
            },
        ),
        glb("NODE_SKINNED_MESH_NON_ROOT", "a skinned mesh below a node", Silent(IN_PLACE), |doc| {
            skin(doc);
            push(&mut doc.json["nodes"], json!({"children": [0], "translation": [1, 0, 0]}));
            doc.json["scenes"][0]["nodes"] = json!([1, 2]);
        }),
        glb("NODE_SKIN_NO_SCENE", "a skin whose joint is not in the scene", Warned, |doc| {
            skin(doc);
            doc.json["scenes"] = json!([{"nodes": [0]}, {"nodes": [1]}]);
        }),
        glb(
            "SKIN_NO_COMMON_ROOT",
            "two joints without a common root",
            Silent("each joint's own transform is used; no common root is needed"),
            |doc| {
                skin(doc);
                let index = push(&mut doc.json["nodes"], json!({}));
                doc.json["skins"][0]["joints"] = json!([1, index]);
                doc.json["scenes"][0]["nodes"] = json!([0, 1, index]);
            },
        ),
        glb(
            "SKIN_SKELETON_INVALID",
            "a skeleton that is not above the joints",
            Silent("the skeleton does not affect the image"),
            |doc| {
                skin(doc);
                doc.json["skins"][0]["skeleton"] = json!(0);
            },
        ),
    ]
}
