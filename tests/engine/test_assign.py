"""Each prim is handed to the rules that asked for it, and to no other."""

from __future__ import annotations

import gc
import shutil
import weakref
from collections import Counter
from pathlib import Path

import pytest
from process import ROOT
from pxr import Sdf, Usd
from walks import CLOUD, INSTANCE, LIVE, asks, instancer, write_stage

from usdvol_lint.engine.assign import Assignment
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts import Context, Facts, Walked
from usdvol_lint.facts.found import Wing, summary
from usdvol_lint.facts.grids.contents import ContentClass
from usdvol_lint.facts.prims.tables import Table
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.model import Severity
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE, Rule, When


def assigned(stage: Usd.Stage, found: Walked, rules: list[Rule]) -> list[tuple[Rule, Usd.Prim]]:
    """Each rule with each prim that it is handed; no precondition fails."""
    facts = Facts(Context.of(stage), found)
    failed: list[object] = []
    pairs = Assignment(rules, {}).pairs(found, facts, lambda *failure: failed.append(failure))
    handed = [each for each in pairs if each]
    assert failed == []
    return handed


def test_rules_get_what_they_asked_for(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(
        write_stage(
            tmp_path,
            """
def Volume "volume" (
    prepend apiSchemas = ["CollectionAPI:lights", "MaterialBindingAPI"]
)
{
}
def OpenVDBAsset "vdb"
{
}
def Field3DAsset "f3d"
{
}
def FieldAsset "abstract"
{
}
def Nonsense "unknown"
{
}
def "untyped"
{
}
def Sphere "ball"
{
}
""",
        )
    )
    asked = [
        ("Volume", "volume"),
        ("Gprim", "ball volume"),
        ("Xformable", "ball f3d vdb volume"),
        ("FieldAsset", "f3d vdb"),
        ("FieldBase", "f3d vdb"),
        ("VolumeFieldBase", "f3d vdb"),
        ("OpenVDBAsset", "vdb"),
        ("MaterialBindingAPI", "volume"),
        (UNKNOWN_TYPE, "unknown"),
        (ABSTRACT_TYPE, "abstract"),
        (STAGE, ""),
        ("Camera", ""),
    ]
    rules = [asks(name, name) for name, _ in asked]
    rules.append(asks("TWO001", "Volume", "Gprim", "MaterialBindingAPI"))
    found = walk(stage, asked_by(rules), PrimKinds())
    pairs = Counter((rule.code, prim.GetName()) for rule, prim in assigned(stage, found, rules))
    assert pairs == Counter(
        (code, name)
        for code, names in [*asked, ("TWO001", "ball volume")]
        for name in names.split()
    )


def test_a_prim_that_nothing_is_remarkable_about_is_handed_to_no_rule_with_a_condition(
    tmp_path: Path, catalog: Catalog
) -> None:
    shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", tmp_path)
    field = """
    def OpenVDBAsset "density"
    {
        asset filePath = @./cloud.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
    }
"""
    cloud = """
def Volume "cloud"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </cloud/density>
"""
    stage = Usd.Stage.Open(write_stage(tmp_path, f"{cloud}{field}}}\n"))
    rules = list(catalog.rules.values())
    pairs = assigned(stage, walk(stage, asked_by(rules), PrimKinds()), rules)
    assert [rule.code for rule, _ in pairs if rule.when] == []


def test_what_no_rule_asked_for_is_counted_and_let_go(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(write_stage(tmp_path, 'def Sphere "ball"\n{\n}\n' + LIVE))
    result = walk(stage, asked_by([]), PrimKinds())
    assert result.prims == 2
    assert [str(prim.GetPath()) for prims in result.kept.values() for prim in prims] == ["/live"]


def below(specifier: str, name: str, *instances: str) -> str:
    texts = "".join(INSTANCE.format(each, "cloud") for each in instances)
    return f'{specifier} "{name}"\n{{\n{texts}}}\n'


@pytest.mark.parametrize(
    ("text", "message", "prim"),
    [
        (below("def", "set", "b", "a", "c"), "seen (shown by 3 instances)", "/set/a/thick"),
        (
            below("over", "library", "b", "c")
            + below("class", "again", "d")
            + below("def", "set", "a"),
            "seen",
            "/set/a/thick",
        ),
        (
            below("over", "library", "b", "a")
            + below("class", "again", "d")
            + instancer("i", "/library/a", "/library/b"),
            "seen (shown by 2 instances)",
            "/library/a/thick",
        ),
    ],
)
def test_an_instanced_finding_says_where_and_how_often(
    text: str, message: str, prim: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from usdvol_lint.packs.activation import ActiveRules
    from usdvol_lint.rule import Problem

    monkeypatch.chdir(tmp_path)
    seen = Rule(
        *("SEE001", "seen", ("Volume",), Severity.INFO, "1"),
        lambda prim, facts: iter([Problem("seen", at=prim)]),
        {},
    )
    write_stage(tmp_path, text, lib=CLOUD)
    engine = Engine({"SEE001": seen}, ActiveRules({"SEE001": Severity.INFO}, {}))
    (finding,) = engine.lint("stage.usda").findings
    assert finding.message == message
    assert (finding.site.prim, finding.site.layer, finding.site.line) == (prim, "lib.usda", 4)


def test_stages_whose_files_hold_the_same_share_a_key(engine: Engine, tmp_path: Path) -> None:
    """And no stage is kept with it."""
    field = 'def OpenVDBAsset "cloud"\n{\n    asset filePath = @./cloud.vdb@\n}\n'

    def lint(name: str) -> int:
        stage = tmp_path / name / "cloud.usda"
        stage.parent.mkdir()
        shutil.copy(ROOT / "rules" / "assets" / "cloud.vdb", stage.parent)
        stage.write_text(f"#usda 1.0\n{field}", encoding="utf-8")
        engine.lint(str(stage))
        assert Sdf.Layer.Find(str(stage)) is None
        gc.collect()
        return sum(isinstance(each, ContentClass) for each in gc.get_objects())

    assert lint("a") == lint("b")


class Key:
    """A key of somebody's own, which may hold anything of its stage."""


def test_no_key_of_a_stage_is_kept_in_memory(tmp_path: Path) -> None:
    kept: list[weakref.ref[Key]] = []

    class Keys(Wing):
        @summary
        def own(self, table: Table) -> list[Key]:
            keys = [Key() for _ in table.prims]
            kept.extend(map(weakref.ref, keys))
            return keys

    stage = Usd.Stage.Open(write_stage(tmp_path, 'def Volume "a" {}'))
    rules = [asks("ONE001", "Volume")._replace(when=When(Keys.own, lambda key: True))]
    found = walk(stage, asked_by(rules), PrimKinds())
    facts = Facts(Context.of(stage), found)
    facts.keys = Keys(facts.tables)  # type: ignore[attr-defined]
    assignment = Assignment(rules, {})
    assert len([*filter(None, assignment.pairs(found, facts, lambda *failure: None))]) == 1
    assert [reference() for reference in kept] == [None]
