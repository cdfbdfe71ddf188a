"""Varied inputs: axes, samples, tables, rules, constraints; the estimate before a study; refused descriptions."""
import contact
import numpy as np
import pandas
import pytest
from bases import EXAMPLES, rolling
from contact.study import log_span, sample, span, table
from contact.study._expression import evaluate, names_in
from contact.study._progress import Progress, duration
from contact.study._scene import write_case
from contact.study._space import make_space


def test_axes_make_a_grid_in_order():
    space = make_space({"kinematics.cksi": [1, 2, 3], "friction.fstat": span(0.1, 0.2, 2), "pressure": ["full", "kpec"]}, None)
    assert space.shape == (3, 2, 2)
    columns = space.columns()
    np.testing.assert_array_equal(columns["kinematics.cksi"], np.repeat([1.0, 2.0, 3.0], 4))
    assert list(columns["pressure"][:4]) == ["full", "kpec", "full", "kpec"]
    assert [axis.name for axis in space.axes] == ["cksi", "fstat", "pressure"]


def test_ranges():
    np.testing.assert_allclose(log_span(1.0, 100.0, 3), [1.0, 10.0, 100.0])
    np.testing.assert_allclose(span(0.0, 1.0, 3), [0.0, 0.5, 1.0])


@pytest.mark.parametrize("method", ["latin_hypercube", "sobol"])
def test_samples_fill_their_ranges(method):
    axis = sample({"a.x": (2.0, 4.0), "a.y": (1e-3, 1e3, "log")}, 64, method, seed=3)
    x, y = axis.columns["a.x"], axis.columns["a.y"]
    # one point in each of 64 layers of both inputs, a property of both methods
    for unit in ((x - 2.0) / 2.0, np.log10(y) / 6.0 + 0.5):
        assert len(np.unique(np.floor(64.0 * unit))) == 64
        assert unit.min() >= 0.0 and unit.max() <= 1.0
    np.testing.assert_array_equal(x, sample({"a.x": (2.0, 4.0), "a.y": (1e-3, 1e3, "log")}, 64, method, seed=3).columns["a.x"])


def test_longer_sobol_sequences_begin_with_shorter_ones():
    long, short = (sample({"a.x": (0, 1), "a.y": (0, 1)}, n, "sobol").columns["a.y"] for n in (32, 16))
    np.testing.assert_array_equal(long[:16], short)


def test_tables(tmp_path):
    frame = pandas.DataFrame({"force": [1.0, 2.5], "method": ["full", "kpec"]})
    frame.to_csv(tmp_path / "a.csv", index=False)
    frame.to_parquet(tmp_path / "a.parquet")
    for name in ("a.csv", "a.parquet"):
        axis = table(tmp_path / name, {"kinematics.fn": "force", "pressure": "method"})
        np.testing.assert_array_equal(axis.columns["kinematics.fn"], [1.0, 2.5])
        assert list(axis.columns["pressure"]) == ["full", "kpec"]
    with pytest.raises(ValueError, match="no column weight"):
        table(frame, {"a.b": "weight"})


def test_rules_and_constraints():
    space = make_space({"a.x": [1, 2, 3], "a.y": [1, 2], "b.sum": lambda p: p["x"] + p["y"], "b.twice": "= 2 * sum"},
                       ["x > y", lambda p: p["sum"] < 5])
    columns = space.columns()
    np.testing.assert_array_equal(columns["b.twice"], 2 * (columns["a.x"] + columns["a.y"]))
    np.testing.assert_array_equal(space.chosen(columns), (columns["a.x"] > columns["a.y"]) & (columns["b.sum"] < 5))


def test_formulae_are_no_programs():
    assert evaluate("1 < x < 3 and not y", {"x": np.array([2.0, 4.0]), "y": np.array([False, False])}).tolist() == [True, False]
    assert names_in("hypot(fx, fy) + pi") == {"fx", "fy"}
    for bad in ("__import__('os')", "x.real", "x[0]", "(lambda: 1)()", "[x]", "x +"):
        with pytest.raises(ValueError):
            evaluate(bad, {"x": 1.0})


