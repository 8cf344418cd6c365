"""A piece of a layer that needs what stands above it there: the arc to the piece is to blame."""

from __future__ import annotations

from pathlib import Path

import pytest
from identities import LAYER, META, STAGE, Find, refers
from process import write

TOP = """#usda 1.0
(
    defaultPrim = "set"
    startTimeCode = 1
    endTimeCode = 48
%s
)
def Xform "set" (
    kind = "component"
    prepend apiSchemas = ["MaterialBindingAPI", "GeomModelAPI"]
%s
)
{
    float3[] extentsHint = [(0, 0, 0), (1, 1, 1)]
    rel material:binding = </set/look>
    def Material "look"
    {
    }
%s
}
"""
ASSET = """
    def Volume "smoke"
    {
        rel field:density = </set/smoke/density>
        def OpenVDBAsset "density"
        {
            asset filePath = @./cloud.vdb@
            token fieldName = "density"
            token fieldDataType = "float"
        }
    }
    def ParticleField3DGaussianSplat "splats"
    {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        point3f[] positions = [(0.5, 0.5, 0.5)]
        float3[] scales = [(0.01, 0.01, 0.01)]
        quatf[] orientations = [(1, 0, 0, 0)]
        float[] opacities = [0.5]
    }
    def ParticleField "bare" (
        prepend apiSchemas = [
            "ParticleFieldPositionAttributeAPI", "ParticleFieldKernelGaussianEllipsoidAPI",
            "ParticleFieldRadianceBaseAPI"
        ]
    )
    {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        point3f[] positions = [(0.5, 0.5, 0.5)]
    }
"""
HIDDEN = """
    token visibility = "invisible"
    def Volume "smoke"
    {
        float3[] extent = [(0, 0, 0), (1, 1, 1)]
        rel field:density = </set/smoke/density>
        def OpenVDBAsset "density"
        {
            asset filePath.timeSamples = { %s }
            token fieldName = "density"
            token fieldDataType = "float"
        }
    }
"""
HOLE = HIDDEN % "1: @./cloud.vdb@, 2: @@, 3: @./cloud.vdb@"
TURNED = """
    float3 xformOp:scale = (0.01, 0.01, 0.01)
    uniform token[] xformOpOrder = ["xformOp:scale"]
    def "smoke" (
        references = @./centimetres.usda@</set/smoke>
    )
    {
    }
"""
CLASSED = """
    def "smoke" (
        inherits = </set/_class_smoke>
    )
    {
    }
    class "_class_smoke"
    {
        def Volume "inner"
        {
        }
    }
"""
INSTANCED = CLASSED.replace("inherits", "instanceable = true\ninherits")


PARKED = f"""
def ParticleField3DGaussianSplat "tank"
{{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(1e8, 1e8, 1e8){", (0.5, 0.5, 0.5)" * 49}]
    quatf[] orientations = [{", ".join(["(1, 0, 0, 0)"] * 50)}]
    float3[] scales = [(0.01, 0.01, 0.01){", (0.01, 0.02, 0.01)" * 49}]
    float[] opacities = [0{"".join(f", 0.{n:02}" for n in range(50, 99))}]
    uniform int radiance:sphericalHarmonicsDegree = 0
    float3[] radiance:sphericalHarmonicsCoefficients = [{", ".join(["(1, 1, 1)"] * 50)}]
}}
"""
SEEN = f"float[] opacities = [{', '.join(['1'] * 50)}]"
ALONE = f"float[] opacities = [1{', 0' * 49}]"


def shot(*paths: str, meta: str = "") -> str:
    range_ = "startTimeCode = 1\nendTimeCode = 48\n)"
    return STAGE.replace(")", range_) + "".join(
        f'def "piece_{number}" (\n{meta}\nreferences = @../assets/set.usda@<{path}>\n)\n{{\n}}\n'
        for number, path in enumerate(paths)
    )


