"""Finds the place of a problem: what is to blame, its layer and line, and the prim on the stage."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple, TypeVar

from pxr import Usd

from usdvol_lint.engine.blame import Blame, Blaming, on_other
from usdvol_lint.engine.entries import Entries
from usdvol_lint.engine.layer_names import leads_elsewhere, link_to, real_name, shown_name
from usdvol_lint.facts.usd.bringing import path_of_prim
from usdvol_lint.facts.usd.calls import get_name, get_path, get_prim, get_stage
from usdvol_lint.facts.usd.instances import Shown, shown
from usdvol_lint.layertext.source import LayerTexts, SharedTexts
from usdvol_lint.model import Cover, Severity, Site, Source
from usdvol_lint.rule import NotChecked, Problem, Rule

if TYPE_CHECKING:
    from usdvol_lint.engine.pieces import Pieces
    from usdvol_lint.layertext.lines import Position, TextLayer


_Found = TypeVar("_Found")

PLACE = "the layer and line of findings"
_DIGITS = 6
"""Decimals of a time that a retime was taken off, which leaves a rounding error."""


class Located(NamedTuple):
    """A site and its prim, what is to blame and its layer, and how many instances show it.

    `path` is that of the first that shows the prim on the stage.
    """

    prim: Any
    path: str
    site: Site
    source: Source
    blame: Blame
    layer: Any
    instances: int


class _Layer(NamedTuple):
    """What is found once of a layer with a problem: its names, and its text if it has one."""

    shown: str
    real: str
    link: str | None
    text: TextLayer | None

    def position(
        self, path: str, time: float | None, asset: str | None, prim: str
    ) -> Position | None:
        """The position of a spec in the text; found once where others than its own prim show it."""
        if self.text is None:
            return None
        if path.startswith(prim):
            return self.text.find(path, time=time, asset=asset)
        return self.text.find_once(path, time, asset)


class Sites:
    """Finds the sites of problems; a text layer is read once, and only if a problem is in it.

    `stage` is the path of the stage as its user named it.
    `texts` are those that other stages have read too.
    With a `repository`, sites in layers outside it say where the stage's own file brings these in.
    With `pieces`, what only a piece of a layer lacks is blamed on the arc to it.
    """

    def __init__(
        self,
        repository: str | None = None,
        stage: str = "",
        texts: SharedTexts | None = None,
        pieces: Pieces | None = None,
    ) -> None:
        self._pieces = pieces
        self._stage = stage
        self._texts = LayerTexts(texts)
        self._entries = Entries(repository, self._texts) if repository else None
        self._layers: dict[Any, _Layer] = {}
        self._blaming = Blaming()
        self.faults: list[tuple[Any, str, Exception]] = []
        """What was raised where something was looked for: the prim of the problem, and what."""

    def recomposed(self) -> None:
        """Says that the stage was composed in another way."""
        self._blaming.recomposed()
        if self._pieces:
            self._pieces.recomposed()

    def locate(self, problem: Problem | NotChecked, rule: Rule | None = None) -> Located:
        """The site of a problem, what is to blame for it, and how many instances show it.

        Where looking for it fails, that is its prim: what was found stands all the same.
        """
        return self.locate_all([(problem, rule)])[0]

    def locate_all(
        self, problems: Sequence[tuple[Problem | NotChecked, Rule | None]]
    ) -> list[Located]:
        """The same of many problems, one step of all after the other."""
        tried = self.tried
        prims = [get_prim(problem.at) for problem, _ in problems]
        blamed = [
            tried(prim, PLACE, self._blame_shown, prim, problem, rule)
            for prim, (problem, rule) in zip(prims, problems, strict=True)
        ]
        return [
            (by and tried(prim, PLACE, self._find, prim, problem, *by))
            or self._at_prim(prim, problem)
            for prim, (problem, _), by in zip(prims, problems, blamed, strict=True)
        ]

    def tried(
        self, prim: Any, what: str, find: Callable[..., _Found], *arguments: Any
    ) -> _Found | None:
        """What is found for a problem at a prim; None where that fails."""
        try:
            return find(*arguments)
        except Exception as error:  # whatever it is: the engine reports it
            self.faults.append((prim, what, error))
            return None

    def _at_prim(self, prim: Any, problem: Problem | NotChecked) -> Located:
        """The prim of a problem, in the stage's own layer."""
        at = problem.at
        path = str(get_path(prim))
        name = at.GetName() if isinstance(at, Usd.Property) else None
        root = at.GetStage().GetRootLayer()
        site = Site(
            layer=shown_name(root, self._stage),
            prim=None if path == "/" else path,
            property=name,
            times=problem.times,
            at_default=problem.at_default,
        )
        source = Source(real_name(root), path, name, problem.subject)
        return Located(prim, path, site, source, Blame(None), root, 1)

    def _blame_shown(
        self, prim: Any, problem: Problem | NotChecked, rule: Rule | None
    ) -> tuple[Shown, Blame]:
        """How the prim of a problem of a rule is shown, and what is to blame for it."""
        where = shown(prim)
        blame = self._blaming.blame(problem)
        if rule is None or self._pieces is None or not isinstance(problem, Problem):
            return where, blame
        if blame.beside and not blame.clean:
            already = self._pieces.already.blame(rule, problem, blame)
            if already:
                return where, already
        if self._pieces.are_switched(prim):
            return where, blame
        other = blame.spec and self._pieces.instead(rule, problem, blame.spec, where.path)
        return where, on_other(other, problem, blame.spec) if other else blame

    def _find(
        self, prim: Any, problem: Problem | NotChecked, where: Shown, blame: Blame
    ) -> Located:
        at = problem.at
        on_stage, instances = where
        spec = blame.spec or None
        blamed = get_stage(prim).GetRootLayer() if spec is None else spec.layer
        layer = self._layer(blamed)
        path = "/" if spec is None else str(spec.path)
        asset = blame.clip or blame.asset or problem.asset
        position = layer.position(path, blame.time, asset, on_stage)
        site = Site(
            layer.shown,
            None if on_stage == "/" else on_stage,
            get_name(at) if isinstance(at, Usd.Property) else None,
            _variants(spec.path) if spec is not None and "{" in path else None,
            position.line if position else None,
            position.column if position else None,
            problem.times,
            problem.at_default,
            position.excerpt if position else None,
            self._entries.of(prim, spec, layer.real) if self._entries and spec else None,
        )
        if problem.machine is not None:
            source = Source(None, subject=problem.machine)
        else:
            prim_path = None if spec is None else _path_of_prim(spec, path)
            is_link = layer.link and leads_elsewhere(layer.link, asset)
            name = layer.link if is_link else layer.real
            source = Source(name, prim_path, blame.property, blame.subject)
        return Located(prim, on_stage, site, source, blame, blamed, instances)

    def _layer(self, layer: Any) -> _Layer:
        found = self._layers.get(layer)
        if found is None:
            text = self._texts.of(layer)
            names = shown_name(layer, self._stage), real_name(layer), link_to(layer)
            found = self._layers[layer] = _Layer(*names, text)
        return found


