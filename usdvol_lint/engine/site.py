"""Finds the site of a problem: the layer with the opinion, its line, and the prim on the stage."""

from __future__ import annotations

from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.layertext.source import LayerTexts
from usdvol_lint.model import Site
from usdvol_lint.paths import display
from usdvol_lint.rule import NotChecked, Problem


class Located(NamedTuple):
    """A site, the spec to blame if there is one, and how many instances show it on the stage."""

    site: Site
    spec: Any | None
    instances: int


class Sites:
    """Finds the sites of problems; a text layer is read once, and only if a problem is in it."""

    def __init__(self) -> None:
        self._texts = LayerTexts()

    def locate(self, problem: Problem | NotChecked) -> Located:
        """The site of a problem, the spec to blame for it, and how many instances show it."""
        prim = problem.at.GetPrim()
        is_property = isinstance(problem.at, Usd.Property)
        spec, time = (problem.spec, None) if problem.spec else _blamed_spec(problem)
        layer = spec.layer if spec else prim.GetStage().GetRootLayer()
        path = spec.path if spec else "/"
        text = self._texts.of(layer)
        position = text.find(str(path), time=time, asset=problem.asset) if text else None
        on_stage = shown(prim)
        site = Site(
            layer=display(layer.realPath or layer.identifier),
            prim=None if prim.IsPseudoRoot() else on_stage.path,
            property=problem.at.GetName() if is_property else None,
            variant=_variants(spec.path) if spec else None,
            line=position.line if position else None,
            column=position.column if position else None,
            times=problem.times,
            at_default=problem.at_default,
        )
        return Located(site, spec, on_stage.instances)


def _blamed_spec(problem: Problem | NotChecked) -> tuple[Any | None, float | None]:
    """The spec whose opinion counts, and the first time of the problem in the time of its layer."""
    if not isinstance(problem.at, Usd.Property):
        return _blamed_prim_spec(problem.at), None
    if isinstance(problem.at, Usd.Attribute) and (problem.at_default or problem.times):
        time = None if problem.at_default else problem.times[0]
        if strongest := strongest_opinion(problem.at, time):
            spec, offset = strongest
            return spec, None if time is None else offset.GetInverse() * time
    specs = problem.at.GetPropertyStack()
    spec = next((spec for spec in specs if _has_value(spec)), specs[0] if specs else None)
    return spec or _blamed_prim_spec(problem.at.GetPrim()), None


def _blamed_prim_spec(prim: Any) -> Any | None:
    """The strongest spec that defines the prim with a type, or else its strongest one."""
    if prim.IsPseudoRoot():
        return prim.GetStage().GetRootLayer().pseudoRoot
    session = prim.GetStage().GetSessionLayer()
    stack = [spec for spec in prim.GetPrimStack() if spec.layer != session]
    return next((spec for spec in stack if spec.typeName), stack[0] if stack else None)


def _has_value(spec: Any) -> bool:
    return any(spec.HasInfo(key) for key in ("default", "timeSamples", "targetPaths", "spline"))


def _variants(path: Any) -> str | None:
    """`set=name` for each variant that the path of a spec goes through, outermost first."""
    chosen = [
        "=".join(prefix.GetVariantSelection())
        for prefix in path.GetPrefixes()
        if prefix.IsPrimVariantSelectionPath()
    ]
    return ", ".join(chosen) or None
