"""What code hosts are handed, from the command on: places they have, and files on failure too."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
from consumers import gitlab_entries, sarif_run
from process import ONLY_STUDIO, environment, run, volume, write

SHOT = """\
#usda 1.0
(
    defaultPrim = "shot"
)
def Xform "shot"
{
    def "cloud" (
        prepend references = @../../show/cloud.usda@</fog>
    )
    {
    }
}
"""
BOTH = (
    *("--output-format", "sarif", "--output", "out.sarif"),
    *("--output-format", "gitlab", "--output", "out.json"),
)
ONLY = (*ONLY_STUDIO, "--ignore", "STU002", *BOTH)


def read(folder: Path) -> tuple[Any, Any]:
    """The run that the SARIF file holds, and the entries for GitLab."""
    sarif = sarif_run((folder / "out.sarif").read_text(encoding="utf-8"))
    return sarif, gitlab_entries((folder / "out.json").read_text(encoding="utf-8"))


@pytest.fixture
def repository(tmp_path: Path) -> Path:
    """A repository with a shot, which references an asset outside of it."""
    folder = tmp_path / "my repository"
    write(folder / "shots", shot=SHOT)
    write(tmp_path / "show", cloud=volume("fog"))
    (folder / ".git").mkdir()
    return folder


@pytest.mark.parametrize("folder", [".", "shots"])
def test_a_layer_outside_the_repository_is_shown_in_the_shot(folder: str, repository: Path) -> None:
    """At the line of its arc, and from whichever folder the tool is called."""
    stage = "shots/shot.usda" if folder == "." else "shot.usda"
    ran = run(*ONLY, "--category", "lookdev", stage, cwd=repository / folder)
    assert (ran.code, ran.err) == (1, "")
    sarif, entries = read(repository / folder)
    (result,), (entry,) = sarif["results"], entries
    assert sarif["automationDetails"] == {"id": "usdvol-lint/lookdev/"}
    assert result["locations"][0]["physicalLocation"] == {
        "artifactLocation": {"uri": "shots/shot.usda"},
        "region": {"startLine": 8, "startColumn": 30},
    }
    assert entry["location"] == {"path": "shots/shot.usda", "lines": {"begin": 8}}
    layer = "../show/cloud.usda" if folder == "." else "../../show/cloud.usda"
    for text in (result["message"]["text"], entry["description"]):
        assert f"At </shot/cloud>. In the layer {layer}." in text
    assert entry["fingerprint"] == result["partialFingerprints"]["primaryLocationLineHash"]


def test_files_are_named_from_the_workspace_of_the_job(repository: Path) -> None:
    """It may hold several repositories."""
    env = environment(GITHUB_WORKSPACE=str(repository.parent))
    run(*ONLY, "shots/shot.usda", cwd=repository, env=env)
    sarif, entries = read(repository)
    location = sarif["results"][0]["locations"][0]["physicalLocation"]
    assert location["artifactLocation"] == {"uri": "show/cloud.usda"}
    assert entries[0]["location"] == {"path": "show/cloud.usda", "lines": {"begin": 2}}


def test_where_no_file_is_in_the_repository_the_uri_is_absolute(repository: Path) -> None:
    env = environment(CI_PROJECT_DIR=str(repository))
    run(*ONLY, "../show/cloud.usda", cwd=repository, env=env)
    sarif, entries = read(repository)
    uri = sarif["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]["uri"]
    assert uri.startswith("file:///")
    assert uri.endswith("/show/cloud.usda")
    assert entries[0]["location"]["path"] == "../show/cloud.usda"


def test_rules_bring_their_pages(repository: Path) -> None:
    (repository / "a.usda").write_text("#usda 1.0\n")
    ran = run("--isolated", "--fail-on", "never", *BOTH, "a.usda", cwd=repository)
    assert ran.code == 0
    (rule,) = read(repository)[0]["tool"]["driver"]["rules"]
    assert (rule["id"], rule["properties"]) == ("STG003", {"tags": ["stage"]})
    assert rule["help"]["markdown"].startswith(rule["shortDescription"]["text"])
    assert "## Why it matters" in rule["help"]["markdown"]
    assert "```" not in rule["help"]["markdown"]


def test_a_clean_run_is_written(repository: Path) -> None:
    write(repository, smoke=volume("smoke"))
    ran = run(*ONLY, "smoke.usda", cwd=repository)
    assert ran.code == 0
    sarif, entries = read(repository)
    assert (sarif["results"], entries) == ([], [])
    assert sarif["invocations"] == [{"executionSuccessful": True}]


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (
            ("--ignore", "XYZ", "shots"),
            "--ignore: 'XYZ' is no rule, no family and no beginning of a code",
        ),
        (("--config", "nope.toml", "shots"), "nope.toml: No such file or directory"),
        (("--baseline", "nope.jsonl", "shots"), "nope.jsonl: "),
    ],
)
def test_a_run_that_could_not_begin_is_written(
    arguments: tuple[str, ...], said: str, repository: Path
) -> None:
    ran = run(*BOTH, *arguments, cwd=repository)
    assert ran.code == 2
    sarif, (entry,) = read(repository)
    (invocation,) = sarif["invocations"]
    assert (invocation["executionSuccessful"], invocation["exitCode"]) == (False, 2)
    assert invocation["toolExecutionNotifications"][0]["message"]["text"].startswith(said)
    assert entry["description"].startswith(said)
    assert entry["location"]["path"] == "shots"
    assert said in ran.err


def test_a_stage_that_can_not_be_read_is_no_success(repository: Path) -> None:
    (repository / "cut.usda").write_text("#usda 1.0\ndef Volume", encoding="utf-8")
    ran = run(*ONLY, "--fail-on", "never", "cut.usda", cwd=repository)
    assert ran.code == 2
    sarif, (entry,) = read(repository)
    assert sarif["invocations"][0]["executionSuccessful"] is False
    (result,) = sarif["results"]
    assert (result["ruleId"], entry["check_name"]) == ("LNT001", "LNT001")
    assert entry["location"]["path"] == "cut.usda"


def test_a_run_that_fails_at_its_end_is_no_success(repository: Path) -> None:
    """What could not be written into the baseline is what the run was for."""
    run(*ONLY, "--write-baseline", "known.jsonl", ".", cwd=repository)
    ran = run(
        *(*ONLY, "--select", "STU001", "--baseline", "known.jsonl", "--prune-baseline"),
        *("--root", ".", "shots/shot.usda"),
        cwd=repository,
    )
    assert ran.code == 2, ran
    sarif, entries = read(repository)
    text = sarif["invocations"][0]["toolExecutionNotifications"][0]["message"]["text"]
    assert text.startswith("--prune-baseline: ")
    assert entries[-1]["description"] == text
    assert json.dumps(text)[1:-1] in json.dumps(ran.err)
