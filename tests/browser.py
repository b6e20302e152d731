"""A browser of the family of Chromium, which run/test installs where the system has a package of it."""
import functools
import html
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

FLAGS = ("--headless=new", "--no-sandbox", "--disable-dev-shm-usage", "--use-angle=swiftshader", "--enable-unsafe-swiftshader",
         "--enable-logging=stderr", "--disable-extensions")
PROBE = """<body><script>document.body.textContent = document.createElement("canvas").getContext("webgl2") ? "it draws"
: "no pictures in three dimensions";</script></body>"""


def open_page(browser, page, *more):
    """The page as the browser has it after its scripts ran, in stdout; `more` flags."""
    with tempfile.TemporaryDirectory() as profile:
        return subprocess.run([browser, *FLAGS, *more, f"--user-data-dir={profile}", "--dump-dom", Path(page).as_uri()],
                              capture_output=True, text=True, timeout=120, check=False)


@functools.cache
def found():
    """Path of a browser that draws in three dimensions here, or the reason why there is none."""
    browser = next(filter(None, map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))), None)
    if browser is None:
        return None, "no Chromium here (Debian's package chromium)"
    with tempfile.TemporaryDirectory() as folder:
        page = Path(folder, "probe.html")
        page.write_text(PROBE, encoding="utf-8")
        try:
            seen = open_page(browser, page)
        except subprocess.TimeoutExpired:
            return None, f"{browser} opens no page in two minutes here"
    if "it draws" not in html.unescape(seen.stdout).replace(PROBE, ""):
        said = (seen.stdout + seen.stderr).strip().splitlines() or ["it says nothing"]
        return None, f"{browser} does not draw here: {said[-1][:200]}"
    return browser, ""


def needed(test):
    """Skips a test, with the reason, where no browser draws; returns the browser."""
    browser, reason = found()
    if browser is None:
        raise unittest.SkipTest(reason)
    return browser
