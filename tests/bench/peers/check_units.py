#!/usr/bin/env python3
"""Proves the units of cycles_scene.py: a matt plate of reflectance 0.5 under a sun of 1,000 lx, a point light of 100 cd two metres
above it, and a sky of 10 cd/m2, drawn with Cycles and compared with what theory says. Exit status 1 where they differ by more than
a hundredth; 77 without Blender."""
import base64
import json
import math
import os
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile

import errors

HERE = pathlib.Path(__file__).resolve().parent
DOWN = [-math.sqrt(0.5), 0, 0, math.sqrt(0.5)]


def plate(light):
    corners = [(-1, 0, -1), (1, 0, -1), (1, 0, 1), (-1, 0, 1)]
    data = b''.join(struct.pack('<3f', *p) for p in corners) + struct.pack('<3f', 0, 1, 0) * 4 + struct.pack('<6H', 0, 2, 1, 0, 3, 2)
    g = {'asset': {'version': '2.0'}, 'scenes': [{'nodes': [0, 1]}],
         'buffers': [{'byteLength': len(data), 'uri': 'data:application/octet-stream;base64,' + base64.b64encode(data).decode()}],
         'bufferViews': [{'buffer': 0, 'byteOffset': o, 'byteLength': n} for o, n in ((0, 48), (48, 48), (96, 12))],
         'accessors': [{'bufferView': 0, 'componentType': 5126, 'count': 4, 'type': 'VEC3'},
                       {'bufferView': 1, 'componentType': 5126, 'count': 4, 'type': 'VEC3'},
                       {'bufferView': 2, 'componentType': 5123, 'count': 6, 'type': 'SCALAR'}],
         'materials': [{'pbrMetallicRoughness': {'metallicFactor': 0, 'baseColorFactor': [0.5, 0.5, 0.5, 1]}}],
         'meshes': [{'primitives': [{'attributes': {'POSITION': 0, 'NORMAL': 1}, 'indices': 2, 'material': 0}]}],
         'cameras': [{'type': 'perspective', 'perspective': {'yfov': 0.1, 'znear': 0.01}}],
         'nodes': [{'mesh': 0}, {'camera': 0, 'translation': [0, 1, 0], 'rotation': DOWN}]}
    if light is None:
        g['extensions'] = {'ATRIUM_environment': {'skyRadiance': [10, 10, 10]}}
    else:
        g['extensions'] = {'KHR_lights_punctual': {'lights': [light]}}
        g['nodes'].append({'translation': [0, 2, 0], 'rotation': DOWN, 'extensions': {'KHR_lights_punctual': {'light': 0}}})
        g['scenes'][0]['nodes'].append(2)
    return g


def main():
    if not shutil.which('blender'):
        print('Blender is not installed.')
        return 77
    wrong = 0
    for name, light, truth in (('sun', {'type': 'directional', 'intensity': 1000.0}, 1000.0 * 0.5 / math.pi),
                               ('point', {'type': 'point', 'intensity': 100.0}, 25.0 * 0.5 / math.pi), ('sky', None, 5.0)):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder)
            (path / 'plate.gltf').write_text(json.dumps(plate(light)))
            job = {'scene': str(path / 'plate.gltf'), 'camera': 0, 'width': 16, 'height': 16, 'threads': 1, 'seed': 1, 'mean': 1.0,
                   'mode': 'unbiased', 'denoise': False, 'runs': [{'samples': 256, 'out': str(path / 'plate.exr')}]}
            (path / 'job.json').write_text(json.dumps(job))
            subprocess.run(['blender', '-b', '--factory-startup', '-noaudio', '--python', HERE / 'cycles_scene.py', '--', path / 'job.json'],
                           check=True, stdout=subprocess.DEVNULL, env={**os.environ, 'PATH': '/usr/bin:/bin:' + os.environ['PATH']})
            got = errors.luminance(path / 'plate.exr').mean()
        print(f'{name}: {got:.4f} cd/m2, {truth:.4f} by theory')
        wrong += abs(got - truth) > 0.01 * truth
    return 1 if wrong else 0


if __name__ == '__main__':
    sys.exit(main())
