"""Wear and fatigue: against the integrals of Hertzian contacts in full sliding, and corners of the maps."""
import contact
import numpy as np
import pytest
from bases import rolling
from contact import wear

MU, FN, SLIP, VELOC = 0.3, 70000.0, 0.2, 30000.0


@pytest.fixture(scope="module")
def sliding():
    """A Hertzian contact that slides as a whole, along x"""
    base = rolling(41)
    base["grid"]["scale"] = 1.05
    return contact.Study(base, {"kinematics.cksi": [SLIP]}, fields=["pn", "px", "py", "sx", "sy"], derive={
        "t_gamma": lambda data: wear.t_gamma(data.fx, data.fy, data.cksi, data.ceta)}).run(workers=1).isel(cksi=0)


def test_t_gamma_of_full_sliding(sliding):
    assert float(sliding.t_gamma) == pytest.approx(MU * FN * SLIP, rel=1e-4)


def test_t_gamma_is_what_refinement_finds():
    """In steady rolling nothing but friction takes energy: with half the elements half the gap to the power of the slip,
    and a quarter of it with the second order"""
    gaps = {}
    for order in (1, 2):
        for n in (21, 41):
            base = rolling(n)
            base["iteration"] = {"order": order}
            base["kinematics"].update(cksi=0.0005, ceta=0.0008, cphi=0.0002)
            found = contact.Study(base).run(workers=1)
            # all three terms have the same sign here
            told = wear.t_gamma(found.fx, found.fy, 0.0005, 0.0008, found.mz, 0.0002)
            gaps[order, n] = float(told + 1e3 * found.friction_power / VELOC) / float(told)
    assert 0.0 < gaps[1, 41] < 0.15 and 0.4 < gaps[1, 41] / gaps[1, 21] < 0.65, gaps
    assert 0.0 < gaps[2, 41] < 0.01 and gaps[2, 41] / gaps[2, 21] < 0.3, gaps


def test_power_density_adds_up(sliding):
    density = wear.friction_power_density(sliding.px, sliding.py, sliding.sx, sliding.sy, VELOC)
    assert float(density.min()) >= 0.0
    assert float(density.sum() * sliding.dx * sliding.dy) == pytest.approx(float(-sliding.friction_power), rel=1e-6)


def test_archard_depth_of_full_sliding(sliding):
    """Depth along y: k/H times slip times the pressure integrated along x, p0 a (1 - y2/b2) pi/2 with p0 a = 3 Fn/(2 pi b)"""
    coefficient, hardness, bb = 1e-4, 3e3, 5.0
    depth = wear.archard_depth(sliding.pn.values, sliding.sx.values, sliding.sy.values, float(sliding.dx), coefficient, hardness)
    y = float(sliding.y_first) + float(sliding.dy) * np.arange(41)
    exact = coefficient / hardness * SLIP * 1.5 * FN / (np.pi * bb) * np.maximum(0.0, 1 - (y / bb)**2) * np.pi / 2
    np.testing.assert_allclose(depth, exact, atol=0.02 * exact.max())
    # what is worn off in all is Archard's volume, whatever the pressures
    volume = depth.sum() * float(sliding.dy)
    assert volume == pytest.approx(coefficient * FN * SLIP / hardness, rel=0.003)
    with pytest.raises(ValueError):
        wear.archard_depth(1.0, 0.0, 0.0, 1.0, 1e-4, 0.0)


def test_fatigue_index_is_zero_at_the_limit():
    """f = k/p0, with p0 of Hertz"""
    aa, bb, yielding = 6.0, 5.0, 300.0
    p0 = 1.5 * FN / (np.pi * aa * bb)
    assert wear.surface_fatigue_index(yielding / p0 * FN, 0.0, FN, aa, bb, yielding) == pytest.approx(0.0, abs=1e-12)
    assert wear.surface_fatigue_index(0.0, 0.4 * FN, FN, aa, bb, yielding) == pytest.approx(0.4 - yielding / p0)


def test_shakedown_map():
    np.testing.assert_allclose(wear.shakedown_limit([0.0, 0.25, 0.5, 1.0]), [4.0, 4.0, 2.0, 1.0])
    assert wear.shakedown_state(1200.0, 0.1, 300.0) == pytest.approx(1.0)
    assert wear.shakedown_state(1200.0, 0.5, 300.0) == pytest.approx(2.0)


def test_wear_index():
    np.testing.assert_allclose(wear.wear_index(np.array([100.0, 0.0]), np.array([50.0, 0.0])), [2.0, 0.0])
