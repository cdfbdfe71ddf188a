"""Table and picture of error against time, from the output of performance_accuracy.

    accuracy.py FOLDER < lines      writes FOLDER/accuracy.md and FOLDER/accuracy.svg
"""
import math
import os
import platform
import sys

COLOURS = ["#1f5fa8", "#d1495b", "#2e8b57", "#8a5fbf", "#c77f1a", "#3aa0a0", "#6b6b6b", "#a0522d"]
MEASURES = [("force", "error in the forces"), ("peak", "error in the peak traction")]
WIDTH, HEIGHT, LEFT, GAP_X, GAP_Y = 270, 210, 62, 62, 74
# Legends: entries per line and height of a line
ENTRIES, LINE = 2, 16


def read(lines):
    points = []
    for line in lines:
        word = line.strip().split(",")
        if len(word) != 8:
            sys.exit("accuracy.py: not a line of performance_accuracy: " + line.strip())
        points.append(dict(group=word[0], method=word[1], contact=int(word[2]), grid=int(word[3]), eps=float(word[4]),
                           seconds=float(word[5]), force=float(word[6]), peak=float(word[7])))
    return points


def unique(values):
    return list(dict.fromkeys(values))


def front(points, measure):
    """Points that no other one beats in both time and error, sorted by time"""
    best, kept = math.inf, []
    for point in sorted(points, key=lambda p: p["seconds"]):
        if point[measure] < best:
            best = point[measure]
            kept.append(point)
    return kept


def decades(values):
    return math.floor(math.log10(min(values))), math.ceil(math.log10(max(values)))


def panel(out, x0, y0, points, measure, methods, y_range):
    x_range = decades([p["seconds"] for p in points])

    def error(p):
        return max(p[measure], 10.0**y_range[0])

    def x(seconds):
        return x0 + WIDTH*(math.log10(seconds) - x_range[0])/(x_range[1] - x_range[0])

    def y(value):
        return y0 + HEIGHT*(y_range[1] - math.log10(value))/(y_range[1] - y_range[0])

    for d in range(x_range[0], x_range[1] + 1):
        at = x(10.0**d)
        out.append(f'<path d="M{at:.1f} {y0} V{y0 + HEIGHT}" stroke="#ddd"/>')
        out.append(f'<text x="{at:.1f}" y="{y0 + HEIGHT + 15}" text-anchor="middle">{seconds_text(d)}</text>')
    for d in range(y_range[0], y_range[1] + 1):
        at = y(10.0**d)
        out.append(f'<path d="M{x0} {at:.1f} H{x0 + WIDTH}" stroke="#ddd"/>')
        out.append(f'<text x="{x0 - 6}" y="{at + 4:.1f}" text-anchor="end">10<tspan dy="-4" font-size="8">{d}</tspan></text>')
    out.append(f'<rect x="{x0}" y="{y0}" width="{WIDTH}" height="{HEIGHT}" fill="none" stroke="#666"/>')
    for k, method in enumerate(methods):
        own = [p for p in points if p["method"] == method]
        for p in own:
            out.append(f'<circle cx="{x(p["seconds"]):.1f}" cy="{y(error(p)):.1f}" r="2" fill="{COLOURS[k]}" fill-opacity="0.45"/>')
        line = " ".join(f'{x(p["seconds"]):.1f},{y(error(p)):.1f}' for p in front(own, measure))
        out.append(f'<polyline points="{line}" fill="none" stroke="{COLOURS[k]}" stroke-width="1.8"/>')


def seconds_text(d):
    return {-6: "1 µs", -5: "10 µs", -4: "0.1 ms", -3: "1 ms", -2: "10 ms", -1: "0.1 s", 0: "1 s", 1: "10 s"}.get(d, f"1e{d} s")


