//! The glTF file that a scene came from, for programs that write it back: its JSON, its buffers and
//! images, and the object in the file for each part of the scene.
//!
//! A scene holds what is drawn. The file holds more: `extras`, extensions that trigon does not
//! read, objects that nothing uses, numbers with more digits than an f64 has. An editor takes all
//! of these from here, as text and bytes, so that nothing is rounded, sorted or lost.
//!
//! A load collects it (`keep` of the reader fills the draft), and `text` finds parts of the JSON. None of it
//! runs without [`LoadOptions::keep_source`](crate::LoadOptions::keep_source).

mod text;

use std::collections::{BTreeMap, BTreeSet};
use std::fmt;
use std::ops::Range;
use std::sync::Arc;

use trigon_scene::{MaterialId, MeshId, NodeId, SkinId, TextureId};

use super::texture_request::{ImageBytes, Request};

pub(crate) use text::JsonText;

/// A glTF or GLB file as it was read, with its mapping to the scene.
///
/// ```
/// use trigon_io::{LoadOptions, load_from_slice};
///
/// let gltf = br#"{
///     "asset": {"version": "2.0"},
///     "buffers": [{"byteLength": 36, "uri": "data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00"}],
///     "bufferViews": [{"buffer": 0, "byteLength": 36}],
///     "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
///     "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
///     "nodes": [{}, {"mesh": 0, "extras": {"part": 12345678901234567890123}}]
/// }"#;
/// let options = LoadOptions { keep_source: true, ..LoadOptions::default() };
/// let loaded = load_from_slice("part.gltf", gltf, &options)?;
/// let source = loaded.source.expect("it was asked for");
///
/// let (id, _) = loaded.scene.nodes().iter().find(|(_, node)| node.mesh.is_some()).expect("a node");
/// let node = source.node(id).expect("the file has it");
/// assert_eq!(node, 1);
/// assert_eq!(source.at(&format!("/nodes/{node}/extras")), Some(r#"{"part": 12345678901234567890123}"#));
/// assert_eq!(source.buffer(0).map(<[u8]>::len), Some(36));
/// # Ok::<(), trigon_io::LoadError>(())
/// ```
///
/// Ids are those of the scene as it was loaded. They stay valid while the scene is edited; parts
/// added later have no index here. Chunks of a GLB that are neither JSON nor binary are not kept.
pub struct GltfSource {
    text: JsonText,
    buffers: Vec<Option<Arc<[u8]>>>,
    images: Vec<Option<SharedBytes>>,
    origins: Origins,
}

/// A part of shared bytes.
#[derive(Clone)]
pub(crate) struct SharedBytes {
    bytes: Arc<[u8]>,
    range: Range<usize>,
}

impl SharedBytes {
    fn get(&self) -> &[u8] {
        &self.bytes[self.range.clone()]
    }
}

impl GltfSource {
    /// The JSON, byte by byte as in the file, without a leading byte order mark and without the
    /// zeros that some exporters append in a GLB.
    #[must_use]
    pub fn json(&self) -> &str {
        self.text.whole()
    }

    /// The part of the JSON at a pointer (RFC 6901, such as `/materials/2/normalTexture/extras`),
    /// as written in the file; `None` if there is no such part. Of members with the same name the
    /// last counts.
    ///
    /// It reads through the object given by the first two steps, such as one node; for pointers
    /// that do not begin with a list of the format, through the whole file.
    #[must_use]
    pub fn at(&self, pointer: &str) -> Option<&str> {
        self.text.at(pointer)
    }

    /// The bytes of a buffer of the file, at least as many as its `byteLength`; `None` if it does
    /// not exist, could not be read, or is an empty stand-in for a compressed one.
    #[must_use]
    pub fn buffer(&self, buffer: usize) -> Option<&[u8]> {
        self.buffers.get(buffer)?.as_deref()
    }

    /// The encoded bytes (PNG, JPEG, KTX2 …) of an image of the file, whether in a buffer, a file
    /// or a `data:` URI; `None` if it does not exist or could not be read.
    #[must_use]
    pub fn image(&self, image: usize) -> Option<&[u8]> {
        Some(self.images.get(image)?.as_ref()?.get())
    }

    /// The index in `nodes` of a node; `None` for the copies made by EXT_mesh_gpu_instancing, which
    /// are children of the file's node.
    #[must_use]
    pub fn node(&self, id: NodeId) -> Option<usize> {
        self.origins.nodes.get(&id).copied()
    }

    /// The index in `meshes` of a mesh.
    #[must_use]
    pub fn mesh(&self, id: MeshId) -> Option<usize> {
        Some(self.origins.meshes.get(&id)?.index)
    }

    /// The index, in the `primitives` of its mesh, of the primitive that a face came from. `face`
    /// counts the faces of the mesh as it was loaded.
    #[must_use]
    pub fn primitive(&self, id: MeshId, face: usize) -> Option<usize> {
        self.origins.meshes.get(&id)?.primitive(face)
    }

    /// The index in `materials` of a material; `None` for the default one. Its textures are found
    /// through the material: `/materials/2/normalTexture/index`.
    #[must_use]
    pub fn material(&self, id: MaterialId) -> Option<usize> {
        self.origins.materials.get(&id).copied()
    }

