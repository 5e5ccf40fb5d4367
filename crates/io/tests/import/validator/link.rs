//! The codes of the group LinkError: objects do not fit together.

use serde_json::json;

use super::files::*;
use super::row::{Refused, Row, Silent, Warned, glb, raw};
use super::schema::IMAGE;
use super::semantic::{ALIGNMENT, BOUNDS};
use crate::gltf::push;

pub(super) fn rows() -> Vec<Row> {
    [
        accessors(),
        channels(),
        samplers(),
        buffers(),
        extensions(),
        primitives(),
        targets(),
        nodes(),
        references(),
    ]
    .concat()
}

fn accessors() -> Vec<Row> {
    vec![
        glb("ACCESSOR_SMALL_BYTESTRIDE", "positions of 12 bytes, 8 bytes apart", Refused, |doc| {
            doc.json["bufferViews"][0]["byteStride"] = json!(8);
        }),
        glb("ACCESSOR_TOO_LONG", "more positions than the bufferView holds", Refused, |doc| {
            doc.json["accessors"][0]["count"] = json!(9);
        }),
        glb(
            "ACCESSOR_TOTAL_OFFSET_ALIGNMENT",
            "floats in a bufferView from byte 1",
            Silent(ALIGNMENT),
            |doc| {
                let accessor = floats(doc, "TEXCOORD_0", "VEC2", &[0.5; 9]);
                let start = view(doc, accessor)["byteOffset"].as_u64().expect("a number");
                view(doc, accessor)["byteOffset"] = json!(start + 1);
                view(doc, accessor)["byteLength"] = json!(32);
                doc.json["accessors"][accessor]["count"] = json!(4);
                // Each number starts a byte later, too.
                let start = start as usize;
                doc.bytes.copy_within(start..start + 32, start + 1);
            },
        ),
        glb(
            "ACCESSOR_USAGE_OVERRIDE",
            "the same numbers as times and as weights",
            Silent("each use reads the same numbers"),
            |doc| {
                target(doc);
                let both = times(doc, &[0., 1.]);
                animate(doc, "weights", both, both);
            },
        ),
    ]
}

fn channels() -> Vec<Row> {
    vec![
        glb("ANIMATION_CHANNEL_TARGET_NODE_MATRIX", "an animation of a node with a matrix", Warned, |doc| {
            moved(doc);
            node(doc)["matrix"] = json!([2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 2, 0, 0, 0, 0, 1]);
        }),
        glb(
            "ANIMATION_CHANNEL_TARGET_NODE_WEIGHTS_NO_MORPHS",
            "an animation of weights without morph targets",
            Warned,
            |doc| {
                let (input, output) = (times(doc, &[0., 1.]), doc.floats("SCALAR", &[0., 1.]));
                animate(doc, "weights", input, output);
            },
        ),
        glb("ANIMATION_DUPLICATE_TARGETS", "two channels move the same node", Warned, |doc| {
            moved(doc);
            let channel = doc.json["animations"][0]["channels"][0].clone();
            push(&mut doc.json["animations"][0]["channels"], channel);
        }),
    ]
}

