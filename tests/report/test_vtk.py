#!/usr/bin/env python3
"""contact --vtk: files that VTK can read, with the forces of the case.

Without the package vtk the files are read by this test. Environment: CONTACT_PROGRAM, CONTACT_SOURCE.
"""
import json
import os
import re
import struct
import subprocess
import tempfile
import unittest
import xml.dom.minidom

try:
    import vtk
except ImportError:
    vtk = None

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]


def read_by_hand(path):
    """Numbers of points and cells, and arrays by name as lists of tuples"""
    with open(path, "rb") as file:
        data = file.read()
    head, rest = data.split(b'<AppendedData encoding="raw">\n_', 1)
    text = head.decode()
    assert 'byte_order="LittleEndian"' in text
    extent = [int(word) for word in re.search(r'<Piece Extent="([^"]*)"', text).group(1).split()]
    sizes = [extent[2 * k + 1] - extent[2 * k] for k in range(3)]
    arrays = {}
    for name, components, offset in re.findall(r'Name="([^"]*)" NumberOfComponents="(\d)" format="appended" offset="(\d+)"', text):
        at, n = int(offset), int(components)
        count = struct.unpack_from("<Q", rest, at)[0] // 8
        values = struct.unpack_from("<%dd" % count, rest, at + 8)
        arrays[name] = [values[k:k + n] for k in range(0, count, n)]
    return (sizes[0] + 1) * (sizes[1] + 1) * (sizes[2] + 1), sizes, arrays


