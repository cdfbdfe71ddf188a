#!/usr/bin/env python3
"""Use of the page: links, colours, zoom, touch, keys, accessibility, export, printing, groups, play, sections, view of the rail."""
import base64
import csv
import math
import os
import re
import shutil
import subprocess
import unittest
import xml.etree.ElementTree

import h5py
import numpy as np
from browser import COLOURS, PHONE, PROGRAM, SETTLED, SOURCE, NotInTime, Page, many_cases

INDEX = "contactReport.state.index"
# The page continues to scroll for a while after a touch ends
STILL = """() => new Promise(done => { let last = -1, times = 0;
  const look = () => { times = scrollY === last ? times + 1 : 0; last = scrollY;
    if (times > 20) done(); else requestAnimationFrame(look); };
  look(); })"""
# Mouse events of the page, for a click without an effect
LISTEN = """() => { if (window.heard) return; window.heard = [];
  for (const kind of ['mousedown', 'mouseup', 'click', 'scroll', 'resize'])
    addEventListener(kind, e => heard.push([kind, performance.now(), e.target.ariaLabel || e.target.id || e.target.tagName]),
      true); }"""
WIDTH = "contactReport.state.view[1] - contactReport.state.view[0]"


class Viewer(Page):
    def step(self, page, index):
        page.evaluate("i => contactReport.go(i)", index)
        page.wait_for_function(SETTLED, arg=index)

    def fields(self, name, case, patch=1):
        with h5py.File(self.results_of(name)) as file:
            group = file["case_%04d/patch_%d" % (case, patch)]
            return tuple({key: value[()] for key, value in group[part].items()} for part in ("fields", "grid", "totals"))

    def test_case_in_the_address_both_ways(self):
        address = self.page_of("wheel_on_rail")
        page = self.open(address + "#case=4", 3)
        page.keyboard.press("ArrowRight")
        page.wait_for_function(SETTLED, arg=4)
        page.wait_for_function("() => location.hash === '#case=5'")
        page.evaluate("location.hash = '#case=9'")
        page.wait_for_function(SETTLED, arg=8)
        for hash_ in ("#case=99", "#case=x", "#other"):
            page.evaluate("h => { location.hash = h; }", hash_)
        page.wait_for_timeout(100)
        self.assertEqual(page.evaluate(INDEX), 8)
        self.assertEqual(self.troubles, [])
        self.assertEqual(self.open(address + "#case=99").evaluate("location.hash"), "#case=99")

    def test_colours_are_common_or_given(self):
        page = self.open(self.page_of("wheel_on_rail"))
        scale = "k => { const s = contactReport.maps[k].scale; return [s.low, s.high]; }"
        all_fields = [self.fields("wheel_on_rail", n)[0] for n in range(1, 11)]
        largest = max(f["pn"].max() for f in all_fields)
        slip = max(np.hypot(f["sx"], f["sy"])[f["eldiv"] > 0].max() for f in all_fields)
        page.select_option("#quantity", "slip")
        for index in (0, 4):
            self.step(page, index)
            self.assertAlmostEqual(page.evaluate(scale, 0)[1], largest, delta=1e-5 * largest)
            self.assertAlmostEqual(page.evaluate(scale, 3)[1], slip, delta=1e-5 * slip)
        page.select_option("#scale", "own")
        own = self.fields("wheel_on_rail", 1)[0]["pn"].max()
        self.step(page, 0)
        self.assertAlmostEqual(page.evaluate(scale, 0)[1], own, delta=1e-5 * own)
        # user limits apply to all cases until they are reset; invalid input is marked and ignored
        page.click("button[aria-label='Pressure: tools']")
        page.fill("input[aria-label='colours of Pressure from']", "100")
        page.fill("input[aria-label='colours of Pressure to']", "900")
        page.press("input[aria-label='colours of Pressure to']", "Tab")
        self.step(page, 4)
        self.assertEqual(page.evaluate(scale, 0), [100, 900])
        page.fill("input[aria-label='colours of Pressure to']", "50")
        page.press("input[aria-label='colours of Pressure to']", "Tab")
        self.assertEqual(page.get_attribute("input[aria-label='colours of Pressure to']", "aria-invalid"), "true")
        page.click("button[aria-label='colours of Pressure automatic']")
        self.assertAlmostEqual(page.evaluate(scale, 0)[1], self.fields("wheel_on_rail", 5)[0]["pn"].max(), delta=0.1)
        self.assertEqual(self.troubles, [])

    def test_the_wheel_zooms_with_a_key_and_within_limits(self):
        page = self.open(self.page_of("cattaneo"), viewport={"width": 1400, "height": 700})
        box = page.locator("#map-pn").bounding_box()
        middle = (box["x"] + 60 + (box["width"] - 150) / 2, box["y"] + 100)
        page.mouse.move(*middle)
        before = page.evaluate("contactReport.state.view")
        page.mouse.wheel(0, 200)
        page.wait_for_function("() => scrollY > 50")
        self.assertEqual(page.evaluate("contactReport.state.view"), before)
        page.evaluate("scrollTo(0, 0)")
        page.wait_for_function("() => scrollY === 0")
        page.mouse.move(*middle)
        page.keyboard.down("Control")
        for turn, least, most in ((-300, 1 / 201, 1 / 100), (300, 2.5, 3.01)):
            for _ in range(25):
                page.mouse.wheel(0, turn)
            page.wait_for_function("([w, a, b]) => { const part = (%s) / w; return part >= a && part <= b; }" % WIDTH,
                                   arg=[before[1] - before[0], least, most])
            self.assertGreater(page.evaluate(COLOURS, "map-pn"), 1)
        page.keyboard.up("Control")
        # dragged far out of the range, a part stays in view
        for _ in range(6):
            page.mouse.move(*middle)
            page.mouse.down()
            page.mouse.move(middle[0] + 900, middle[1] + 900, steps=3)
            page.mouse.up()
        page.wait_for_timeout(100)
        self.assertGreater(page.evaluate(COLOURS, "map-pn"), 5)
        view = page.evaluate("contactReport.state.view")
        self.assertTrue(view[0] < before[1] and view[1] > before[0] and view[2] < before[3] and view[3] > before[2])
        page.mouse.dblclick(*middle)
        page.wait_for_function("w => contactReport.state.view.every((x, k) => Math.abs(x - w[k]) < 1e-9)", arg=before)
        self.assertEqual(self.troubles, [])

    def test_touch(self):
        page = self.open(self.page_of("wheel_on_rail"), viewport=PHONE, has_touch=True, is_mobile=True)
        self.assertIn("tap a plot", page.inner_text("#readout"))
        send = self.processor.send
        page.locator("#map-pn").scroll_into_view_if_needed()
        box = page.locator("#map-pn").bounding_box()
        x, y = box["x"] + 60 + (box["width"] - 152) / 2, box["y"] + 12 + (box["height"] - 52) / 2
        page.touchscreen.tap(x, y)
        page.wait_for_function("() => document.getElementById('readout').innerText.includes('N/mm')")
        before, view = page.evaluate("scrollY"), page.evaluate("contactReport.state.view")
        send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": [{"x": x, "y": y}]})
        for k in range(1, 9):
            send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": [{"x": x, "y": y - 25 * k}]})
        send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        page.wait_for_function("y => scrollY > y + 100", arg=before)
        self.assertEqual(page.evaluate("contactReport.state.view"), view)
        page.evaluate(STILL)
        page.evaluate("scrollTo(0, %d)" % before)
        page.evaluate(STILL)
        view = page.evaluate("contactReport.maps[0].shown")
        box = page.locator("#map-pn").bounding_box()
        y = box["y"] + 12 + (box["height"] - 52) / 2
        def at(d):
            return [{"x": x - d, "y": y, "id": 0}, {"x": x + d, "y": y, "id": 1}]

        here = page.evaluate("scrollY")
        send("Input.dispatchTouchEvent", {"type": "touchStart", "touchPoints": at(30)})
        for d in (40, 50, 60):
            send("Input.dispatchTouchEvent", {"type": "touchMove", "touchPoints": at(d)})
        send("Input.dispatchTouchEvent", {"type": "touchEnd", "touchPoints": []})
        page.wait_for_function("w => { const s = contactReport.maps[0].shown; return Math.abs((s[1] - s[0]) / w - .5) < .12; }",
                               arg=view[1] - view[0])
        self.assertEqual(page.evaluate("scrollY"), here)
        self.assertEqual(page.evaluate("visualViewport.scale"), 1)
        self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), PHONE["width"])
        self.assertEqual(self.troubles, [])

    def test_keys_and_words(self):
        page = self.open(self.page_of("wheel_on_rail"))
        for canvas in page.query_selector_all("canvas"):
            if canvas.is_visible():
                self.assertEqual(canvas.get_attribute("role"), "application")
                self.assertEqual(canvas.get_attribute("tabindex"), "0")
                self.assertRegex(canvas.get_attribute("aria-label"), r"^[A-Z].*: .*\d")
        fields, _, _ = self.fields("wheel_on_rail", 1)
        largest = fields["pn"].max()
        self.assertIn("%.4g" % largest, page.get_attribute("#map-pn", "aria-label"))
        page.focus("#map-pn")
        page.keyboard.press("ArrowRight")
        page.wait_for_function("() => document.getElementById('said').textContent.includes('element')")
        text = page.inner_text("#said")
        ix, iy = (int(n) - 1 for n in re.search(r"element\s+(\d+), (\d+)", text).groups())
        self.assertRegex(text, r"pn\s+%s" % re.escape("%.4g" % fields["pn"][iy, ix]))
        page.keyboard.press("ArrowDown")
        page.wait_for_function("n => document.getElementById('said').textContent.includes(n)", arg="element %d, %d" % (ix + 1, iy))
        before, shown = page.evaluate(WIDTH), page.evaluate("contactReport.maps[0].shown")
        page.keyboard.press("+")
        page.wait_for_function("w => { const s = contactReport.maps[0].shown; return s[1] - s[0] < .9 * w; }",
                               arg=shown[1] - shown[0])
        page.keyboard.press("Home")
        page.wait_for_function("w => Math.abs((%s) - w) < 1e-9" % WIDTH, arg=before)
        page.keyboard.press("Enter")
        page.wait_for_function("r => contactReport.state.row === r", arg=iy - 1)
        self.assertEqual(page.evaluate(INDEX), 0)   # arrow keys on a plot do not change the case
        # the table: one stop of the Tab key, arrow keys move inside
        self.assertEqual(page.evaluate("[...document.querySelectorAll('#cases button')].filter(b => b.tabIndex === 0).length"), 1)
        page.focus("#cases button[tabindex='0']")
        page.keyboard.press("ArrowDown")
        page.wait_for_function(SETTLED, arg=1)
        self.assertEqual(page.evaluate("document.activeElement.closest('tr').getAttribute('aria-current')"), "true")
        self.assertIn("case 2", page.get_attribute("#slider", "aria-valuetext"))
        # rotating the rail, and points of the curve
        page.focus("#plot-scene")
        turn = page.evaluate("contactReport.plots.scene.turn[0]")
        page.keyboard.press("ArrowRight")
        self.assertGreater(page.evaluate("contactReport.plots.scene.turn[0]"), turn)
        page.focus("#plot-curve")
        page.keyboard.press("ArrowRight")
        page.keyboard.press("Enter")
        page.wait_for_function(SETTLED, arg=2)
        self.assertEqual(self.troubles, [])

    def test_axe_core_finds_nothing(self):
        for name, other in (("wheel_on_rail", None), ("subsurface", None), ("cattaneo", "subsurface")):
            page = self.open(self.page_of(name, other=other))
            for opener in page.query_selector_all(".opener"):
                if opener.is_visible():
                    opener.click()
            page.click("summary")
            for size in ({"width": 1400, "height": 1000}, PHONE):
                page.set_viewport_size(size)
                page.wait_for_timeout(50)
                self.assert_accessible(page)
                self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), size["width"])
            self.assertEqual(self.troubles, [])

    def saved(self, page, name):
        # beside other programs the browser sometimes does not start a download; a button that never works fails twice
        page.evaluate(LISTEN)
        try:
            with page.expect_download(timeout=30000) as download:
                page.click("button[aria-label='%s']" % name)
        except NotInTime:
            print("no download within 30 s, clicked again:", name, page.evaluate("[performance.now(), heard.slice(-12)]"))
            with page.expect_download() as download:
                page.click("button[aria-label='%s']" % name)
        path = os.path.join(self.scratch.name, "saved")
        download.value.save_as(path)
        with open(path, "rb") as file:
            return download.value.suggested_filename, file.read()

    def table(self, page, name):
        return list(csv.reader(self.saved(page, name)[1].decode("utf-8").splitlines()))

    def test_pictures_and_tables_as_files(self):
        page = self.open(self.page_of("wheel_on_rail"))
        self.step(page, 3)
        openers = [opener for opener in page.query_selector_all(".opener") if opener.is_visible()]
        names = [re.sub(": tools$", "", opener.get_attribute("aria-label")) for opener in openers]
        self.assertEqual(len(names), 11)
        for name in names:
            page.click("button[aria-label='%s: tools']" % name)
            if page.query_selector("button[aria-label='%s as PNG']" % name):
                file, data = self.saved(page, name + " as PNG")
                self.assertRegex(file, r"^wheel_on_rail_\w+_case4_patch1\.png$")
                self.assertEqual(data[:8], b"\x89PNG\r\n\x1a\n")
                self.assertGreaterEqual(int.from_bytes(data[16:20], "big"), 1800)
                self.assertGreater(len(data), 15000, name)
                root = xml.etree.ElementTree.fromstring(self.saved(page, name + " as SVG")[1])
                tags = [element.tag.rpartition("}")[2] for element in root.iter()]
                self.assertIn("path", tags)
                self.assertGreater(tags.count("text"), 5)
                self.assertNotIn("NaN", " ".join(element.get("d", "") for element in root.iter()))
                for element in root.iter():
                    if element.tag.endswith("}image"):
                        self.assertEqual(base64.b64decode(element.get("href").split(",")[1])[:4], b"\x89PNG")
            self.assertGreater(len(self.table(page, name + " as CSV")), 5, name)
        fields, grid, totals = self.fields("wheel_on_rail", 4)
        rows = self.table(page, "Pressure as CSV")
        self.assertEqual(rows[0], ["x [mm]", "y [mm]", "state", "pn [N/mm2]"])
        np.testing.assert_allclose([float(row[3]) for row in rows[1:]], fields["pn"].ravel(), rtol=1e-6, atol=1e-4)
        np.testing.assert_allclose([float(row[0]) for row in rows[1:grid["mx"] + 1]], grid["x"], atol=1e-6)
        rows = self.table(page, "Cases as CSV")
        self.assertEqual((len(rows), rows[4][0], rows[9][1]), (11, "4", "left"))
        at = rows[0].index("fn [N]")
        self.assertAlmostEqual(float(rows[4][at]), totals["fn"], delta=1e-6 * totals["fn"])
        rows = {row[1]: row for row in self.table(page, "Totals as CSV")}
        self.assertAlmostEqual(float(rows["t_gamma"][3]), -1000 * totals["friction_power"] / grid["veloc"], places=6)
        self.assertAlmostEqual(float(rows["y_over_q"][3]), float(rows["fy_tr"][3]) / float(rows["fz_tr"][3]), places=9)
        # exporting a plot does not change the page
        self.assertGreater(page.evaluate(COLOURS, "plot-scene"), 30)
        self.assertEqual(self.troubles, [])

    def test_estimated_errors_stand_beside_totals(self):
        path = os.path.join(self.scratch.name, "judged.inp")
        shutil.copy(os.path.join(SOURCE, "examples", "cattaneo.inp"), path)
        subprocess.run([PROGRAM, "--quiet", "--errors", "--hdf5", "2", path], check=True, stdin=subprocess.DEVNULL, timeout=60)
        self.made["judged"] = path[:-4] + ".h5"
        with h5py.File(self.made["judged"]) as file:
            error = file["patches/pmax_error"][0]
        self.assertGreater(error, 0)
        page = self.open(self.page_of("judged"))
        self.assertIn("\u00b1 " + page.evaluate("e => figures(e, 2)", error), page.inner_text("#totals tr:has-text('pmax')"))
        self.assertNotIn("More", page.inner_text("#totals"))
        self.assertNotIn("pmax_error", page.inner_html("#curve-y"))
        for opener in ("Cases", "Totals"):
            page.click("button[aria-label='%s: tools']" % opener)
        rows = self.table(page, "Cases as CSV")
        self.assertAlmostEqual(float(rows[1][rows[0].index("pmax_error [N/mm2]")]), error, delta=1e-9 * error)
        rows = self.table(page, "Totals as CSV")
        self.assertEqual(rows[0][5], "estimated error")
        self.assertAlmostEqual(float(next(row for row in rows if row[1] == "pmax")[5]), error, delta=1e-9 * error)
        self.assertEqual(self.troubles, [])

    def test_on_paper(self):
        page = self.open(self.page_of("wheel_on_rail"))
        page.emulate_media(media="print")
        sizes = page.evaluate("""() => [...document.querySelectorAll('canvas')].filter(c => c.offsetParent).map(c => {
          const box = c.getBoundingClientRect(); return [box.width / box.height, c.width / c.height]; })""")
        for there, drawn in sizes:
            self.assertAlmostEqual(there, drawn, delta=0.02 * drawn)
        for hidden in ("#readout", "#play", ".opener", "#compare"):
            self.assertTrue(page.is_hidden(hidden), hidden)
        self.assertTrue(page.is_visible("#where"))
        pdf = page.pdf(format="A4")
        self.assertLessEqual(len(re.findall(rb"/Type\s*/Page\b", pdf)), 5)

    def test_totals_have_names_and_groups(self):
        page = self.open(self.page_of("wheel_on_rail"))
        with open(os.path.join(SOURCE, "doc", "user", "results.md"), encoding="utf-8") as file:
            text = file.read()
        tables = text[text.index("Totals of a contact patch:"):text.index("Element fields; the number")]
        names = set(re.findall(r"^\| `(\w+)` \|", tables, re.MULTILINE))
        self.assertGreater(len(names), 50)
        groups = page.evaluate("GROUPS")
        listed = [name for _, members in groups for name in members]
        self.assertEqual(len(listed), len(set(listed)))
        self.assertEqual(names - set(listed), set())
        self.assertNotIn("More", page.inner_text("#totals"))
        load = page.evaluate("figures(contactReport.data.cases[0].totals.fz_tr, 6)")
        self.assertRegex(page.inner_text("#totals"), r"wheel load Q\s*%s" % load)
        self.assertIn("guiding force Y", page.inner_text("#totals"))

    def test_wear_and_fatigue_where_they_were_asked_for(self):
        path = os.path.join(self.scratch.name, "worn.toml")
        with open(os.path.join(SOURCE, "examples/falling_friction.toml"), encoding="utf-8") as file:
            text = file.read()
        last = text.count("[[case]]") - 1
        with open(path, "w", encoding="utf-8") as file:
            file.write(text + "\n[case.wear]\narchard = 1e-4\nhardness = 3000\nshear_yield = 300\n")
        page = self.open(self.page_of("worn", path[:-5]) + f"#case={last + 1}", last)
        totals = page.inner_text("#totals")
        for words in ("T-gamma", "wear_index", "max_wear", "Fatigue", "fatigue_index"):
            self.assertIn(words, totals)
        self.assertNotIn("More", totals)
        page.select_option("#quantity", "wear")
        self.assertGreater(page.evaluate(COLOURS, "map-more"), 20)
        self.assertIn("wear depth", page.inner_text("#quantity"))
        self.assertEqual(self.troubles, [])

    def test_labels_apart_and_wheels_not_joined(self):
        page = self.open(self.page_of("wheel_on_rail"))
        boxes = page.evaluate("""() => { const plot = contactReport.plots.profiles;
          plot.labels(plot.brush, [740, 741, 742, 742, 760].map((y, k) => ({ number: k + 1, totals: { ycp_tr: y, zcp_tr: 1 } })));
          return plot.taken; }""")
        self.assertEqual(len(boxes), 5)
        for k, a in enumerate(boxes):
            for b in boxes[:k]:
                self.assertFalse(abs(a["x"] - b["x"]) < (a["w"] + b["w"]) / 2 and abs(a["y"] - b["y"]) < 14, (a, b))
        series = page.evaluate("contactReport.plots.curve.series.map(s => [s.name, s.points.length, s.points.map(p => p.index)])")
        self.assertEqual([(name, points) for name, points, _ in series], [("right wheel", 5), ("left wheel", 5)])
        self.assertEqual([index for _, _, indices in series for index in indices], list(range(10)))

    def test_legends_stand_above_the_curves(self):
        address = self.page_of("wheel_on_rail", other="manchester")
        for viewport in (None, PHONE):
            page = self.open(address + "#case=2", 1, **({"viewport": viewport} if viewport else {}))
            for name in ("curve", "section"):
                rows, top = page.evaluate("""name => {
                  const plot = contactReport.plots[name], rows = [], brush = plot.brush, write = brush.fillText;
                  const lines = () => name === 'curve' ? plot.series.map(s => [s.name, s.points.map(p => p.y)])
                    : plot.drawn.map(l => [l.name, l.values]);
                  const names = lines().map(l => l[0]);
                  brush.fillText = (text, x, y) => {
                    if (names.includes(text)) rows.push(y);
                    return write.call(brush, text, x, y);
                  };
                  plot.draw();
                  delete brush.fillText;
                  return [rows, Math.min(...lines().flatMap(l => l[1]).map(y => plot.Y(y)))];
                }""", name)
                self.assertGreater(len(rows), 1, name)
                self.assertGreater(top, max(rows) + 6, name)
            self.assertEqual(self.troubles, [])

    def test_play(self):
        page = self.open(self.page_of("cattaneo"))
        page.select_option("#speed", "10")
        page.click("#play")
        page.wait_for_function("() => contactReport.state.index === 1")
        page.wait_for_function("() => contactReport.state.index === 0")   # and from the start again
        page.click("#play")
        self.assertEqual(page.get_attribute("#play", "aria-pressed"), "false")
        page.wait_for_timeout(250)
        at = page.evaluate(INDEX)
        page.wait_for_timeout(400)
        self.assertEqual(page.evaluate(INDEX), at)

    def test_sections_along_x_and_y(self):
        page = self.open(self.page_of("wheel_on_rail"))
        fields, grid, _ = self.fields("wheel_on_rail", 1)
        line = "name => { const l = contactReport.plots.section.drawn.find(l => l.name === name); return [l.places, l.values]; }"
        page.evaluate("() => { contactReport.state.row = 40; contactReport.state.column = 20; }")
        for direction, axis, values in (("y", "y", fields["py"][:, 20]), ("x", "x", fields["py"][40, :])):
            page.select_option("#direction", direction)
            places, drawn = page.evaluate(line, "py")
            np.testing.assert_allclose(places, grid[axis], atol=1e-6)
            np.testing.assert_allclose(drawn, values, rtol=1e-6, atol=1e-3)
        # a click on a map chooses both
        box = page.locator("#map-pn").bounding_box()
        page.mouse.click(box["x"] + 150, box["y"] + 150)
        x, y = page.evaluate("([px, py]) => contactReport.maps[0].back(px, py)", [150, 150])
        self.assertEqual(page.evaluate("[contactReport.state.column, contactReport.state.row]"),
                         [math.floor((x - grid["xl"]) / grid["dx"]), math.floor((y - grid["yl"]) / grid["dy"])])
        self.assertEqual(self.troubles, [])

    def test_patches_on_the_rail(self):
        page = self.open(self.page_of("wheel_on_rail"))
        self.step(page, 3)
        self.assertGreater(page.evaluate(COLOURS, "plot-scene"), 60)
        _, _, totals = self.fields("wheel_on_rail", 4)
        # the contact reference is at the position given by the totals, and the axes are right-handed with z down
        place = page.evaluate("""() => { const p = contactReport.data.cases[3].patches[0], g = p.grid;
          const iy = Math.floor(-g.yl / g.dy); return contactReport.plots.scene.place(p, 0, iy, -g.yl / g.dy - iy - .5); }""")
        np.testing.assert_allclose(place, [totals["xcp_tr"], totals["ycp_tr"], totals["zcp_tr"]], atol=1e-4)
        # the wheel passes through the contact reference, which is that of the rail as well, and can be hidden
        for index in (3, 8):
            place = page.evaluate("""k => { const c = contactReport.data.cases[k], t = c.patches[0].totals;
              const angle = Math.asin(t.xcp_w / (c.radius + t.zcp_w));
              return contactReport.plots.scene.wheelPoint(c, [t.ycp_w, t.zcp_w], angle); }""", index)
            _, _, there = self.fields("wheel_on_rail", index + 1)
            np.testing.assert_allclose(place, [there["xcp_tr"], there["ycp_tr"], there["zcp_tr"]], atol=1e-2)
        inked = "() => { const c = document.getElementById('plot-scene'); return c.toDataURL(); }"
        with_wheel = page.evaluate(inked)
        page.uncheck("#scene-wheel")
        page.wait_for_function("before => document.getElementById('plot-scene').toDataURL() !== before", arg=with_wheel)
        page.check("#scene-wheel")
        page.wait_for_function("before => document.getElementById('plot-scene').toDataURL() === before", arg=with_wheel)
        x, y, z = np.array(page.evaluate("""() => { const project = contactReport.plots.scene.project, o = project([0, 0, 0]);
          return [[1, 0, 0], [0, 1, 0], [0, 0, 1]].map(e => project(e).map((v, k) => v - o[k])); }"""))
        # on the screen right, down, away from the viewer: a right-handed system
        size = np.linalg.norm(z[:2]) / math.cos(page.evaluate("contactReport.plots.scene.turn[1]"))
        x[:2], y[:2], z[:2] = x[:2] / size, y[:2] / size, z[:2] / size
        np.testing.assert_allclose(np.cross(x, y), z, atol=1e-9)
        self.assertGreater(z[1], 0)
        box = page.locator("#plot-scene").bounding_box()
        turn = page.evaluate("contactReport.plots.scene.turn")
        page.locator("#plot-scene").scroll_into_view_if_needed()
        box = page.locator("#plot-scene").bounding_box()
        page.mouse.move(box["x"] + 200, box["y"] + 100)
        page.mouse.down()
        page.mouse.move(box["x"] + 260, box["y"] + 130, steps=3)
        page.mouse.up()
        turned = page.evaluate("contactReport.plots.scene.turn")
        self.assertNotEqual(turned, turn)
        # a rotated view is kept in other cases; by default the rail is seen from the side to which the contact is inclined
        self.step(page, 8)
        self.assertEqual(page.evaluate("contactReport.plots.scene.turn"), turned)
        page.click("#reset")
        for index, side in ((8, 1), (3, -1)):
            self.step(page, index)
            self.assertGreater(side * math.cos(page.evaluate("contactReport.plots.scene.turn[0]")), 0.5)
            self.assertGreater(side * page.evaluate("contactReport.data.cases[%d].patches[0].totals.deltcp_tr" % index), 0.03)
        self.assertEqual(self.troubles, [])

    def test_incomplete_results_say_so(self):
        path = os.path.join(self.scratch.name, "broken.inp")
        many_cases(path, 3, 11)
        with open(path) as file:
            text = file.read()
        with open(path, "w") as file:
            file.write(text[:-2] + "3\n203100\n1000 nonsense\n")
        run = subprocess.run([PROGRAM, "--quiet", "--hdf5", "2", path], stdin=subprocess.DEVNULL, capture_output=True, timeout=60)
        self.assertEqual(run.returncode, 1)
        self.made["broken"] = path[:-4] + ".h5"
        page = self.open(self.page_of("broken"))
        self.assertRegex(page.inner_text("#incomplete"), r"NOT COMPLETE: 3 of (at least )?4 cases finished")
        self.assertTrue(page.is_visible("#incomplete"))
        self.assertTrue(self.open(self.page_of("cattaneo")).is_hidden("#incomplete"))


