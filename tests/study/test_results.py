"""Results of studies against other interfaces of the library, against themselves in another order, and their files."""
import json
import os
import subprocess

import contact
import numpy as np
import pandas
import pytest
import xarray
from bases import EXAMPLES, rolling
from contact import _library
from contact.study import _dataset, _engine, _study, sample, save, span
from contact.study._parts import numbers_of, places
from contact.study._scene import Scene
from contact.study._store import FILE, Store, distinct

SLIPS = {"kinematics.cksi": [0.0, 0.002, -0.005], "kinematics.cphi": [0.0, 0.0004]}
PAIR = EXAMPLES / "wheel_on_rail.toml"
#: A wheel in contact on the tread, at the flange, and beside the rail, on coarse elements
PLACES = {"position.y_ws": [-1.0, 5.0, 60.0], "search.dx": [0.8], "search.ds": [0.8]}


def same(one, other, names=None):
    """Are two datasets identical bit by bit?"""
    for name in names or one.data_vars:
        if one[name].dtype.kind == "f":
            assert one[name].values.tobytes() == other[name].values.tobytes(), name
        elif name not in ("reason", "reasons"):
            np.testing.assert_array_equal(one[name].values, other[name].values)


@pytest.mark.parametrize("count, kinds", [(0, 2), (1, 2), (500, 2), (500, 20), (500, 2**63)])
def test_keys_that_are_equal(count, kinds):
    """First positions and indices of keys, by another algorithm of numpy"""
    keys = np.random.default_rng(2).integers(0, kinds, (count, 2)).astype(np.uint64)
    first, inverse = distinct(keys)
    if count:
        np.testing.assert_array_equal(first, np.sort(np.unique(keys, axis=0, return_index=True)[1]))
    assert first.shape == (0,) or (np.diff(first) > 0).all()
    np.testing.assert_array_equal(keys[first][inverse], keys)


def test_totals_are_those_of_the_objects():
    found = contact.Study(rolling(), SLIPS, fields=["pn", "sx"]).run(workers=2)
    assert found.fx.dims == ("cksi", "cphi") and found.fx.attrs["units"] == "N"
    with contact.Problem() as problem:
        problem.set_material(g=82000.0, nu=0.28)
        problem.set_friction(0.3)
        problem.set_hertz(9, 9, aa=6.0, bb=5.0, scale=1.3)
        problem.set_normal_force(70e3)
        problem.set_rolling(30000.0, 1.0)
        for cksi in found.cksi.values:
            for cphi in found.cphi.values:
                problem.set_creepages(cksi, 0.0, cphi)
                result, here = problem.solve(), found.sel(cksi=cksi, cphi=cphi)
                for name in ("fn", "fx", "fy", "mz"):
                    assert float(here[name]) == getattr(result, name), name
                assert here.pmax == result.max_pressure and here.status == 0
                np.testing.assert_array_equal(here.pn, result.pn)
                np.testing.assert_array_equal(here.sx, result.sx)
                assert here.x_first == pytest.approx(result.x[0], rel=1e-12)


def test_wheel_and_rail_as_by_the_program(tmp_path):
    found = contact.Study(PAIR, PLACES, case=1).run(workers=2)
    assert found.fz_tr.dims == ("y_ws", "dx", "ds") and found.fn.dims == ("y_ws", "dx", "ds", "patch")
    text = "".join(Scene(PAIR, 1).text({"position.y_ws": y, "search.dx": 0.8, "search.ds": 0.8})
                   for y in PLACES["position.y_ws"]).replace("profiles/", f"{EXAMPLES}/profiles/")
    (tmp_path / "pair.toml").write_text(text)
    subprocess.run([os.environ["CONTACT_PROGRAM"], "2", "pair", "--json", "--quiet"], cwd=tmp_path, check=False)
    lines = [json.loads(line) for line in (tmp_path / "pair.jsonl").read_text().splitlines()]
    cases = [line for line in lines if "status_code" in line]
    assert len(cases) == 3
    for place, case in enumerate(cases):
        here = found.isel(y_ws=place, dx=0, ds=0)
        assert int(here.status) == case["status_code"]
        if case["status_code"] == 2:
            continue
        for name, total in case["totals"].items():
            name = "y_ws_result" if name == "y_ws" else name
            assert float(here[name]) == (total["value"] if isinstance(total, dict) else total), name
        for number, patch in enumerate(case["patches"]):
            for name, total in patch["totals"].items():
                assert float(here[name][number]) == (total["value"] if isinstance(total, dict) else total), name


