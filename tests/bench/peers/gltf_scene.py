"""Reads what a path tracer needs of a glTF file: triangles in the world, materials, lights, sky and cameras, in the file's own
axes (+Y up) and in photometric units (cd/m2, lx, cd). The standard library alone, so that any program's Python can use it."""
import base64
import json
import math
import os
import shutil
import struct

COMPONENTS = {5120: 'b', 5121: 'B', 5122: 'h', 5123: 'H', 5125: 'I', 5126: 'f'}
WIDTHS = {'SCALAR': 1, 'VEC2': 2, 'VEC3': 3, 'VEC4': 4, 'MAT4': 16}
SUN_DIAMETER_DEGREES = 0.533  # of a directional light that names none, as in the engine


def multiply(a, b):
    return [[sum(a[i][k] * b[k][j] for k in range(4)) for j in range(4)] for i in range(4)]


def local_matrix(node):
    if 'matrix' in node:
        m = node['matrix']
        return [[m[4 * j + i] for j in range(4)] for i in range(4)]
    x, y, z, w = node.get('rotation', (0, 0, 0, 1))
    s = node.get('scale', (1, 1, 1))
    t = node.get('translation', (0, 0, 0))
    r = [[1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w)],
         [2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w)],
         [2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y)]]
    return [[r[i][j] * s[j] for j in range(3)] + [t[i]] for i in range(3)] + [[0, 0, 0, 1]]


def transform(m, p):
    return tuple(sum(m[i][k] * p[k] for k in range(3)) + m[i][3] for i in range(3))


def normal_matrix(m):
    """Cofactors of the upper left part: what turns normals, but for their length."""
    a = [row[:3] for row in m[:3]]
    def minor(i, j):
        r = [k for k in range(3) if k != i]
        c = [k for k in range(3) if k != j]
        return a[r[0]][c[0]] * a[r[1]][c[1]] - a[r[0]][c[1]] * a[r[1]][c[0]]
    return [[(-1) ** (i + j) * minor(i, j) for j in range(3)] for i in range(3)]


def direction(m, v):
    d = [sum(m[i][k] * v[k] for k in range(3)) for i in range(3)]
    length = math.sqrt(sum(c * c for c in d)) or 1.0
    return tuple(c / length for c in d)


class Gltf:
    """A file as JSON with its buffers."""

    def __init__(self, path):
        self.folder = os.path.dirname(os.path.abspath(path))
        with open(path, 'rb') as file:
            data = file.read()
        binary = b''
        if data[:4] == b'glTF':
            length = struct.unpack('<I', data[12:16])[0]
            self.json = json.loads(data[20:20 + length])
            binary = data[20 + length + 8:]
        else:
            self.json = json.loads(data)
        self.buffers = [self.load(b, binary) for b in self.json.get('buffers', [])]

    def load(self, buffer, binary):
        uri = buffer.get('uri')
        if uri is None:
            return binary
        if uri.startswith('data:'):
            return base64.b64decode(uri.split(',', 1)[1])
        with open(os.path.join(self.folder, uri), 'rb') as file:
            return file.read()

    def accessor(self, index):
        a = self.json['accessors'][index]
        view = self.json['bufferViews'][a['bufferView']]
        width, kind = WIDTHS[a['type']], COMPONENTS[a['componentType']]
        size = struct.calcsize('<' + kind) * width
        stride = view.get('byteStride', size)
        start = view.get('byteOffset', 0) + a.get('byteOffset', 0)
        data = self.buffers[view['buffer']]
        out = [struct.unpack_from('<%d%s' % (width, kind), data, start + i * stride) for i in range(a['count'])]
        return [v[0] for v in out] if width == 1 else out

    def image(self, index):
        """Path of a texture's picture; none for one within a buffer."""
        source = self.json['images'][self.json['textures'][index]['source']]
        uri = source.get('uri', '')
        return os.path.join(self.folder, uri) if uri and not uri.startswith('data:') else None


