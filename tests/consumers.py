"""Reports as other tools read them: checked against the schemas of these tools."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import jsonschema  # type: ignore[import-untyped]
import pytest

from usdvol_lint.report import Options, render
from usdvol_lint.results import Report

_SCHEMAS = Path(__file__).parent / "schemas"


_ENTRY = {"description", "check_name", "fingerprint", "severity", "location"}


def _validator(name: str) -> Any:
    schema = json.loads((_SCHEMAS / name).read_text(encoding="utf-8"))
    return jsonschema.Draft202012Validator(schema)


_SARIF = _validator("sarif-2.1.0.schema.json")  # which allows nothing that it does not describe
_GITLAB = _validator("gitlab-code-quality.schema.json")


def sarif(report: Report, options: Options | None = None) -> Any:
    """The run of a valid SARIF file."""
    return sarif_run(render(report, "sarif", options or Options()))


def sarif_run(text: str) -> Any:
    """The same, of a file that was written."""
    assert text.isascii()
    written = json.loads(text, parse_constant=pytest.fail)
    (run,) = written["runs"]
    few = {**run, "results": run["results"][:20]}  # thousands of them take minutes
    _SARIF.validate({**written, "runs": [few]})
    return run


def gitlab(report: Report, options: Options | None = None) -> Any:
    """The entries of a valid Code Quality file."""
    return gitlab_entries(render(report, "gitlab", options or Options()))


def gitlab_entries(text: str) -> Any:
    """The same, of a file that was written; it has nothing that GitLab does not read."""
    assert text.isascii()
    written = json.loads(text, parse_constant=pytest.fail)
    _GITLAB.validate(written)
    assert all(set(entry) == _ENTRY for entry in written)
    return written
