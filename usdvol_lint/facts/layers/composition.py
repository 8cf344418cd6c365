"""What USD could not compose, and which prims of the stage may lack opinions or values."""

from __future__ import annotations

import re
from collections import defaultdict
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Sdf, Usd

from usdvol_lint.cached import cached_property
from usdvol_lint.facts.files.paths import is_uri
from usdvol_lint.facts.usd.instances import in_prototype

if TYPE_CHECKING:
    from usdvol_lint.facts.layers.unresolved import EmptyArc

ARCS = ("sublayer", "reference", "payload")
"""The composition arcs that name a layer, in the words of USD's errors."""
_SCHEMA = re.compile(r"\w+/schema\.usda")
_FILE_SCHEME = re.compile(r"file:(//)?", re.IGNORECASE)


class MissingLayer(NamedTuple):
    """A layer that USD can't open, named by an arc or a clip set.

    `arc`, `asset`, `path` and `spec` are as in `LayerArc`.
    `reason`: what is wrong with a file that exists, or "".
    `extension`: that of a file that is there and that no plugin here reads, or "".
    `prims`: those of the stage that are composed without it, at least one.
    """

    arc: str
    asset: str
    path: str
    spec: Any
    reason: str
    extension: str
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]

    @property
    def is_uri(self) -> bool:
        """Whether the authored path is a URI."""
        return is_uri(self.asset)

    @property
    def file_scheme(self) -> str:
        """What makes the path the URI of a file, which USD's own resolver does not know; or ""."""
        scheme = _FILE_SCHEME.match(self.asset) if self.is_uri else None
        return scheme[0] if scheme else ""

    @property
    def is_schema(self) -> bool:
        """Whether it is the schema of a library, which `usdGenSchema` finds on a search path."""
        return not self.reason and _SCHEMA.fullmatch(self.asset) is not None


class CompositionError(NamedTuple):
    """Any other error.

    `message`: USD's text in one line.
    `spec`: the one to blame, if the text names it.
    `prims`: those of the stage where it occurs, at least one.
    """

    message: str
    spec: Any | None
    prims: tuple[Any, ...]

    @property
    def prim(self) -> Any:
        """The first of the prims."""
        return self.prims[0]


class Composition:
    """What a stage could not compose, without duplicates and in the same order in every run.

    `unloaded`: the prims with payloads that were not loaded.
    """

    def __init__(
        self,
        missing_layers: tuple[MissingLayer, ...],
        empty_arcs: tuple[EmptyArc, ...],
        errors: tuple[CompositionError, ...],
        unloaded: tuple[Any, ...],
    ) -> None:
        self.missing_layers = missing_layers
        self.empty_arcs = empty_arcs
        self.errors = errors
        self.unloaded = unloaded

    @property
    def is_whole(self) -> bool:
        """Whether every arc could be followed and every payload was loaded."""
        return not self.unloaded and not self._lack_opinions

    def may_lack(self, prim: Any) -> bool:
        """Whether an arc that brings nothing may have opinions on a prim or those below it."""
        return _is_at_or_below(prim, self._lack_opinions)

    def may_lack_values(self, prim: Any) -> bool:
        """As `may_lack`, and value clips count too, which supply only attribute values."""
        return _is_at_or_below(prim, self._lack_opinions | self._lack_clips)

    @property
    def of_unread_formats(self) -> tuple[tuple[MissingLayer, ...], ...]:
        """The layers that are there, and in files that no plugin here reads; by their formats."""
        formats: dict[str, list[MissingLayer]] = defaultdict(list)
        for missing in self.missing_layers:
            formats[missing.extension].append(missing)
        return tuple(tuple(layers) for extension, layers in formats.items() if extension)

    @cached_property
    def _lack_opinions(self) -> frozenset[Any]:
        missing = [missing for missing in self.missing_layers if missing.arc in ARCS]
        return _as_walked([*missing, *self.empty_arcs])

    @cached_property
    def _lack_clips(self) -> frozenset[Any]:
        return _as_walked(missing for missing in self.missing_layers if missing.arc not in ARCS)


def unloaded_prims(stage: Any) -> tuple[Any, ...]:
    """The prims with payloads that were not loaded."""
    if stage.GetLoadRules() == Usd.StageLoadRules.LoadAll():
        return ()  # FindLoadable would traverse the whole stage
    loadable = map(stage.GetPrimAtPath, sorted(stage.FindLoadable()))
    return tuple(prim for prim in loadable if prim and not prim.IsLoaded())


def _as_walked(lacking: Iterable[MissingLayer | EmptyArc]) -> frozenset[Any]:
    """The paths of the prims as the walk visits them: those in instances are in prototypes."""
    prims = [prim for each in lacking for prim in each.prims]
    prims += [prim.GetPrototype() for prim in prims if prim.IsInstance()]
    return frozenset(in_prototype(prim).GetPath() for prim in prims)


def _is_at_or_below(prim: Any, paths: frozenset[Any]) -> bool:
    if not paths:
        return False  # nearly always
    path = in_prototype(prim).GetPath()
    return not paths.isdisjoint([Sdf.Path.absoluteRootPath, *path.GetPrefixes()])
