"""`python -m bench`: runs cases and prints a table of ratios, without asserting anything."""

from __future__ import annotations

import argparse
import os
import platform
import shutil
from importlib.metadata import version
from pathlib import Path
from statistics import median

from bench.case import Case, Make
from bench.cases import CASES
from bench.measure import Pairs, UnexpectedExitError, measure

_DATA = Path.home() / ".cache" / "usdvol-lint-bench"
_DATA_HELP = f"where the stages are kept for the next time (default: {_DATA})"
_ROW = "{:<16} {:>9} {:>9} {:>7} {:>7}"


def main() -> None:
    """Measures the cases that the command line names, or all but the big ones."""
    chosen = _arguments()
    cases = [case for case in CASES if _is_chosen(case, chosen.names)]
    print(
        f"{os.cpu_count()} cores, Python {platform.python_version()}, "
        f"USD {version('usd-core')}, {chosen.runs} runs, scale {chosen.scale:g}"
    )
    print(_ROW.format("case", "floor", "ours", "ratio", "wanted"))
    chosen.data.mkdir(parents=True, exist_ok=True)
    for case in cases:
        print(_measured(case, chosen.data.resolve(), chosen.scale, chosen.runs), flush=True)


def _is_chosen(case: Case, names: list[str]) -> bool:
    return case.name in names if names else not case.is_big


def _measured(case: Case, data: Path, scale: float, runs: int) -> str:
    """The row of a case."""
    if case.needs and not shutil.which(case.needs):
        return f"{case.name:<16} {case.needs} is not installed"
    stages, floor_stages = (
        [str(_made(make, data, scale))] if make else []
        for make in (case.make, case.make_floor or case.make)
    )
    floor = (case.floor, floor_stages) if case.floor else None
    try:
        pairs = measure(floor, (case.ours, stages), runs, data / "bytecode")
    except UnexpectedExitError as error:
        return f"{case.name:<16} {error}"
    return _row(case, pairs)


def _row(case: Case, pairs: Pairs) -> str:
    ours = f"{median(pairs.ours):.3f} {case.unit}"
    if not pairs.floor:
        return _ROW.format(case.name, "", ours, "", f"{case.wanted:g} {case.unit}")
    floor = f"{median(pairs.floor):.3f} {case.unit}"
    return _ROW.format(case.name, floor, ours, f"{pairs.ratio:.2f}", f"{case.wanted:.2f}")


def _made(make: Make, data: Path, scale: float) -> Path:
    """The path of what `make` wrote, which is kept; after an interruption it is written anew."""
    folder = data / f"{make.__name__}-{scale:g}"
    note = folder / "stage"
    if not note.exists():
        shutil.rmtree(folder, ignore_errors=True)
        folder.mkdir()
        note.write_text(make(folder, scale).name, encoding="utf-8")
    return folder / note.read_text(encoding="utf-8")


def _arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(prog="python -m bench", description=__doc__)
    names = [case.name for case in CASES]
    parser.add_argument("names", nargs="*", metavar="NAMES", help=f"of {', '.join(names)}")
    parser.add_argument("--runs", type=int, default=7, help="pairs for each case (default: 7)")
    parser.add_argument("--scale", type=float, default=1.0, help="factor on the stages' sizes")
    parser.add_argument("--data", type=Path, metavar="FOLDER", default=_DATA, help=_DATA_HELP)
    chosen = parser.parse_args()
    if unknown := set(chosen.names) - set(names):
        parser.error(f"no case {', '.join(sorted(unknown))}; there are {', '.join(names)}")
    return chosen


if __name__ == "__main__":
    main()
