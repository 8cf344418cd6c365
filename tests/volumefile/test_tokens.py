"""What is in a file, said in UsdVol's words."""

from __future__ import annotations

import pytest

from usdvol_lint.volumefile import tokens, vdb


@pytest.mark.parametrize(
    ("value_type", "half", "fitting"),
    [
        ("half", False, ("half",)),
        ("float", False, ("float",)),
        ("float", True, ("float", "half")),
        ("double", True, ("double", "half")),
        ("int32", True, ("int",)),
        ("uint32", False, ("uint",)),
        ("int64", False, ("int64",)),
        ("vec2s", True, ("float2", "half2")),
        ("vec2d", False, ("double2",)),
        ("vec2i", False, ("int2",)),
        ("vec3s", False, ("float3",)),
        ("vec3s", True, ("float3", "half3")),
        ("vec3d", True, ("double3", "half3")),
        ("vec3i", True, ("int3",)),
        ("vec3h", False, ("half3",)),
        ("mat3d", False, ("matrix3d",)),
        ("mat4d", False, ("matrix4d",)),
        ("quatd", False, ("quatd",)),
        ("bool", False, ("bool",)),
        ("mask", False, ("mask",)),
        ("string", False, ("string",)),
        *(
            (name, True, ())
            for name in (
                *("ptdataidx32", "ptidx32", "int8", "uint8", "int16", "uint16", "vec3u8"),
                *("vec3u16", "vec4s", "vec4d", "mat3s", "mat4s", "quats", "unknown", ""),
            )
        ),
    ],
)
def test_data_types(value_type: str, half: bool, fitting: tuple[str, ...]) -> None:
    assert tokens.data_types(value_type, half) == fitting


@pytest.mark.parametrize(
    ("grid_class", "token"),
    [
        ("level set", "levelSet"),
        ("fog volume", "fogVolume"),
        ("staggered", "staggered"),
        ("unknown", "unknown"),
        ("other", "unknown"),
    ],
)
def test_field_classes(grid_class: str, token: str) -> None:
    assert tokens.field_class(grid_class) == token


@pytest.mark.parametrize(
    ("vector_type", "fitting", "strength"),
    [
        ("invariant", {"None", "Color"}, "weak"),
        ("covariant", {"Normal", "Vector"}, "weak"),
        ("covariant normalize", {"Normal"}, "strong"),
        ("contravariant relative", {"Vector"}, "strong"),
        ("contravariant absolute", {"Point"}, "strong"),
    ],
)
def test_role_hints(vector_type: str, fitting: set[str], strength: str) -> None:
    hints = tokens.role_hints(vector_type)
    assert (set(hints.fitting), hints.strength) == (fitting, strength)


def test_every_token_is_one_of_the_schema() -> None:
    from pxr import Usd

    registry = Usd.SchemaRegistry()

    def allowed(schema: str, name: str) -> set[str]:
        definition = registry.FindConcretePrimDefinition(schema)
        return set(definition.GetSchemaAttributeSpec(name).allowedTokens)

    data_types = {*tokens.DATA_TYPES.values(), *tokens.HALF_TYPES.values()}
    assert data_types == allowed("OpenVDBAsset", "fieldDataType")
    assert data_types > allowed("Field3DAsset", "fieldDataType")
    assert {*tokens.FIELD_CLASSES.values(), "unknown"} == allowed("OpenVDBAsset", "fieldClass")
    hints = {word for hint in tokens.ROLE_HINTS.values() for word in hint.fitting}
    assert hints == allowed("OpenVDBAsset", "vectorDataRoleHint")


def test_vector_types_have_hints() -> None:
    assert set(tokens.ROLE_HINTS) == {"invariant", *vdb.VECTOR_TYPES}
    assert set(tokens.FIELD_CLASSES) == set(vdb.CLASSES)
