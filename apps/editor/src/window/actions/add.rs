//! The menu Add.

use super::{Action, Does::*, Needs, actions};
use crate::request::UiRequest;

actions! {
    "Add" "add.menu" "Add Menu" "Shift+A" ObjectMode Ui(UiRequest::Popup("Add")) => "Chooses an object or a light to add.";
    "Add" "add.plane" "Plane" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"plane","width":2.0,"depth":2.0}}"#) => "Adds a plane of 2 m.";
    "Add" "add.cube" "Cube" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"cube","edge":2.0}}"#) => "Adds a cube of 2 m.";
    "Add" "add.uv_sphere" "UV Sphere" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"uv_sphere","radius":1.0,"segments":32,"rings":16}}"#) => "Adds a sphere of quads between two poles.";
    "Add" "add.icosphere" "Ico Sphere" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"icosphere","radius":1.0,"subdivisions":2}}"#) => "Adds a sphere of triangles.";
    "Add" "add.cylinder" "Cylinder" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"cylinder","radius":1.0,"height":2.0,"segments":32}}"#) => "Adds a cylinder.";
    "Add" "add.cone" "Cone" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"cone","radius":1.0,"height":2.0,"segments":32}}"#) => "Adds a cone.";
    "Add" "add.torus" "Torus" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"torus","major_radius":1.0,"minor_radius":0.25,"major_segments":48,"minor_segments":12}}"#) => "Adds a ring.";
    "Add" "add.grid" "Grid" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"grid","width":2.0,"depth":2.0,"columns":10,"rows":10}}"#) => "Adds a plane of many quads.";
    "Add" "add.disc" "Disc" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"disc","radius":1.0,"segments":32}}"#) => "Adds a disc.";
    "Add" "add.pyramid" "Pyramid" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"pyramid","edge":2.0,"height":2.0}}"#) => "Adds a pyramid.";
    "Add" "add.teapot" "Teapot" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"teapot","subdivisions":8}}"#) => "Adds Newell's teapot.";
    "Add" "add.empty" "Empty" "" ObjectMode Run(r#"{"op":"add_empty"}"#) => "Adds an empty object, as a parent for others.";
    "Add" "add.camera" "Camera" "" ObjectMode Run(r#"{"op":"add_camera","position":[6.0,4.5,6.0],"rotation":{"by":"euler","angles":[-28.0,45.0,0.0]}}"#) => "Adds a camera that looks at the 3D cursor.";
    "Add/Solids" "add.tetrahedron" "Tetrahedron" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"tetrahedron","edge":2.0}}"#) => "Adds a solid of 4 triangles.";
    "Add/Solids" "add.octahedron" "Octahedron" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"octahedron","edge":2.0}}"#) => "Adds a solid of 8 triangles.";
    "Add/Solids" "add.dodecahedron" "Dodecahedron" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"dodecahedron","edge":1.0}}"#) => "Adds a solid of 12 pentagons.";
    "Add/Solids" "add.icosahedron" "Icosahedron" "" ObjectMode Run(r#"{"op":"add_object","object":{"shape":"icosahedron","edge":1.0}}"#) => "Adds a solid of 20 triangles.";
    "Add/Light" "add.point_light" "Point Light" "" ObjectMode Run(r#"{"op":"add_light","light":"point","name":"Point","position":[4.0,5.0,3.0],"intensity":100.0}"#) => "Adds a light that shines in all directions.";
    "Add/Light" "add.sun" "Directional Light" "" ObjectMode Run(r#"{"op":"add_light","light":"directional","name":"Sun","position":[4.0,5.0,3.0],"intensity":3.0}"#) => "Adds a light from far away.";
    "Add/Light" "add.spot" "Spot Light" "" ObjectMode Run(r#"{"op":"add_light","light":"spot","name":"Spot","position":[0.0,1.0,4.0],"intensity":100.0}"#) => "Adds a light that shines in a cone.";
}