def picture(points):
    groups = unique(p["group"] for p in points)
    total_x = LEFT + len(groups)*(WIDTH + GAP_X)
    most = max(len(unique(p["method"] for p in points if p["group"] == group)) for group in groups)
    top = 36 + LINE*math.ceil(most/ENTRIES)
    total_y = top + 2*(HEIGHT + GAP_Y) + 10
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {total_x} {total_y}" font-family="sans-serif" font-size="11">',
           f'<rect width="{total_x}" height="{total_y}" fill="white"/>']
    for row, (measure, title) in enumerate(MEASURES):
        y0 = top + row*(HEIGHT + GAP_Y)
        y_range = max(-8, math.floor(math.log10(max(1e-9, min(p[measure] for p in points))))), \
            math.ceil(math.log10(max(p[measure] for p in points)))
        out.append(
            f'<text x="14" y="{y0 + HEIGHT / 2}" transform="rotate(-90 14 {y0 + HEIGHT / 2})" text-anchor="middle">{title}</text>'
        )
        for column, group in enumerate(groups):
            x0 = LEFT + column*(WIDTH + GAP_X)
            own = [p for p in points if p["group"] == group]
            methods = unique(p["method"] for p in own)
            panel(out, x0, y0, own, measure, methods, y_range)
            if row == 0:
                out.append(f'<text x="{x0}" y="18" font-size="14" font-weight="bold">{group}</text>')
                for k, method in enumerate(methods):
                    at, line = x0 + k % ENTRIES*WIDTH//ENTRIES, 35 + LINE*(k//ENTRIES)
                    out.append(f'<circle cx="{at + 4}" cy="{line}" r="4" fill="{COLOURS[k]}"/>'
                               f'<text x="{at + 12}" y="{line + 4}">{method}</text>')
            else:
                out.append(
                    f'<text x="{x0 + WIDTH / 2}" y="{y0 + HEIGHT + 34}" text-anchor="middle">processor time of one case</text>'
                )
    out.append("</svg>")
    return "\n".join(out) + "\n"


def table(points):
    out = []
    for group in unique(p["group"] for p in points):
        out += [f"## {group[0].upper()}{group[1:]}", "",
                "| method | grid | in contact | tolerance | ms | error in the forces | error in the peak traction |",
                "|---|---|---|---|---|---|---|"]
        for p in (p for p in points if p["group"] == group):
            out.append(f'| {p["method"]} | {p["grid"]} x {p["grid"]} | {p["contact"]} | {p["eps"]:.0e} | '
                       f'{1000*p["seconds"]:.3g} | {p["force"]:.1e} | {p["peak"]:.1e} |')
        out.append("")
    return "\n".join(out)


TEXT = """# Accuracy against time

Errors of single contacts with each method, grid and tolerance, and what they cost. At the end: times for a required error
compared with the [goals](#goals). Many contacts: [error against time](accuracy_study.md).

Written by `sh tests/performance/accuracy.sh`; {machine}. Times are processor time of one thread
for a case that starts from zero on a grid that is already set up.

![error against seconds](accuracy.svg)

Each dot is one grid with one tolerance; for each method the lines join the combinations that no
other combination beats in both time and error. An error that changes its sign between grids can be small
by chance: single points far below their neighbours are not significant. Errors below 1e-8 are drawn at 1e-8.
References from a finest grid have an error, too, about half that of the next coarser grid.

- *Normal problem*: a ball on a flat, approach prescribed; errors of the force and of the largest
  pressure against Hertz's solution.
- *Steady rolling*: the first contact of the benchmark, with Hertz's pressures. Errors of forces
  are relative to the friction bound, that of the largest traction to its own value;
  reference: 320 x 320 elements, tolerance 1e-9.
- *Shift*: the same contact shifted by (5, -3) micrometres.
- *Complete case*: normal and tangential problem of a contact of 6 x 4 mm as in a creep-force table,
  with the full normal problem (B=0), prescribed pressures (B=2, B=3) or approximate ones (B=5, B=6, from the approach of the
  reference), and with simplified theory instead of the full one (M=3, M=5); reference: 283 x 283 elements, B=0, M=0,
  tolerance 1e-9. Parabolic pressures are the traction bound of the simplified theory, not an
  approximation of the true ones; their error does not converge to zero, nor do those of the other approximations.

The tolerance is that of each method: a bound on the true residual for Newton-Krylov, on the last
update for the classical methods.

"""


def main():
    folder = sys.argv[1]
    points = read(sys.stdin)
    if not points:
        sys.exit("accuracy.py: no points on the standard input")
    machine = f"{os.cpu_count()} processors, {platform.machine()}, shared with other work"
    with open(os.path.join(folder, "accuracy.svg"), "w", encoding="utf-8") as file:
        file.write(picture(points))
    with open(os.path.join(folder, "accuracy.md"), "w", encoding="utf-8") as file:
        file.write(TEXT.format(machine=machine) + table(points))


main()
