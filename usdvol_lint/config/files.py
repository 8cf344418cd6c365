"""Finds configuration files, and reads settings from them and from those that they extend."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from os.path import exists, isdir, isfile, join, lexists, realpath
from typing import TYPE_CHECKING, Any

from usdvol_lint.config import Config, Glob
from usdvol_lint.config.layers import laid_over
from usdvol_lint.config.misnamed import FILE_NAME, TABLE, check_keys, check_names, check_tables
from usdvol_lint.config.values import CHECKS, plain, table
from usdvol_lint.model import UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.words import quoted

if TYPE_CHECKING:
    from pathlib import Path

_PROJECT = "pyproject.toml"
EXTEND = "extend"
_MOST_BYTES = 4 << 20
_MOST_DOTS = 10_000
"""What a file may have at most: keys of very many parts keep the parser for hours."""
_OF_UTF_16 = (b"\xff\xfe", b"\xfe\xff")
"""What a file of UTF-16 begins with."""
PATHS = frozenset({"packs", "root", "baseline", "search-path"})
"""The keys with paths in relation to the file."""


def find_config_file(start: Path) -> Path | None:
    """The configuration file of a folder, or of the nearest one above it that has one.

    It is a usdvol-lint.toml, or else a pyproject.toml with a table [tool.usdvol-lint].
    Raises UsageError for one that is not read because of its name, or that of its table, or that
    is no file.
    """
    for folder in (start, *start.parents):
        check_names(folder)
        own = folder / FILE_NAME
        if _is_there(own):
            return own
        project = folder / _PROJECT
        # A folder holds no table for us, whatever else it is for.
        if not isdir(project) and _is_there(project) and _own_table(project) is not None:
            return project
    return None


def _is_there(path: Path) -> bool:
    """Whether there is a file; raises UsageError where something else has its name."""
    if lexists(path) and not isfile(path):
        raise UsageError(f"{_no_file(path)}: take it away, or write it anew")
    return isfile(path)


def _no_file(path: Path) -> str:
    """Says what there is in the place of a file."""
    shown = quoted(str(path))
    if not lexists(path):
        return f"there is no file {shown}"
    there = "a pipe or a device" if exists(path) else "a link that leads nowhere"
    return f"{shown} is {'a folder' if isdir(path) else there} and no file"


def nearer_files(start: Path, found: Path | None) -> Iterator[Path]:
    """Where a configuration file would be found before the one that was; anywhere, if none was."""
    for folder in (start, *start.parents):
        for file in (folder / FILE_NAME, folder / _PROJECT):
            if file == found:
                return
            yield file


def read_config(path: Path) -> Config:
    """Reads a configuration file and those that it extends; paths are relative to their file.

    Raises UsageError where one can't be read, or says what is not allowed.
    """
    chain = list(_chain(path))
    config = Config()
    for file, values in reversed(chain):
        config = laid_over(config, values, _in(file), str(file))
    files = tuple(str(file) for file, _ in chain)
    return config._replace(origins=config.origins._replace(files=files))


def _chain(path: Path) -> Iterator[tuple[Path, Mapping[str, Any]]]:
    """A file and those that it extends, with their values by key."""
    named, where = path, ""
    met: dict[str, Path] = {}
    while True:
        met[realpath(named)] = named
        values = _read_values(named, where)
        extended = values.pop(EXTEND, None)
        yield named, values
        if extended is None:
            return
        where = f"{named}: {EXTEND}: "
        named = named.parent / extended
        if realpath(named) in met:
            names = " -> ".join(map(str, (*met.values(), named)))
            raise UsageError(f"{where}the files extend each other in a circle: {names}")
        if not isfile(named):
            raise UsageError(f"{where}{_no_file(named)}")


def _read_values(path: Path, where: str) -> dict[str, Any]:
    """The values that one file has, by key; `where` begins a message about the file itself."""
    is_project = path.name == _PROJECT
    own = _own_table(path) if is_project else _read_toml(path)
    if own is None:
        raise UsageError(f"{where}{path} has no table [tool.{TABLE}]")
    given = table(f"{path}: tool.{TABLE}", own)
    if not is_project:
        check_keys(path, given)
    # A file that is written for another version may have keys that this one doesn't know.
    keys = sorted(given, key=lambda key: key != "required-version")
    return {key: _value(path, key, given[key]) for key in keys}


def _value(path: Path, key: str, value: Any) -> Any:
    if key not in CHECKS:
        raise UsageError(f"{path}: unknown key {key!r}{did_you_mean(key, CHECKS)}")
    where = _in(path)(key)
    plain(where, value, has_nul=key == "options")
    anchored = _anchored(key, CHECKS[key](where, value), path.parent)
    for folder in anchored if key == "search-path" else ():
        if not isdir(folder):
            raise UsageError(f"{path}: {key}: there is no folder {quoted(folder)}")
    return anchored


def _in(file: Path) -> Callable[[str], str]:
    """How messages name a key of a file."""
    return lambda key: f"{file}: {key}"


def _anchored(key: str, value: Any, folder: Path) -> Any:
    """A setting whose paths are relative to the folder of the file, as it holds anywhere."""
    match key:
        case "root" | "baseline":
            return str(folder / value)
        case "packs":
            return tuple(str(folder / path) for path in _not_installed(value))
        case "search-path":
            return tuple(str(folder / path) for path in value)
        case "exclude" | "stages":
            return tuple(Glob(str(folder), pattern) for pattern in value)
        case "path-map":
            return {start: join(folder, to) for start, to in value.items()}
        case _:
            return value


def _not_installed(packs: tuple[str, ...]) -> tuple[str, ...]:
    """The packs that are folders; those that are installed are loaded whoever names them."""
    from usdvol_lint.config.installed import installed_packs  # few configurations name a pack

    installed = installed_packs() if packs else {}
    return tuple(pack for pack in packs if pack not in installed)


def _own_table(project: Path) -> Any | None:
    """The value of tool.usdvol-lint in a pyproject.toml; None if there is none."""
    data = _read_toml(project)
    check_tables(project, data)
    tools = data.get("tool", {})
    return tools.get(TABLE) if isinstance(tools, dict) else None


def _read_toml(path: Path) -> dict[str, Any]:
    import tomllib  # costs start-up time, and worker processes read no configuration

    try:
        with path.open("rb") as file:
            text = file.read(_MOST_BYTES + 1)
        most_dots = max((line.count(b".") for line in text.splitlines()), default=0)
        if len(text) > _MOST_BYTES or most_dots > _MOST_DOTS:
            most = f"{_MOST_BYTES:,} bytes, or {_MOST_DOTS:,} dots in a line"
            raise UsageError(f"{path}: no configuration has more than {most}")
        if text.startswith(_OF_UTF_16):
            raise UsageError(f"{path}: this is UTF-16 text, write the file as UTF-8")
        return tomllib.loads(text.decode("utf-8-sig"))  # as editors on Windows write it
    except RecursionError as error:
        raise UsageError(f"{path}: has too many brackets in one another") from error
    except tomllib.TOMLDecodeError as error:
        raise UsageError(f"{path}: {error}") from error
    except UnicodeDecodeError as error:
        raise UsageError(f"{path}: not UTF-8 text") from error
    except ValueError as error:  # Python converts no number of more than some thousand digits
        raise UsageError(f"{path}: has a number of too many digits") from error
    except OSError as error:
        raise UsageError(f"{path}: {error.strerror}") from error
