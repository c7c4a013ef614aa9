"""Draws a glTF scene with Blender's Cycles at a ladder of samples. Run by compare.py inside Blender:

    blender -b --factory-startup -noaudio --python cycles_scene.py -- JOB.json

JOB: {"scene", "camera", "width", "height", "threads", "seed", "mean", "mode", "runs": [{"samples", "out"}], "denoise"}. Prints a
line "RESULT {json}" for each picture; processor seconds are those of the call that renders, Blender's own start left out.

Units: radiance in Cycles is cd/m2 one to one, so a sun has its lux as strength and a point light its candela times 4 pi
(tests/bench/peers/check_units.py proves it). The view transform must not touch an .exr: Standard, no look, no dither.

Modes:
  unbiased  no clamping, no blurred glossy paths, 24 bounces, fixed samples
  shipped   as a new Blender file has it: indirect light clamped at 10 for a picture of mean 0.4, filter glossy 1, 12 bounces (4 of
            them diffuse or glossy), adaptive sampling with a threshold of 0.01
  manifold  unbiased with manifold next-event estimation ("shadow caustics") of lamps over metals and glass
"""
import json
import math
import os
import resource
import sys

import bpy
from mathutils import Matrix, Vector

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import gltf_scene  # noqa: E402

MIRROR_BELOW = 0.04  # roughness, as in the engine
UNSEEN = 1e-3        # radius of a point light, metres


def nodes_of(name):
    m = bpy.data.materials.new(name)
    m.use_nodes = True
    m.node_tree.nodes.clear()
    return m, m.node_tree, m.node_tree.nodes.new('ShaderNodeOutputMaterial')


def rgb(c):
    return (c[0], c[1], c[2], 1.0)


def lobe(tree, kind, m):
    b = tree.nodes.new(kind)
    smooth = m['roughness'] < MIRROR_BELOW
    b.distribution = 'SHARP' if smooth else 'GGX'
    b.inputs['Roughness'].default_value = 0.0 if smooth else m['roughness']
    b.inputs['Color'].default_value = rgb(m['color'])
    return b


def pane(tree, m):
    """A thin sheet: both of its faces mirror 2 F / (1 + F), the rest goes straight on."""
    fresnel = tree.nodes.new('ShaderNodeFresnel')
    fresnel.inputs['IOR'].default_value = m['ior']
    def math_node(operation, a, b):
        n = tree.nodes.new('ShaderNodeMath')
        n.operation = operation
        for socket, value in zip(n.inputs, (a, b)):
            if isinstance(value, float):
                socket.default_value = value
            else:
                tree.links.new(value, socket)
        return n.outputs[0]
    f = fresnel.outputs[0]
    share = math_node('DIVIDE', math_node('MULTIPLY', f, 2.0), math_node('ADD', f, 1.0))
    through = tree.nodes.new('ShaderNodeBsdfTransparent')
    through.inputs['Color'].default_value = rgb(m['color'])
    back = tree.nodes.new('ShaderNodeBsdfGlossy')
    back.distribution = 'SHARP'
    back.inputs['Color'].default_value = (1, 1, 1, 1)
    mix = tree.nodes.new('ShaderNodeMixShader')
    tree.links.new(share, mix.inputs[0])
    tree.links.new(through.outputs[0], mix.inputs[1])
    tree.links.new(back.outputs[0], mix.inputs[2])
    return mix


def absorb(tree, end, color, distance):
    """A solid that lets `color` through along `distance` metres: Cycles takes density * (1 - color) a metre."""
    if distance <= 0.0 or min(color) >= 1.0:
        return
    per_metre = [-math.log(max(c, 1e-4)) / distance for c in color]
    volume = tree.nodes.new('ShaderNodeVolumeAbsorption')
    volume.inputs['Density'].default_value = max(per_metre)
    volume.inputs['Color'].default_value = rgb([1.0 - a / max(per_metre) for a in per_metre])
    tree.links.new(volume.outputs[0], end.inputs['Volume'])


