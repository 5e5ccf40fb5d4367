#!/usr/bin/env python3
"""The crate of docs/crate.md in other programs: what Blender and three.js read is what is in the file.

    python tests/peers/crate.py crate.glb [--again blender.glb] [--three node_modules/three --browser chromium --picture page.png]

needs Python 3.11 with bpy and numpy; for the web page, three.js (`npm install three`) and Chromium. Triangles are compared as sets of
corners with position and texture coordinates; the image byte by byte.
"""

import argparse
import base64
import functools
import http.server
import json
import pathlib
import queue
import struct
import subprocess
import sys
import tempfile
import threading

import bpy
import numpy

COMPONENTS = {5120: "i1", 5121: "u1", 5122: "<i2", 5123: "<u2", 5125: "<u4", 5126: "<f4"}
WIDTHS = {"SCALAR": 1, "VEC2": 2, "VEC3": 3, "VEC4": 4}


class Glb:
    """A GLB without sparse or compressed data."""

    def __init__(self, path):
        data = pathlib.Path(path).read_bytes()
        length = struct.unpack_from("<I", data, 12)[0]
        self.json = json.loads(data[20 : 20 + length])
        self.binary = data[28 + length :]

    def view(self, index):
        view = self.json["bufferViews"][index]
        start = view.get("byteOffset", 0)
        return self.binary[start : start + view["byteLength"]], view.get("byteStride")

    def accessor(self, index):
        accessor = self.json["accessors"][index]
        data, stride = self.view(accessor["bufferView"])
        kind, width = numpy.dtype(COMPONENTS[accessor["componentType"]]), WIDTHS[accessor["type"]]
        step = stride or kind.itemsize * width
        start = accessor.get("byteOffset", 0)
        rows = [numpy.frombuffer(data, kind, width, start + step * row) for row in range(accessor["count"])]
        return numpy.array(rows)

    def triangles(self):
        found = []
        for mesh in self.json["meshes"]:
            for primitive in mesh["primitives"]:
                positions = self.accessor(primitive["attributes"]["POSITION"])
                uvs = self.accessor(primitive["attributes"]["TEXCOORD_0"])
                indices = self.accessor(primitive["indices"]).reshape(-1, 3)
                found += [[(*positions[i], *uvs[i]) for i in triangle] for triangle in indices]
        return as_set(found)

    def image(self):
        return bytes(self.view(self.json["images"][0]["bufferView"])[0])


def as_set(triangles):
    """Each from its smallest corner on, in the order in which it is wound."""
    rounded = [[tuple(round(float(x), 5) + 0.0 for x in corner) for corner in triangle] for triangle in triangles]
    turned = [min(t[i:] + t[:i] for i in range(3)) for t in rounded]
    return sorted(map(tuple, turned))


