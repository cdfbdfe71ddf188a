"""Tables of creep forces: errors against results, Kalker's limit, sliding, symmetries, slopes, other languages, damaged files."""
import copy
import os
import pickle
import re
import subprocess
from concurrent.futures import ThreadPoolExecutor

import contact
import numpy as np
import pytest
from contact.table import Plan, Table, build
from contact.table._results import Results, arms, creepages, sides

FN, MU, GG = 70e3, 0.3, 82e3
LIMIT = MU * FN


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    path = tmp_path_factory.mktemp("tables") / "steel.table"
    facts = build(path, Plan(tolerance=0.04, ratio=(0.5, 2.0), elements=9, points=1000), workers=2)
    assert max(facts.error) <= facts.asked == 0.04 and facts.points == 1000
    return path


@pytest.fixture(scope="module")
def table(file):
    with Table(file) as opened:
        yield opened


def inputs(count, seed=7, spread=2.0):
    """Random contacts with creepages of all magnitudes"""
    random = np.random.default_rng(seed)
    ratio = np.exp(random.uniform(np.log(0.5), np.log(2.0), count))
    aa, bb = 5.0 * np.sqrt(ratio), 5.0 / np.sqrt(ratio)
    unit = LIMIT / (GG * aa * bb) * [[1.0], [1.0], [0.2]] * 10.0**random.uniform(-spread, spread, count)
    return (FN, MU, GG, aa, bb), unit * random.normal(size=(3, count)) / 3.0


def test_error_is_what_the_table_says(table):
    """Errors at independent points, with creepages, forces and sizes that the builder does not use"""
    random = np.random.default_rng(11)
    worst = 0.0
    for aa, bb, mu, fn in ((6.0, 5.0, 0.5, 40e3), (3.0, 5.5, 0.1, 120e3)):
        unit = mu * fn / (GG * aa * bb)
        given = random.normal(size=(60, 3)) * [unit, unit, unit / np.sqrt(aa * bb)] * 10.0**random.uniform(-1, 1, (60, 1))
        base = {"module": "contact", "motion": "steady_rolling", "normal": "force",
                "kinematics": {"fn": fn, "cksi": 0.0, "ceta": 0.0, "cphi": 0.0}, "friction": {"fstat": mu, "fkin": mu},
                "material": {"poiss": [0.28] * 2, "gg": [GG] * 2}, "rolling": {"veloc": 30000.0, "dq": 1.0},
                "grid": {"form": "hertz_axes", "mx": 9, "my": 9, "aa": aa, "bb": bb, "scale": 1.05}, "iteration": {"order": 2}}
        columns = {f"kinematics.{name}": given[:, k] for k, name in enumerate(("cksi", "ceta", "cphi"))}
        found = contact.Study(base, contact.study.table(columns)).run(workers=1)
        forces = table.force(fn, mu, GG, aa, bb, *given.T)
        worst = max(worst, np.hypot(forces[:, 0] - found.fx, forces[:, 1] - found.fy).max() / (mu * fn),
                    np.abs(forces[:, 2] - found.mz).max() / (mu * fn * np.sqrt(aa * bb)))
    assert 0.0 < worst <= table.facts.asked


@pytest.mark.parametrize("ratio, c11, c22, c23", [(0.5, 3.62, 3.01, 0.929), (1.0, 4.12, 3.67, 1.47), (2.0, 5.10, 4.90, 2.62)])
def test_slope_at_rest_is_kalkers(file, ratio, c11, c22, c23):
    """G a b C11 and so on, with the table's Poisson ratio of 0.28 where Kalker's book has 0.25"""
    aa, bb = 5.0 * np.sqrt(ratio), 5.0 / np.sqrt(ratio)
    with Table(file) as table:
        _, slopes = table.derivatives(FN, MU, GG, aa, bb)
    own = slopes / (-GG * aa * bb * np.array([[1.0, 1.0, 5.0]]))
    assert own[0, 0] == pytest.approx(c11, rel=0.08)
    assert own[1, 1] == pytest.approx(c22, rel=0.08)
    assert own[1, 2] == pytest.approx(c23, rel=0.2)
    assert abs(own[0, 1]) + abs(own[0, 2]) + abs(own[1, 0]) < 1e-12