@pytest.mark.parametrize("base, vary, case", [
    (rolling(), [SLIPS, {"friction.coefficient": [0.1, 0.5], "grid.aa": [6.0, 2.0]}], None), (PAIR, PLACES, 1)])
def test_results_follow_from_nothing_but_the_inputs(base, vary, case):
    """Results do not depend on order, size of tasks, threads or processes: identical bit by bit"""
    study = contact.Study(base, vary, case=case)
    serial = study.run(workers=1, points_per_task=1)
    same(serial, study.run(workers=1, points_per_task=1000))
    same(serial, study.run(workers=3, points_per_task=2))
    back = {path: list(values)[::-1] for part in (vary if isinstance(vary, list) else [vary]) for path, values in part.items()}
    same(serial, contact.Study(base, back, case=case).run(workers=1, points_per_task=1000)
         .isel({name: slice(None, None, -1) for name in serial.sizes if name not in ("sentence", "patch")}))
    if case is None:
        same(serial, study.run(workers=2, engine="processes"))


def test_words_and_numbers_vary_together():
    vary = {"pressure": ["full", "elliptical"], "grid.form": ["hertz_axes"], "kinematics.cksi": [0.001, 0.003]}
    found = contact.Study(rolling(), vary).run(workers=1)
    for word in vary["pressure"]:
        alone = contact.Study({**rolling(), "pressure": word}, {"kinematics.cksi": vary["kinematics.cksi"]}).run(workers=1)
        np.testing.assert_array_equal(found.fx.sel(pressure=word).values[0], alone.fx.values)


def test_failures_are_data():
    found = contact.Study(rolling(), {"kinematics.cksi": [0.001, float("nan")], "friction.coefficient": [0.3, -1.0]}).run()
    assert found.status.values.tolist() == [[0, 2], [2, 2]]
    assert np.isnan(found.fx.values[found.status.values == 2]).all()
    text = str(found.reasons.values[found.reason.values[0, 1]])
    assert "-1" in text and "fstat" in text
    lines = contact.Study.failures(found).splitlines()
    assert len(lines) == 5 and lines[1].split()[0] == "2", lines
    few = rolling()
    few["iteration"] = {"solver": "default", "maxgs": 1, "maxin": 100, "maxnr": 30, "eps": 1e-9}
    found = contact.Study(few, {"kinematics.cksi": [0.002]}).run()
    assert found.status.values[0] == 1 and np.isfinite(found.fx.values[0]) and found.missed.values[0] > 0
    assert "not converged" in contact.Study.failures(found)
    assert contact.Study.failures(contact.Study(rolling(), {"kinematics.cksi": [0.002]}).run()) == ""


def test_constraints_leave_points_out():
    found = contact.Study(rolling(), SLIPS, where="cksi >= 0", derive={"t_gamma": "-(fx * cksi + mz * cphi)",
                                                                     "ratio": lambda data: data.fx / data.fn}).run()
    assert (found.status.sel(cksi=-0.005) == -1).all() and np.isnan(found.fx.sel(cksi=-0.005)).all()
    np.testing.assert_array_equal(found.t_gamma, -(found.fx * found.cksi + found.mz * found.cphi))
    np.testing.assert_array_equal(found.ratio, found.fx / found.fn)


def test_studies_go_on_and_grow(tmp_path, monkeypatch):
    solved = []
    real = _engine.solve_task
    monkeypatch.setattr(_engine, "solve_task", lambda task: solved.append(len(task)) or real(task))

    def study(values, **more):
        return contact.Study(rolling(), {"kinematics.cksi": values, "friction.coefficient": [0.2, 0.3]}, folder=tmp_path, **more)

    calls = []
    part = study(span(0, 0.01, 11)).run(workers=1, points_per_task=2, stop=lambda: calls.append(1) or len(calls) > 6)
    there = sum(solved)
    assert 0 < there < 22 and (part.status == -2).sum() == 22 - there
    whole = study(span(0, 0.01, 11)).run()
    assert sum(solved) == 22 and (whole.status == 0).all()
    # new values, another order, another form of the description: only new points are computed
    more = study([0.01, 0.0, 0.0035]).run()
    assert sum(solved) == 24
    np.testing.assert_array_equal(more.fx.values[0], whole.fx.values[-1])
    axis = contact.study.Axis("row", {"friction.coefficient": np.array([0.3, 0.2]), "kinematics.cksi": np.array([0.01, 0.0035])})
    contact.Study(rolling(), axis, folder=tmp_path).run()
    assert sum(solved) == 24
    # another base, another field, another version: no stored result is used
    contact.Study(rolling(7), {"kinematics.cksi": [0.01]}, folder=tmp_path).run()
    assert sum(solved) == 25
    study([0.01], fields=["pn"]).run()
    assert sum(solved) == 27
    monkeypatch.setattr(_study, "VERSION", "another")
    study([0.01]).run()
    assert sum(solved) == 29


