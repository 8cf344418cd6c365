"""Why a worker process ended while it checked a stage, and what to do about that."""

from __future__ import annotations

import signal

from usdvol_lint.engine.trouble import Trouble
from usdvol_lint.run.limits import address_space
from usdvol_lint.words import format_size

LESS = "look at less with --content first --times ends"
MORE_MEMORY = "give the machine more memory, or let fewer work at once with --jobs"
_FROM_OUTSIDE = frozenset({"SIGHUP", "SIGKILL", "SIGTERM"})


def timed_out(limit: float) -> Trouble:
    """That a stage took longer than its limit."""
    return Trouble(
        f"stopped after {limit:g} s, the limit for one stage",
        f"a large stage or a slow disk needs more: raise --timeout, or {LESS}; "
        "a pipe or a corrupt layer never ends",
    )


def too_large(own: int, limit: float) -> Trouble:
    """That the process took more memory than one may."""
    return Trouble(
        f"stopped at {format_size(own)} of memory; the limit for one process is "
        f"{format_size(limit)}",
        f"if the stage is that large, raise --memory-limit, let fewer work at once with --jobs, or "
        f"{LESS}; if it is not, look for references that bring references: a few of them multiply",
    )


def crashed(code: int, said: str) -> Trouble:
    """That the process ended by itself, or by another one, with its last words."""
    cause = cause_of(code)
    space = address_space()
    if cause in _FROM_OUTSIDE:
        what = f"the process that checked it was ended from outside ({cause})"
        advice = MORE_MEMORY
    elif space is not None:
        what = f"the process that checked it ended ({cause})"
        advice = f"{format_size(space)} of addresses may be too few: raise `ulimit -v`, or {LESS}"
    elif 0 <= code < 256 or cause == "SIGINT":  # which is how Python ends by KeyboardInterrupt
        what = f"the process that checked it ended early ({cause})"
        advice = "a bug of usdvol-lint, a rule pack or a USD plugin; --verbose shows what it said"
    else:
        what = f"the USD library crashed while reading it ({cause})"
        advice = (
            "the file or a layer it names is probably corrupt: open it with usdcat to see which"
        )
    return Trouble(what, advice, detail=said)


def not_started(reason: str) -> Trouble:
    """That nothing was left to check a stage: no process could take the place of one that ended."""
    return Trouble(f"not checked: {reason}", MORE_MEMORY, of_machine="processes")


def cause_of(code: int) -> str:
    """An exit code as a person reads it."""
    if code >= 0:
        return f"exit code {code if code < 256 else hex(code)}"
    try:
        return signal.Signals(-code).name
    except ValueError:
        return f"signal {-code}"
