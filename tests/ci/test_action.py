"""The GitHub Action: its shell steps run as a runner runs them, whatever its inputs hold."""

from __future__ import annotations

import os
import re
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from actionsteps import ACTION, CHECK, INSTALL, Runner, path_with
from process import ROOT, write

pytestmark = pytest.mark.skipif(
    os.name == "nt" or shutil.which("bash") is None, reason="needs a bash of its own"
)

HOSTILE = [
    "; touch owned",
    "$(touch owned)",
    "`touch owned`",
    "a' ; touch owned ; '",
    'a" ; touch owned ; "',
    "a && touch owned",
    "*",
    "~/$HOME ${RUNNER_TEMP}",
    "--version",
    "-q",
    "übung/smoke 1.usda",
]
SIGNALLED = """\
import os, signal, sys, time
def leave(*_):
    open(os.environ["RECORD"], "w").write('"signalled"')
    os._exit(130)
signal.signal(signal.SIGINT, leave)
print("ready", flush=True)
time.sleep(60)
"""


@pytest.fixture
def runner(tmp_path: Path) -> Runner:
    runner = Runner(tmp_path)
    runner.records("usdvol-lint")
    return runner


def told(runner: Runner, **inputs: str) -> list[str]:
    """What the tool is called with, by these inputs with `_` for `-`."""
    step = runner.run(CHECK, {name.replace("_", "-"): value for name, value in inputs.items()})
    assert (step.code, step.said) == (0, "")
    assert list(runner.workspace.iterdir()) == []
    return list(step.told["arguments"])


def test_no_input_stands_in_a_script() -> None:
    """What it holds would be run; and each is there to be used."""
    scripts = "".join(step["run"] for step in (INSTALL, CHECK))
    assert "${{" not in scripts
    used = re.findall(r"inputs\.([a-z-]+)", str([INSTALL["env"], CHECK["env"]]))
    assert sorted(used) == sorted(ACTION["inputs"])
    assert all("uses" not in step for step in ACTION["runs"]["steps"])


def test_inputs_become_arguments(runner: Runner) -> None:
    assert told(runner) == ["--", "."]
    given = told(
        runner,
        paths="shots \r\n  my assets/a.usda  \n \r\n\t\n",
        args="--fail-on warning\n--ignore 'VOL012, SCH'",
        sarif_file="out/usdvol lint.sarif",
        category="nightly run",
    )
    assert given == [
        *("--output-format=sarif", "--output=out/usdvol lint.sarif", "--category=nightly run"),
        *("--fail-on", "warning", "--ignore", "VOL012, SCH"),
        *("--", "shots", "my assets/a.usda"),
    ]


@pytest.mark.parametrize("value", HOSTILE)
def test_what_an_input_holds_is_never_run(value: str, runner: Runner) -> None:
    """It is one argument, and a path is never an option."""
    given = told(runner, paths=f"a\n{value}", sarif_file=value, category=f"{value}\n{value}")
    assert given == [
        *("--output-format=sarif", f"--output={value}", f"--category={value}\n{value}"),
        *("--", "a", value),
    ]
    told(runner, args=value)


def test_arguments_are_split_and_nothing_is_expanded(runner: Runner) -> None:
    args = "--config a\\ b.toml $(id) '$HOME' * \"\" `id`"
    split = ["--config", "a b.toml", "$(id)", "$HOME", "*", "", "`id`"]
    assert told(runner, args=args) == [*split, "--", "."]


def test_the_checkout_brings_no_code(runner: Runner) -> None:
    """A module of the checkout that is called like one of Python's own is not imported."""
    (runner.workspace / "shlex.py").write_text("raise SystemExit(9)", encoding="utf-8")
    assert runner.run(CHECK, {}).code == 0


@pytest.mark.parametrize(
    ("inputs", "said"),
    [
        ({"args": "--select 'AST"}, 'the input "args" has a quote without its other one'),
        ({"summary": "yes\n::notice::x"}, "the input 'summary' must be true or false"),
    ],
)
def test_an_input_that_is_wrong(inputs: dict[str, str], said: str, runner: Runner) -> None:
    step = runner.run(CHECK, inputs)
    assert (step.code, step.said) == (2, f"::error::usdvol-lint: {said}\n")


