"""What the pages of rules/particle say of USD, asked of USD."""

from __future__ import annotations

import pytest
from answers import Said, layer, stage, with_particles
from pxr import Usd, UsdShade, UsdVol

pytestmark = with_particles


def schemas(text: str) -> list[str]:
    return list(stage(text).GetPrimAtPath("/splats").GetAppliedSchemas())


def applied(*names: str) -> str:
    listed = ", ".join(f'"{name}"' for name in names)
    return f'def ParticleField "splats" (prepend apiSchemas = [{listed}])\n{{\n}}\n'


def test_PRT001_nothing_is_enforced() -> None:
    with Said() as said:
        asked = stage('def ParticleField "splats"\n{\n}\n').GetPrimAtPath("/splats")
        assert asked.IsA(UsdVol.ParticleField)
        assert asked.GetAppliedSchemas() == []
    assert said == []


def test_PRT001_the_api_brings_its_base() -> None:
    name = "ParticleFieldPositionAttributeAPI"
    assert schemas(applied(name)) == [name, "ParticleFieldPositionBaseAPI"]


def test_PRT002_the_splat_type_has_a_kernel() -> None:
    found = schemas('def ParticleField3DGaussianSplat "splats"\n{\n}\n')
    assert {"ParticleFieldKernelGaussianEllipsoidAPI", "ParticleFieldKernelBaseAPI"} <= set(found)


def test_PRT004_base_apis_have_no_attributes() -> None:
    for name in ("Position", "Kernel", "Radiance"):
        base = f"ParticleField{name}BaseAPI"
        asked = Usd.SchemaRegistry().FindAppliedAPIPrimDefinition(base)
        assert asked.GetPropertyNames() == []
        assert stage(applied(base)).GetPrimAtPath("/splats").HasAPI(getattr(UsdVol, base))


def test_PRT005_built_in_apis_stay() -> None:
    text = applied("ParticleFieldKernelConstantSurfletAPI")
    found = schemas(text.replace("ParticleField ", "ParticleField3DGaussianSplat "))
    assert "ParticleFieldKernelGaussianEllipsoidAPI" in found
    assert "ParticleFieldKernelConstantSurfletAPI" in found


def test_PRT006_unknown_names_are_dropped_without_a_word() -> None:
    with Said() as said:
        assert schemas(applied("ParticleFieldPositionAPI")) == []
    assert said == []


def test_PRT006_any_text_can_be_added() -> None:
    asked = stage('def ParticleField "splats"\n{\n}\n').GetPrimAtPath("/splats")
    assert asked.AddAppliedSchema("NoSuchAPI")


@pytest.mark.parametrize("how", ["", "add", "append", "prepend", "delete"])
def test_PRT009_a_list_with_a_name_twice_is_dropped_without_a_word(how: str) -> None:
    text = applied("MaterialBindingAPI", "ParticleFieldPositionAttributeAPI", "MaterialBindingAPI")
    with Said() as said:
        read = layer(text.replace("prepend", how))
    assert not read.GetPrimAtPath("/splats").HasInfo("apiSchemas")
    assert said == []


@pytest.mark.parametrize(
    ("edit", "is_kept"),
    [
        ('apiSchemas = ["MaterialBindingAPI"]', False),
        ('delete apiSchemas = ["ParticleFieldPositionAttributeAPI"]', False),
        ('prepend apiSchemas = ["MaterialBindingAPI"]', True),
    ],
)
def test_PRT010_a_stronger_list_takes_an_api_away_without_a_word(edit: str, is_kept: bool) -> None:
    api = "ParticleFieldPositionAttributeAPI"
    text = f'def "s" (\n    references = @weak@</splats>\n    {edit}\n)\n{{\n}}\n'
    with Said() as said:
        found = stage(text, weak=applied(api)).GetPrimAtPath("/s")
        assert found.GetTypeName() == "ParticleField"
        assert (api in found.GetAppliedSchemas()) is is_kept
    assert said == []


def test_PRT010_no_list_takes_away_what_a_type_has_built_in() -> None:
    api = "ParticleFieldPositionAttributeAPI"
    text = 'def ParticleField3DGaussianSplat "s" (delete apiSchemas = ["%s"])\n{\n}\n'
    assert api in stage(text % api).GetPrimAtPath("/s").GetAppliedSchemas()


def test_PRT009_python_adds_no_name_twice() -> None:
    asked = stage('def ParticleField "splats"\n{\n}\n').GetPrimAtPath("/splats")
    for _ in range(2):
        asked.ApplyAPI(UsdVol.ParticleFieldPositionAttributeAPI)
        asked.AddAppliedSchema("NoSuchAPI")
    listed = asked.GetMetadata("apiSchemas").GetAddedOrExplicitItems()
    assert {"ParticleFieldPositionAttributeAPI", "NoSuchAPI"} <= {*listed}
    assert len({*listed}) == len(listed)


def test_PRT007_without_its_api_an_attribute_is_a_custom_one() -> None:
    text = 'def ParticleField "splats"\n{\n    point3f[] positions = [(0, 0, 0)]\n}\n'
    bare = stage(text).GetPrimAtPath("/splats")
    assert "positions" not in bare.GetPrimDefinition().GetPropertyNames()
    assert not bare.HasAPI(UsdVol.ParticleFieldPositionAttributeAPI)


def test_PRT008_the_splat_type_has_six_apis_and_hints() -> None:
    asked = stage('def ParticleField3DGaussianSplat "splats"\n{\n}\n').GetPrimAtPath("/splats")
    found = [name for name in asked.GetAppliedSchemas() if "Base" not in name]
    parts = ("Position", "Orientation", "Scale", "Opacity", "SphericalHarmonics")
    attributes = [f"ParticleField{part}AttributeAPI" for part in parts]
    assert sorted(found) == sorted([*attributes, "ParticleFieldKernelGaussianEllipsoidAPI"])
    by_parts = stage(applied(*found)).GetPrimAtPath("/splats")
    assert not by_parts.IsA(UsdVol.ParticleField3DGaussianSplat)
    assert asked.HasAttribute("sortingModeHint")
    assert not by_parts.HasAttribute("sortingModeHint")


def test_PRT003_a_binding_counts_without_its_api() -> None:
    text = 'def ParticleField "splats"\n{\n    rel material:binding = </look>\n}\n'
    splats = stage(text + 'def Material "look"\n{\n}\n').GetPrimAtPath("/splats")
    assert not splats.HasAPI(UsdShade.MaterialBindingAPI)
    bound, _ = UsdShade.MaterialBindingAPI(splats).ComputeBoundMaterial()
    assert bound.GetPath() == "/look"