def in_blender(path, again):
    """Reads a file and writes it again. Its triangles in the axes and the texture coordinates of glTF, and the image."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    bpy.ops.import_scene.gltf(filepath=str(path))
    triangles = []
    for thing in bpy.data.objects:
        if thing.type != "MESH":
            continue
        mesh, uvs = thing.data, thing.data.uv_layers.active.data
        mesh.calc_loop_triangles()
        for triangle in mesh.loop_triangles:
            corners = []
            for vertex, loop in zip(triangle.vertices, triangle.loops):
                x, y, z = thing.matrix_world @ mesh.vertices[vertex].co
                corners.append((x, z, -y, uvs[loop].uv.x, 1 - uvs[loop].uv.y))
            triangles.append(corners)
    image = bytes(bpy.data.images[0].packed_file.data)
    if again:
        bpy.ops.export_scene.gltf(filepath=str(again), export_format="GLB")
    return as_set(triangles), image


PAGE = """<!doctype html><meta charset="utf-8">
<script type="importmap">{"imports": {"three": "./three/build/three.module.js"}}</script>
<script type="module">
import * as THREE from 'three';
import { GLTFLoader } from './three/examples/jsm/loaders/GLTFLoader.js';
const told = (found) => fetch('/found', { method: 'POST', body: JSON.stringify(found) });
const renderer = new THREE.WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
renderer.setSize(640, 480); renderer.setClearColor(0x808890);
new GLTFLoader().load('./model.glb', (gltf) => {
  const scene = new THREE.Scene(); scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x666666, 3));
  const camera = new THREE.PerspectiveCamera(40, 4 / 3, 0.1, 100); camera.position.set(4, 3, 5); camera.lookAt(0, 0, 0);
  renderer.render(scene, camera);
  const corners = []; let image = null;
  gltf.scene.updateMatrixWorld(true);
  gltf.scene.traverse((node) => {
    if (!node.isMesh) return;
    const p = node.geometry.attributes.position, t = node.geometry.attributes.uv, v = new THREE.Vector3();
    const map = node.material.map; image = map && [map.image.width, map.image.height];
    const index = node.geometry.index, count = index ? index.count : p.count;
    for (let k = 0; k < count; k++) {
      const i = index ? index.getX(k) : k;
      v.fromBufferAttribute(p, i).applyMatrix4(node.matrixWorld);
      corners.push([v.x, v.y, v.z, t.getX(i), t.getY(i)]);
    }
  });
  told({ corners, image, picture: renderer.domElement.toDataURL() });
}, undefined, (error) => told({ error: String(error) }));
</script>"""


class Page(http.server.SimpleHTTPRequestHandler):
    """Serves a folder, and takes what its page has found."""

    found = queue.Queue()

    def do_POST(self):
        self.found.put(json.loads(self.rfile.read(int(self.headers["Content-Length"]))))
        self.send_response(204)
        self.end_headers()

    def log_message(self, *_):
        pass


def in_browser(path, three, browser, picture):
    """What three.js makes of a file in a page, and optionally its picture."""
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "index.html").write_text(PAGE)
        (root / "model.glb").write_bytes(pathlib.Path(path).read_bytes())
        (root / "three").symlink_to(pathlib.Path(three).resolve())
        server = http.server.ThreadingHTTPServer(("127.0.0.1", 0), functools.partial(Page, directory=folder))
        threading.Thread(target=server.serve_forever, daemon=True).start()
        address = f"http://127.0.0.1:{server.server_port}/index.html"
        options = ["--headless=new", "--no-sandbox", "--use-angle=swiftshader", "--enable-unsafe-swiftshader"]
        shown = subprocess.Popen([browser, *options, f"--user-data-dir={folder}/profile", "--remote-debugging-port=0", address],
                                 stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        try:
            found = Page.found.get(timeout=300)
        except queue.Empty:
            sys.exit("three.js: the page found nothing in five minutes")
        finally:
            shown.terminate()
            shown.wait()
            server.shutdown()
    if "error" in found:
        sys.exit(f"three.js: {found['error']}")
    if picture:
        pathlib.Path(picture).write_bytes(base64.b64decode(found["picture"].split(",")[1]))
    corners = found["corners"]
    return as_set([corners[k : k + 3] for k in range(0, len(corners), 3)]), found["image"]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("file")
    parser.add_argument("--again")
    parser.add_argument("--three")
    parser.add_argument("--browser", default="chromium")
    parser.add_argument("--picture")
    arguments = parser.parse_args()
    own = Glb(arguments.file)
    triangles, image = own.triangles(), own.image()
    findings = []

    def check(what, is_same):
        print(f"{what}: {'the same' if is_same else 'DIFFERENT'}")
        findings.extend([] if is_same else [what])

    of_blender, image_of_blender = in_blender(arguments.file, arguments.again)
    check(f"Blender, {len(triangles)} triangles with positions and texture coordinates", of_blender == triangles)
    check(f"Blender, image of {len(image)} bytes", image_of_blender == image)
    if arguments.again:
        again = Glb(arguments.again)
        check("Blender's own GLB, triangles", again.triangles() == triangles)
        check("Blender's own GLB, image", again.image() == image)
    if arguments.three:
        of_page, size = in_browser(arguments.file, arguments.three, arguments.browser, arguments.picture)
        check("three.js, triangles", of_page == triangles)
        print(f"three.js, image: {size[0]} × {size[1]} pixels")
    sys.exit(1 if findings else 0)


if __name__ == "__main__":
    main()