def test_sliding(table):
    """Infinite creepage without spin: the friction bound against it; infinite spin: no force, and the moment of Coulomb friction"""
    forces = table.force(FN, MU, GG, 5.0, 5.0, 3e5, -4e5, 0.0)
    np.testing.assert_allclose(forces / LIMIT, [-0.6, 0.8, 0.0], atol=table.facts.asked)
    forces = table.force(FN, MU, GG, 5.0, 5.0, 0.0, 0.0, 1e9)
    # the mean distance from the centre under Hertz's pressure is 3 pi/16 of the radius
    np.testing.assert_allclose(forces / (LIMIT * np.array([1.0, 1.0, 5.0])), [0.0, 0.0, -3.0 * np.pi / 16.0],
                               atol=table.facts.asked)


def test_never_above_friction(table):
    contacts, given = inputs(50000, spread=4.0)
    forces = table.force(*contacts, *given)
    size = np.hypot(forces[:, 0], forces[:, 1])
    assert 0.9 * LIMIT < size.max() <= LIMIT


def test_symmetries_and_scales(table):
    contacts, (cksi, ceta, cphi) = inputs(500)
    forces = table.force(*contacts, cksi, ceta, cphi)
    np.testing.assert_array_equal(table.force(*contacts, -cksi, ceta, cphi), forces * [-1, 1, 1])
    np.testing.assert_array_equal(table.force(*contacts, cksi, -ceta, -cphi), forces * [1, -1, -1])
    # half the friction with half the creepages; metres instead of millimetres
    np.testing.assert_allclose(table.force(FN, MU / 2, *contacts[2:], cksi / 2, ceta / 2, cphi / 2), forces / 2, rtol=1e-10)
    np.testing.assert_allclose(table.force(FN, MU, GG * 1e6, contacts[3] / 1e3, contacts[4] / 1e3, cksi, ceta, cphi * 1e3),
                               forces * [1, 1, 1e-3], rtol=1e-9, atol=1e-6)


def test_smooth(table):
    """Derivatives agree with finite differences, and their jumps vanish with the step, also where creepages change sign"""
    contacts, given = inputs(3000)
    given[:, ::3] *= [[1e-9], [1.0], [1e-9]]
    unit = LIMIT / (GG * 25.0) * np.array([1.0, 1.0, 0.2])
    forces, slopes = table.derivatives(*contacts, *given)
    for k in range(3):
        step = np.zeros((3, 1))
        step[k] = 1e-6 * unit[k]
        low, high = table.derivatives(*contacts, *(given - step)), table.derivatives(*contacts, *(given + step))
        scale = unit[k] / (LIMIT * np.array([1.0, 1.0, 5.0]))
        assert np.abs(((high[0] - low[0]) / (2e-6 * unit[k]) - slopes[:, :, k]) * scale).max() < 1e-3
        assert np.abs((high[1] - low[1])[:, :, k] * scale).max() < 1e-3
    assert forces.shape == (3000, 3) and slopes.shape == (3000, 3, 3)


def test_no_copies(file):
    """A copy would free the memory of the library a second time, which ended Python"""
    with Table(file) as table:
        for copied in (copy.copy, copy.deepcopy, pickle.dumps):
            with pytest.raises(TypeError, match="a Table cannot be copied or pickled"):
                copied(table)
        assert table.force(FN, MU, GG, 5.0, 5.0, 0.001)[0] < 0.0


def test_threads_see_the_same(table):
    contacts, given = inputs(2000)
    alone = table.force(*contacts, *given)
    with ThreadPoolExecutor(4) as pool:
        for forces in pool.map(lambda _: table.force(*contacts, *given), range(16)):
            np.testing.assert_array_equal(forces, alone)