def test_mistakes_are_told():
    with pytest.raises(ValueError, match="varies twice"):
        make_space([{"a.x": [1]}, sample({"a.x": (0, 1)}, 4)], None)
    with pytest.raises(contact.ContactError, match=r"inputs of the study do not fit.*did you mean|unknown "):
        contact.Study(rolling(), {"kinematics.xksi": [0.001]}).run()
    with pytest.raises(contact.ContactError, match="has 1 cases"):
        contact.Study(rolling(), case=2)
    with pytest.raises(contact.ContactError, match="neither"):
        contact.Study("no_such_experiment")
    with pytest.raises(ValueError, match="none of threads, processes"):
        contact.Study(rolling()).run(engine="carrots")


@pytest.mark.parametrize("make, words", [
    (lambda: contact.Study(5), "a file or its cases, not 5"),
    (lambda: contact.Study(rolling(7), 5), "what varies is a mapping .* not 5"),
    (lambda: contact.Study(rolling(7), "kinematics.cksi"), "what varies is a mapping"),
    (lambda: contact.Study(rolling(7), {"kinematics.cksi": [1j]}).run(), "numbers, words and lists"),
    (lambda: contact.Study(rolling(7), {"pressure": pandas.date_range("2020", periods=2)}).run(), "numbers, words and lists"),
    (lambda: contact.Study(rolling(7), totals=["fx", "force"]).run(), "there is no total force; there are fn, fx"),
    (lambda: contact.Study(rolling(7), totals="force").run(), "there is no total force"),
    (lambda: contact.Study(rolling(7), fields="pressure").run(), "there is no element field pressure"),
    (lambda: contact.Study(EXAMPLES / "wheel_on_rail.toml", case=1, fields=["pn", "p"]).run(), "there is no element field p;"),
    (lambda: contact.Study(rolling(7), seconds=-1.0), "seconds = -1.0"),
    (lambda: contact.Study(rolling(7), folder=__file__).run(), "cannot be the folder of a study: File exists"),
    (lambda: contact.Study(rolling(7)).run(scheduler="hello"), "hello is not the address of a scheduler"),
    (lambda: contact.Study(rolling(7)).run(workers="2"), "workers = '2' is no number"),
    (lambda: contact.Study(rolling(7)).write("a.nc"), "needs a folder")])
def test_errors_are_reported_in_a_sentence(make, words):
    with pytest.raises((contact.ContactError, ValueError), match=words) as caught:
        make()
    assert "\n" not in str(caught.value)


def test_a_base_with_errors_is_refused():
    """What the base lacks, or has wrong, is an error; it was replaced by a preset, such as a modulus of rigidity of 1 N/mm2"""
    def reasons(change, numbers=(9.0, 5.0)):
        base = rolling()
        change(base)
        results = contact.Study(base, vary={"kinematics.fn": list(numbers)}).run(workers=1)
        return [results.reasons.values[k] for k in results.reason.values.ravel()], results.status.values.ravel().tolist()
    for group, key, words in (("material", "gg", "gg1 is missing"), ("grid", "mx", "mx is missing"),
                              ("friction", "fstat", "fstat is missing")):
        texts, states = reasons(lambda base: base[group].pop(key))  # noqa: B023
        assert states == [2, 2] and all(words in text for text in texts), texts
    texts, states = reasons(lambda base: base["material"].update(poiss=[0.7, 0.7]))
    assert states == [2, 2] and "poiss1 = 0.7 is above" in texts[0]
    # an invalid number of the study is that of its point only, the first one as well
    texts, states = reasons(lambda base: None, (-1.0, 9.0, float("nan")))
    assert states == [2, 0, 2] and "-1 is below" in texts[0], texts
    for change in (lambda base: base["material"].update(foo=1.0), lambda base: base["grid"].update(form="heptagon")):
        with pytest.raises(contact.ContactError, match="unknown "):
            reasons(change)


