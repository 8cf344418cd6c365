"""Laws of blame, tried on any stage: what a layer is not to blame for, and what moves no blame."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from pathlib import Path
from random import Random
from typing import Any, TypeAlias

from pxr import Sdf, Usd

from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.model import Finding, Severity, Source
from usdvol_lint.paths import canonical

from .breaking import BREAKS, Break

Blamed: TypeAlias = tuple[str, Source]

_OF_STAGES = {"ARR027", "AST012", "AST017", "STG007"}
"""They are about the range that the root layer says, which a layer on top has to say again."""
_OF_RUNS = {"LNT001", "LNT004"}
_CARRIED_OVER = (
    *("startTimeCode", "endTimeCode", "timeCodesPerSecond", "framesPerSecond"),
    *("upAxis", "metersPerUnit", "expressionVariables", "defaultPrim"),
)


def broken_laws(engine: Engine, path: Path, number: int) -> Iterator[str]:
    """What laws a stage shows to be broken; one that is right is also broken from above."""
    if path.suffix != ".usdz":
        yield from blamed_though_clean(engine, path, engine.lint(str(path)).findings)
        if stage := _opened(path):
            yield from moved_by_types_on_top(engine, path, stage)
            yield from moved_by_saying_it_again(engine, path)
            yield from moved_by_notes(engine, path, stage, Random(number))
            yield from blamed_in_a_piece(engine, path, stage, Random(number))
            if number % 2 == 0:
                yield from blamed_for_a_break_above(engine, path, stage, Random(number))
                yield from blamed_for_a_break_by_reference(engine, path, stage, Random(number))


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
    paths = [prim.GetPath() for prim in stage.Traverse() if prim.GetTypeName() in BREAKS]
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


def moved_by_notes(engine: Engine, path: Path, stage: Any, random: Random) -> Iterator[str]:
    """What is blamed on another spec once a layer, on top or below, has a note on some prims."""
    before = _blamed(engine.lint(str(path)).findings)
    noted = Sdf.Layer.CreateNew(str(path.with_name("with_notes.usda")))
    for prim in stage.Traverse():
        if not prim.IsInPrototype() and random.random() < 0.5:
            spec = Sdf.CreatePrimInLayer(noted, prim.GetPath())
            Sdf.AttributeSpec(spec, "note", Sdf.ValueTypeNames.String).custom = True
    if not noted.rootPrims:
        return  # a stage without prims is that of its weakest layer
    noted.Save()
    top = _layer_on_top(stage, path.with_name("on_top_of_notes.usda"))
    own = list(top.subLayerPaths)
    for where, paths in (
        ("on top", ["./with_notes.usda", *own]),
        ("below", [*own, "./with_notes.usda"]),
    ):
        top.subLayerPaths = paths
        top.Save()
        after = _blamed(engine.lint(top.realPath).findings)
        for code, source in sorted(before ^ after, key=str):
            if code not in _OF_STAGES:
                how = "no more" if (code, source) in before else "only"
                yield f"{code} is {how} blamed on {source} with notes {where}"


def blamed_for_a_break_by_reference(
    engine: Engine, path: Path, stage: Any, random: Random
) -> Iterator[str]:
    """Each layer that is blamed for what only the shot that references the stage breaks."""
    broken = _broken(stage, path.with_name("broken_again.usda"), random)
    roots = [each for each in stage.GetPseudoRoot().GetChildren() if each.IsDefined()]
    if not broken or not roots:
        return
    way, top = broken
    for shown, name in ((True, "referenced.usda"), (False, "referenced_and_broken.usda")):
        shot = Sdf.Layer.CreateNew(str(path.with_name(name)))
        for key in filter(top.pseudoRoot.HasInfo, _CARRIED_OVER):
            shot.pseudoRoot.SetInfo(key, top.pseudoRoot.GetInfo(key))
        for root in roots:
            below = Sdf.CreatePrimInLayer(shot, root.GetPath())
            if not shown and top.GetPrimAtPath(root.GetPath()):
                Sdf.CopySpec(top, root.GetPath(), shot, root.GetPath())
            below.specifier = Sdf.SpecifierDef
            reference = Sdf.Reference(f"./{path.name}", root.GetPath())
            below.referenceList.prependedItems = [reference]
        shot.Save()
        blamed = _blamed(engine.lint(shot.realPath).findings)
        if shown:
            known = blamed
            continue
        for code, source in sorted(blamed - known, key=str):
            if source.layer != canonical(shot.realPath):
                yield f"{code} is blamed on {source} for {way.__name__} in a shot of it"


def _broken(stage: Any, path: Path, random: Random) -> tuple[Break, Any] | None:
    """A layer on top of a stage that breaks a prim in some way."""
    ways = [(prim, way) for prim in stage.Traverse() for way in BREAKS.get(prim.GetTypeName(), ())]
    if not ways:
        return None
    prim, way = random.choice(ways)
    top = _layer_on_top(stage, path)
    way(top, prim)
    return way, top


def blamed_for_a_break_above(
    engine: Engine, path: Path, stage: Any, random: Random
) -> Iterator[str]:
    """Each layer that is blamed for what only a layer on top of it breaks."""
    known = _blamed(engine.lint(str(path)).findings)
    broken = _broken(stage, path.with_name("on_top_broken.usda"), random)
    if not broken:
        return
    way, top = broken
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
