"""Laws of blame, tried on any stage: what a layer is not to blame for, and what moves no blame."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

from pxr import Sdf, Usd, Vt

from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.model import Finding, Severity, Source
from usdvol_lint.paths import canonical

Blamed: TypeAlias = tuple[str, Source]
Break: TypeAlias = Callable[[Any, Any], None]

_OF_STAGES = {"ARR027", "AST012", "AST017", "STG007"}
"""They are about the range that the root layer says, which a layer on top has to say again."""
_OF_RUNS = {"LNT001", "LNT004"}
_CARRIED_OVER = (
    *("startTimeCode", "endTimeCode", "timeCodesPerSecond", "framesPerSecond"),
    *("upAxis", "metersPerUnit", "expressionVariables", "defaultPrim"),
)
_SMALL = Vt.Vec3fArray([(0.4, 0.4, 0.4), (0.41, 0.41, 0.41)])


def broken_laws(engine: Engine, path: Path, number: int) -> Iterator[str]:
    """What laws a stage shows to be broken; one that is right is also broken from above."""
    if path.suffix != ".usdz":
        yield from blamed_though_clean(engine, path, engine.lint(str(path)).findings)
        if stage := _opened(path):
            yield from moved_by_types_on_top(engine, path, stage)
            yield from moved_by_saying_it_again(engine, path)
            yield from blamed_in_a_piece(engine, path, stage, Random(number))
            if number % 2 == 0:
                yield from blamed_for_a_break_above(engine, path, stage, Random(number))


def blamed_though_clean(engine: Engine, path: Path, findings: Iterable[Finding]) -> Iterator[str]:
    """Each layer below the root that is blamed for what it does not show when opened alone."""
    root = canonical(str(path))
    for code, source in sorted(_blamed(findings), key=str):
        layer = source.layer or ""
        if layer in ("", root) or layer.endswith("]") or _is_part(layer, source.path):
            continue
        if (code, source) not in _blamed(engine.lint(layer).findings, Severity.INFO):
            yield f"{code} is blamed on {source}, which is clean opened alone"


def blamed_in_a_piece(engine: Engine, path: Path, stage: Any, random: Random) -> Iterator[str]:
    """What is blamed on a clean layer once a shot references one prim of it."""
    paths = [prim.GetPath() for prim in stage.Traverse() if prim.GetTypeName() in _BREAKS]
    if not paths:
        return
    wanted = random.choice(random.choice(paths).GetPrefixes()[1:] or paths)
    shot = Sdf.Layer.CreateNew(str(path.with_name("with_a_piece.usda")))
    root = stage.GetRootLayer()
    for key in filter(root.pseudoRoot.HasInfo, _CARRIED_OVER):
        shot.pseudoRoot.SetInfo(key, root.pseudoRoot.GetInfo(key))
    shot.defaultPrim = "Shot"
    spec = Sdf.CreatePrimInLayer(shot, f"/Shot/{wanted.name}")
    for each in (spec.nameParent, spec):
        each.specifier = Sdf.SpecifierDef
    spec.nameParent.typeName = "Xform"
    reference = Sdf.Reference(f"./{Path(root.realPath).name}", wanted)
    spec.referenceList.prependedItems = [reference]
    shot.Save()
    yield from blamed_though_clean(engine, Path(shot.realPath), engine.lint(shot.realPath).findings)


def _is_part(layer: str, path: str | None) -> bool:
    """Whether nothing in a layer defines what a spec is about, which another one does."""
    stage = _opened(Path(layer))
    prim = stage and stage.GetPrimAtPath(Sdf.Path(path or "/").StripAllVariantSelections())
    return bool(prim) and not prim.IsPseudoRoot() and not prim.IsDefined()


def moved_by_types_on_top(engine: Engine, path: Path, stage: Any) -> Iterator[str]:
    """What is blamed on another spec once a layer on top repeats the types of what is blamed."""
    findings = engine.lint(str(path)).findings
    top = _layer_on_top(stage, path.with_name("on_top_repeated.usda"))
    for finding in findings:
        _repeat_types(stage, finding.site.prim, top)
    top.Save()
    before, after = _blamed(findings), _blamed(engine.lint(top.realPath).findings)
    for code, source in sorted(before - after, key=str):
        if code not in _OF_STAGES:
            yield f"{code} is no more blamed on {source} below types that say the same"


def moved_by_saying_it_again(engine: Engine, path: Path) -> Iterator[str]:
    """What is blamed on other specs of a layer once one on top says again all that it says."""
    findings = engine.lint(str(path)).findings
    for name in sorted({finding.source.layer or "" for finding in findings}):
        if not name or name.endswith(("]", ".usdz")):
            continue
        layer = Sdf.Layer.FindOrOpen(name)
        above = Path(name).with_name(f"on_top_of_{Path(name).stem}.usda")
        top = Sdf.Layer.CreateNew(str(above))
        top.TransferContent(layer)
        top.subLayerPaths = [f"./{Path(name).name}"]
        top.Save()
        before = _blamed(engine.lint(name).findings)
        after = _blamed(engine.lint(top.realPath).findings)
        for code, source in sorted(before - after, key=str):
            if code != "STG007":  # USD takes the range of the root layer and of no other
                yield f"{code} is no more blamed on {source} below a layer that says the same"


def blamed_for_a_break_above(
    engine: Engine, path: Path, stage: Any, random: Random
) -> Iterator[str]:
    """Each layer that is blamed for what only a layer on top of it breaks."""
    known = _blamed(engine.lint(str(path)).findings)
    ways = [(prim, way) for prim in stage.Traverse() for way in _BREAKS.get(prim.GetTypeName(), ())]
    if not ways:
        return
    prim, way = random.choice(ways)
    top = _layer_on_top(stage, path.with_name("on_top_broken.usda"))
    way(top, prim)
    top.Save()
    for code, source in sorted(_blamed(engine.lint(top.realPath).findings) - known, key=str):
        if source.layer != canonical(top.realPath):
            yield f"{code} is blamed on {source} for {way.__name__} in a layer above"


def _opened(path: Path) -> Any | None:
    """The stage; None where USD raises for a layer that it can't read."""
    try:
        return Usd.Stage.Open(str(path))
    except UNREADABLE:
        return None