class Compared(Page):
    """Comparison of two runs: cattaneo, and the same with less friction"""

    def setUp(self):
        path = os.path.join(self.scratch.name, "less.inp")
        if "less" not in self.made:
            with open(os.path.join(SOURCE, "examples", "cattaneo.inp")) as file:
                text = file.read()
            with open(path, "w") as file:
                file.write(re.sub(r"^(\s*)(0?\.\d+)(\s+)\2(\s.*FSTAT)", r"\g<1>0.2\g<3>0.2\g<4>", text, flags=re.MULTILINE))
        self.results_of("less", path)
        self.results_of("cattaneo")

    def values(self, name):
        with h5py.File(self.results_of(name)) as file:
            return {key: value[...] for key, value in file["case_0002/patch_1/fields"].items()}

    def judge(self, page):
        page.evaluate("contactReport.go(1)")
        page.wait_for_function(SETTLED, arg=1)
        mine, other = self.values("cattaneo"), self.values("less")
        self.assertGreater(abs(mine["px"] - other["px"]).max(), 0.01)
        page.select_option("#quantity", "px")
        # colours of differences depend on the sign, even if all have the same: negative is blue, positive is red, zero is white
        for low, high, at, blue in ((-0.2, 0, 0, True), (0, 0.2, 1, False), (-0.3, -0.1, 0, True), (0, 0, 0.5, None)):
            colours = page.evaluate(
                "([l, h, at]) => { const s = coloursOf([l, h], 'signed'); return [s.low, s.high, s.colour(at)]; }", [low, high, at])
            self.assertEqual(colours[0], -colours[1])
            red, _, right = colours[2]
            self.assertTrue(abs(red - right) < 5 if blue is None else (right > red) == blue, (low, high, colours))
        for show in ("side", "difference"):
            page.select_option("#show", show)
            number, chosen_at = {"side": (2, "map-pn"), "difference": (3, "map-more")}[show]
            self.assertEqual(page.evaluate("document.querySelector('#quantity').closest('.card').querySelector('canvas').id"),
                             chosen_at)
            shown = page.evaluate("""k => { const m = contactReport.maps[k];
              return [...picture(m.choose(), m.mode()).values]; }""", number)
            np.testing.assert_allclose(np.array(shown), (mine["px"] - other["px"]).ravel(), atol=1e-5)
        page.select_option("#show", "side")
        for canvas in ("map-pn", "map-pt", "map-eldiv"):
            self.assertGreater(page.evaluate(COLOURS, canvas), 10, canvas)
        self.assertIn("other run", page.inner_text("#totals"))
        row = page.inner_text("#totals tr:has-text('fx_rel')").split("\t")
        self.assertAlmostEqual(float(row[1].strip().replace("\u2212", "-")), -0.875, places=3)
        self.assertIn("other run", page.inner_text("#plot-curve") + page.get_attribute("#map-pt", "aria-label"))
        self.assertEqual(page.evaluate("contactReport.plots.curve.series.map(s => s.run)"), [0, 1])
        self.assertEqual(self.troubles, [])

    def test_in_one_page(self):
        page = self.open(self.page_of("cattaneo", other="less"))
        self.assertIn("compared with less", page.inner_text("#about"))
        self.judge(page)

    def test_with_the_file_of_another_page(self):
        page = self.open(self.page_of("cattaneo"))
        self.assertTrue(page.is_hidden("#compared"))
        page.set_input_files("#compare-file", os.path.join(SOURCE, "README.md"))
        page.wait_for_function("() => document.getElementById('readout').innerText.includes('not a page')")
        other = self.page_of("less")[len("file://"):]
        page.set_input_files("#compare-file", other)
        page.wait_for_selector("#compared", state="visible")
        self.judge(page)

    def deep(self, name, friction, depth):
        """Stresses below a sliding ball in two blocks, the second at another depth"""
        path = os.path.join(self.scratch.name, name + ".inp")
        with open(path, "w") as file:
            file.write(f"3 MODULE\n 203103\n0022020\n0000101\n 100 100 30 1 1e-5\n 9.2 0.01 0 0\n {friction} {friction}\n"
                       " 0d 0.1 1000\n 0.42 0.42 200 200\n 1\n 24 24 -1.2 -1.2 0.1 0.1\n 1 1\n 0.01 0 0.01 0 0 0\n 2 0\n"
                       f" 1\n 6 0.1 0.2\n 1\n 2 {depth} 0.1\n 0\n0 END\n")
        with h5py.File(self.results_of(name, path)) as file:
            return file["case_0001/patch_1/subsurface/block_1/sigvm"][()].ravel()

    def test_below_the_surface(self):
        mine, other = self.deep("deep", 0.4, 0.5), self.deep("deeper", 0.2, 0.7)
        page = self.open(self.page_of("deep", other="deeper"))
        page.select_option("#stress", "sigvm")
        for show, expected, title in (("this", mine, "Below the surface"), ("other", other, "other run"),
                                    ("difference", mine - other, "this minus other"), ("side", mine - other, "this minus other")):
            page.select_option("#show", show)
            page.wait_for_function("t => document.querySelector('#card-block h2 .name').textContent.includes(t)", arg=title)
            page.wait_for_function("m => contactReport.state.block.mode === m", arg={"side": "difference"}.get(show, show))
            shown = np.array(page.evaluate("[...contactReport.state.block.values]"))
            np.testing.assert_allclose(shown, expected, atol=2e-6 * mine.max())
            self.assertGreater(page.evaluate(COLOURS, "map-block"), 30)
        self.assertGreater(abs(mine - other).max(), 0.05 * mine.max())
        self.assertIn("this minus other", page.get_attribute("#map-block", "aria-label"))
        # blocks with different points are not compared
        page.select_option("#block", "1")
        page.wait_for_function("() => contactReport.state.block.values === null")
        page.wait_for_function("() => document.getElementById('map-block').getAttribute('aria-label').includes('no block')")
        page.select_option("#show", "this")
        page.wait_for_function("() => contactReport.state.block.values !== null")
        self.assertEqual(self.troubles, [])

    def test_cases_that_the_other_run_lacks(self):
        path = os.path.join(self.scratch.name, "many.inp")
        many_cases(path, 3, 11)
        self.results_of("many", path)
        page = self.open(self.page_of("many", other="cattaneo"))
        page.evaluate("contactReport.go(2)")
        page.wait_for_function(SETTLED, arg=2)
        self.assertIn("no such case", page.inner_text("#solution"))
        self.assertIn("no such case", page.get_attribute("#map-pt", "aria-label"))
        self.assertEqual(self.troubles, [])

    def test_other_grids_are_interpolated(self):
        page = self.open(self.page_of("cattaneo"))
        far = page.evaluate("""() => {
          const from = { mx: 9, my: 7, xl: -3, yl: -2, dx: .7, dy: .6 };
          const to = { mx: 20, my: 15, xl: -2.2, yl: -1.4, dx: .2, dy: .2 };
          const f = (x, y) => 2 + 3 * x - y + .5 * x * y, centre = (g, k, axis) => g[axis + "l"] + (k + .5) * g["d" + axis];
          const exact = (g, i) => f(centre(g, i % g.mx, "x"), centre(g, Math.floor(i / g.mx), "y"));
          const values = Float64Array.from({ length: 63 }, (_, i) => exact(from, i));
          return Math.max(...resampled(values, from, to).map((v, i) => Math.abs(v - exact(to, i)))); }""")
        self.assertLess(far, 1e-5)


if __name__ == "__main__":
    unittest.main()
