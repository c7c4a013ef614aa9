#!/usr/bin/env python3
"""Atrium against Blender's Cycles on the same scenes, from nothing and after one object has moved: error of diffuse pixels against
processor seconds.

usage: compare.py [--build build/release] [--work FOLDER] [--shared ../shared/peers] [--scenes A,B] [--samples 4,16,64] ...

Needs python3-numpy and python3-openimageio, and Blender for its side (Debian: blender); without Blender it says so and measures
Atrium alone. Everything made is kept in the work folder and not made again: remove a scene's folder there to measure it anew.
Writes results.csv, a picture NAME_STATE.svg of each table of curves, and tables as Markdown to the standard output.

What is compared: processor seconds (user + system, all threads) of what each program does between a scene in memory and a picture
on disk; starting the program and reading the file are left out on both sides. Errors: see errors.py. The truth of scenes in
--shared is what lies there, of all others two halves of `atrium-cli reference`. The move ends where the scene has the object, so
that both states have the same truth: Atrium starts with complete light of the object elsewhere and follows it back, Cycles starts
from nothing and has the same rows in both states.
"""
import argparse
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
sys.path.insert(0, str(HERE))

import gltf_scene  # noqa: E402
import plot  # noqa: E402

LEVELS = (0.20, 0.10, 0.05, 0.02)
COLUMNS = ('scene', 'state', 'program', 'setting', 'light', 'cpu', 'wall', 'relative', 'trimmed', 'smooth', 'bias')
# Scenes of our own: what moves, by how much (metres, in its parent's space), and how far Cycles is driven besides 'unbiased'.
OWN = {
    'sun-mirror': ('scenes/sun-mirror/sun-mirror.glb', 'Mirror', (0.25, 0.0, 0.0), ()),
    'glass-ball': ('scenes/glass-ball/glass-ball.glb', 'Ball', (0.06, 0.0, 0.0), ('manifold',)),
    'sunlit_room': ('scenes/sunlit_room/sunlit_room.gltf', 'Chair south', (0.36, 0.0, 0.24), ()),
}
SHARED_MODES = {'cornell-mirror': ('shipped',), 'ring': ('shipped', 'manifold')}


class Scene:
    def __init__(self, name, a):
        self.name, self.folder = name, a.work / name
        self.folder.mkdir(parents=True, exist_ok=True)
        self.shared = None
        if name in OWN:
            file, self.node, self.by, self.modes = OWN[name]
            self.file = ROOT / file
        else:
            self.shared, self.file = a.shared, a.shared / 'scenes' / (name + '.gltf')
            facts = json.loads((a.shared / 'scenes' / name / 'scene.json').read_text())['movable']
            x, y, z = facts['delta']
            self.node, self.by, self.modes = facts['name'], (x, z, -y), SHARED_MODES.get(name, ())
        # The neutral scenes know no sides of surfaces: every program but ours mirrors on both.
        self.base, self.away = self.folder / 'base.gltf', self.folder / 'away.gltf'
        both = self.shared is not None
        gltf_scene.write(self.file, self.base, metals_on_both_sides=both)
        gltf_scene.write(self.file, self.away, self.node, self.by, both)


def run(command, log, **more):
    with open(log, 'a') as out:
        out.write('$ ' + ' '.join(str(c) for c in command) + '\n')
        done = subprocess.run([str(c) for c in command], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, **more)
        out.write(done.stdout)
    if done.returncode != 0:
        raise SystemExit(f'{command[0]} failed, see {log}:\n{done.stdout[-2000:]}')
    return done.stdout


def truth(scene, a):
    import errors
    if scene.shared:
        path = lambda suffix: scene.shared / 'ref' / f'{scene.name}{suffix}.exr'
        mask = errors.read(scene.shared / 'ref' / f'mask_{scene.name}.png')[:, :, 0] > 0.5
        half1, half2, mean = (errors.luminance(path(s)) for s in ('_half1', '_half2', ''))
        return errors.Reference(mean, half1, half2, mask)
    halves = []
    for seed in (101, 102):
        out = scene.folder / f'truth_{a.truth:g}s_{seed}.exr'
        if not out.exists():
            run([a.build / 'atrium-cli', 'reference', scene.base, '--camera', '', '-o', out, '--size', f'{a.width}x{a.height}',
                 '--time', a.truth, '--seed', seed, '--threads', a.threads], scene.folder / 'log.txt')
        halves.append(errors.luminance(out))
    mask = scene.folder / 'parts.exr'
    if not mask.exists():
        run([a.build / 'atrium-cli', 'render', scene.base, '--quality', 'draft', '--channels', '--samples', 16, '--size',
             f'{a.width}x{a.height}', '-o', mask], scene.folder / 'log.txt')
    return errors.Reference(0.5 * (halves[0] + halves[1]), *halves, errors.diffuse_mask(mask))


