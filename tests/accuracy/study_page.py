"""Page and picture of study.py: tables of medians and 95 % quantiles, and error against processor time by kind of contact."""
import math
import os
import platform

COLOURS = {1: "#d1495b", 2: "#1f5fa8"}
WIDTH, HEIGHT, LEFT, TOP, GAP_X, GAP_Y, COLUMNS = 220, 170, 60, 50, 40, 64, 4
LEGEND = ("error of the forces (of the approach without friction) against processor time; "
          f'<tspan fill="{COLOURS[1]}">order 1</tspan>, <tspan fill="{COLOURS[2]}">order 2</tspan>; '
          "solid: median, dashed: 95 %; dots: 10 to 80 elements along a side; EPS = 1e-5")
#: Grids of the tables
SHOWN = (20, 40, 80)
TOTALS = (("normal", "approach, or normal force"), ("peak", "PMAX"), ("power", "frictional power or work"),
          ("temperature", "highest temperature"))
ASKED = (1e-2, 3e-3, 1e-3, 3e-4, 1e-4)

HEAD = """# Error against time over many contacts

Written by `{command} --write doc/validation`,
from {cases} solutions of {contacts} contacts in {kinds} kinds, each at {offsets} offsets of each grid; {machine},
shared with other work. Times are processor time of one thread for a case of the program, including input and output.
In short: [what an accuracy costs](#cost-of-an-accuracy-of-the-forces), and [how exact](../user/how_exact.md) results are
for the user. One contact with all methods and tolerances: [accuracy against time](accuracy.md).

![error of the forces against processor time](accuracy_study.svg)

The error of the forces is the largest of those of FX and FY, relative to the friction bound, and MZ, relative to the bound times
the root of a b; with prescribed forces the errors of the creepages replace those of FX and FY, relative to the creepage of full
sliding. References: 80 and 160 elements along a side, extrapolated, with order 2 where it applies; their own error is about 1e-5
there, and about 3e-4 for transient rolling. In transient rolling the step is 0.15 a on every grid, and the reference
is the limit of fine elements with that step. The number of elements is that along each side of a potential contact 1.15 times
(profiles 1.9, two patches 2, viscoelastic 1.3 times) as long as the contact; for wheels along 12 mm.
"""


PRICES = """Milliseconds, and number of elements along a side, of the fastest combination of grid and tolerance with a median error
below that of the column; - where 80 elements are not enough.
"""


def quantile(values, q):
    """Quantile q of the values."""
    values = sorted(values)
    return values[min(len(values) - 1, int(q * len(values)))] if values else math.nan


def figure(value):
    """A short number, "" for none."""
    return "" if math.isnan(value) else f"{value:.1e}"


def milliseconds(seconds):
    """Two figures."""
    return f"{1e3 * seconds:.2g}" if seconds < 0.0995 else f"{1e3 * seconds:.0f}"


def find(rows, kind, order, eps, n):
    """The row of a kind, None if it was not computed."""
    return next((r for r in rows if (r["kind"], r["order"], r["eps"], r["n"]) == (kind, order, eps, n)), None)


def by_kind(rows, eps):
    """Errors of the forces by kind and order: medians, 95 %, time, observed order."""
    lines = ["| contact | order | " + " | ".join(f"{n} x {n}: median | 95 % | ms" for n in SHOWN) + " | observed order |",
             "|---" * (3 + 3 * len(SHOWN)) + "|"]
    for kind in dict.fromkeys(r["kind"] for r in rows):
        for order in (1, 2):
            picked = [find(rows, kind, order, eps, n) for n in SHOWN]
            if None in picked or not any(r["errors"].get("forces") for r in picked):
                continue
            medians = [quantile(r["errors"].get("forces", []), 0.5) for r in picked]
            cells = [f"{figure(m)} | {figure(quantile(r['errors']['forces'], 0.95))} | {milliseconds(r['seconds'])}"
                     for m, r in zip(medians, picked)]
            observed = math.log(medians[0] / medians[-1]) / math.log(SHOWN[-1] / SHOWN[0]) if min(medians) > 0 else math.nan
            lines.append(f"| {kind} | {order} | " + " | ".join(cells) + f" | {observed:.1f} |")
    return lines