    /// The indices in `images` of a texture, in increasing order: identical images become one
    /// texture, and an image used both for colours and for data becomes two.
    pub fn images(&self, id: TextureId) -> impl Iterator<Item = usize> {
        self.origins.textures.get(&id).into_iter().flatten().copied()
    }

    /// The index in `skins` of a skin.
    #[must_use]
    pub fn skin(&self, id: SkinId) -> Option<usize> {
        self.origins.skins.get(&id).copied()
    }

    /// The index in `animations` of an animation of the scene, by its position in
    /// [`Scene::animations`](trigon_scene::Scene::animations), which leaves out those that move
    /// nothing in the scene.
    #[must_use]
    pub fn animation(&self, animation: usize) -> Option<usize> {
        self.origins.animations.get(animation).copied()
    }

    /// The index in `scenes` of the loaded scene; `None` if the file has no scenes.
    #[must_use]
    pub fn scene(&self) -> Option<usize> {
        self.origins.scene
    }

    /// The index in `cameras` of a node's camera.
    #[must_use]
    pub fn camera(&self, id: NodeId) -> Option<usize> {
        self.origins.cameras.get(&id).copied()
    }

    /// The index in the `lights` of KHR_lights_punctual of a node's light.
    #[must_use]
    pub fn light(&self, id: NodeId) -> Option<usize> {
        self.origins.lights.get(&id).copied()
    }
}

/// Prints sizes only, not megabytes of content.
impl fmt::Debug for GltfSource {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let retained = |list: usize, bytes: usize| format!("{list} with {bytes} bytes");
        let buffers = self.buffers.iter().flatten().map(|bytes| bytes.len()).sum();
        let images = self.images.iter().flatten().map(|image| image.range.len()).sum();
        f.debug_struct("GltfSource")
            .field("json", &format!("{} bytes", self.json().len()))
            .field("buffers", &retained(self.buffers.len(), buffers))
            .field("images", &retained(self.images.len(), images))
            .finish_non_exhaustive()
    }
}

/// The data collected so far.
#[derive(Default)]
pub(crate) struct SourceDraft {
    /// `None` as long as the file is not known to be a glTF.
    pub(crate) text: Option<JsonText>,
    pub(crate) buffers: Vec<Option<Arc<[u8]>>>,
    pub(crate) images: BTreeMap<usize, SharedBytes>,
    pub(crate) image_count: usize,
    pub(crate) origins: Origins,
}

impl SourceDraft {
    /// Records the images given by their index in `requests`, and the textures that they became.
    pub(crate) fn note_images(
        &mut self,
        requests: &[Request],
        textures: &[Option<TextureId>],
        images: impl Iterator<Item = (usize, usize)>,
    ) {
        // Many images may be the same file, which is kept once.
        let shared: Vec<SharedBytes> = requests.iter().map(|request| share(&request.layers[0].1)).collect();
        for (image, request) in images {
            self.images.entry(image).or_insert_with(|| shared[request].clone());
            if let Some(id) = textures[request] {
                self.origins.textures.entry(id).or_default().insert(image);
            }
        }
    }

    /// Records the next animation of the scene.
    pub(crate) fn note_animation(&mut self, index: usize) {
        self.origins.animations.push(index);
    }

    /// The source; `None` if the file was not a glTF.
    pub(crate) fn finish(self) -> Option<GltfSource> {
        let Self { text, buffers, mut images, image_count, origins } = self;
        let images = (0..image_count).map(|image| images.remove(&image)).collect();
        Some(GltfSource { text: text?, buffers, images, origins })
    }
}

pub(crate) fn share(bytes: &ImageBytes) -> SharedBytes {
    match bytes {
        ImageBytes::Own(bytes) => SharedBytes { bytes: bytes.as_slice().into(), range: 0..bytes.len() },
        ImageBytes::Shared(buffer, range) => SharedBytes { bytes: buffer.clone(), range: range.clone() },
    }
}

/// Indices of the file by ids of the scene.
#[derive(Default)]
pub(crate) struct Origins {
    pub(crate) nodes: BTreeMap<NodeId, usize>,
    pub(crate) meshes: BTreeMap<MeshId, MeshOrigin>,
    pub(crate) materials: BTreeMap<MaterialId, usize>,
    pub(crate) textures: BTreeMap<TextureId, BTreeSet<usize>>,
    pub(crate) skins: BTreeMap<SkinId, usize>,
    /// By their index in the scene.
    pub(crate) animations: Vec<usize>,
    pub(crate) cameras: BTreeMap<NodeId, usize>,
    pub(crate) lights: BTreeMap<NodeId, usize>,
    /// The loaded scene, if the file has scenes.
    pub(crate) scene: Option<usize>,
}

/// A mesh of the file.
pub(crate) struct MeshOrigin {
    pub(crate) index: usize,
    /// In the order of their faces.
    pub(crate) primitives: Vec<PrimitiveFaces>,
}

/// The faces of a primitive: from the end of the previous one's.
#[derive(Clone, Debug)]
pub(crate) struct PrimitiveFaces {
    /// Its index in the mesh of the file.
    pub(crate) primitive: usize,
    /// One after its last face.
    pub(crate) end: usize,
}

impl MeshOrigin {
    fn primitive(&self, face: usize) -> Option<usize> {
        let next = self.primitives.partition_point(|faces| faces.end <= face);
        Some(self.primitives.get(next)?.primitive)
    }
}
