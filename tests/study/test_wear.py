"""Wear and fatigue: against the integrals of Hertzian contacts in full sliding, and corners of the maps."""
import json
import os
import subprocess

import contact
import numpy as np
import pytest
from bases import EXAMPLES, rolling
from contact import wear
from contact.study._scene import write_case

MU, FN, SLIP, VELOC = 0.3, 70000.0, 0.2, 30000.0
ARCHARD, HARDNESS, YIELD = 1e-4, 3e3, 300.0
ASKED = {"archard": ARCHARD, "hardness": HARDNESS, "shear_yield": YIELD}
P0 = 1.5 * FN / (np.pi * 6.0 * 5.0)


@pytest.fixture(scope="module")
def sliding():
    """A Hertzian contact in full sliding along x"""
    base = rolling(41)
    base["grid"]["scale"] = 1.05
    return contact.Study(base, {"kinematics.cksi": [SLIP]}, fields=["pn", "px", "py", "sx", "sy"], derive={
        "t_gamma": lambda data: wear.t_gamma(data.fx, data.fy, data.cksi, data.ceta)}).run(workers=1).isel(cksi=0)


def test_t_gamma_of_full_sliding(sliding):
    assert float(sliding.t_gamma) == pytest.approx(MU * FN * SLIP, rel=1e-4)


def test_t_gamma_is_what_refinement_finds():
    """In steady rolling only friction dissipates energy: the difference from the frictional power decreases with the element size,
    and with its square by the second order"""
    gaps = {}
    for order in (1, 2):
        for n in (21, 41):
            base = rolling(n)
            base["iteration"] = {"order": order}
            base["kinematics"].update(cksi=0.0005, ceta=0.0008, cphi=0.0002)
            found = contact.Study(base).run(workers=1)
            # all three terms have the same sign here
            dissipation = wear.t_gamma(found.fx, found.fy, 0.0005, 0.0008, found.mz, 0.0002)
            gaps[order, n] = float(dissipation + 1e3 * found.friction_power / VELOC) / float(dissipation)
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
    # the total worn volume is Archard's, independent of the pressures
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


def largest_shear(traction):
    """Of a line contact that slides, along the surface, over p0: McEwen's stresses on a grid (Johnson, 4.49 and 7.2)"""
    x, z = np.linspace(-1.5, 1.5, 1201)[:, None], np.linspace(1e-9, 1.0, 801)[None, :]
    s = 1 - x**2 + z**2
    root = np.sqrt(s**2 + 4 * x**2 * z**2)
    m, n = np.sqrt(np.maximum(0.0, 0.5 * (root + s))), np.sign(x) * np.sqrt(np.maximum(0.0, 0.5 * (root - s)))
    square = m**2 + n**2 + 1e-300
    along = -(m * (1 + (z**2 + n**2) / square) - 2 * z)
    return np.abs(-n * (m**2 - z**2) / square + traction * along).max()


def test_shakedown_map():
    for traction in (0.0, 0.1, 0.2, 0.3, 0.36, 0.37, 0.6):
        assert wear.shakedown_limit(traction) == pytest.approx(1.0 / largest_shear(traction), rel=2e-5)
    np.testing.assert_allclose(wear.shakedown_limit([0.0, 0.5, 1.0]), [4.0, 2.0, 1.0])
    # continuous at the transition to failure at the surface
    edge = wear._SURFACE_TRACTION
    assert wear.shakedown_limit(edge - 1e-12) == pytest.approx(wear.shakedown_limit(edge), rel=1e-5)
    assert wear.shakedown_state(1200.0, 0.0, 300.0) == pytest.approx(1.0)
    assert wear.shakedown_state(1200.0, 0.5, 300.0) == pytest.approx(2.0)


def test_wear_index():
    np.testing.assert_allclose(wear.wear_index(np.array([100.0, 0.0]), np.array([50.0, 0.0])), [2.0, 0.0])


def sliding_case(cksi=SLIP, n=41, **more):
    """The case of full sliding, or another one, with wear"""
    base = rolling(n)
    base["grid"]["scale"] = 1.05
    base["kinematics"]["cksi"] = cksi
    return {**base, "wear": dict(ASKED), **more}