@pytest.mark.parametrize("name, case", [("cattaneo", 2), ("layer_traction", 3), ("manchester", 2), ("bentall", 5),
                                        ("conformal_wheel", 8)])
def test_a_case_keeps_what_those_before_it_gave(name, case):
    """The base is a case with all that it keeps, also in a group whose form changes, without what has no meaning in it"""
    results = contact.Study(EXAMPLES / (name + ".toml"), case=case, vary={}).run(workers=1)
    assert results.status.values.ravel().tolist() == [0], results.reasons.values
    if name == "cattaneo":
        # 19 x 19 elements of case 1, in the window of case 2
        assert float(results.fx.values.ravel()[0]) == pytest.approx(-3.21839, abs=1e-4)


@pytest.mark.parametrize("name", sorted(path.name for path in EXAMPLES.glob("*.inp")))
def test_complete_cases_stand_alone(name, tmp_path):
    """A complete case is a whole experiment, and is the same when it is read from there"""
    cases = contact.read(EXAMPLES / name, complete=True)
    assert len(cases) == len(contact.read(EXAMPLES / name))
    for number, case in enumerate(cases):
        alone = tmp_path / f"{number}.toml"
        alone.write_text(write_case(case), encoding="utf-8")
        again = contact.read(alone, complete=True)[0]
        for key in ("sequence", "estimate"):
            # a first case has nothing to continue
            case.pop(key, None)
            again.pop(key, None)
        assert again == case, f"case {number + 1}"


def test_complete_cases_need_a_right_input(tmp_path):
    (tmp_path / "a.toml").write_text(write_case(rolling()) + "[[case]]\n[case.material]\nfoo = 1.0\n", encoding="utf-8")
    with pytest.raises(contact.ContactError, match='unknown key "foo"'):
        contact.read(tmp_path / "a.toml", complete=True)


def test_one_name_is_a_list_of_one():
    found = contact.Study(rolling(7), totals="fx", fields="pn").run()
    assert {"fx", "pn"} <= set(found.data_vars) and "fy" not in found


def test_explain_before_a_run(tmp_path):
    study = contact.Study(rolling(), {"kinematics.cksi": span(0, 0.01, 21)}, where="cksi < 0.00951", folder=tmp_path / "s")
    plan = study.explain(workers=2)
    assert (plan.points, plan.left_out, plan.there, plan.cases, plan.workers) == (21, 1, 0, 20, 2)
    assert 0.0 < plan.seconds_per_case < 1.0
    assert plan.seconds == pytest.approx(plan.seconds_per_case * 10)
    study.run(workers=1)
    after = study.explain()
    assert (after.there, after.cases) == (20, 0)
    # estimated size against the size of the folder, within the headers of the batches
    assert plan.bytes < (tmp_path / "s" / "cases.sqlite").stat().st_size < 4 * plan.bytes + 60000
    assert "nothing is left" in str(after)


def test_progress_reports_time_left():
    texts = []
    progress = Progress(10, 5, texts.append)
    progress.add(10, 2)
    assert texts and texts[0].startswith("15 of 15 points, 2 not solved, ") and texts[0].endswith("left")
    assert [duration(t) for t in (3.0, 59, 600, 86400, 1e6)] == ["3.0 s", "59 s", "10 min", "24 h", "11.6 days"]


def test_both_formats_are_the_same_base():
    vary = {"friction.coefficient": [0.2, 0.4]}
    one, other = (contact.Study(EXAMPLES / f"cattaneo{suffix}", vary).run(workers=1) for suffix in (".inp", ".toml"))
    assert one.sizes["step"] == 2
    np.testing.assert_array_equal(one.fx.values, other.fx.values)
    # the varied friction is that of the shift
    np.testing.assert_allclose(one.fx.sel(step=2), -0.875 * np.array([0.2, 0.4]) * 9.1954, rtol=1e-3)