fn samplers() -> Vec<Row> {
    vec![
        glb("ANIMATION_SAMPLER_ACCESSOR_WITH_BYTESTRIDE", "times with a byteStride", Warned, |doc| {
            let (input, output) = (times(doc, &[0., 9., 1.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]));
            view(doc, input)["byteStride"] = json!(8);
            let from = &mut doc.json["accessors"][input];
            (from["count"], from["max"]) = (json!(2), json!([1]));
            animate(doc, "translation", input, output);
        }),
        glb("ANIMATION_SAMPLER_INPUT_ACCESSOR_INVALID_FORMAT", "times in bytes", Warned, |doc| {
            let input = doc.accessor(5121, "SCALAR", 2, &[0, 1]);
            let output = doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]);
            (doc.json["accessors"][input]["min"], doc.json["accessors"][input]["max"]) =
                (json!([0]), json!([1]));
            animate(doc, "translation", input, output);
        }),
        glb(
            "ANIMATION_SAMPLER_INPUT_ACCESSOR_TOO_FEW_ELEMENTS",
            "a spline with one key",
            Silent("a curve with one key has its value at all times"),
            |doc| {
                let (input, output) =
                    (times(doc, &[0.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0., 0., 0., 0.]));
                animate(doc, "translation", input, output);
                doc.json["animations"][0]["samplers"][0]["interpolation"] = json!("CUBICSPLINE");
            },
        ),
        glb(
            "ANIMATION_SAMPLER_INPUT_ACCESSOR_WITHOUT_BOUNDS",
            "times without min and max",
            Silent(BOUNDS),
            |doc| {
                let (input, output) =
                    (doc.floats("SCALAR", &[0., 1.]), doc.floats("VEC3", &[0., 0., 0., 1., 0., 0.]));
                animate(doc, "translation", input, output);
            },
        ),
        glb("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_COUNT", "two times and three places", Warned, |doc| {
            let (input, output) = (times(doc, &[0., 1.]), doc.floats("VEC3", &[0.; 9]));
            animate(doc, "translation", input, output);
        }),
        glb("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT", "places of four numbers", Warned, |doc| {
            let (input, output) = (times(doc, &[0., 1.]), doc.floats("VEC4", &[0.; 8]));
            animate(doc, "translation", input, output);
        }),
        glb("ANIMATION_SAMPLER_OUTPUT_ACCESSOR_INVALID_FORMAT-shorts", "places in shorts", Warned, |doc| {
            let places: Vec<u8> = [0_i16, 0, 0, 0, 1, 0, 0, 0].iter().flat_map(|v| v.to_le_bytes()).collect();
            let (input, output) = (times(doc, &[0., 1.]), doc.accessor(5122, "VEC3", 2, &places[..12]));
            animate(doc, "translation", input, output);
        }),
    ]
}

fn buffers() -> Vec<Row> {
    vec![
        raw("BUFFER_MISSING_GLB_DATA", "a GLB without the chunk of its buffer", Refused, || {
            container(&[(JSON_CHUNK, &chunks().0)])
        }),
        glb(
            "BUFFER_VIEW_TARGET_OVERRIDE",
            "indices in a bufferView for attributes",
            Silent("target is a hint for graphics cards and is not used"),
            |doc| doc.json["bufferViews"][1]["target"] = json!(34962),
        ),
        glb("BUFFER_VIEW_TOO_LONG", "a bufferView that is longer than its buffer", Refused, |doc| {
            doc.json["bufferViews"][0]["byteLength"] = json!(4800);
        }),
        glb(
            "IMAGE_BUFFER_VIEW_WITH_BYTESTRIDE",
            "an image in a bufferView with a byteStride",
            Silent("an image's bytes follow each other, whatever the stride says"),
            |doc| {
                textured(doc, &png(), "image/png");
                let view = doc.json["images"][0]["bufferView"].as_u64().expect("a number") as usize;
                doc.json["bufferViews"][view]["byteStride"] = json!(4);
            },
        ),
        glb("INVALID_IBM_ACCESSOR_COUNT", "one bind matrix for two joints", Warned, |doc| {
            skin(doc);
            bound(doc, &bind_matrix(0, 1.0));
            push(&mut doc.json["nodes"], json!({}));
            doc.json["nodes"][1]["children"] = json!([2]);
            doc.json["skins"][0]["joints"] = json!([1, 2]);
        }),
        glb("SKIN_IBM_ACCESSOR_WITH_BYTESTRIDE", "bind matrices with a byteStride", Warned, |doc| {
            skin(doc);
            let accessor = bound(doc, &[&bind_matrix(0, 1.0)[..], &[0.0; 16]].concat());
            doc.json["accessors"][accessor]["count"] = json!(1);
            view(doc, accessor)["byteStride"] = json!(68);
        }),
        glb("SKIN_IBM_INVALID_FORMAT", "bind matrices that are vectors", Refused, |doc| {
            skin(doc);
            let accessor = doc.floats("VEC4", &[0.0; 4]);
            doc.json["skins"][0]["inverseBindMatrices"] = json!(accessor);
        }),
        glb("SKIN_IBM_INVALID_FORMAT-shorts", "bind matrices in shorts", Warned, |doc| {
            skin(doc);
            let numbers: Vec<u8> =
                bind_matrix(0, 1.0).iter().flat_map(|&value| (value as i16).to_le_bytes()).collect();
            let accessor = doc.accessor(5122, "MAT4", 1, &numbers);
            doc.json["skins"][0]["inverseBindMatrices"] = json!(accessor);
        }),
    ]
}

