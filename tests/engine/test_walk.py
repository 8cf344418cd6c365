"""The walk meets every live prim once, and what is drawn though an over hides it."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd
from walks import CLOUD, INSTANCE, LIVE, asks, instancer, write_stage

from usdvol_lint.engine.walk import asked_by, walk
from usdvol_lint.facts.usd.kinds import PrimKinds


def walked(
    folder: Path, text: str, load: object = Usd.Stage.LoadAll, **layers: str
) -> tuple[int, list[str]]:
    """How many prims there are, and which of them a rule for Volumes gets.

    Those in a prototype are named by where they are in it.
    """
    stage = Usd.Stage.Open(write_stage(folder, text, **layers), load)
    result = walk(stage, asked_by([asks("ONE001", "Volume")]), PrimKinds())
    kept = [prim for prims in result.kept.values() for prim in prims]
    return result.prims, sorted(map(_path, kept))


def _path(prim: Usd.Prim) -> str:
    return f"prototype{_below(prim)}" if prim.IsInPrototype() else str(prim.GetPath())


def _below(prim: Usd.Prim) -> str:
    prototype = prim
    while not prototype.IsPrototype():
        prototype = prototype.GetParent()
    return str(prim.GetPath())[len(str(prototype.GetPath())) :]


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
    result = walk(stage, asked_by([asks("ONE001", "Sphere", "Xform")]), PrimKinds())
    over = stage.GetPrimAtPath("/fx")
    assert result.undefined == {over: [over.GetChild("live"), over.GetPrimAtPath("c/live")]}
    assert [[prim.GetName() for prim in kept] for kept in result.kept.values()] == [["a"]]


@pytest.mark.parametrize(
    ("text", "untyped"),
    [
        ('def "a"\n{\nrel field:x = </x>\n}\n', ["/a"]),
        ('def Scope "a"\n{\nfloat3[] radiance:sphericalHarmonicsCoefficients\n}\n', ["/a"]),
        ('def Xform "a"\n{\nhalf3[] radiance:sphericalHarmonicsCoefficientsh\n}\n', ["/a"]),
        ('def Xform "a"\n{\nfloat3[] primvars:field:x\n}\n', []),
        ('def Cube "a"\n{\nrel field:x = </x>\n}\n', []),
        ('over "a"\n{\nrel field:x = </x>\n}\n', []),
        (
            'def "a" (\n    prepend apiSchemas = ["MaterialBindingAPI"]\n)\n'
            "{\nrel field:x = </x>\n}\n",
            ["/a"],
        ),
    ],
)
def test_prims_of_other_types_that_have_our_data(
    text: str, untyped: list[str], tmp_path: Path
) -> None:
    stage = Usd.Stage.Open(write_stage(tmp_path, LIVE + text))
    assert [
        str(prim.GetPath()) for prim in walk(stage, asked_by([]), PrimKinds()).untyped
    ] == untyped


def test_only_so_many_prims_of_other_types_are_looked_into(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("usdvol_lint.engine.walk._GROUPS", 300)
    groups = "".join(f'def Xform "a{n}"\n{{\nrel field:x = </x>\n}}\n' for n in range(1000))
    stage = Usd.Stage.Open(write_stage(tmp_path, groups))
    assert 300 <= len(walk(stage, asked_by([]), PrimKinds()).untyped) < 600


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
            f'over "library"\n{{\n{INSTANCE.format("a", "cloud")}{LIVE}}}\n'
            + instancer("i", "/library/live"),
            ["/library/live"],
        ),
        (
            f'class "library"\n{{\n{INSTANCE.format("a", "cloud")}}}\n'
            + instancer("i", "/library/a"),
            [],
        ),
        (f'class "library"\n{{\n{INSTANCE.format("a", "sky")}}}\n', []),
        (f'over "library"\n{{\n{INSTANCE.format("a", "sky")}}}\n', []),
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
    result = walk(stage, asked_by([]), PrimKinds())
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


_SET = """(
    clips = {
        dictionary default = {
            string primPath = "/clip"
        }
    }
)"""


def test_clips_on_and_above_what_is_kept(tmp_path: Path) -> None:
    text = f"""
def Xform "first"
{{
    def Mesh "between" {_SET}
    {{
    }}
    def Volume "plain"
    {{
    }}
    def Mesh "after" {_SET}
    {{
    }}
    def Xform "group" {_SET}
    {{
        def Xform "inner" {_SET}
        {{
            def Volume "own" {_SET}
            {{
                def Volume "below" {_SET}
                {{
                }}
            }}
        }}
    }}
}}
"""
    stage = Usd.Stage.Open(write_stage(tmp_path, text))
    clipped = walk(stage, asked_by([asks("ONE001", "Volume")]), PrimKinds()).clipped
    names = sorted(prim.GetName() for prim in clipped)
    assert names == ["below", "group", "inner", "own"]
