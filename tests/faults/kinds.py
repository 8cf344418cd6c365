"""The kinds of faults: each does something to a run and says what came of it."""

from __future__ import annotations

import os
import shutil
import subprocess
import time
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from pathlib import Path
from random import Random

import psutil

from .outcome import ERROR, REPORT, WRONG, Outcome, outcome, write_stages

LIMITS: Mapping[str, tuple[int, ...]] = {
    "n": (5, 8, 11, 14, 20, 40),
    "v": (40_000, 100_000, 300_000, 600_000, 1_000_000, 1_500_000, 3_000_000),
    "u": (1, 2, 3, 4, 5, 6, 7, 8, 12, 30),
}
"""What `ulimit` is called with: files, kilobytes of addresses, processes of a user."""
_AS_SOMEBODY = (
    *("setpriv", "--reuid=54321", "--regid=54321", "--clear-groups"),
    *("--inh-caps=-all,+dac_override", "--ambient-caps=-all,+dac_override"),
    "--bounding-set=-all,+dac_override",
)
"""root may have any number of processes; whoever has no name here still reads the checkout."""


def killed(folder: Path, chance: Random, stages: int) -> Iterator[Outcome]:
    """Workers are killed at random, also while they start."""
    write_stages(folder, stages)

    def kill_one(parent: psutil.Process) -> None:
        time.sleep(chance.expovariate(0.4))
        _kill(chance.choice(parent.children() or [None]))

    for jobs in (2, 2, 1):
        yield outcome(folder, f"-j{jobs}", meanwhile=kill_one)


def killed_starting(folder: Path, chance: Random, stages: int) -> Iterator[Outcome]:
    """Each of the first workers is killed as soon as it is there, a few or all of them."""
    write_stages(folder, stages)
    for most in (1, 3, 1000):
        met: set[int] = set()

        def kill_new(parent: psutil.Process, met: set[int] = met, most: int = most) -> None:
            time.sleep(chance.uniform(0, 0.1))
            for child in parent.children():
                if child.pid not in met and len(met) < most:
                    met.add(child.pid)
                    _kill(child)

        yield outcome(folder, "-j2", meanwhile=kill_new)


def full_disk(folder: Path, chance: Random, stages: int) -> Iterator[Outcome]:
    """The report goes to a disk that fills up: nothing of it is left there."""
    write_stages(folder, stages)
    with _small_disk(folder / "disk") as is_mounted:
        for name in ("json", "sarif", "junit", "jsonl") if is_mounted else ():
            file = folder / "disk" / f"report.{name}"
            found = outcome(folder, "--output", str(file), "--output-format", name)
            left = os.listdir(folder / "disk")
            yield found if found.kind != ERROR or not left else Outcome(WRONG, f"left: {left}")


def changed_files(folder: Path, chance: Random, stages: int) -> Iterator[Outcome]:
    """Stages are taken away, revoked and replaced by other things while the run goes on."""
    write_stages(folder, stages)
    paths = sorted((folder / "stages").iterdir())

    def change_one(parent: psutil.Process) -> None:
        time.sleep(0.002)
        path = chance.choice(paths)
        with suppress(OSError):
            chance.choice(_CHANGES)(path)

    yield outcome(folder, "-j2", meanwhile=change_one)


def limits(folder: Path, chance: Random, stages: int) -> Iterator[Outcome]:
    """What the shell allows a process is little."""
    write_stages(folder, stages)
    for letter, sizes in LIMITS.items():
        before = _AS_SOMEBODY if letter == "u" and os.geteuid() == 0 else ()
        if before and not shutil.which(before[0]):
            continue
        for size in sizes:
            line = f'ulimit -{letter} {size}; exec "$@"'
            found = outcome(folder, before=(*before, "bash", "-c", line, "bash"))
            # Where not even Python or the shell can start, that says so.
            is_ours = "usdvol-lint" in found.why or found.kind == REPORT
            yield found if is_ours else found._replace(why=f"-{letter} {size}: {found.why}")


KINDS: Mapping[str, Callable[[Path, Random, int], Iterator[Outcome]]] = {
    "killed": killed,
    "killed-starting": killed_starting,
    "full-disk": full_disk,
    "changed-files": changed_files,
    "limits": limits,
}


def _kill(process: psutil.Process | None) -> None:
    if process:
        with suppress(psutil.Error):
            process.kill()


def _replace(path: Path) -> None:
    beside = path.with_suffix(".new")
    beside.write_text("#usda 1.0\n")
    beside.rename(path)


_CHANGES: tuple[Callable[[Path], object], ...] = (
    _replace,
    lambda path: path.write_bytes(b""),
    lambda path: path.write_bytes(os.urandom(100)),
    lambda path: path.chmod(0),
    lambda path: os.truncate(path, 30),
)


@contextmanager
def _small_disk(folder: Path) -> Iterator[bool]:
    """A file system of 16 KB; False where nobody may mount one."""
    folder.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=16k", "tmpfs", str(folder)]
    is_mounted = (
        bool(shutil.which("mount"))
        and not subprocess.run(mount, stderr=subprocess.DEVNULL, check=False).returncode
    )
    try:
        yield is_mounted
    finally:
        if is_mounted:
            subprocess.run(["umount", str(folder)], check=True)
