//! A mesh and its edit data as named runs of little-endian numbers.
//!
//! Writer and reader visit the columns in the same order, and both hash them, so a file whose views
//! differ from those written is detected.

use std::collections::BTreeSet;

use serde_json::value::RawValue;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{
    Attributes, Deltas, EdgeMark, EditData, Mesh, MeshColumns, MorphTarget, SkinWeights, VertexGroupData,
};

use super::NativeHeader;
use crate::formats::gltf::triangle_hash::xxh64;

const SHARP: u32 = 1;
const SEAM: u32 = 2;
const HIDDEN: u32 = 4;

/// The columns of a mesh, with their names, and the hash of them all.
#[derive(Default)]
pub(in crate::formats::gltf) struct ColumnWriter {
    pub(in crate::formats::gltf) columns: Vec<(String, Vec<u8>)>,
    hashed: Vec<u8>,
}

impl ColumnWriter {
    fn push(&mut self, name: impl Into<String>, bytes: Vec<u8>) {
        let name = name.into();
        hash_column(&mut self.hashed, &name, &bytes);
        // Views have at least one byte.
        if !bytes.is_empty() {
            self.columns.push((name, bytes));
        }
    }

    fn floats<const N: usize>(
        &mut self,
        name: impl Into<String>,
        values: impl ExactSizeIterator<Item = [f32; N]>,
    ) {
        let mut bytes = vec![0; values.len() * N * 4];
        for (to, from) in bytes.chunks_exact_mut(N * 4).zip(values) {
            for (to, from) in to.as_chunks_mut::<4>().0.iter_mut().zip(from) {
                *to = from.to_le_bytes();
            }
        }
        self.push(name, bytes);
    }

    fn words(&mut self, name: impl Into<String>, values: impl ExactSizeIterator<Item = u32>) {
        let mut bytes = vec![0; values.len() * 4];
        for (to, from) in bytes.as_chunks_mut::<4>().0.iter_mut().zip(values) {
            *to = from.to_le_bytes();
        }
        self.push(name, bytes);
    }

    /// The hash of all columns.
    pub(in crate::formats::gltf) fn hash(&self) -> String {
        format!("{:016x}", xxh64(&self.hashed))
    }
}

/// A column without values is equivalent to a missing one.
fn hash_column(hashed: &mut Vec<u8>, name: &str, bytes: &[u8]) {
    if bytes.is_empty() {
        return;
    }
    hashed.extend((name.len() as u32).to_le_bytes());
    hashed.extend(name.as_bytes());
    hashed.extend((bytes.len() as u64).to_le_bytes());
    hashed.extend(xxh64(bytes).to_le_bytes());
}

/// The columns of a mesh, and of its edit data if it was edited, with the corresponding header fields.
pub(in crate::formats::gltf) fn columns_of_mesh(
    mesh: &Mesh,
    edit_data: Option<&EditData>,
) -> (ColumnWriter, NativeHeader) {
    let mut writer = ColumnWriter::default();
    let attributes = mesh.attributes();
    writer.floats("positions", mesh.positions().iter().map(|position| position.to_array()));
    writer.words("faceSizes", mesh.faces().map(|corners| corners.len() as u32));
    writer.words("cornerVertices", mesh.corner_vertices().iter().copied());
    writer.words("looseEdges", mesh.loose_edges().as_flattened().iter().copied());
    writer.words("loosePoints", mesh.loose_points().iter().copied());
    if let Some(materials) = &attributes.face_materials {
        writer.words("faceMaterials", materials.iter().copied());
    }
    if let Some(smooth) = &attributes.face_smooth {
        writer.push("faceSmooth", smooth.iter().map(|&smooth| u8::from(smooth)).collect());
    }
    if let Some(normals) = &attributes.corner_normals {
        writer.floats("cornerNormals", normals.iter().map(|normal| normal.to_array()));
    }
    if let Some(tangents) = &attributes.corner_tangents {
        writer.floats("cornerTangents", tangents.iter().map(|tangent| tangent.to_array()));
    }
    if let Some(colors) = &attributes.corner_colors {
        writer.floats("cornerColors", colors.iter().map(|color| color.to_array()));
    }
    if let Some(colors) = &attributes.vertex_colors {
        writer.floats("vertexColors", colors.iter().map(|color| color.to_array()));
    }
    for (set, uvs) in attributes.uv_sets.iter().enumerate() {
        writer.floats(format!("uv{set}"), uvs.iter().map(|uv| uv.to_array()));
    }
    if let Some(skin) = &attributes.skin {
        writer.push("joints", skin.joints().iter().flat_map(|joint| joint.to_le_bytes()).collect());
        writer.floats("weights", skin.weights().iter().map(|&weight| [weight]));
    }
    for (number, target) in attributes.morph_targets.iter().enumerate() {
        for (kind, deltas) in deltas_of(target) {
            writer.words(format!("target{number}.{kind}.indices"), deltas.iter().map(|(index, _)| index));
            writer.floats(format!("target{number}.{kind}"), deltas.iter().map(|(_, value)| value.to_array()));
        }
    }
    if let Some(data) = edit_data {
        write_edit_data(&mut writer, data);
    }
    let header = NativeHeader {
        version: super::VERSION,
        data: writer.hash(),
        joints_per_vertex: attributes.skin.as_ref().map(SkinWeights::per_vertex),
        targets: attributes.morph_targets.len(),
        edited: edit_data.is_some(),
        groups: edit_data.map_or_else(Vec::new, group_names),
        modifiers: edit_data.and_then(|data| RawValue::from_string(data.modifiers.clone()).ok()),
        empty: if mesh.face_count() == 0 { optional_columns(attributes) } else { BTreeSet::new() },
        ..NativeHeader::default()
    };
    (writer, header)
}

