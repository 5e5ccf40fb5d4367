//! A glTF mesh, with all its primitives, to one polygon mesh.
//!
//! The primitives become faces with different material slots, so that a node
//! of the file stays one node, with one object id. Vertices at exactly the
//! same place become one, across primitives too: edges and neighbours are then
//! those of the surface, and what differs at a seam stays on the corners.

use std::collections::HashMap;

use gltf_json::accessor::Type;
use gltf_json::mesh::{Primitive, Semantic};
use gltf_json::validation::Checked;
use trigon_math::{Vec2, Vec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshBuilder};

use super::accessor::{Accessors, valid};
use super::buffers::{Unplaced, Unread};
use super::primitive::{Elements, corner_count, elements};
use crate::error::{LoadErrorKind, Place};
use crate::warning::{Warnings, counted};

/// A mesh, and what its slots hold.
pub(crate) struct BuiltMesh {
    pub(crate) mesh: Mesh,
    /// The material of each slot: an index of the document, or the default.
    pub(crate) materials: Vec<Option<usize>>,
}

/// Reads a mesh. `texture_sets` says which UV set the base colour texture of a
/// material uses; `None` when it has no texture.
pub(crate) fn build_mesh(
    accessors: &mut Accessors<'_, '_>,
    index: usize,
    texture_sets: &dyn Fn(Option<usize>) -> Option<u32>,
    warnings: &mut Warnings,
) -> Result<BuiltMesh, Unplaced> {
    let mut parts = Vec::new();
    for (number, primitive) in accessors.root.meshes[index].primitives.iter().enumerate() {
        let place = Place::Named(format!("mesh {index}, primitive {number}"));
        if let Some(part) = read_primitive(accessors, primitive, place, texture_sets, warnings)? {
            parts.push(part);
        }
    }
    let mut draft = Draft::new(&parts);
    for part in &parts {
        draft.add(part);
    }
    let place = || Place::Item("mesh", index);
    warnings.push_counted(
        draft.non_finite,
        place(),
        "a triangle has a vertex that is not finite and is left out",
        "export the model again",
    );
    warnings.push_counted(
        draft.flat,
        place(),
        "a triangle has fewer than 3 different vertices and is left out",
        "remove doubles and export again if a hole shows",
    );
    Ok(draft.finish())
}

/// A primitive, decoded.
struct Part {
    positions: Vec<Vec3>,
    normals: Option<Vec<[f32; 3]>>,
    uv_sets: Vec<Vec<[f32; 2]>>,
    colors: Option<Vec<[f32; 4]>>,
    elements: Elements,
    material: Option<usize>,
    /// Strips repeat vertices on purpose, to jump.
    is_strip: bool,
}

/// How many UV sets are read: the material model has two.
const UV_SETS: u32 = 2;

fn read_primitive(
    accessors: &mut Accessors<'_, '_>,
    primitive: &Primitive,
    place: Place,
    texture_sets: &dyn Fn(Option<usize>) -> Option<u32>,
    warnings: &mut Warnings,
) -> Result<Option<Part>, Unplaced> {
    let find = |semantic: Semantic| {
        primitive.attributes.get(&Checked::Valid(semantic)).map(|accessor| accessor.value())
    };
    let Some(position_index) = find(Semantic::Positions) else {
        warnings.push(place, "it has no POSITION and is not drawn", "export the model again");
        return Ok(None);
    };
    let Some(mode) = valid(&primitive.mode) else {
        warnings.push(place, "its mode is unknown and it is not drawn", "export the model again");
        return Ok(None);
    };
    check_bounds(accessors, position_index)?;
    let positions = accessors.vectors::<3>(position_index, &[Type::Vec3])?;
    let indices = match primitive.indices {
        Some(indices) => accessors.indices(indices.value())?,
        None => (0..positions.len() as u32).collect(),
    };
    accessors.spend(positions.len().max(corner_count(mode, indices.len())), &place)?;
    if let Some(beyond) = indices.iter().find(|&&vertex| vertex as usize >= positions.len()) {
        let what =
            format!("index {beyond} leads nowhere; the primitive has {}", counted(positions.len(), "vertex"));
        return Err(Unplaced(
            place,
            Unread { kind: LoadErrorKind::Malformed, what, remedy: "export the model again" },
        ));
    }
    let elements = elements(mode, &indices);
    if elements.left_over > 0 {
        let what = format!(
            "{} at the end left over, too few for a whole element",
            counted(elements.left_over, "index")
        );
        warnings.push(place.clone(), what, "export the model again");
    }
    let mut optional = Optional { accessors, vertices: positions.len(), place: &place, warnings };
    let normals = optional.read::<3>(find(Semantic::Normals), "NORMAL", &[Type::Vec3])?;
    let colors = optional.read::<4>(find(Semantic::Colors(0)), "COLOR_0", &[Type::Vec3, Type::Vec4])?;
    let mut uv_sets = Vec::new();
    for set in 0..UV_SETS {
        uv_sets.push(optional.read::<2>(find(Semantic::TexCoords(set)), "TEXCOORD", &[Type::Vec2])?);
    }
    let material = primitive.material.map(|material| material.value());
    let uv_sets = settle_uv_sets(uv_sets, texture_sets(material), &place, warnings);
    let is_strip = matches!(mode, gltf_json::mesh::Mode::TriangleStrip);
    let positions = positions.into_iter().map(Vec3::from).collect();
    Ok(Some(Part { positions, normals, uv_sets, colors, elements, material, is_strip }))
}

