"""What operations on meshes cost in Blender, beside crates/document/examples/edit_prices.rs.

    blender --background --factory-startup --python tests/peers/blender_edit.py

Prints the same rows: program,operation,input,threads,median,shortest,longest, in milliseconds. The operations
of `bmesh` are timed by themselves, without the undo and the redraw that Blender adds when a user calls them.
"""
import math
import statistics
import time

import bmesh
import bpy

VERSION = bpy.app.version_string


def sheet(side):
    """The grid of edit_prices.rs: quads on a wavy sheet with one set of texture coordinates."""
    mesh = bpy.data.meshes.new("sheet")
    share = [i / side for i in range(side + 1)]
    vertices = [
        ((x - 0.5) * 2, (y - 0.5) * 2, 0.1 * math.sin(9 * x) * math.cos(7 * y)) for y in share for x in share
    ]
    row = side + 1
    corner = lambda x, y: y * row + x
    faces = [
        (corner(x, y), corner(x + 1, y), corner(x + 1, y + 1), corner(x, y + 1))
        for y in range(side)
        for x in range(side)
    ]
    mesh.from_pydata(vertices, [], faces)
    layer = mesh.uv_layers.new(name="UVMap")
    places = [c for loop in mesh.loops for c in vertices[loop.vertex_index][:2]]
    layer.data.foreach_set("uv", places)
    mesh.update()
    return mesh


def tell(name, quads, times):
    middle, least, most = (f(times) * 1e3 for f in (statistics.median, min, max))
    print(f"blender-{VERSION},{name},{quads} quads,all,{middle:.2f},{least:.2f},{most:.2f}", flush=True)


def timed(work):
    start = time.perf_counter()
    work()
    return time.perf_counter() - start


def on_elements(name, side, operation, runs=5):
    mesh, times = sheet(side), []
    for _ in range(runs):
        edited = bmesh.new()
        edited.from_mesh(mesh)
        for elements in (edited.verts, edited.edges, edited.faces):
            elements.ensure_lookup_table()
        times.append(timed(lambda: operation(edited)))
        edited.free()
    tell(name, side * side, times)


def subdivision_surface(side, runs=5):
    shown = bpy.data.objects.new("sheet", sheet(side))
    bpy.context.collection.objects.link(shown)
    modifier, times, count = shown.modifiers.new("m", "SUBSURF"), [], 0
    modifier.levels = 1
    for _ in range(runs):
        shown.data.update_tag()
        start = time.perf_counter()
        evaluated = shown.evaluated_get(bpy.context.evaluated_depsgraph_get())
        count = len(evaluated.to_mesh().polygons)
        times.append(time.perf_counter() - start)
        evaluated.to_mesh_clear()
        modifier.show_viewport = False
        bpy.context.view_layer.update()
        modifier.show_viewport = True
    tell(f"catmull-clark ({count} faces out)", side * side, times)
    bpy.data.objects.remove(shown)


def in_edit_mode(side, runs=5):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    mesh = sheet(side)
    shown = bpy.data.objects.new("sheet", mesh)
    bpy.context.collection.objects.link(shown)
    bpy.context.view_layer.objects.active = shown
    shown.select_set(True)
    tell("enter edit mode", side * side, [timed(lambda: bpy.ops.object.mode_set(mode="EDIT"))])
    ops = bpy.ops.mesh
    tell("select all", side * side, [timed(lambda: ops.select_all(action="SELECT")) for _ in range(runs)])

    def select_first(count):
        ops.select_all(action="DESELECT")
        edited = bmesh.from_edit_mesh(mesh)
        edited.verts.ensure_lookup_table()
        for vertex in edited.verts[:count]:
            vertex.select = True
        edited.select_flush(True)
        bmesh.update_edit_mesh(mesh)

    for name, operation in (("select linked", ops.select_linked), ("select more", ops.select_more)):
        times = []
        for _ in range(runs):
            select_first(1)
            times.append(timed(operation))
        tell(name, side * side, times)
    select_first(10_000)
    move = lambda: bpy.ops.transform.translate(value=(0, 0, 0.01))
    tell("move 10000 vertices", side * side, [timed(move) for _ in range(runs)])


ops = bmesh.ops
subdivision_surface(500)
on_elements(
    "extrude region, all faces",
    500,
    lambda b: ops.extrude_face_region(b, geom=b.faces[:] + b.edges[:] + b.verts[:]),
)
on_elements(
    "extrude individual, a tenth", 500, lambda b: ops.extrude_discrete_faces(b, faces=list(b.faces)[::10])
)
on_elements(
    "inset individual, a tenth",
    500,
    lambda b: ops.inset_individual(b, faces=list(b.faces)[::10], thickness=0.0005),
)
on_elements(
    "bevel a tenth of the edges, 1 segment",
    200,
    lambda b: ops.bevel(b, geom=list(b.edges)[::10], offset=0.0005, segments=1, affect="EDGES", profile=0.5),
)
on_elements(
    "subdivide flat", 500, lambda b: ops.subdivide_edges(b, edges=b.edges[:], cuts=1, use_grid_fill=True)
)
on_elements(
    "merge by distance, nothing to merge", 500, lambda b: ops.remove_doubles(b, verts=b.verts[:], dist=1e-6)
)
on_elements("triangulate", 500, lambda b: ops.triangulate(b, faces=b.faces[:]))
on_elements("recalculate normals", 500, lambda b: ops.recalc_face_normals(b, faces=b.faces[:]))
on_elements(
    "delete a tenth of the faces", 500, lambda b: ops.delete(b, geom=list(b.faces)[::10], context="FACES")
)
in_edit_mode(1000)
