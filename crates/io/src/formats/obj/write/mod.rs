//! Writes scenes as OBJ: objects with their polygons, normals, texture coordinates and vertex colours. `materials`
//! writes the material library and the images beside it.

mod materials;

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::path::Path;

use trigon_math::color::linear_to_srgb;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_scene::MaterialId;

use self::materials::ImageFiles;
use crate::export::Loss;
use crate::export::{ExportOptions, ExportedFile, Gathered, Object, Precision, plain_name, push_number};
use crate::write::WriteError;

/// Writes an OBJ with its MTL and its images.
pub(crate) fn write_obj(
    name: &str,
    gathered: &mut Gathered<'_>,
    options: &ExportOptions<'_>,
) -> Result<Vec<ExportedFile>, WriteError> {
    let stem = plain_name(&Path::new(name).file_stem().unwrap_or_default().to_string_lossy(), "model");
    let materials = name_materials(gathered);
    let library = format!("{stem}.mtl");
    let mut text = "# written by trigon\n".to_owned();
    if !materials.is_empty() {
        text += &format!("mtllib {library}\n");
    }
    let mut names = UniqueNames::default();
    let mut elements = ElementWriter::new(text);
    for object in &gathered.objects {
        elements.object(gathered, object, &names.unique(&object.node.name, "object"), &materials);
    }
    let has_varying_colors = elements.has_varying_colors;
    let text = elements.text;
    let mut images = ImageFiles::new(&stem, gathered.scene, options.images);
    let mtl = materials::write(gathered, &materials, &mut images);
    if has_varying_colors {
        gathered.losses.push(Loss::of_scene("vertex colours that differ between the faces of a vertex"));
    }
    let mut files = images.into_files();
    if !materials.is_empty() {
        files.push(ExportedFile { name: library, bytes: mtl.into_bytes() });
    }
    files.push(ExportedFile { name: name.to_owned(), bytes: text.into_bytes() });
    Ok(files)
}

/// Names that are each used once: readers unite what has the same.
#[derive(Default)]
struct UniqueNames {
    known: BTreeSet<String>,
}

impl UniqueNames {
    fn unique(&mut self, name: &str, otherwise: &str) -> String {
        let plain = plain_name(name, otherwise);
        let mut unique = plain.clone();
        let mut number = 1;
        while !self.known.insert(unique.clone()) {
            number += 1;
            unique = format!("{plain}_{number}");
        }
        unique
    }
}

/// The names of the materials that faces have: of the default one if others have one of their own.
type MaterialNames = BTreeMap<Option<MaterialId>, String>;

fn name_materials(gathered: &Gathered<'_>) -> MaterialNames {
    let (mut names, mut materials) = (UniqueNames::default(), BTreeMap::new());
    for object in &gathered.objects {
        for &face in &object.sources {
            let id = object.material(face);
            let name =
                id.and_then(|id| gathered.scene.materials.get(id)).map_or("default", |found| &found.name);
            materials.entry(id).or_insert_with(|| names.unique(name, "material"));
        }
    }
    if materials.keys().all(Option::is_none) { MaterialNames::new() } else { materials }
}

/// The text so far, and how many of each kind there are: indices count through the whole file.
struct ElementWriter {
    text: String,
    /// Whether a vertex has several colours, of which the first is written.
    has_varying_colors: bool,
    vertices: usize,
    coordinates: usize,
    normals: usize,
    /// What the last statements said: they hold for all that follows.
    material: Option<Option<MaterialId>>,
    is_smooth: bool,
}

/// The numbers of values that are written once each.
struct WrittenNumbers<const N: usize> {
    known: HashMap<[u32; N], usize>,
    /// Of each corner of the object's faces, in order.
    of_corners: Vec<usize>,
}

impl<const N: usize> WrittenNumbers<N> {
    fn new() -> Self {
        Self { known: HashMap::new(), of_corners: Vec::new() }
    }

    /// Whether the value of the next corner is new. `count` is how many there are in the file.
    fn push(&mut self, bits: [u32; N], count: &mut usize) -> bool {
        let number = *self.known.entry(bits).or_insert(*count + 1);
        self.of_corners.push(number);
        let is_new = number > *count;
        *count += usize::from(is_new);
        is_new
    }
}

impl ElementWriter {
    fn new(text: String) -> Self {
        Self {
            text,
            has_varying_colors: false,
            vertices: 0,
            coordinates: 0,
            normals: 0,
            material: None,
            is_smooth: false,
        }
    }

    fn object(
        &mut self,
        gathered: &Gathered<'_>,
        object: &Object<'_>,
        name: &str,
        materials: &MaterialNames,
    ) {
        self.text += &format!("o {name}\n");
        let base = self.vertices;
        self.positions(gathered, object);
        let coordinates = self.coordinates(object);
        let normals = self.normals(object);
        self.faces(object, materials, |at, vertex| WrittenCorner {
            vertex: base + vertex as usize + 1,
            coordinate: coordinates.as_ref().map(|numbers| numbers.of_corners[at]),
            normal: normals.as_ref().map(|numbers| numbers.of_corners[at]),
        });
        for edge in object.mesh.loose_edges() {
            let [from, to] = edge.map(|end| base + end as usize + 1);
            self.text += &format!("l {from} {to}\n");
        }
        for &point in object.mesh.loose_points() {
            self.text += &format!("p {}\n", base + point as usize + 1);
        }
    }