def test_other_languages(file, table):
    """The same numbers in C and Fortran; a look-up takes less than half a millisecond on any machine"""
    random = np.random.default_rng(3)
    given = random.normal(size=(50, 3)) * [0.003, 0.003, 0.0005]
    forces = table.force(FN, MU, GG, 6.0, 5.0, *given.T)
    lines = "".join(" ".join(repr(float(value)) for value in row) + "\n" for row in given)
    patch = ["70e3", "0.3", "82e3", "6.0", "5.0", "5.0"]
    for command, text in (([os.environ["CONTACT_TABLE_C"], str(file), *patch], lines),
                          ([os.environ["CONTACT_TABLE_F"], str(file)], " ".join(patch) + "\n" + lines)):
        done = subprocess.run(command, input=text, capture_output=True, text=True, check=True, timeout=60)
        np.testing.assert_allclose(np.loadtxt(done.stdout.splitlines()), forces, rtol=1e-14, atol=1e-9)
        for line in done.stderr.splitlines():
            print(line)
            assert float(line.split()[-2]) < 5e5


def test_errors_are_reported(table, file, tmp_path):
    with pytest.raises(contact.ContactError, match=r"a/b from 0.5 to 2 and no offset"):
        table.force(FN, MU, GG, 30.0, 5.0, 0.001)
    assert table.force(FN, MU, GG, 30.0, 5.0, 0.001, outside=True)[0] < 0.0
    with pytest.raises(contact.ContactError, match="no number"):
        table.force(FN, MU, GG, 5.0, 5.0, float("nan"))
    whole = file.read_bytes()
    bad = tmp_path / "bad.table"
    turned = whole[:5000] + bytes([whole[5000] ^ 1]) + whole[5001:]
    for content, words in ((whole[:-100], "damaged"), (turned, "checksum"), (b"x" * 300, "start")):
        bad.write_bytes(content)
        with pytest.raises(contact.ContactError, match=words) as caught:
            Table(bad)
        assert "\n" not in str(caught.value) and "bad.table" in str(caught.value)
    for plan, words in ((Plan(tolerance=0.5), "tolerance"), (Plan(ratio=(2.0, 1.0)), "a/b"), (Plan(offset=1.0), "offset"),
                        (Plan(ratio=(0.5, 2.0), elements=9, most_cases=100), "more than 100 solutions")):
        with pytest.raises(contact.ContactError, match=words):
            build(tmp_path / "none.table", plan)
    assert not (tmp_path / "none.table").exists()


def test_nodes_are_solved_where_they_are_needed(tmp_path, monkeypatch):
    """A table of forces with a bend across all axes reaches the requested error, with fewer results than nodes"""
    messages, solved = [], []

    class Bent:
        """Replacement of contacts: a moment with a bend at y + 0.9 z = 0.3"""

        def __init__(self, *_):
            self.cases = 0

        def at(self, points, _=None):
            self.cases += len(points)
            solved.append(self.cases)
            _, _, x, y, z = points.T
            return np.column_stack([-0.5 * x, -0.5 * y, -0.5 * z * np.abs(y + 0.9 * z - 0.3)])

    monkeypatch.setattr("contact.table._build.Results", Bent)
    facts = build(tmp_path / "bent.table", Plan(tolerance=0.003, ratio=(0.8, 1.25), elements=9, points=3000), workers=1,
                  tell=messages.append)
    nodes = np.prod([int(count) for count in re.search(r"solutions, (.*) nodes", messages[-2])[1].split(" x ")])
    assert max(facts.error) <= 0.003 and facts.points == 3000
    # points of the checks are not part of the table; the number of checks depends on round-off
    checked = facts.points * sum("checked at" in line for line in messages)
    assert solved[-1] - checked < 0.7 * nodes


def test_few_elements_where_most_slides():
    """Against a grid three times as fine: errors are smaller there than elsewhere, although there are fewer elements"""
    random = np.random.default_rng(3)
    points = random.uniform([np.log(0.5), 0.0, 0.0, -1.0, 0.0], [np.log(2.0), 0.0, 1.0, 1.0, 0.85], (150, 5))
    radius = np.sqrt(np.hypot(points[:, 2]**2, points[:, 3]**2))
    points, radius = points[radius < 1.0], radius[radius < 1.0]
    size = sides(points, 15).min(axis=1)
    assert set(size[radius < 0.4]) == {15} and size[radius > 0.9].max() <= 9
    gap = Results(0.28, 15, False, 2).at(points) - Results(0.28, 45, False, 2).at(points)
    error = np.maximum(np.hypot(gap[:, 0], gap[:, 1]), np.abs(gap[:, 2]))
    assert error.max() < 6e-3 and error[radius > 0.6].max() < 1.5e-3 and error[radius > 0.8].max() < 4e-4