fn extensions() -> Vec<Row> {
    vec![
        glb(
            "KHR_MATERIALS_VARIANTS_NON_UNIQUE_VARIANT",
            "a primitive with two materials for one variant",
            Warned,
            |doc| {
                uses(doc, &["KHR_materials_variants"]);
                material(doc, json!({}));
                doc.json["extensions"] = json!({"KHR_materials_variants": {"variants": [{"name": "red"}]}});
                let mapping = json!({"material": 0, "variants": [0]});
                doc.primitive()["extensions"] =
                    json!({"KHR_materials_variants": {"mappings": [mapping, mapping]}});
            },
        ),
        glb(
            "TEXTURE_INVALID_IMAGE_MIME_TYPE",
            "a WebP image where a PNG or JPEG belongs",
            Silent(IMAGE),
            |doc| {
                textured(doc, WEBP, "image/webp");
                uses(doc, &["EXT_texture_webp"]);
            },
        ),
        glb("UNDECLARED_EXTENSION", "a clear coat that extensionsUsed does not name", Warned, |doc| {
            material(doc, json!({"extensions": {"KHR_materials_clearcoat": {"clearcoatFactor": 1}}}));
        }),
        glb(
            "UNDECLARED_EXTENSION-read",
            "an unlit material that extensionsUsed does not name",
            Silent("it is read as if it were declared"),
            |doc| material(doc, json!({"extensions": {"KHR_materials_unlit": {}}})),
        ),
        glb(
            "UNEXPECTED_EXTENSION_OBJECT",
            "a node that is KHR_materials_unlit",
            Silent("the extension means nothing there, so nothing is missing from the image"),
            |doc| {
                uses(doc, &["KHR_materials_unlit"]);
                node(doc)["extensions"] = json!({"KHR_materials_unlit": {}});
            },
        ),
    ]
}

