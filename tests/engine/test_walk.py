"""The walk meets every live prim once, and hands each to the rules that asked for it."""

from __future__ import annotations

import shutil
from collections import Counter
from pathlib import Path

import pytest
from process import ROOT
from pxr import Usd

from usdvol_lint.engine.assign import assign
from usdvol_lint.engine.engine import Engine
from usdvol_lint.engine.walk import walk
from usdvol_lint.facts import Context, Facts, Walked
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.model import Severity
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.rule import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE, Rule


def asks(code: str, *on: str) -> Rule:
    return Rule(code, code.lower(), on, Severity.INFO, "1", lambda prim, facts: iter(()), {})


def write_stage(folder: Path, text: str, **layers: str) -> str:
    for name, layer in layers.items():
        (folder / f"{name}.usda").write_text(f"#usda 1.0\n{layer}", encoding="utf-8")
    path = folder / "stage.usda"
    path.write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    return str(path)


def assigned(stage: Usd.Stage, found: Walked, rules: list[Rule]) -> list[tuple[Rule, Usd.Prim]]:
    """Each rule with each prim that it is handed; no precondition fails."""
    facts = Facts(Context.of(stage), found)
    failed: list[object] = []
    pairs = list(assign(found, rules, facts, {}, lambda *failure: failed.append(failure)))
    assert failed == []
    return pairs


def walked(
    folder: Path, text: str, load: object = Usd.Stage.LoadAll, **layers: str
) -> tuple[int, list[str]]:
    """How many prims there are, and which of them a rule for Volumes gets.

    Those in a prototype are named by where they are in it.
    """
    stage = Usd.Stage.Open(write_stage(folder, text, **layers), load)
    result = walk(stage, [asks("ONE001", "Volume")], PrimKinds())
    kept = [prim for prims in result.kept.values() for prim in prims]
    return result.prims, sorted(map(_path, kept))


def _path(prim: Usd.Prim) -> str:
    return f"prototype{_below(prim)}" if prim.IsInPrototype() else str(prim.GetPath())


def _below(prim: Usd.Prim) -> str:
    prototype = prim
    while not prototype.IsPrototype():
        prototype = prototype.GetParent()
    return str(prim.GetPath())[len(str(prototype.GetPath())) :]


LIVE = 'def Volume "live"\n{\n}\n'


@pytest.mark.parametrize(
    ("text", "prims", "kept"),
    [
        ("", 0, []),
        (LIVE, 1, ["/live"]),
        (f'def Xform "a"\n{{\n{LIVE}}}\n', 2, ["/a/live"]),
        (f'def "untyped"\n{{\n{LIVE}}}\n', 2, ["/untyped/live"]),
        (f'class "library"\n{{\n{LIVE}}}\n', 0, []),
        (f'class Volume "library"\n{{\n}}\n{LIVE}', 1, ["/live"]),
        (f'over "nowhere"\n{{\n{LIVE}}}\n', 2, []),
        (f'def Xform "off" (\n    active = false\n)\n{{\n{LIVE}}}\n', 0, []),
        (
            f'def Xform "a"\n{{\n{LIVE}def Volume "off" (active = false)\n{{\n}}\n}}\n',
            2,
            ["/a/live"],
        ),
        ('def Volume "a"\n{\n    def Volume "b"\n    {\n    }\n}\n', 2, ["/a", "/a/b"]),
    ],
)
def test_live_prims(text: str, prims: int, kept: list[str], tmp_path: Path) -> None:
    assert walked(tmp_path, text) == (prims, kept)


def instancer(name: str, *prototypes: str, below: str = "") -> str:
    targets = ", ".join(f"<{path}>" for path in prototypes)
    return f'def PointInstancer "{name}"\n{{\nrel prototypes = [{targets}]\n{below}}}\n'