def test_the_summary_can_be_left_out(runner: Runner) -> None:
    assert runner.run(CHECK, {}).told["summary"] == str(runner.temporary / "summary.md")
    assert runner.run(CHECK, {"summary": "false"}).told["summary"] is None


def test_a_job_that_is_cancelled_ends_the_tool(runner: Runner) -> None:
    """The signal goes to the shell of the step, in whose place the tool is."""
    program = runner.temporary / "wait.py"
    program.write_text(SIGNALLED, encoding="utf-8")
    runner.program("usdvol-lint", f'exec "{sys.executable}" "{program}"')
    process = runner.start(CHECK, {})
    assert process.stdout
    assert process.stdout.readline() == "ready\n"
    process.send_signal(signal.SIGINT)
    began = time.monotonic()
    process.communicate(timeout=30)
    assert process.returncode == 130
    assert time.monotonic() - began < 20
    assert runner.record.read_text() == '"signalled"'


def test_stages_are_checked(runner: Runner) -> None:
    """With the tool itself, and the exit code that it has."""
    runner.program("usdvol-lint", f'exec "{sys.executable}" -P -m usdvol_lint "$@"')
    write(runner.workspace, empty='#usda 1.0\ndef Xform "x"\n{\n}\n')
    assert runner.run(CHECK, {"args": "--quiet"}).code == 0
    write(runner.workspace / "two words", cut="#usda 1.0\ndef")
    assert runner.run(CHECK, {"paths": "empty.usda\ntwo words"}).code == 2


# --- the installation -----------------------------------------------------------------------------


@pytest.fixture
def tools(tmp_path: Path) -> Path:
    folder = tmp_path / "tools"
    folder.mkdir()
    return folder


def installed(runner: Runner, tools: Path, version: str) -> list[str]:
    """What pip is called with."""
    runner.program("python3", "exit 0", tools)
    runner.records("python")
    step = runner.run(INSTALL, {"version": version}, PATH=path_with(tools))
    assert (step.code, step.said) == (0, "")
    return list(step.told["arguments"])


def test_what_is_installed(runner: Runner, tools: Path) -> None:
    """The Action's own code unless a release is named; pip is not that of the checkout."""
    pip = ["-I", "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
    assert installed(runner, tools, "") == [*pip, str(ROOT)]
    assert installed(runner, tools, "0.1.0") == [*pip, "usdvol-lint==0.1.0"]


@pytest.mark.parametrize(
    "version",
    ["latest", "--index-url=https://x", "0.1\n::notice::x", "1 --pre", "0.1;x", "0.1 @ x"],
)
def test_what_is_no_release_is_refused(version: str, runner: Runner, tools: Path) -> None:
    runner.program("python3", "exit 9", tools)
    step = runner.run(INSTALL, {"version": version}, PATH=path_with(tools))
    said = "::error::usdvol-lint: the input 'version' must be a release, such as 0.1.0\n"
    assert (step.code, step.said) == (2, said)


def test_an_old_python_is_told(runner: Runner, tools: Path) -> None:
    for name in ("python3", "python"):
        runner.program(name, "exit 1", tools)
    step = runner.run(INSTALL, {}, PATH=path_with(tools))
    said = "::error::usdvol-lint needs Python 3.11 or later: run actions/setup-python before it\n"
    assert (step.code, step.said) == (2, said)


def test_zizmor_finds_nothing(tmp_path: Path) -> None:
    """In the Action, and in the workflow that its page shows, at zizmor's strictest."""
    program = Path(sys.executable).with_name("zizmor")
    workflow = (ROOT / "docs" / "ci" / "github-workflow.yml").read_text(encoding="utf-8")
    own = workflow.replace("<owner>", "owner").replace("<commit>", "0" * 40)
    (tmp_path / ".github" / "workflows").mkdir(parents=True)
    (tmp_path / ".github" / "workflows" / "usdvol-lint.yml").write_text(own, encoding="utf-8")
    shutil.copy(ROOT / "action.yml", tmp_path)
    done = subprocess.run(
        [program, "--offline", "--no-progress", "--persona=pedantic", tmp_path],
        capture_output=True,
        text=True,
        encoding="utf-8",
        check=False,
    )
    assert done.returncode == 0, done.stdout + done.stderr
    assert "No findings to report" in done.stdout + done.stderr
