"""`python -m tests.hosts`: what Microsoft's SARIF validator says of the reports of real runs."""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tarfile
from collections import Counter
from collections.abc import Iterator
from pathlib import Path
from shutil import which
from tempfile import TemporaryDirectory
from typing import Any

_ROOT = Path(__file__).resolve().parents[2]
_PACKAGE = "@microsoft/sarif-multitool-linux"
_CACHE = Path.home() / ".cache" / "usdvol-lint-hosts"

RUNS = {
    "broken": ["docs/examples/broken"],
    "clean": ["docs/examples/shot", "--category", "shots"],
    "never": ["docs/examples/broken", "--fail-on", "never"],
    "unreadable": ["docs/examples/nowhere.usda"],
    "misconfigured": ["docs/examples/shot", "--ignore", "XYZ999"],
}
"""By name the arguments of each run."""
ACCEPTED = {
    "SARIF2002": "messages are sentences of their own: there is no list of formats to refer to",
    "SARIF2003": "the host that reads the file knows of which commit it is",
    "SARIF2005": "the tool has no page on the web to name",
    "SARIF2006": "needs the network, to fetch $schema",
    "SARIF2010": "the line is there where the layer is a text of the repository",
    "SARIF2011": "the host has the file itself",
    "SARIF2012": "rules have no page on the web, and the names that configurations use",
}
"""What is left as it is, and why."""


def main() -> int:
    """Validates the report of each run; 1 where the validator says what is not accepted."""
    chosen = _arguments()
    chosen.cache.mkdir(parents=True, exist_ok=True)
    validator = _validator(chosen.cache)
    unwanted = 0
    with TemporaryDirectory(prefix="hosts-") as folder:
        for name, arguments in RUNS.items():
            report = Path(folder) / f"{name}.sarif"
            _lint(report, arguments)
            said = Counter(_said(validator, report))
            for (code, level, text), number in sorted(said.items()):
                why = ACCEPTED.get(code, "")
                unwanted += not why
                print(f"{name}: {code} {level} x{number}: {why or text}")
            if not said:
                print(f"{name}: nothing to say")
    return 1 if unwanted else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m tests.hosts", description=__doc__)
    parser.add_argument(
        "--cache", type=Path, default=_CACHE, help=f"where the validator is kept ({_CACHE})"
    )
    return parser.parse_args()


def _validator(cache: Path) -> Path:
    """The program, fetched with npm where it is not there yet; it brings its own runtime."""
    program = cache / "package" / "Sarif.Multitool"
    if not program.exists():
        npm = which("npm")
        if npm is None:
            sys.exit(f"npm is not installed, which fetches {_PACKAGE}")
        done = subprocess.run(
            [npm, "pack", "--silent", _PACKAGE], cwd=cache, capture_output=True, text=True
        )
        if done.returncode:
            sys.exit(f"npm pack {_PACKAGE}: {done.stderr.strip()}")
        with tarfile.open(cache / done.stdout.split()[-1]) as archive:
            archive.extractall(cache, filter="data")
        program.chmod(0o755)
    return program


def _lint(report: Path, arguments: list[str]) -> None:
    subprocess.run(
        [
            *(sys.executable, "-P", "-m", "usdvol_lint", "--isolated", "--quiet"),
            *("--output-format", "sarif", "--output", report, *arguments),
        ],
        cwd=_ROOT,
        capture_output=True,
        env={**os.environ, "PYTHONPATH": str(_ROOT)},
    )


def _said(validator: Path, report: Path) -> Iterator[tuple[str, str, str]]:
    """Rule, level and text of each result, without the text of what is accepted.

    The exit code of the validator says nothing.
    """
    results = report.with_suffix(".results")
    done = subprocess.run(
        [
            *(validator, "validate", report, "--rule-kind", "Sarif;Ghas"),
            *("--level", "Error;Warning;Note", "--log", "ForceOverwrite", "--output", results),
        ],
        env={**os.environ, "DOTNET_SYSTEM_GLOBALIZATION_INVARIANT": "1"},
        capture_output=True,
        text=True,
    )
    if not results.exists():
        sys.exit(f"the validator wrote nothing: {done.stdout}{done.stderr}")
    (run,) = json.loads(results.read_text(encoding="utf-8-sig"))["runs"]
    rules = {rule["id"]: rule for rule in run["tool"]["driver"].get("rules", ())}
    for result in run.get("results", ()):
        code = result["ruleId"].partition("/")[0]
        text = "" if code in ACCEPTED else _text(result["message"], rules.get(code, {}))
        yield code, result.get("level", "warning"), text
    for invocation in run.get("invocations", ()):
        for told in invocation.get("toolExecutionNotifications", ()):
            yield "validator", told.get("level", "warning"), told["message"].get("text", "")


def _text(message: dict[str, Any], rule: dict[str, Any]) -> str:
    if "text" in message:
        return str(message["text"])
    template = rule["messageStrings"][message["id"]]["text"]
    return str(template.format(*message.get("arguments", ())))


if __name__ == "__main__":
    sys.exit(main())
