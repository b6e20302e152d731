"""The pages as a site: every page is in it, and every link within it leads to a page and a heading."""
import re
import shutil
import subprocess
import tempfile
import unittest
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote

import yaml

import program

TOP = Path(program.SOURCE)
CONFIGURATION = TOP / "packaging" / "mkdocs.yml"


class Page(HTMLParser):
    """Names of places, and addresses of links and of what the page loads."""

    def __init__(self, text):
        super().__init__()
        self.places, self.links, self.loaded = set(), [], []
        self.feed(text)

    def handle_starttag(self, tag, attrs):
        values = dict(attrs)
        self.places |= {values[name] for name in ("id", "name") if values.get(name)}
        if tag == "a" and values.get("href"):
            self.links.append(values["href"])
        elif tag in ("img", "script") and values.get("src"):
            self.loaded.append(values["src"])
        elif tag == "link" and values.get("rel") != "canonical" and values.get("href"):
            self.loaded.append(values["href"])


def listed(entries):
    for entry in entries:
        for value in entry.values():
            yield from [value] if isinstance(value, str) else listed(value)


class Site(unittest.TestCase):
    def test_every_page_is_listed(self):
        pages = {str(path.relative_to(TOP / "docs")) for path in (TOP / "docs").rglob("*.md")}
        nav = list(listed(yaml.safe_load(CONFIGURATION.read_text())["nav"]))
        self.assertEqual(len(nav), len(set(nav)))
        self.assertEqual(set(nav), pages | {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE.md"})

    def test_links_lead_to_pages_and_headings(self):
        if shutil.which("mkdocs") is None:
            self.skipTest("mkdocs is not installed (Debian's package of that name)")
        version = subprocess.run(["mkdocs", "--version"], capture_output=True, text=True, check=True).stdout
        if tuple(map(int, re.findall(r"\d+", version)[:2])) < (1, 5):
            self.skipTest("mkdocs of Debian 12, which lacks a file of its theme")
        folder = tempfile.TemporaryDirectory(prefix="pounding-site-")
        self.addCleanup(folder.cleanup)
        done = subprocess.run(["mkdocs", "build", "--strict", "-q", "-f", CONFIGURATION, "-d", folder.name],
                              capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))
        root = Path(folder.name)
        pages = {path: Page(path.read_text()) for path in root.rglob("*.html") if path.name != "404.html"}
        self.assertGreater(len(pages), 35)
        seen = 0
        for path, page in pages.items():
            for address in page.links + page.loaded:
                target, _, place = unquote(address).partition("#")
                if re.match(r"\w+:", target):
                    self.assertNotIn(address, page.loaded, f"{path.name} loads from elsewhere")
                    continue
                found = (path.parent / target.partition("?")[0]).resolve() if target else path
                self.assertTrue(found.exists(), f"{path.name} links to {address}")
                if place and found in pages:
                    seen += 1
                    self.assertIn(place, pages[found].places, f"{path.name} links to {address}")
        self.assertGreater(seen, 300)
        self.assertIn("complementarity", (root / "search" / "search_index.json").read_text())


if __name__ == "__main__":
    unittest.main()