def test_files_of_profiles_are_part_of_the_key(tmp_path):
    for name in ("60E1.prr", "S1002.prw"):
        (tmp_path / name).write_bytes((EXAMPLES / "profiles" / name).read_bytes())
    case = Scene(PAIR, 1).cases[0]
    case["rail_profile"]["file"], case["wheel_profile"]["file"] = "60E1.prr", "S1002.prw"
    before = Scene(case, folder=tmp_path).digest()
    assert before == Scene(case, folder=tmp_path).digest()
    (tmp_path / "60E1.prr").write_text((tmp_path / "60E1.prr").read_text() + "\n")
    assert before != Scene(case, folder=tmp_path).digest()


def test_contents_of_varied_files_are_part_of_the_key(tmp_path):
    """A profile that varies, and a slice outside of the folder of its slices file, may change between two runs"""
    for name in ("60E1.prr", "S1002.prw"):
        (tmp_path / name).write_bytes((EXAMPLES / "profiles" / name).read_bytes())
    (tmp_path / "worn.prr").write_bytes((EXAMPLES / "profiles" / "60E1.prr").read_bytes())
    case = Scene(PAIR, 1).cases[0]
    case["wheel_profile"]["file"] = "S1002.prw"

    def forces():
        study = contact.Study(case, {"rail_profile.file": ["60E1.prr", "worn.prr"]}, folder=tmp_path / "s", base_folder=tmp_path)
        return study.run(workers=1).fy_tr.values

    first = forces()
    assert first[0] == first[1]
    (tmp_path / "worn.prr").write_bytes((EXAMPLES / "profiles" / "60E1_worn.prr").read_bytes())
    second = forces()
    assert second[0] == first[0] and abs(second[1] - first[1]) > 10.0

    (tmp_path / "a").mkdir()
    (tmp_path / "a" / "rail.slcs").write_text("0 1\n1\n0 0 0\n1\n0.0 '..\\worn.prr'\n")
    case["rail_profile"]["file"] = "a/rail.slcs"
    before = Scene(case, folder=tmp_path).digest()
    (tmp_path / "worn.prr").write_text((tmp_path / "worn.prr").read_text() + "\n")
    assert before != Scene(case, folder=tmp_path).digest()


def test_inputs_and_names_that_contradict_each_other():
    with pytest.raises(contact.ContactError, match=r"friction\.coefficient and friction\.fstat set the same number"):
        contact.Study(rolling(), {"friction.coefficient": [0.2], "friction.fstat": [0.3]})
    with pytest.raises(contact.ContactError, match="derived quantity fx has the name of a result"):
        contact.Study(rolling(), SLIPS, derive={"fx": "2 * fn"}).run()
    with pytest.raises(ValueError, match="masked values"):
        contact.Study(rolling(), {"kinematics.cksi": np.ma.array([0.001, 0.002], mask=[False, True])})
    with pytest.raises(ValueError, match="asks for 'none', which is not there; there are cksi"):
        contact.Study(rolling(), {"kinematics.cksi": [0.001], "kinematics.cphi": lambda inputs: inputs["none"]})


def test_one_study_at_a_time_writes_into_a_folder(tmp_path):
    store = Store(tmp_path)
    with pytest.raises(contact.ContactError, match="another study"):
        contact.Study(rolling(), folder=tmp_path).run()
    store.close()
    (tmp_path / "b").mkdir()
    (tmp_path / "b" / FILE).write_bytes(b"something else" * 100)
    with pytest.raises(contact.ContactError, match="no file of a study"):
        contact.Study(rolling(), folder=tmp_path / "b").run()