fn primitives() -> Vec<Row> {
    vec![
        glb(
            "MESH_PRIMITIVE_ACCESSOR_UNALIGNED",
            "normals of three bytes, three bytes apart",
            Silent(ALIGNMENT),
            |doc| {
                uses(doc, &["KHR_mesh_quantization"]);
                doc.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
                let normals = doc.accessor(5120, "VEC3", 4, &[0, 0, 127].repeat(4));
                doc.json["accessors"][normals]["normalized"] = json!(true);
                attribute(doc, "NORMAL", normals);
            },
        ),
        glb(
            "MESH_PRIMITIVE_ACCESSOR_WITHOUT_BYTESTRIDE",
            "positions and normals in one bufferView without byteStride",
            Silent("without a byteStride, elements are tightly packed"),
            |doc| {
                let both = [
                    doc.bytes[..48].to_vec(),
                    [0_f32, 0., 1.].repeat(4).iter().flat_map(|v| v.to_le_bytes()).collect(),
                ];
                let view = doc.view(&both.concat());
                doc.json["accessors"][0]["bufferView"] = json!(view);
                let normals = json!({"bufferView": view, "byteOffset": 48, "componentType": 5126, "type": "VEC3", "count": 4});
                let normals = push(&mut doc.json["accessors"], normals);
                attribute(doc, "NORMAL", normals);
            },
        ),
        glb(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT",
            "colours in bytes that are not normalized",
            Warned,
            |doc| {
                let colors = doc.accessor(5121, "VEC4", 4, &[0, 1, 0, 1].repeat(4));
                attribute(doc, "COLOR_0", colors);
            },
        ),
        glb(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT-quantized",
            "positions in bytes without KHR_mesh_quantization",
            Warned,
            |doc| {
                let positions =
                    doc.accessor(5120, "VEC4", 4, &[0, 0, 0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 0, 1, 0, 0]);
                view(doc, positions)["byteStride"] = json!(4);
                let from = &mut doc.json["accessors"][positions];
                (from["type"], from["min"], from["max"]) =
                    (json!("VEC3"), json!([0, 0, 0]), json!([1, 1, 0]));
                attribute(doc, "POSITION", positions);
            },
        ),
        glb(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_INVALID_FORMAT-type",
            "normals of two numbers",
            Refused,
            |doc| {
                floats(doc, "NORMAL", "VEC2", &[0.; 8]);
            },
        ),
        glb(
            "MESH_PRIMITIVE_ATTRIBUTES_ACCESSOR_UNSIGNED_INT",
            "an application's own attribute in unsigned ints",
            Silent("attributes whose name starts with an underscore are not drawn in any format"),
            |doc| {
                let ids = doc.accessor(5125, "SCALAR", 4, &[0; 16]);
                attribute(doc, "_ID", ids);
            },
        ),
        glb(
            "MESH_PRIMITIVE_GENERATED_TANGENT_SPACE",
            "a normal map on a mesh without tangents",
            Silent("by the specification, the tangents are generated by MikkTSpace"),
            with_normal_map,
        ),
        glb("MESH_PRIMITIVE_INCOMPATIBLE_MODE", "five indices of triangles", Warned, |doc| {
            doc.json["accessors"][1]["count"] = json!(5);
        }),
        glb(
            "MESH_PRIMITIVE_INCOMPATIBLE_MODE-strip",
            "a strip of two vertices beside a sound primitive",
            Warned,
            |doc| {
                let indices = doc.accessor(5121, "SCALAR", 2, &[0, 1]);
                let strip = json!({"attributes": {"POSITION": 0}, "indices": indices, "mode": 5});
                push(&mut doc.json["meshes"][0]["primitives"], strip);
            },
        ),
        glb("MESH_PRIMITIVE_INDICES_ACCESSOR_INVALID_FORMAT", "indices that are floats", Refused, |doc| {
            let indices = doc.floats("SCALAR", &[0., 1., 2.]);
            doc.primitive()["indices"] = json!(indices);
        }),
        glb("MESH_PRIMITIVE_INDICES_ACCESSOR_WITH_BYTESTRIDE", "indices with a byteStride", Warned, |doc| {
            let indices = doc.accessor(5121, "SCALAR", 3, &[0, 9, 9, 9, 1, 9, 9, 9, 2]);
            view(doc, indices)["byteStride"] = json!(4);
            doc.primitive()["indices"] = json!(indices);
        }),
        glb(
            "MESH_PRIMITIVE_NO_TANGENT_SPACE",
            "anisotropy without tangents or a normal map",
            Warned,
            |doc| {
                normals(doc);
                uv(doc);
                let index = texture(doc, &png(), "image/png");
                extended(doc, "KHR_materials_anisotropy", json!({"anisotropyTexture": {"index": index}}));
            },
        ),
        glb(
            "MESH_PRIMITIVE_POSITION_ACCESSOR_WITHOUT_BOUNDS",
            "positions without min and max",
            Silent(BOUNDS),
            |doc| {
                let from = doc.json["accessors"][0].as_object_mut().expect("an object");
                from.remove("min");
                from.remove("max");
            },
        ),
        glb("MESH_PRIMITIVE_TOO_FEW_TEXCOORDS", "a texture that wants TEXCOORD_1", Warned, |doc| {
            textured(doc, &png(), "image/png");
            doc.json["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"]["texCoord"] = json!(1);
        }),
        glb("MESH_PRIMITIVE_UNEQUAL_ACCESSOR_COUNT", "three normals for four vertices", Warned, |doc| {
            floats(doc, "NORMAL", "VEC3", &[0., 0., 1.].repeat(3));
        }),
    ]
}