@pytest.mark.parametrize(
    ("asset", "path", "code"),
    [
        (ASSET, "/set/smoke", "SCH007"),
        (ASSET, "/set/smoke/density", "VOL012"),
        (ASSET, "/set/splats", "ARR017"),
        (ASSET, "/set/bare", "PRT004"),
        (HOLE, "/set/smoke", "AST018"),
        (
            HIDDEN % "1: @./box_growing.0001.vdb@, 2: @./box_growing.0002.vdb@",
            "/set/smoke",
            "AST012",
        ),
        (TURNED, "/set/smoke", "STG009"),
        (CLASSED, "/set/smoke", "SCH007"),
        (INSTANCED, "/set/smoke", "SCH007"),
    ],
)
@pytest.mark.parametrize("meta", ["", "instanceable = true"])
def test_a_piece_is_blamed_on_its_arc(
    asset: str, path: str, code: str, meta: str, find: Find, shots: Path
) -> None:
    centimetres = META.replace("metersPerUnit = 1", "metersPerUnit = 0.01")
    write(
        shots.parent / "assets",
        set=TOP % (META, "", asset),
        centimetres=TOP % (centimetres, "", ASSET),
    )
    write(shots, one=shot(path, meta=meta), two=shot("/set", meta=meta))
    assert not find("assets/set.usda", "shots/two.usda", rules=(code,))
    [cause] = find("shots/one.usda", rules=(code,))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/piece_0")
    assert cause.first.message.endswith(" ('set.usda' by itself has no such problem)")


def test_two_pieces_are_two_causes(find: Find, shots: Path) -> None:
    write(shots.parent / "assets", set=TOP % (META, "", ASSET))
    write(shots, one=shot("/set/smoke", "/set/smoke", "/set/splats"))
    causes = find("shots/one.usda", rules=("SCH007", "ARR017"))
    assert [(cause.code, cause.source.path) for cause in causes] == [
        ("SCH007", "/piece_0"),
        ("SCH007", "/piece_1"),
        ("ARR017", "/piece_2"),
    ]


@pytest.mark.parametrize("asset", [ASSET, CLASSED, INSTANCED])
def test_what_is_wrong_in_the_layer_itself_stays_its_own(
    asset: str, find: Find, shots: Path
) -> None:
    unmeasured = (TOP % (META, "", asset)).replace("float3[] extentsHint", "float3[] hint")
    write(shots.parent / "assets", set=unmeasured)
    write(shots, one=shot("/set/smoke"))
    [alone] = find("assets/set.usda", rules=("SCH007",))
    [shown] = find("shots/one.usda", rules=("SCH007",))
    assert shown.fingerprint == alone.fingerprint
    assert shown.source.layer == "assets/set.usda"
    assert "by itself" not in shown.first.message


def test_a_piece_in_an_asset_is_blamed_on_the_asset_and_not_on_the_shot(
    find: Find, shots: Path
) -> None:
    piece = 'def "piece" (\nreferences = @./library.usda@</set/smoke>\n)\n{\n}\n'
    asset = (TOP % (META, "", piece)).replace("float3[] extentsHint", "float3[] hint")
    write(shots.parent / "assets", library=TOP % (META, "", ASSET), set=asset)
    write(shots, one=shot("/set"), two=shot("/set/piece"))
    assert not find("assets/library.usda", rules=("SCH007",))
    for stages in (("assets/set.usda",), ("shots/one.usda", "shots/two.usda")):
        [cause] = find(*stages, rules=("SCH007",))
        assert (cause.source.layer, cause.source.path) == ("assets/set.usda", "/set/piece")


