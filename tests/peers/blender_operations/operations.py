"""The operations: for each a selection, the commands of trigon, and a function that does the same in Blender."""
import dataclasses
import math
from typing import Callable

import bpy

import selections as on
from blender import in_view
from calls import (
    about_center,
    connect_path,
    loop_cut,
    merge_first,
    merge_last,
    mirror_copy,
    mirror_in_place,
    moved,
    object_change,
    plain,
    separate_and_join,
    split_edges,
    surface,
    then_all,
    triangulate,
    turn_some,
)

ops = bpy.ops.mesh


@dataclasses.dataclass
class Operation:
    name: str
    # What is selected: "vertex", "edge" or "face".
    kind: str
    select: Callable
    commands: list
    # Called with the BMesh in edit mode and the selected elements.
    blender: Callable
    # Another call with which the result may agree.
    other: Callable | None = None


def op(name, **parameters):
    return {"op": name, **parameters}


VECTOR = [0.1, 0.25, -0.2]
BEVEL = {"offset": 0.06, "clamp_overlap": True, "offset_type": "OFFSET"}
TABLE = [
    Operation("nothing", "vertex", on.all_vertices, [], lambda edited, chosen: None),
]


def add(name, kind, select, commands, blender, **more):
    commands = commands if isinstance(commands, list) else [commands]
    TABLE.append(Operation(name, kind, select, commands, blender, **more))


def each(name, kind, selects, commands, blender, **more):
    """The same operation on several selections."""
    for select in selects:
        add(f"{name}, {select.__name__.replace('_', ' ')}", kind, select, commands, blender, **more)


VERTICES = (on.one_vertex, on.some_vertices)
EDGES = (on.one_edge, on.some_edges)
FACES = (on.one_face, on.patch, on.some_faces, on.all_faces)

# Deleting and copying.
each("delete vertices", "vertex", VERTICES, op("delete", what="vertices"), plain(ops.delete, type="VERT"))
each("delete edges", "edge", EDGES, op("delete", what="edges"), plain(ops.delete, type="EDGE"))
each("delete faces", "face", FACES, op("delete", what="faces"), plain(ops.delete, type="FACE"))
each("delete only faces", "face", FACES[:3], op("delete", what="only_faces"), plain(ops.delete, type="ONLY_FACE"))
each("duplicate", "face", FACES[1:], op("duplicate", offset=VECTOR), moved("duplicate_move", VECTOR))
each("duplicate edges", "edge", EDGES, op("duplicate", offset=VECTOR), moved("duplicate_move", VECTOR))
each("split off", "face", FACES[:3], op("split_off"), plain(ops.split))
each("separate selection", "face", FACES[:3], op("separate", by="selection"), plain(ops.separate, type="SELECTED"))
add("separate loose parts", "face", on.all_faces, op("separate", by="loose_parts"), plain(ops.separate, type="LOOSE"))
add(
    "separate loose parts and join",
    "face",
    on.all_faces,
    [op("separate", by="loose_parts"), op("leave_edit_mode"), op("select_all"), op("join_objects")],
    separate_and_join,
)
add("rip around a patch", "edge", on.outline_of_patch, op("rip", direction=[1, 0.3, 0.2]), split_edges)

# Extruding and insetting.
each("extrude by a vector", "face", FACES, op("extrude", offset=VECTOR), moved("extrude_region_move", VECTOR))
each(
    "extrude along normals",
    "face",
    FACES,
    op("extrude", distance=0.2),
    plain(ops.extrude_region_shrink_fatten, TRANSFORM_OT_shrink_fatten={"value": 0.2}),
)
each(
    "extrude individually",
    "face",
    FACES[1:],
    op("extrude", distance=0.2, individual=True),
    plain(ops.extrude_faces_move, TRANSFORM_OT_shrink_fatten={"value": 0.2}),
)
each("extrude edges", "edge", EDGES, op("extrude", offset=VECTOR), moved("extrude_context_move", VECTOR))
add("extrude a border", "edge", on.one_border, op("extrude", offset=VECTOR), moved("extrude_context_move", VECTOR))
each("extrude vertices", "vertex", VERTICES, op("extrude", offset=VECTOR), moved("extrude_context_move", VECTOR))
INSET = {"thickness": 0.04}
each("inset", "face", FACES, op("inset", **INSET), plain(ops.inset, **INSET))
each("inset with depth", "face", FACES[:3], op("inset", depth=0.03, **INSET), plain(ops.inset, depth=0.03, **INSET))
each(
    "inset without borders",
    "face",
    FACES[1:],
    op("inset", open_borders=False, **INSET),
    plain(ops.inset, use_boundary=False, **INSET),
)
each(
    "inset individually",
    "face",
    FACES[1:],
    op("inset", mode="individual", depth=0.03, **INSET),
    plain(ops.inset, use_individual=True, depth=0.03, **INSET),
)
each("outset", "face", FACES[:2], op("inset", mode="outset", **INSET), plain(ops.inset, use_outset=True, **INSET))

