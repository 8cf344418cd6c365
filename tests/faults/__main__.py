"""`python -m tests.faults`: runs the tool while things go wrong, and prints what came of it."""

from __future__ import annotations

import argparse
import sys
from collections import Counter
from pathlib import Path
from random import Random
from tempfile import TemporaryDirectory

sys.path[:0] = [str(Path(__file__).parent.parent)]

_ROW = "{:<16} {:>5} {:>8} {:>7} {:>7}  {}"


def main() -> int:
    """Does each kind of fault, or those named: 1 if a run does not end as it should."""
    from .kinds import KINDS
    from .outcome import ERROR, REPORT, WRONG

    parser = argparse.ArgumentParser(prog="python -m tests.faults", description=__doc__)
    parser.add_argument("kinds", nargs="*", help=f"of {', '.join(KINDS)}; all by default")
    parser.add_argument("--stages", type=int, default=1000, help="in each run (default: 1000)")
    parser.add_argument("--seed", type=int, default=1, help="of what is random (default: 1)")
    chosen = parser.parse_args()
    if unknown := set(chosen.kinds) - set(KINDS):
        parser.error(f"no kind {', '.join(sorted(unknown))}; there are {', '.join(KINDS)}")
    print(_ROW.format("kind", "runs", "reports", "errors", "wrong", "stages"))
    wrong = 0
    for name in chosen.kinds or KINDS:
        with TemporaryDirectory(prefix="faults-") as folder:
            found = list(KINDS[name](Path(folder), Random(chosen.seed), chosen.stages))
        kinds = Counter(each.kind for each in found)
        stages = Counter[str]()
        for each in found:
            stages.update(each.statuses)
        said = ", ".join(f"{number:,} {status}" for status, number in sorted(stages.items()))
        numbers = (kinds[kind] for kind in (REPORT, ERROR, WRONG))
        print(_ROW.format(name, len(found), *numbers, said), flush=True)
        for each in (each for each in found if each.kind == WRONG):
            print(f"    {each.why}")
        wrong += kinds[WRONG]
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
