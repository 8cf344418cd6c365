"""The files for GitLab, Jenkins and Azure: their shell lines run, and write what is published."""

from __future__ import annotations

import os
import re
import shutil
import subprocess
import sys
from collections.abc import Iterator
from importlib.util import find_spec
from pathlib import Path
from textwrap import dedent
from typing import Any

import pytest
import yaml
from actionsteps import path_with
from process import ROOT, environment

from usdvol_lint.report import FORMATS

FOLDER = ROOT / "docs" / "ci"
FILES = {
    "github.md": "github-workflow.yml",
    "gitlab.md": "gitlab-ci.yml",
    "jenkins.md": "Jenkinsfile",
    "azure.md": "azure-pipelines.yml",
}
needs_bash = pytest.mark.skipif(
    os.name == "nt" or shutil.which("bash") is None, reason="needs a bash of its own"
)


def text(name: str) -> str:
    return (FOLDER / name).read_text(encoding="utf-8")


def loaded(name: str) -> Any:
    return yaml.safe_load(text(name))


@pytest.mark.parametrize("page", FILES)
def test_a_page_shows_its_file(page: str) -> None:
    blocks = re.findall(r"^```\w+\n(.*?)^```$", text(page), re.MULTILINE | re.DOTALL)
    assert text(FILES[page]) in blocks


def of_gitlab() -> tuple[list[str], set[str]]:
    job = loaded("gitlab-ci.yml")["usdvol-lint"]
    artifacts = job["artifacts"]
    assert artifacts["when"] == "always", "a job that fails has them too"
    assert set(artifacts["reports"]) == {"codequality", "junit"}
    assert set(artifacts["reports"].values()) == set(artifacts["paths"])
    return job["script"], set(artifacts["paths"])


def of_jenkins() -> tuple[list[str], set[str]]:
    said = text("Jenkinsfile")
    assert said.count("{") == said.count("}")
    post = said[said.index("always {") :]
    published = re.findall(r"(?:testResults|pattern): '([^']+)'", post)
    scripts = re.findall(r"sh '''\n(.*?)'''", said, re.DOTALL)
    return [dedent(each) for each in scripts], set(published)


def of_azure() -> tuple[list[str], set[str]]:
    steps = loaded("azure-pipelines.yml")["steps"]
    publishing = [step for step in steps if "condition" in step]
    assert {step["condition"] for step in publishing} == {"succeededOrFailed()"}
    published = {
        step["publish"] if "publish" in step else step["inputs"]["testResultsFiles"]
        for step in publishing
    }
    return [step["bash"] for step in steps if "bash" in step], published


def outputs(script: str) -> Iterator[tuple[str, str]]:
    """The formats that a script asks for, each with its file."""
    yield from re.findall(r"--output-format (\w+) --output (\S+)", script)


@needs_bash
@pytest.mark.parametrize("read", [of_gitlab, of_jenkins, of_azure])
@pytest.mark.parametrize(("shots", "code"), [("shot", 0), ("broken", 1), (None, 2)])
def test_what_is_published_is_written(
    read: Any, shots: str | None, code: int, tmp_path: Path
) -> None:
    """Whether the stages are clean or not, and where they can't be read."""
    (*setup, check), published = read()
    assert all("pip install --quiet" in each for each in setup)
    written = dict(outputs(check))
    assert set(written.values()) == published
    lacking = [name for name in written if not find_spec(f"usdvol_lint.report.{_module(name)}")]
    if lacking:
        pytest.skip(f"there is no writer of {', '.join(lacking)} yet")
    for name in ("shots", "assets"):
        if shots:
            shutil.copytree(ROOT / "docs" / "examples" / shots, tmp_path / name)
    tool = tmp_path / ".usdvol-lint" / "bin"
    tool.mkdir(parents=True)
    (tool / "usdvol-lint").write_text(
        f'#!/bin/sh\nexec "{sys.executable}" -P -m usdvol_lint "$@"\n', encoding="utf-8"
    )
    (tool / "usdvol-lint").chmod(0o755)
    done = subprocess.run(
        ["bash", "-e", "-c", check],
        cwd=tmp_path,
        env=environment(PATH=path_with(tool)),
        capture_output=True,
        check=False,
    )
    assert done.returncode == code, done.stderr
    assert {name for name in published if (tmp_path / name).stat().st_size > 0} == published


def _module(name: str) -> str:
    return FORMATS[name].partition(".")[0]
