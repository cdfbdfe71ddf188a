#!/usr/bin/env python3
"""Wear of a rail 60E1 by 50 million wheels S1002, with its profile changing: python3 rail_wear.py

The wheels are those of wheel_wear.py, with their positions and yaw; wear is by Archard's law, with a chosen coefficient and
hardness, not measured ones. Profiles and computed cases are stored in the folder rail_wear.study; repeat the command to resume
after an interruption. --small takes seconds.
"""
import argparse
import sys
from pathlib import Path

from contact import wear
from contact.wheel_wear import Profile, wear_of_rail
from wheel_wear import EXAMPLES, HERE, base, journey


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--wheels", type=float, default=50.0, help="in millions; default %(default)s")
    parser.add_argument("--positions", type=int, default=13, help="lateral positions; default %(default)s")
    parser.add_argument("--elements", type=float, default=1.0, help="sides of elements [mm]; default %(default)s")
    parser.add_argument("--archard", type=float, default=3e-4, help="wear coefficient [-]; default %(default)s")
    parser.add_argument("--hardness", type=float, default=2800.0, help="of the rail [N/mm2]; default %(default)s")
    parser.add_argument("--small", action="store_true", help="5 million wheels with 5 positions")
    parser.add_argument("--folder", type=Path, default=HERE / "rail_wear.study")
    asked = parser.parse_args()
    if asked.small:
        asked.wheels, asked.positions, asked.elements = 5.0, 5, 2.0
    wheel = Profile.read(EXAMPLES / "profiles/S1002.prw")
    last = None
    for state in wear_of_rail(base(asked.elements), lambda step, rail: journey(asked.positions, 1.5, 5e-4, step, wheel),
                              asked.wheels, lambda pn, px, py, sx, sy, dx: wear.archard_depth(
                                  pn, sx, sy, dx, asked.archard, asked.hardness), folder=asked.folder, base_folder=EXAMPLES):
        last = state
        print(f"{state.distance:8.2f} million wheels: worn {state.area:7.2f} mm2, at most {state.depth.max():.3f} mm at "
              f"y = {state.profile.y[state.depth.argmax()]:.1f} mm", flush=True)
    last.profile.write(asked.folder / "worn.prr", f"60E1 after {asked.wheels:g} million wheels")
    return 0


if __name__ == "__main__":
    sys.exit(main())