@pytest.mark.parametrize(
    ("prototypes", "library", "kept"),
    [
        (("/library/live",), f'over "library"\n{{\n{LIVE}}}\n', ["/library/live"]),
        (("/library/live.size",), f'over "library"\n{{\n{LIVE}}}\n', ["/library/live"]),
        (
            ("/library.chosen",),
            f'over "library"\n{{\nrel chosen = </library/live>\n{LIVE}}}\n',
            ["/library/live"],
        ),
        (("/library/gone",), f'over "library"\n{{\n{LIVE}}}\n', []),
        (("/library",), f'over "library"\n{{\n{LIVE}}}\n', []),
        (("/library",), f'class "library"\n{{\n{LIVE}}}\n', []),
        (("/library/live",), f'class "library"\n{{\n{LIVE}}}\n', []),
        (("/library",), f'def "library"\n{{\n{LIVE}}}\n', ["/library/live"]),
        (
            ("/library/a", "/library/a/live"),
            f'over "library"\n{{\ndef "a"\n{{\n{LIVE}over "b"\n{{\n{LIVE}}}\n}}\n{LIVE}}}\n',
            ["/library/a/live"],
        ),
        (
            ("/library/more",),
            'over "library"\n{\n' + instancer("more", "/other/live") + "}\n"
            f'over "other"\n{{\n{LIVE}}}\n',
            ["/other/live"],
        ),
    ],
)
def test_what_a_point_instancer_draws_below_an_over(
    prototypes: tuple[str, ...], library: str, kept: list[str], tmp_path: Path
) -> None:
    assert walked(tmp_path, instancer("i", *prototypes) + library)[1] == kept


def test_a_point_instancer_that_is_not_drawn_draws_nothing(tmp_path: Path) -> None:
    library = f'over "library"\n{{\n{instancer("i", "/library/live")}{LIVE}}}\n'
    assert walked(tmp_path, library) == (3, [])


def test_a_point_instancer_that_is_an_instance(tmp_path: Path) -> None:
    below = f'over "library"\n{{\n{LIVE}}}\n'
    lib = instancer("cloud", "/cloud/library/live", below=below)
    text = INSTANCE.format("a", "cloud") + INSTANCE.format("b", "cloud")
    assert walked(tmp_path, text, lib=lib)[1] == ["prototype/library/live"]


def test_what_an_over_takes_off_the_stage(tmp_path: Path) -> None:
    text = f'over "fx"\n{{\n{LIVE}over Volume "b"\n{{\n}}\ndef "c"\n{{\n{LIVE}}}\n}}\n'
    drawn = 'over "lib"\n{\ndef Volume "a"\n{\n}\n}\n' + instancer("i", "/lib/a")
    spheres = 'over "spheres"\n{\ndef Sphere "a"\n{\n}\n}\n'
    stage = Usd.Stage.Open(write_stage(tmp_path, text + drawn + spheres))
    result = walk(stage, [asks("ONE001", "Sphere", "Xform")], PrimKinds())
    over = stage.GetPrimAtPath("/fx")
    assert result.undefined == {over: [over.GetChild("live"), over.GetPrimAtPath("c/live")]}
    assert [[prim.GetName() for prim in kept] for kept in result.kept.values()] == [["a"]]


CLOUD = 'def Xform "cloud"\n{\n    def Volume "thick"\n    {\n    }\n}\n'
INSTANCE = 'def "{}" (\n    instanceable = true\n    references = @./lib.usda@</{}>\n)\n{{\n}}\n'


def test_instances_are_walked_once(tmp_path: Path) -> None:
    text = "".join(INSTANCE.format(f"i{n}", "cloud") for n in range(50))
    assert walked(tmp_path, text, lib=CLOUD) == (52, ["prototype/thick"])


def test_instances_inside_instances_are_walked_once(tmp_path: Path) -> None:
    sky = 'def Xform "sky"\n{\n' + INSTANCE.format("left", "cloud") + "}\n"
    text = "".join(INSTANCE.format(f"i{n}", "sky") for n in range(5))
    assert walked(tmp_path, text, lib=CLOUD + sky) == (9, ["prototype/thick"])


