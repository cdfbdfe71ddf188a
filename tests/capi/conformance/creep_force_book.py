#!/usr/bin/env python3
"""A book of creep forces for interpolation: 25 ellipses, 15 x 15 creepages, 30 spins, by several threads.

The published program for this table has no printed results; conditions that hold for every entry are checked. Scaled
creepages xi, eta, psi: the linear theory gives 3 xi, 3 eta, psi. usage: creep_force_book.py [STRIDE]
With a stride n only every n-th ellipse and creepage is computed.
"""
import sys
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from checks import check, close, finish, same
from contact import cntc
from contact._library import call
from contact.cntc import CNTC

NU, MX, SEVENTH = 0.28, 12, np.arange(1, 8) / 7.0
#: Kalker's coefficients: g = min(a/b, b/a), then C11, C22, C23 for nu = 0, 1/4, 1/2 (Kalker 1967, as given in the
#: specification of the interface, with its 1.15)
LONG_ACROSS = """0.1 2.51 3.31 4.85 2.51 2.52 2.53 .334 .473 .731   0.2 2.59 3.37 4.81 2.59 2.63 2.66 .483 .603 .809
0.3 2.68 3.44 4.80 2.68 2.75 2.81 .607 .715 .889   0.4 2.78 3.53 4.82 2.78 2.88 2.98 .720 .823 .977
0.5 2.88 3.62 4.83 2.88 3.01 3.14 .827 .929 1.07   0.6 2.98 3.72 4.91 2.98 3.14 3.31 .930 1.03 1.18
0.7 3.09 3.81 4.97 3.09 3.28 3.48 1.03 1.14 1.29   0.8 3.19 3.91 5.05 3.19 3.41 3.65 1.13 1.15 1.40
0.9 3.29 4.01 5.12 3.29 3.54 3.82 1.23 1.36 1.51   1.0 3.40 4.12 5.20 3.40 3.67 3.98 1.33 1.47 1.63"""
LONG_ALONG = """0.1 10.7 11.7 12.9 10.7 12.8 16.0 12.2 14.6 18.0   0.2 6.96 7.78 8.82 6.96 8.14 9.79 5.72 6.63 7.89
0.3 5.57 6.34 7.34 5.57 6.40 7.51 3.79 4.32 5.01   0.4 4.84 5.57 6.57 4.84 5.48 6.31 2.88 3.24 3.70
0.5 4.37 5.10 6.11 4.37 4.90 5.56 2.35 2.62 2.96   0.6 4.06 4.78 5.80 4.06 4.50 5.04 2.01 2.23 2.50
0.7 3.82 4.54 5.58 3.82 4.21 4.67 1.76 1.95 2.18   0.8 3.65 4.36 5.42 3.65 3.99 4.39 1.58 1.75 1.94
0.9 3.51 4.22 5.30 3.51 3.81 4.16 1.44 1.59 1.77   1.0 3.40 4.12 5.20 3.40 3.67 3.98 1.33 1.47 1.63"""


def coefficients(ratio):
    """Cx, Cy, Cz of an ellipse a/b = ratio: a table, and asymptotes for slender ones"""
    g = min(ratio, 1 / ratio)
    if g < 0.101:
        if ratio < 1:
            return (np.pi**2 / (4 * (1 - NU)), np.pi**2 / 4, np.pi * np.sqrt(g) / (3 * (1 - NU)) * (1 + NU * (np.log(16 / g) - 5)))
        big = np.log(16 / g**2)
        across = (1 - NU) * big + 2 * NU
        return (2 * np.pi / ((big - 2 * NU) * g) * (1 + (3 - np.log(4)) / (big - 2 * NU)),
                2 * np.pi / g * (1 + (1 - NU) * (3 - np.log(4)) / across) / across,
                2 * np.pi / (3 * g**1.5 * ((1 - NU) * big - 2 + 4 * NU)))
    rows = np.array((LONG_ACROSS if ratio <= 1 else LONG_ALONG).split(), float).reshape(10, 10)
    nodes = (0.0, 0.25, 0.5)
    weights = [np.prod([(NU - other) / (node - other) for other in nodes if other != node]) for node in nodes]
    return tuple(1 / np.dot(weights, 1 / np.array([np.interp(g, rows[:, 0], rows[:, column + k]) for k in range(3)]))
                 for column in (1, 4, 7))


