"""Run inside Blender 3.4: reads a model and writes it again in the same format.

usage: blender --background --factory-startup --python blender_round_trip.py -- SOURCE TARGET
"""
import json
import pathlib
import sys

import bpy
import numpy

# Blender 3.4 reads glTF with a name that NumPy 1.24 has no more.
numpy.bool = bool

source, target = sys.argv[sys.argv.index("--") + 1 :]
kind = pathlib.Path(source).suffix[1:]
bpy.ops.wm.read_factory_settings(use_empty=True)

# The axes of the file stay those of Blender, so that no position is turned and rounded.
AXES = {"axis_forward": "Y", "axis_up": "Z"}
OBJ_AXES = {"forward_axis": "Y", "up_axis": "Z"}
if kind == "glb":
    bpy.ops.import_scene.gltf(filepath=source, merge_vertices=True)
elif kind == "ply":
    bpy.ops.import_mesh.ply(filepath=source)
elif kind == "stl":
    bpy.ops.import_mesh.stl(filepath=source, **AXES)
elif kind == "obj":
    bpy.ops.wm.obj_import(filepath=source, **OBJ_AXES)

meshes = [item.data for item in bpy.context.scene.objects if item.type == "MESH"]
counts = {"faces": sum(len(mesh.polygons) for mesh in meshes), "vertices": sum(len(mesh.vertices) for mesh in meshes)}
print("counts " + json.dumps(counts), flush=True)

if kind == "glb":
    bpy.ops.export_scene.gltf(filepath=target, export_format="GLB")
elif kind == "ply":
    bpy.ops.export_mesh.ply(filepath=target, use_normals=False, use_uv_coords=False, **AXES)
elif kind == "stl":
    bpy.ops.export_mesh.stl(filepath=target, **AXES)
elif kind == "obj":
    bpy.ops.wm.obj_export(filepath=target, export_triangulated_mesh=False, **OBJ_AXES)
