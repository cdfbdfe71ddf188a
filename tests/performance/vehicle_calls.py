"""Calls of performance_vehicle in two versions: vehicle_calls.py BEFORE AFTER [PICTURE.svg]

The files are those of `performance_vehicle FOLDER --calls FILE STEPS` of both versions. Prints the differences of the forces, and
draws the fraction of calls that take longer than a given time.
"""
import math
import sys

WIDTH, HEIGHT, LEFT, TOP, BOTTOM = 720, 420, 70, 40, 60
#: Range of times [ms] and of fractions
TIMES, SHARES = (0.1, 30.0), (1e-4, 1.0)
COLOURS = {"1": "#1f77b4", "0.5": "#d62728"}


def read(name):
    """Side of the elements -> {(wheel, step): (ms, FX, FY, FZ)}"""
    calls = {}
    with open(name, encoding="utf-8") as file:
        for line in file:
            side, wheel, step, *numbers = line.split()
            calls.setdefault(side, {})[int(wheel), int(step)] = [float(number) for number in numbers]
    return calls


def across(time):
    """Position of a time [ms] in the picture"""
    return LEFT + (WIDTH - LEFT - 20)*math.log(time/TIMES[0])/math.log(TIMES[1]/TIMES[0])


def down(share):
    """Position of a fraction of calls in the picture"""
    return TOP + (HEIGHT - TOP - BOTTOM)*math.log(SHARES[1]/share)/math.log(SHARES[1]/SHARES[0])


def curve(times, colour, dashes):
    """Fraction of calls that take longer, as a path"""
    times = sorted(times)
    points = []
    for k, time in enumerate(times):
        if k % max(1, len(times)//400) and k < len(times) - 50:
            continue
        share = max(SHARES[0], (len(times) - k)/len(times))
        points.append(f"{across(min(max(time, TIMES[0]), TIMES[1])):.1f},{down(share):.1f}")
    return f'<polyline points="{" ".join(points)}" fill="none" stroke="{colour}" stroke-width="2" stroke-dasharray="{dashes}"/>'


def axes():
    """Lines and texts of the picture"""
    parts = []
    for time in (0.1, 0.2, 0.5, 1, 2, 5, 10, 20):
        x = across(time)
        parts.append(f'<line x1="{x:.1f}" x2="{x:.1f}" y1="{TOP}" y2="{HEIGHT - BOTTOM}" stroke="#ddd"/>'
                     f'<text x="{x:.1f}" y="{HEIGHT - BOTTOM + 18}" text-anchor="middle">{time:g}</text>')
    for share, word in ((1.0, "all"), (0.5, "50 %"), (0.1, "10 %"), (0.01, "1 %"), (0.001, "0.1 %"), (0.0001, "0.01 %")):
        y = down(share)
        parts.append(f'<line x1="{LEFT}" x2="{WIDTH - 20}" y1="{y:.1f}" y2="{y:.1f}" stroke="#ddd"/>'
                     f'<text x="{LEFT - 8}" y="{y + 4:.1f}" text-anchor="end">{word}</text>')
    parts.append(f'<text x="{(LEFT + WIDTH)/2:.0f}" y="{HEIGHT - 15}" text-anchor="middle">processor time of a call, ms</text>'
                 f'<text x="{LEFT}" y="{TOP - 15}">calls that take longer: DX = 1.0 mm (blue), 0.5 mm (red); '
                 f'before (dashed), after</text>')
    return parts


def main():
    before, after = read(sys.argv[1]), read(sys.argv[2])
    lines = axes()
    for side, calls in after.items():
        both = calls.keys() & before[side].keys()
        worst = sorted(max(abs(new - old) for new, old in zip(calls[key][1:], before[side][key][1:]))/calls[key][3] for key in both)
        print(f"DX = {side}: forces of {len(worst)} calls differ by {worst[len(worst)//2]:.1e} FZ in the median, "
              f"{worst[-1]:.1e} at most")
        for which, dashes in ((before[side], "5 4"), (calls, "none")):
            lines.append(curve([call[0] for call in which.values()], COLOURS[side], dashes))
    if len(sys.argv) > 3:
        with open(sys.argv[3], "w", encoding="utf-8") as file:
            file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {WIDTH} {HEIGHT}" font-family="sans-serif" '
                       'font-size="12">'
                       f'<rect width="{WIDTH}" height="{HEIGHT}" fill="white"/>\n' + "\n".join(lines) + "\n</svg>\n")
    return 0


if __name__ == "__main__":
    sys.exit(main())
