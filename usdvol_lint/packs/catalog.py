"""Rule packs: a folder of rules and their pages becomes a catalog that can be selected from."""

from __future__ import annotations

import os
import re
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import redirect_stdout, suppress
from importlib import import_module, invalidate_caches
from types import ModuleType
from typing import TYPE_CHECKING, NamedTuple

from usdvol_lint.model import PackError, Severity, UsageError
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.rule import Problems, Rule

if TYPE_CHECKING:
    from usdvol_lint.packs.page import Page

ENTRY_POINT_GROUP = "usdvol_lint.packs"
_BUILT_IN = "usdvol_lint.rules"
_CODE = re.compile(r"[A-Z]{3}\d{3}")


def _from_engine(prim: object, facts: object) -> Problems:
    yield from ()


def _engine_rule(code: str, name: str, severity: Severity) -> Rule:
    return Rule(code, name, (), severity, "0.1", _from_engine, {})


STAGE_UNREADABLE = _engine_rule("LNT001", "stage-unreadable", Severity.ERROR)
RULE_FAILED = _engine_rule("LNT002", "rule-failed", Severity.ERROR)
USD_TOO_OLD = _engine_rule("LNT004", "usd-too-old", Severity.WARNING)
NOT_CHECKED = _engine_rule("LNT005", "not-checked", Severity.INFO)
ENGINE_RULES = (STAGE_UNREADABLE, RULE_FAILED, USD_TOO_OLD, NOT_CHECKED)
"""What the engine itself reports; `rules/lint/` holds only the pages."""
NOT_IGNORABLE = frozenset({STAGE_UNREADABLE.code, RULE_FAILED.code})
"""They say that the job was not done, so nobody can switch them off."""


def help_for(rule: Rule) -> str:
    """The command that prints a rule's page: it works wherever the tool does."""
    return f"usdvol-lint --explain {rule.code}"


class Catalog(NamedTuple):
    """All rules by code, in order, with the folders their pages lie in."""

    rules: Mapping[str, Rule]
    folders: tuple[str, ...] = ()

    def page(self, code: str) -> Page | None:
        """The page of a rule, or None if its pack has none."""
        from pathlib import Path  # this and the next cost start-up time, and few runs show a page

        from usdvol_lint.packs.page import read_page

        stem = self.rules[code].name.replace("-", "_")
        for folder in self.folders:
            for path in Path(folder).glob(f"**/{stem}.md"):
                page = read_page(path)
                if page.code == code:
                    return page
        return None

    def find(self, code_or_name: str) -> Rule:
        """The rule of that code or name."""
        wanted = code_or_name.strip()
        by_name = {rule.name: rule for rule in self.rules.values()}
        rule = self.rules.get(wanted.upper()) or by_name.get(wanted.lower())
        if rule is None:
            raise UsageError(f"no rule {wanted!r}{did_you_mean(wanted, [*self.rules, *by_name])}")
        return rule

    def expand(self, selector: str) -> frozenset[str]:
        """The codes that a code, a prefix of codes, or ALL stands for."""
        wanted = selector.strip().upper()
        codes = self.rules if wanted == "ALL" else [c for c in self.rules if c.startswith(wanted)]
        if not codes or not wanted:
            raise UsageError(f"no rule code starts with {selector.strip()!r}{self._hint(wanted)}")
        return frozenset(codes)

    def select(self, select: Sequence[str], ignore: Sequence[str]) -> frozenset[str]:
        """The codes switched on; where `select` and `ignore` both match, the longer one wins."""
        chosen = self._lengths(select)
        dropped = self._lengths(ignore)
        for code in NOT_IGNORABLE & dropped.keys():
            if code in (selector.strip().upper() for selector in ignore):
                raise UsageError(f"{code} can't be ignored: it says that the job was not done")
        if not select:
            chosen = {code: 0 for code, rule in self.rules.items() if rule.default}
        on = {code for code, length in chosen.items() if length > dropped.get(code, -1)}
        return frozenset(on) | NOT_IGNORABLE

    def _hint(self, wanted: str) -> str:
        by_name = {rule.name.upper(): code for code, rule in self.rules.items()}
        families = sorted({code[:3] for code in self.rules})
        hint = did_you_mean(wanted, [*self.rules, *families, "ALL"])
        return hint or did_you_mean(by_name.get(wanted, ""), self.rules)

    def _lengths(self, selectors: Sequence[str]) -> dict[str, int]:
        lengths: dict[str, int] = {}
        for selector in selectors:
            for code in self.expand(selector):
                lengths[code] = max(length(selector), lengths.get(code, 0))
        return lengths