def test_files_of_results(tmp_path):
    found = contact.Study(rolling(), [SLIPS, sample({"friction.coefficient": (0.1, 0.5), "kinematics.fn": (1e4, 9e4)}, 4)],
                          where="cksi < 0.001", fields=["pn"]).run()
    for name in ("a.nc", "a.zarr"):
        save(found, tmp_path / name)
    with xarray.open_dataset(tmp_path / "a.nc") as back:
        xarray.testing.assert_equal(found, back.load())
        assert back.fx.encoding["chunksizes"] == (3, 2, 4)
        assert back.fx.attrs == found.fx.attrs
    with xarray.open_zarr(tmp_path / "a.zarr", consolidated=False) as back:
        np.testing.assert_array_equal(found.pn, back.pn)
    save(found, tmp_path / "a.parquet")
    frame = pandas.read_parquet(tmp_path / "a.parquet")
    assert len(frame) == found.status.size
    row = frame[(frame.cksi == 0.0) & (frame.cphi == 0.0004) & (frame["sample"] == 2)]
    assert row.fx.item() == found.fx.sel(cksi=0.0, cphi=0.0004)[2] and row.fn.item() == row.fn_result.item()
    with pytest.raises(contact.ContactError, match=r"\.nc, \.zarr or \.parquet"):
        save(found, tmp_path / "a.xls")


def test_rows_of_long_tables_are_numbered_on(tmp_path, monkeypatch):
    monkeypatch.setattr(_dataset, "_CHUNK", 3)
    found = contact.Study(rolling(7), sample({"kinematics.fn": (1e4, 9e4)}, 8)).run()
    save(found, tmp_path / "a.parquet")
    frame = pandas.read_parquet(tmp_path / "a.parquet")
    assert frame["sample"].tolist() == list(range(8)) and frame.fn.tolist() == found.fn.values.tolist()


@pytest.mark.parametrize("base, vary, case, fields", [
    (rolling(), [{"kinematics.cksi": [0.001, float("nan"), 0.003], "grid.mx": [7, 9], "pressure": ["full", "elliptical"]},
                 {"kinematics.fn": "= 1e4 + 1e7 * cksi"}], None, ["pn", "sx"]),
    (rolling(), [sample({"friction.coefficient": (0.1, 0.5), "kinematics.fn": (1e4, 9e4)}, 12)], None, []),
    (rolling(), None, None, ["pn"]),
    (EXAMPLES / "cattaneo.toml", {"friction.coefficient": [0.2, -1.0, 0.4]}, None, ["px"]),
    (PAIR, PLACES, 1, ["pn"])])
@pytest.mark.parametrize("memory", [1, 1 << 27])
def test_files_by_parts_are_those_of_the_whole(tmp_path, base, vary, case, fields, memory):
    """Results do not depend on the parts, single points or all at once; refused cases, several grid sizes, steps, wheel and rail"""
    study = contact.Study(base, vary, case=case, fields=fields, where="coefficient < 0.45" if case is None and not fields else None,
                          derive={"ratio": "fx / fn"} if case is None else None, folder=tmp_path / "s")
    study.compute(workers=2)
    found = study.results()
    tally = study.write(tmp_path / "a.nc", tmp_path / "a.zarr", tmp_path / "a.parquet", memory=memory)
    assert tally.table() == study.failures(found) and str(tally).startswith(f"{found.status.size} cases: ")
    with xarray.open_dataset(tmp_path / "a.nc") as back, xarray.open_zarr(tmp_path / "a.zarr", consolidated=False) as other:
        for one in (back.load(), other.load()):
            assert sorted(one.variables) == sorted(found.variables) and one.attrs == found.attrs
            for name in found.variables:
                if name in ("reason", "reasons"):
                    continue
                np.testing.assert_array_equal(one[name].values, found[name].values, err_msg=name)
                assert one[name].dims == found[name].dims
                assert {key: np.asarray(value).tolist() for key, value in one[name].attrs.items()} == {
                    key: np.asarray(value).tolist() for key, value in found[name].attrs.items()}
            np.testing.assert_array_equal(one.reasons.values[one.reason.values], found.reasons.values[found.reason.values])
    save(found, tmp_path / "b.parquet")
    # reasons are numbered in the order of their occurrence
    one, other = (pandas.read_parquet(tmp_path / name).drop(columns="reason") for name in ("a.parquet", "b.parquet"))
    order = [name for name in other.columns if name in found.coords]
    pandas.testing.assert_frame_equal(*(frame.sort_values(order, ignore_index=True) if order else frame
                                        for frame in (one[other.columns], other)))
    assert sorted(path.name for path in tmp_path.iterdir()) == ["a.nc", "a.parquet", "a.zarr", "b.parquet", "s"]


