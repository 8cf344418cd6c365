"""A baseline and a report as a run on the broken example writes them."""

from __future__ import annotations

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory

from process import ROOT, run


def real_texts() -> tuple[bytes, bytes]:
    """The bytes of the baseline, and those of the JSON report."""
    with TemporaryDirectory(prefix="usdvol-fuzz-") as made:
        folder = Path(made).resolve()
        shutil.copytree(ROOT / "docs" / "examples" / "broken", folder / "broken")
        outputs = ("--write-baseline", "b.jsonl", "--output-format", "json", "--output", "r.json")
        run("--isolated", "--root", ".", *outputs, "broken", cwd=folder)
        return (folder / "b.jsonl").read_bytes(), (folder / "r.json").read_bytes()
