"""`python -m bench`: runs the cases and prints a table of ratios; nothing is asserted."""

from __future__ import annotations

import argparse
import os
import platform
import shutil
import tempfile
from importlib.metadata import version
from pathlib import Path
from statistics import median

from bench.cases import CASES, Case
from bench.measure import Pairs, UnexpectedExit, measure

_ROW = "{:<16} {:>9} {:>9} {:>7} {:>7}"


def main() -> None:
    """Measures the cases that the command line names, or all."""
    chosen = _arguments()
    cases = [case for case in CASES if not chosen.names or case.name in chosen.names]
    print(
        f"{os.cpu_count()} cores, Python {platform.python_version()}, "
        f"USD {version('usd-core')}, {chosen.runs} runs, scale {chosen.scale:g}"
    )
    print(_ROW.format("case", "floor s", "ours s", "ratio", "wanted"))
    if chosen.data:
        chosen.data.mkdir(parents=True, exist_ok=True)
        _measure_all(cases, chosen.data.resolve(), chosen)
    else:
        with tempfile.TemporaryDirectory(prefix="usdvol-lint-bench-") as folder:
            _measure_all(cases, Path(folder), chosen)


def _measure_all(cases: list[Case], data: Path, chosen: argparse.Namespace) -> None:
    for case in cases:
        stages = [str(_made(case, data, chosen.scale))] if case.make else []
        try:
            pairs = measure(case.floor, case.ours, stages, chosen.runs, data / "bytecode")
        except UnexpectedExit as error:
            print(f"{case.name:<16} {error}", flush=True)
        else:
            print(_row(case, pairs), flush=True)


def _row(case: Case, pairs: Pairs) -> str:
    floor, ours = median(pairs.floor), median(pairs.ours)
    return _ROW.format(
        case.name, f"{floor:.3f}", f"{ours:.3f}", f"{pairs.ratio:.2f}", f"{case.wanted:.2f}"
    )


def _made(case: Case, data: Path, scale: float) -> Path:
    """The stage of a case; it is made once, and in whole."""
    assert case.make
    folder = data / f"{case.make.__name__}-{scale:g}"
    note = folder / "stage"
    if not note.exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        note.write_text(case.make(folder, scale).name, encoding="utf-8")
    return folder / note.read_text(encoding="utf-8")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    names = [case.name for case in CASES]
    parser.add_argument("names", nargs="*", metavar="NAMES", help=f"of {', '.join(names)}")
    parser.add_argument("--runs", type=int, default=7, help="pairs for each case (default: 7)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the stages' sizes")
    parser.add_argument("--data", type=Path, metavar="FOLDER", help="keep the stages here")
    chosen = parser.parse_args()
    if unknown := set(chosen.names) - set(names):
        parser.error(f"no case {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    return chosen


if __name__ == "__main__":
    main()
