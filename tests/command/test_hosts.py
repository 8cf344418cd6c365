"""What a job in GitHub Actions prints and adds to its summary, and what a hook there does not."""

from __future__ import annotations

import re
from pathlib import Path

import pytest
from process import environment, run, volume, write

from usdvol_lint.command.hosts import MOST_OF_A_SUMMARY, guarded
from usdvol_lint.report import FORMATS

ONLY = ("--isolated", "--select", "AST002")
BROKEN = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./gone.vdb@\n}\n'


def test_in_a_job_the_log_has_text_and_annotations_and_the_step_a_summary(tmp_path: Path) -> None:
    (tmp_path / "::error::x.usda").write_text(BROKEN)
    summary = tmp_path / "summary.md"
    summary.write_text("of others\n")
    env = environment(
        GITHUB_ACTIONS="true", GITHUB_WORKSPACE=str(tmp_path), GITHUB_STEP_SUMMARY=str(summary)
    )
    ran = run(*ONLY, ".", cwd=tmp_path, env=env)
    stop, *text, go, annotation = ran.out.splitlines()
    token = re.fullmatch("::stop-commands::([0-9a-f]{32})", stop)
    assert token
    assert go == f"::{token[1]}::"
    assert any("AST002 error" in line for line in text)
    assert annotation.startswith("::error file=%3A%3Aerror%3A%3Ax.usda,title=AST002 file-missing,")
    assert summary.read_text().startswith("of others\n")
    assert "AST002" in summary.read_text()


def test_a_text_in_a_file_leaves_the_log_of_a_job_what_it_has(tmp_path: Path) -> None:
    (tmp_path / "broken.usda").write_text(BROKEN)
    ran = run(*ONLY, "--output", "report.txt", "broken.usda", cwd=tmp_path)
    assert (ran.out, (tmp_path / "report.txt").read_text().count("AST002")) == ("", 1)
    env = environment(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(tmp_path / "summary.md"))
    ran = run(*ONLY, "--output", "report.txt", "broken.usda", cwd=tmp_path, env=env)
    assert "    AST002 error: " in ran.out
    assert "::error file=broken.usda," in ran.out
    assert "AST002" in (tmp_path / "summary.md").read_text()
    assert (tmp_path / "report.txt").read_text().count("AST002") == 1


def test_a_hook_adds_nothing_to_the_summary_of_a_job(tmp_path: Path) -> None:
    write(tmp_path, fog=volume("fog"))
    (tmp_path / "broken.usda").write_text(BROKEN)
    summary = tmp_path / "summary.md"
    env = environment(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(summary), PRE_COMMIT="1")
    ran = run(*ONLY, "broken.usda", cwd=tmp_path, env=env)
    assert "::error file=broken.usda," in ran.out
    assert not summary.exists()


def test_a_full_summary_stays_as_it_is(tmp_path: Path) -> None:
    (tmp_path / "broken.usda").write_text(BROKEN)
    summary = tmp_path / "summary.md"
    summary.write_bytes(b"x" * MOST_OF_A_SUMMARY)
    env = environment(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(summary))
    assert run(*ONLY, "broken.usda", cwd=tmp_path, env=env).code == 1
    assert summary.stat().st_size == MOST_OF_A_SUMMARY


def test_a_summary_begins_on_a_line_of_its_own_or_is_told_to_be_missing(tmp_path: Path) -> None:
    (tmp_path / "clean.usda").write_text("#usda 1.0\n")
    summary = tmp_path / "summary.md"
    summary.write_text("no end")
    env = environment(GITHUB_ACTIONS="true", GITHUB_STEP_SUMMARY=str(summary))
    assert run(*ONLY, "clean.usda", cwd=tmp_path, env=env).code == 0
    assert summary.read_text().startswith("no end\n## usdvol-lint passed")
    env["GITHUB_STEP_SUMMARY"] = str(tmp_path / "gone" / "summary.md")
    ran = run(*ONLY, "clean.usda", cwd=tmp_path, env=env)
    assert (ran.code, ran.out.count("##")) == (0, 0)
    assert ran.err.startswith("usdvol-lint: the summary of the step (GITHUB_STEP_SUMMARY) can't be")


@pytest.mark.parametrize("format", sorted(FORMATS))
def test_no_host_takes_a_command_from_a_stage(format: str, tmp_path: Path) -> None:
    """`##vso[` and `##[` count wherever they stand in a line of a log."""
    text = BROKEN.replace("./gone", "./##vso[task.setvariable]x##[add-mask]")
    (tmp_path / "a##[b].usda").write_text(text)
    ran = run("--isolated", "--fail-on", "info", "--output-format", format, ".", cwd=tmp_path)
    assert ran.code == 1
    assert "vso[" in ran.out
    assert "##[" not in ran.out
    assert "##vso" not in ran.out


@pytest.mark.parametrize("parts", [[], [""]])
def test_nothing_needs_no_guard(parts: list[str]) -> None:
    assert list(guarded(parts)) == []
