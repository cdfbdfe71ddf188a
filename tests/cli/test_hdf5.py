#!/usr/bin/env python3
"""contact --hdf5: one file with all results, read by h5py and by Octave; readable after the program was killed.

Skipped (exit status 77) without h5py. The environment gives CONTACT_PROGRAM and CONTACT_SOURCE.
"""
import hashlib
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import tomllib
import unittest

try:
    import h5py
    import numpy as np
except ImportError as reason:
    print("SKIPPED: %s" % reason)
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")
# Keys and groups that are not among the inputs of a case: they define the problem to which it belongs, or subsurface points
ELSEWHERE = ("module", "result_element", "contact_patch", "stress_output", "stress_points")

FIRST = """3
203100
022020
0002001
999 100 30 1 1e-5
2000 {creep:.9f} 0 0
0.3 0.3
0 0.2 1000
0.28 0.28 82000 82000
1
13 11 -1.3 -1.1 0.2 0.2
1 1
0.01 0 0.01 0 0 0
"""
NEXT = """3
203100
100000
0112001
2000 {creep:.9f} 0 0
"""


def series(path, cases):
    """Creepages from 0 in steps; all other values are constant"""
    with open(path, "w") as file:
        file.writelines((FIRST if k == 0 else NEXT).format(creep=-1e-5 * k) for k in range(cases))
        file.write("0\n")


def table(path):
    """Columns of a .mat file by name"""
    with open(path) as file:
        lines = file.read().splitlines()
    names = lines[12][1:].split()
    rows = np.array([line.split() for line in lines[13:]], dtype=float)
    return dict(zip(names, rows.T))


