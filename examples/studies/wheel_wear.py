#!/usr/bin/env python3
"""Wear of a wheel S1002 over 100,000 km on rails 60E1, with its profile changing: python3 wheel_wear.py

Lateral positions and yaw angles of the wheelset are normally distributed; wear is that of Braghin and others (2006). Profiles, a
table and the computed cases are stored in the folder wheel_wear.study; repeat the command to resume after an interruption.
--small takes seconds.
"""
import argparse
import csv
import sys
from pathlib import Path

import contact
import numpy as np
from contact import wear
from contact.wheel_wear import wear_of_wheel

HERE = Path(__file__).resolve().parent
EXAMPLES = HERE.parent
#: Forward speed [mm/s], radius of the new wheel [mm]
SPEED, RADIUS = 20000.0, 460.0


def journey(positions, spread_y, spread_yaw, step, profile):
    """Positions [mm], yaw angles [rad] and pitch rates [rad/s] of a step, and their fractions of the distance"""
    # the positions are shifted in each step: multiples of the golden ratio fill the interval between two positions evenly
    shift = (0.5 * (5.0**0.5 - 1.0) * step) % 1.0 - 0.5
    y = (np.arange(positions) - 0.5 * (positions - 1) + shift) * 5.0 * spread_y / (positions - 1)
    yaw = np.array([-1.2, 0.0, 1.2]) * spread_yaw
    parts = np.exp(-0.5 * (y / spread_y)**2)[:, None] * [0.3, 0.4, 0.3]
    places = np.broadcast_arrays(y[:, None], yaw)
    # an undriven wheelset: pure rolling at the middle of the current tread
    pitch = np.full(parts.size, -SPEED / (RADIUS + float(profile.height_at(0.0))))
    inputs = {"velocity.vpitch": pitch, "position.y_ws": places[0].ravel(), "position.yaw": places[1].ravel()}
    return {name: list(values) for name, values in inputs.items()}, parts.ravel()


def base(elements):
    """A right wheel on its rail"""
    case = contact.read(EXAMPLES / "wheel_on_rail.toml")[0]
    case["search"].update(dx=elements, ds=elements)
    case["velocity"]["vs"], case["wheel_dimensions"]["nomradw"] = SPEED, RADIUS
    case["friction"].update(fstat=0.3, fkin=0.3)
    return case


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--distance", type=float, default=1e5, help="in km; default %(default)s")
    parser.add_argument("--positions", type=int, default=13, help="lateral positions; default %(default)s")
    parser.add_argument("--elements", type=float, default=1.0, help="sides of elements [mm]; default %(default)s")
    parser.add_argument("--step", type=float, default=0.05, help="increase of the depth after which contacts are recomputed [mm]")
    parser.add_argument("--spread", type=float, nargs=2, default=[1.5, 5e-4], metavar=("Y", "YAW"),
                        help="standard deviations of position [mm] and yaw [rad]; default 1.5 0.0005")
    parser.add_argument("--small", action="store_true", help="2000 km with 5 positions")
    parser.add_argument("--folder", type=Path, default=HERE / "wheel_wear.study")
    parser.add_argument("--figure", type=Path, help="a drawing of the profiles, .svg or .png; needs matplotlib")
    asked = parser.parse_args()
    if asked.small:
        asked.distance, asked.positions, asked.elements = 2000.0, 5, 2.0
    states = []
    for state in wear_of_wheel(base(asked.elements), lambda *now: journey(asked.positions, *asked.spread, *now), asked.distance,
                               lambda pn, px, py, sx, sy, dx: wear.braghin_depth(px, py, sx, sy, dx), folder=asked.folder,
                               base_folder=EXAMPLES, largest_step=asked.step):
        states.append(state)
        height, thickness, slope = state.profile.flange()
        print(f"{state.distance:8.0f} km: worn {state.area:7.2f} mm2, at most {state.depth.max():.3f} mm; flange Sh {height:.2f}, "
              f"Sd {thickness:.2f}, qR {slope:.2f} mm", flush=True)
    with (asked.folder / "wear.csv").open("w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow(["km", "worn area [mm2]", "largest depth [mm]", "Sh [mm]", "Sd [mm]", "qR [mm]"])
        rows.writerows([state.distance, state.area, state.depth.max(), *state.profile.flange()] for state in states)
    states[-1].profile.write(asked.folder / "worn.prw", f"S1002 after {asked.distance:.0f} km")
    if asked.figure:
        draw(states, asked.figure)
    return 0


def draw(states, file):
    """Profiles and depth at about six distances"""
    import matplotlib
    matplotlib.use("Agg")
    matplotlib.rcParams.update({"svg.hashsalt": "contact", "svg.fonttype": "none"})
    from matplotlib import pyplot
    _, (upper, lower) = pyplot.subplots(2, 1, figsize=(7.5, 5.5), sharex=True, layout="constrained")
    chosen = [states[int(np.abs([state.distance - at for state in states]).argmin())]
              for at in np.linspace(0.0, states[-1].distance, 6)]
    for state, colour in zip(chosen, pyplot.get_cmap("viridis")(np.linspace(0.0, 0.9, len(chosen)))):
        upper.plot(state.profile.y, state.profile.z, color=colour, lw=1)
        lower.plot(state.profile.y, state.depth, color=colour, lw=1, label=f"{state.distance:.0f} km")
    upper.invert_yaxis()
    upper.set_ylabel("z [mm]")
    lower.set(xlabel="y of the wheel profile [mm]", ylabel="worn off [mm]")
    lower.legend(fontsize="small")
    pyplot.savefig(file, metadata={"Date": None} if file.suffix == ".svg" else None)


if __name__ == "__main__":
    sys.exit(main())