/// The existing columns of faces and corners of a mesh without faces: all are empty.
fn optional_columns(attributes: &Attributes) -> BTreeSet<String> {
    let known = [
        ("faceMaterials", attributes.face_materials.is_some()),
        ("faceSmooth", attributes.face_smooth.is_some()),
        ("cornerNormals", attributes.corner_normals.is_some()),
        ("cornerTangents", attributes.corner_tangents.is_some()),
        ("cornerColors", attributes.corner_colors.is_some()),
    ];
    let named = known.into_iter().filter(|(_, is_there)| *is_there).map(|(name, _)| name.to_owned());
    named.chain((0..attributes.uv_sets.len()).map(|set| format!("uv{set}"))).collect()
}

fn deltas_of(target: &MorphTarget) -> [(&'static str, &Deltas); 3] {
    [("positions", &target.positions), ("normals", &target.normals), ("tangents", &target.tangents)]
}

fn write_edit_data(writer: &mut ColumnWriter, data: &EditData) {
    writer.floats("firstPositions", data.first_positions.iter().map(|position| position.to_array()));
    let flag = |is_set: bool, flag: u32| if is_set { flag } else { 0 };
    let edge = |mark: &EdgeMark| {
        let flags = flag(mark.is_sharp, SHARP) | flag(mark.is_seam, SEAM) | flag(mark.is_hidden, HIDDEN);
        [mark.vertices[0], mark.vertices[1], flags, mark.crease.to_bits()]
    };
    let edges: Vec<[u32; 4]> = data.edges.iter().map(edge).collect();
    writer.words("edgeMarks", edges.as_flattened().iter().copied());
    writer.words("hiddenVertices", data.hidden_vertices.iter().copied());
    writer.words("hiddenFaces", data.hidden_faces.iter().copied());
    writer.words("sharpCorners", data.sharp_corners.iter().copied());
    writer.words("pinnedCorners", data.pinned_corners.as_flattened().iter().copied());
    for (number, group) in data.vertex_groups.iter().enumerate() {
        writer.words(format!("group{number}.vertices"), group.vertices.iter().copied());
        writer.floats(format!("group{number}.weights"), group.weights.iter().map(|&weight| [weight]));
    }
}

fn group_names(data: &EditData) -> Vec<String> {
    data.vertex_groups.iter().map(|group| group.name.clone()).collect()
}

/// Finds the bytes of columns by name, and hashes those requested.
pub(in crate::formats::gltf) struct ColumnReader<'b> {
    /// Columns that exist without values.
    empty: &'b BTreeSet<String>,
    /// The bytes of each column, by its name.
    find: &'b dyn Fn(&str) -> Option<&'b [u8]>,
    hashed: Vec<u8>,
}