# Bevels.
OURS = {"width": 0.06}
BEVELED = (on.one_edge, on.apart_edges, on.edges_of_face, on.some_edges, on.all_edges)
for segments in (1, 2, 3):
    each(
        f"bevel, {segments} segments",
        "edge",
        BEVELED,
        op("bevel", segments=segments, **OURS),
        plain(ops.bevel, segments=segments, **BEVEL),
    )
for profile in (0.25, 0.7):
    add(
        f"bevel, profile {profile}",
        "edge",
        on.apart_edges,
        op("bevel", segments=4, profile=profile, **OURS),
        plain(ops.bevel, segments=4, profile=profile, **BEVEL),
    )
for kind, theirs in {"width": "WIDTH", "depth": "DEPTH", "absolute": "ABSOLUTE"}.items():
    each(
        f"bevel by {kind}",
        "edge",
        (on.one_edge, on.edges_of_face),
        op("bevel", width_type=kind, **OURS),
        plain(ops.bevel, **{**BEVEL, "offset_type": theirs}),
    )
each(
    "bevel by percent",
    "edge",
    (on.one_edge, on.edges_of_face),
    op("bevel", width_type="percent", width=12),
    plain(ops.bevel, offset_type="PERCENT", offset_pct=12.0, clamp_overlap=True),
)
for miter in ("patch", "arc"):
    add(
        f"bevel, outer miter {miter}",
        "edge",
        on.some_edges,
        op("bevel", segments=2, outer_miter=miter, **OURS),
        plain(ops.bevel, segments=2, miter_outer=miter.upper(), spread=0.06, **BEVEL),
    )
add(
    "bevel, inner miter arc",
    "edge",
    on.edges_of_face,
    op("bevel", segments=2, inner_miter="arc", **OURS),
    plain(ops.bevel, segments=2, miter_inner="ARC", spread=0.06, **BEVEL),
)
for segments in (1, 3):
    each(
        f"bevel vertices, {segments} segments",
        "vertex",
        (on.inner_vertex, on.apart_vertices, on.all_vertices),
        op("bevel", vertices=True, segments=segments, **OURS),
        plain(ops.bevel, affect="VERTICES", segments=segments, **BEVEL),
    )

# Cutting.
CUT = (on.one_edge, on.some_edges, on.all_edges)
for cuts in (1, 2, 3):
    theirs = plain(ops.subdivide, number_cuts=cuts, ngon=False, quadcorner="INNERVERT")
    each(f"subdivide, {cuts} cuts", "edge", CUT, op("subdivide", cuts=cuts), theirs)
add("subdivide with n-gons, some edges", "edge", on.some_edges, op("subdivide"), plain(ops.subdivide))
for cuts in (1, 3):
    add(f"loop cut, {cuts} cuts", "edge", on.quad_edge, op("loop_cut", cuts=cuts), loop_cut(cuts))
each("triangulate", "face", (on.some_faces, on.all_faces), op("triangulate"), triangulate)
add(
    "triangles to quads",
    "face",
    on.all_faces,
    [op("triangulate"), op("select_all"), op("tris_to_quads")],
    then_all(triangulate, plain(ops.tris_convert_to_quads)),
)
add("connect across a face", "vertex", on.across_face, op("connect_vertices"), connect_path)
add("connect across two faces", "vertex", on.across_two_faces, op("connect_vertices"), connect_path)
add("connect, some vertices", "vertex", on.some_vertices, op("connect_vertices"), plain(ops.vert_connect))
for levels in (1, 2):
    add(
        f"Catmull-Clark, {levels} levels", "face", on.all_faces, op("catmull_clark", levels=levels), surface(levels)
    )