/// The bounds of POSITION need not be there, but must have three numbers.
fn check_bounds(accessors: &Accessors<'_, '_>, index: usize) -> Result<(), Unplaced> {
    let accessor = &accessors.root.accessors[index];
    for (name, bound) in [("min", &accessor.min), ("max", &accessor.max)] {
        let Some(bound) = bound else { continue };
        let numbers = bound.as_array().map_or(0, Vec::len);
        if numbers != 3 {
            let what = format!("POSITION {name} has {numbers} numbers and should have 3");
            let unread = Unread { kind: LoadErrorKind::Malformed, what, remedy: "export the model again" };
            return Err(Unplaced(Place::Item("accessor", index), unread));
        }
    }
    Ok(())
}

/// Reads attributes that a primitive can do without.
struct Optional<'o, 'a, 'b> {
    accessors: &'o mut Accessors<'a, 'b>,
    vertices: usize,
    place: &'o Place,
    warnings: &'o mut Warnings,
}

impl Optional<'_, '_, '_> {
    fn read<const N: usize>(
        &mut self,
        index: Option<usize>,
        name: &str,
        allowed: &[Type],
    ) -> Result<Option<Vec<[f32; N]>>, Unplaced> {
        let Some(index) = index else { return Ok(None) };
        let count = self.accessors.count(index);
        if count != self.vertices as u64 {
            let what = format!("{name} has {count} values for {} vertices and is ignored", self.vertices);
            self.warnings.push(self.place.clone(), what, "export the model again");
            return Ok(None);
        }
        self.accessors.vectors(index, allowed).map(Some)
    }
}

/// Makes sure that the set that the texture wants is there.
fn settle_uv_sets(
    mut sets: Vec<Option<Vec<[f32; 2]>>>,
    wanted: Option<u32>,
    place: &Place,
    warnings: &mut Warnings,
) -> Vec<Vec<[f32; 2]>> {
    if let Some(wanted) = wanted {
        let missing = sets.get(wanted as usize).is_none_or(Option::is_none);
        if missing {
            let instead =
                if sets[0].is_some() { "TEXCOORD_0 is used" } else { "the texture shows one colour" };
            let what = format!("its texture wants TEXCOORD_{wanted}, which is missing; {instead}");
            warnings.push(place.clone(), what, "export the model with that UV map");
        }
        if missing && (wanted as usize) < sets.len() {
            sets[wanted as usize] = sets[0].clone();
        }
    }
    // Later sets keep their number: an absent one before them is empty.
    while sets.last().is_some_and(Option::is_none) {
        sets.pop();
    }
    sets.into_iter().map(Option::unwrap_or_default).collect()
}

/// The mesh under construction.
struct Draft {
    builder: MeshBuilder,
    welded: HashMap<[u32; 3], u32>,
    attributes: Attributes,
    face_materials: Vec<u32>,
    materials: Vec<Option<usize>>,
    slots: HashMap<Option<usize>, u32>,
    flat: usize,
    non_finite: usize,
}

