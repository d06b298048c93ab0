"""Renders a glTF file with Cycles, for docs/benchmarks/2026-11-23-peers.md:

    blender -b --factory-startup -noaudio --python cycles.py -- FILE.glb WIDTH HEIGHT SPP SEED DEPTH OUT.exr [CAMERA] [WHITE]

One sample first, so that reading the scene and its BVH are not in the time printed. SPEC0=1: no dielectric reflection,
which the glTF importer of Blender 3.4 gives to every material. LAMBERT=1: Lambert's diffuse and the emission alone, in
place of the importer's Principled BSDF, whose diffuse is Burley's.
"""
import os
import sys
import time

import bpy
import numpy as np
np.bool = bool; np.object = object; np.int = int; np.float = float
a = sys.argv[sys.argv.index("--") + 1:]
scene_file, width, height, spp, seed, depth, out = a[0], int(a[1]), int(a[2]), int(a[3]), int(a[4]), int(a[5]), a[6]
camera = [float(x) for x in a[7].split(",")] if len(a) > 7 and a[7] else None
bpy.ops.wm.read_factory_settings(use_empty=True)
bpy.ops.import_scene.gltf(filepath=scene_file)
s = bpy.context.scene
if os.environ.get("SPEC0"):
    for m in bpy.data.materials:
        if m.use_nodes:
            for n in m.node_tree.nodes:
                if n.type == "BSDF_PRINCIPLED": n.inputs["Specular"].default_value = 0
if os.environ.get("LAMBERT"):
    for m in bpy.data.materials:
        for n in [n for n in m.node_tree.nodes if n.type == "BSDF_PRINCIPLED"] if m.use_nodes else []:
            add, diffuse, emission = (m.node_tree.nodes.new("ShaderNode" + kind) for kind in ("AddShader", "BsdfDiffuse", "Emission"))
            diffuse.inputs["Color"].default_value = n.inputs["Base Color"].default_value
            emission.inputs["Color"].default_value = n.inputs["Emission"].default_value
            emission.inputs["Strength"].default_value = n.inputs["Emission Strength"].default_value
            m.node_tree.links.new(diffuse.outputs[0], add.inputs[0])
            m.node_tree.links.new(emission.outputs[0], add.inputs[1])
            for link in list(n.outputs[0].links): m.node_tree.links.new(add.outputs[0], link.to_socket)
s.render.engine = 'CYCLES'
c = s.cycles
c.device = 'CPU'; c.samples = spp; c.seed = seed; c.use_adaptive_sampling = False; c.use_denoising = False
c.max_bounces = c.diffuse_bounces = c.glossy_bounces = c.transmission_bounces = depth
c.transparent_max_bounces = 8; c.caustics_reflective = c.caustics_refractive = True; c.blur_glossy = 0
c.sample_clamp_direct = c.sample_clamp_indirect = 0
c.pixel_filter_type = 'BOX'; c.filter_width = 1.0
s.render.threads_mode = 'FIXED'; s.render.threads = 2
s.render.resolution_x, s.render.resolution_y, s.render.resolution_percentage = width, height, 100
s.render.image_settings.file_format = 'OPEN_EXR'; s.render.image_settings.color_depth = '32'; s.render.image_settings.exr_codec = 'ZIP'
s.render.image_settings.color_mode = 'RGB'
s.render.use_persistent_data = True
cams = [o for o in bpy.data.objects if o.type == 'CAMERA']
if camera:
    import mathutils, math
    p = mathutils.Vector((camera[0], -camera[2], camera[1])); t = mathutils.Vector((camera[3], -camera[5], camera[4]))
    data = bpy.data.cameras.new('c'); data.sensor_fit = 'VERTICAL'; data.angle = math.radians(camera[6]); data.clip_start = 1e-3; data.clip_end = 1e5
    o = bpy.data.objects.new('c', data); s.collection.objects.link(o)
    o.location = p; o.rotation_euler = (t - p).to_track_quat('-Z', 'Y').to_euler(); s.camera = o
else:
    s.camera = cams[0]
if len(a) > 8 and a[8]:
    w = bpy.data.worlds.new('w'); s.world = w; w.use_nodes = True
    v = float(a[8]); w.node_tree.nodes['Background'].inputs[0].default_value = (v, v, v, 1); w.node_tree.nodes['Background'].inputs[1].default_value = 1
s.render.filepath = out
c.samples = 1
s.render.filepath = out + '.warm.exr'
bpy.ops.render.render(write_still=True)   # warm-up: sync, BVH
c.samples = spp
s.render.filepath = out
t0 = time.time(); bpy.ops.render.render(write_still=True); t1 = time.time()
print(f"CYCLES {scene_file} {width}x{height} spp {spp} seed {seed}: {t1 - t0:.3f} s, {width*height*spp/(t1-t0)/1e6:.3f} Msamples/s")
