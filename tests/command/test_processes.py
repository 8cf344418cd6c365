"""The processes of a run: how many, what they import, and that none stays behind."""

from __future__ import annotations

import json
import os
import re
import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest
from process import ONLY_STUDIO, PROGRAM, ROUGH, STUDIO, environment, run, volume, write


def test_the_parent_imports_neither_usd_nor_numpy(two: Path) -> None:
    done = subprocess.run(
        [PROGRAM[0], "-X", "importtime", *PROGRAM[1:], *map(str, ONLY_STUDIO), "."],
        cwd=two,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    assert done.returncode == 1
    imported = {line.rpartition("|")[2].strip() for line in done.stderr.splitlines()}
    assert {"usdvol_lint.run.pool", "usdvol_lint.report.style"} <= imported
    roots = {name.partition(".")[0] for name in imported}
    assert roots.isdisjoint({"pxr", "numpy", "rich"})


def test_the_same_bytes_for_any_number_of_jobs(tmp_path: Path) -> None:
    folder = tmp_path / "stages"
    names = ["smoke", "fog", "fire", "mist", "steam", "cloud", "dust", "haze"]
    write(folder, **{name: volume(name) for name in names})
    write(folder / "below", abort=volume("abort"), raising=volume("raise"), more=volume("smoke"))
    (folder / "garbage.usda").write_text("garbage")
    (folder / "empty.usdc").write_bytes(b"")
    (folder / "cut.usda").write_text('#usda 1.0\ndef Volume "cut"\n{\n')
    arguments = ("--isolated", "--pack", STUDIO, "--pack", ROUGH, "--select", "STU,RGH")
    outputs = set()
    for jobs in ("1", "1", "2", "4"):
        ran = run(*arguments, "-j", jobs, "--output-format", "json", "stages", cwd=tmp_path)
        assert (ran.code, ran.err) == (2, "")
        outputs.add(re.sub(r'^  "run": .*$', "", ran.out, flags=re.MULTILINE))
    (output,) = outputs
    summary = json.loads(output.rpartition(",")[0] + "}")["summary"]
    assert summary["by_status"] == {"checked": 10, "crashed": 1, "unreadable": 3}
    assert summary["by_code"] == {
        "LNT001": 4, "LNT002": 1, "RGH001": 9, "STU001": 7, "STU002": 10,
    }  # fmt: skip


def test_each_stage_once_and_sorted_by_path(two: Path) -> None:
    write(two / "b" / "deep", one=volume("fog"))
    write(two / "a", two=volume("fog"))
    write(two / ".hidden", no=volume("fog"))
    (two / "notes.txt").write_text("not a stage, and not named")
    ran = run(
        *ONLY_STUDIO,
        *("--output-format", "json", "smoke.usda", "b", ".", "./fog.usda", "a"),
        cwd=two,
    )
    assert [stage["path"] for stage in ran.json["stages"]] == [
        "a/two.usda",
        "b/deep/one.usda",
        "fog.usda",
        "smoke.usda",
    ]


AS_JSON = ("--output-format", "json", "--output", "report.json")


@pytest.mark.skipif(os.name != "posix", reason="signals as POSIX has them")
@pytest.mark.parametrize("end", ["ctrl-c", "terminate"])
def test_interrupted(end: str, tmp_path: Path) -> None:
    """No process stays behind, not even one that hangs."""
    gone = '#usda 1.0\ndef OpenVDBAsset "a"\n{\n    asset filePath = @./gone.vdb@\n}\n'
    write(tmp_path, hang=volume("hang"), done=gone)
    # Under `make test &` and nohup it would be ignored, and inherited as ignored.
    previous = signal.signal(signal.SIGINT, signal.default_int_handler)
    with subprocess.Popen(
        [
            *PROGRAM,
            "--isolated",
            "--pack",
            str(ROUGH),
            "--jobs",
            "1",
            *AS_JSON,
            *("--output-format", "concise"),
            "done.usda",
            "hang.usda",
        ],
        cwd=tmp_path,
        env=environment(),
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        start_new_session=True,
    ) as process:
        deadline = time.monotonic() + 60
        while not (tmp_path / "hanging").exists():
            assert time.monotonic() < deadline
            assert process.poll() is None
            time.sleep(0.02)
        told = b""
        while b"AST002 error" not in told:
            assert process.stdout
            told += os.read(process.stdout.fileno(), 4096)
        if end == "ctrl-c":  # the terminal tells the whole group
            os.killpg(process.pid, signal.SIGINT)
        else:
            process.terminate()
        _, err = process.communicate(timeout=60)
    signal.signal(signal.SIGINT, previous)
    name, code = ("SIGINT", 130) if end == "ctrl-c" else ("SIGTERM", 143)
    said = f"usdvol-lint: interrupted by {name} after 1 of 2 stages; what was found is reported\n"
    assert (process.returncode, err.decode()) == (code, said)
    report = json.loads((tmp_path / "report.json").read_text())
    assert (report["partial"], [stage["path"] for stage in report["stages"]]) == (
        True,
        ["done.usda"],
    )
    with pytest.raises(ProcessLookupError):
        os.killpg(process.pid, 0)


@pytest.mark.skipif(sys.platform != "linux", reason="elsewhere nobody stands in a removed folder")
def test_the_working_directory_is_gone(tmp_path: Path) -> None:
    write(tmp_path, smoke=volume("smoke"))
    gone = tmp_path / "gone"
    gone.mkdir()
    done = subprocess.run(
        ["/bin/sh", "-c", 'rmdir "$0"; exec "$@"', gone, *PROGRAM, tmp_path / "smoke.usda"],
        cwd=gone,
        env=environment(),
        capture_output=True,
        text=True,
        check=False,
    )
    said = "usdvol-lint: error: the working directory is not there any more\n"
    assert (done.returncode, done.stdout, done.stderr) == (2, "", said)