@pytest.mark.parametrize(
    ("text", "kept"),
    [
        (f'over "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n', []),
        (f'class "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n', []),
        (
            f'over "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n'
            + INSTANCE.format("b", "cloud"),
            ["prototype/thick"],
        ),
        (
            f'over "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n'
            + instancer("i", "/library/a"),
            ["prototype/thick"],
        ),
        (
            f'over "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n'
            + instancer("i", "/library/a/thick"),
            ["prototype/thick"],
        ),
        (
            f'class "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n'
            + instancer("i", "/library/a"),
            [],
        ),
        (INSTANCE.format("a", "below_over"), []),
        (INSTANCE.format("a", "below_class"), []),
        (INSTANCE.format("a", "below_over") + INSTANCE.format("b", "cloud"), ["prototype/thick"]),
        (
            f'over "library"\n{{\n{INSTANCE.format("a", "sky")}}}\n'
            + instancer("i", "/library/a/left"),
            ["prototype/thick"],
        ),
        (
            f'over "library"\n{{\n{INSTANCE.format("a", "flock")}}}\n'
            + instancer("i", "/library/a"),
            ["prototype/library/live"],
        ),
    ],
)
def test_what_is_in_instances_is_drawn_with_one_of_them(
    text: str, kept: list[str], tmp_path: Path
) -> None:
    left = INSTANCE.format("left", "cloud")
    lib = (
        f'{CLOUD}def "sky"\n{{\n{left}}}\n'
        f'def "below_over"\n{{\nover "library"\n{{\n{left}}}\n}}\n'
        f'def "below_class"\n{{\nclass "library"\n{{\n{left}}}\n}}\n'
        f'def "flock"\n{{\n{instancer("swarm", "/flock/library/live")}'
        f'over "library"\n{{\n{LIVE}}}\n}}\n'
    )
    assert walked(tmp_path, text, lib=lib)[1] == kept


def test_what_an_over_takes_off_the_stage_in_instances(tmp_path: Path) -> None:
    sky = f'def "sky"\n{{\n{INSTANCE.format("left", "cloud")}}}\n'
    instances = "".join(INSTANCE.format(name, "sky") for name in "ab")
    text = f'over "one"\n{{\n{instances}}}\nover "two"\n{{\n{INSTANCE.format("c", "sky")}}}\n'
    text += f'class "library"\n{{\n{INSTANCE.format("d", "sky")}}}\n'
    stage = Usd.Stage.Open(write_stage(tmp_path, text, lib=CLOUD + sky))
    result = walk(stage, [], PrimKinds())
    found = {
        over.GetName(): [_path(prim) for prim in prims] for over, prims in result.undefined.items()
    }
    assert found == {"one": ["prototype/thick"], "two": ["prototype/thick"]}


def test_payloads(tmp_path: Path) -> None:
    text = f'def "far" (\n    payload = @./lib.usda@</cloud>\n)\n{{\n}}\n{LIVE}'
    assert walked(tmp_path, text, lib=CLOUD) == (3, ["/far/thick", "/live"])
    assert walked(tmp_path, text, Usd.Stage.LoadNone, lib=CLOUD) == (1, ["/live"])


def test_more_prims_than_are_read_at_a_time(tmp_path: Path) -> None:
    names = [f"v{n}" for n in range(1000)]
    text = "".join(f'def Volume "{name}"\n{{\n}}\n' for name in names)
    assert walked(tmp_path, text) == (1000, sorted(f"/{name}" for name in names))


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
    found = walk(stage, rules, PrimKinds())
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
    pairs = assigned(stage, walk(stage, rules, PrimKinds()), rules)
    assert [rule.code for rule, _ in pairs if rule.when] == []


def test_what_no_rule_asked_for_is_counted_and_let_go(tmp_path: Path) -> None:
    stage = Usd.Stage.Open(write_stage(tmp_path, 'def Sphere "ball"\n{\n}\n' + LIVE))
    result = walk(stage, [], PrimKinds())
    assert result.prims == 2
    assert [str(prim.GetPath()) for prims in result.kept.values() for prim in prims] == ["/live"]


def test_an_instanced_finding_says_where_and_how_often(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from usdvol_lint.packs.activation import ActiveRules
    from usdvol_lint.rule import Problem

    monkeypatch.chdir(tmp_path)
    seen = Rule(
        *("SEE001", "seen", ("Volume",), Severity.INFO, "1"),
        lambda prim, facts: iter([Problem("seen", at=prim)]),
        {},
    )
    text = "".join(INSTANCE.format(name, "cloud") for name in ("b", "a", "c"))
    write_stage(tmp_path, text, lib=CLOUD)
    engine = Engine({"SEE001": seen}, ActiveRules({"SEE001": Severity.INFO}, {}))
    (finding,) = engine.lint("stage.usda").findings
    assert finding.message == "seen (shown by 3 instances)"
    assert (finding.site.prim, finding.site.layer, finding.site.line) == ("/a/thick", "lib.usda", 4)