def test_parts_cover_the_whole():
    for shape in ((), (1,), (7,), (3, 4, 5), (2, 1, 9)):
        whole = np.arange(int(np.prod(shape))).reshape(shape)
        for most in (1, 2, 5, 13, 1000):
            seen = []
            for place in places(shape, most):
                part = np.arange(whole.size)[numbers_of(shape, place)]
                np.testing.assert_array_equal(whole[place].ravel(), part)
                assert 1 <= len(part) <= max(1, most)
                seen.extend(part)
            assert seen == list(range(whole.size))


def test_parts_need_formulae_and_a_folder(tmp_path):
    study = contact.Study(rolling(), SLIPS, derive={"most": lambda data: data.fx.max()}, folder=tmp_path / "s")
    study.compute(workers=1)
    with pytest.raises(contact.ContactError, match="most is derived by a function"):
        study.write(tmp_path / "a.nc")
    assert str(study.write()).startswith("6 cases: 6 solved")
    with pytest.raises(contact.ContactError, match="needs a folder"):
        contact.Study(rolling(), SLIPS).compute()
    with pytest.raises(contact.ContactError, match=r"\.nc, \.zarr or \.parquet"):
        contact.Study(rolling(), SLIPS, folder=tmp_path / "s").write(tmp_path / "a.xls")


def test_a_process_that_dies_costs_its_case_only(monkeypatch):
    """A case that kills its worker is refused after some attempts; all others are computed"""
    import deadly
    found = contact.Study(rolling(), {"kinematics.cksi": [0.001, 0.002, 0.003, 0.004]})
    engine = contact.study.Engine(2, "processes")
    keys = found.keys()
    tasks = iter([found._task(np.arange(4), keys)])
    monkeypatch.setattr(_engine, "solve_task", deadly.solve)
    done = list(engine.run(lambda: next(tasks, None)))
    assert sum(len(one.keys) for one in done) == 4
    dead = [one for one in done if one.states[:, :, 0].any()]
    assert len(dead) == 1 and len(dead[0].keys) == 1 and "several times" in dead[0].reasons["0,0"]


def test_another_library_computes_anew(tmp_path, monkeypatch):
    """Stored results are used only with the library that computed them, identified by the hash of its file"""
    def study():
        return contact.Study(rolling(), {"kinematics.cksi": [0.001, 0.002]}, folder=tmp_path)

    study().run(workers=1)
    assert study().explain().there == 2
    assert _library.fingerprint() == _library.fingerprint() and len(_library.fingerprint()) == 32
    other = tmp_path / "other.so"
    other.write_bytes(b"another one")
    monkeypatch.setattr(_study, "fingerprint", lambda: _library._digest(str(other), 11, 0))
    assert study().explain().there == 0


def test_contacts_of_other_sizes_do_not_know_each_other():
    """Load, stiffness and shape vary: each case has its own grid, independent of the previous case"""
    inputs = {"kinematics.fn": [30e3, 90e3], "material.gg": [40e3, 82e3], "grid.form": ["hertz_axes"]}
    whole = contact.Study(rolling(), inputs)
    found = whole.run(workers=1)
    for workers, points in ((1, 1), (2, 1), (2, 2)):
        same(found, contact.Study(rolling(), inputs).run(workers=workers, points_per_task=points))
    turned = contact.Study(rolling(), {path: values[::-1] for path, values in inputs.items()}).run(workers=1)
    same(found, turned.isel(fn=slice(None, None, -1), gg=slice(None, None, -1)))
    for fn in inputs["kinematics.fn"]:
        for gg in inputs["material.gg"]:
            base = rolling()
            base["kinematics"]["fn"] = fn
            base["material"]["gg"] = [gg, gg]
            alone = contact.Study(base).run(workers=1)
            one = found.sel(fn=fn, gg=gg).isel(form=0)
            assert all(alone[name].values.tobytes() == one[name].values.tobytes() for name in ("fx", "pmax", "pen", "contact_area"))
            # Hertz with prescribed semi-axes
            assert float(one.pmax) == pytest.approx(1.5 * fn / (np.pi * 30.0), rel=0.02)