def ours(scene, a):
    """Rows of (state, setting, processor seconds of the light, those with the picture, wall, picture)."""
    for state, file, more in (('cold', scene.base, ()),
                              ('moved', scene.away, ('--node', scene.node, '--by', *(f'{-c:.9g}' for c in scene.by)))):
        table = scene.folder / f'atrium_{state}.csv'
        if not table.exists():
            folder = scene.folder / state
            folder.mkdir(exist_ok=True)
            made = run([a.build / 'tests/peer_bench', file, folder, *more, '--qualities', a.qualities, '--width', a.width, '--height',
                        a.height, '--threads', a.threads], scene.folder / 'log.txt')
            table.write_text(made[made.index('quality,'):])
        before = 0.0
        for row in csv.DictReader(table.read_text().splitlines()):
            light, picture, stage = float(row['cpu']), float(row['still_cpu']), row['stage']
            if state == 'moved' and stage == 'first':
                continue
            if stage == 'hurried':
                before = light
            if stage == 'settled':  # comes after the hurried answer
                light += before
            if state == 'moved' and stage == 'solved':  # what the update has to mend: no time, for nothing was done
                light, picture, stage = 0.0, 0.0, 'had nothing moved'
            yield state, f"{row['quality']}, {stage}", light, light + picture, float(row['wall']), row['file']


def cycles(scene, mode, mean, a):
    """Rows of (setting, cpu, wall, picture)."""
    rows, job = [], scene.folder / f'cycles_{mode}.json'
    kept = job.with_suffix('.txt')
    wanted = [{'samples': n, 'out': str(scene.folder / f'cycles_{mode}_{n}.exr')} for n in a.samples if mode == 'unbiased' or n <= a.most_other]
    have = {}
    if kept.exists():
        for line in kept.read_text().splitlines():
            have[json.loads(line)['samples']] = json.loads(line)
    missing = [w for w in wanted if w['samples'] not in have]
    if missing:
        job.write_text(json.dumps({'scene': str(scene.base.resolve()), 'camera': 0, 'width': a.width, 'height': a.height,
                                   'threads': a.threads, 'seed': 1, 'mean': mean, 'mode': mode, 'denoise': mode == 'denoised',
                                   'runs': missing}))
        said = run(['blender', '-b', '--factory-startup', '-noaudio', '--python', HERE / 'cycles_scene.py', '--', job],
                   scene.folder / 'log.txt', env={**os.environ, 'PATH': '/usr/bin:/bin:' + os.environ.get('PATH', '')})
        for line in said.splitlines():
            if line.startswith('RESULT ') and 'samples' in json.loads(line[7:]):
                one = json.loads(line[7:])
                have[one['samples']] = one
                with open(kept, 'a') as out:
                    out.write(json.dumps(one) + '\n')
    for w in wanted:
        one = have.get(w['samples'])
        if one:
            rows.append((f"{w['samples']} samples", one['cpu'], one['wall'], one['out']))
    return rows


def time_to(rows, level, measure, by_chance):
    """Least processor seconds to an error; (seconds, 'measured' or 'extrapolated'), or None. Chance alone falls as one over the
    root of the time, which is how far an unbiased picture may be carried on."""
    reached = [r['cpu'] for r in rows if r[measure] <= level]
    if by_chance and rows:
        last = max(rows, key=lambda r: r['cpu'])
        needed = last['cpu'] * (last[measure] / level) ** 2
        return (needed, 'extrapolated') if not reached else (min(min(reached), max(needed, min(r['cpu'] for r in rows))), 'measured')
    return (min(reached), 'measured') if reached else None


def measure_scene(scene, a, blender):
    import errors
    rows = []
    reference = truth(scene, a)
    print(f'{scene.name}: {int(reference.mask.sum())} diffuse pixels, the reference is itself {100 * reference.own_error():.1f} % off '
          'a pixel', file=sys.stderr)

    def add(state, program, setting, light, cpu, wall, picture):
        rows.append({'scene': scene.name, 'state': state, 'program': program, 'setting': setting, 'light': light, 'cpu': cpu, 'wall': wall,
                     **reference.errors(errors.luminance(picture))})

    for state, setting, light, cpu, wall, picture in ours(scene, a):
        add(state, 'Atrium', setting, light, cpu, wall, picture)
    for mode in ('unbiased',) + scene.modes if blender else ():
        for setting, cpu, wall, picture in cycles(scene, mode, float(reference.mean.mean()), a):
            add('cold', f'Cycles, {mode}', setting, cpu, cpu, wall, picture)
    return rows


