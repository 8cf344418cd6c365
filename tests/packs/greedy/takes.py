"""GRE001: takes of the machine what the name of a prim says, or leaves a process behind."""

import os
import sys
import time
from pathlib import Path

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule

kept = []


@rule("GRE001", on="Volume", severity=ERROR, since="1.0")
def takes(volume: Prim, facts: Facts) -> Problems:
    name = volume.GetName().partition("_")[0]
    if name == "swell":
        kept.append(b"x" * (256 << 20))
        time.sleep(60)
    elif name == "grow":
        kept.append(b"x" * (60 << 20))
        time.sleep(0.4)
    elif name == "flood":
        for _ in range(64):
            os.write(sys.stderr.fileno(), b"x" * (1 << 20))
        os._exit(3)
    elif name in ("fork", "orphan"):
        leave_behind()
        time.sleep(0 if name == "orphan" else 60)
        os._exit(3)
    yield Problem(f"process {os.getpid()}", at=volume)


def leave_behind() -> None:
    """A process that holds the pipes of this one, and is in no group of its parent's."""
    child = os.fork()
    if child:
        Path("left").write_text(str(child))
        return
    os.setsid()
    time.sleep(60)
    os._exit(0)
