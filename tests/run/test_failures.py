"""What happens while USD or a rule is at work: crashes, hangs, exceptions, corrupt crates."""

from __future__ import annotations

import random
import subprocess
import sys
from pathlib import Path
from typing import Any

import pytest
from badinput import POSIX, RULE, STUDIO_ONLY, crate, pack, statuses, troubles
from process import ROUGH, environment, run, volume, write

from usdvol_lint.model import UsageError
from usdvol_lint.run.protocol import Setup
from usdvol_lint.run.supervisor import Worker

ROUGH_ONLY = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--output-format", "json")

CRASHED = "the file or a layer it names is probably corrupt: open it with usdcat to see which"
KILLED = "give the machine more memory, or let fewer work at once with --jobs"
ENDED = "a bug of usdvol-lint, a rule pack or a USD plugin; --verbose shows what it said"


@pytest.mark.skipif(not POSIX, reason="signals as POSIX has them")
@pytest.mark.parametrize("jobs", ["1", "3"])
def test_crashes_and_hangs(jobs: str, tmp_path: Path) -> None:
    names = ["a", "abort", "exit", "hang", "interrupt", "killed", "leave", "print", "segfault", "z"]
    write(tmp_path / "stages", **{name: volume(name) for name in names})
    ran = run(*ROUGH_ONLY, "--timeout", "1", "-j", jobs, "stages", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    behaved = ("behaved", 2, 1, None)
    crash = "the USD library crashed while reading it"
    end = "the process that checked it ended early"
    outside = "the process that checked it was ended from outside"
    hung = (
        "a large stage or a slow disk needs more: raise --timeout, or look at less with "
        "--content first --times ends; a pipe or a corrupt layer never ends"
    )
    assert troubles(ran) == {
        "stages/a.usda": behaved,
        "stages/abort.usda": (f"{crash} (SIGABRT)", None, None, CRASHED),
        "stages/exit.usda": (f"{end} (exit code 3)", None, None, ENDED),
        "stages/hang.usda": ("stopped after 1 s, the limit for one stage", None, None, hung),
        "stages/interrupt.usda": (f"{end} (SIGINT)", None, None, ENDED),
        "stages/killed.usda": (f"{outside} (SIGKILL)", None, None, KILLED),
        "stages/leave.usda": (f"{end} (exit code 4)", None, None, ENDED),
        "stages/print.usda": behaved,
        "stages/segfault.usda": (f"{crash} (SIGSEGV)", None, None, CRASHED),
        "stages/z.usda": behaved,
    }
    assert ran.json["summary"]["by_status"] == {"checked": 3, "crashed": 6, "timed_out": 1}


@pytest.mark.parametrize("end", ["hang", "exit"])
def test_what_was_found_before_the_end_is_kept(end: str, tmp_path: Path) -> None:
    """Also what the authored selections show, where another selection ends it all."""
    kept = volume("v1") + volume("v2").removeprefix("#usda 1.0\n")
    bad = volume(end).removeprefix("#usda 1.0\n")
    variants = 'variantSet "look" = {\n"good" {\n}\n"bad" {\n' + bad + "}\n}"
    (tmp_path / "late.usda").write_text(kept + bad, encoding="utf-8")
    (tmp_path / "other.usda").write_text(
        f'{kept}def "model" (\nvariants = {{ string look = "good" }}\n'
        f'prepend variantSets = ["look"]\n)\n{{\n{variants}\n}}\n',
        encoding="utf-8",
    )
    ran = run(*ROUGH_ONLY, "--timeout", "1", "--variants", "all", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert set(statuses(ran).values()) == {"timed_out" if end == "hang" else "crashed"}
    found = [
        [(finding["code"], finding["prim"]) for finding in stage["findings"]]
        for stage in ran.stages
    ]
    assert found == [[("LNT001", None), ("RGH001", "/v1"), ("RGH001", "/v2")]] * 2


def test_of_many_findings_few_are_lost(tmp_path: Path) -> None:
    """To tell of each by itself would take its time."""
    many = "".join(volume(f"v{n}").removeprefix("#usda 1.0\n") for n in range(1000))
    (tmp_path / "many.usda").write_text(volume("v") + many + volume("exit")[10:], encoding="utf-8")
    ran = run(*ROUGH_ONLY, "many.usda", cwd=tmp_path)
    assert statuses(ran) == {"many.usda": "crashed"}
    assert 900 <= len(ran.stages[0]["findings"]) <= 1002


def test_verbose_shows_what_the_process_said(tmp_path: Path) -> None:
    write(tmp_path, exit=volume("exit"))
    only = ("--isolated", "--pack", ROUGH, "--select", "RGH", "exit.usda")
    assert "last words" not in run(*only, cwd=tmp_path).out
    assert "\n    | last words\n" in run(*only, "--verbose", cwd=tmp_path).out


def test_the_limit_is_for_a_stage_not_for_a_new_process(tmp_path: Path) -> None:
    """Which takes longer to start than the limit is, because of a slow pack."""
    write(tmp_path, a=volume("hang"), b=volume("b"))
    pack(tmp_path / "slow", a="import time; time.sleep(1)\n" + RULE.format(code="SLO001", name="a"))
    ran = run(*ROUGH_ONLY, "--pack", "slow", "--timeout", "0.9", "-j1", ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert statuses(ran) == {"a.usda": "timed_out", "b.usda": "checked"}


def test_a_process_that_says_why_it_ends_is_heard() -> None:
    """Even if it has gone before it was asked anything."""
    program = (
        "import pickle, sys; from usdvol_lint.run.protocol import Refusal; "
        "sys.stdout.buffer.write(pickle.dumps([Refusal('not\\ntoday')]))"
    )
    pipes = dict.fromkeys(("stdin", "stdout", "stderr"), subprocess.PIPE)
    child = subprocess.Popen([sys.executable, "-P", "-c", program], env=environment(), **pipes)
    child.wait()
    worker = Worker(child)
    nothing: Any = [None] * len(Setup._fields)
    with pytest.raises(UsageError, match=r"^not today$"):
        worker.prepare(Setup(*nothing), 60)
    worker.stop()


def test_a_rule_that_raises(tmp_path: Path) -> None:
    stage = "#usda 1.0\n" + "".join(f'def Volume "raise_{n}"\n{{\n}}\n' for n in range(40))
    write(tmp_path, raising=stage + 'def Volume "fine"\n{\n}\n', z=volume("z"))
    ran = run(*ROUGH_ONLY, ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    found = [
        (finding["code"], finding["prim"], finding["line"], finding["message"])
        for stage in ran.stages
        for finding in stage["findings"]
    ]
    said = (
        "rule RGH001 (behaves) failed here, and on 39 more prims: "
        "ValueError: at /raise_0: second line"
    )
    assert found == [
        ("RGH001", "/fine", 122, "behaved"),
        ("LNT002", "/raise_0", 2, said),
        ("RGH001", "/z", 2, "behaved"),
    ]
    assert statuses(ran) == {"raising.usda": "checked", "z.usda": "checked"}
    only = ("--isolated", "--pack", ROUGH, "--select", "RGH", "--fail-on", "never", ".")
    ran = run(*only, "--verbose", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert "| Traceback (most recent call last):\n" in ran.out
    assert "behaves.py" in ran.out


def test_corrupt_crates(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Whatever USD makes of them: it checks some, refuses some, crashes or hangs on others."""
    monkeypatch.chdir(tmp_path)
    data = crate()
    folder = write(tmp_path / "stages", a=volume("fog"), z=volume("fog"))
    for seed in range(24):
        chance = random.Random(seed)
        mutant = bytearray(data)
        for _ in range(1 + seed % 8):
            mutant[chance.randrange(88, len(data))] = chance.randrange(256)
        (folder / f"mutant_{seed:02}.usdc").write_bytes(mutant)
    ran = run(*STUDIO_ONLY, "--timeout", "10", "-j2", "stages", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    found = statuses(ran)
    assert len(found) == 26
    assert set(found.values()) >= {"checked", "unreadable"}
    assert found["stages/a.usda"] == found["stages/z.usda"] == "checked"
    assert {"stages/a.usda", "stages/z.usda"} <= troubles(ran).keys()


def test_usd_fails_while_rules_read_a_stage(tmp_path: Path) -> None:
    """It is not the rules' fault, and said once, however many of them read that value."""
    write(tmp_path, damaged=volume("damaged"), z=volume("z"))
    ran = run(*ROUGH_ONLY, ".", cwd=tmp_path)
    assert (ran.code, ran.err) == (2, "")
    assert [
        (finding["code"], finding["message"], finding["suggestion"])
        for stage in ran.stages
        for finding in stage["findings"]
    ] == [
        (
            "LNT001",
            "USD can't read what is here: Python runtime error: "
            "no value in damaged.usda at </damaged>",
            "the layer is probably corrupt: copy or export it again",
        ),
        ("RGH001", "behaved", None),
    ]
    assert statuses(ran) == {"damaged.usda": "checked", "z.usda": "checked"}
