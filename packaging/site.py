"""What mkdocs.yml needs beside the pages of docs: those at the top of the repository, headings as links name them."""

import re
import tempfile
from pathlib import Path

from mkdocs.structure.files import File

TOP = Path(__file__).resolve().parents[1]
made = tempfile.TemporaryDirectory(prefix="pounding-site-")  # lives as long as mkdocs does


def slug(heading: str, separator: str) -> str:
    """The name of a heading in links: small letters, hyphens for spaces, without marks."""
    return re.sub(r"[^\w\- ]", "", heading.strip().lower()).replace(" ", separator)


def on_config(config):
    config["mdx_configs"]["toc"] = {"slugify": slug, "permalink": True}
    return config


def on_files(files, config):
    for name in ("README.md", "CONTRIBUTING.md", "CHANGELOG.md", "LICENSE"):
        text = (TOP / name).read_text()
        if name == "LICENSE":
            name, text = "LICENSE.md", "# Licence\n\n```\n" + text + "```\n"
        text = text.replace("](docs/", "](").replace("](LICENSE)", "](LICENSE.md)")
        Path(made.name, name).write_text(text)
        files.append(File(name, made.name, config["site_dir"], config["use_directory_urls"]))
    return files