def length(selector: str) -> int:
    """How much a selector says: the longer of two that match a code wins; ALL says least."""
    stripped = selector.strip()
    return 0 if stripped.upper() == "ALL" else len(stripped)


def load(packs: Sequence[str] = ()) -> Catalog:
    """The built-in rules, those of installed packs, and those of the folders named."""
    built_in = _built_in_folder()
    mounted = [(_mount(_BUILT_IN, built_in), built_in), *_installed_packs()]
    mounted += _named_packs(packs, [os.path.realpath(folder) for _, folder in mounted])
    rules = {rule.code: rule for rule in ENGINE_RULES}
    names = {rule.name: rule for rule in ENGINE_RULES}
    for package, folder in mounted:
        for rule in _collect(package, folder):
            same_code = rules.setdefault(rule.code, rule)
            same_name = names.setdefault(rule.name, rule)
            for other in (same_code, same_name):
                if other is not rule:
                    raise PackError(
                        f"rule pack {folder!r}: {rule.code} ({rule.name}) takes the code or "
                        f"name of another rule, {other.code} ({other.name})"
                    )
    return Catalog(dict(sorted(rules.items())), tuple(folder for _, folder in mounted))


def _built_in_folder() -> str:
    """Beside the engine in a checkout, inside it in a wheel."""
    package = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))
    inside = os.path.join(package, "rules")
    return inside if os.path.isdir(inside) else os.path.join(os.path.dirname(package), "rules")


def _installed_packs() -> Iterator[tuple[str, str]]:
    # To import what reads entry points takes ten times as long as to see that there are none.
    if not any(map(_names_packs, sys.path)):
        return
    from importlib.metadata import entry_points
    from importlib.util import find_spec

    for entry in sorted(entry_points(group=ENTRY_POINT_GROUP), key=lambda entry: entry.name):
        try:
            spec = find_spec(entry.value)
        except (ImportError, ValueError):
            spec = None
        places = list(spec.submodule_search_locations or ()) if spec else []
        if not places:
            raise PackError(f"rule pack {entry.name!r}: there is no package {entry.value!r}")
        yield entry.value, places[0]


def _names_packs(folder: str) -> bool:
    """Whether some distribution in a folder of `sys.path` declares a rule pack."""
    with suppress(OSError):
        for name in os.listdir(folder or "."):
            if name.endswith("-info"):
                declared = os.path.join(folder, name, "entry_points.txt")
                with suppress(OSError), open(declared, "rb") as file:
                    if ENTRY_POINT_GROUP.encode() in file.read():
                        return True
    return False


def _named_packs(packs: Sequence[str], known: Sequence[str]) -> Iterator[tuple[str, str]]:
    """The folders named, but for those that are known as a pack already."""
    from zlib import crc32

    for pack in packs:
        folder = os.path.realpath(pack)
        if not os.path.isdir(folder):
            raise PackError(f"rule pack {pack!r}: no such folder")
        if folder in known:
            continue
        # By its place: two packs in one process may both have a module `checks`.
        name = f"usdvol_lint_pack_{crc32(os.fsencode(folder)):08x}"
        _forget(name)
        yield _mount(name, folder), folder


def _forget(name: str) -> None:
    """Has a package imported anew: workers read it from disk, and it may have been edited."""
    loaded = [module for module in sys.modules if f"{module}.".startswith(f"{name}.")]
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


def _collect(package: str, folder: str) -> list[Rule]:
    """The rules of every module below the folder that holds one; a pack without any is broken."""
    rules: list[Rule] = []
    with redirect_stdout(sys.stderr):  # what a module prints stays out of the report
        for name, path in _modules(package, folder):
            module = _import(name, path)
            rules += [value for value in vars(module).values() if isinstance(value, Rule)]
    if not rules:
        raise PackError(f"rule pack {folder!r} holds no rule")
    for rule in rules:
        if not _CODE.fullmatch(rule.code):
            raise PackError(
                f"rule pack {folder!r}: a code is three capitals and three digits, "
                f"not {rule.code!r} ({rule.name})"
            )
    return rules


def _modules(package: str, folder: str) -> Iterator[tuple[str, str]]:
    """Name and path of each module below a folder, but of none that `_` or `.` hides."""
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
    except (Exception, SystemExit) as error:
        said = " ".join(f"{type(error).__name__}: {error}".split())
        raise PackError(f"{path}: {said}") from error
