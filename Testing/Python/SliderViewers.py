# SPDX-FileCopyrightText: Copyright (c) SphericalStyle contributors
# SPDX-License-Identifier: BSD-3-Clause
"""What programs of others show of a file with a slider: three.js in headless Chromium, and Blender in the background."""
import base64
import functools
import http.server
import io
import json
import os
import shutil
import subprocess
import tempfile
import threading

import numpy as np
from PIL import Image

import GLTFFiles

SIZE = 400  # of a picture, pixels
TIME_LIMIT = 900  # seconds, for a program that hangs

# Shows each file from the front (-z), with the slider at each Roundness, and sends back what it shows. Points are those
# that three.js computes itself from targets, bones and nodes; the picture is what its shaders make of the same.
SCENE = """<!DOCTYPE html><meta charset="utf-8">
<script type="importmap">{"imports": {"three": "/modules/three/build/three.module.js"}}</script>
<script type="module">
const send = result => fetch("/result", { method: "POST", body: JSON.stringify(result) });
addEventListener("error", event => send({ error: event.message }));
addEventListener("unhandledrejection", event => send({ error: String(event.reason) }));
const THREE = await import("three");
const { GLTFLoader } = await import("/modules/three/examples/jsm/loaders/GLTFLoader.js");
@FUNCTION@
const asked = @ASKED@;
const renderer = new THREE.WebGLRenderer({ alpha: true });
renderer.setSize(asked.size, asked.size);
function look(scene, meshes, camera) {
  scene.updateMatrixWorld(true);
  renderer.render(scene, camera);
  const picture = renderer.domElement.toDataURL(), points = [], v = new THREE.Vector3();
  for (const mesh of meshes)
    for (let i = 0; i < mesh.geometry.attributes.position.count; ++i)
      points.push(...mesh.getVertexPosition(i, v).applyMatrix4(mesh.matrixWorld).toArray());
  return { picture, points };
}
const results = [];
for (const file of asked.files) {
  const gltf = await new GLTFLoader().loadAsync(file), scene = new THREE.Scene(), meshes = [];
  scene.add(gltf.scene, new THREE.HemisphereLight(0xffffff, 0x666666, 1.2), new THREE.DirectionalLight(0xffffff, 1.5));
  gltf.scene.traverse(node => { if (node.isMesh && node.userData.sphericalStyle) meshes.push(node); });
  if (!meshes.length) throw new Error(file + ": no mesh with a slider");
  const opened = meshes[0].morphTargetInfluences.slice();
  for (const mesh of meshes) setRoundness(mesh, 0);
  scene.updateMatrixWorld(true);
  const box = new THREE.Box3().setFromObject(gltf.scene, true), center = box.getCenter(new THREE.Vector3());
  const size = box.getSize(new THREE.Vector3()), half = 0.65 * Math.max(size.x, size.y);
  const camera = new THREE.OrthographicCamera(-half, half, half, -half, 0, 20 * size.length());
  camera.position.set(center.x, center.y, center.z + 10 * size.length());
  camera.lookAt(center);
  scene.children[2].position.set(1, 2, 3);
  const shown = asked.roundness.map(roundness => {
    for (const mesh of meshes) setRoundness(mesh, roundness);
    return { ...look(scene, meshes, camera), weights: meshes[0].morphTargetInfluences.slice() };
  });
  const told = meshes[0].userData.sphericalStyle, played = [];
  const clip = gltf.animations.find(animation => animation.name === told.animation);
  if (clip) {
    const mixer = new THREE.AnimationMixer(gltf.scene);
    mixer.clipAction(clip).play();
    for (const share of asked.played) {
      mixer.setTime(share * clip.duration);
      played.push(meshes[0].morphTargetInfluences.slice());
    }
  }
  const triangles = [];
  let first = 0; // point of the mesh
  for (const { geometry, matrixWorld } of meshes) {
    const count = geometry.attributes.position.count, index = geometry.index;
    const corners = Array.from({ length: index ? index.count : count }, (_, k) => first + (index ? index.getX(k) : k));
    for (let k = 0; k < corners.length; k += 3)
      triangles.push(matrixWorld.determinant() < 0 ? [corners[k], corners[k + 2], corners[k + 1]] : corners.slice(k, k + 3));
    first += count;
  }
  results.push({ opened, shown, played, triangles, center: center.toArray(), half });
}
send({ results, revision: THREE.REVISION });
</script>"""

# Moves the slider of a page as a hand does, and looks at what it draws.
HAND = """<script>
const seen = data.presets.map(preset => {
  choose(preset);
  draw();
  return [null, 0, 300, 700, 1000].map(place => {
    if (place !== null) {
      slider.value = place;
      slider.dispatchEvent(new Event("input"));
      draw();
    }
    return { preset: preset.name, place: slider.value / 1000, told: document.querySelector("output").textContent,
             picture: canvas.toDataURL(), points: [...points] };
  });
}).flat();
document.documentElement.textContent = JSON.stringify({
  seen, asked: performance.getEntriesByType("resource").map(entry => entry.name) });
</script>"""

