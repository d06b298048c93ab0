"""Writes one scene for POV-Ray and for raylab, for docs/benchmarks/2026-11-23-peers.md: povray.py FOLDER makes spheres.pov and spheres.gltf.

A thousand spheres that mirror .3, over a floor, under two point lights whose light does not fall with distance. POV-Ray's diffuse
surface of pigment p sends p (n.l) for a light of 1, raylab's p (n.l) E/pi: intensities are pi times POV-Ray's.
"""
import base64
import json
import math
import struct
import sys
from pathlib import Path

folder = Path(sys.argv[1])
spheres = [(2.5 * (i - 4.5), 1 + 2.5 * j, -2.5 * k) for i in range(10) for j in range(10) for k in range(10)]
eye, target, vertical, aspect = (6, 14, 18), (0, 10, -10), math.radians(50), 1280 / 720
lights, light = [(20, 40, 20), (-30, 30, 10)], 0.5
corners, indices = [(-60, 0, 60), (60, 0, 60), (60, 0, -60), (-60, 0, -60)], [0, 1, 2, 0, 2, 3]

horizontal = 2 * math.degrees(math.atan(math.tan(vertical / 2) * aspect))
vector = lambda v: "<" + ",".join(f"{x:g}" for x in v) + ">"
pov = ["#version 3.7;", "global_settings { assumed_gamma 1 max_trace_level 6 adc_bailout 0.001 ambient_light 0 }", "background { rgb 0 }",
       f"camera {{ perspective location {vector(eye)} right -x*image_width/image_height up y angle {horizontal:.9f} look_at {vector(target)} }}",
       "#declare Ball = texture { pigment { rgb <.6,.5,.4> } finish { ambient 0 diffuse 1 reflection .3 } }",
       "#declare Floor = texture { pigment { rgb .5 } finish { ambient 0 diffuse 1 } }"]
pov += [f"light_source {{ {vector(at)} rgb {light} }}" for at in lights]
pov += ["mesh { " + " ".join("triangle { " + ",".join(vector(corners[i]) for i in indices[n:n + 3]) + " }" for n in (0, 3)) + " texture { Floor } }"]
pov += [f"sphere {{ {vector(at)}, 1 texture {{ Ball }} }}" for at in spheres]
(folder / "spheres.pov").write_text("\n".join(pov) + "\n")

cross = lambda a, b: [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
unit = lambda v: [x / math.hypot(*v) for x in v]
back = unit([e - t for e, t in zip(eye, target)])
right = unit(cross([0, 1, 0], back))
camera = [*right, 0, *cross(back, right), 0, *back, 0, *eye, 1]
phong = lambda diffuse, mirror: {"extras": {"raylab": {"phong": {"diffuse": diffuse, "mirror": [1, 1, 1] if mirror else [0, 0, 0], "reflection": mirror}}}}
data = b"".join(struct.pack("<3f", *p) for p in corners) + struct.pack("<6I", *indices)
nodes = [{"mesh": 0}, {"camera": 0, "matrix": camera}]
nodes += [{"translation": at, "extensions": {"KHR_lights_punctual": {"light": 0}}} for at in lights]
nodes += [{"translation": at, "extras": {"raylab": {"quadrics": 0}}} for at in spheres]
(folder / "spheres.gltf").write_text(json.dumps({
    "asset": {"version": "2.0"}, "extensionsUsed": ["KHR_lights_punctual"],
    "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": math.pi * light}]}},
    "scene": 0, "scenes": [{"nodes": list(range(len(nodes)))}], "nodes": nodes,
    "cameras": [{"type": "perspective", "perspective": {"yfov": vertical, "znear": 0.01, "aspectRatio": aspect}}],
    "materials": [{"name": "floor", **phong([0.5, 0.5, 0.5], 0)}, {"name": "ball", **phong([0.6, 0.5, 0.4], 0.3)}],
    "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
    "extras": {"raylab": {"quadrics": [{"name": "ball", "material": 1, "surfaces": [{"kind": "sphere", "radius": 1}]}]}},
    "buffers": [{"byteLength": len(data), "uri": "data:application/octet-stream;base64," + base64.b64encode(data).decode()}],
    "bufferViews": [{"buffer": 0, "byteLength": 48}, {"buffer": 0, "byteOffset": 48, "byteLength": 24}],
    "accessors": [{"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3", "min": [-60, 0, -60], "max": [60, 0, 60]},
                  {"bufferView": 1, "componentType": 5125, "count": 6, "type": "SCALAR"}]}))
