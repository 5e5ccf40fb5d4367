"""Calls of Blender's operators that take more than a name and parameters."""
import math

import bpy
import bmesh

from blender import in_view

ops = bpy.ops.mesh
AXES = {"constraint_axis": (True, False, False), "orient_type": "GLOBAL"}


def plain(function, **parameters):
    """A Blender operator without anything else."""
    return lambda edited, chosen: function(**parameters)


def then_all(*functions):
    return lambda edited, chosen: [function(edited, chosen) for function in functions]


def moved(name, vector, **parameters):
    """An operator followed by a translation."""
    return plain(getattr(ops, name), TRANSFORM_OT_translate={"value": vector}, **parameters)


def in_order(edited, chosen):
    """Blender takes the first and the last vertex of a merge from the history of the selection."""
    edited.select_history.clear()
    for vertex in chosen:
        edited.select_history.add(vertex)


def merge_first(edited, chosen):
    in_order(edited, chosen)
    ops.merge(type="FIRST")


def merge_last(edited, chosen):
    in_order(edited, chosen)
    ops.merge(type="LAST")


def surface(levels):
    """Not an operator on elements: the modifier, with the points of the subdivided mesh instead of the limit's."""

    def run(edited, chosen):
        bpy.ops.object.mode_set(mode="OBJECT")
        subject = bpy.context.object
        modifier = subject.modifiers.new("s", "SUBSURF")
        modifier.levels, modifier.use_limit_surface = levels, False
        bpy.ops.object.modifier_apply(modifier=modifier.name)

    return run


def loop_cut(cuts):
    def run(edited, chosen):
        index = chosen[0].index
        in_view(ops.loopcut, number_cuts=cuts, object_index=0, edge_index=index)

    return run


def mirror_copy(edited, chosen):
    """The modifier: bmesh.ops.mirror leaves the copy inside out."""
    bpy.ops.object.mode_set(mode="OBJECT")
    modifier = bpy.context.object.modifiers.new("m", "MIRROR")
    modifier.use_axis, modifier.merge_threshold = (True, False, False), 1e-4
    bpy.ops.object.modifier_apply(modifier=modifier.name)


def split_edges(edited, chosen):
    bmesh.ops.split_edges(edited, edges=chosen)


def connect_path(edited, chosen):
    in_order(edited, chosen)
    ops.vert_connect_path()


def center_of(points):
    """trigon's default centre, so that both have the same."""
    total = sum((point.co for point in points), points[0].co * 0)
    return total / len(points)


def about_center(operator, **parameters):
    return lambda edited, chosen: operator(center_override=center_of(chosen), **parameters)


def object_change(edited, chosen):
    bpy.ops.object.mode_set(mode="OBJECT")
    subject = bpy.context.object
    subject.location, subject.scale = (1.0, 2.0, -0.5), (2.0, 0.5, 1.5)
    subject.rotation_mode, subject.rotation_euler = "XYZ", (math.radians(30), math.radians(-20), math.radians(50))
    bpy.ops.object.transform_apply(location=True, rotation=True, scale=True)


def separate_and_join(edited, chosen):
    ops.separate(type="LOOSE")
    bpy.ops.object.mode_set(mode="OBJECT")
    bpy.ops.object.select_all(action="SELECT")
    if len(bpy.context.selected_objects) > 1:
        bpy.ops.object.join()


def turn_some(edited, chosen):
    ops.flip_normals()
    ops.select_all(action="SELECT")


def triangulate(edited, chosen):
    ops.quads_convert_to_tris(quad_method="SHORTEST_DIAGONAL", ngon_method="BEAUTY")


def mirror_in_place(edited, chosen):
    bpy.ops.transform.mirror(center_override=(0, 0, 0), **AXES)
    ops.flip_normals()
