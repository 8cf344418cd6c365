"""Where reports go: standard output, files, devices, and with which colours."""

from __future__ import annotations

import html
import json
import os
import re
import subprocess
from collections.abc import Callable
from pathlib import Path

import pytest
from process import ONLY_STUDIO, PROGRAM, STUDIO, Ran, environment, run, volume, write

from usdvol_lint.report import FORMATS

WRONG = "name 'fog', wanted smoke, fire"

TEXT_REPORT = f"""\
fog.usda
  /fog
    STU001 error: {WRONG}
      --> fog.usda:2:1
      2 | def Volume "fog"
        | ^
"""

VERDICT = re.compile(r"1 error in 1 of 2 stages; 2 volumes checked in [\d.]+ s\n")


def test_the_report_goes_to_standard_output(two: Path) -> None:
    ran = run(*ONLY_STUDIO, "--ignore", "STU002", ".", cwd=two)
    report, _, verdict = ran.out.rpartition("\n\n")
    assert (ran.code, ran.err, f"{report}\n") == (1, "", TEXT_REPORT)
    assert VERDICT.fullmatch(verdict)


def test_quiet_and_verbose(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002")
    assert run(*only, "--quiet", "smoke.usda", cwd=two) == Ran(0, "", "")
    assert run(*only, "-q", ".", cwd=two) == Ran(1, TEXT_REPORT, "")
    ran = run(*only, "--verbose", "smoke.usda", cwd=two)
    assert (ran.code, ran.err) == (0, "")
    assert re.search(r"^  stats: prims 1, volumes 1, ", ran.out, re.MULTILINE)
    assert re.search(r"^  seconds: open [\d.]+, walk [\d.]+, check ", ran.out, re.MULTILINE)


def test_several_reports_in_one_run(two: Path) -> None:
    ran = run(
        *(*ONLY_STUDIO, "--ignore", "STU002"),
        *("--output-format", "json", "--output", "report.json"),
        *("--output-format", "concise", "--output", "report.txt"),
        *("--output-format", "full", "."),
        cwd=two,
    )
    assert (ran.code, ran.err, ran.out.partition("\n\n")[0] + "\n") == (1, "", TEXT_REPORT)
    assert (two / "report.txt").read_text() == f"fog.usda:2:1: STU001 error </fog> {WRONG}\n"
    found = json.loads((two / "report.json").read_text())["summary"]["by_code"]
    assert found == {"STU001": 1}
    assert sorted(os.listdir(two)) == ["fog.usda", "report.json", "report.txt", "smoke.usda"]


def test_the_terminal_has_a_report_beside_files_for_machines(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002", "--quiet")
    ran = run(*only, "--output-format", "json", "--output", "report.json", ".", cwd=two)
    assert ran == Ran(1, TEXT_REPORT, "")
    ran = run(*only, "--output", "report.txt", ".", cwd=two)
    assert ran == Ran(1, "", "")
    assert (two / "report.txt").read_text().startswith(f"{TEXT_REPORT}\n1 error in 1 of 2 stages;")


def test_a_report_replaces_the_old_one_whole(two: Path) -> None:
    (two / "real.json").write_text("old and longer than the new one" * 1000)
    (two / "report.json").symlink_to("real.json")
    ran = run(
        *(*ONLY_STUDIO, "--quiet", "--output-format", "json"),
        *("--output", "report.json", "fog.usda"),
        cwd=two,
    )
    assert (ran.code, ran.err) == (1, "")
    assert (two / "report.json").is_symlink()
    assert json.loads((two / "real.json").read_text())["summary"]["errors"] == 1


def test_a_file_that_can_not_be_written_loses_nothing(two: Path) -> None:
    """The folder goes while the run is under way: the check before the work could not know."""
    pack = write(two / "pack")
    (pack / "remover.py").write_text(
        "import shutil\n"
        "from usdvol_lint.rule import INFO, STAGE, rule\n"
        "@rule('RMV001', on=STAGE, severity=INFO, since='1')\n"
        "def remover(stage, facts):\n"
        "    shutil.rmtree('out', ignore_errors=True)\n"
        "    yield from ()\n"
    )
    (two / "out").mkdir()
    ran = run(
        *("--isolated", "--pack", "pack", "--pack", STUDIO, "--select", "STU001,RMV", "--quiet"),
        *("--output-format", "json", "--output", "out/report.json"),
        *("--output-format", "concise", "--output", "report.txt", "fog.usda"),
        cwd=two,
    )
    assert ran.code == 2
    assert re.fullmatch(r"usdvol-lint: error: --output out[/\\]report.json: .+\n", ran.err)
    assert json.loads(ran.out)["summary"]["by_code"] == {"STU001": 1}
    assert (two / "report.txt").read_text() == f"fog.usda:2:1: STU001 error </fog> {WRONG}\n"


@pytest.mark.skipif(not os.path.exists("/dev/full"), reason="needs /dev/full and /dev/null")
def test_devices(two: Path) -> None:
    only = (*ONLY_STUDIO, "--ignore", "STU002", "--quiet", "fog.usda")
    ran = run(*only, "--output-format", "json", "--output", os.devnull, cwd=two)
    assert ran == Ran(1, TEXT_REPORT, "")
    assert not os.path.isfile(os.devnull)
    ran = run(*only, "--output", "/dev/full", cwd=two)
    said = "usdvol-lint: error: --output /dev/full: No space left on device\n"
    assert (ran.code, ran.err) == (2, said)
    assert ran.out.startswith(f"{TEXT_REPORT}\n1 error in 1 stage;")
    with open("/dev/full", "w") as full:
        done = subprocess.run(
            [
                *PROGRAM,
                *only,
                "--output-format",
                "json",
                "--output",
                "x",
                "--output-format",
                "full",
            ],
            cwd=two,
            env=environment(),
            stdout=full,
            stderr=subprocess.PIPE,
            check=False,
        )
    assert done.returncode == 2
    said = b"usdvol-lint: error: can't write to standard output: No space left on device\n"
    assert done.stderr == said
    assert json.loads((two / "x").read_text())["summary"]["errors"] == 1


@pytest.mark.parametrize(
    ("arguments", "code"),
    [([*map(str, ONLY_STUDIO), "."], 1), (["--list-rules"], 0), (["--help"], 2)],
)
def test_the_reader_may_leave(arguments: list[str], code: int, two: Path) -> None:
    """As `head -1` does."""
    with subprocess.Popen(
        [*PROGRAM, *arguments],
        cwd=two,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
    ) as process:
        assert process.stdout
        assert process.stderr
        process.stdout.close()
        assert process.stderr.read() == b""
    assert process.returncode == code


@pytest.mark.skipif(os.name != "posix", reason="needs a POSIX shell")
@pytest.mark.parametrize("output", ["", "--output-format json --output report.json"])
def test_without_standard_output(output: str, two: Path) -> None:
    arguments = [*PROGRAM, *map(str, ONLY_STUDIO), ".", *output.split()]
    done = subprocess.run(
        ["/bin/sh", "-c", 'exec "$@" >&-', "sh", *arguments],
        cwd=two,
        env=environment(),
        stderr=subprocess.PIPE,
        check=False,
    )
    said = b"usdvol-lint: error: there is no standard output to print to\n"
    assert (done.returncode, done.stderr) == (2, said)
    assert (two / "report.json").is_file() == bool(output)


@pytest.mark.parametrize(
    ("arguments", "variables", "coloured"),
    [
        ("", {}, False),
        ("", {"FORCE_COLOR": "1"}, True),
        ("", {"FORCE_COLOR": "1", "NO_COLOR": "1"}, False),
        ("--color always", {"NO_COLOR": "1"}, True),
        ("--color never", {"FORCE_COLOR": "1"}, False),
        ("--output-format concise", {"FORCE_COLOR": "1"}, True),
        ("--output-format json --color always", {"FORCE_COLOR": "1"}, False),
        ("--output report.txt --color always", {}, False),
    ],
)
def test_colour(arguments: str, variables: dict[str, str], coloured: bool, two: Path) -> None:
    env = environment(**variables)
    ran = run(*ONLY_STUDIO, *arguments.split(), "fog.usda", cwd=two, env=env)
    assert (ran.code, ran.err) == (1, "")
    assert ("\x1b[" in ran.out) == coloured
    if (two / "report.txt").exists():
        assert "\x1b" not in (two / "report.txt").read_text()


@pytest.mark.skipif(os.name != "posix", reason="such file names are for POSIX only")
@pytest.mark.parametrize("format", sorted(FORMATS))
def test_foreign_text_is_harmless(format: str, tmp_path: Path) -> None:
    """Escape sequences and markup in names, in paths and in what USD quotes of a broken layer."""
    name = "[bold]\x1b[31m\u202e[bold]\r\n::error::.usda"
    text = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./[red]\u202e[/x].vdb@\n}\n'
    (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "broken.usda").write_text("#usda 1.0\n\x1b[31m[red]\n", encoding="utf-8")
    (tmp_path / "garbage.usda").write_text("\x1b[31m[red]\n", encoding="utf-8")
    os.mkdir(tmp_path / "undecodable")
    (tmp_path / os.fsdecode(b"undecodable/\xff\xfe.usda")).write_text(volume("fog"))
    select = ("--isolated", "--select", "AST002", "--output-format", format)
    for color in ("never", "always"):
        ran = run(*select, "--color", color, ".", cwd=tmp_path)
        assert (ran.code, ran.err) == (2, "")
        plain = re.sub(r"\x1b\[[\d;]*m", "", ran.out) if color == "always" else ran.out
        assert "[red]" in plain
        assert "[/x].vdb" in plain
        assert not re.search(r"[\x00-\x09\x0b-\x1f\x7f-\x9f\u202e]", plain), repr(plain)
        if format == "json":
            assert {stage["path"] for stage in ran.json["stages"]} >= {name, "broken.usda"}
        elif format == "github":
            commands = re.findall(r"^::(error|warning|notice) [^\n]*$", plain, re.MULTILINE)
            assert len(commands) == len(plain.splitlines())
        else:
            assert not re.search(r"^::", plain, re.MULTILINE)


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        ("--bogus", "No such option '--bogus'"),
        ("--fail-on", "Option '--fail-on' requires an argument"),
        ("--jobs 0 .", "Invalid value for '--jobs'"),
        ("", "nothing to check: name a stage or a folder"),
        ("nope.usda", "no such file or folder: 'nope.usda'"),
    ],
)
def test_whatever_is_wrong_no_report_of_before_stays(
    arguments: str, said: str, tool: Callable[..., Ran], tmp_path: Path
) -> None:
    files = {"json": "r.json", "junit": "r.xml", "full": "r.txt"}
    asked = [f"--output-format {format} --output {file}" for format, file in files.items()]
    for file in files.values():
        (tmp_path / file).write_text("no findings")
    ran = tool("--isolated", *" ".join(asked).split(), *arguments.split())
    assert (ran.code, ran.out) == (2, "")
    for file in files.values():
        assert said in html.unescape((tmp_path / file).read_text()), file


