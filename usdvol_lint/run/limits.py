"""The limits that the shell sets for each process, as `ulimit` prints and changes them."""

from __future__ import annotations

from collections.abc import Iterator

from usdvol_lint.words import format_size

_FEW_FILES = 256
_FEW_PROCESSES = 1000


def address_space() -> int | None:
    """The bytes of addresses that a process may use, mapped files among them; None for any."""
    return _limit("RLIMIT_AS")


def narrow_limits() -> str:
    """What to do about the limits that are narrow: the end of a sentence, or nothing."""
    found = list(_narrow())
    return f"; this shell allows {', '.join(found)}: raise that" if found else ""


def _narrow() -> Iterator[str]:
    space, files, processes = map(_limit, ("RLIMIT_AS", "RLIMIT_NOFILE", "RLIMIT_NPROC"))
    if space is not None:
        yield f"a process {format_size(space)} of addresses (ulimit -v)"
    if files is not None and files < _FEW_FILES:
        yield f"a process {files} open files (ulimit -n)"
    if processes is not None and processes < _FEW_PROCESSES:
        yield f"a user {processes} processes and threads (ulimit -u)"


def _limit(name: str) -> int | None:
    """A limit of this process; None if there is none, or none of that kind."""
    try:
        import resource  # which Windows has not
    except ImportError:
        return None
    number = getattr(resource, name, None)
    found = resource.RLIM_INFINITY if number is None else resource.getrlimit(number)[0]
    return None if found == resource.RLIM_INFINITY else found
