"""The entry point of `usdvol-lint` and `python -m usdvol_lint`.

It starts the slowest step, importing USD, first.
"""

from __future__ import annotations

import os
import sys
from contextlib import suppress

if __name__ == "__main__" and not sys.flags.safe_path:
    # `python -m` puts the working directory first, which may be a stranger's checkout.
    del sys.path[0]

from usdvol_lint import __version__

TYPE_CHECKING = False
if TYPE_CHECKING:
    from typing import NoReturn

    from usdvol_lint.run.interruption import Interruption

_STARTS_NO_CHILD = {
    *("--version", "-h", "--help", "--explain", "--list-rules", "--show-settings"),
    "--show-files",
    "--test",  # it starts its own, in another working directory
}


def main() -> None:
    """Answers `--version` and `--help` itself; all else goes to the command line.

    What ends it before the command line can say so is one line all the same: 1 would mean findings.
    """
    try:
        _main()
    except KeyboardInterrupt as signal:
        _fail_interrupted(signal.args[0] if signal.args else 2)
    except Exception as error:  # such as a module that no memory or file handle is left for
        words = " ".join(f"{type(error).__name__}: {error}".split())
        _fail(f"error: it can't be started ({words.removesuffix(': ')}); look at `ulimit -a`", 2)


def _main() -> None:
    _open_standard_streams()
    _use_utf8()
    arguments = sys.argv[1:]
    if arguments == ["--version"]:
        _print(f"usdvol-lint {__version__}\n")
    elif arguments in (["-h"], ["--help"]):
        with open(os.path.join(os.path.dirname(__file__), "help.txt"), encoding="utf-8") as file:
            _print(file.read())
    else:
        _run(arguments)


def _run(arguments: list[str]) -> None:
    from usdvol_lint.run.interruption import Interruption

    signals = Interruption()
    signals.listen()
    if arguments and _STARTS_NO_CHILD.isdisjoint(each.partition("=")[0] for each in arguments):
        _lint(arguments, signals)
    signals.release()
    from usdvol_lint.command.cli import main as run_command

    sys.exit(run_command(arguments, None, signals))


def _open_standard_streams() -> None:
    """Puts the null device in the place of what is closed, or else the next pipe would be there."""
    for number in range(3):
        try:
            os.fstat(number)
        except OSError:
            os.open(os.devnull, os.O_RDWR)
    if sys.stderr is None:
        sys.stderr = os.fdopen(os.open(os.devnull, os.O_WRONLY), "w", encoding="utf-8")


def _use_utf8() -> None:
    """Begins anew where the locale is no UTF-8, as USD's names of files are whatever the locale."""
    if sys.getfilesystemencoding() != "utf-8" and os.environ.get("PYTHONUTF8") != "1":
        os.environ["PYTHONUTF8"] = "1"
        os.execv(sys.executable, [sys.executable, *sys.orig_argv[1:]])


def _print(text: str) -> None:
    try:
        print(text, end="", flush=True)
    except BrokenPipeError:  # a reader that left, as `head` does
        os._exit(2)
    except OSError as error:
        _fail(f"error: can't write to standard output: {error.strerror}", 2)


def _fail(words: str, code: int) -> None:
    """Says in one line why nothing was done, if anybody can hear it, and ends the process."""
    with suppress(OSError):
        print(f"usdvol-lint: {words}", file=sys.stderr, flush=True)
    os._exit(code)


def _fail_interrupted(number: int) -> None:
    from usdvol_lint.run.interruption import name_of

    _fail(f"interrupted by {name_of(number)}", 128 + number)


def _lint(arguments: list[str], signals: Interruption) -> NoReturn:
    """Starts the process that imports USD, and imports the command line meanwhile."""
    from usdvol_lint.child import kill_child, start_child

    child = None
    with suppress(OSError):  # no file handles or processes left: it is tried again, and then said
        child = start_child()
    import gc

    # What is found is plain data without cycles: looking for them among 100,000 causes takes longer
    # than making these.
    gc.disable()
    try:
        from usdvol_lint.command.cli import main as run_command

        code = run_command(arguments, child, signals)
    finally:
        if child:
            kill_child(child)
    _leave(code)


def _leave(code: int) -> NoReturn:
    """Ends the process at once: tearing down all that was imported would only cost time."""
    try:
        for stream in (sys.stdout, sys.stderr):
            if stream is not None:
                stream.flush()
    except OSError:
        code = 2
    os._exit(code)


if __name__ == "__main__":
    main()