def test_a_rule_that_fails_on_the_layer_alone_moves_no_blame(
    find: Find, shots: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from usdvol_lint.engine.alone import Alone

    def fails(*arguments: object) -> None:
        raise RuntimeError("a rule of a pack")

    monkeypatch.setattr(Alone, "_run", fails)
    write(shots.parent / "assets", set=TOP % (META, "", ASSET))
    write(shots, one=shot("/set/smoke"))
    [cause] = find("shots/one.usda", rules=("SCH007",))
    assert cause.source.layer == "assets/set.usda"


@pytest.mark.parametrize(
    ("edit", "code", "path", "name"),
    [
        (SEEN, "ARR013", "/a", "opacities"),
        (ALONE, "ARR020", "/a", "opacities"),
        (f"{SEEN}\nfloat width = 1", "ARR013", "/a", "opacities"),
        (f'{SEEN}\ntoken visibility = "inherited"', "ARR013", "/a", "extent"),
    ],
)
def test_an_edit_beside_what_a_rule_looks_at_is_to_blame(
    edit: str, code: str, path: str, name: str | None, find: Find, shots: Path
) -> None:
    """The rules tell that they look at positions, and not at which of them are seen."""
    write(shots.parent / "assets", tank=LAYER + PARKED)
    write(shots, one=STAGE + refers("a", inside=edit), two=STAGE + refers("a"))
    assert not find("assets/tank.usda", "shots/two.usda", rules=(code,))
    [cause] = find("shots/one.usda", rules=(code,))
    found = cause.source
    assert (found.layer, found.path, found.property) == ("shots/one.usda", path, name)


BESIDE = """#usda 1.0
(
    defaultPrim = "splats"
%s
)
def Material "look"
{
}
def ParticleField3DGaussianSplat "splats" (
    prepend apiSchemas = ["MaterialBindingAPI"]
)
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    point3f[] positions = [(0.5, 0.5, 0.5)]
    float3[] scales = [(0.01, 0.01, 0.01)]
    quatf[] orientations = [(1, 0, 0, 0)]
    float[] opacities = [0.5]
    rel material:binding = </look>
}
"""


@pytest.mark.parametrize("meta", ["", "instanceable = true", 'kind = "subcomponent"'])
def test_what_lies_beside_a_prim_is_left_behind_by_its_arc(
    meta: str, find: Find, shots: Path
) -> None:
    write(shots.parent / "assets", tank=BESIDE % META)
    write(shots, one=STAGE + refers("a", meta=meta))
    assert not find("assets/tank.usda", rules=("ARR017",))
    [cause] = find("shots/one.usda", rules=("ARR017",))
    assert (cause.source.layer, cause.source.path) == ("shots/one.usda", "/a")


def test_a_component_below_no_model_is_blamed_on_its_arc(find: Find, shots: Path) -> None:
    """USD looks for the hints of models where all prims above have a kind."""
    write(shots.parent / "assets", tank=TOP % (META, "", ASSET))
    arc = refers("a").replace("@../assets/tank.usda@", "@../assets/tank.usda@")
    write(shots, one=STAGE + arc, two=f'{STAGE}def Xform "world"\n{{\n{arc}}}\n')
    assert not find("assets/tank.usda", "shots/one.usda", rules=("SCH007",))
    [cause] = find("shots/two.usda", rules=("SCH007",))
    assert (cause.source.layer, cause.source.path) == ("shots/two.usda", "/world/a")


def test_who_takes_away_a_material_above_is_to_blame(find: Find, shots: Path) -> None:
    write(shots.parent / "assets", tank=TOP % (META, "", ASSET))
    write(shots, one=STAGE + refers("a", inside="rel material:binding = None"))
    [cause] = find("shots/one.usda", rules=("ARR017",))
    found = cause.source
    assert (found.layer, found.path, found.property) == (
        "shots/one.usda",
        "/a",
        "material:binding",
    )


def test_pieces_below_an_over_are_checked(find: Find, shots: Path) -> None:
    over = f'over "library"\n{{\ndef "inner"\n{{\n{ASSET}\n}}\n}}\n'
    write(
        shots.parent / "assets", set=TOP % (META, "", over.replace("/set/", "/set/library/inner/"))
    )
    write(shots, one=shot("/set/library", "/set/library/inner/smoke"))
    codes = {cause.code for cause in find("shots/one.usda", rules=("ALL",))}
    assert "SCH007" in codes
    assert "LNT002" not in codes