add(
    "subdivision surface",
    "face",
    on.all_faces,
    [op("leave_edit_mode"), op("select", objects=["subject"]), op("set_subdivision", levels=1), op("apply_subdivision")],
    surface(1),
)

# Filling.
add("fill a border", "edge", on.one_border, op("fill"), plain(ops.edge_face_add))
add("fill a border with a grid", "edge", on.even_border, op("grid_fill"), plain(ops.fill_grid))
add("fill vertices", "vertex", on.across_two_faces, op("fill"), plain(ops.edge_face_add))
add("bridge borders", "edge", on.two_borders, op("bridge"), plain(ops.bridge_edge_loops))
add("bridge faces", "face", on.two_far_faces, op("bridge"), plain(ops.bridge_edge_loops))

# Dissolving and merging.
each("dissolve vertices", "vertex", (on.inner_vertex, on.apart_vertices, on.some_vertices), op("dissolve"), plain(ops.dissolve_verts))
each("dissolve edges", "edge", (on.one_edge, on.apart_edges, on.some_edges), op("dissolve"), plain(ops.dissolve_edges))
each("dissolve faces", "face", (on.patch, on.some_faces), op("dissolve"), plain(ops.dissolve_faces))
for angle in (5, 30):
    add(
        f"limited dissolve, {angle} degrees",
        "face",
        on.all_faces,
        op("dissolve_flat", angle=angle),
        plain(ops.dissolve_limited, angle_limit=math.radians(angle)),
    )
add("merge at the centre", "vertex", on.edge_ends, op("merge", at="center"), plain(ops.merge, type="CENTER"))
add("merge some at the centre", "vertex", on.some_vertices, op("merge", at="center"), plain(ops.merge, type="CENTER"))
add("merge at the first", "vertex", on.some_vertices, op("merge", at="first"), merge_first)
add("merge at the last", "vertex", on.some_vertices, op("merge", at="last"), merge_last)
each("collapse", "edge", EDGES, op("merge", at="collapse"), plain(ops.merge, type="COLLAPSE"))
for distance in (1e-4, 0.2):
    add(
        f"merge by distance {distance}",
        "vertex",
        on.all_vertices,
        op("merge", at="distance", distance=distance),
        plain(ops.remove_doubles, threshold=distance),
    )
add("repair: loose elements", "vertex", on.all_vertices, op("repair"), plain(ops.delete_loose))

# Sides and symmetry.
each("flip normals", "face", (on.some_faces, on.all_faces), op("flip_normals"), plain(ops.flip_normals))
for inside in (False, True):
    add(
        f"recalculate normals{' inside' if inside else ''}",
        "face",
        on.some_faces,
        [op("flip_normals"), op("select_all"), op("recalculate_normals", inside=inside)],
        then_all(turn_some, plain(ops.normals_make_consistent, inside=inside)),
    )
X_PLANE = {"normal": [1, 0, 0], "point": [0, 0, 0]}
add("mirror", "vertex", on.all_vertices, op("mirror", plane=X_PLANE), mirror_in_place)
add(
    "mirror a copy",
    "face",
    on.all_faces,
    op("mirror", plane=X_PLANE, copy=True, merge_distance=1e-4),
    mirror_copy,
)
add(
    "symmetrize", "face", on.all_faces, op("symmetrize", plane=X_PLANE), plain(ops.symmetrize, direction="POSITIVE_X")
)


