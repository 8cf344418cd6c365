"""Preconditions: on which prims a rule need run at all, decided for all that are alike at once."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Iterable
from enum import Enum
from itertools import chain
from typing import TYPE_CHECKING, Any, NamedTuple

from usdvol_lint.facts.files import Files
from usdvol_lint.facts.files.states import AssetState, PathMark
from usdvol_lint.facts.found import column, summary
from usdvol_lint.facts.grids import Grids
from usdvol_lint.facts.prims import Prims
from usdvol_lint.facts.volumes import Volumes
from usdvol_lint.facts.volumes.states import BindingMark, Emptiness, TargetState
from usdvol_lint.nearest import did_you_mean
from usdvol_lint.schema import ATTRIBUTES, FIELD_ASSET, TYPE_BASES, VOLUME

if TYPE_CHECKING:
    from usdvol_lint.facts.grids.contents import Content, ContentClass

_ATTRIBUTES = frozenset(chain.from_iterable(ATTRIBUTES.values()))


class When(NamedTuple):
    """A precondition: the rule runs only on prims whose key `holds` accepts.

    `keys` is declared in a wing, such as `Files.path_marks`.
    `holds` is called once for each distinct key, with those of the rule's options that it has
    parameters for.
    It may accept too many keys, which costs time, but never too few, which loses findings: a rule
    has to be right without it.
    `about` is the type without which a prim has no such keys; "" if any prim has them.
    """

    keys: column[Any, Any] | summary[Any, Any]
    holds: Callable[..., bool]
    about: str = ""

    @property
    def options(self) -> tuple[str, ...]:
        """The names of the options that `holds` is given: its parameters but for the key."""
        code = getattr(self.holds, "__code__", None)
        return code.co_varnames[1 : code.co_argcount + code.co_kwonlyargcount] if code else ()


def authored(*names: str) -> When:
    """When one of these attributes is authored, or has values in clips.

    Raises ValueError for one that no schema of UsdVol, nor a base of one, declares.
    """
    unknown = [name for name in names if name not in _ATTRIBUTES]
    if unknown or not names:
        said = f"no attribute {unknown[0]!r}" if unknown else "no attribute"
        hint = did_you_mean(unknown[0], _ATTRIBUTES) if unknown else ""
        raise ValueError(f"authored: {said} of UsdVol{hint}")
    return When(Prims.authored, lambda authored: not authored.declared.keys().isdisjoint(names))


def layered() -> When:
    """When several specs make up a prim, or value clips apply to it."""
    return When(Prims.authored, lambda authored: authored.is_layered or authored.is_clipped)


def file_paths(*marks: AssetState | PathMark) -> When:
    """When the values of `filePath` have one of these states or marks."""
    _require("file_paths", marks, AssetState, PathMark)
    return When(Files.path_marks, lambda states: not states.isdisjoint(marks), FIELD_ASSET)


def bindings(*marks: BindingMark | TargetState | Emptiness) -> When:
    """When the `field:` namespace of a Volume has one of these states or marks."""
    _require("bindings", marks, BindingMark, TargetState, Emptiness)
    return When(Volumes.binding_marks, lambda states: not states.isdisjoint(marks), VOLUME)


def contents(*keys: Callable[[Content], Hashable | None]) -> When:
    """When one of these keys is not None for the content of one of a field's files."""
    if not keys or not all(map(callable, keys)):
        raise ValueError(f"contents: takes functions, not {keys!r}")
    return When(Grids.content_classes, AnyKey(keys), FIELD_ASSET)


def _require(precondition: str, marks: tuple[object, ...], *kinds: type[Enum]) -> None:
    """Raises ValueError for marks that no prim ever has, which would keep a rule from running."""
    if not marks or not all(isinstance(mark, kinds) for mark in marks):
        names = " or ".join(kind.__name__ for kind in kinds)
        raise ValueError(f"{precondition}: takes members of {names}, not {marks!r}")


class AnyKey:
    """Whether any of these keys is not None for any class of contents."""

    def __init__(self, keys: tuple[Callable[[Content], Hashable | None], ...]) -> None:
        self.keys = keys

    def __call__(self, classes: Iterable[ContentClass]) -> bool:
        return any(contents.answer(key) is not None for contents in classes for key in self.keys)


def check_precondition(code: str, when: When | None, on: tuple[str, ...]) -> None:
    """Raises ValueError for one that is none, or that no prim of these types ever meets."""
    if when is not None and not isinstance(when, When):
        raise ValueError(f"{code}: `when` takes a When, not {when!r}")
    if when and not isinstance(when.keys, column | summary):
        raise ValueError(f"{code}: `when` names no column or summary of a wing, but {when.keys!r}")
    if when and when.about and all(_is_other(name, when.about) for name in on):
        names = ", ".join(map(repr, on))
        raise ValueError(f"{code}: `when` is about a {when.about}, and `on` names none: {names}")


def _is_other(name: str, about: str) -> bool:
    """Whether no prim of one of our types is one of the other."""
    related = (name, *TYPE_BASES.get(name, ())), (about, *TYPE_BASES[about])
    return name in TYPE_BASES and about not in related[0] and name not in related[1]
