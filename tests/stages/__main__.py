"""`python -m tests.stages`: lints random stages, and compares two checkouts over them."""

from __future__ import annotations

import argparse
import os
import shutil
import sys
import tempfile
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import NamedTuple

from .batches import Case, random_cases, written_cases
from .checkouts import FLAGS, FailedError, Run, differences, judged, start
from .writing import ROOT

_BATCH = 500
_SHOWN = 10


class Tally(NamedTuple):
    """What came of a batch."""

    stages: int = 0
    missed: tuple[str, ...] = ()
    different: tuple[str, ...] = ()

    def with_more(self, more: Tally) -> Tally:
        return Tally(
            self.stages + more.stages,
            self.missed + more.missed,
            self.different + more.different,
        )


def main() -> int:
    """1 if a stage is not as expected, or two checkouts differ."""
    chosen = _arguments()
    began = time.perf_counter()
    tally = Tally()
    try:
        for part in _blames(chosen) if chosen.blame else _parts(chosen):
            tally = tally.with_more(part)
            _print_new(part, tally)
    except FailedError as error:
        print(f"the tool failed: {error}")
        return 1
    seconds = time.perf_counter() - began
    print(
        f"{tally.stages} stages in {seconds:.0f} s: {len(tally.missed)} not as expected"
        + (f", {len(tally.different)} different" if chosen.against else "")
    )
    return 1 if tally.missed or tally.different else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser("python -m tests.stages", description=__doc__)
    parser.add_argument("--count", type=int, default=1000, help="random stages, half with a defect")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--first", type=int, default=0, help="number of the first stage")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="leave the stages there")
    parser.add_argument("--blame", action="store_true", help="hold the laws of blame over them")
    parser.add_argument("--against", type=Path, metavar="CHECKOUT", help="compare with this one")
    return parser.parse_args()


def _parts(chosen: argparse.Namespace) -> Iterator[Tally]:
    """One batch after the other, each with its share of the flags where two are compared."""
    size = min(_BATCH, max(1, chosen.count // len(FLAGS))) if chosen.against else _BATCH
    end = chosen.first + chosen.count
    for index, first in enumerate(range(chosen.first, end, size)):
        with _folder(chosen, f"batch{index:04}") as folder:
            cases = random_cases(folder, chosen.seed, range(first, min(first + size, end)))
            flags = FLAGS[index % len(FLAGS)] if chosen.against else ()
            yield _checked(folder, cases, flags, chosen.against)
    if chosen.against:
        with _folder(chosen, "written") as folder:
            for cases in written_cases(folder, _BATCH):
                for flags in FLAGS[:2]:
                    yield _checked(folder, cases, flags, chosen.against)


def _blames(chosen: argparse.Namespace) -> Iterator[Tally]:
    """Each stage by itself, opened in this process."""
    from usdvol_lint.config import Config
    from usdvol_lint.engine.engine import Engine
    from usdvol_lint.packs.activation import activate
    from usdvol_lint.packs.catalog import load

    from .blaming import broken_laws

    catalog = load()
    engine = Engine(catalog.rules, activate(Config(), catalog))
    for number in range(chosen.first, chosen.first + chosen.count):
        with _folder(chosen, f"blame{number:06}") as folder:
            case, *_ = random_cases(folder, chosen.seed, range(number, number + 1))
            broken = broken_laws(engine, folder / case.path, number)
            yield Tally(1, tuple(f"{case.story}: {each}" for each in broken))


def _checked(folder: Path, cases: list[Case], flags: tuple[str, ...], other: Path | None) -> Tally:
    """The batch by this checkout, and at the same time by the other."""
    jobs = 1 if other else os.cpu_count() or 1
    our_run = start(ROOT, folder, cases, flags, jobs, "this")
    their_run = start(other.resolve(), folder, cases, flags, 1, "other") if other else None
    ours = our_run.result()
    missed = () if flags else tuple(judged(cases, ours))
    different = _compared(cases, ours, their_run) if their_run else ()
    return Tally(len(cases), missed, different)


def _compared(cases: list[Case], ours: object, their_run: Run) -> tuple[str, ...]:
    return tuple(differences(cases, ours, their_run.result()))


def _print_new(part: Tally, tally: Tally) -> None:
    """Of each kind the first few in all; the rest is counted."""
    for what, new, known in (
        ("not as expected", part.missed, tally.missed),
        ("different", part.different, tally.different),
    ):
        for each in new[: max(0, _SHOWN - (len(known) - len(new)))]:
            print(f"{what}: {each}", flush=True)


@contextmanager
def _folder(chosen: argparse.Namespace, name: str) -> Iterator[Path]:
    """A folder for a batch, which goes with it unless it is to be kept."""
    if chosen.keep:
        folder = chosen.keep.resolve() / name
        folder.mkdir(parents=True)
        yield folder
        return
    folder = Path(tempfile.mkdtemp(prefix="usdvol-stages-"))
    try:
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)


if __name__ == "__main__":
    sys.exit(main())