def _blamed(findings: Iterable[Finding], least: Severity = Severity.WARNING) -> set[Blamed]:
    return {
        (finding.code, finding.source)
        for finding in findings
        if finding.severity >= least and finding.code not in _OF_RUNS
    }


def _layer_on_top(stage: Any, path: Path) -> Any:
    """A layer beside that of a stage, with this as sublayer, that says the same of the stage."""
    top = Sdf.Layer.CreateNew(str(path))
    root = stage.GetRootLayer()
    top.subLayerPaths = [f"./{Path(root.realPath).name}"]
    for key in filter(root.pseudoRoot.HasInfo, _CARRIED_OVER):
        top.pseudoRoot.SetInfo(key, root.pseudoRoot.GetInfo(key))
    return top


def _repeat_types(stage: Any, path: str | None, top: Any) -> None:
    """Authors a prim and those above it again, with their types; nothing inside of instances."""
    prim = stage.GetPrimAtPath(path or "/")
    if not prim or prim.IsPseudoRoot() or prim.IsInstanceProxy() or not prim.IsDefined():
        return
    for prefix in prim.GetPath().GetPrefixes():
        each = stage.GetPrimAtPath(prefix)
        if each.IsInstance():
            return
        spec = Sdf.CreatePrimInLayer(top, prefix)
        if each.GetTypeName() and not each.IsAbstract():
            spec.specifier, spec.typeName = Sdf.SpecifierDef, each.GetTypeName()


