//! Makes meshes and their materials: a slot for each base material that triangles show, one for colours at corners, and one
//! for triangles without properties.

use std::collections::BTreeMap;

use trigon_math::{DVec3, Vec4};
use trigon_mesh::{Attributes, Mesh, MeshColumns};
use trigon_scene::{AlphaMode, Material, MaterialId, MeshId};

use super::closed::open_edges;
use super::model::{FoundObject, Model, PropertyGroup, TriangleProperty, Triangles};
use crate::import::Import;
use crate::rebase::offset_for;
use crate::warning::counted;

/// A mesh of the scene, and what its nodes need of it.
#[derive(Clone)]
pub(super) struct Built {
    pub(super) mesh: MeshId,
    pub(super) materials: Vec<MaterialId>,
    /// What the positions were moved by, in metres.
    pub(super) offset: DVec3,
}

/// What the faces of a slot show.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum SlotContent<'m> {
    /// Nothing that the file says.
    Default,
    /// Colours at their corners.
    Colors { is_blended: bool },
    /// A base material.
    Base { part: &'m str, group: u32, item: u32 },
}

/// Makes meshes; those of a file share their materials.
#[derive(Default)]
pub(super) struct MeshMaker<'m> {
    materials: BTreeMap<SlotContent<'m>, MaterialId>,
}

/// What the faces of a mesh show.
#[derive(Default)]
struct ShownFaces<'m> {
    slots: Vec<SlotContent<'m>>,
    /// Of faces.
    face_slots: Vec<u32>,
    /// Of corners, if any face has some.
    colors: Vec<Vec4>,
    /// Whether a triangle has properties that do not exist.
    has_unknown: bool,
}

impl<'m> MeshMaker<'m> {
    pub(super) fn make(
        &mut self,
        import: &mut Import<'_>,
        found: &FoundObject<'m>,
        triangles: &'m Triangles,
    ) -> Built {
        let unit = found.model.unit;
        let in_meters = || triangles.vertices.iter().map(|&vertex| unit.meters(vertex));
        let offset = offset_for(in_meters());
        let columns = MeshColumns {
            positions: in_meters().map(|position| (position - offset).as_vec3()).collect(),
            face_sizes: vec![3; triangles.triangles.len()],
            corner_vertices: triangles.triangles.as_flattened().to_vec(),
            ..MeshColumns::default()
        };
        let mut mesh = Mesh::from_columns(columns).expect("triangles have 3 different vertices of the mesh");
        let shown = ShownFaces::of(found, &triangles.properties);
        warn(import, found, triangles, shown.has_unknown);
        let materials = shown.slots.iter().map(|&slot| self.material(import, found.model, slot)).collect();
        let attributes = Attributes {
            face_materials: (shown.slots.len() > 1).then_some(shown.face_slots),
            corner_colors: Some(shown.colors).filter(|colors| !colors.is_empty()),
            ..Attributes::default()
        };
        mesh.set_attributes(attributes).expect("one value per face or corner");
        let mesh = import.scene.add_mesh(found.object.name.clone(), mesh);
        Built { mesh, materials, offset }
    }

    fn material(&mut self, import: &mut Import<'_>, model: &Model, slot: SlotContent<'m>) -> MaterialId {
        let make = || import.scene.add_material(material_of(model, slot));
        *self.materials.entry(slot).or_insert_with(make)
    }
}

fn material_of(model: &Model, slot: SlotContent<'_>) -> Material {
    let blended = |is_blended| if is_blended { AlphaMode::Blend } else { AlphaMode::Opaque };
    let default = Material::default().with_name("default");
    match slot {
        SlotContent::Default => default,
        SlotContent::Colors { is_blended } => {
            Material { base_color: Vec4::ONE, alpha_mode: blended(is_blended), ..default }
        }
        SlotContent::Base { group, item, .. } => match model.groups.get(&group) {
            Some(PropertyGroup::Bases(bases)) => {
                let base = &bases[item as usize];
                let alpha_mode = blended(base.color.w < 1.0);
                Material { base_color: base.color, alpha_mode, ..default }.with_name(base.name.clone())
            }
            _ => default,
        },
    }
}

