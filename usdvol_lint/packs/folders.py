"""Finds the folders of rule packs, and imports the modules in them."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, redirect_stdout
from importlib import import_module, invalidate_caches
from types import ModuleType

from usdvol_lint.config.installed import installed_packs
from usdvol_lint.model import PackError
from usdvol_lint.rule import Rule

_BUILT_IN = "usdvol_lint.rules"
_NAMED = "usdvol_lint_pack_"
"""What the names of packages begin with that are made for folders."""
_CODE = re.compile(r"[A-Z]{3}\d{3}")


def find_packs(folders: Sequence[str]) -> list[tuple[str, str]]:
    """The name of an importable package and the folder of each pack.

    First the built-in pack, then installed ones, then `folders`.
    Raises PackError for a pack that is not there.
    """
    built_in = _built_in_folder()
    found = [(_mount(_BUILT_IN, built_in), built_in), *_installed_packs()]
    return found + list(_named_packs(folders, [os.path.realpath(folder) for _, folder in found]))


def _built_in_folder() -> str:
    """`rules` is beside `usdvol_lint` in a checkout, and inside it in a wheel."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    inside = os.path.join(package, "rules")
    return inside if os.path.isdir(inside) else os.path.join(os.path.dirname(package), "rules")


def _installed_packs() -> Iterator[tuple[str, str]]:
    for name, package in installed_packs().items():
        from importlib.util import find_spec  # costs start-up time, and few have such packs

        try:
            spec = find_spec(package)
        except (ImportError, ValueError):
            spec = None
        folders = list(spec.submodule_search_locations or ()) if spec else []
        if not folders:
            raise PackError(f"rule pack {name!r}: there is no package {package!r}")
        yield package, folders[0]


def _named_packs(packs: Sequence[str], known: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The folders named, without those that are mounted already."""
    from zlib import crc32

    for pack in packs:
        folder = os.path.realpath(pack)
        if not os.path.isdir(folder):
            raise PackError(f"rule pack {pack!r}: no such folder")
        if folder in known:
            continue
        # Named after its path: two packs in one process may both have a module `checks`.
        name = f"{_NAMED}{crc32(os.fsencode(folder)):08x}"
        _forget(name)
        yield _mount(name, folder), folder


def _forget(name: str) -> None:
    """Has a package imported anew: it may have been edited, and new workers read it from disk."""
    loaded = [module for module in list(sys.modules) if f"{module}.".startswith(f"{name}.")]
    for module in loaded:
        del sys.modules[module]
    if loaded:
        invalidate_caches()


def _mount(name: str, folder: str) -> str:
    """Makes a folder importable as a package of that name, wherever it lies."""
    package = ModuleType(name)
    package.__path__ = [folder]
    sys.modules[name] = package
    return name


def import_rules(package: str, folder: str) -> list[Rule]:
    """The rules in all modules below a folder.

    Raises PackError for a module that can't be imported, a malformed code, or no rule at all.
    """
    rules: list[Rule] = []
    leaves_no_trace = package.startswith(_NAMED)
    # What a module prints stays out of the report.
    with redirect_stdout(sys.stderr), _writing_bytecode(not leaves_no_trace):
        for name, path in _modules(package, folder):
            module = _import(name, path)
            rules += [value for value in vars(module).values() if isinstance(value, Rule)]
    if not rules:
        raise PackError(
            f"rule pack {folder!r} holds no rule: no module in it has a function with @rule"
        )
    for rule in rules:
        if not _CODE.fullmatch(rule.code):
            raise PackError(
                f"rule pack {folder!r}: a code is three capitals and three digits, "
                f"not {rule.code!r} ({rule.name})"
            )
    return rules


@contextmanager
def _writing_bytecode(wanted: bool) -> Iterator[None]:
    """Whether Python may write what it compiles beside the source, as far as it does so at all."""
    before = sys.dont_write_bytecode
    sys.dont_write_bytecode = before or not wanted
    try:
        yield
    finally:
        sys.dont_write_bytecode = before


def _modules(package: str, folder: str) -> Iterator[tuple[str, str]]:
    """Name and path of each module below a folder; names with `_` or `.` first are hidden."""
    try:
        entries = sorted(os.scandir(folder), key=lambda entry: entry.name)
    except OSError as error:
        raise PackError(f"{folder}: {error.strerror}") from error
    for entry in entries:
        stem, suffix = os.path.splitext(entry.name)
        if stem.startswith(("_", ".")):
            continue
        if entry.is_dir(follow_symlinks=False):
            yield from _modules(f"{package}.{entry.name}", entry.path)
        elif suffix == ".py":
            yield f"{package}.{stem}", entry.path


def _import(name: str, path: str) -> ModuleType:
    try:
        return import_module(name)
    except (Exception, SystemExit) as error:  # a pack is code of others, and may raise anything
        said = " ".join(f"{type(error).__name__}: {error}".split())
        raise PackError(f"{path}: {said}") from error