def other_totals(rows, eps):
    """Medians and 95 % quantiles of the other totals by kind, with the highest order available."""
    lines = ["| total | contact | " + " | ".join(f"{n} x {n}: median | 95 %" for n in SHOWN) + " |",
             "|---" * (2 + 2 * len(SHOWN)) + "|"]
    for group, title in TOTALS:
        for kind in dict.fromkeys(r["kind"] for r in rows):
            order = max(r["order"] for r in rows if r["kind"] == kind)
            picked = [find(rows, kind, order, eps, n) for n in SHOWN]
            if None in picked or not all(r["errors"].get(group) for r in picked):
                continue
            cells = [f"{figure(quantile(r['errors'][group], 0.5))} | {figure(quantile(r['errors'][group], 0.95))}" for r in picked]
            lines.append(f"| {title} | {kind} | " + " | ".join(cells) + " |")
    return lines


def cheapest(rows, kind, order, asked, q):
    """Row of the fastest combination of grid and tolerance whose quantile of the error is below the request."""
    good = [r for r in rows if r["kind"] == kind and r["order"] == order and r["errors"].get("forces")
            and quantile(r["errors"]["forces"], q) <= asked]
    return min(good, key=lambda r: r["seconds"], default=None)


def prices(rows, q):
    """Cost of an accuracy of the forces, by kind and order."""
    lines = ["| contact | order | " + " | ".join(f"{e:g}" for e in ASKED) + " |", "|---" * (2 + len(ASKED)) + "|"]
    for kind in dict.fromkeys(r["kind"] for r in rows):
        for order in (1, 2):
            if not any(r["kind"] == kind and r["order"] == order and r["errors"].get("forces") for r in rows):
                continue
            cells = []
            for asked in ASKED:
                best = cheapest(rows, kind, order, asked, q)
                cells.append(f"{milliseconds(best['seconds'])} ({best['n']})" if best else "-")
            lines.append(f"| {kind} | {order} | " + " | ".join(cells) + " |")
    return lines


def tolerances(rows, eps):
    """Effect of a larger tolerance: ratios of errors and times, medians over kinds."""
    lines = ["| order | elements | error at EPS 1e-3 over that at 1e-5 | time |", "|---|---|---|---|"]
    for order in (1, 2):
        for n in SHOWN:
            pairs = [(find(rows, k, order, eps[0], n), find(rows, k, order, eps[1], n)) for k in {r["kind"] for r in rows}]
            pairs = [(a, b) for a, b in pairs if a and b and a["errors"].get("forces") and b["errors"].get("forces")]
            if not pairs:
                continue
            error = quantile([quantile(a["errors"]["forces"], 0.5) / quantile(b["errors"]["forces"], 0.5) for a, b in pairs], 0.5)
            time = quantile([a["seconds"] / b["seconds"] for a, b in pairs], 0.5)
            lines.append(f"| {order} | {n} x {n} | {error:.2f} | {time:.2f} |")
    return lines