class Vtk(unittest.TestCase):
    def setUp(self):
        scratch = tempfile.TemporaryDirectory()
        self.addCleanup(scratch.cleanup)
        self.folder = scratch.name

    def run_example(self, name):
        subprocess.run([PROGRAM, "--quiet", "--vtk", "--json", "--output-dir", self.folder, "2",
                        os.path.join(SOURCE, "examples", name)], check=True, stdin=subprocess.DEVNULL, timeout=120)
        with open(os.path.join(self.folder, name + ".jsonl")) as file:
            return [case for case in map(json.loads, file) if case["case"]]

    def collection(self, name):
        tree = xml.dom.minidom.parse(os.path.join(self.folder, name + ".pvd"))
        return [(int(item.getAttribute("timestep")), item.getAttribute("file")) for item in tree.getElementsByTagName("DataSet")]

    def force(self, arrays, sizes):
        """Integral of the traction over the cells"""
        points = arrays["Points"]
        total = [0.0, 0.0, 0.0]
        for iy in range(sizes[1]):
            for ix in range(sizes[0]):
                k = ix + (sizes[0] + 1) * iy
                a, b, c = points[k], points[k + 1], points[k + sizes[0] + 1]
                u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
                cross = [u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]]
                area = sum(x * x for x in cross) ** 0.5
                for axis, value in enumerate(arrays["traction [N/mm2]"][ix + sizes[0] * iy]):
                    total[axis] += value * area
        return total

    def test_plane_surface_and_blocks(self):
        cases = self.run_example("subsurface")
        listed = self.collection("subsurface")
        self.assertEqual({step for step, _ in listed}, {case["case"] for case in cases})
        for _, file in listed:
            count, sizes, arrays = read_by_hand(os.path.join(self.folder, file))
            self.assertEqual(len(arrays["Points"]), count)
            if "block" in file:
                stress = arrays["stress, axes of the patch [N/mm2]"]
                for tensor, mean in list(zip(stress, arrays["mean stress [N/mm2]"]))[:50]:
                    self.assertAlmostEqual(sum(tensor[:3]) / 3, mean[0], delta=1e-9 * (1 + abs(mean[0])))
        _, sizes, arrays = read_by_hand(os.path.join(self.folder, "subsurface.0001.vts"))
        fn = cases[0]["patches"][0]["totals"]["fn"]["value"]
        self.assertAlmostEqual(self.force(arrays, sizes)[2], fn, delta=1e-8 * fn)

    def test_forces_in_track_coordinates_on_both_sides(self):
        cases = self.run_example("wheel_on_rail")
        listed = self.collection("wheel_on_rail")
        for case in cases:
            total = [0.0, 0.0, 0.0]
            for step, file in listed:
                if step == case["case"] and not file.endswith((".rail.vts", ".wheel.vts")):
                    _, sizes, arrays = read_by_hand(os.path.join(self.folder, file))
                    total = [a + b for a, b in zip(total, self.force(arrays, sizes))]
            for axis, name in enumerate(("fx_tr", "fy_tr", "fz_tr")):
                self.assertAlmostEqual(total[axis], case["totals"][name]["value"], delta=1e-6 * case["totals"]["fz_tr"]["value"],
                                       msg="case %d %s" % (case["case"], name))

    def test_patches_lie_on_rail_and_wheel(self):
        """At the largest pressure, rail and wheel are closer to the patch than the error due to the distance of their sections"""
        for case in self.run_example("wheel_on_rail")[:3]:
            name = "wheel_on_rail.%04d" % case["case"]
            self.assertIn((case["case"], name + ".rail.vts"), self.collection("wheel_on_rail"))
            _, sizes, arrays = read_by_hand(os.path.join(self.folder, name + "a.vts"))
            pressure = [value[0] for value in arrays["pressure [N/mm2]"]]
            k = max(range(len(pressure)), key=pressure.__getitem__)
            spot = arrays["Points"][k + k // sizes[0]]
            rail = read_by_hand(os.path.join(self.folder, name + ".rail.vts"))[2]["Points"]
            across = min(((p[1] - spot[1]) ** 2 + (p[2] - spot[2]) ** 2) ** 0.5 for p in rail)
            self.assertLess(across, 1.0)
            self.assertTrue(min(p[0] for p in rail) < spot[0] < max(p[0] for p in rail))
            wheel = read_by_hand(os.path.join(self.folder, name + ".wheel.vts"))[2]["Points"]
            self.assertLess(min(sum((a - b) ** 2 for a, b in zip(p, spot)) ** 0.5 for p in wheel), 25.0)
            # the lowest meridian is one of the sections
            self.assertLess(min(((p[1] - spot[1]) ** 2 + (p[2] - spot[2]) ** 2) ** 0.5 for p in wheel), 1.0)
            # the axle is at the height given by the nominal radius of 460 mm
            heights = [p[2] for p in wheel]
            self.assertAlmostEqual((max(heights) + min(heights)) / 2, case["totals"]["z_ws"]["value"] - 460.0, delta=2.0)

    def test_all_fields_are_there(self):
        self.run_example("cattaneo")
        _, sizes, arrays = read_by_hand(os.path.join(self.folder, "cattaneo.0002.vts"))
        for name in ("distance [mm]", "un [mm]", "ux [mm]", "uy [mm]", "sx [mm]", "wx [mm]", "px [N/mm2]", "friction coefficient"):
            self.assertEqual(len(arrays[name]), sizes[0] * sizes[1], name)
        # slip is rigid shift and change of the elastic displacement
        k = max(range(sizes[0] * sizes[1]), key=lambda k: abs(arrays["sx [mm]"][k][0]))
        self.assertAlmostEqual(arrays["slip [mm]"][k][0], arrays["sx [mm]"][k][0], delta=1e-15)
        self.assertAlmostEqual(arrays["sx [mm]"][k][0], arrays["wx [mm]"][k][0] + arrays["ux [mm]"][k][0], delta=1e-6)

    @unittest.skipIf(vtk is None, "the package vtk is not installed")
    def test_vtk_reads_the_same(self):
        self.run_example("subsurface")
        for _, file in self.collection("subsurface"):
            path = os.path.join(self.folder, file)
            reader = vtk.vtkXMLStructuredGridReader()
            reader.SetFileName(path)
            reader.Update()
            self.assertEqual(reader.GetErrorCode(), 0)
            grid = reader.GetOutput()
            count, _, arrays = read_by_hand(path)
            self.assertEqual(grid.GetNumberOfPoints(), count)
            data = grid.GetPointData() if "block" in file else grid.GetCellData()
            self.assertEqual(data.GetNumberOfArrays(), len(arrays) - 1)
            for k in range(data.GetNumberOfArrays()):
                array = data.GetArray(k)
                self.assertEqual(array.GetTuple(array.GetNumberOfTuples() // 2),
                                 arrays[array.GetName()][array.GetNumberOfTuples() // 2])

    def test_without_the_flag_nothing_is_written(self):
        subprocess.run([PROGRAM, "--quiet", "--output-dir", self.folder, "2", os.path.join(SOURCE, "examples", "cattaneo")],
                       check=True, stdin=subprocess.DEVNULL, timeout=60)
        self.assertFalse([name for name in os.listdir(self.folder) if name.endswith((".vts", ".pvd", ".h5", ".jsonl"))])


if __name__ == "__main__":
    unittest.main()
