//! Reads a model part: a loop over its elements with a stack of those that are open. Elements of extensions that are not
//! read are passed, with one warning for each extension.

use std::collections::BTreeSet;

use trigon_math::{DAffine3, DVec3};

use super::model::{
    Base, Model, ObjectShape, PartObject, PlacedObject, PropertyGroup, TriangleProperty, Triangles, Unit,
};
use super::namespaces::{CORE, MATERIAL, PRODUCTION};
use super::package::part_name;
use super::properties::{color, resolve};
use super::xml::{Space, Step, Xml, XmlElement};
use crate::error::{LoadError, LoadErrorKind, Location};
use crate::import::Import;
use crate::options::LoadStage;
use crate::polygons::{check_vertices, most_corners, too_many_corners};
use crate::rows::plain_text;

/// Extensions that may be required though nothing of them is drawn: they say nothing about shapes and colours.
const HARMLESS: [&str; 1] = ["http://schemas.microsoft.com/3dmanufacturing/trianglesets/2021/07"];

/// So many elements are read before the caller is asked again whether to go on.
const STRIDE: u64 = 1 << 18;

/// An open element.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Within {
    Model,
    Resources,
    Bases,
    Colors,
    Object,
    Mesh,
    Vertices,
    Triangles,
    Components,
    Build,
}

/// An object that is being read.
struct ObjectDraft {
    id: u32,
    object: PartObject,
    /// What triangles show that say nothing else.
    default: TriangleProperty,
    /// Triangles with fewer than three different vertices, and where the first is.
    flat: usize,
    first_flat: Location,
}

struct Parser<'a, 'i, 'o> {
    xml: Xml<'a>,
    import: &'i mut Import<'o>,
    model: Model,
    open: Vec<Within>,
    /// The group that is being read.
    group: u32,
    draft: Option<ObjectDraft>,
    /// The addresses of extensions with a warning.
    foreign: BTreeSet<String>,
    /// Of all triangles.
    corners: usize,
}

/// Reads a part.
pub(super) fn parse(import: &mut Import<'_>, part: &str, bytes: &[u8]) -> Result<Model, LoadError> {
    let (path, text) = (import.path, plain_text(bytes));
    let mut parser = Parser {
        xml: Xml::new(path, part, &text),
        import,
        model: Model::default(),
        open: Vec::new(),
        group: 0,
        draft: None,
        foreign: BTreeSet::new(),
        corners: 0,
    };
    let mut count = 0_u64;
    while let Some(step) = parser.xml.step()? {
        match step {
            Step::Start(element) => parser.start(&element)?,
            Step::End => parser.end()?,
        }
        count += 1;
        if count.is_multiple_of(STRIDE) {
            let share = 0.8 * parser.xml.progress();
            parser.import.options.report(path, LoadStage::Geometry, share)?;
        }
    }
    Ok(parser.model)
}

impl<'a> Parser<'a, '_, '_> {
    fn start(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        use Within::{Bases, Build, Colors, Components, Mesh, Model, Object, Resources, Vertices};
        let entered = match (self.open.last(), element.space, element.name()) {
            (None, Space::Core, b"model") => self.begin_model(element)?,
            (None, ..) => return Err(self.xml.fault("its first element is not the <model> of a 3MF")),
            (Some(Model), Space::Core, b"resources") => Resources,
            (Some(Model), Space::Core, b"build") => Build,
            (Some(Resources), Space::Core, b"basematerials") => self.begin_bases(element)?,
            (Some(Resources), Space::Material, b"colorgroup") => self.begin_colors(element)?,
            (Some(Resources), Space::Core, b"object") => self.begin_object(element)?,
            (Some(Object), Space::Core, b"mesh") => Mesh,
            (Some(Object), Space::Core, b"components") => self.begin_components(),
            (Some(Mesh), Space::Core, b"vertices") => Vertices,
            (Some(Mesh), Space::Core, b"triangles") => Within::Triangles,
            (Some(Vertices), Space::Core, b"vertex") => return self.vertex(element),
            (Some(Within::Triangles), Space::Core, b"triangle") => return self.triangle(element),
            (Some(Bases), Space::Core, b"base") => return self.base(element),
            (Some(Colors), Space::Material, b"color") => return self.group_color(element),
            (Some(Components | Build), Space::Core, b"component" | b"item") => return self.placed(element),
            _ => return self.other(element),
        };
        if element.is_empty {
            return self.leave(entered);
        }
        self.open.push(entered);
        Ok(())
    }

    fn end(&mut self) -> Result<(), LoadError> {
        self.open.pop().map_or(Ok(()), |within| self.leave(within))
    }

    fn leave(&mut self, within: Within) -> Result<(), LoadError> {
        if within != Within::Object {
            return Ok(());
        }
        let Some(ObjectDraft { id, object, flat, first_flat, .. }) = self.draft.take() else { return Ok(()) };
        self.import.warnings.push_counted(
            flat,
            first_flat,
            "a triangle has fewer than 3 different vertices, and is left out",
            "clean the model up",
        );
        if self.model.objects.insert(id, object).is_some() {
            return Err(self.xml.fault(format!("a second object has the number {id}")));
        }
        Ok(())
    }

