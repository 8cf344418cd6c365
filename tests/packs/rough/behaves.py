"""RGH001: does to the process what the name of a prim says."""

import os
import signal
import sys
import time
from pathlib import Path

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("RGH001", on="Volume", severity=ERROR, since="1.0")
def behaves(volume: Prim, facts: Facts) -> Problems:
    name = volume.GetName().partition("_")[0]
    if name == "abort":
        os.abort()
    elif name == "segfault":
        os.kill(os.getpid(), signal.SIGSEGV)
    elif name == "killed":
        os.kill(os.getpid(), signal.SIGKILL)
    elif name == "interrupt":
        signal.signal(signal.SIGINT, signal.SIG_DFL)
        os.kill(os.getpid(), signal.SIGINT)
    elif name == "exit":
        print("many words\n" * 50_000 + "last words", file=sys.stderr)
        os._exit(3)
    elif name == "leave":
        sys.exit(4)
    elif name == "hang":
        Path("hanging").touch()
        time.sleep(3600)
    elif name == "raise":
        raise ValueError(f"at {volume.GetPath()}:\nsecond line")
    elif name == "damaged":
        fail_as_usd_does(volume)
    elif name == "print":
        print("noise on standard output", flush=True)
    yield Problem("behaved", at=volume)


@rule("RGH002", on="Volume", severity=ERROR, since="1.0")
def behaves_too(volume: Prim, facts: Facts) -> Problems:
    if volume.GetName() == "damaged":
        fail_as_usd_does(volume)
    yield from ()


def fail_as_usd_does(prim: Prim) -> None:
    from pxr import Tf

    layer = prim.GetStage().GetRootLayer().realPath
    Tf.RaiseRuntimeError(f"no value in @{layer}@ at <{prim.GetPath()}>")