class Hdf5(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def path(self, name):
        return os.path.join(self.folder, name)

    def run_program(self, *arguments):
        run = subprocess.run([PROGRAM, "--quiet", *arguments], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, text=True, timeout=300)
        self.assertEqual(run.returncode, 0, run.stderr[-2000:])

    def run_example(self, name):
        self.run_program("--hdf5", "--output-dir", ".", "2", os.path.join(SOURCE, "examples", name))
        return h5py.File(self.path(name + ".h5"), "r")

    def test_fields_are_those_of_the_mat_file(self):
        series(self.path("series.inp"), 4)
        self.run_program("--hdf5", "2", "series")
        with h5py.File(self.path("series.h5"), "r") as file:
            for case in range(1, 5):
                group = file["case_%04d/patch_1" % case]
                columns = table(self.path("series.%04d.mat" % case))
                self.assertEqual(group["grid/x"].shape, (13,))
                for name, column in (("pn", "PN"), ("px", "PX"), ("py", "PY"), ("ux", "UX"), ("h", "H"), ("mu", "MU")):
                    field = group["fields/" + name]
                    self.assertEqual(field.shape, (11, 13))
                    self.assertTrue(field.attrs["units"] and field.attrs["long_name"])
                    np.testing.assert_allclose(field[...].ravel(), columns[column], rtol=1e-5,
                                               atol=1e-9 * abs(columns[column]).max())
                np.testing.assert_array_equal(group["fields/eldiv"][...].ravel(), columns["IGS"])
                slip = np.hypot(group["fields/sx"][...], group["fields/sy"][...]).ravel()
                np.testing.assert_allclose(slip, columns["SREL"], rtol=1e-5, atol=1e-12)
                self.assertAlmostEqual(group["totals/fn"][()], 2000.0, delta=0.1)
                self.assertEqual(file["patches/cksi"][case - 1], file["case_%04d/inputs/kinematics/cksi" % case][()])
            self.assertEqual(file["patches/fx"].attrs["units"], b"N")
            # data that do not change are stored once
            first, last = file["case_0001"], file["case_0004"]
            for same in ("inputs/material", "patch_1/fields/pn", "patch_1/grid", "patch_1/solver"):
                self.assertEqual(h5py.h5o.get_info(first[same].id).addr, h5py.h5o.get_info(last[same].id).addr, same)
            self.assertNotEqual(h5py.h5o.get_info(first["patch_1/fields/px"].id).addr,
                                h5py.h5o.get_info(last["patch_1/fields/px"].id).addr)

    def test_file_describes_itself(self):
        """Units, names, dimension scales and flags of all data; origin of the results"""
        for name in ("manchester", "conformal_wheel", "subsurface"):
            file = self.run_example(name)
            self.assertEqual(file.attrs["Conventions"], b"CF-1.11")
            self.assertLess(abs(file["provenance/created/seconds"][()] - time.time()), 600)
            missing, titles = [], {}

            def look(path, item):
                if not isinstance(item, h5py.Dataset):
                    return
                if item.ndim and not item.is_scale and not all(len(dimension) == 1 for dimension in item.dims):
                    missing.append(path + ": dimension scales")  # noqa: B023
                for axis, dimension in enumerate(item.dims if not item.is_scale else ()):
                    if len(dimension) and dimension[0].shape != (item.shape[axis],):
                        missing.append(path + ": length of a scale")  # noqa: B023
                if "long_name" not in item.attrs:
                    missing.append(path + ": long_name")  # noqa: B023
                if item.dtype.kind == "f" and "units" not in item.attrs and not path.startswith(("cases", "patches")):
                    missing.append(path + ": units")  # noqa: B023
                if "/block_1/s" in path:
                    titles.setdefault(path.split("/")[0], []).append(item.attrs["long_name"])  # noqa: B023

            file.visititems(look)
            self.assertEqual(missing, [])
            for found in titles.values():
                self.assertEqual(len(set(found)), 12)
            patch = file["case_0001/patch_1"]
            self.assertEqual(patch["fields/eldiv"].attrs["flag_values"].tolist(), [0, 1, 2, 3])
            self.assertEqual(patch["fields/eldiv"].attrs["flag_meanings"], b"exterior adhesion slip plastic")
            np.testing.assert_array_equal(patch["fields/pn"].dims[0][0], patch["grid/y"])
            np.testing.assert_array_equal(patch["fields/pn"].dims[1][0], patch["grid/x"])
            self.assertEqual(patch["totals/fx"].attrs["units"], b"N")
            self.assertEqual("kinematics" in file["case_0001/inputs"], name == "subsurface")
            with open(os.path.join(SOURCE, "examples", name + ".inp"), "rb") as source:
                text = source.read()
            origin = file["provenance"]
            self.assertEqual(origin["input"][0], text)
            self.assertEqual(origin["input_sha256"][()], hashlib.sha256(text).hexdigest().encode())
            profiles = [(origin[item]["file"][()].decode(), origin[item]["sha256"][()].decode()) for item in origin
                        if item.startswith("profile_")]
            self.assertEqual(len(profiles), 0 if name == "subsurface" else 2)
            for path, digest in profiles:
                with open(os.path.join(SOURCE, "examples", path), "rb") as source:
                    self.assertEqual(hashlib.sha256(source.read()).hexdigest(), digest)
            file.close()

    def test_xarray_knows_all_dimensions(self):
        try:
            import xarray
            import h5netcdf  # noqa: F401
        except ImportError as reason:
            self.skipTest(str(reason))
        self.run_example("subsurface").close()
        path = os.path.join(self.folder, "subsurface.h5")
        for group, sizes in (("patches", {"case": 4}), ("case_0002/patch_1/fields", {"y_element": 41, "x_element": 41})):
            with xarray.open_dataset(path, group=group, engine="h5netcdf") as data:
                self.assertEqual(dict(data.sizes), sizes)
        if hasattr(xarray, "open_datatree"):
            with xarray.open_datatree(path, group="case_0001", engine="h5netcdf") as tree:
                self.assertEqual([str(name) for node in tree.subtree for name in node.dims if "phony" in str(name)], [])
                self.assertIn("x_element", tree["patch_1/fields"].to_dataset().coords)
                self.assertEqual(tree["patch_1/subsurface/block_1/sigvm"].dims, ("z", "y", "x"))

    def test_shifts_and_rolling_have_columns_of_their_own(self):
        with self.run_example("cattaneo") as file:
            self.assertTrue(np.isnan(file["patches/shift_x"][0]))
            self.assertGreater(abs(file["patches/shift_x"][1]), 0.0)
            self.assertNotIn("cksi", file["patches"])
            self.assertEqual(file["patches/shift_x"].attrs["units"], b"mm")

    def test_subsurface_blocks(self):
        with self.run_example("subsurface") as file:
            block = file["case_0001/patch_1/subsurface/block_1"]
            shape = tuple(block["points"][axis].size for axis in "zyx")
            self.assertEqual(block["sigvm"].shape, shape)
            tensor = {name: block["sig" + name][...] for name in ("xx", "yy", "zz", "xy", "xz", "yz")}
            np.testing.assert_allclose(block["sighyd"][...], (tensor["xx"] + tensor["yy"] + tensor["zz"]) / 3, rtol=1e-9,
                                       atol=1e-9 * abs(tensor["zz"]).max())
            mises = np.sqrt(0.5 * ((tensor["xx"] - tensor["yy"])**2 + (tensor["yy"] - tensor["zz"])**2
                                   + (tensor["zz"] - tensor["xx"])**2)
                            + 3 * (tensor["xy"]**2 + tensor["xz"]**2 + tensor["yz"]**2))
            np.testing.assert_allclose(block["sigvm"][...], mises, rtol=1e-9, atol=1e-9 * mises.max())

    def test_wheel_on_rail(self):
        with self.run_example("wheel_on_rail") as file:
            lefts = rights = 0
            for name in file:
                if not name.startswith("case_"):
                    continue
                case = file[name]
                left = case["inputs/choices/configuration"][()].startswith(b"left")
                lefts, rights = lefts + left, rights + (not left)
                total = case["totals/fx_tr"][()]
                fields = case["patch_1/fields"]
                grid = case["patch_1/grid"]
                area = grid["dx"][()] * grid["dy"][()]
                for field, force in (("px", "fx"), ("py", "fy"), ("pn", "fn")):
                    self.assertAlmostEqual(fields[field][...].sum() * area, case["patch_1/totals/" + force][()],
                                           delta=1e-6 * case["patch_1/totals/fn"][()], msg=name + force)
                self.assertGreater(abs(total), 0.0)
                # the contact reference lies on the rail's profile at its position in the track
                roll, s = case["markers/roll_r"][()], -1.0 if left else 1.0
                y, z = case["profiles/rail/y"][...], case["profiles/rail/z"][...]
                yt = case["markers/y_r"][()] + y * np.cos(roll) - z * np.sin(roll)
                zt = case["markers/z_r"][()] + y * np.sin(roll) + z * np.cos(roll)
                at = case["patch_1/totals/ycp_tr"][()], case["patch_1/totals/zcp_tr"][()]
                self.assertGreater(s * at[0], 0.0)
                self.assertLess(np.hypot(yt - at[0], zt - at[1]).min(), 1.5)
            self.assertGreater(lefts, 0)
            self.assertGreater(rights, 0)

    def test_section_of_a_wheel_in_slices(self):
        with self.run_example("wheel_flat") as file:
            def height(case, y):
                profile = file["case_%04d/profiles/wheel" % case]
                order = np.argsort(profile["y"][...])
                return np.interp(y, profile["y"][...][order], profile["z"][...][order])
            # the middle of the flat, 0.4 mm deep, is at the bottom in case 6; case 1 is beside it
            for y in (-20.0, 0.0, 20.0):
                self.assertAlmostEqual(height(6, y) - height(1, y), -0.4, delta=1e-6)
            # a contact ahead of the bottom touches another section than the bottom has
            self.assertAlmostEqual(height(5, 0.0), height(7, 0.0), delta=1e-3)
            self.assertIn("rail", file["case_0001/profiles"])

    def test_curve_of_conformal_contact(self):
        with self.run_example("conformal_wheel") as file:
            found = 0
            for name in file:
                patch = file[name]["patch_1"] if name.startswith("case_") and "patch_1" in file[name] else {}
                if "curve" not in patch:
                    continue
                found += 1
                y, z, angle = (patch["curve"][column][...] for column in ("y", "z", "angle"))
                self.assertEqual(y.size, patch["grid/my"][()])
                # neighbouring points are as far apart as rows, and the angle is that of the line between them
                np.testing.assert_allclose(np.hypot(np.diff(y), np.diff(z)), patch["grid/dy"][()], rtol=2e-3)
                middle = 0.5 * (angle[1:] + angle[:-1])
                np.testing.assert_allclose(np.arctan2(np.diff(z), np.diff(y)), middle, atol=2e-3)
            self.assertGreater(found, 0)

    def test_inputs_by_names_of_the_readable_format(self):
        """The values that the first case of an example gives in its .toml are found under the same names, values of all sets in
        one list"""
        compared = 0
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), self.path("profiles"))
        for path in sorted(os.listdir(EXAMPLES)):
            name, suffix = os.path.splitext(path)
            if suffix != ".toml":
                continue
            with open(os.path.join(EXAMPLES, path), encoding="utf-8") as file:
                first = "\n[[case]]".join(file.read().split("\n[[case]]")[:2])
            with open(self.path(path), "w", encoding="utf-8") as file:
                file.write(first)
            given = tomllib.loads(first)["case"][0]
            choices = {key: value for key, value in given.items() if not isinstance(value, (dict, list))}
            groups = {"choices": choices} | {key: value for key, value in given.items() if isinstance(value, dict)}
            self.run_program("--hdf5", "2", name)
            with h5py.File(self.path(name + ".h5")) as file:
                inputs = next(file[key]["inputs"] for key in file if "case_0001" in key)
                for group, values in groups.items():
                    for key, value in values.items():
                        if key in ELSEWHERE or group in ELSEWHERE:
                            continue
                        with self.subTest(example=name, group=group, key=key):
                            compared += self.same_input(inputs[group], key, value)
        self.assertGreater(compared, 600)

    def test_keys_that_input_files_have_no_place_for(self):
        """Accuracy and permission are stored if they are requested; order and source always, by the words of the format"""
        with open(os.path.join(EXAMPLES, "cattaneo.toml"), encoding="utf-8") as file:
            first = "\n[[case]]".join(file.read().split("\n[[case]]")[:2])
        requested = first.replace("[case.iteration]\n", '[case.iteration]\naccuracy = 0.05\nallow = "approximate"\n')
        self.assertNotEqual(first, requested)
        with open(self.path("own.toml"), "w", encoding="utf-8") as file:
            file.write(requested + '\n[[case]]\n[case.iteration]\naccuracy = 0\nallow = "nothing"\norder = 1\n')
        self.run_program("--hdf5", "2", "own")
        with h5py.File(self.path("own.h5")) as file:
            groups = [file[f"case_{case:04d}/inputs/iteration"] for case in (1, 2)]
            self.assertEqual(groups[0]["accuracy"][()], 0.05)
            self.assertEqual(groups[0]["allow"][()], b"approximate")
            self.assertEqual(groups[1]["order"][()], 1)
            self.assertFalse({"accuracy", "allow"} & set(groups[1]))

    def test_inputs_with_an_accuracy(self):
        """The inputs are as given, with the accuracy; grid, order and tolerance that were chosen are in the group accuracy"""
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), self.path("profiles"))
        for name, group in (("falling_friction", "case_0001/patch_1"), ("manchester", "case_0001")):
            with self.subTest(name):
                with open(os.path.join(EXAMPLES, name + ".toml"), encoding="utf-8") as file:
                    text = "\n[[case]]".join(file.read().split("\n[[case]]")[:2])
                with open(self.path(name + ".toml"), "w", encoding="utf-8") as file:
                    file.write(text)
                inputs = []
                for options in ((), ("--accuracy", "0.02")):
                    self.run_program("--hdf5", *options, "2", name)
                    with h5py.File(self.path(name + ".h5")) as file:
                        inputs.append({f"{key}/{one}": str(values[one][()]) for key, values in file["case_0001/inputs"].items()
                                       for one in values})
                        if options:
                            self.assertEqual(file[group + "/accuracy/order"][()], 2)
                self.assertEqual(inputs[1].pop("iteration/accuracy"), "0.02")
                self.assertEqual(inputs[1], inputs[0])
                self.assertEqual(inputs[0]["iteration/order"], "1")

    def same_input(self, group, key, value):
        """The value of a key, or the values of sets of friction; how many were compared"""
        if key == "set":
            names = {name for one in value for name in one}
            return sum(self.same_input(group, name, [one.get(name) for one in value]) for name in names)
        found = group[key][()]
        if isinstance(found, bytes):
            self.assertEqual(found.decode(), value)
        elif isinstance(value, str):
            number, unit = value.split()
            self.assertIn(unit, ("deg", "deg/s"))
            self.assertIn(group[key].attrs["units"], (b"rad", b"rad/s"))
            self.assertAlmostEqual(found, np.deg2rad(float(number)), delta=1e-12)
        elif isinstance(value, list) and isinstance(value[0], str):
            np.testing.assert_allclose(found, np.deg2rad([float(one.split()[0]) for one in value]), rtol=1e-12)
        else:
            np.testing.assert_allclose(np.ravel(found), np.ravel(value), rtol=1e-14)
        return 1

    def test_inputs_of_each_case(self):
        """Groups shared by two cases are written once: each case has the same inputs as in a separate file"""
        texts = [FIRST.format(creep=-1e-5)]
        # one number after the other differs, then all are as in the first case
        for old, new in (("2000 -0.000010000 0 0", "2100 -0.000010000 0 0"), ("2000 -0.000010000 0 0", "2000 -0.000020000 0 0"),
                         ("0.3 0.3", "0.31 0.31"), ("0.28 0.28 82000 82000", "0.28 0.28 82000 81000"),
                         ("0.28 0.28 82000 82000", "0.29 0.28 82000 82000"), ("13 11 -1.3", "15 11 -1.3"),
                         ("-1.3 -1.1 0.2", "-1.3 -1.3 0.2"),
                         ("0.01 0 0.01 0 0 0", "0.01 0 0.012 0 0 0"), ("0.01 0 0.01 0 0 0", "0.01 0 0.01 0 0 1e-4"),
                         ("0 0.2 1000", "0 0.2 1500"), ("0.3 0.3", "0.3 0.3")):
            self.assertIn(old, texts[0])
            texts.append(texts[0].replace(old, new))

        def inputs(name, case):
            found = {}
            with h5py.File(self.path(name)) as file:
                file[f"case_{case:04d}/inputs"].visititems(
                    lambda place, item: found.update({place: np.array(item[()]).tolist()} if hasattr(item, "dtype") else {}))
            return found

        with open(self.path("all.inp"), "w", encoding="utf-8") as file:
            file.write("".join(texts) + "0\n")
        self.run_program("--hdf5", "2", "all")
        seen = []
        for k, text in enumerate(texts, 1):
            with open(self.path("one.inp"), "w", encoding="utf-8") as file:
                file.write(text + "0\n")
            self.run_program("--hdf5", "2", "one")
            alone = inputs("one.h5", 1)
            self.assertEqual(inputs("all.h5", k), alone, k)
            seen.append(alone)
        self.assertNotIn(seen[0], seen[1:-1])
        self.assertEqual(seen[0], seen[-1])

    def test_case_without_result(self):
        with open(self.path("faulty.inp"), "w") as file:
            file.write(FIRST.format(creep=0) + FIRST.format(creep=0).replace("0.28 0.28 8", "0.28 0.98 8") + "0\n")
        run = subprocess.run([PROGRAM, "--quiet", "--hdf5", "2", "faulty"], cwd=self.folder, stdin=subprocess.DEVNULL,
                             capture_output=True, timeout=60)
        self.assertEqual(run.returncode, 1)
        with h5py.File(self.path("faulty.h5"), "r") as file:
            self.assertEqual(list(file["cases/solved"]), [1.0, 0.0])
            self.assertIn(b"input", file["case_0002/failure/reason"][()])

    def test_readable_after_a_violent_end(self):
        series(self.path("long.inp"), 8000)
        shown = 0
        for pause in (0.0, 0.5, 1.1, 1.7, 2.3):
            if os.path.exists(self.path("long.h5")):
                os.remove(self.path("long.h5"))
            run = subprocess.Popen([PROGRAM, "--quiet", "--hdf5", "2", "long"], cwd=self.folder, stdin=subprocess.DEVNULL)
            # the file of the final name can be opened
            patience = time.monotonic() + 60
            while not os.path.exists(self.path("long.h5")) and time.monotonic() < patience:
                time.sleep(0.01)
            time.sleep(pause)
            run.send_signal(signal.SIGKILL)
            run.wait()
            with h5py.File(self.path("long.h5"), "r") as file:
                names = [name for name in file if name.startswith("case_") and len(file[name])]
                for name in names:
                    self.assertEqual(file[name + "/patch_1/fields/px"].shape, (11, 13))
                    self.assertAlmostEqual(file[name + "/patch_1/fields/pn"][...].sum() * 0.04, 2000.0, delta=0.5)
                shown = max(shown, len(names))
        self.assertGreater(shown, 10)

    def test_octave_loads_it(self):
        octave = shutil.which("octave-cli") or shutil.which("octave")
        if not octave:
            self.skipTest("there is no octave")
        self.run_example("cattaneo").close()
        script = """d = load("cattaneo.h5"); p = d.case_0002.patch_1;
assert(size(p.fields.pn), [double(p.grid.mx), double(p.grid.my)]);
assert(p.totals.fn, d.patches.fn(2)); assert(ischar(p.solver.normal_method)); disp("it loads");
"""
        run = subprocess.run([octave, "--quiet", "--no-gui", "--eval", script], cwd=self.folder, stdin=subprocess.DEVNULL,
                             stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=300)
        self.assertIn("it loads", run.stdout)


if __name__ == "__main__":
    unittest.main()