# Moving.
transform = bpy.ops.transform
SOFT = {"radius": 0.9, "shape": "smooth"}
THEIRS = {"use_proportional_edit": True, "proportional_size": 0.9, "proportional_edit_falloff": "SMOOTH"}
add("translate", "vertex", on.some_vertices, op("translate", offset=VECTOR), plain(transform.translate, value=VECTOR))
add(
    "translate with falloff",
    "vertex",
    on.some_vertices,
    op("translate", offset=VECTOR, proportional=SOFT),
    plain(transform.translate, value=VECTOR, **THEIRS),
)
add(
    "translate with falloff along edges",
    "vertex",
    on.some_vertices,
    op("translate", offset=VECTOR, proportional={**SOFT, "connected": True}),
    plain(transform.translate, value=VECTOR, use_proportional_connected=True, **THEIRS),
)
add(
    "rotate",
    "vertex",
    on.some_vertices,
    op("rotate", axis=[0, 1, 0], angle=35),
    about_center(transform.rotate, value=math.radians(35), orient_axis="Y", orient_type="GLOBAL"),
)
add(
    "rotate with falloff",
    "vertex",
    on.one_vertex,
    op("rotate", axis=[0, 1, 0], angle=35, proportional=SOFT),
    about_center(transform.rotate, value=math.radians(35), orient_axis="Y", orient_type="GLOBAL", **THEIRS),
)
add(
    "scale",
    "vertex",
    on.some_vertices,
    op("scale", factors=[1.5, 0.5, 2.0]),
    about_center(transform.resize, value=(1.5, 0.5, 2.0), orient_type="GLOBAL"),
)
add(
    "to sphere",
    "vertex",
    on.some_vertices,
    op("to_sphere", factor=0.7),
    about_center(transform.tosphere, value=0.7),
)
add(
    "push and pull",
    "vertex",
    on.some_vertices,
    op("push_pull", distance=0.1),
    about_center(transform.push_pull, value=-0.1),
)
add(
    "shrink and fatten",
    "vertex",
    on.some_vertices,
    op("shrink_fatten", distance=0.1),
    plain(transform.shrink_fatten, value=0.1),
)
add(
    "apply a placement",
    "vertex",
    on.all_vertices,
    [
        op("leave_edit_mode"),
        op("select", objects=["subject"]),
        op(
            "set_transform",
            location=[1.0, 2.0, -0.5],
            scale=[2.0, 0.5, 1.5],
            rotation={"by": "euler", "angles": [30, -20, 50]},
        ),
        op("apply_transform", location=True, rotation=True, scale=True),
    ],
    object_change,
)
add(
    "slide an edge",
    "edge",
    on.quad_edge,
    op("slide_edges", factor=0.4),
    lambda edited, chosen: in_view(transform.edge_slide, value=0.4),
    # Which side is positive depends on the view in Blender.
    other=lambda edited, chosen: in_view(transform.edge_slide, value=-0.4),
)

# Selecting: what is selected is deleted, so that the counts tell.
GONE = {"vertex": op("delete", what="vertices"), "edge": op("delete", what="edges"), "face": op("delete", what="faces")}
TYPES = {"vertex": "VERT", "edge": "EDGE", "face": "FACE"}


def selecting(name, kind, select, commands, blender):
    gone = plain(ops.delete, type=TYPES[kind])
    commands = commands if isinstance(commands, list) else [commands]
    add(f"select {name}", kind, select, [*commands, GONE[kind]], then_all(blender, gone))


selecting("more", "vertex", on.some_vertices, op("select_more"), plain(ops.select_more))
selecting("more faces", "face", on.one_face, op("select_more"), plain(ops.select_more))
selecting("less", "face", on.some_faces, [op("select_more"), op("select_less")], then_all(plain(ops.select_more), plain(ops.select_less)))
selecting("inverse", "face", on.some_faces, op("select_inverse"), plain(ops.select_all, action="INVERT"))
selecting("linked", "face", on.one_face, op("select_linked"), plain(ops.select_linked))
selecting("a loop of edges", "edge", on.one_edge, op("select_loop"), plain(ops.loop_multi_select, ring=False))
selecting("a ring of edges", "edge", on.one_edge, op("select_ring"), plain(ops.loop_multi_select, ring=True))
selecting("the border", "edge", on.nothing, [op("select_all"), op("select_border")], then_all(plain(ops.select_all, action="SELECT"), plain(ops.region_to_loop)))
selecting("non-manifold", "edge", on.nothing, op("select_non_manifold"), plain(ops.select_non_manifold))
selecting("sharp", "edge", on.nothing, op("select_sharp", angle=30), plain(ops.edges_select_sharp, sharpness=math.radians(30)))
selecting(
    "similar by corners",
    "face",
    on.one_face,
    op("select_similar", by="corners"),
    plain(ops.select_similar, type="FACE_SIDES", threshold=0.0),
)
selecting(
    "similar by edges",
    "vertex",
    on.one_vertex,
    op("select_similar", by="edges"),
    plain(ops.select_similar, type="VERT_EDGES", threshold=0.0),
)
