"""Curves over two logarithmic axes as SVG. The standard library alone."""
import math
import pathlib
from xml.sax.saxutils import escape

WIDTH, HEIGHT = 720, 440
LEFT, RIGHT, TOP, BOTTOM = 70, 210, 40, 50
COLORS = ('#0060a8', '#c04000', '#c09000', '#408040', '#8040a0', '#707070')


def decades(low, high):
    return range(math.floor(math.log10(low)), math.ceil(math.log10(high)) + 1)


def number(value):
    return f'{value:g}'


def log_log(path, title, x_title, y_title, series):
    """series: {name: [(x, y)]}; points that are not above 0 are left out; y in shares, shown in per cent."""
    series = {n: sorted((x, y) for x, y in s if x > 0 and y > 0) for n, s in series.items()}
    points = [p for s in series.values() for p in s]
    if not points:
        return
    xs, ys = decades(min(p[0] for p in points), max(p[0] for p in points)), decades(min(p[1] for p in points), max(p[1] for p in points))
    xs = xs if len(xs) > 1 else range(xs[0], xs[0] + 2)
    ys = ys if len(ys) > 1 else range(ys[0], ys[0] + 2)
    def at(x, y):
        u = (math.log10(x) - xs[0]) / (xs[-1] - xs[0])
        v = (math.log10(y) - ys[0]) / (ys[-1] - ys[0])
        return LEFT + u * (WIDTH - LEFT - RIGHT), HEIGHT - BOTTOM - v * (HEIGHT - TOP - BOTTOM)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" width="{WIDTH}" height="{HEIGHT}" font-family="sans-serif" font-size="12">',
           f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>',
           f'<text x="{LEFT}" y="22" font-size="15">{escape(title)}</text>']
    def line(x0, y0, x1, y1, color):
        a, b = at(x0, y0), at(x1, y1)
        out.append(f'<line x1="{a[0]:.1f}" y1="{a[1]:.1f}" x2="{b[0]:.1f}" y2="{b[1]:.1f}" stroke="{color}"/>')
    low, high = (10.0 ** xs[0], 10.0 ** ys[0]), (10.0 ** xs[-1], 10.0 ** ys[-1])
    for e in xs:
        for k in range(1, 10) if e < xs[-1] else (1,):
            line(k * 10.0 ** e, low[1], k * 10.0 ** e, high[1], '#b0b0b0' if k == 1 else '#ececec')
        x, y = at(10.0 ** e, low[1])
        out.append(f'<text x="{x:.1f}" y="{y + 16:.1f}" text-anchor="middle">{number(10.0 ** e)}</text>')
    for e in ys:
        for k in range(1, 10) if e < ys[-1] else (1,):
            line(low[0], k * 10.0 ** e, high[0], k * 10.0 ** e, '#b0b0b0' if k == 1 else '#ececec')
        x, y = at(low[0], 10.0 ** e)
        out.append(f'<text x="{x - 6:.1f}" y="{y + 4:.1f}" text-anchor="end">{number(100 * 10.0 ** e)} %</text>')
    out.append(f'<text x="{(LEFT + WIDTH - RIGHT) / 2}" y="{HEIGHT - 12}" text-anchor="middle">{escape(x_title)}</text>')
    out.append(f'<text transform="translate(16 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">{escape(y_title)}</text>')
    for i, (name, s) in enumerate(series.items()):
        color = COLORS[i % len(COLORS)]
        path_points = ' '.join('%.1f,%.1f' % at(x, y) for x, y in s)
        out.append(f'<polyline points="{path_points}" fill="none" stroke="{color}" stroke-width="2"/>')
        for x, y in s:
            u, v = at(x, y)
            out.append(f'<circle cx="{u:.1f}" cy="{v:.1f}" r="3.5" fill="{color}"/>')
        y = TOP + 14 + 20 * i
        out.append(f'<line x1="{WIDTH - RIGHT + 14}" y1="{y - 4}" x2="{WIDTH - RIGHT + 34}" y2="{y - 4}" stroke="{color}" stroke-width="2"/>')
        out.append(f'<text x="{WIDTH - RIGHT + 40}" y="{y}">{escape(name)}</text>')
    out.append('</svg>')
    pathlib.Path(path).write_text('\n'.join(out) + '\n')
