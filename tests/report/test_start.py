#!/usr/bin/env python3
"""The start page of the server in a real browser: a run that continues after the page is closed, folders, inputs, a form;
desktop and phone."""
import os
import shutil
import threading
import unittest

from browser import COLOURS, DESKTOP, EXAMPLES, PATIENCE, PHONE, SETTLED, NotInTime, Page, many_cases
from contact.report.server import Server

# Number of cases of the long run
LONG = 4000
STATE = "text => document.getElementById('state').textContent.includes(text)"


class Start(Page):
    def setUp(self):
        self.folder = os.path.join(self.scratch.name, self.id().rpartition(".")[2])
        shutil.copytree(os.path.join(EXAMPLES, "profiles"), os.path.join(self.folder, "study", "profiles"))
        shutil.copy(os.path.join(EXAMPLES, "cattaneo.inp"), self.folder)
        shutil.copy(os.path.join(EXAMPLES, "cattaneo.toml"), os.path.join(self.folder, "study"))
        # takes minutes on a fast machine; the test stops it after some seconds
        many_cases(os.path.join(self.folder, "long.inp"), LONG, 300)
        server = Server(self.folder, 0)
        threading.Thread(target=server.serve_forever, daemon=True).start()
        self.addCleanup(server.server_close)
        self.addCleanup(server.shutdown)
        self.address = "http://127.0.0.1:%d/" % server.server_port
        self.troubles = []

    def start(self, **options):
        page = self.new_page(**options)
        page.on("console", lambda message: self.troubles.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: self.troubles.append(str(error)))
        page.goto(self.address)
        page.wait_for_selector("#files tr")
        return page

    def wait_for_state(self, page, text):
        try:
            page.wait_for_function(STATE, arg=text)
        except NotInTime:
            self.fail("no state %r: %r, %r, %r" % (text, page.inner_text("#what"), page.inner_text("#state"),
                                                   page.inner_text("#messages")[-500:]))

    def no_troubles(self):
        self.assertEqual([text for text in self.troubles if "favicon" not in text and "404" not in text], [])

    def test_check_run_look(self):
        page = self.start(viewport=DESKTOP)
        page.click("tr[data-name=cattaneo] button:has-text('check')")
        page.wait_for_selector("#state.good")
        page.click("tr[data-name=cattaneo] button:has-text('run')")
        page.wait_for_selector("tr[data-name=cattaneo] a")
        page.wait_for_selector("#state.good")
        self.assertIn("Case     2", page.inner_text("#messages"))
        with page.expect_popup() as popup:
            page.click("tr[data-name=cattaneo] a")
        result = popup.value
        result.set_default_timeout(PATIENCE)
        result.wait_for_function(SETTLED, arg=0)
        self.assertGreater(result.evaluate(COLOURS, "map-pn"), 20)
        self.no_troubles()

    def test_a_run_survives_reloading(self):
        page = self.start(viewport=DESKTOP)
        page.click("tr[data-name=long] button:has-text('run')")
        self.wait_for_state(page, f"of {LONG}")
        page.reload()
        self.wait_for_state(page, f"of {LONG}")
        self.assertEqual(page.inner_text("#what"), "Run of long")
        self.assertIn("Case     1", page.inner_text("#messages"))
        # the first case may not have ended yet
        page.wait_for_function("() => document.getElementById('progress').value >= 1")
        page.wait_for_selector("tr[data-name=cattaneo] button:has-text('run')[aria-disabled=true]")
        page.click("tr[data-name=cattaneo] button:has-text('run')", force=True)
        self.assertEqual(page.inner_text("#what"), "Run of long", "one experiment runs at a time")
        page.click("#stop")
        self.wait_for_state(page, "stopped")
        page.wait_for_selector("tr[data-name=long] .warn")
        self.assertRegex(page.inner_text("tr[data-name=long] .warn"), r"not complete: \d+ of %d cases" % LONG)
        self.assertTrue(page.is_disabled("#stop"))
        # the messages of a finished run remain, too
        page.reload()
        self.wait_for_state(page, "stopped")
        self.assertIn("Case     1", page.inner_text("#messages"))
        self.no_troubles()

    def test_folders_input_and_form(self):
        for size in (DESKTOP, PHONE):
            page = self.start(viewport=size)
            page.click("text=study/")
            page.wait_for_selector("tr[data-name='study/cattaneo']")
            page.reload()
            page.wait_for_selector("tr[data-name='study/cattaneo']")
            page.click("tr[data-name='study/cattaneo'] button:has-text('input')")
            page.wait_for_function("() => document.getElementById('input').textContent.includes('[[case]]')")
            self.assert_accessible(page)
            page.click("#fresh")
            page.wait_for_selector("#new-kind")
            page.select_option("#new-kind", "wheel")
            self.assertEqual((page.input_value("#new-rail")[-4:], page.input_value("#new-wheel")[-4:]), (".prr", ".prw"))
            page.fill("#new-name", "made%d" % size["width"])
            page.fill("#new-poiss", "0.7")
            page.click("text=write the input")
            page.wait_for_selector("#new-answer.error")
            self.assertIn("POISS", page.inner_text("#new-answer").upper())
            page.fill("#new-poiss", "0.28")
            self.assertTrue(page.is_disabled("#new-to"), "nothing varies yet")
            page.select_option("#new-vary", "y_ws")
            page.fill("#new-to", "4")
            page.fill("#new-count", "3")
            page.click("text=write the input")
            page.wait_for_selector("tr[data-name='study/made%d']" % size["width"])
            self.assertIn("made%d.inp: 3 cases checked" % size["width"], page.inner_text("#new-answer"))
            self.assertTrue(page.is_visible("text=run it"))
            self.assert_accessible(page)
            self.assertLessEqual(page.evaluate("document.documentElement.scrollWidth"), size["width"])
            page.click("#way button:has-text('top')")
            page.wait_for_selector("tr[data-name=long]")
            page.go_back()
            page.wait_for_selector("tr[data-name='study/cattaneo']")
        self.troubles = [text for text in self.troubles if "422" not in text]
        self.no_troubles()

    def test_by_keyboard_alone(self):
        """The focus is kept when the list is rebuilt, and moves to the part that a button opens"""
        page = self.start(viewport=DESKTOP)
        focus = "() => document.activeElement.getAttribute('aria-label') || document.activeElement.id"

        def reach(label):
            for _ in range(40):
                if page.evaluate(focus) == label:
                    return
                page.keyboard.press("Tab")
            self.fail("no way to " + label)

        reach("run cattaneo")
        page.keyboard.press("Enter")
        page.wait_for_selector("#state.good")
        page.wait_for_selector("tr[data-name=cattaneo] a")
        self.assertEqual(page.evaluate(focus), "run cattaneo")
        page.keyboard.press("Tab")
        self.assertEqual(page.evaluate(focus), "show cattaneo")
        reach("input long.inp")
        page.keyboard.press("Enter")
        page.wait_for_function("() => document.activeElement.id === 'input'")
        page.focus("#back")
        page.keyboard.press("Enter")
        self.assertEqual(page.evaluate(focus), "input long.inp")
        page.focus("#fresh")
        page.keyboard.press("Enter")
        page.wait_for_function("() => document.activeElement.id === 'new-kind'")
        page.focus("[aria-label='folder study']")
        page.keyboard.press("Enter")
        page.wait_for_selector("tr[data-name='study/cattaneo']")
        self.assertEqual(page.evaluate(focus), "fresh")
        self.no_troubles()


if __name__ == "__main__":
    unittest.main()