def make_material(m):
    out, tree, end = nodes_of(m['name'])
    if m['kind'] == 'metal':
        shader = lobe(tree, 'ShaderNodeBsdfGlossy', m)
    elif m['kind'] == 'glass':
        shader = lobe(tree, 'ShaderNodeBsdfGlass', m)
        shader.inputs['IOR'].default_value = m['ior']
        absorb(tree, end, *m['attenuation'])
    elif m['kind'] == 'pane':
        shader = pane(tree, m)
    else:
        shader = tree.nodes.new('ShaderNodeBsdfDiffuse')
        shader.inputs['Roughness'].default_value = 0.0
        shader.inputs['Color'].default_value = rgb(m['color'])
        if m['texture']:
            picture = tree.nodes.new('ShaderNodeTexImage')
            picture.image = bpy.data.images.load(m['texture'])
            tree.links.new(picture.outputs['Color'], shader.inputs['Color'])
    top = max(m['emission'])
    if top > 0.0:
        shine = tree.nodes.new('ShaderNodeEmission')
        shine.inputs['Color'].default_value = rgb([c / top for c in m['emission']])
        shine.inputs['Strength'].default_value = top
        both = tree.nodes.new('ShaderNodeAddShader')
        tree.links.new(shader.outputs[0], both.inputs[0])
        tree.links.new(shine.outputs[0], both.inputs[1])
        shader = both
    tree.links.new(shader.outputs[0], end.inputs['Surface'])
    return out


def make_mesh(mesh, material):
    data = bpy.data.meshes.new(mesh['name'])
    data.from_pydata(mesh['positions'], [], mesh['triangles'])
    if material is not None:
        data.materials.append(material)
    if mesh['texcoords']:
        layer = data.uv_layers.new()
        for loop in data.loops:
            u, v = mesh['texcoords'][loop.vertex_index]
            layer.data[loop.index].uv = (u, 1.0 - v)
    data.update()
    if mesh['normals']:
        for polygon in data.polygons:
            polygon.use_smooth = True
        data.use_auto_smooth = True
        data.normals_split_custom_set_from_vertices(mesh['normals'])
    thing = bpy.data.objects.new(mesh['name'], data)
    bpy.context.scene.collection.objects.link(thing)
    return thing


def make_light(l):
    if l['type'] == 'directional':
        lamp = bpy.data.lights.new('sun', 'SUN')
        lamp.energy = l['intensity']
        lamp.angle = math.radians(l['diameter_degrees'])
    elif l['type'] == 'point':
        lamp = bpy.data.lights.new('point', 'POINT')
        lamp.energy = l['intensity'] * 4.0 * math.pi
        lamp.shadow_soft_size = UNSEEN
    else:
        raise SystemExit('spot lights are not exported: their fall-off differs')
    lamp.color = l['color']
    thing = bpy.data.objects.new('light', lamp)
    bpy.context.scene.collection.objects.link(thing)
    thing.location = l['position']
    thing.rotation_mode = 'QUATERNION'
    thing.rotation_quaternion = Vector(l['direction']).to_track_quat('-Z', 'Y')
    return thing


def settings(job):
    scene = bpy.context.scene
    scene.render.engine = 'CYCLES'
    r, c = scene.render, scene.cycles
    r.resolution_x, r.resolution_y, r.resolution_percentage = job['width'], job['height'], 100
    r.threads_mode, r.threads = 'FIXED', job['threads']
    r.image_settings.file_format, r.image_settings.color_depth, r.image_settings.color_mode = 'OPEN_EXR', '32', 'RGB'
    scene.view_settings.view_transform, scene.view_settings.look = 'Standard', 'None'
    scene.view_settings.exposure, scene.view_settings.gamma = 0.0, 1.0
    r.use_compositing = r.use_sequencer = False
    r.dither_intensity = 0.0
    r.use_file_extension = False
    c.device, c.seed = 'CPU', job['seed']
    c.pixel_filter_type, c.filter_width, c.film_exposure = 'BOX', 1.0, 1.0
    c.use_denoising = bool(job['denoise'])
    shipped = job['mode'] == 'shipped'
    c.use_adaptive_sampling, c.adaptive_threshold = shipped, 0.01
    c.max_bounces = 12 if shipped else 24
    c.diffuse_bounces = c.glossy_bounces = 4 if shipped else 24
    c.transmission_bounces = 12 if shipped else 24
    c.transparent_max_bounces = 8 if shipped else 32
    c.caustics_reflective = c.caustics_refractive = True
    c.blur_glossy = 1.0 if shipped else 0.0
    c.sample_clamp_direct = 0.0
    c.sample_clamp_indirect = 10.0 * job['mean'] / 0.4 if shipped else 0.0
    c.light_sampling_threshold = 0.01 if shipped else 0.0