def set_up(ire):
    """Common settings of all entries"""
    cntc.initialize(ire, 3)
    cntc.setflags(ire, 1, [CNTC[name] for name in ("if_units", "ic_tang", "ic_output", "ic_flow")], [CNTC["un_cntc"], 3, 0, 0])
    cntc.setmaterialproperties(ire, 1, 1.0, NU, 1.0, NU)
    cntc.setfrictionmethod(ire, 1, 0, [1.0, 1.0])
    cntc.setreferencevelocity(ire, 1, 1.0)
    cntc.setnormalforce(ire, 1, 1.0)
    cntc.setsolverflags(ire, 1, 0, [999, 5, 30, 1], [1e-6])


def fill(ire, ratio, xi, eta, psi):
    """Fx, Fy, Mz of an ellipse for all combinations, and the number of failures"""
    set_up(ire)
    cx, cy, cz = coefficients(ratio)
    table, failures = np.zeros((len(xi), len(eta), len(psi), 3)), 0
    cntc.sethertzcontact(ire, 1, -3, [MX, MX, np.sqrt(ratio), 1 / np.sqrt(ratio), MX / (MX - 2)])
    for i, one in enumerate(xi):
        for j, other in enumerate(eta):
            for k, spin in enumerate(psi):
                cntc.setcreepages(ire, 1, -3 * one / cx, -3 * other / cy, -spin / cz)
                failures += call("cntc_calculate", ire, 1) != 0
                table[i, j, k] = cntc.getcontactforces(ire, 1)[1:]
    cntc.finalize(ire)
    return table, failures


def main():
    """All ellipses, several at a time"""
    stride = int(sys.argv[1]) if len(sys.argv) > 1 else 1
    ratios = np.concatenate([SEVENTH, [200, 130, 90, 65, 45, 32, 22.4, 16, 11.2, 8, 5.6, 4, 2.8, 2, 1.7, 1.4, 1.2, 1]])[::stride]
    creepages = np.concatenate([[0.0], SEVENTH, [7e5], 1 / SEVENTH[:7]])
    order = np.argsort(creepages)[::stride]
    creepages = np.unique(np.append(creepages[order], [0.0, 1 / 7, 7e5]))
    spins = np.concatenate([-creepages[::-1], creepages])
    cntc.initlibrary(expnam="book")
    cntc.setglobalflags([CNTC["if_idebug"], CNTC["if_openmp"]], [0, 1])
    # a remaining element keeps the run active
    cntc.initialize(999, 3)
    with ThreadPoolExecutor(max_workers=max(1, min(4, cntc.getmaxnumthreads()))) as pool:
        jobs = [pool.submit(fill, ire, ratio, creepages, creepages, spins) for ire, ratio in enumerate(ratios, 1)]
        tables = [job.result() for job in jobs]
    same(sum(failures for _, failures in tables), 0, "entries that could not be computed")
    zero, small, huge = 0, int(np.searchsorted(creepages, 0.14)), len(creepages) - 1
    n = len(creepages)
    for ratio, (table, _) in zip(ratios, tables):
        label = f"a/b = {ratio:.4g}"
        check(bool(np.all(np.isfinite(table))), f"{label}: all entries are numbers")
        check(np.hypot(table[..., 0], table[..., 1]).max() <= 1 + 1e-6, f"{label}: forces within the friction bound")
        close(table[zero, zero, [n - 1, n]], np.zeros((2, 3)), 5e-7, f"{label}: no force without creepage")
        close(table[huge, zero, [n - 1, n], 0], [1, 1], 1e-4, f"{label}: sliding along x")
        close(table[zero, huge, [n - 1, n], 1], [1, 1], 1e-4, f"{label}: sliding along y")
        # eta and psi change sign together: Fy and Mz do, Fx does not
        turned = table[:, zero, ::-1]
        close(table[:, zero, :, 0], turned[..., 0], 2e-4, f"{label}: Fx is even in the spin")
        close(table[:, zero, :, 1], -turned[..., 1], 2e-4, f"{label}: Fy is odd in the spin")
        # a third of the way to sliding is 3 xi (1 - xi + xi**2/3) after Vermeulen and Johnson, where the coefficients are
        # Kalker's and not those of strips; the grid has ten elements along the ellipse
        if 0.1 <= ratio <= 10:
            expected = 1 - (1 - creepages[small])**3
            close(table[small, zero, n, 0] / expected, 1.0, 0.12, f"{label}: small creepage along x")
            close(table[zero, small, n, 1] / expected, 1.0, 0.12, f"{label}: small creepage along y")
        rising = np.diff(table[:, zero, n, 0])
        check(rising.min() > -1e-5, f"{label}: Fx grows with the creepage")
    print(f"{sum(table[..., 0].size for table, _ in tables)} entries")
    cntc.finalizelast()


if __name__ == "__main__":
    main()
    finish()