    fn row(&mut self, keyword: &str, values: &[f64], precision: Precision) {
        self.text += keyword;
        for &value in values {
            self.text.push(' ');
            push_number(&mut self.text, value, precision);
        }
    }

    fn positions(&mut self, gathered: &Gathered<'_>, object: &Object<'_>) {
        let colors = self.colors(object);
        for vertex in 0..object.mesh.vertex_count() as u32 {
            let position = gathered.position(object, vertex).to_array();
            self.row("v", &position, gathered.precision);
            if let Some(colors) = &colors {
                let color = colors[vertex as usize].truncate().to_array();
                let encoded = color.map(|channel| f64::from(linear_to_srgb(channel.clamp(0.0, 1.0))));
                self.row("", &encoded, Precision::Single);
            }
            self.text.push('\n');
        }
        self.vertices += object.mesh.vertex_count();
    }

    /// The colour of each vertex: that of its first corner, or without one that of lines and points.
    fn colors(&mut self, object: &Object<'_>) -> Option<Vec<Vec4>> {
        let (mesh, attributes) = (object.mesh, object.mesh.attributes());
        if !attributes.has_colors() {
            return None;
        }
        let mut colors: Vec<Option<Vec4>> = vec![None; mesh.vertex_count()];
        let mut set = |vertex: u32, color: Vec4| {
            let first = *colors[vertex as usize].get_or_insert(color);
            self.has_varying_colors |= first != color;
        };
        if let Some(of_corners) = &attributes.corner_colors {
            object.corners.iter().for_each(|&corner| set(object.vertex(corner), of_corners[corner as usize]));
        }
        if let Some(of_vertices) = &attributes.vertex_colors {
            let wires = mesh.loose_edges().as_flattened().iter().chain(mesh.loose_points());
            wires.for_each(|&vertex| set(vertex, of_vertices[vertex as usize]));
        }
        Some(colors.into_iter().map(|color| color.unwrap_or(Vec4::ONE)).collect())
    }

    fn coordinates(&mut self, object: &Object<'_>) -> Option<WrittenNumbers<2>> {
        let uvs = object.mesh.attributes().uv_sets.first()?;
        let mut numbers = WrittenNumbers::new();
        for &corner in &object.corners {
            let uv = Some(uvs[corner as usize]).filter(|uv| uv.is_finite()).unwrap_or(Vec2::ZERO);
            if numbers.push(uv.to_array().map(f32::to_bits), &mut self.coordinates) {
                // OBJ counts v upwards; all digits of 1 − v bring v back.
                self.row("vt", &[f64::from(uv.x), 1.0 - f64::from(uv.y)], Precision::Double);
                self.text.push('\n');
            }
        }
        Some(numbers)
    }

    fn normals(&mut self, object: &Object<'_>) -> Option<WrittenNumbers<3>> {
        let given = object.mesh.attributes().corner_normals.as_ref()?;
        // Where there is none, the reader is to find none either, and OBJ has it for whole faces only.
        if given.iter().all(|&normal| normal == Vec3::ZERO) {
            return None;
        }
        let mut numbers = WrittenNumbers::new();
        for &corner in &object.corners {
            let normal = object.normal(corner).to_array();
            if numbers.push(normal.map(f32::to_bits), &mut self.normals) {
                self.row("vn", &normal.map(f64::from), Precision::Single);
                self.text.push('\n');
            }
        }
        Some(numbers)
    }

    fn faces(
        &mut self,
        object: &Object<'_>,
        materials: &MaterialNames,
        corner: impl Fn(usize, u32) -> WrittenCorner,
    ) {
        let mut at = 0;
        for (face, &source) in object.faces().zip(&object.sources) {
            self.state(object, source, materials);
            self.text.push('f');
            for &number in face {
                corner(at, object.vertex(number)).push(&mut self.text);
                at += 1;
            }
            self.text.push('\n');
        }
    }
}

impl ElementWriter {
    /// Says what changes with a face: its material, and whether it is smooth.
    fn state(&mut self, object: &Object<'_>, face: u32, materials: &MaterialNames) {
        let material = object.material(face);
        if let Some(name) = materials.get(&material)
            && self.material != Some(material)
        {
            self.material = Some(material);
            self.text += &format!("usemtl {name}\n");
        }
        let smooth = object.mesh.attributes().face_smooth.as_ref();
        let is_smooth = smooth.is_some_and(|smooth| smooth[face as usize]);
        if is_smooth != self.is_smooth {
            self.is_smooth = is_smooth;
            self.text += if is_smooth { "s 1\n" } else { "s off\n" };
        }
    }
}

/// The indices of a corner, counted from 1.
struct WrittenCorner {
    vertex: usize,
    coordinate: Option<usize>,
    normal: Option<usize>,
}

impl WrittenCorner {
    fn push(&self, text: &mut String) {
        *text += &match (self.coordinate, self.normal) {
            (None, None) => format!(" {}", self.vertex),
            (Some(coordinate), None) => format!(" {}/{coordinate}", self.vertex),
            (None, Some(normal)) => format!(" {}//{normal}", self.vertex),
            (Some(coordinate), Some(normal)) => format!(" {}/{coordinate}/{normal}", self.vertex),
        };
    }
}
