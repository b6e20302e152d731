"""The page of a campaign: the paper's tables and figures with ours, the findings, the impacts."""

import json
from pathlib import Path

from pounding.files import write_text
from pounding.plot.markup import figure_parts, html_table, paragraphs, write_page

from . import findings, paper, paper_tables, results
from .cases import VARIANTS
from .results import Campaign


def _findings(campaign: Campaign) -> str:
    checks = findings.check_all(campaign)
    summary = html_table("Findings of the paper", ["finding", "found", "of"], findings.totals(checks))
    rows = [(check.finding, check.case, check.figure, "found" if check.found else "NOT found") for check in checks]
    criteria = _note("Found means: " + "; ".join(findings.CRITERIA) + ".")
    return summary + criteria + html_table("Case by case", ["finding", "case", "figure", ""], rows)


def _excitations(campaign: Campaign) -> str:
    rows = []
    for gap in paper.GAPS:
        row = [f"gap {gap} cm"]
        for motion in paper.MOTIONS:
            one = campaign.get(gap, motion, "A")
            row += [paper.PGA[gap][motion], float(one.series["ground_peaks"][0]) / paper.G if one else None]
        rows.append(row)
    head = [""] + [text for motion in paper.MOTIONS for text in (f"{motion}: paper", "ours")]
    return html_table("Table 3: peak ground acceleration along x, as prescribed and as met by the runs [g]", head, rows)


def _damping(summaries: dict) -> str:
    rows = []
    for name, (alpha, beta) in paper.DAMPING.items():
        options = summaries["A"]["options"]
        rows.append((name, alpha, float(options[f"{name}_damping_alpha"]), beta,
                     float(options[f"{name}_damping_beta"])))
    return html_table("Table 2: Rayleigh damping", ["structure", "α [1/s]: paper", "ours", "β [s]: paper", "ours"],
                      rows)


def _runs(campaign: Campaign) -> str:
    rows = [(f"gap {one.case.gap} cm, {one.case.motion}", VARIANTS[one.case.variant], one.summary["end_time"],
             one.summary["steps"], one.summary["time_step"], one.summary["wall_time"],
             one.summary["microseconds_per_step"], one.summary["energy"]["relative_residual"])
            for one in campaign.all() if one.run == one.case]
    multiples = [one for one in campaign.all() if one.run != one.case]
    told = _note("Without pounding the response grows with the motion: " + "; ".join(
        f"gap {one.case.gap} cm, {one.case.motion} is {one.case.pga / one.run.pga:.4g} times that of the run for gap "
        f"{one.run.gap} cm" for one in multiples) + ".") if multiples else ""
    return told + html_table("Runs", ["case", "variant", "duration [s]", "steps", "time step [s]", "wall time [s]",
                               "µs per step", "energy residual"], rows)


def _note(*texts: str) -> str:
    return paragraphs(texts, kind="note")


def write(campaign: Campaign, summaries: dict, failures: dict, pages: list, folder: Path, notes: list) -> Path:
    """report.html in `folder`, with findings.json for programs. `failures`: case -> why it is not
    there; `summaries`: of the models as they are in the paper, for Tables 1 and 2."""
    checks = [vars(check) for check in findings.check_all(campaign)]
    write_text(folder / "findings.json", json.dumps(checks, indent=1))
    failed = [(case.name, why) for case, why in failures.items() if why]
    title = "The two-storey pair: the paper's campaign"
    before = _note(*notes) + html_table("Cases that failed", ["case", "why"], failed) + _findings(campaign)
    if summaries:
        before += (html_table(*paper_tables.frequency_table(summaries)) + html_table(*paper_tables.time_step_table(summaries))
                   + _damping(summaries))
    after = html_table("Impacts by case and floor", results.IMPACT_HEAD, results.impact_rows(campaign.all()))
    after += _note("left: share of the impulse in the half of the face at y = 0; bottom: in its lower half; at "
                   f"both ends: impacts of which each half took over {100 * (1 - results.AT_AN_END):.0f} %.")
    return write_page(folder / "report.html", title, figure_parts(folder, pages), before=before + _excitations(campaign),
                      after=after + _runs(campaign))
