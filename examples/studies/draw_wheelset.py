#!/usr/bin/env python3
"""Contact positions of new and worn wheels on new and worn rails.

Usage: python3 draw_wheelset.py wheelset.nc wheelset.svg; needs matplotlib.
"""
import itertools
import sys

import matplotlib
import numpy as np
import xarray

matplotlib.use("Agg")
matplotlib.rcParams.update({"svg.hashsalt": "contact", "svg.fonttype": "none"})

WORDS = ("new", "worn")


def main():
    from matplotlib import pyplot
    data = xarray.open_dataset(sys.argv[1])
    cant = float(data["cant"][np.abs(data["cant"].values - 0.025).argmin()])
    figure, axes = pyplot.subplots(2, 2, figsize=(7.5, 5.5), sharex=True, sharey=True, layout="constrained")
    for one, (rail, wheel) in zip(axes.ravel(), itertools.product(range(2), repeat=2)):
        part = data.isel(rail_profile_file=rail, wheel_profile_file=wheel).sel(cant=cant, method="nearest")
        for number, colour in zip(range(part.sizes["yaw"]), pyplot.get_cmap("viridis")(np.linspace(0.0, 0.85, part.sizes["yaw"]))):
            for patch in range(part.sizes["patch"]):
                found = part.isel(yaw=number, patch=patch)
                one.scatter(found["ycp_w"], found["y_ws"], s=0.25 * found["contact_area"], color=colour, alpha=0.6, lw=0,
                            label=f"{1e3 * float(found['yaw']):.0f} mrad" if patch == 0 else None)
        one.set(title=f"{WORDS[wheel]} wheel, {WORDS[rail]} rail")
    for one in axes[1]:
        one.set_xlabel("contact on the wheel profile, y [mm]")
    for one in axes[:, 0]:
        one.set_ylabel("lateral position [mm]")
    axes[0, 0].legend(title="yaw", fontsize="small", title_fontsize="small")
    figure.savefig(sys.argv[2], metadata={"Date": None} if sys.argv[2].endswith(".svg") else None)
    return 0


if __name__ == "__main__":
    sys.exit(main())