def test_a_file_goes_with_the_format_beside_it(two: Path) -> None:
    words = "--output-format concise --output-format json --output r.json"
    ran = run(*ONLY_STUDIO, *words.split(), "fog.usda", cwd=two)
    assert ran.out.startswith("fog.usda:2:1: STU001 error")
    assert json.loads((two / "r.json").read_text())["schema_version"]
    ran = run(*ONLY_STUDIO, *["--output", "-", "--output-format", "concise", "fog.usda"], cwd=two)
    assert ran.out.startswith("fog.usda:2:1: STU001 error")
    assert not (two / "-").exists()


@pytest.mark.parametrize("option", ["--config", "--files-from", "--baseline"])
def test_no_message_begins_a_line_of_its_own(option: str, tool: Callable[..., Ran]) -> None:
    ran = tool(option, "x\n::error::", ".")
    assert (ran.code, "\n::" in ran.err) == (2, False)


def test_a_stage_of_a_commit_is_no_option(two: Path) -> None:
    (two / "--quiet=fog.usda").write_bytes((two / "fog.usda").read_bytes())
    env = environment(PRE_COMMIT="1")
    ran = run(*ONLY_STUDIO, "--output-format", "concise", "--quiet=fog.usda", cwd=two, env=env)
    assert ran.out.startswith("--quiet=fog.usda:2:1: STU001")


