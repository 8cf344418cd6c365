"""What ends a run before its time elsewhere: memory, processes that stay, and none that start."""

from __future__ import annotations

import os
import re
import signal
import subprocess
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import psutil
import pxr
import pytest
from badinput import POSIX, statuses
from process import PACKS, PROGRAM, ROOT, ROUGH, Ran, environment, run, volume, write

from usdvol_lint.child import start_child
from usdvol_lint.model import Status
from usdvol_lint.run import memory, pool
from usdvol_lint.run.last_words import LastWords
from usdvol_lint.run.lint import lint
from usdvol_lint.run.memory import Memory, own_part

GREEDY = ("--isolated", "--pack", PACKS / "greedy", "--select", "GRE", "--output-format", "json")
ROUGH_ONLY = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--output-format", "json")
KILLED = "the process that loads USD does not start (SIGKILL): it said nothing; "
MORE = "give the machine more memory, or let fewer work at once with --jobs"

posix = pytest.mark.skipif(not POSIX, reason="processes as POSIX has them")

FAILING = """
import os, signal
with open({counter!r}, "a+") as file:
    file.write("x")
    file.seek(0)
    number = len(file.read())
if {ends}:
    os.kill(os.getpid(), signal.SIGKILL)
__path__[:] = [{real!r}]
with open(os.path.join({real!r}, "__init__.py")) as file:
    exec(file.read())
"""


def failing_usd(folder: Path, ends: str) -> dict[str, str]:
    """An environment in which USD's `number`th import is ended where that is so."""
    (folder / "fake" / "pxr").mkdir(parents=True)
    values = {"counter": str(folder / "count"), "ends": ends, "real": str(*pxr.__path__)}
    (folder / "fake" / "pxr" / "__init__.py").write_text(FAILING.format(**values))
    return environment(PYTHONPATH=os.pathsep.join([str(ROOT), str(folder / "fake")]))


def messages(ran: Ran) -> dict[str, list[str]]:
    return {
        stage["path"]: [finding["message"] for finding in stage["findings"]] for stage in ran.stages
    }


@pytest.fixture
def left(tmp_path: Path) -> Iterator[Path]:
    """The file with the number of the process that was left behind, which is ended then."""
    yield tmp_path / "left"
    os.kill(int((tmp_path / "left").read_text()), signal.SIGKILL)


# --- memory ---------------------------------------------------------------------------------------