def test_totals_of_full_sliding():
    """Results of the library: friction is the coefficient times the pressure everywhere, and slip is the creepage"""
    found = contact.Study(sliding_case(), fields=["power", "wear"]).run(workers=1)
    area = np.pi * 6.0 * 5.0
    for name, exact, accuracy in (("t_gamma", MU * FN * SLIP, 1e-5), ("wear_index", MU * FN * SLIP / area, 5e-3),
                                  ("max_power", 1e-3 * MU * P0 * SLIP * VELOC, 2e-3), ("traction", MU, 1e-5),
                                  ("max_wear", ARCHARD / HARDNESS * SLIP * P0 * 6.0 * np.pi / 2, 5e-3),
                                  ("worn_section", ARCHARD / HARDNESS * SLIP * FN, 1e-5), ("shakedown_load", P0 / YIELD, 2e-3),
                                  ("shakedown", P0 / YIELD * largest_shear(MU), 2e-3), ("fatigue_index", MU - YIELD / P0, 2e-2)):
        assert float(found[name]) == pytest.approx(exact, rel=accuracy), name
    assert float(found.power.sum() * found.dx * found.dy) == pytest.approx(float(-found.friction_power), rel=1e-9)
    assert float(found.wear.sum() * found.dy) == pytest.approx(float(found.worn_section), rel=1e-9)
    assert found.t_gamma.attrs["units"] == "N" and found.wear.attrs["units"] == "mm"


def test_totals_are_those_of_the_functions():
    """Partial slip, with spin about a point other than the middle"""
    base = sliding_case(0.001)
    base["kinematics"].update(ceta=-0.0005, cphi=0.0003, spinxo=1.0, spinyo=-2.0)
    found = contact.Study(base, fields=["pn", "sx", "sy"]).run(workers=1)
    mz = found.mz - 2.0 * found.fx - 1.0 * found.fy
    t_gamma = wear.t_gamma(found.fx, found.fy, 0.001, -0.0005, mz, 0.0003)
    traction = float(np.hypot(found.fx, found.fy) / FN)
    depth = wear.archard_depth(found.pn.values, found.sx.values, found.sy.values, float(found.dx), ARCHARD, HARDNESS)
    for name, expected in (("t_gamma", t_gamma), ("wear_index", wear.wear_index(t_gamma, found.contact_area)),
                           ("max_wear", depth.max()), ("shakedown", wear.shakedown_state(found.pmax, traction, YIELD)),
                           ("fatigue_index", traction - YIELD / float(found.pmax))):
        assert float(found[name]) == pytest.approx(float(expected), rel=1e-9), name


def test_stresses_below_the_surface():
    """On the axis of a circular contact without friction; von Mises and Tresca are the same there"""
    base = sliding_case(motion="none")
    del base["rolling"], base["friction"]
    base["kinematics"] = {"fn": FN}
    base["grid"].update(aa=5.0, bb=5.0)
    depths = [0.1 * k for k in range(1, 60)]
    base["stress_points"] = [{"points": "free", "x": [0.0], "y": [0.0], "z": depths}]
    base["stress_output"] = {"matfil_s": 0, "output_s": 0}
    found = contact.Study(base).run(workers=1)
    zeta = np.array(depths) / 5.0
    across = -(1.28 * (1 - zeta * np.arctan(1 / zeta)) - 0.5 / (1 + zeta**2))
    exact = np.abs(across + 1 / (1 + zeta**2)).max() * 1.5 * FN / (np.pi * 25.0)
    assert float(found.max_mises) == pytest.approx(exact, rel=3e-3)
    assert float(found.max_tresca) == pytest.approx(exact, rel=3e-3)
    assert "t_gamma" not in found and "max_wear" not in found


def test_a_shift_wears():
    """Full sliding by 0.1 mm: depth is pressure times distance"""
    base = sliding_case(0.1, motion="shift")
    del base["rolling"]
    base["iteration"] = {"eps": 1e-8}
    found = contact.Study(base, fields=["pn", "sx", "sy", "wear"]).run(workers=1)
    np.testing.assert_allclose(found.wear, ARCHARD / HARDNESS * found.pn * np.hypot(found.sx, found.sy), rtol=1e-12)
    assert float(found.max_wear) == float(found.wear.max()) > 0.0