def table(rows):
    out = ['| scene | state | program | setting | CPU s | of it light | error % | without worst 1 % | after 9 x 9 | bias % |', '|---' * 10 + '|']
    for r in rows:
        numbers = ' | '.join(f'{100 * r[k]:.1f}' for k in ('relative', 'trimmed', 'smooth', 'bias'))
        out.append(f"| {r['scene']} | {r['state']} | {r['program']} | {r['setting']} | {r['cpu']:.2f} | {r['light']:.3f} | {numbers} |")
    return '\n'.join(out)


def seconds(t):
    return f'{t:.2f}' if t < 10.0 else f'{t:,.0f}'


def rows_of(rows, scene, state):
    """What was done in a state; other programs start from nothing in either."""
    return [r for r in rows if r['scene'] == scene and (r['state'] == state or r['program'] != 'Atrium') and r['cpu'] > 0.0]


def summary(rows):
    """Time to each level, ours beside the best of Cycles' modes; '*' = extrapolated, '-' = not reached."""
    out = ['| scene | state | measure | program | ' + ' | '.join(f'{100 * l:.0f} %' for l in LEVELS) + ' |',
           '|---' * (4 + len(LEVELS)) + '|']
    for scene, state in dict.fromkeys((r['scene'], r['state']) for r in rows):
        here = rows_of(rows, scene, state)
        for measure in ('relative', 'trimmed', 'smooth'):
            for program in dict.fromkeys(r['program'] for r in here):
                own = [r for r in here if r['program'] == program]
                cells = []
                for level in LEVELS:
                    t = time_to(own, level, measure, program == 'Cycles, unbiased')
                    cells.append('-' if t is None else seconds(t[0]) + ('*' if t[1] == 'extrapolated' else ''))
                out.append(f"| {scene} | {state} | {measure} | {program} | " + ' | '.join(cells) + ' |')
    return '\n'.join(out)


def curves(rows, a):
    for scene, state in dict.fromkeys((r['scene'], r['state']) for r in rows):
        series = {}
        for r in rows_of(rows, scene, state):
            stage = ', ' + r['setting'].split(', ')[1] if r['program'] == 'Atrium' else ''
            series.setdefault(r['program'] + stage, []).append((r['cpu'], r['relative']))
            if r['program'] == 'Cycles, unbiased':
                series.setdefault(r['program'] + ', 9 x 9', []).append((r['cpu'], r['smooth']))
        plot.log_log(a.work / f'{scene}_{state}.svg', f'{scene}, {"from nothing" if state == "cold" else "after the move"}',
                     'processor seconds', 'relative error of diffuse pixels', series)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument('--build', type=pathlib.Path, default=ROOT / 'build/release')
    parser.add_argument('--work', type=pathlib.Path, default=pathlib.Path('peers_work'))
    parser.add_argument('--shared', type=pathlib.Path, default=ROOT.parent / 'shared/peers')
    parser.add_argument('--scenes', default='cornell-mirror,ring,sun-mirror,glass-ball')
    parser.add_argument('--samples', default='4,16,64,256', help='a pixel, of Cycles')
    parser.add_argument('--most-other', type=int, default=64, help='the most samples of other modes than unbiased')
    parser.add_argument('--qualities', default='draft,normal,fine', help='of Atrium')
    parser.add_argument('--threads', type=int, default=2)
    parser.add_argument('--truth', type=float, default=120.0, help='seconds for each half of a reference')
    parser.add_argument('--width', type=int, default=640)
    parser.add_argument('--height', type=int, default=360)
    a = parser.parse_args()
    a.samples = [int(n) for n in a.samples.split(',')]
    for module, package in (('numpy', 'python3-numpy'), ('OpenImageIO', 'python3-openimageio')):
        try:
            __import__(module)
        except ImportError:
            raise SystemExit(f'Python has no {module}: install {package} and run this with the Python that it belongs to.')
    blender = shutil.which('blender')
    if not blender:
        print('Blender is not installed: Cycles is left out (Debian: apt-get install --no-install-recommends blender).',
              file=sys.stderr)
    rows = []
    for name in a.scenes.split(','):
        if name not in OWN and not (a.shared / 'scenes' / (name + '.gltf')).exists():
            print(f'{name} is not there and is left out: see --shared.', file=sys.stderr)
            continue
        rows += measure_scene(Scene(name, a), a, blender)
        with open(a.work / 'results.csv', 'w', newline='') as out:
            writer = csv.DictWriter(out, COLUMNS)
            writer.writeheader()
            for r in rows:
                writer.writerow({k: f'{v:.5g}' if isinstance(v, float) else v for k, v in r.items()})
        curves(rows, a)
    print(table(rows) + '\n\n' + summary(rows))
    return 0


if __name__ == '__main__':
    sys.exit(main())
