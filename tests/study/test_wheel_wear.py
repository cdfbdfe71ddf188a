"""Wear of a wheel: volumes of Archard and Braghin, conservation by smoothing, profiles read back unchanged, the example."""
import os
import subprocess
import sys

import contact
import numpy as np
import pytest
from bases import EXAMPLES, rolling
from contact import wear
from contact.wheel_wear import Profile, depth_per_revolution, smoothed, wear_of_rail, wear_of_wheel

K_ARCHARD = 2e-3
S1002 = EXAMPLES / "profiles/S1002.prw"


def test_rate_joins_its_branches():
    np.testing.assert_allclose(wear.braghin_rate([0.0, 1.0, 10.4, 50.0, 77.2, 87.2]), [0.0, 5.3, 55.12, 55.12, 55.12, 674.12])


def test_worn_mass_of_full_sliding_is_that_of_t_gamma():
    """In mild wear the mass per metre is 5.3 T-gamma, independent of the pressures"""
    base = rolling(21)
    base["grid"]["scale"] = 1.05
    found = contact.Study(base, {"kinematics.cksi": [0.02]}, fields=["px", "py", "sx", "sy"]).run(workers=1).isel(cksi=0)
    fields = [found[name].values for name in ("px", "py", "sx", "sy")]
    assert np.abs(fields[0] * fields[2]).max() < 10.4
    depth = wear.braghin_depth(*fields, float(found.dx))
    # mm2 a passage: microgram per m and mm2, times m, over microgram per mm3
    exact = 5.3 * 0.3 * 70000.0 * 0.02 * 1e-3 / 7800.0
    assert depth.sum() * float(found.dy) == pytest.approx(exact, rel=0.02)


def test_smoothing_loses_nothing():
    values = np.zeros(200)
    values[[3, 90, 199]] = [1.0, 2.0, 0.5]
    for width in (0.0, 1.0, 4.0):
        found = smoothed(values, 0.25, width)
        assert found.sum() == pytest.approx(values.sum(), rel=1e-12) and found.min() >= 0.0
    # Gaussian weights: variances add
    place = np.arange(200) * 0.25
    one = smoothed(np.eye(200)[100], 0.25, 2.0)
    assert ((place - 25.0)**2 * one).sum() == pytest.approx(4.0, rel=0.01)


def test_profile_is_kept_by_file_and_mesh(tmp_path):
    profile = Profile.read(S1002)
    height, thickness, slope = profile.flange()
    assert (height, thickness) == (pytest.approx(28.0, abs=0.02), pytest.approx(32.5, abs=0.05)) and 10.0 < slope < 11.5
    again = profile
    for _ in range(40):
        again = again.meshed(0.25)
    tread = np.linspace(-30.0, 50.0, 300)
    np.testing.assert_allclose(again.height_at(tread), profile.height_at(tread), atol=2e-3)
    again.write(tmp_path / "again.prw", "meshed")
    read = Profile.read(tmp_path / "again.prw")
    np.testing.assert_allclose(read.z, again.z, atol=1e-9)
    # a uniform depth moves the tread inwards, and the flange face away from the rail
    thinner = profile.worn(np.full(len(profile.y), 0.1))
    assert float(thinner.height_at(0.0) - profile.height_at(0.0)) == pytest.approx(-0.1, abs=1e-3)
    assert thinner.y[np.abs(profile.y + 38.0).argmin()] < profile.y[np.abs(profile.y + 38.0).argmin()]
    with pytest.raises(contact.ContactError, match="Simpack"):
        Profile.read(EXAMPLES / "profiles/groove.txt")


def test_profile_of_a_rail(tmp_path):
    rail = Profile.read(EXAMPLES / "profiles/60E1.prr")
    rail.meshed(0.25).write(tmp_path / "again.prr", "meshed")
    again = Profile.read(tmp_path / "again.prr")
    head = np.linspace(-30.0, 30.0, 200)
    assert again.is_rail and not Profile.read(S1002).is_rail
    np.testing.assert_allclose(again.height_at(head), rail.height_at(head), atol=2e-3)
    # a uniform depth lowers the head, and moves the gauge face away from the flange
    thinner = rail.worn(np.full(len(rail.y), 0.1))
    assert float(thinner.height_at(0.0) - rail.height_at(0.0)) == pytest.approx(0.1, abs=1e-3)
    assert thinner.y[0] - rail.y[0] == pytest.approx(0.1, rel=0.01) and rail.y[-1] - thinner.y[-1] == pytest.approx(0.1, rel=0.01)


def one_place(step, profile):
    return {"position.y_ws": [0.0, 2.0]}, [3.0, 1.0]


def base():
    case = contact.read(EXAMPLES / "wheel_on_rail.toml")[0]
    case["search"].update(dx=2.0, ds=2.0)
    return case


def archard(pn, px, py, sx, sy, dx):
    return wear.archard_depth(pn, sx, sy, dx, coefficient=K_ARCHARD, hardness=3e3)


def test_depth_lies_where_the_contact_is_with_archards_volume():
    """Volume per revolution: K/H times force times slip, here with nearly full sliding of a braked wheel"""
    case = base()
    case["velocity"]["vpitch"] = -40.0
    profile = Profile.read(S1002).meshed(0.25)
    study = contact.Study(case, contact.study.table({"position.y_ws": [0.0]}), fields=["pn", "px", "py", "sx", "sy"],
                          base_folder=EXAMPLES)
    found = study.run(workers=1)
    depth = depth_per_revolution(found, archard, profile, [1.0])
    area = float((depth * np.gradient(np.abs(profile.lengths()))).sum())
    slip = abs(float(found.cksi.squeeze()))
    assert area == pytest.approx(K_ARCHARD / 3e3 * 60000.0 * slip, rel=0.03)
    worn = profile.y[depth > 0.05 * depth.max()]
    assert worn.min() < float(found.ycp_w.squeeze()) < worn.max() and np.ptp(worn) < 30.0