    /// Passes an element that is not read.
    fn other(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        if element.space == Space::Material && self.open.last() == Some(&Within::Resources) {
            self.other_group(element)?;
        } else if element.space == Space::Foreign {
            let address = self.xml.address(element);
            self.note_foreign(address);
        }
        self.xml.pass(element)
    }

    /// A group of an extension whose properties are not drawn.
    fn other_group(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        // Images are named by groups of texture coordinates, never by triangles.
        if let Some(id) = self.xml.id(element)?.filter(|_| element.name() != b"texture2d") {
            let name = String::from_utf8_lossy(element.name()).into_owned();
            let what = format!("properties of the kind \"{name}\" are not drawn");
            self.import.warnings.push(
                self.xml.location(),
                what,
                "export base materials or a colour group to see colours",
            );
            self.model.groups.insert(id, PropertyGroup::Other);
        }
        Ok(())
    }

    fn note_foreign(&mut self, address: String) {
        if !self.foreign.contains(&address) {
            let what = format!("what the extension \"{address}\" says is not read");
            self.import.warnings.push(
                self.xml.location(),
                what,
                "nothing if it does not matter for the shape",
            );
            self.foreign.insert(address);
        }
    }

    fn begin_model(&mut self, element: &XmlElement<'a>) -> Result<Within, LoadError> {
        let mut required = String::new();
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            match attribute.key.as_ref() {
                b"unit" => {
                    let name = self.xml.text(&attribute)?;
                    let unknown = || self.xml.fault(format!("the unit \"{name}\" is not one of 3MF"));
                    self.model.unit = Unit::named(&name).ok_or_else(unknown)?;
                }
                b"requiredextensions" => required = self.xml.text(&attribute)?,
                _ => {}
            }
        }
        for prefix in required.split_ascii_whitespace() {
            self.check_required(prefix)?;
        }
        Ok(Within::Model)
    }

    /// Refuses an extension without which the model is another one.
    fn check_required(&self, prefix: &str) -> Result<(), LoadError> {
        let address = self.xml.address_of(format!("{prefix}:x").as_bytes());
        let known = [CORE, MATERIAL, PRODUCTION];
        if known.contains(&address.as_str()) || HARMLESS.contains(&address.as_str()) {
            return Ok(());
        }
        let name = if address.is_empty() { prefix } else { &address };
        let what = format!("it requires the extension \"{name}\", which is not supported");
        let remedy = "export the model without this extension";
        let error = LoadError::new(LoadErrorKind::Unsupported, self.import.path, what, remedy);
        Err(error.at(self.xml.location()))
    }

    fn begin_bases(&mut self, element: &XmlElement<'a>) -> Result<Within, LoadError> {
        self.begin_group(element, PropertyGroup::Bases(Vec::new()))?;
        Ok(Within::Bases)
    }

    fn begin_colors(&mut self, element: &XmlElement<'a>) -> Result<Within, LoadError> {
        self.begin_group(element, PropertyGroup::Colors(Vec::new()))?;
        Ok(Within::Colors)
    }

    fn begin_group(&mut self, element: &XmlElement<'a>, group: PropertyGroup) -> Result<(), LoadError> {
        let id = self.xml.id(element)?;
        self.group = id.ok_or_else(|| self.xml.fault("a group of properties has no id"))?;
        self.model.groups.insert(self.group, group);
        Ok(())
    }

    fn base(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        let mut base = Base { name: String::new(), color: color([255; 4]) };
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            match attribute.key.as_ref() {
                b"name" => base.name = self.xml.text(&attribute)?,
                b"displaycolor" => base.color = self.xml.color(&attribute.value)?,
                _ => {}
            }
        }
        if let Some(PropertyGroup::Bases(bases)) = self.model.groups.get_mut(&self.group) {
            bases.push(base);
        }
        self.xml.pass(element)
    }

    fn group_color(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        let mut found = color([255; 4]);
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            if attribute.key.as_ref() == b"color" {
                found = self.xml.color(&attribute.value)?;
            }
        }
        if let Some(PropertyGroup::Colors(colors)) = self.model.groups.get_mut(&self.group) {
            colors.push(found);
        }
        self.xml.pass(element)
    }

    fn begin_object(&mut self, element: &XmlElement<'a>) -> Result<Within, LoadError> {
        let (mut id, mut name, mut part_number) = (None, String::new(), String::new());
        let (mut group, mut item) = (None, 0);
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            match attribute.key.as_ref() {
                b"id" => id = Some(self.xml.index(&attribute.value, "id")?),
                b"name" => name = self.xml.text(&attribute)?,
                b"partnumber" => part_number = self.xml.text(&attribute)?,
                b"pid" => group = Some(self.xml.index(&attribute.value, "pid")?),
                b"pindex" => item = self.xml.index(&attribute.value, "pindex")?,
                _ => self.note_attribute(attribute.key.as_ref()),
            }
        }
        let id = id.ok_or_else(|| self.xml.fault("an object has no id"))?;
        let shape = ObjectShape::Mesh(Triangles::default());
        let location = self.xml.location();
        self.draft = Some(ObjectDraft {
            id,
            object: PartObject { name, part_number, shape, location },
            default: TriangleProperty { group: group.unwrap_or(0), items: [item; 3] },
            flat: 0,
            first_flat: Location::Whole,
        });
        Ok(Within::Object)
    }

    fn begin_components(&mut self) -> Within {
        if let Some(draft) = &mut self.draft {
            draft.object.shape = ObjectShape::Components(Vec::new());
        }
        Within::Components
    }

    /// Warns of an attribute of an extension that is not read.
    fn note_attribute(&mut self, key: &[u8]) {
        if key.starts_with(b"xml") || !key.contains(&b':') {
            return;
        }
        let address = self.xml.address_of(key);
        if ![CORE, MATERIAL, PRODUCTION].contains(&address.as_str()) {
            self.note_foreign(address);
        }
    }

    fn vertex(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        let mut position = DVec3::NAN;
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            let axis = match attribute.key.as_ref() {
                b"x" => 0,
                b"y" => 1,
                b"z" => 2,
                _ => continue,
            };
            position[axis] = self.xml.number(&attribute.value)?;
        }
        if !self.model.unit.meters(position).as_vec3().is_finite() {
            return Err(self.xml.fault("a vertex lacks a coordinate, or has one that is too large"));
        }
        if let Some(ObjectDraft { object: PartObject { shape: ObjectShape::Mesh(mesh), .. }, .. }) =
            &mut self.draft
        {
            mesh.vertices.push(position);
            check_vertices(self.import, mesh.vertices.len() as u64)?;
        }
        self.xml.pass(element)
    }

    fn triangle(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        let (mut triangle, mut group, mut items) = ([u32::MAX; 3], None, [None; 3]);
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            match attribute.key.as_ref() {
                b"v1" => triangle[0] = self.xml.index(&attribute.value, "v1")?,
                b"v2" => triangle[1] = self.xml.index(&attribute.value, "v2")?,
                b"v3" => triangle[2] = self.xml.index(&attribute.value, "v3")?,
                b"pid" => group = Some(self.xml.index(&attribute.value, "pid")?),
                b"p1" => items[0] = Some(self.xml.index(&attribute.value, "p1")?),
                b"p2" => items[1] = Some(self.xml.index(&attribute.value, "p2")?),
                b"p3" => items[2] = Some(self.xml.index(&attribute.value, "p3")?),
                key => {
                    let key = key.to_vec();
                    self.note_attribute(&key);
                }
            }
        }
        self.push_triangle(triangle, group, items)?;
        self.xml.pass(element)
    }

    fn push_triangle(
        &mut self,
        triangle: [u32; 3],
        group: Option<u32>,
        items: [Option<u32>; 3],
    ) -> Result<(), LoadError> {
        let Some(draft) = &mut self.draft else { return Ok(()) };
        let ObjectShape::Mesh(mesh) = &mut draft.object.shape else { return Ok(()) };
        let count = mesh.vertices.len();
        if let Some(beyond) = triangle.iter().find(|&&vertex| vertex as usize >= count) {
            let what = match *beyond {
                u32::MAX => "a triangle has fewer than 3 vertices".to_owned(),
                beyond => format!("a triangle names vertex {beyond}, and the mesh has {count}"),
            };
            return Err(self.xml.fault(what));
        }
        let [a, b, c] = triangle;
        if a == b || b == c || c == a {
            if draft.flat == 0 {
                draft.first_flat = self.xml.location();
            }
            draft.flat += 1;
            return Ok(());
        }
        self.corners += 3;
        if self.corners > most_corners(self.import) {
            return Err(too_many_corners(self.import));
        }
        mesh.triangles.push(triangle);
        mesh.properties.push(resolve(draft.default, group, items));
        Ok(())
    }

    /// An item of the build, or a component.
    fn placed(&mut self, element: &XmlElement<'a>) -> Result<(), LoadError> {
        let (mut part, mut object, mut part_number) = (None, None, String::new());
        let mut transform = DAffine3::IDENTITY;
        for attribute in element.attributes() {
            let attribute = self.xml.checked(attribute)?;
            match attribute.key.as_ref() {
                b"objectid" => object = Some(self.xml.index(&attribute.value, "objectid")?),
                b"partnumber" => part_number = self.xml.text(&attribute)?,
                b"transform" => transform = self.xml.transform(&attribute.value)?,
                key if key.ends_with(b":path") && self.xml.space_of(&attribute) == Space::Production => {
                    part = Some(part_name(&self.xml.text(&attribute)?));
                }
                key => {
                    let key = key.to_vec();
                    self.note_attribute(&key);
                }
            }
        }
        let object = object.ok_or_else(|| self.xml.fault("an item or a component names no object"))?;
        let placed = PlacedObject { part, object, transform, part_number, location: self.xml.location() };
        match &mut self.draft {
            Some(ObjectDraft {
                object: PartObject { shape: ObjectShape::Components(components), .. },
                ..
            }) => {
                components.push(placed);
            }
            Some(_) => {}
            None => self.model.items.push(placed),
        }
        self.xml.pass(element)
    }
}
