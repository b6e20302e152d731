"""Where a report comes from: date, machine, program and libraries, the inputs with their hashes, and all options."""

from pounding.results import Result
from .markup import folded, html_table, paragraphs

SHOWN_OVERRIDES = 6  # in a title


def overrides(result: Result) -> dict:
    """Options of the command line by which the run is another one than its files say."""
    return result.summary.get("overrides", {})


def title(result: Result) -> str:
    """The title of the run, and what the command line changed; a title from the command line stands alone."""
    changed = overrides(result)
    if not changed or "title" in changed:
        return result.title
    parts = [f"{name} {value}".strip() for name, value in list(changed.items())[:SHOWN_OVERRIDES]]
    more = f" and {len(changed) - len(parts)} more options" if len(changed) > len(parts) else ""
    return f"{result.title}, with {', '.join(parts)}{more}"


def line(result: Result) -> str:
    """One line under the title."""
    summary = result.summary
    date = str(summary.get("started", "")).replace("T", " ")
    words = [f"Computed {date}" if date else "", f"pounding {summary['version']} ({summary.get('commit', 'unknown')})"
             if "version" in summary else "", f"results in {result.folder.resolve()}" if summary else ""]
    return "; ".join(word for word in words if word)


def run_rows(result: Result) -> list:
    summary = result.summary
    machine = summary.get("machine", {})
    rows = [("started", summary.get("started")), ("ended", summary.get("ended")),
            ("machine", ", ".join(machine.get("names", [])) or None), ("processor", machine.get("processor")),
            ("folder of the run", machine.get("folder")), ("ranks", summary.get("ranks")),
            ("pounding", f"{summary['version']}, commit {summary.get('commit', 'unknown')}" if "version" in summary else None)]
    rows += list(summary.get("versions", {}).items())
    return [row for row in rows if row[1] is not None]


def tables(result: Result) -> str:
    changed = list(overrides(result).items())
    inputs = [(one["file"], one["option"], one["bytes"], one["sha256"]) for one in result.summary.get("inputs", [])]
    text = html_table("Date, machine, program", ["", ""], run_rows(result), text=(1,))
    text += html_table("Options of the command line, before those of the files", ["", ""], changed, text=(1,))
    text += html_table("Inputs, as they were when the run began (SHA-256)", ["file", "named by", "bytes", "SHA-256"], inputs,
                       text=(1,), hashes=(3,))
    text += html_table("Files beside this page", ["", ""], [tuple(one.values()) for one in result.summary.get("files", [])], text=(1,))
    if str(result.summary.get("commit", "")).endswith("-changed"):
        text += paragraphs(["The sources of the program were not those of the commit: build a committed state before a report is "
                            "filed."], kind="note")
    return text


def options(result: Result) -> str:
    """All options in force, small, behind a click and not on paper: resolved.yaml has them."""
    table = html_table("", ["option", "value"], list(result.summary.get("options", {}).items()), text=(1,))
    return folded("All options in force, as resolved.yaml has them", [table], small=True)
