"""Runs the real command line over inputs in a scratch folder, under limits, and judges it."""

from __future__ import annotations

import contextlib
import json
import os
import subprocess
import sys
import tempfile
import time
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

from process import PROGRAM, environment

from .model import STAGE, Input, Role

TIMEOUT = 6
"""Seconds for one stage."""
_SLACK = 60
_MEMORY = 6 << 30
_LARGEST_FILE = 256 << 20
_OPTIONS = ("--output-format", "json", "--max-places", "1000000", "--jobs", "1")
_FAILED, _UNREADABLE = "LNT002", "LNT001"


class Outcome(NamedTuple):
    """What came of an input: a word for the table, and what is not as it should be."""

    word: str
    wrong: tuple[str, ...] = ()
    opened: bool | None = None
    detail: str = ""


class Done(NamedTuple):
    """What a run of the command line came to; `code` is None where it did not end."""

    code: int | None
    out: str
    err: str
    peak: int
    """The most memory that one process took, in MB; 0 where the system does not say."""


def write(inputs: Mapping[int, Input], folder: Path) -> dict[int, str]:
    """Writes each input into a folder of its own; the paths of the files to try, from there."""
    roots = {}
    for number, made in inputs.items():
        for name, data in made.files.items():
            path = folder / f"n{number}" / name
            path.parent.mkdir(parents=True, exist_ok=True)
            path.write_bytes(data)
        roots[number] = f"n{number}/{made.root}"
    return roots


def run(arguments: Sequence[str], folder: Path, count: int) -> Done:
    """Runs the command line with limits that it can't lift; output goes to files elsewhere."""
    with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
        process = subprocess.Popen(
            [*PROGRAM, *arguments],
            cwd=folder,
            env=environment(),
            stdin=subprocess.DEVNULL,
            stdout=out,
            stderr=err,
            start_new_session=True,
            **({"preexec_fn": _limit} if os.name == "posix" else {}),  # type: ignore[call-overload]
        )
        code, peak = _wait(process, _SLACK + (TIMEOUT + 2) * count)
        texts = []
        for stream in (out, err):
            stream.seek(0)
            texts.append(stream.read().decode("utf-8", "replace"))
    return Done(code, texts[0], texts[1], peak)


def _limit() -> None:
    import resource

    resource.setrlimit(resource.RLIMIT_AS, (_MEMORY, _MEMORY))
    resource.setrlimit(resource.RLIMIT_FSIZE, (_LARGEST_FILE, _LARGEST_FILE))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def _wait(process: subprocess.Popen[bytes], seconds: float) -> tuple[int | None, int]:
    if not hasattr(os, "wait4"):
        try:
            return process.wait(seconds), 0
        except subprocess.TimeoutExpired:
            process.kill()
            return None, 0
    ends = time.monotonic() + seconds
    while True:
        pid, status, usage = os.wait4(process.pid, os.WNOHANG)
        if pid:
            process.returncode = os.waitstatus_to_exitcode(status)
            return process.returncode, _megabytes(usage.ru_maxrss)
        if time.monotonic() > ends:
            with contextlib.suppress(ProcessLookupError):
                os.killpg(process.pid, 9)
            process.wait()
            return None, 0
        time.sleep(0.02)


def _megabytes(size: int) -> int:
    return size >> (20 if sys.platform == "darwin" else 10)


def outcomes(inputs: Mapping[int, Input], folder: Path) -> tuple[dict[int, Outcome], int]:
    """What came of each input, all written into the folder, and the most memory in MB.

    Where a run on many stages is not as it should be, each is tried alone.
    """
    roots = write(inputs, folder)
    before = _listing(folder)
    found: dict[int, Outcome] = {}
    peak = 0
    stages = [number for number, made in inputs.items() if made.role is Role.STAGE]
    for numbers in [stages, *([number] for number in inputs.keys() - set(stages))]:
        for tried, done in _tried(numbers, inputs, roots, folder):
            peak = max(peak, done.peak)
            found |= judged(tried, done, roots, inputs)
            if _listing(folder) != before:
                found[tried[0]] = Outcome("wrote", ("something was written beside the inputs",))
    return found, peak