def panel(out, x0, y0, kind, rows):
    """Error against time for one kind: medians as lines, 95 % quantiles dashed."""
    x_range, y_range = (-1, 3), (-6, 0)

    def x(ms):
        return x0 + WIDTH * (min(max(math.log10(ms), x_range[0]), x_range[1]) - x_range[0]) / (x_range[1] - x_range[0])

    def y(value):
        return y0 + HEIGHT * (y_range[1] - min(max(math.log10(value), y_range[0]), y_range[1])) / (y_range[1] - y_range[0])

    for d in range(x_range[0], x_range[1] + 1):
        out.append(f'<path d="M{x(10.0**d):.1f} {y0} V{y0 + HEIGHT}" stroke="#ddd"/>')
        out.append(f'<text x="{x(10.0**d):.1f}" y="{y0 + HEIGHT + 15}" text-anchor="middle">{10.0**d:g} ms</text>')
    for d in range(y_range[0], y_range[1] + 1):
        out.append(f'<path d="M{x0} {y(10.0**d):.1f} H{x0 + WIDTH}" stroke="#ddd"/>')
        out.append(f'<text x="{x0 - 5}" y="{y(10.0**d) + 4:.1f}" text-anchor="end">1e{d}</text>')
    out.append(f'<text x="{x0}" y="{y0 - 7}" font-weight="bold">{kind}</text>')
    for order in (1, 2):
        picked = sorted((r for r in rows if r["kind"] == kind and r["order"] == order), key=lambda r: r["n"])
        group = "forces" if any(r["errors"].get("forces") for r in picked) else "normal"
        picked = [r for r in picked if r["errors"].get(group)]
        for q, dash in ((0.5, ""), (0.95, ' stroke-dasharray="4 3"')):
            points = [(x(1e3 * r["seconds"]), y(max(quantile(r["errors"][group], q), 1e-9))) for r in picked]
            if points:
                path = "M" + " L".join(f"{a:.1f} {b:.1f}" for a, b in points)
                out.append(f'<path d="{path}" fill="none" stroke="{COLOURS[order]}" stroke-width="1.6"{dash}/>')
            if q == 0.5:
                out += [f'<circle cx="{a:.1f}" cy="{b:.1f}" r="2.4" fill="{COLOURS[order]}"/>' for a, b in points]


def draw(rows, eps):
    """The picture, a panel for each kind."""
    kinds = list(dict.fromkeys(r["kind"] for r in rows))
    lines = -(-len(kinds) // COLUMNS)
    width, height = LEFT + COLUMNS * (WIDTH + GAP_X), TOP + lines * (HEIGHT + GAP_Y)
    out = [f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width} {height}" font-family="sans-serif" font-size="11">',
           f'<rect width="{width}" height="{height}" fill="white"/>',
           f'<text x="{LEFT}" y="16">{LEGEND}</text>']
    for number, kind in enumerate(kinds):
        x0 = LEFT + number % COLUMNS * (WIDTH + GAP_X)
        panel(out, x0, TOP + number // COLUMNS * (HEIGHT + GAP_Y), kind, [r for r in rows if r["eps"] == eps])
    return "\n".join([*out, "</svg>"]) + "\n"


def make(rows, command, eps):
    """Text of the page, and of the picture."""
    machine = f"{os.cpu_count()} processors, {platform.machine()}"
    for r in rows:
        r["solved"] = max((len(v) for v in r["errors"].values()), default=0)
    contacts = sum(max(r["contacts"] for r in rows if r["kind"] == kind) for kind in {r["kind"] for r in rows})
    head = HEAD.format(command=command, cases=sum(r["solved"] for r in rows), contacts=contacts, offsets=rows[0]["offsets"],
                       kinds=len({r["kind"] for r in rows}), machine=machine)
    missing = {}
    for r in rows:
        missing[r["kind"]] = missing.get(r["kind"], 0) + r["missing"]
    told = ", ".join(f"{kind} {n}" for kind, n in missing.items() if n) or "none"
    parts = [head, f"Solutions excluded because they or the reference did not converge: {told}.\n",
             "## Forces, EPS = 1e-5\n", *by_kind(rows, eps[1]),
             "\n## Cost of an accuracy of the forces\n",
             PRICES, *prices(rows, 0.5),
             "\nThe same for 95 % of the contacts and offsets.\n", *prices(rows, 0.95),
             "\n## Other totals\n", "Relative errors, with order 2 where it applies.\n", *other_totals(rows, eps[1]),
             "\n## Tolerance\n", "Medians over all kinds.\n", *tolerances(rows, eps)]
    return "\n".join(parts) + "\n", draw(rows, eps[1])
