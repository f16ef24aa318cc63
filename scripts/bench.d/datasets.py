"""Images per second of `hedgehop dataset` on one core, and the memory of meshes with large images or many nodes.

A data set has 640 x 480 px in all channels: color, depth, optic flow, classes and instances of the city, noise-free. Its CPU
time contains the construction of the city; that of the images alone is the difference between many images and one.
"""

import json
import shutil
import struct
import zlib

from logs import measured

IMAGES = 200
CAMERA = "rig.cameras.0={role: front, width: 640, height: 480, fov: 75, rate: 10, channel: color}"
SIDE_PX, NODES = 8192, 10_000


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


def run(root, hedgehop):
    print(f"{'data set of the city, 640 x 480 px':48} {'images/CPU s':>13} {'wall s':>9} {'CPU s':>9} {'peak MB':>9}")
    _, one_s, _ = dataset(root, hedgehop, 1)
    wall_s, cpu_s, peak_mb = dataset(root, hedgehop, IMAGES)
    print(f"{f'{IMAGES} images and the city':48} {IMAGES / cpu_s:13.1f} {wall_s:9.1f} {cpu_s:9.1f} {peak_mb:9.0f}", flush=True)
    print(f"{'images alone':48} {(IMAGES - 1) / (cpu_s - one_s):13.1f}", flush=True)
    for name, nodes, side_px in (("image of 8192 x 8192 px", 1, SIDE_PX), ("mesh of 10,000 nodes", NODES, 64)):
        wall_s, cpu_s, peak_mb = imported(root, hedgehop, name.replace(" ", "-").replace(",", ""), nodes, side_px)
        print(f"{name:48} {'':>13} {wall_s:9.1f} {cpu_s:9.1f} {peak_mb:9.0f}", flush=True)
