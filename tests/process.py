"""Runs the tool as users do: a real process, in a folder that is not the checkout."""

from __future__ import annotations

import json
import os
import re
import subprocess
import sys
from dataclasses import dataclass
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
ASSETS = ROOT / "rules" / "assets"
"""The files that the examples of rule pages name."""
SAMPLES = ROOT / "tests" / "samples"
"""Volume files as OpenVDB, NanoVDB and Field3D wrote them."""
PACKS = ROOT / "tests" / "packs"
STUDIO = PACKS / "studio"
"""A pack with rules that report the same whatever rules are built in."""
ONLY_STUDIO = ("--isolated", "--pack", STUDIO, "--select", "STU")
ROUGH = PACKS / "rough"
"""A pack that crashes, hangs, ends the process or raises, as the name of a prim says."""
TIMEOUT = 120
PROGRAM = [sys.executable, "-P", "-m", "usdvol_lint"]
_MORE_JOBS = re.compile(r"usdvol-lint: \d+ jobs are no faster than .*\n")
"""What is said where a test asks for more processes than the machine has processors."""
_TAKEN_OVER = ("PATH", "SYSTEMROOT", "TEMP", "TMP", "TMPDIR", "HOME", "USERPROFILE", "LANG")


@dataclass(frozen=True)
class Ran:
    """What came of a run."""

    code: int
    out: str
    err: str

    @property
    def json(self) -> Any:
        return json.loads(self.out)

    @property
    def stages(self) -> list[dict[str, Any]]:
        """The stages of a JSON report, each with its `findings`."""
        from stages import by_stage

        return by_stage(self.json)


def environment(**changes: str) -> dict[str, str]:
    """What the tool sees of the world: nothing that changes its colours or its imports."""
    kept = {name: os.environ[name] for name in _TAKEN_OVER if name in os.environ}
    return {**kept, "PYTHONPATH": str(ROOT), **changes}


def run(*arguments: str | Path, cwd: Path, env: dict[str, str] | None = None) -> Ran:
    """Runs the tool; only `--verbose` may show a traceback, whatever happens."""
    done = subprocess.run(
        [*PROGRAM, *map(str, arguments)],
        cwd=cwd,
        env=env or environment(),
        stdin=subprocess.DEVNULL,
        capture_output=True,
        timeout=TIMEOUT,
        check=False,
    )
    said = _MORE_JOBS.sub("", _text(done.stderr))
    ran = Ran(done.returncode, _text(done.stdout), said)
    if "--verbose" not in arguments:
        assert "Traceback" not in ran.out + ran.err, ran.out + ran.err
    return ran


def _text(data: bytes) -> str:
    return data.decode("utf-8").replace("\r\n", "\n")


AS_JSON = ("--show-settings", "--output-format", "json")


def settings(ran: Ran) -> Any:
    """What `--show-settings` printed."""
    assert (ran.code, ran.err) == (0, "")
    return ran.json


def volume(name: str) -> str:
    """A stage with one Volume of that name."""
    return f'#usda 1.0\ndef Volume "{name}"\n{{\n}}\n'


def write(folder: Path, **texts: str) -> Path:
    """Stages by name, in a folder that is made if need be."""
    folder.mkdir(parents=True, exist_ok=True)
    for name, text in texts.items():
        (folder / f"{name}.usda").write_text(text, encoding="utf-8", newline="\n")
    return folder
