#!/usr/bin/env python3
"""The page in a real browser: no errors, drawn maps, stepping, values under the pointer, pan and zoom."""
import os
import unittest

import h5py
from browser import COLOURS, SETTLED, Page, many_cases


class Browser(Page):
    def test_shift_of_a_ball(self):
        page = self.open(self.page_of("cattaneo"))
        for canvas in ("map-pn", "map-eldiv", "plot-section", "plot-curve"):
            self.assertGreater(page.evaluate(COLOURS, canvas), 5, canvas)
        self.assertTrue(page.is_hidden("#card-pt"))
        self.assertTrue(page.is_hidden("#card-profiles"))
        page.keyboard.press("ArrowRight")
        page.wait_for_function(SETTLED, arg=1)
        self.assertIn("case 2", page.inner_text("#where"))
        self.assertTrue(page.is_visible("#card-pt"))
        self.assertGreater(page.evaluate(COLOURS, "map-pt"), 20)
        self.assertIn("NormCG", page.inner_text("#solution"))
        # the middle of the contact is in adhesion and has the largest pressure
        box = page.locator("#map-pn").bounding_box()
        page.mouse.move(box["x"] + 58 + (box["width"] - 142) / 2, box["y"] + 12 + (box["height"] - 52) / 2)
        page.wait_for_function("() => document.getElementById('readout').innerText.includes('adhesion')")
        readout = page.inner_text("#readout").replace("\n", " ")
        largest = page.evaluate("Math.max(...contactReport.state.fields.pn)")
        self.assertRegex(readout, r"pn\s*%.2f" % largest)
        # zoom and pan change the view, a double click shows all again
        before = page.evaluate("contactReport.state.view")
        page.keyboard.down("Control")
        page.mouse.wheel(0, -300)
        page.keyboard.up("Control")
        page.wait_for_function("w => contactReport.state.view[1] - contactReport.state.view[0] < 0.8 * w",
                               arg=before[1] - before[0])
        zoomed = page.evaluate("contactReport.state.view")
        page.mouse.down()
        page.mouse.move(box["x"] + 120, box["y"] + 60, steps=4)
        page.mouse.up()
        page.wait_for_function("x => Math.abs(contactReport.state.view[0] - x) > 1e-3", arg=zoomed[0])
        page.mouse.dblclick(box["x"] + 150, box["y"] + 100)
        page.wait_for_function("w => contactReport.state.view.every((x, k) => Math.abs(x - w[k]) < 1e-9)", arg=before)
        self.assertEqual(self.troubles, [])

    def test_wheel_on_rail(self):
        page = self.open(self.page_of("wheel_on_rail"))
        self.assertTrue(page.is_visible("#card-profiles"))
        self.assertGreater(page.evaluate(COLOURS, "plot-profiles"), 10)
        page.select_option("#quantity", "slip")
        page.click("#cases tbody tr:nth-child(4)")
        page.wait_for_function(SETTLED, arg=3)
        self.assertIn("fz_tr", page.inner_text("#totals"))
        page.fill("#slider", "9")
        page.wait_for_function(SETTLED, arg=9)
        self.assertTrue(page.is_disabled("#next"))
        self.assertEqual(self.troubles, [])

    def test_temperatures_and_one_row(self):
        page = self.open(self.page_of("sliding_temperature"))
        self.assertEqual(page.input_value("#quantity"), "temp1")
        self.assertGreater(page.evaluate(COLOURS, "map-more"), 20)
        page = self.open(self.page_of("carter2d"))
        self.assertGreater(page.evaluate(COLOURS, "plot-section"), 10)
        self.assertEqual(self.troubles, [])

    def test_stresses_below_the_surface(self):
        page = self.open(self.page_of("subsurface"))
        page.set_viewport_size({"width": 1400, "height": 2200})
        self.assertTrue(page.is_visible("#card-block"))
        page.evaluate("contactReport.go(1)")
        page.wait_for_function(SETTLED, arg=1)
        self.assertGreater(page.evaluate(COLOURS, "map-block"), 100)
        block = page.evaluate("contactReport.state.block")
        self.assertEqual((block["name"], block["plane"]), ("sigvm", "y"))
        # the value at the pointer is that of the nearest point in the file
        with h5py.File(os.path.join(self.scratch.name, "subsurface.h5")) as file:
            values = file["case_0002/patch_1/subsurface/block_1/sigvm"][...]
            points = {axis: file["case_0002/patch_1/subsurface/block_1/points/" + axis][...] for axis in "xyz"}
        place = block["place"]
        at = page.evaluate("([x, z]) => ({ x: contactReport.plots.block.X(x), y: contactReport.plots.block.Y(z) })",
                           [float(points["x"][10]), float(points["z"][1])])
        page.hover("#map-block", position=at)
        page.wait_for_function("() => document.getElementById('readout').innerText.includes('von Mises')")
        readout = page.inner_text("#readout").replace("\n", " ")
        self.assertRegex(readout, "von Mises stress ?%s" % float("%.5g" % values[1, place, 10]))
        # another plane, its position, another stress
        page.select_option("#plane", "z")
        page.fill("#depth", "2")
        page.select_option("#stress", "sigzz")
        page.wait_for_function(
            "() => { const b = contactReport.state.block; return b.plane === 'z' && b.place === 2 && b.name === 'sigzz'; }"
        )
        self.assertGreater(page.evaluate(COLOURS, "map-block"), 100)
        # a line of points, and a case without points
        page.select_option("#block", "1")
        page.wait_for_function("() => contactReport.state.block.x.length === 1")
        self.assertGreater(page.evaluate(COLOURS, "map-block"), 10)
        self.assertEqual(self.troubles, [])
        page = self.open(self.page_of("carter2d"))
        self.assertTrue(page.is_hidden("#card-block"))
        self.assertEqual(self.troubles, [])

    def test_narrow_and_other_side(self):
        page = self.open(self.page_of("wheel_on_rail"))
        page.set_viewport_size({"width": 400, "height": 800})
        page.wait_for_function("() => document.documentElement.scrollWidth <= 400")
        # right and left side: the contact is in view on both
        for index in (0, 5):
            page.evaluate("contactReport.go(%d)" % index)
            page.wait_for_function(SETTLED, arg=index)
            low, high = page.evaluate("contactReport.plots.profiles.shown.slice(0, 2)")
            at = page.evaluate("contactReport.data.cases[%d].patches[0].totals.ycp_tr" % index)
            self.assertTrue(low < at < high)
        self.assertEqual(self.troubles, [])

    def test_a_thousand_cases(self):
        path = os.path.join(self.scratch.name, "many")
        many_cases(path + ".inp", 1000, 25)
        address = self.page_of("many", path)
        page = self.open(address)
        self.assertLess(self.processor_time(), 30.0)
        self.assertEqual(page.input_value("#curve-x"), "cksi")
        page.fill("#slider", "999")
        page.wait_for_function(SETTLED, arg=999)
        self.assertIn("1000 of 1000", page.inner_text("#where"))
        self.assertEqual(self.troubles, [])


if __name__ == "__main__":
    unittest.main()