# Imports a file, plays its animation, moves its shape keys and renders them.
BLENDER = """
import json, sys
import numpy
if not hasattr(numpy, "bool"):
    numpy.bool = bool  # Blender 3.4's importer has a name that numpy dropped
import bpy
asked = json.load(open(sys.argv[-1]))
bpy.ops.wm.read_homefile(use_empty=True)
bpy.ops.import_scene.gltf(filepath=asked["file"])
model, = [item for item in bpy.data.objects if item.type == "MESH"]
keys = model.data.shape_keys
told = {"names": [key.name for key in keys.key_blocks], "opened": [key.value for key in keys.key_blocks[1:]],
        "version": bpy.app.version_string, "actions": [action.name for action in bpy.data.actions]}
scene = bpy.context.scene
played = []
for seconds in asked["seconds"]:
    frame = seconds * scene.render.fps
    scene.frame_set(int(frame), subframe=frame % 1)
    played.append([key.value for key in keys.key_blocks[1:]])
told["played"] = played
keys.animation_data_clear()
camera = bpy.data.objects.new("Camera", bpy.data.cameras.new("Camera"))
camera.data.type, camera.data.ortho_scale, camera.data.clip_end = "ORTHO", 2 * asked["half"], 1e6
x, y, z = asked["center"]  # y is up in glTF, z in Blender
camera.location, camera.rotation_euler = (x, -z - 20 * asked["half"], y), (1.5707963267948966, 0, 0)
sun = bpy.data.objects.new("Sun", bpy.data.lights.new("Sun", "SUN"))
sun.data.energy, sun.rotation_euler = 3, (0.9, 0.2, 0.4)
for item in (camera, sun):
    scene.collection.objects.link(item)
scene.world = bpy.data.worlds.new("World")
scene.world.use_nodes = True
scene.world.node_tree.nodes["Background"].inputs[0].default_value = (0.5, 0.5, 0.5, 1)
scene.camera = camera
scene.render.engine, scene.cycles.samples, scene.render.film_transparent = "CYCLES", 8, True
scene.cycles.use_denoising = False  # Debian's Blender has none
scene.render.resolution_x = scene.render.resolution_y = asked["size"]
points = []
for number, weights in enumerate(asked["weights"]):
    for key, weight in zip(keys.key_blocks[1:], weights):
        key.value = weight
    shown = model.evaluated_get(bpy.context.evaluated_depsgraph_get())
    mesh = shown.to_mesh()
    found = numpy.empty(3 * len(mesh.vertices), numpy.float32)
    mesh.vertices.foreach_get("co", found)
    points.append(found.reshape(-1, 3)[:, [0, 2, 1]] * [1, 1, -1])
    scene.render.filepath = asked["folder"] + f"/{number}.png"
    bpy.ops.render.render(write_still=True)
numpy.save(asked["folder"] + "/points.npy", points)
json.dump(told, open(asked["folder"] + "/told.json", "w"))
"""


def find_browser():
    return next(filter(None, map(shutil.which, ("chromium", "google-chrome", "chromium-browser"))), None)


def find_three():
    """The folder with three.js, or None where it or a browser is not there."""
    return GLTFFiles.find_module("three") if find_browser() else None


def browser(folder, *arguments, **keywords):
    """The process of a browser without a window that draws without a graphics card and knows no name of a host."""
    command = [find_browser(), "--headless", "--no-sandbox", "--no-first-run", "--use-angle=swiftshader",
               "--enable-unsafe-swiftshader", "--host-resolver-rules=MAP * ~NOTFOUND, EXCLUDE 127.0.0.1",
               "--user-data-dir=" + os.path.join(folder, "profile"), *arguments]
    return subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, **keywords)


class Server(http.server.ThreadingHTTPServer):
    """Hands out a page, node's modules and files, and waits for a result."""

    def __init__(self, page, modules, folder):
        super().__init__(("127.0.0.1", 0), functools.partial(Handler, directory=folder))
        self.page, self.modules, self.result, self.done = page, modules, None, threading.Event()


class Handler(http.server.SimpleHTTPRequestHandler):
    extensions_map = {**http.server.SimpleHTTPRequestHandler.extensions_map, ".js": "text/javascript"}

    def translate_path(self, path):
        if path.startswith("/modules/"):
            self.directory = self.server.modules
            path = path[len("/modules"):]
        return super().translate_path(path)

    def do_GET(self):
        if self.path != "/":
            super().do_GET()
            return
        self.send_response(200)
        self.send_header("Content-Type", "text/html")
        self.end_headers()
        self.wfile.write(self.server.page.encode())

    def do_POST(self):
        self.server.result = json.loads(self.rfile.read(int(self.headers["Content-Length"])))
        self.send_response(204)
        self.end_headers()
        self.server.done.set()

    def log_message(self, *_):
        pass


