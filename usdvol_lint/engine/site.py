"""Finds the site of a problem: the layer with the opinion, its line, and the prim on the stage."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, NamedTuple

from pxr import Ar, Usd

from usdvol_lint.engine.diagnosis import TEXT_SIGNATURES
from usdvol_lint.facts.usd.instances import shown
from usdvol_lint.facts.usd.opinions import strongest_opinion
from usdvol_lint.model import Site
from usdvol_lint.paths import display
from usdvol_lint.rule import NotChecked, Problem

if TYPE_CHECKING:
    from usdvol_lint.engine.lines import TextLayer


class Located(NamedTuple):
    """A site, the spec to blame if there is one, and how many instances show it on the stage."""

    site: Site
    spec: Any | None
    instances: int


class Sites:
    """Finds the sites of problems; a text layer is read once, and only if a problem is in it."""

    def __init__(self) -> None:
        self._texts: dict[str, TextLayer | None] = {}

    def locate(self, problem: Problem | NotChecked) -> Located:
        """The site of a problem, the spec to blame for it, and how many instances show it."""
        prim = problem.at.GetPrim()
        is_property = isinstance(problem.at, Usd.Property)
        spec, time = (problem.spec, None) if problem.spec else _blamed_spec(problem)
        layer = spec.layer if spec else prim.GetStage().GetRootLayer()
        path = spec.path if spec else "/"
        text = self._text(layer)
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

    def _text(self, layer: Any) -> TextLayer | None:
        from usdvol_lint.engine.lines import (
            TextLayer,  # costs start-up time; clean stages need none
        )

        key = layer.identifier
        if key not in self._texts:
            data = _read(layer)
            self._texts[key] = TextLayer(data) if data.startswith(TEXT_SIGNATURES) else None
        return self._texts[key]


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


def _read(layer: Any) -> bytes:
    path = layer.realPath
    if not path or layer.anonymous:
        return b""
    if layer.GetFileFormat().IsPackage():
        path = _root_layer_of_package(path)
    if Ar.IsPackageRelativePath(path):
        asset = Ar.GetResolver().OpenAsset(Ar.ResolvedPath(path))
        return bytes(asset.GetBuffer()) if asset else b""
    try:
        with open(path, "rb") as file:
            head = file.read(8)
            return head + file.read() if head.startswith(TEXT_SIGNATURES) else b""
    except OSError:
        return b""


def _root_layer_of_package(path: str) -> str:
    """The path of the first file in a package, which is what USD opens."""
    from usdvol_lint.volumefile.package import Package  # costs start-up time; few are packages

    names = Package(path).names
    return str(Ar.JoinPackageRelativePath(path, names[0])) if names else path