def test_a_journey(tmp_path):
    """Distances add up, area is depth times width, and an interrupted journey is resumed with the same profile bit by bit"""
    def go(folder, **more):
        return list(wear_of_wheel(base(), one_place, 400.0, archard, folder=folder, base_folder=EXAMPLES, workers=1,
                                  largest_step=0.02, **more))

    states = go(tmp_path / "whole")
    assert states[0].distance == 0.0 and states[-1].distance == 400.0 and len(states) > 2
    last = states[-1]
    assert last.depth.max() <= 0.0201 * (len(states) - 1)
    widths = np.gradient(np.abs(last.profile.lengths()))
    assert last.area > 0.0 and (last.depth * widths).sum() == pytest.approx(last.area, rel=1e-3)
    # the loss of the section is the worn area
    tread = np.linspace(-35.0, 55.0, 4000)
    gone = np.trapezoid(states[0].profile.height_at(tread) - last.profile.height_at(tread), tread)
    assert gone == pytest.approx(last.area, rel=0.02)
    go(tmp_path / "parts", stop=lambda: True)
    again = go(tmp_path / "parts")
    np.testing.assert_array_equal(again[-1].profile.z, last.profile.z)
    with pytest.raises(contact.ContactError, match="negative or no number"):
        list(wear_of_wheel(base(), one_place, 1.0, lambda *fields: -archard(*fields), folder=tmp_path / "wrong",
                           base_folder=EXAMPLES, workers=1))


def test_a_rail_wears_where_its_contacts_are(tmp_path):
    """The loss of the section is the worn area, and the program reads the worn rail"""
    wheels = 0.3
    states = list(wear_of_rail(base(), one_place, wheels, archard, folder=tmp_path / "rail", base_folder=EXAMPLES, workers=1,
                               largest_step=0.02))
    first, last = states[0], states[-1]
    assert last.distance == wheels and len(states) > 2 and last.area > 0.0
    head = np.linspace(-34.0, 34.0, 4000)
    gone = np.trapezoid(last.profile.height_at(head) - first.profile.height_at(head), head)
    assert gone == pytest.approx(last.area, rel=0.02)
    case = base()
    case["rail_profile"]["file"] = str(max((tmp_path / "rail").glob("rail_*.prr")))
    found = contact.Study(case, contact.study.table({"position.y_ws": [0.0]}), base_folder=EXAMPLES).run(workers=1)
    assert (found.status == 0).all()


def test_depth_on_a_rail_lies_where_pressures_are():
    """A depth that is the sum of pressures has its centre at the lateral centre of the pressures, on both bodies"""
    names = ["pn", "px", "py", "sx", "sy"]
    found = contact.Study(base(), contact.study.table({"position.y_ws": [-4.0]}), fields=names, base_folder=EXAMPLES).run(workers=1)
    one = found.isel(row=0, patch=0)
    loads = np.nan_to_num(one.pn.values).sum(axis=1)
    middle = float((loads * (float(one.y_first) + float(one.dy) * np.arange(len(loads)))).sum() / loads.sum())
    for file, place in (("60E1.prr", float(one.ycp_r)), ("S1002.prw", float(one.ycp_w))):
        profile = Profile.read(EXAMPLES / "profiles" / file).meshed(0.1)
        depth = depth_per_revolution(found, lambda pn, px, py, sx, sy, dx: pn.sum(axis=1), profile, [1.0])
        widths = np.gradient(np.abs(profile.lengths()))
        assert (depth * widths).sum() == pytest.approx(loads.sum() * float(one.dy), rel=1e-3)
        at = (depth * widths * profile.lengths()).sum() / (depth * widths).sum()
        assert at - float(profile.length_at(place)) == pytest.approx(middle, abs=0.06)


def test_example_of_a_rail(tmp_path):
    done = subprocess.run([sys.executable, str(EXAMPLES / "studies/rail_wear.py"), "--small", "--folder", str(tmp_path / "study")],
                          capture_output=True, text=True, timeout=250, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    assert "5.00 million wheels" in done.stdout and Profile.read(tmp_path / "study/worn.prr").is_rail


def test_example(tmp_path):
    """The example with few positions: a smooth profile, worn where the contacts are"""
    done = subprocess.run([sys.executable, str(EXAMPLES / "studies/wheel_wear.py"), "--small", "--folder", str(tmp_path / "study")],
                          capture_output=True, text=True, timeout=250, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    assert "2000 km" in done.stdout
    rows = np.loadtxt(tmp_path / "study/wear.csv", delimiter=",", skiprows=1)
    assert rows[-1, 0] == 2000.0 and (np.diff(rows[:, 1]) > 0.0).all()
    before, after = (Profile.read(tmp_path / "study" / name).meshed(0.5) for name in ("wheel_0000.prw", "worn.prw"))
    tread = np.linspace(-25.0, 45.0, 71)
    depth = before.height_at(tread) - after.height_at(tread)
    assert 0.02 < depth.max() < 0.3 and abs(tread[depth.argmax()]) < 25.0
    # no ripples: the depth has few maxima, and its steps are small
    assert np.abs(np.diff(depth, 2)).max() < 0.1 * depth.max()