fn targets() -> Vec<Row> {
    vec![
        glb(
            "MESH_PRIMITIVE_MORPH_TARGET_INVALID_ATTRIBUTE_COUNT",
            "a morph target of three vertices of four",
            Warned,
            |doc| {
                let deltas = target(doc);
                doc.json["accessors"][deltas]["count"] = json!(3);
            },
        ),
        glb(
            "MESH_PRIMITIVE_MORPH_TARGET_NO_BASE_ACCESSOR",
            "a morph target of normals without normals",
            Warned,
            |doc| {
                target(doc);
                let deltas = doc.floats("VEC3", &[0.; 12]);
                doc.primitive()["targets"][0]["NORMAL"] = json!(deltas);
            },
        ),
    ]
}

fn nodes() -> Vec<Row> {
    vec![
        glb("NODE_LOOP", "two nodes that are each other's child", Refused, |doc| {
            push(&mut doc.json["nodes"], json!({"children": [0]}));
            node(doc)["children"] = json!([1]);
        }),
        glb("NODE_PARENT_OVERRIDE", "a node with two parents", Refused, |doc| {
            push(&mut doc.json["nodes"], json!({"children": [0]}));
            push(&mut doc.json["nodes"], json!({"children": [0]}));
            doc.json["scenes"][0]["nodes"] = json!([1, 2]);
        }),
        glb(
            "NODE_SKINNED_MESH_WITHOUT_SKIN",
            "a mesh with joints on a node without a skin",
            Silent("without a skin the mesh is static"),
            |doc| weights(doc, &[0, 0, 0, 0], &[1., 0., 0., 0.]),
        ),
        glb("NODE_SKIN_WITH_NON_SKINNED_MESH", "a skin for a mesh without joints", Warned, |doc| {
            skin(doc);
            let attributes = doc.primitive()["attributes"].as_object_mut().expect("an object");
            attributes.retain(|name, _| name == "POSITION");
        }),
        glb("NODE_WEIGHTS_INVALID", "two weights of a node for one morph target", Warned, |doc| {
            target(doc);
            node(doc)["weights"] = json!([0, 1]);
        }),
        glb("SCENE_NON_ROOT_NODE", "a scene lists a node and its parent", Warned, |doc| {
            push(&mut doc.json["nodes"], json!({"children": [0], "translation": [1, 0, 0]}));
            doc.json["scenes"][0]["nodes"] = json!([0, 1]);
        }),
        glb("SCENE_NON_ROOT_NODE-alone", "a scene lists a node without its parent", Warned, |doc| {
            push(&mut doc.json["nodes"], json!({"children": [0], "translation": [1, 0, 0]}));
        }),
    ]
}

fn references() -> Vec<Row> {
    vec![
        glb("UNRESOLVED_REFERENCE", "a node with a mesh that does not exist", Refused, |doc| {
            node(doc)["mesh"] = json!(7);
        }),
        glb(
            "UNRESOLVED_REFERENCE-material",
            "a primitive with a material that does not exist",
            Refused,
            |doc| {
                doc.primitive()["material"] = json!(7);
            },
        ),
        glb("UNRESOLVED_REFERENCE-image", "a texture with an image that does not exist", Refused, |doc| {
            textured(doc, &png(), "image/png");
            doc.json["textures"][0]["source"] = json!(7);
        }),
        glb("UNRESOLVED_REFERENCE-joint", "a skin with a joint that does not exist", Refused, |doc| {
            skin(doc);
            doc.json["skins"][0]["joints"] = json!([7]);
        }),
        glb("UNRESOLVED_REFERENCE-webp", "a WebP texture with an image that does not exist", Warned, |doc| {
            textured(doc, &png(), "image/png");
            uses(doc, &["EXT_texture_webp"]);
            doc.json["textures"][0] = json!({"extensions": {"EXT_texture_webp": {"source": 7}}});
        }),
        glb(
            "UNRESOLVED_REFERENCE-skeleton",
            "a skin with a skeleton that does not exist",
            Silent("the skeleton does not affect the image"),
            |doc| {
                skin(doc);
                doc.json["skins"][0]["skeleton"] = json!(7);
            },
        ),
        glb("UNRESOLVED_REFERENCE-light", "a node with a light that does not exist", Refused, |doc| {
            light(doc, json!({"type": "point"}));
            doc.json["nodes"][1]["extensions"]["KHR_lights_punctual"]["light"] = json!(7);
        }),
    ]
}