def function_of(page):
    """setRoundness() as the page about glTF has it for three.js."""
    with open(page, encoding="utf-8") as file:
        return file.read().partition("```js\n")[2].partition("```")[0]


def _decoded(shown):
    shown["points"] = np.array(shown["points"]).reshape(-1, 3)
    shown["picture"] = base64.b64decode(shown["picture"].partition(",")[2])
    return shown


def in_three(modules, files, roundness, function, played=()):
    """What three.js shows of files in one folder: for each a dictionary with opened (weights when it is opened), shown
    (points, picture and weights for each Roundness), played (weights at these shares of the animation), triangles (of the
    points), and center and half, which say what of the x-y plane is in the picture: half to each side of the center."""
    folder = os.path.dirname(os.path.abspath(files[0]))
    asked = {"files": [os.path.basename(file) for file in files], "roundness": list(roundness), "played": list(played),
             "size": SIZE}
    page = SCENE.replace("@FUNCTION@", function).replace("@ASKED@", json.dumps(asked))
    with Server(page, modules, folder) as server, tempfile.TemporaryDirectory() as profile:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        process = browser(profile, "--remote-debugging-port=0", f"http://127.0.0.1:{server.server_address[1]}/")
        try:
            assert server.done.wait(TIME_LIMIT), "the browser said nothing"
        finally:
            process.kill()
            process.communicate()
            server.shutdown()
    assert "error" not in server.result, server.result["error"]
    for result in server.result["results"]:
        result["shown"] = [_decoded(shown) for shown in result["shown"]]
    return server.result["results"]


def page_in_browser(page):
    """(what is seen, what the page asked the network for): for each preset its points and picture where the page opens
    it (w is place times the end of the slider), and at 0, .3, .7 and 1 of the slider."""
    with tempfile.TemporaryDirectory() as folder:
        moved = os.path.join(folder, "moved.html")
        with open(page, encoding="utf-8") as file, open(moved, "w", encoding="utf-8") as copy:
            copy.write(file.read().replace("</body>", HAND + "</body>"))
        process = browser(folder, "--dump-dom", "file://" + moved)
        text = process.communicate(timeout=TIME_LIMIT)[0].decode()
    result = json.loads(text[text.index("{"):text.rindex("}") + 1])
    return [_decoded(shown) for shown in result["seen"]], result["asked"]


def in_blender(file, weights, seconds, center, half):
    """What Blender makes of a file with one mesh: a dictionary with the names of its shape keys, opened (their values),
    played (the same at these seconds of the animation), actions, version, and points and pictures for each of `weights`;
    center and half as of in_three()."""
    with tempfile.TemporaryDirectory() as folder:
        script, asked = os.path.join(folder, "script.py"), os.path.join(folder, "asked.json")
        with open(script, "w", encoding="utf-8") as out:
            out.write(BLENDER)
        with open(asked, "w", encoding="utf-8") as out:
            json.dump({"file": os.path.abspath(file), "folder": folder, "weights": weights, "seconds": seconds,
                       "center": [float(x) for x in center], "half": float(half), "size": SIZE}, out)
        result = subprocess.run(["blender", "--background", "--factory-startup", "--python-exit-code", "1",
                                 "--python", script, "--", asked], capture_output=True, text=True, timeout=TIME_LIMIT)
        assert result.returncode == 0, result.stdout + result.stderr
        with open(os.path.join(folder, "told.json"), encoding="utf-8") as done:
            told = json.load(done)
        told["points"] = np.load(os.path.join(folder, "points.npy"))
        told["pictures"] = []
        for number in range(len(weights)):
            with open(os.path.join(folder, f"{number}.png"), "rb") as picture:
                told["pictures"].append(picture.read())
    return told


def silhouette(picture):
    """Where something is in a picture with a transparent ground: left, top, right and bottom in pixels."""
    return np.array(Image.open(io.BytesIO(picture)).convert("RGBA").getchannel("A").point(
        lambda alpha: 255 if alpha > 127 else 0).getbbox() or (0, 0, 0, 0))


def silhouette_of(points, center, half):
    """The same of points, seen from the front."""
    x, y = (points[:, 0] - center[0]) / half, (center[1] - points[:, 1]) / half
    return (np.array([x.min(), y.min(), x.max(), y.max()]) + 1) * SIZE / 2


def sheet(pictures, path, columns):
    """Pictures in rows, on white."""
    images = [Image.open(io.BytesIO(picture)).convert("RGBA") for picture in pictures]
    width, height = images[0].size
    whole = Image.new("RGBA", (width * columns, height * -(-len(images) // columns)), "white")
    for k, image in enumerate(images):
        whole.alpha_composite(image, (k % columns * width, k // columns * height))
    whole.convert("RGB").save(path)


def drawn(picture):
    """The share of an opaque picture that does not have the color of its first corner."""
    pixels = np.asarray(Image.open(io.BytesIO(picture)).convert("RGB")).reshape(-1, 3)
    return (pixels != pixels[0]).any(axis=1).mean()
