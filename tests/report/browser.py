"""A headless browser for the tests of the page: skipped (exit status 77) without h5py, Playwright for Python or chromium.

Environment: CONTACT_PROGRAM, CONTACT_SOURCE. tests/support/setup.sh installs axe-core below build/axe.
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

BROWSER = shutil.which("chromium") or shutil.which("chromium-browser")
try:
    import h5py  # noqa: F401
    from playwright.sync_api import TimeoutError as NotInTime  # noqa: F401
    from playwright.sync_api import sync_playwright
    # that of Ubuntu only tells how to install another one
    if not BROWSER or subprocess.run([BROWSER, "--version"], capture_output=True).returncode != 0:
        raise ImportError("there is no chromium that starts")
except ImportError as reason:
    print("SKIPPED: %s" % reason)
    sys.exit(77)

PROGRAM = os.environ["CONTACT_PROGRAM"]
SOURCE = os.environ["CONTACT_SOURCE"]
EXAMPLES = os.path.join(SOURCE, "examples")
sys.path.insert(0, os.path.join(SOURCE, "python"))
from contact.report import write_page

AXE = os.path.join(SOURCE, "build", "axe", "node_modules", "axe-core", "axe.min.js")
# [ms]; long, as steps are slow on a busy machine
PATIENCE = 200_000
SETTLED = "index => window.contactReport && contactReport.state.ready && contactReport.state.index === index"
# Number of different colours on a canvas; an empty canvas has one
COLOURS = """id => { const c = document.getElementById(id), p = c.getContext('2d')
  .getImageData(0, 0, c.width, c.height).data;
const seen = new Set(); for (let i = 0; i < p.length; i += 4) seen.add(p[i] * 65536 + p[i + 1] * 256 + p[i + 2]);
return seen.size; }"""
DESKTOP, PHONE = {"width": 1400, "height": 1300}, {"width": 390, "height": 844}

# Cases of 2 kN with different creepages
MANY = """3
203100
022020
0000001
999 100 30 1 1e-5
2000 {creep:.9f} 0 0
0.3 0.3
0 0.2 1000
0.28 0.28 82000 82000
1
{n} {n} -2.5 -2.5 {size} {size}
1 1
0.01 0 0.01 0 0 0
"""
NEXT = """3
203100
100000
0110001
2000 {creep:.9f} 0 0
"""


def many_cases(path, count, elements):
    """Write an input with cases of elements x elements"""
    with open(path, "w") as file:
        file.writelines((MANY if k == 0 else NEXT).format(creep=-4e-6 * (k % 400), n=elements, size=5.0 / elements)
                        for k in range(count))
        file.write("0\n")


class Page(unittest.TestCase):
    """A test case with a browser, a folder for results, and pages whose errors are recorded"""

    @classmethod
    def setUpClass(cls):
        cls.scratch = tempfile.TemporaryDirectory()
        cls.playwright = sync_playwright().start()
        cls.browser = cls.playwright.chromium.launch(executable_path=BROWSER, args=["--no-sandbox", "--disable-gpu"],
                                                     timeout=PATIENCE)
        cls.made = {}
        # pages are reused by the next test: the processes of a new one take twice the time of its contents
        cls.idle = None

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.playwright.stop()
        cls.scratch.cleanup()

    def results_of(self, name, path=None):
        """The .h5 file of an example, or of an input; computed once"""
        if name not in self.made:
            subprocess.run([PROGRAM, "--quiet", "--hdf5", "--output-dir", self.scratch.name, "2",
                            path or os.path.join(EXAMPLES, name)], check=True, stdin=subprocess.DEVNULL, timeout=300)
            self.made[name] = os.path.join(self.scratch.name, name + ".h5")
        return self.made[name]

    def page_of(self, name, path=None, other=None):
        result = self.results_of(name, path)
        target = "%s%s.html" % (result[:-3], "_" + other if other else "")
        return "file://" + write_page(result, target, self.results_of(other) if other else None)

    def new_page(self, **options):
        page = self.browser.new_page(**options)
        page.set_default_timeout(PATIENCE)
        self.addCleanup(page.close)
        return page

    def take_page(self):
        """An empty page of desktop size, without pressed keys: an idle one or a new one"""
        page = type(self).idle or self.browser.new_page(viewport=DESKTOP)
        type(self).idle = None
        page.set_default_timeout(PATIENCE)
        self.addCleanup(self.leave_page, page)
        return page

    def leave_page(self, page):
        """Reset a page for the next test"""
        if type(self).idle:
            page.close()
            return
        page.goto("about:blank")
        for key in ("Control", "Shift", "Alt"):
            page.keyboard.up(key)
        page.mouse.up()
        page.mouse.move(0, 0)
        page.emulate_media(media="screen")
        page.set_viewport_size(DESKTOP)
        type(self).idle = page

    def open(self, address, index=0, **options):
        """A fully loaded page of results; self.troubles collects errors and network requests"""
        page = self.new_page(**{"viewport": DESKTOP, **options}) if options else self.take_page()
        self.processor = page.context.new_cdp_session(page)
        self.addCleanup(self.processor.detach)
        self.processor.send("Performance.enable", {"timeDomain": "threadTicks"})
        troubles = self.troubles = []

        # the repeated reading of canvas colours is by these tests, not by the page
        def listen(message):
            if message.type in ("error", "warning") and "willReadFrequently" not in message.text:
                troubles.append(message.text)

        def fail(error):
            troubles.append(str(error))

        def watch(request):
            if not request.url.startswith(("file:", "data:", "blob:", "about:")):
                troubles.append(request.url)

        for event, action in (("console", listen), ("pageerror", fail), ("request", watch)):
            page.on(event, action)
            self.addCleanup(page.remove_listener, event, action)
        page.goto(address)
        page.wait_for_function(SETTLED, arg=index)
        return page

    def processor_time(self):
        """Processor time of the last opened page so far [s]"""
        metrics = self.processor.send("Performance.getMetrics")["metrics"]
        return next(item["value"] for item in metrics if item["name"] == "TaskDuration")

    def assert_accessible(self, page):
        """axe-core reports no violation; skipped if it is not installed"""
        if not os.path.isfile(AXE):
            print("axe-core is missing; accessibility is not tested")
            return
        with open(AXE, encoding="utf-8") as file:
            page.evaluate(file.read() + ";0")
        # passed rules are not listed element by element, which would take a third of the time
        found = page.evaluate("async () => (await axe.run({ resultTypes: ['violations'] })).violations")
        self.assertEqual([(one["id"], node["html"][:200], re.sub(r"\s+", " ", node["failureSummary"])) for one in found
                          for node in one["nodes"]], [])
