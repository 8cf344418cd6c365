"""The entry point of `usdvol-lint` and `python -m usdvol_lint`.

It starts the slowest step, importing USD, first.
"""

from __future__ import annotations

import os
import sys

if __name__ == "__main__" and not sys.flags.safe_path:
    # `python -m` puts the working directory first, which may be a stranger's checkout.
    del sys.path[0]

from usdvol_lint import __version__

_STARTS_NO_CHILD = {
    *("--version", "-h", "--help", "--explain", "--list-rules", "--show-settings"),
    "--show-files",
    "--test",  # it starts its own, in another working directory
}


def main() -> None:
    """Answers `--version` and `--help` itself; all else goes to the command line."""
    _open_standard_streams()
    _use_utf8()
    arguments = sys.argv[1:]
    if arguments == ["--version"]:
        _print(f"usdvol-lint {__version__}\n")
    elif arguments in (["-h"], ["--help"]):
        with open(os.path.join(os.path.dirname(__file__), "help.txt"), encoding="utf-8") as file:
            _print(file.read())
    elif not arguments or not _STARTS_NO_CHILD.isdisjoint(arguments):
        from usdvol_lint.command.cli import main as run_command

        sys.exit(run_command(arguments))
    else:
        _lint(arguments)


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
    except OSError:  # a reader that left, as `head` does, or a full disk
        os._exit(2)


def _lint(arguments: list[str]) -> None:
    """Starts the process that imports USD, and imports the command line meanwhile."""
    from usdvol_lint.child import start_child

    try:
        child = start_child()
    except OSError as error:  # no file handles or processes left
        print(f"usdvol-lint: error: no process can be started: {error.strerror}", file=sys.stderr)
        sys.exit(2)
    import gc
    import signal

    # What is found is plain data without cycles: looking for them among 100,000 causes takes longer
    # than making these.
    gc.disable()
    # A signal that ends this process, as a CI host sends it, has to end the workers too.
    signal.signal(signal.SIGTERM, _terminate)
    try:
        from usdvol_lint.command.cli import main as run_command

        code = run_command(arguments, child)
    finally:
        child.kill()
    _leave(code)


def _terminate(number: int, frame: object) -> None:
    raise KeyboardInterrupt(number)


def _leave(code: int) -> None:
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