def test_half_ellipses(tmp_path):
    """Symmetries hold, errors are below the stated one, and without offset the contact is an ellipse with prescribed pressures"""
    facts = build(tmp_path / "halves.table", Plan(tolerance=0.12, ratio=(0.95, 1.05), offset=0.3, spin=1.5, elements=7, points=200),
                  workers=2)
    assert facts.has_offset and facts.offset == 0.3 and max(facts.error) <= 0.12
    with Table(tmp_path / "halves.table") as table:
        forces = table.force(FN, MU, GG, 5.0, 5.0, 0.001, 0.002, 0.0004, offset=0.2)
        mirrored = table.force(FN, MU, GG, 5.0, 5.0, 0.001, -0.002, -0.0004, offset=-0.2)
        np.testing.assert_allclose(mirrored, forces * [1, -1, -1], rtol=1e-12)
        assert not np.allclose(table.force(FN, MU, GG, 5.0, 5.0, 0.001, 0.002, 0.0004, offset=-0.2), forces, rtol=1e-3)
        points = np.array([[0.0, 0.2, 0.2, 0.1, 0.3]])
        given = creepages(points) * LIMIT / (GG * 25.0) * [1.0, 1.0, 0.2]
        own = Results(0.28, 9, True, 1).at(points)[0]
        # about the middle of both extents
        own[2] -= arms(points)[0] * own[0]
        np.testing.assert_allclose(table.force(FN, MU, GG, 5.0, 5.0, *given[0], offset=0.2) / (LIMIT * np.array([1, 1, 5.0])), own,
                                   atol=0.12)
        # sliding without spin acts in the middle of the pressures, 3/8 of each extent from the widest row
        middle = 0.5 * (4.0 - 6.0) + 3.0 / 8.0 * (6.0**2 - 4.0**2) / (6.0 + 4.0)
        forces = table.force(FN, MU, GG, 5.0, 5.0, 1e5, 0.0, 0.0, offset=0.2)
        np.testing.assert_allclose(forces / LIMIT, [-1.0, 0.0, middle], atol=0.06)
        # derivatives agree with finite differences, with the moment about the middle of both extents
        given = np.array([[0.002], [-0.001], [0.0003]]) * np.linspace(0.1, 3.0, 20)
        _, slopes = table.derivatives(FN, MU, GG, 5.0, 5.0, *given, offset=0.2)
        for k, unit in enumerate((1e-3, 1e-3, 2e-4)):
            step = np.zeros((3, 1))
            step[k] = 1e-6 * unit
            high, low = (table.force(FN, MU, GG, 5.0, 5.0, *(given + sign * step), offset=0.2) for sign in (1, -1))
            gap = (high - low) / (2e-6 * unit) - slopes[:, :, k]
            assert np.abs(gap * unit / (LIMIT * np.array([1, 1, 5.0]))).max() < 1e-4


def test_command(file, tmp_path):
    def run(path, *words):
        command = [os.environ["CONTACT_PROGRAM"], "table", str(path), *words]
        return subprocess.run(command, capture_output=True, text=True, timeout=200)

    about = run(file, "--about")
    assert "a/b from 0.5 to 2" in about.stdout and "at 1000 random points" in about.stdout
    made = run(tmp_path / "new.table", "--tolerance", "0.15", "--ratio", "0.8", "1.25", "--spin", "0.6", "--elements", "7",
               "--points", "200", "--workers", "1")
    assert made.returncode == 0 and "new.table is written: ellipses" in made.stdout and "solutions" in made.stderr
    with Table(tmp_path / "new.table") as narrow:
        assert narrow.facts.spin == pytest.approx(0.6)
        with pytest.raises(contact.ContactError, match=r"spins up to 0.6"):
            narrow.force(FN, MU, GG, 5.0, 5.0, 0.0, 0.0, 1.0)
        forces, slopes = narrow.derivatives(FN, MU, GG, 5.0, 5.0, 0.001, 0.001, 1.0, outside=True)
        assert abs(forces[1]) > 0.0 and not slopes[:, 2].any()
    wrong = run(tmp_path / "no.table", "--tolerance", "2")
    assert wrong.returncode == 1 and wrong.stderr.startswith("contact table: the tolerance")