impl<'m> ShownFaces<'m> {
    fn of(found: &FoundObject<'m>, properties: &[TriangleProperty]) -> Self {
        let mut shown = Self::default();
        let mut numbers: BTreeMap<SlotContent<'m>, u32> = BTreeMap::new();
        // Neighbours mostly show the same.
        let mut last: Option<(TriangleProperty, u32)> = None;
        for (face, &property) in properties.iter().enumerate() {
            let known =
                last.filter(|(other, _)| other.group == property.group && other.items == property.items);
            let number = known.map(|(_, number)| number).unwrap_or_else(|| {
                let slot = shown.slot(found, property);
                let next = numbers.len() as u32;
                let number = *numbers.entry(slot).or_insert(next);
                if number == next {
                    shown.slots.push(slot);
                }
                number
            });
            shown.push_colors(found.model, property, face);
            shown.face_slots.push(number);
            last = Some((property, number));
        }
        if shown.slots.is_empty() {
            shown.slots.push(SlotContent::Default);
        }
        if !shown.colors.is_empty() {
            shown.colors.resize(3 * properties.len(), Vec4::ONE);
        }
        shown
    }

    fn slot(&mut self, found: &FoundObject<'m>, property: TriangleProperty) -> SlotContent<'m> {
        let TriangleProperty { group, items } = property;
        match found.model.groups.get(&group) {
            Some(PropertyGroup::Bases(bases)) if (items[0] as usize) < bases.len() => {
                SlotContent::Base { part: found.part, group, item: items[0] }
            }
            Some(PropertyGroup::Colors(colors)) => match corner_colors(colors, items) {
                Some(corners) => {
                    SlotContent::Colors { is_blended: corners.iter().any(|color| color.w < 1.0) }
                }
                None => self.unknown_slot(),
            },
            Some(PropertyGroup::Other) => SlotContent::Default,
            None if group == 0 => SlotContent::Default,
            _ => self.unknown_slot(),
        }
    }

    fn unknown_slot(&mut self) -> SlotContent<'m> {
        self.has_unknown = true;
        SlotContent::Default
    }

    /// Adds the colours at the corners of a face that has some; those of the faces before are white.
    fn push_colors(&mut self, model: &Model, property: TriangleProperty, face: usize) {
        let Some(PropertyGroup::Colors(colors)) = model.groups.get(&property.group) else { return };
        if let Some(corners) = corner_colors(colors, property.items) {
            self.colors.resize(3 * face, Vec4::ONE);
            self.colors.extend(corners);
        }
    }
}

/// The colours of three corners; none if one does not exist.
fn corner_colors(colors: &[Vec4], items: [u32; 3]) -> Option<[Vec4; 3]> {
    let [a, b, c] = items.map(|item| colors.get(item as usize).copied());
    Some([a?, b?, c?])
}

fn warn(import: &mut Import<'_>, found: &FoundObject<'_>, triangles: &Triangles, has_unknown: bool) {
    let location = || found.object.location.clone();
    if has_unknown {
        let what = "triangles name properties that do not exist, and are drawn without";
        import.warnings.push(location(), what, "export the model again");
    }
    if triangles.triangles.is_empty() {
        let what = format!("object {} has no triangles", found.number);
        import.warnings.push(location(), what, "remove it, or export the model again");
        return;
    }
    let open = open_edges(&triangles.triangles);
    if open > 0 {
        let (number, edges) = (found.number, counted(open, "edge"));
        let what =
            format!("object {number} is no closed body: {edges} lack a second triangle, or have too many");
        import.warnings.push(location(), what, "fill the holes before it is printed");
    }
}
