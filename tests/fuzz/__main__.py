"""`python -m tests.fuzz`: hostile inputs by seed and number, and what the command line does.

What is not as it should be is kept in a folder, as small as it still is wrong where that is simple.
"""

from __future__ import annotations

import argparse
import shutil
import sys
import tempfile
import time
from collections import Counter
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Lock

from .keeping import keep
from .making import Maker
from .model import Input
from .real import real_texts
from .running import Outcome, outcomes

_BATCH = 100
_MAKING = Lock()
"""One thread makes inputs: there is one process for crates, and an input is the same each time."""


class Tally:
    """What came of all inputs so far."""

    def __init__(self) -> None:
        self.words: Counter[tuple[str, str]] = Counter()
        self.layers = self.opened = self.wrong = self.peak = 0

    def add(self, made: Input, outcome: Outcome) -> None:
        self.words[made.kind, outcome.word] += 1
        self.wrong += bool(outcome.wrong)
        if made.is_layer:
            self.layers += 1
            self.opened += bool(outcome.opened)

    def table(self) -> str:
        words = sorted({word for _, word in self.words})
        kinds = sorted({kind for kind, _ in self.words})
        rows = [["", *words, "all"]]
        for kind in kinds:
            counts = [self.words[kind, word] for word in words]
            rows.append([kind, *(str(count or "") for count in counts), str(sum(counts))])
        sums = [sum(self.words[kind, word] for kind in kinds) for word in words]
        rows.append(["all", *map(str, sums), str(sum(sums))])
        widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
        return "\n".join(
            "  ".join(
                cell.rjust(width) if place else cell.ljust(width)
                for place, (cell, width) in enumerate(zip(row, widths, strict=True))
            ).rstrip()
            for row in rows
        )


def main() -> int:
    """1 if something is not as it should be."""
    chosen = _arguments()
    folder = (chosen.keep or Path(tempfile.mkdtemp(prefix="usdvol-fuzz-kept-"))).resolve()
    if chosen.only:
        seed, _, number = chosen.only.partition(":")
        return _replay(int(seed), int(number), folder)
    tally, ends = Tally(), time.monotonic() + 60 * chosen.minutes
    maker = Maker(chosen.seed, *real_texts())
    starts = range(chosen.first, chosen.first + chosen.count, _BATCH)
    last = chosen.first + chosen.count

    def batch(start: int) -> None:
        if time.monotonic() < ends:
            _batch(maker, chosen.seed, range(start, min(start + _BATCH, last)), folder, tally)

    with ThreadPoolExecutor(chosen.jobs) as pool:
        list(pool.map(batch, starts))
    print(tally.table())
    share = 100 * tally.opened // max(tally.layers, 1)
    print(f"{tally.opened} of {tally.layers} layers open in USD ({share} %)")
    print(f"the most memory of one process: {tally.peak} MB")
    print(f"{tally.wrong} not as they should be" + (f", in {folder}" if tally.wrong else ""))
    return 1 if tally.wrong else 0


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser("python -m tests.fuzz", description=__doc__)
    parser.add_argument("--minutes", type=float, default=10, help="begin no batch after these")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--count", type=int, default=10_000, help="of inputs, at most")
    parser.add_argument("--first", type=int, default=0, help="number of the first input")
    parser.add_argument("--jobs", type=int, default=2, help="how many batches at a time")
    parser.add_argument("--only", metavar="SEED:NUMBER", help="this input alone")
    parser.add_argument("--keep", type=Path, metavar="FOLDER", help="where to keep what is wrong")
    return parser.parse_args()


def _batch(maker: Maker, seed: int, numbers: range, folder: Path, tally: Tally) -> None:
    with _MAKING:
        inputs = {number: maker.make(number) for number in numbers}
    scratch = Path(tempfile.mkdtemp(prefix="usdvol-fuzz-"))
    try:
        found, peak = outcomes(inputs, scratch)
    finally:
        shutil.rmtree(scratch, ignore_errors=True)
    tally.peak = max(tally.peak, peak)
    for number, outcome in sorted(found.items()):
        tally.add(inputs[number], outcome)
        if outcome.wrong:
            print(f"{seed}:{number} ({inputs[number].kind}): {'; '.join(outcome.wrong)[:300]}")
            keep(inputs[number], outcome, folder / f"{seed}-{number}")
    print(f"{numbers.start}-{numbers.stop - 1}: {peak} MB", flush=True)


def _replay(seed: int, number: int, folder: Path) -> int:
    made = Maker(seed, *real_texts()).make(number)
    found, peak = outcomes({number: made}, folder)
    outcome = found[number]
    print(f"{made.kind}: {outcome.word}, {peak} MB; it is in {folder}")
    print("\n".join([*outcome.wrong, outcome.detail]))
    return 1 if outcome.wrong else 0


if __name__ == "__main__":
    sys.exit(main())