@pytest.mark.parametrize(
    "arguments",
    [["--explain", "AST002"], ["--list-rules"], ["--test", "."], ["--show-settings"],
     ["--show-files", "."]],
)  # fmt: skip
def test_what_is_no_report_has_no_file(
    arguments: list[str], tool: Callable[..., Ran], tmp_path: Path
) -> None:
    ran = tool(*arguments, "--output", "report.txt")
    said = f"--output is for reports, and {arguments[0]} writes none: leave it out, and redirect "
    assert (ran.code, ran.out, said in ran.err) == (2, "", True)
    assert not (tmp_path / "report.txt").exists()


def test_a_report_on_a_run_that_failed_has_its_own_words(
    tool: Callable[..., Ran], tmp_path: Path
) -> None:
    """Names stay what they are, and the upload takes the place of the one of its category."""
    asked = "--output-format sarif --output r.sarif --output-format gitlab --output r.json"
    for wrong in ("--bogus", "--quiet"):
        ran = tool(
            "--isolated", *asked.split(), "--category=shots", wrong, "--baseline", "a\nb", "."
        )
        assert ran.code == 2
        [sarif] = json.loads((tmp_path / "r.sarif").read_text())["runs"]
        assert sarif["automationDetails"]["id"] == "usdvol-lint/shots/"
    [notification] = sarif["invocations"][0]["toolExecutionNotifications"]
    [entry] = json.loads((tmp_path / "r.json").read_text())
    said = r"a\x0ab: there is no such baseline; --write-baseline a\x0ab writes one"
    assert notification["message"]["text"] == entry["description"] == said
