"""What Linux control groups grant this process, in both versions of their files."""

from __future__ import annotations

from collections.abc import Iterator

ROOT = "/sys/fs/cgroup"
OWN = "/proc/self/cgroup"


def granted(
    controller: str, name: str, old_names: tuple[str, ...], root: str = ROOT, own: str = OWN
) -> Iterator[list[str]]:
    """The words in the file `name` of each group around this process.

    In version 1 the file is that of the controller, and its words stand in `old_names`.
    """
    for line in text(own).splitlines():
        _, controllers, path = line.split(":", 2)
        if not controllers:
            yield from _words(root, path, (name,))
        elif controller in controllers.split(","):
            yield from _words(f"{root}/{controllers}", path, old_names)


def _words(root: str, path: str, names: tuple[str, ...]) -> Iterator[list[str]]:
    """What a group and those above it say; in a container only the outermost may be there."""
    while True:
        yield [word for name in names for word in text(f"{root}{path}/{name}").split()]
        if not path.strip("/"):
            return
        path = path.rpartition("/")[0]


def text(path: str) -> str:
    """What stands in a file; nothing if there is none."""
    try:
        with open(path, encoding="utf-8", errors="replace") as file:
            return file.read()
    except OSError:
        return ""
