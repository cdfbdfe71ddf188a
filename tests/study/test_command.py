"""contact study FILE.toml: from a file to files, exit status, messages if something is missing."""
import os
import signal
import subprocess
import sys
import time

import contact
import pandas
import pytest
import xarray
from bases import EXAMPLES, rolling
from contact.study.__main__ import main
from contact.study._scene import write_case

PROGRAM = os.environ["CONTACT_PROGRAM"]
STUDY = """
[study]
base = "roller.toml"
where = "cksi < 0.0085"
totals = ["fx", "pmax"]
results = ["all.nc", "all.parquet"]

[vary]
"kinematics.cksi" = { from = 0.0, to = 0.009, count = 4 }
"friction.coefficient" = [0.2, 0.4]
"friction.memdst" = "= 0 * cksi"

[[sample]]
inputs."kinematics.fn" = [1e4, 1e5, "log"]
count = 2
method = "sobol"

[derive]
ratio = "fx / fn"
"""


def run(folder, *words, **more):
    """Run the program in a folder"""
    environment = {**os.environ, "CONTACT_PYTHON": os.path.join(os.environ["CONTACT_SOURCE"], "python"), **more.pop("env", {})}
    return subprocess.run([PROGRAM, *words], cwd=folder, capture_output=True, text=True, env=environment, check=False, **more)


@pytest.fixture
def folder(tmp_path):
    """A folder with a base and a study"""
    (tmp_path / "roller.toml").write_text(write_case(rolling()))
    (tmp_path / "a.toml").write_text(STUDY.replace('"friction.memdst" = "= 0 * cksi"\n', ""))
    return tmp_path


def test_from_a_file_to_files(folder):
    done = run(folder, "study", "a.toml", "--workers", "1")
    assert done.returncode == 0 and "16 cases: 12 solved, 0 not converged, 0 refused, 4 left out" in done.stdout, done
    with xarray.open_dataset(folder / "all.nc") as data:
        assert dict(data.sizes) == {"cksi": 4, "coefficient": 2, "sample": 2, "sentence": 1}
        assert "fy" not in data and (data.ratio == data.fx / data.fn)[:3].all()
    assert len(pandas.read_parquet(folder / "all.parquet")) == 16


def test_told_beforehand(folder, monkeypatch, capsys):
    monkeypatch.setattr(sys, "argv", ["contact study", str(folder / "a.toml"), "--explain"])
    assert main() == 0
    assert capsys.readouterr().out.startswith("16 points, 4 left out by constraints, 0 computed before")


def test_mistakes_in_a_file(folder, monkeypatch, capsys):
    for old, new, words in (("[vary]", "[vari]", "unknown key 'vari'; accepted: study, vary"),
                            ("count = 4", "cunt = 4", "unknown key 'cunt'; accepted: from, to, count, scale"),
                            ('"roller.toml"', '"rollers.toml"', "rollers.toml"),
                            ("where = ", "where = 3 #", "a constraint is a formula"),
                            ("kinematics.cksi", "kinematics.xksi", "xksi")):
        (folder / "b.toml").write_text((folder / "a.toml").read_text().replace(old, new))
        monkeypatch.setattr(sys, "argv", ["contact study", str(folder / "b.toml")])
        assert main() == 1
        text = capsys.readouterr().err
        assert text.startswith("contact study: ") and words in text
    assert run(folder, "study", "nothing.toml").returncode == 1
    for words in (["--folder", str(folder / "roller.toml")], ["--results", str(folder / "none" / "a.nc")]):
        monkeypatch.setattr(sys, "argv", ["contact study", str(folder / "a.toml"), "--quiet", *words])
        assert main() == 1
        text = capsys.readouterr().err
        assert text.startswith("contact study: ") and text.count("\n") == 1, text


def test_cases_that_fail_are_told(folder, monkeypatch, capsys):
    (folder / "b.toml").write_text('[study]\nbase = "roller"\n[vary]\n"friction.coefficient" = [0.3, -1.0]\n')
    for words, status in ((["--strict"], 2), ([], 0)):
        monkeypatch.setattr(sys, "argv", ["contact study", str(folder / "b.toml"), *words])
        assert main() == status
        text = capsys.readouterr().out
        assert "1 refused" in text and "is below its lower bound" in text


def test_without_python_it_says_so(folder):
    done = run(folder, "study", "a.toml", env={"PATH": str(folder)})
    assert done.returncode == 1 and done.stderr.startswith("contact study: Python 3 is not found; install it"), done


def test_without_a_package_it_says_which(folder):
    (folder / "empty").mkdir()
    (folder / "empty" / "xarray.py").write_text("raise ModuleNotFoundError(\"No module named 'xarray'\", name='xarray')\n")
    done = run(folder, "study", "a.toml", env={"PYTHONPATH": str(folder / "empty") + ":" + os.environ.get("PYTHONPATH", "")})
    assert done.returncode == 1 and "package xarray is not found" in done.stderr and "[study]" in done.stderr, done


@pytest.mark.skipif(sys.platform == "win32", reason="signals")
def test_a_signal_ends_it_and_it_goes_on(folder):
    (folder / "b.toml").write_text('[study]\nbase = "roller"\nresults = "b.nc"\n[vary]\n"kinematics.cksi" = '
                                   '{ from = 0.0, to = 0.01, count = 30000 }\n')
    process = subprocess.Popen([PROGRAM, "study", "b.toml"], cwd=folder, stderr=subprocess.PIPE, text=True,
                               env={**os.environ, "CONTACT_PYTHON": os.path.join(os.environ["CONTACT_SOURCE"], "python")})
    file = folder / "b.study" / "cases.sqlite"
    for _ in range(600):
        if file.is_file() and file.stat().st_size > 30000:
            break
        time.sleep(0.1)
    process.send_signal(signal.SIGTERM)
    assert process.wait(60) == 128 + signal.SIGTERM
    assert "repeat the command to continue" in process.stderr.read()
    process.stderr.close()
    plan = contact.Study(folder / "roller.toml", {"kinematics.cksi": contact.study.span(0.0, 0.01, 30000)},
                         folder=folder / "b.study").explain()
    assert plan.points == 30000 and plan.there > 0 and plan.there + plan.cases == 30000
    assert not (folder / "b.nc").exists()


@pytest.mark.parametrize("name, coarse", [("creep_curves", {"count = 41": "count = 5", "count = 6": "count = 2"}),
                                          ("wheelset", {"count = 5 ": "count = 1 ", "count = 25": "count = 2",
                                                        "[0.0, 0.025, 0.05]": "[0.025]"})])
def test_worked_studies(tmp_path, monkeypatch, capsys, name, coarse):
    """The examples with fewer points"""
    text = (EXAMPLES / "studies" / f"{name}.toml").read_text()
    text = text.replace('"../wheel', f'"{EXAMPLES}/wheel').replace('"roller.toml"', f'"{EXAMPLES}/studies/roller.toml"')
    for old, new in coarse.items():
        text = text.replace(old, new)
    (tmp_path / f"{name}.toml").write_text(text)
    monkeypatch.setattr(sys, "argv", ["contact study", str(tmp_path / f"{name}.toml"), "--strict"])
    assert main() == 0, capsys.readouterr()
    with xarray.open_dataset(tmp_path / f"{name}.nc") as data:
        assert (data.status == 0).all()
        if name == "creep_curves":
            # beyond saturation the traction is the friction bound; traction increases with creepage
            assert abs(data.traction[:, -1] + data.coefficient).max() < 1e-4
            assert (data.fx.diff("cksi") < 1e-6 * 7e4).all()