impl<'b> ColumnReader<'b> {
    pub(in crate::formats::gltf) fn new(
        header: &'b NativeHeader,
        find: &'b dyn Fn(&str) -> Option<&'b [u8]>,
    ) -> Self {
        Self { empty: &header.empty, find, hashed: Vec::new() }
    }

    pub(in crate::formats::gltf) fn hash(&self) -> String {
        format!("{:016x}", xxh64(&self.hashed))
    }

    /// A column; a missing one is empty.
    fn column(&mut self, name: &str) -> &'b [u8] {
        let bytes = (self.find)(name).unwrap_or_default();
        hash_column(&mut self.hashed, name, bytes);
        bytes
    }

    /// An optional column.
    fn optional(&mut self, name: &str) -> Option<&'b [u8]> {
        let is_there = (self.find)(name).is_some() || self.empty.contains(name);
        is_there.then(|| self.column(name))
    }

    fn words(&mut self, name: &str) -> Result<Vec<u32>, String> {
        words(name, self.column(name))
    }
}

fn words(name: &str, bytes: &[u8]) -> Result<Vec<u32>, String> {
    let (words, []) = bytes.as_chunks::<4>() else { return Err(uneven(name)) };
    Ok(words.iter().map(|word| u32::from_le_bytes(*word)).collect())
}

fn uneven(name: &str) -> String {
    format!("its {name} end within a value")
}

fn floats<const N: usize>(name: &str, bytes: &[u8]) -> Result<Vec<[f32; N]>, String> {
    if !bytes.len().is_multiple_of(4 * N) {
        return Err(uneven(name));
    }
    let vector = |bytes: &[u8]| {
        let (numbers, _) = bytes.as_chunks::<4>();
        std::array::from_fn(|index| f32::from_le_bytes(numbers[index]))
    };
    Ok(bytes.chunks_exact(4 * N).map(vector).collect())
}

fn vec3(name: &str, bytes: &[u8]) -> Result<Vec<Vec3>, String> {
    Ok(floats::<3>(name, bytes)?.into_iter().map(Vec3::from_array).collect())
}

/// The mesh in some columns, and its edit data.
///
/// # Errors
/// The contradiction, in words.
pub(in crate::formats::gltf) fn mesh_from_columns(
    reader: &mut ColumnReader<'_>,
    header: &NativeHeader,
) -> Result<(Mesh, Option<EditData>), String> {
    let positions = reader.column("positions");
    let columns = MeshColumns {
        positions: vec3("positions", positions)?,
        face_sizes: reader.words("faceSizes")?,
        corner_vertices: reader.words("cornerVertices")?,
        loose_edges: {
            let ends = reader.words("looseEdges")?;
            let (pairs, []) = ends.as_chunks::<2>() else { return Err(uneven("looseEdges")) };
            pairs.to_vec()
        },
        loose_points: reader.words("loosePoints")?,
    };
    let attributes = read_attributes(reader, header)?;
    let edit_data = header.edited.then(|| read_edit_data(reader, header)).transpose()?;
    let mut mesh = Mesh::from_columns(columns).map_err(|error| error.to_string())?;
    mesh.set_attributes(attributes).map_err(|error| error.to_string())?;
    Ok((mesh, edit_data))
}

fn read_attributes(reader: &mut ColumnReader<'_>, header: &NativeHeader) -> Result<Attributes, String> {
    let mut attributes = Attributes::default();
    if let Some(bytes) = reader.optional("faceMaterials") {
        attributes.face_materials = Some(words("faceMaterials", bytes)?);
    }
    if let Some(bytes) = reader.optional("faceSmooth") {
        attributes.face_smooth = Some(bytes.iter().map(|&byte| byte != 0).collect());
    }
    if let Some(bytes) = reader.optional("cornerNormals") {
        attributes.corner_normals = Some(vec3("cornerNormals", bytes)?);
    }
    if let Some(bytes) = reader.optional("cornerTangents") {
        let tangents = floats::<4>("cornerTangents", bytes)?;
        attributes.corner_tangents = Some(tangents.into_iter().map(Vec4::from_array).collect());
    }
    if let Some(bytes) = reader.optional("cornerColors") {
        let colors = floats::<4>("cornerColors", bytes)?;
        attributes.corner_colors = Some(colors.into_iter().map(Vec4::from_array).collect());
    }
    if let Some(bytes) = reader.optional("vertexColors") {
        let colors = floats::<4>("vertexColors", bytes)?;
        attributes.vertex_colors = Some(colors.into_iter().map(Vec4::from_array).collect());
    }
    while let Some(bytes) = reader.optional(&format!("uv{}", attributes.uv_sets.len())) {
        let uvs = floats::<2>("uv", bytes)?;
        attributes.uv_sets.push(uvs.into_iter().map(Vec2::from_array).collect());
    }
    if let Some(per_vertex) = header.joints_per_vertex {
        attributes.skin = Some(read_skin(reader, per_vertex)?);
    }
    for number in 0..header.targets {
        attributes.morph_targets.push(read_target(reader, number)?);
    }
    Ok(attributes)
}