def material(gltf, m):
    pbr, e = m.get('pbrMetallicRoughness', {}), m.get('extensions', {})
    strength = e.get('KHR_materials_emissive_strength', {}).get('emissiveStrength', 1.0)
    texture = pbr.get('baseColorTexture')
    volume = e.get('KHR_materials_volume', {})
    out = {'name': m.get('name', ''), 'color': pbr.get('baseColorFactor', [1, 1, 1, 1])[:3],
           'texture': gltf.image(texture['index']) if texture else None,
           'roughness': pbr.get('roughnessFactor', 1.0), 'ior': e.get('KHR_materials_ior', {}).get('ior', 1.5),
           'emission': [c * strength for c in m.get('emissiveFactor', [0, 0, 0])]}
    if pbr.get('metallicFactor', 1.0) >= 0.5:
        out['kind'] = 'metal' if out['roughness'] < 0.5 else 'diffuse'
    elif e.get('KHR_materials_transmission', {}).get('transmissionFactor', 0.0) >= 0.5:
        out['kind'] = 'glass' if volume.get('thicknessFactor', 0.0) > 0.0 else 'pane'
        out['attenuation'] = (volume.get('attenuationColor', [1, 1, 1]), volume.get('attenuationDistance', 0.0))
    else:
        out['kind'] = 'diffuse'
    return out


def read(path):
    """{'meshes': [{name, positions, normals, texcoords, triangles, material}], 'materials', 'lights', 'sky', 'cameras'}"""
    gltf = Gltf(path)
    g = gltf.json
    out = {'meshes': [], 'lights': [], 'cameras': [], 'materials': [material(gltf, m) for m in g.get('materials', [])],
           'sky': g.get('extensions', {}).get('ATRIUM_environment', {}).get('skyRadiance', [0, 0, 0])}
    lights = g.get('extensions', {}).get('KHR_lights_punctual', {}).get('lights', [])

    def visit(index, parent):
        node = g['nodes'][index]
        m = multiply(parent, local_matrix(node))
        turn = normal_matrix(m)
        for p in g['meshes'][node['mesh']]['primitives'] if 'mesh' in node else []:
            a = p['attributes']
            positions = [transform(m, v) for v in gltf.accessor(a['POSITION'])]
            indices = gltf.accessor(p['indices']) if 'indices' in p else list(range(len(positions)))
            out['meshes'].append({
                'name': node.get('name', ''), 'positions': positions, 'material': p.get('material'),
                'normals': [direction(turn, n) for n in gltf.accessor(a['NORMAL'])] if 'NORMAL' in a else None,
                'texcoords': gltf.accessor(a['TEXCOORD_0']) if 'TEXCOORD_0' in a else None,
                'triangles': [tuple(indices[i:i + 3]) for i in range(0, len(indices) - 2, 3)]})
        light = node.get('extensions', {}).get('KHR_lights_punctual')
        if light:
            l = lights[light['light']]
            diameter = l.get('extras', {}).get('angularDiameterDegrees', SUN_DIAMETER_DEGREES)
            out['lights'].append({'type': l['type'], 'color': l.get('color', [1, 1, 1]), 'intensity': l.get('intensity', 1.0),
                                  'spot': l.get('spot'), 'diameter_degrees': diameter,
                                  'position': [m[i][3] for i in range(3)],
                                  'direction': direction([r[:3] for r in m[:3]], (0, 0, -1))})
        if 'camera' in node:
            out['cameras'].append({'matrix': m, 'yfov': g['cameras'][node['camera']]['perspective']['yfov']})
        for child in node.get('children', []):
            visit(child, m)

    identity = [[float(i == j) for j in range(4)] for i in range(4)]
    for root in g['scenes'][g.get('scene', 0)]['nodes']:
        visit(root, identity)
    return out


def write(path, changed, name=None, by=(0.0, 0.0, 0.0), metals_on_both_sides=False):
    """Writes the file again: with the node of that name moved in its parent's space, and with metals that mirror on both sides, as
    they do in programs that know no sides. Buffers are taken in, pictures copied beside it: Atrium opens none from elsewhere."""
    gltf = Gltf(path)
    g = gltf.json
    if name is not None:
        node = next(n for n in g['nodes'] if n.get('name') == name)
        if 'matrix' in node:
            raise ValueError(name + ' is placed by a matrix')
        node['translation'] = [a + b for a, b in zip(node.get('translation', (0, 0, 0)), by)]
    for m in g.get('materials', []) if metals_on_both_sides else []:
        if m.get('pbrMetallicRoughness', {}).get('metallicFactor', 1.0) >= 0.5:
            m['doubleSided'] = True
    for buffer, data in zip(g.get('buffers', []), gltf.buffers):
        buffer['uri'] = 'data:application/octet-stream;base64,' + base64.b64encode(data[:buffer['byteLength']]).decode()
    for image in g.get('images', []):
        if 'uri' in image and not image['uri'].startswith('data:'):
            name = os.path.basename(image['uri'])
            shutil.copyfile(os.path.join(gltf.folder, image['uri']), os.path.join(os.path.dirname(os.path.abspath(changed)), name))
            image['uri'] = name
    with open(changed, 'w') as file:
        json.dump(g, file)