impl Draft {
    fn new(parts: &[Part]) -> Self {
        let sum = |count: fn(&Part) -> usize| parts.iter().map(count).sum::<usize>();
        let (vertices, faces) = (sum(|part| part.positions.len()), sum(|part| part.elements.triangles.len()));
        let any = |has: fn(&Part) -> bool| parts.iter().any(has);
        let sets = parts.iter().map(|part| part.uv_sets.len()).max().unwrap_or(0);
        let attributes = Attributes {
            corner_normals: any(|part| part.normals.is_some()).then(|| Vec::with_capacity(3 * faces)),
            corner_colors: any(|part| part.colors.is_some()).then(|| Vec::with_capacity(3 * faces)),
            uv_sets: (0..sets).map(|_| Vec::with_capacity(3 * faces)).collect(),
            ..Attributes::default()
        };
        Self {
            builder: MeshBuilder::with_capacity(vertices, faces, 3 * faces),
            welded: HashMap::with_capacity(vertices),
            attributes,
            face_materials: Vec::with_capacity(faces),
            materials: Vec::new(),
            slots: HashMap::new(),
            flat: 0,
            non_finite: 0,
        }
    }

    fn add(&mut self, part: &Part) {
        let slot = *self.slots.entry(part.material).or_insert_with(|| {
            self.materials.push(part.material);
            self.materials.len() as u32 - 1
        });
        let vertices: Vec<Option<u32>> = part.positions.iter().map(|&position| self.weld(position)).collect();
        for corners in &part.elements.triangles {
            let [Some(a), Some(b), Some(c)] = corners.map(|corner| vertices[corner as usize]) else {
                self.non_finite += 1;
                continue;
            };
            match self.builder.push_face(&[a, b, c]) {
                Ok(_) => {
                    self.face_materials.push(slot);
                    corners.iter().for_each(|&corner| self.add_corner(part, corner as usize));
                }
                Err(_) => self.flat += usize::from(!part.is_strip),
            }
        }
        for edge in &part.elements.edges {
            if let [Some(from), Some(to)] = edge.map(|end| vertices[end as usize])
                && from != to
            {
                self.builder.push_loose_edge(from, to).expect("both vertices exist and differ");
            }
        }
        for vertex in part.elements.points.iter().filter_map(|&point| vertices[point as usize]) {
            self.builder.push_loose_point(vertex).expect("the vertex exists");
        }
    }

    /// The vertex at a place; `None` where there is no place.
    fn weld(&mut self, position: Vec3) -> Option<u32> {
        if !position.is_finite() {
            return None;
        }
        // Adding zero makes −0 and +0 the same.
        let key = (position + Vec3::ZERO).to_array().map(f32::to_bits);
        Some(*self.welded.entry(key).or_insert_with(|| self.builder.push_vertex(position)))
    }

    fn add_corner(&mut self, part: &Part, corner: usize) {
        if let Some(list) = &mut self.attributes.corner_normals {
            let normal = part.normals.as_ref().map_or(Vec3::ZERO, |normals| Vec3::from(normals[corner]));
            list.push(if normal.is_finite() { normal } else { Vec3::ZERO });
        }
        if let Some(list) = &mut self.attributes.corner_colors {
            let color = part.colors.as_ref().map_or(Vec4::ONE, |colors| Vec4::from(colors[corner]));
            list.push(if color.is_finite() { color.clamp(Vec4::ZERO, Vec4::ONE) } else { Vec4::ONE });
        }
        for (set, list) in self.attributes.uv_sets.iter_mut().enumerate() {
            let uv = part
                .uv_sets
                .get(set)
                .and_then(|values| values.get(corner))
                .map_or(Vec2::ZERO, |&uv| Vec2::from(uv));
            list.push(if uv.is_finite() { uv } else { Vec2::ZERO });
        }
    }

    fn finish(mut self) -> BuiltMesh {
        let mut mesh = self.builder.build();
        if self.materials.len() > 1 {
            self.attributes.face_materials = Some(self.face_materials);
        }
        mesh.set_attributes(self.attributes).expect("one value per accepted corner and face");
        BuiltMesh { mesh, materials: self.materials }
    }
}
