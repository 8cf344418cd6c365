"""`python -m bench.formats`: times each report format over 100,000 causes, beside a bare dump.

JSON is held against `json.dumps` of the same data, the other formats against JSON.
"""

from __future__ import annotations

import gc
import json
import time
from collections.abc import Callable
from functools import partial

from usdvol_lint.model import Cover, Excerpt, Finding, Severity, Site, Source, StageReport, Status
from usdvol_lint.report import FORMATS, Options, render
from usdvol_lint.results import Report, RunInfo
from usdvol_lint.run.causes import Causes
from usdvol_lint.run.folding import folded

_FINDINGS = 100_000
_RUNS = 3
_WANTED = 3.0


def main() -> None:
    gc.disable()  # as a run does
    report = _report()
    text = render(report, "json", Options())
    data = json.loads(text)
    bare = _best(partial(json.dumps, data))
    seconds = {each: _best(partial(render, report, each, Options())) for each in FORMATS}
    print(f"{'format':<10}{'seconds':>9}{'ratio':>8}{'wanted':>8}")
    print(f"{'dumps':<10}{bare:>9.2f}")
    for format, own in seconds.items():
        ratio = own / (bare if format == "json" else seconds["json"])
        print(f"{format:<10}{own:>9.2f}{ratio:>8.2f}{_WANTED:>8.2f}")


def _best(call: Callable[[], object]) -> float:
    """The least processor time of some calls."""
    times = []
    for _ in range(_RUNS):
        began = time.process_time()
        call()
        times.append(time.process_time() - began)
    return min(times)


def _report() -> Report:
    stage = StageReport(
        "shot.usda", Status.CHECKED, findings=tuple(map(_finding, range(_FINDINGS)))
    )
    stages, causes = folded(Causes("/show"), [(stage, False)], are_declared=False)
    report = Report("0.1.0", "0.26.11", {}, "/show", stages, (), RunInfo())
    return report.with_causes(causes)


def _finding(number: int) -> Finding:
    """One as a run has it: a missing file, each at a field of its own."""
    prim, layer = f"/World/Volume_{number // 25}/field_{number % 25}", "/show/shot.usda"
    site = Site(
        layer="shot.usda",
        prim=prim,
        property="filePath",
        line=number,
        column=26,
        at_default=True,
        excerpt=Excerpt(f"asset filePath = @./missing_{number}.vdb@", 18),
    )
    return Finding(
        code="AST002",
        name="file-missing",
        severity=Severity.ERROR,
        message=f"no file at './missing_{number}.vdb'",
        site=site,
        source=Source(layer, prim, "filePath"),
        cover=Cover(Severity.ERROR, None, at_default=True),
        suggestion="write or copy it there, or name a file that is there",
        help="usdvol-lint --explain AST002",
    )


if __name__ == "__main__":
    main()