def _path_of_prim(spec: Any, path: str) -> str:
    """The path of a spec's prim; USD need not be asked for it where there is no variant."""
    return str(path_of_prim(spec)) if "{" in path else path.partition(".")[0]


def cover_of(problem: Problem | NotChecked, blame: Blame, level: Severity) -> Cover:
    """How much a problem covers, in the time of the layer to blame."""
    found = problem.cover
    share, sizes = getattr(found, "share", None), getattr(found, "sizes", None)
    elements = round(sum(sizes) / len(sizes)) if sizes else None
    if not problem.times or _are_all(problem):
        return Cover(level, None, problem.at_default, share, elements)
    frames = problem.times
    if blame.offset and not blame.offset.IsIdentity():
        inverse = blame.offset.GetInverse()
        frames = tuple(sorted(round(inverse * time, _DIGITS) for time in frames))
    return Cover(level, frames, problem.at_default, share, elements)


def _are_all(problem: Problem | NotChecked) -> bool:
    """Whether the problem is at all time samples there are."""
    total = getattr(problem.cover, "total", None)
    if total is None:
        is_attribute = isinstance(problem.at, Usd.Attribute)
        total = problem.at.GetNumTimeSamples() if is_attribute else 0
    return 0 < total <= len(problem.times)


def _variants(path: Any) -> str | None:
    """`set=name` for each variant that the path of a spec goes through, outermost first."""
    chosen = [
        "=".join(prefix.GetVariantSelection())
        for prefix in path.GetPrefixes()
        if prefix.IsPrimVariantSelectionPath()
    ]
    return ", ".join(chosen) or None