def test_nothing_is_told_unasked(tmp_path):
    base = sliding_case()
    del base["wear"]
    found = contact.Study(base, fields=["power", "wear"]).run(workers=1)
    assert (found.status == 0).all() and not {"t_gamma", "traction", "power", "wear"} & set(found.variables)


def test_wear_ends(tmp_path):
    """Wear is switched off after a case without all of its fields: no depth without Archard's coefficient"""
    first = sliding_case()
    first["wear"] = {"shear_yield": YIELD}
    last = {"wear": {"model": "none"}}
    (tmp_path / "ends.toml").write_text("".join(write_case(case) for case in (first, last)))
    subprocess.run([os.environ["CONTACT_PROGRAM"], "--json", "2", "ends"], cwd=tmp_path, check=True, capture_output=True)
    lines = [json.loads(line) for line in (tmp_path / "ends.jsonl").read_text().splitlines()]
    with_wear, without = [line["patches"][0]["totals"] for line in lines if line["case"]]
    assert "t_gamma" in with_wear and "t_gamma" not in without
    assert without["fx"]["value"] == pytest.approx(with_wear["fx"]["value"], rel=1e-9)


def test_what_cannot_be_is_refused():
    base = sliding_case()
    base["wear"] = {"archard": ARCHARD}
    assert "hardness" in str(contact.Study(base).run(workers=1).reasons.values)
    turned = sliding_case()
    turned["rolling"]["chi"] = 0.5
    assert "along x" in str(contact.Study(turned).run(workers=1).reasons.values)


def test_results_of_python_objects():
    with contact.Problem(units="si") as problem:
        problem.set_material(82e9, 0.28)
        problem.set_friction(MU)
        problem.set_hertz(41, 41, aa=6e-3, bb=5e-3, scale=1.05)
        problem.set_normal_force(FN)
        problem.set_rolling(30.0, 1e-3)
        problem.set_creepages(SLIP)
        assert problem.solve().wear is None
        problem.set_wear(ARCHARD, 3e9, 300e6)
        found = problem.solve()
    mm = contact.Study(sliding_case()).run(workers=1)
    for name, factor in (("t_gamma", 1.0), ("wear_index", 1e6), ("max_power", 1.0), ("max_wear", 1e-3), ("worn_section", 1e-6),
                         ("traction", 1.0), ("shakedown", 1.0), ("fatigue_index", 1.0)):
        assert found.wear[name] == pytest.approx(float(mm[name]) * factor, rel=1e-6), name
    assert found.power.max() == pytest.approx(found.wear["max_power"], rel=1e-12)
    assert found.wear_depth.sum(axis=1).max() == pytest.approx(found.wear["max_wear"], rel=1e-9)


def test_files_of_wheel_and_rail(tmp_path):
    """JSON, HDF5 and both sides of the track: the left wheel is the mirror image of the right one"""
    cases = contact.read(EXAMPLES / "wheel_on_rail.toml")[:1]
    cases[0]["wear"] = dict(ASKED)
    cases[0].pop("title", None)
    cases.append({"configuration": "left_on_track", "sequence": "initiate"})
    for group in ("rail_profile", "wheel_profile"):
        cases[0][group]["file"] = str(EXAMPLES / cases[0][group]["file"])
    (tmp_path / "pair.toml").write_text("".join(write_case(case) for case in cases))
    subprocess.run([os.environ["CONTACT_PROGRAM"], "--json", "--hdf5", "2", "pair"], cwd=tmp_path, check=True,
                   capture_output=True)
    lines = [json.loads(line) for line in (tmp_path / "pair.jsonl").read_text().splitlines()]
    right, left = [[patch["totals"] for patch in line["patches"]] for line in lines if line["case"]]
    whole = contact.load(tmp_path / "pair.h5")
    for one, other, stored in zip(right, left, whole[0].patches):
        assert one["t_gamma"]["value"] > 0.0 and one["max_wear"]["value"] > 0.0
        for name in ("t_gamma", "max_wear", "shakedown", "fatigue_index"):
            assert one[name]["value"] == pytest.approx(other[name]["value"], rel=1e-9)
            assert stored.totals()[name] == pytest.approx(one[name]["value"], rel=1e-12)
        assert stored.fields()["power"].max() == pytest.approx(one["max_power"]["value"], rel=1e-9)
        assert stored.fields()["wear"].shape == stored.fields()["pn"].shape
