"""Blender's side: a mesh in edit mode with a selection, an operation, and what is there afterwards."""
import bpy
# Only there once bpy is.
import bmesh
import numpy

from meshes import Mesh

MODES = {"vertex": (True, False, False), "edge": (False, True, False), "face": (False, False, True)}


class Refused(Exception):
    """An operator that reported an error."""


def in_view(operator, **parameters):
    """Some operators ask for the window of a 3D view, and do not look at it when all parameters are given."""
    window = bpy.context.window_manager.windows[0]
    area = next(area for area in window.screen.areas if area.type == "VIEW_3D")
    region = next(region for region in area.regions if region.type == "WINDOW")
    with bpy.context.temp_override(window=window, area=area, region=region):
        return operator(**parameters)


def clear():
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    for shown in list(bpy.data.objects):
        bpy.data.objects.remove(shown)
    for mesh in list(bpy.data.meshes):
        bpy.data.meshes.remove(mesh)


def edit(mesh):
    clear()
    data = bpy.data.meshes.new("subject")
    data.from_pydata(mesh.positions.tolist(), mesh.loose, mesh.faces)
    shown = bpy.data.objects.new("subject", data)
    bpy.context.collection.objects.link(shown)
    bpy.context.view_layer.objects.active = shown
    shown.select_set(True)
    bpy.ops.object.mode_set(mode="EDIT")
    return bmesh.from_edit_mesh(data)


def choose(edited, kind, selected):
    """Selects by the numbers of the mesh; returns the elements."""
    bpy.context.tool_settings.mesh_select_mode = MODES[kind]
    bpy.ops.mesh.select_all(action="DESELECT")
    edited.select_mode = {{"vertex": "VERT", "edge": "EDGE", "face": "FACE"}[kind]}
    for elements in (edited.verts, edited.edges, edited.faces):
        elements.ensure_lookup_table()
        elements.index_update()
    if kind == "edge":
        chosen = [edited.edges.get([edited.verts[end] for end in pair]) for pair in selected]
    else:
        elements = edited.verts if kind == "vertex" else edited.faces
        chosen = [elements[number] for number in selected]
    for element in chosen:
        element.select_set(True)
    edited.select_flush_mode()
    bmesh.update_edit_mesh(bpy.context.object.data)
    return chosen


def result(name):
    """All objects together."""
    if bpy.context.mode != "OBJECT":
        bpy.ops.object.mode_set(mode="OBJECT")
    positions, faces, loose, base = [], [], [], 0
    for shown in bpy.data.objects:
        data = shown.data
        values = numpy.empty(3 * len(data.vertices), dtype=numpy.float32)
        data.vertices.foreach_get("co", values)
        positions.append(values.reshape(-1, 3))
        faces += [[base + vertex for vertex in polygon.vertices] for polygon in data.polygons]
        used = {key for polygon in data.polygons for key in polygon.edge_keys}
        loose += [(base + a, base + b) for a, b in (edge.key for edge in data.edges) if (a, b) not in used]
        base += len(data.vertices)
    return Mesh(name, numpy.concatenate(positions) if positions else numpy.zeros((0, 3)), faces, loose)


def run(mesh, operation, selected, call):
    """The mesh after a call of an operation. Raises Refused."""
    edited = edit(mesh)
    chosen = choose(edited, operation.kind, selected)
    try:
        call(edited, chosen)
    except RuntimeError as error:
        raise Refused(str(error).strip()) from error
    if bpy.context.mode != "OBJECT":
        bmesh.update_edit_mesh(bpy.context.object.data)
    return result(mesh.name)