def _tried(
    numbers: list[int], inputs: Mapping[int, Input], roots: Mapping[int, str], folder: Path
) -> Iterator[tuple[list[int], Done]]:
    """The runs on inputs: one, or if that is not as it should be one for each half of them."""
    if not numbers:
        return
    arguments = _arguments(inputs[numbers[0]], [roots[number] for number in numbers])
    done = run(arguments, folder, len(numbers))
    if len(numbers) > 1 and run_faults(done, len(numbers), inputs[numbers[0]].role):
        middle = len(numbers) // 2
        yield from _tried(numbers[:middle], inputs, roots, folder)
        yield from _tried(numbers[middle:], inputs, roots, folder)
    else:
        yield numbers, done


def _arguments(first: Input, roots: list[str]) -> list[str]:
    if first.role is Role.STAGE:
        return [*_OPTIONS, "--isolated", "--timeout", str(TIMEOUT), "--select", "ALL", *roots]
    folder = os.path.dirname(roots[0])
    if first.role is Role.BASELINE:
        return [*_OPTIONS, "--isolated", "--root", ".", "--baseline", roots[0], f"{folder}/{STAGE}"]
    return [*_OPTIONS, "--config", roots[0], f"{folder}/{STAGE}"]


def run_faults(done: Done, stages: int, role: Role) -> list[str]:
    """What is wrong with a run as a whole."""
    faults = []
    if done.code not in (0, 1, 2):
        faults.append("it did not end" if done.code is None else f"exit code {done.code}")
    if "Traceback" in done.err or "internal error" in done.err:
        faults.append("a traceback")
    if not done.out:
        lines = done.err.strip().splitlines()
        if role is Role.STAGE or done.code != 2 or len(lines) != 1:
            faults.append(f"neither a report nor one line of error, but {len(lines)} lines")
        return faults
    try:
        told = [stage["path"] for stage in json.loads(done.out)["stages"]]
    except (ValueError, KeyError) as error:
        return [*faults, f"no report: {error}"]
    if len(told) != len(set(told)) or (len(told) != stages and role is Role.STAGE):
        faults.append(f"{len(told)} stages are told of {stages}")
    return faults


def judged(
    numbers: list[int], done: Done, roots: Mapping[int, str], inputs: Mapping[int, Input]
) -> dict[int, Outcome]:
    faults = run_faults(done, len(numbers), inputs[numbers[0]].role)
    if faults:
        return {numbers[0]: Outcome("wrong", tuple(faults), detail=done.err[-3000:])}
    if not done.out:
        return {numbers[0]: Outcome("refused", detail=done.err)}
    report = json.loads(done.out)
    if report["failure"] and inputs[numbers[0]].role is not Role.STAGE:
        return {numbers[0]: Outcome("refused", detail=report["failure"])}
    by_path = {stage["path"]: stage for stage in report["stages"]}
    found = {}
    for number in numbers:
        root = roots[number] if inputs[number].role is Role.STAGE else f"n{number}/{STAGE}"
        stage = by_path.get(root)
        wrong = Outcome("wrong", ("it is not told",))
        found[number] = _of_stage(stage, report["causes"]) if stage else wrong
    return found


def _of_stage(stage: Any, causes: Any) -> Outcome:
    found = [causes[number] for number in stage["causes"]]
    opened = stage["status"] == "checked"
    failed = [cause["message"] for cause in found if cause["code"] == _FAILED]
    said = "\n".join(f"{cause['code']} {cause['message']}" for cause in found)
    wrong = [f"a rule failed: {message}" for message in failed]
    longest = max((len(cause["message"]) for cause in found), default=0)
    if longest > 20_000:
        wrong.append(f"a message of {longest} characters")
    if not opened and not any(cause["code"] == _UNREADABLE for cause in found):
        wrong.append(f"{stage['status']}, and no {_UNREADABLE}")
    word = stage["status"] if not opened else "findings" if found else "clean"
    return Outcome("wrong" if wrong else word, tuple(wrong), opened, said)


def _listing(folder: Path) -> dict[str, tuple[int, int]]:
    """All files with their sizes and times of change."""
    return {
        str(path): (path.stat().st_size, path.stat().st_mtime_ns)
        for path in folder.rglob("*")
        if path.is_file()
    }