def _value(name: str, type_name: Any, value: Any) -> Break:
    def author(top: Any, prim: Any) -> None:
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        Sdf.AttributeSpec(spec, name, type_name).default = value

    author.__name__ = f"{name} = {value}"
    return author


def _first_target(prim: Any) -> tuple[Any, Any] | None:
    """The first field relationship of a Volume, and its target."""
    for each in prim.GetPropertiesInNamespace("field"):
        for target in each.GetTargets()[:1]:
            return each, target
    return None


def a_missing_target(top: Any, prim: Any) -> None:
    if found := _first_target(prim):
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        targets = Sdf.RelationshipSpec(spec, found[0].GetName()).targetPathList
        targets.explicitItems = [prim.GetPath().AppendChild("nowhere_at_all")]


def a_second_target(top: Any, prim: Any) -> None:
    if found := _first_target(prim):
        spec = Sdf.CreatePrimInLayer(top, prim.GetPath())
        targets = Sdf.RelationshipSpec(spec, found[0].GetName()).targetPathList
        targets.appendedItems = [prim.GetPath().AppendChild("other")]


def a_field_that_is_inactive(top: Any, prim: Any) -> None:
    found = _first_target(prim)
    if found and prim.GetStage().GetPrimAtPath(found[1]):
        Sdf.CreatePrimInLayer(top, found[1].GetPrimPath()).SetInfo("active", False)


def a_mesh_below(top: Any, prim: Any) -> None:
    spec = Sdf.CreatePrimInLayer(top, prim.GetPath().AppendChild("mesh"))
    spec.specifier, spec.typeName = Sdf.SpecifierDef, "Mesh"


def another_type(top: Any, prim: Any) -> None:
    Sdf.CreatePrimInLayer(top, prim.GetPath()).typeName = "Xform"


def no_apis(top: Any, prim: Any) -> None:
    taken = Sdf.TokenListOp.Create(deletedItems=list(prim.GetAppliedSchemas()))
    Sdf.CreatePrimInLayer(top, prim.GetPath()).SetInfo("apiSchemas", taken)


_TYPES = Sdf.ValueTypeNames
_OF_ALL = (
    _value("extent", _TYPES.Float3Array, _SMALL),
    _value("extent", _TYPES.Float3Array, Vt.Vec3fArray([(float("nan"), 0, 0), (1, 1, 1)])),
    another_type,
)
_OF_FIELDS = (
    _value("fieldName", _TYPES.Token, "nosuchgrid"),
    _value("fieldIndex", _TYPES.Int, 7),
    _value("fieldDataType", _TYPES.Token, "double3"),
    _value("fieldClass", _TYPES.Token, "levelSet"),
    _value("vectorDataRoleHint", _TYPES.Token, "Color"),
    _value("filePath", _TYPES.Asset, Sdf.AssetPath("./nosuch.vdb")),
    _value("filePath", _TYPES.Asset, Sdf.ValueBlock()),
    _value("fielName", _TYPES.Token, "density"),
    another_type,
)
_OF_PARTICLES = (
    *_OF_ALL,
    _value("positions", _TYPES.Point3fArray, Vt.Vec3fArray([(0, 0, 0)])),
    _value("opacities", _TYPES.FloatArray, Vt.FloatArray([5.0])),
    _value("scales", _TYPES.Float3Array, Vt.Vec3fArray([(-1, -1, -1)])),
    _value("radiance:sphericalHarmonicsDegree", _TYPES.Int, 7),
    no_apis,
)
_BREAKS: dict[str, tuple[Break, ...]] = {
    "Volume": (
        *_OF_ALL,
        *(a_missing_target, a_second_target, a_field_that_is_inactive, a_mesh_below),
    ),
    "OpenVDBAsset": _OF_FIELDS,
    "Field3DAsset": _OF_FIELDS,
    "ParticleField3DGaussianSplat": _OF_PARTICLES,
    "ParticleField": _OF_PARTICLES,
}
"""Ways to break a prim of each type with an opinion that is stronger than all it has."""
