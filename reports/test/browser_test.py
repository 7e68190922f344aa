"""In a headless browser, pages of the report must give no console messages, decode all images and fit the window.
Skipped without Chromium."""
import html
import re
import shutil
import subprocess
import unittest

from harness.tools.kit.program import ProgramTest, drawn, run

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which(
    "google-chrome")

DRIVER = """<!DOCTYPE html><html><head><link rel="icon" href="data:,"></head><body><pre id="out"></pre>{frames}<script>
addEventListener("load", () => {{
  let out = [];
  for (const frame of document.querySelectorAll("iframe")) {{
    const inner = frame.contentDocument;
    for (const image of inner.images) if (!image.complete || image.naturalWidth == 0) out.push("image " + image.src);
    if (inner.documentElement.scrollWidth > inner.documentElement.clientWidth + 1) out.push("wider than the window: " + frame.src);
  }}
  document.getElementById("out").textContent = out.join("\\n") + "\\nseen " + document.querySelectorAll("iframe").length;
}});
</script></body></html>"""


def chromium(folder, *arguments, software=False):
    graphics = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader"
                ] if software else ["--disable-gpu"]
    return subprocess.run([
        CHROMIUM, "--headless", "--no-sandbox", *graphics, "--allow-file-access-from-files",
        f"--user-data-dir={folder}/profile", "--enable-logging=stderr", "--window-size=1400,1000",
        *arguments
    ],
                          capture_output=True,
                          text=True,
                          check=False)


def console(done):
    return [line for line in done.stderr.splitlines() if "CONSOLE" in line]


@unittest.skipUnless(CHROMIUM, "needs chromium")
class Browser(ProgramTest):

    @classmethod
    def setUpClass(cls):
        folder = cls.class_folder()
        bench = folder / "bench.h5"
        run("bench", "elastica", "-f", "collocation", "-f", "beamw", "-o", bench)
        cls.site = drawn(folder,
                         "-k",
                         "warping_torsion/default or elastica/default",
                         "--shapes",
                         options=("--bench", bench))

    def open_all(self, pages):
        driver = self.site / "driver.html"
        frames = "".join(f'<iframe width="1300" height="900" src="{html.escape(p.name)}"></iframe>'
                         for p in pages)
        driver.write_text(DRIVER.format(frames=frames), encoding="utf-8")
        try:
            done = chromium(self.folder, "--virtual-time-budget=60000", "--dump-dom",
                            driver.as_uri())
        finally:
            driver.unlink()
        return done, re.search(r'<pre id="out">(.*?)</pre>', done.stdout, re.S)

    def test_pages(self):
        pages = sorted(self.site.glob("*.html"))
        self.assertGreater(len(pages), 8)
        done, out = self.open_all(pages)
        self.assertEqual(console(done), [])
        self.assertIsNotNone(out, done.stderr[-2000:])
        self.assertEqual(out.group(1).strip(), f"seen {len(pages)}")

    def test_first_column_stays(self):
        """At 390 pixels, a wide table scrolls below its first column, and no page is wider than the window."""
        driver = self.site / "narrow.html"
        driver.write_text("""<!DOCTYPE html><body><iframe width="390" height="800" src="papers.html"></iframe><pre id="out"></pre><script>
addEventListener("load", () => {
  const inner = document.querySelector("iframe").contentDocument, out = [];
  for (const box of inner.querySelectorAll(".scroll")) {
    if (box.scrollWidth <= box.clientWidth) continue;
    const cell = [...box.querySelectorAll("tr")].find(row => row.children.length > 3 && !row.querySelector("[colspan]")).firstElementChild;
    const before = cell.getBoundingClientRect().left;
    box.scrollLeft = 80;
    out.push(Math.abs(cell.getBoundingClientRect().left - before) < 2 && box.scrollLeft == 80 ? "fixed" : "moves");
  }
  const whole = inner.documentElement;
  document.getElementById("out").textContent = [...new Set(out), whole.scrollWidth <= whole.clientWidth + 1 ? "fits" : "wider"].join(" ");
});
</script></body>""", encoding="utf-8")
        try:
            done = chromium(self.folder, "--virtual-time-budget=60000", "--dump-dom", driver.as_uri())
        finally:
            driver.unlink()
        self.assertEqual(re.search(r'<pre id="out">(.*?)</pre>', done.stdout, re.S).group(1), "fixed fits")

    def test_sizes_of_pages(self):
        for page in self.site.glob("*.html"):
            self.assertLess(page.stat().st_size, 400_000, page.name)

    def test_what_is_wrong_is_seen(self):
        page = self.site / "planted.html"
        page.write_text(
            '<img src="nowhere.svg"><script>nothing()</script><div style="width:3000px">wide</div>',
            encoding="utf-8")
        try:
            done, out = self.open_all([page])
        finally:
            page.unlink()
        self.assertTrue(any("nothing is not defined" in line for line in console(done)),
                        done.stderr[-2000:])
        self.assertIn("nowhere.svg", out.group(1))
        self.assertIn("wider than the window", out.group(1))

    def test_prints(self):
        pdf = self.folder / "convergence.pdf"
        chromium(self.folder, "--no-pdf-header-footer", f"--print-to-pdf={pdf}",
                 (self.site / "convergence.html").as_uri())
        content = pdf.read_bytes()
        self.assertTrue(content.startswith(b"%PDF"))
        self.assertGreaterEqual(len(re.findall(rb"/Type\s*/Page\b", content)),
                                2)


if __name__ == "__main__":
    unittest.main()