fn read_skin(reader: &mut ColumnReader<'_>, per_vertex: usize) -> Result<SkinWeights, String> {
    let (joints, []) = reader.column("joints").as_chunks::<2>() else { return Err(uneven("joints")) };
    let joints = joints.iter().map(|joint| u16::from_le_bytes(*joint)).collect();
    let weights = floats::<1>("weights", reader.column("weights"))?.into_flattened();
    let skin = SkinWeights::from_normalized(per_vertex, joints, weights);
    skin.ok_or_else(|| "its joints and weights do not fit each other".to_owned())
}

fn read_target(reader: &mut ColumnReader<'_>, number: usize) -> Result<MorphTarget, String> {
    let mut deltas = |kind: &str| {
        let name = format!("target{number}.{kind}");
        let indices = reader.words(&format!("{name}.indices"))?;
        let values = vec3(&name, reader.column(&name))?;
        if indices.len() != values.len() {
            return Err(format!("its {name} and their indices differ in number"));
        }
        Ok(Deltas::new(indices.into_iter().zip(values).collect()))
    };
    let (positions, normals, tangents) = (deltas("positions")?, deltas("normals")?, deltas("tangents")?);
    Ok(MorphTarget { name: String::new(), positions, normals, tangents })
}

/// The stack of modifiers as text; empty without any.
fn modifiers_of(header: &NativeHeader) -> String {
    match (&header.modifiers, header.subdivision) {
        (Some(modifiers), _) => modifiers.get().to_owned(),
        (None, 0) => String::new(),
        (None, levels) => {
            format!(r#"[{{"modifier":{{"kind":"subdivision","levels":{levels}}},"is_on":true}}]"#)
        }
    }
}

fn read_groups(reader: &mut ColumnReader<'_>, names: &[String]) -> Result<Vec<VertexGroupData>, String> {
    let read = |(number, name): (usize, &String)| {
        let vertices = reader.words(&format!("group{number}.vertices"))?;
        let column = format!("group{number}.weights");
        let weights = floats::<1>(&column, reader.column(&column))?.into_flattened();
        Ok(VertexGroupData { name: name.clone(), vertices, weights })
    };
    names.iter().enumerate().map(read).collect()
}

fn read_edit_data(reader: &mut ColumnReader<'_>, header: &NativeHeader) -> Result<EditData, String> {
    let first_positions = vec3("firstPositions", reader.column("firstPositions"))?;
    let edges = reader.words("edgeMarks")?;
    let (edges, []) = edges.as_chunks::<4>() else { return Err(uneven("edgeMarks")) };
    let edge = |&[a, b, flags, crease]: &[u32; 4]| EdgeMark {
        vertices: [a, b],
        is_sharp: flags & SHARP != 0,
        is_seam: flags & SEAM != 0,
        is_hidden: flags & HIDDEN != 0,
        crease: f32::from_bits(crease),
    };
    Ok(EditData {
        first_positions,
        edges: edges.iter().map(edge).collect(),
        hidden_vertices: reader.words("hiddenVertices")?,
        hidden_faces: reader.words("hiddenFaces")?,
        sharp_corners: reader.words("sharpCorners")?,
        pinned_corners: {
            let words = reader.words("pinnedCorners")?;
            let (pairs, []) = words.as_chunks::<2>() else { return Err(uneven("pinnedCorners")) };
            pairs.to_vec()
        },
        vertex_groups: read_groups(reader, &header.groups)?,
        modifiers: modifiers_of(header),
    })
}
