"""Images per second of `hedgehop dataset` on one core, the memory of meshes with large images or many nodes, and the import of a
mesh of a million triangles with a flight past it.

A data set has 640 x 480 px in all channels: color, depth, optic flow, classes and instances of the city, noise-free. Its CPU
time contains the construction of the city; that of the images alone is the difference between many images and one.
"""

import array
import json
import math
import shutil
import struct
import zlib

from logs import measured

IMAGES = 200
CAMERA = "rig.cameras.0={role: front, width: 640, height: 480, fov: 75, rate: 10, channel: color}"
SIDE_PX, NODES = 8192, 10_000
CAMERA_PAST = "rig.cameras=[{role: front, width: 640, height: 480, fov: 75, rate: 10, channel: color, forward: 0.3}]"
SPHERE_ROWS, FLIGHT_S = 708, 9  # 708 x 708 squares are 1,002,528 triangles


def dataset(root, hedgehop, images):
    out = root / "out/bench/dataset"
    shutil.rmtree(out, ignore_errors=True)
    return measured([hedgehop, "dataset", root / "configs/worlds/park.yaml", "--set", CAMERA, "--set", "scene={type: urban}",
                     "--images", images, "--renderer", "tiles", "--out", out])


def png(side_px):
    """A color image of stripes."""
    chunk = lambda kind, data: struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    packed = zlib.compressobj(1)
    row = b"\0" + bytes((u // 64 * 37) % 256 for u in range(side_px) for _ in range(3))
    data = b"".join(packed.compress(row) for _ in range(side_px)) + packed.flush()
    head = struct.pack(">IIBBBBB", side_px, side_px, 8, 2, 0, 0, 0)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", head) + chunk(b"IDAT", data) + chunk(b"IEND", b"")


def quads(count):
    """An OBJ of upright squares of 8 m, one object each, in rows 20 m apart."""
    lines = ["mtllib quads.mtl", "vt 0 0", "vt 1 0", "vt 1 1", "vt 0 1"]
    for k in range(count):
        x, z, first = 20 * (k % 100) - 1000, 20 * (k // 100) - 1000, 4 * k + 1
        lines += [f"o quad{k}", "usemtl face", *(f"v {x + dx} {y} {z}" for dx, y in ((0, 0), (8, 0), (8, 8), (0, 8)))]
        lines.append("f " + " ".join(f"{first + i}/{i + 1}" for i in range(4)))
    return "\n".join(lines) + "\n"


def imported(root, hedgehop, name, nodes, side_px):
    """Renders a mesh of some nodes, each with an image."""
    folder = root / f"out/bench/{name}"
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "quads.obj").write_text(quads(nodes))
    (folder / "quads.mtl").write_text("newmtl face\nmap_Kd face.png\n")
    (folder / "face.png").write_bytes(png(side_px))
    scene = f"scene={{type: open, imports: [{{file: {json.dumps(str(folder / 'quads.obj'))}, north: 9, east: 9}}]}}"
    return measured([hedgehop, "render", root / "configs/worlds/wall.yaml", "--set", scene, "--camera", "front", "--renderer", "tiles",
                     "-o", folder / "seen.png"])


def wavy_sphere(rows):
    """Positions and indices of a closed sphere of 8 m radius with waves of 0.3 m, of 2 * rows^2 triangles."""
    positions, indices = array.array("f"), array.array("I")
    for i in range(rows + 1):
        for k in range(rows):
            polar, around = math.pi * i / rows, 2 * math.pi * k / rows
            radius = 8 + 0.3 * math.sin(9 * polar) * math.cos(7 * around)
            positions.extend((radius * math.sin(polar) * math.cos(around), radius * math.cos(polar),
                              -radius * math.sin(polar) * math.sin(around)))
    for i in range(rows):
        for k in range(rows):
            a, b, below = i * rows + k, i * rows + (k + 1) % rows, rows
            indices.extend((a, a + below, b, b, a + below, b + below))
    return positions, indices


def glb(positions, indices):
    points, faces = positions.tobytes(), indices.tobytes()
    document = {"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
                "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
                "accessors": [{"bufferView": 0, "componentType": 5126, "count": len(positions) // 3, "type": "VEC3",
                               "min": [min(positions[n::3]) for n in range(3)], "max": [max(positions[n::3]) for n in range(3)]},
                              {"bufferView": 1, "componentType": 5125, "count": len(indices), "type": "SCALAR"}],
                "bufferViews": [{"buffer": 0, "byteLength": len(points)}, {"buffer": 0, "byteOffset": len(points), "byteLength": len(faces)}],
                "buffers": [{"byteLength": len(points) + len(faces)}]}
    text = json.dumps(document).encode()
    text += b" " * (-len(text) % 4)
    body = points + faces
    return (struct.pack("<4sII", b"glTF", 2, 28 + len(text) + len(body)) + struct.pack("<I4s", len(text), b"JSON") + text
            + struct.pack("<I4s", len(body), b"BIN\0") + body)


def obj(positions, indices):
    lines = ["v %.6f %.6f %.6f" % tuple(positions[i:i + 3]) for i in range(0, len(positions), 3)]
    lines += ["f %d %d %d" % tuple(index + 1 for index in indices[i:i + 3]) for i in range(0, len(indices), 3)]
    return ("\n".join(lines) + "\n").encode()


def past_sphere(root, hedgehop):
    """Validates a scenario with the sphere next to the route, 5 m away, as GLB and as OBJ, and flies it. Returns the figures of each
    validation, and the time flown over the CPU time of the flight without its start."""
    folder = root / "out/bench/sphere"
    folder.mkdir(parents=True, exist_ok=True)
    sphere = wavy_sphere(SPHERE_ROWS)
    file = root / "configs/worlds/wall.yaml"

    def settings(name):
        scene = f"scene={{type: open, imports: [{{file: {json.dumps(str(folder / name))}, north: 15, east: 13, altitude: 8}}]}}"
        texts = (scene, CAMERA_PAST, "velocimeter.enabled=false", "start.altitude=8", "goal.altitude=8", "checks=[]")
        return [word for text in texts for word in ("--set", text)]

    imported = {}
    for name, content in (("sphere.glb", glb(*sphere)), ("sphere.obj", obj(*sphere))):
        (folder / name).write_bytes(content)
        imported[name] = measured([hedgehop, "validate", file, *settings(name)])
    fly = lambda seconds: measured([hedgehop, "run", file, *settings("sphere.glb"), "--set", f"duration={seconds}", "--renderer", "tiles",
                                    "--no-video", "--no-report", "--out", folder / "flight"])[1]
    return imported, (FLIGHT_S - 0.1) / (fly(FLIGHT_S) - fly(0.1))


def run(root, hedgehop):
    print(f"{'data set of the city, 640 x 480 px':48} {'images/CPU s':>13} {'wall s':>9} {'CPU s':>9} {'peak MB':>9}")
    _, one_s, _ = dataset(root, hedgehop, 1)
    wall_s, cpu_s, peak_mb = dataset(root, hedgehop, IMAGES)
    print(f"{f'{IMAGES} images and the city':48} {IMAGES / cpu_s:13.1f} {wall_s:9.1f} {cpu_s:9.1f} {peak_mb:9.0f}", flush=True)
    print(f"{'images alone':48} {(IMAGES - 1) / (cpu_s - one_s):13.1f}", flush=True)
    for name, nodes, side_px in (("image of 8192 x 8192 px", 1, SIDE_PX), ("mesh of 10,000 nodes", NODES, 64)):
        wall_s, cpu_s, peak_mb = imported(root, hedgehop, name.replace(" ", "-").replace(",", ""), nodes, side_px)
        print(f"{name:48} {'':>13} {wall_s:9.1f} {cpu_s:9.1f} {peak_mb:9.0f}", flush=True)
    spheres, speed = past_sphere(root, hedgehop)
    for name, (wall_s, cpu_s, peak_mb) in spheres.items():
        print(f"{f'{name} of 1,002,528 triangles: validation':48} {'':>13} {wall_s:9.1f} {cpu_s:9.1f} {peak_mb:9.0f}", flush=True)
    print(f"{'flight 5 m past it, times real time by CPU time':48} {speed:13.1f}", flush=True)