def test_a_process_that_takes_too_much_is_ended(tmp_path: Path) -> None:
    write(tmp_path, swell=volume("swell"), z=volume("z"))
    ran = run(*GREEDY, "--memory-limit", "200M", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {"swell.usda": "crashed", "z.usda": "checked"}
    (finding,) = ran.stages[0]["findings"]
    said = r"stopped at [23]\d\d\.?\d*M of memory; the limit for one process is 200M"
    assert re.fullmatch(said, finding["message"])
    assert finding["suggestion"].startswith("if the stage is that large, raise --memory-limit, ")


def test_references_that_multiply_are_ended(tmp_path: Path) -> None:
    """USD would compose a billion prims of four kilobytes, and is asked while it does."""
    layer = 'class "l0" {\ndef Volume "v" {}\n}\n'
    for level in range(1, 30):
        two = (f'def "{name}" (references = </l{level - 1}>) {{}}\n' for name in "ab")
        layer += f'class "l{level}" {{\n{"".join(two)}}}\n'
    top = 'def "top" (references = </l29>) {}\n'
    write(tmp_path, a=volume("a"), doubled=f"#usda 1.0\n{layer}{top}", z=volume("z"))
    ran = run("--output-format", "json", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran)["doubled.usda"] == "unreadable"
    assert statuses(ran)["a.usda"] == statuses(ran)["z.usda"] == "checked"
    [said] = messages(ran)["doubled.usda"]
    in_all = r"the same \d{3} prims again and again, \d,\d{3},\d{3},\d{3} in all"
    in_all += ", many of them below prims such as </top/a/a>"
    assert re.fullmatch(f"not opened: its arcs multiply what they bring: {in_all}", said)


def test_a_limit_that_no_process_can_keep(tmp_path: Path) -> None:
    write(tmp_path, z=volume("z"))
    ran = run(*GREEDY, "--memory-limit", "2M", ".", cwd=tmp_path)
    said = (
        r"usdvol-lint: error: a memory limit of 2M is too low: a process takes [\d.]+M before it "
        r"opens a stage; raise --memory-limit \(memory-limit in a configuration\)\n"
    )
    assert ran.code == 2
    assert re.fullmatch(said, ran.err)


def test_a_process_that_has_grown_is_replaced(tmp_path: Path) -> None:
    """Between two stages, which show nothing of it."""
    names = [f"grow_{number}" for number in range(9)]
    write(tmp_path, **{name: volume(name) for name in names})
    ran = run(*GREEDY, "--memory-limit", "500M", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (1, "")
    assert set(statuses(ran).values()) == {"checked"}
    assert len({said for (said,) in messages(ran).values()}) == 2


def test_the_limit_is_a_share_of_what_there_is(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(memory, "_common", lambda: iter([8e9, 4e9]))
    monkeypatch.setattr(memory, "address_space", lambda: None)
    assert Memory("auto", 1).limit == 3.2e9
    assert Memory("auto", 4).limit == 0.8e9
    monkeypatch.setattr(memory, "address_space", lambda: 1e9)
    assert Memory("auto", 2).limit == 0.8e9
    assert Memory("1.5G", 4).limit == 1.5 * 2**30
    assert Memory("none", 4).limit == Memory("0", 4).limit == float("inf")


@pytest.mark.parametrize(
    ("own", "files"),
    [
        ("0::/a", {"a/memory.max": "1000", "memory.max": "max"}),
        ("4:memory:/x", {"memory/x/memory.limit_in_bytes": "1000"}),
    ],
)
def test_control_groups(own: str, files: dict[str, str], tmp_path: Path) -> None:
    (tmp_path / "own").write_text(own)
    for name, text in files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(f"{text}\n")
    _, *limits = memory._common(str(tmp_path), str(tmp_path / "own"))
    assert limits == [1000]


class Measured:
    """What psutil says of a process on one system."""

    def __init__(self, **values: int) -> None:
        self.__dict__.update(values)


def test_what_is_mapped_is_not_its_own() -> None:
    linux: Any = Measured(rss=500, shared=300)
    windows: Any = Measured(rss=500, private=200)
    assert (own_part(linux, 0), own_part(windows, 0)) == (200, 200)


def test_what_is_freed_is_no_growth(monkeypatch: pytest.MonkeyPatch) -> None:
    sizes = iter([100 << 20, 900 << 20, 100 << 20, 900 << 20, 900 << 20])
    monkeypatch.setattr(Memory, "_measured", lambda *_: next(sizes))
    kept = Memory("8G")
    assert not kept.has_grown(0)
    assert not kept.is_too_large(0)
    assert not kept.has_grown(0)
    assert not kept.is_too_large(0)
    assert not kept.has_grown(0)
    assert not kept.is_too_large(0)
    assert kept.has_grown(0)


# --- what stays behind ----------------------------------------------------------------------------


def test_of_many_words_the_last_are_kept() -> None:
    read, written = os.pipe()
    words = LastWords(os.fdopen(read, "rb"))
    with os.fdopen(written, "wb") as pipe:
        for _ in range(8):
            pipe.write(b"x" * (1 << 20))
        pipe.write(b"\nthe end\n")
    assert words.text().endswith("x\nthe end")
    assert len(words._kept) <= 1 << 16


@posix
@pytest.mark.parametrize(("name", "status"), [("fork", "timed_out"), ("orphan", "crashed")])
def test_a_process_that_holds_the_pipes(name: str, status: str, tmp_path: Path, left: Path) -> None:
    write(tmp_path, **{name: volume(name), "z": volume("z")})
    began = time.monotonic()
    ran = run(*GREEDY, "--timeout", "1", "-j1", ".", cwd=tmp_path)
    assert time.monotonic() - began < 45
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {f"{name}.usda": status, "z.usda": "checked"}


@posix
@pytest.mark.parametrize("name", ["hang", "wait"])
def test_a_process_whose_parent_has_gone_ends(name: str, tmp_path: Path) -> None:
    """Whether it is busy or not."""
    write(tmp_path, hang=volume("hang"))
    if name == "wait":
        with start_child() as child:
            assert child.stdin
            child.stdin.close()
            assert child.wait(60) == 0
        return
    with subprocess.Popen(
        [*PROGRAM, *map(str, ROUGH_ONLY), "."],
        cwd=tmp_path,
        env=environment(),
        stdout=subprocess.DEVNULL,
        stderr=subprocess.DEVNULL,
    ) as parent:
        until = time.monotonic() + 60
        while not (tmp_path / "hanging").exists():
            assert time.monotonic() < until
            time.sleep(0.02)
        workers = psutil.Process(parent.pid).children()
        assert workers
        parent.kill()
    _, left = psutil.wait_procs(workers, timeout=30)
    for worker in left:
        worker.kill()
    assert left == []


# --- what does not start --------------------------------------------------------------------------


@posix
def test_a_process_that_is_killed_while_it_starts_is_tried_again(tmp_path: Path) -> None:
    write(tmp_path, z=volume("z"))
    env = failing_usd(tmp_path, "number < 3")
    ran = run(*ROUGH_ONLY, ".", cwd=tmp_path, env=env)
    assert (ran.code, ran.err, messages(ran)) == (1, "", {"z.usda": ["behaved"]})


@posix
def test_processes_that_never_start(tmp_path: Path) -> None:
    """All stages are in the report, which says why none was looked at."""
    write(tmp_path, a=volume("a"), z=volume("z"))
    ran = run(*ROUGH_ONLY, "-j1", ".", cwd=tmp_path, env=failing_usd(tmp_path, "True"))
    assert (ran.code, ran.err) == (2, "")
    assert (tmp_path / "count").read_text() == "xxxx"
    why = f"not checked: {KILLED}{MORE}"
    assert messages(ran) == {"a.usda": [why], "z.usda": [why]}
    assert ran.json["summary"]["by_status"] == {"unchecked": 2}


def test_a_thread_that_never_starts(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fails(*arguments: object) -> None:
        raise RuntimeError("can't start new thread")

    write(tmp_path, a=volume("a"), z=volume("z"))
    monkeypatch.setattr(pool, "_in_a_thread", fails)
    stages = lint([str(tmp_path)]).stages
    assert [stage.status for stage in stages] == [Status.UNCHECKED, Status.UNCHECKED]


@posix
@pytest.mark.parametrize("jobs", ["1", "2"])
def test_what_was_checked_is_reported_where_no_process_starts_any_more(
    jobs: str, tmp_path: Path
) -> None:
    write(tmp_path, a=volume("a"), killed=volume("killed"), y=volume("killed"), z=volume("killed"))
    ran = run(*ROUGH_ONLY, "-j", jobs, ".", cwd=tmp_path, env=failing_usd(tmp_path, "number > 1"))
    assert (ran.code, ran.err) == (2, "")
    ended = "the process that checked it was ended from outside (SIGKILL)"
    said = messages(ran)
    assert (said.pop("a.usda"), said.pop("killed.usda")) == (["behaved"], [ended])
    not_started = f"not checked: {KILLED}{MORE}"
    assert said == {"y.usda": [not_started], "z.usda": [not_started]}
    assert ran.json["summary"]["by_status"] == {"checked": 1, "crashed": 1, "unchecked": 2}
    (cause,) = (each for each in ran.json["causes"] if each["source"]["layer"] is None)
    assert cause["count"] == 2


@pytest.mark.parametrize("jobs", ["1", "2"])
def test_plugins_that_do_not_load_are_told_once(jobs: str, tmp_path: Path) -> None:
    (tmp_path / "plug").mkdir()
    (tmp_path / "plug" / "plugInfo.json").write_text('{ "Plugins": [ broken')
    write(tmp_path / "stages", a=volume("a"), z=volume("z"))
    env = environment(PXR_PLUGINPATH_NAME=str(tmp_path / "plug"))
    ran = run(*ROUGH_ONLY, "-j", jobs, "stages", cwd=tmp_path, env=env)
    assert set(statuses(ran).values()) == {"checked"}
    assert ran.err.startswith("usdvol-lint: USD could not load all its plugins: Plugin info file ")
    assert ran.err.count("\n") == 1