def make_sky(sky):
    world = bpy.data.worlds.new('sky')
    bpy.context.scene.world = world
    world.use_nodes = True
    top = max(sky)
    background = world.node_tree.nodes['Background'].inputs
    background['Strength'].default_value = top
    background['Color'].default_value = rgb([c / top for c in sky]) if top > 0.0 else (0, 0, 0, 1)


def make_camera(camera, job):
    lens = bpy.data.cameras.new('camera')
    lens.sensor_fit = 'VERTICAL'
    lens.angle_y = camera['yfov']
    lens.clip_start = 1e-3
    thing = bpy.data.objects.new('camera', lens)
    bpy.context.scene.collection.objects.link(thing)
    m = camera['matrix']
    columns = [Vector([m[i][j] for i in range(3)]).normalized() for j in range(3)]
    turn = Matrix(columns).transposed().to_4x4()
    turn.translation = Vector([m[i][3] for i in range(3)])
    thing.matrix_world = turn
    bpy.context.scene.camera = thing


def build(job):
    bpy.ops.wm.read_factory_settings(use_empty=True)
    scene = gltf_scene.read(job['scene'])
    settings(job)
    make_sky(scene['sky'])
    materials = [make_material(m) for m in scene['materials']]
    manifold = job['mode'] == 'manifold'
    for mesh in scene['meshes']:
        index = mesh['material']
        thing = make_mesh(mesh, materials[index] if index is not None else None)
        if manifold and index is not None and scene['materials'][index]['kind'] in ('metal', 'glass'):
            thing.cycles.is_caustics_caster = True
        elif manifold:
            thing.cycles.is_caustics_receiver = True
        if manifold and index is not None and max(scene['materials'][index]['emission']) > 0.0:
            replace_by_area_lamp(thing, mesh, scene['materials'][index])
    for l in scene['lights']:
        thing = make_light(l)
        thing.data.cycles.is_caustics_light = manifold
    make_camera(scene['cameras'][job['camera']], job)


def replace_by_area_lamp(thing, mesh, material):
    """Manifold next-event estimation works with lamps, not with meshes that shine: a square becomes an area lamp."""
    corners = [Vector(p) for p in dict.fromkeys(mesh['positions'])]
    if len(corners) != 4:
        return
    middle = sum(corners, Vector((0, 0, 0))) / 4.0
    a = max(corners[1:], key=lambda c: (c - corners[0]).length)
    u, v = [c - corners[0] for c in corners[1:] if c is not a]
    if abs(u.length - v.length) > 1e-3 * u.length:
        return
    top = max(material['emission'])
    lamp = bpy.data.lights.new('area', 'AREA')
    lamp.shape, lamp.size = 'SQUARE', u.length
    lamp.color = [c / top for c in material['emission']]
    lamp.energy = 4.0 * top * u.length ** 2  # radiance of Blender's area lamps: strength / (4 area)
    lamp.cycles.is_caustics_light = True
    square = bpy.data.objects.new('area', lamp)
    bpy.context.scene.collection.objects.link(square)
    z = -Vector(mesh['normals'][0])
    x = u.normalized()
    turn = Matrix((x, z.cross(x), z)).transposed().to_4x4()
    turn.translation = middle
    square.matrix_world = turn
    bpy.data.objects.remove(thing)


def processor_seconds():
    used = resource.getrusage(resource.RUSAGE_SELF)
    return used.ru_utime + used.ru_stime


def draw(samples, out):
    import time
    scene = bpy.context.scene
    scene.cycles.samples = samples
    scene.render.filepath = out
    cpu, wall = processor_seconds(), time.perf_counter()
    bpy.ops.render.render(write_still=True)
    return {'cpu': processor_seconds() - cpu, 'wall': time.perf_counter() - wall}


def can_denoise():
    import _cycles
    return bool(getattr(_cycles, 'with_openimagedenoise', False))


def main():
    with open(sys.argv[sys.argv.index('--') + 1]) as file:
        job = json.load(file)
    print('RESULT ' + json.dumps({'version': bpy.app.version_string, 'can_denoise': can_denoise()}))
    if job['denoise'] and not can_denoise():
        return
    cpu = processor_seconds()
    build(job)
    print('RESULT ' + json.dumps({'build_cpu': processor_seconds() - cpu}))
    for run in job['runs']:
        print('RESULT ' + json.dumps({'samples': run['samples'], 'out': run['out'], **draw(run['samples'], run['out'])}), flush=True)


if __name__ == '__main__':
    main()
