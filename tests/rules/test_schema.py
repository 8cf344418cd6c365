"""The tables of `schema` against the registry of the installed USD."""

from __future__ import annotations

import pytest
from pxr import Sdf, Usd

from usdvol_lint import schema, spelling
from usdvol_lint.facts.usd.kinds import is_concrete, is_registered, type_names

REGISTRY = Usd.SchemaRegistry()
KNOWS_PARTICLE_FIELDS = Usd.GetVersion() >= schema.PARTICLE_FIELD_SINCE
SINCE_26_3 = {
    "VolumeFieldBase",
    "VolumeFieldAsset",
    "ParticleField",
    "ParticleField3DGaussianSplat",
}
TYPES = [name for name in schema.TYPE_BASES if KNOWS_PARTICLE_FIELDS or name not in SINCE_26_3]
APIS = list(schema.API_INCLUDES) if KNOWS_PARTICLE_FIELDS else []
LIBRARY = "UsdVol"
ROOTS = {"Typed", "SchemaBase", ""}
"""What every type derives from, and what has no name as a schema."""

needs_particle_fields = pytest.mark.skipif(
    not KNOWS_PARTICLE_FIELDS, reason="this USD is too old to know particle fields"
)


def ancestors(type_name: str) -> tuple[str, ...]:
    """The bases of a registered type, nearest first, as the registry has them."""
    found = Usd.SchemaRegistry.GetTypeFromSchemaTypeName(type_name).GetAllAncestorTypes()
    names = [Usd.SchemaRegistry.GetSchemaTypeName(ancestor) for ancestor in found]
    return tuple(name for name in names[1:] if name not in ROOTS)


def declared(definition: Usd.PrimDefinition) -> set[str]:
    return set(definition.GetPropertyNames())


def test_version_decides_whether_particle_fields_are_registered() -> None:
    assert is_registered(schema.PARTICLE_FIELD) == KNOWS_PARTICLE_FIELDS


def test_every_type_of_the_library_is_in_the_table() -> None:
    base = Usd.SchemaRegistry.GetTypeFromSchemaTypeName("Imageable")
    of_library = {
        Usd.SchemaRegistry.GetSchemaTypeName(derived)
        for derived in base.GetAllDerivedTypes()
        if derived.typeName.startswith(LIBRARY)
    }
    assert of_library - {""} == set(TYPES)


@pytest.mark.parametrize("name", TYPES)
def test_type_agrees_with_the_registry(name: str) -> None:
    bases = schema.TYPE_BASES[name]
    if not KNOWS_PARTICLE_FIELDS:
        bases = tuple(base for base in bases if base not in SINCE_26_3)
    assert ancestors(name) == bases
    assert is_concrete(name) == (name in schema.CONCRETE_TYPES)
    if is_concrete(name):
        assert type_names(name) - ROOTS == {name, *schema.TYPE_BASES[name]}


@pytest.mark.parametrize("name", [*schema.TYPE_BASES, "UsdVolVolume", "Nonsense", "Gprim"])
def test_types_answer_alike_in_every_usd(name: str) -> None:
    if name in schema.CONCRETE_TYPES:
        expected = {name, *schema.TYPE_BASES[name]}
    elif name in schema.ABSTRACT_TYPES or name == "Gprim":
        expected = {schema.ABSTRACT_TYPE}
    else:
        expected = {schema.UNKNOWN_TYPE}
    assert type_names(name) - ROOTS == expected


@needs_particle_fields
def test_every_api_of_the_library_is_in_the_table() -> None:
    base = Usd.SchemaRegistry.GetTypeFromSchemaTypeName("APISchemaBase")
    of_library = {
        Usd.SchemaRegistry.GetSchemaTypeName(derived)
        for derived in base.GetAllDerivedTypes()
        if derived.typeName.startswith(LIBRARY)
    }
    assert of_library == set(APIS)


@needs_particle_fields
@pytest.mark.parametrize("api", schema.API_INCLUDES)
def test_api_agrees_with_the_registry(api: str) -> None:
    definition = REGISTRY.FindAppliedAPIPrimDefinition(api)
    assert tuple(definition.GetAppliedAPISchemas()) == (api, *schema.API_INCLUDES[api])
    assert declared(definition) == set(schema.API_ATTRIBUTES.get(api, ()))
    restricted = Usd.SchemaRegistry.GetAPISchemaCanOnlyApplyToTypeNames(api)
    expected = [schema.PARTICLE_FIELD] if api in schema.PARTICLE_FIELD_ONLY_APIS else []
    assert list(restricted) == expected


@needs_particle_fields
@pytest.mark.parametrize("name", sorted(schema.CONCRETE_TYPES))
def test_built_in_apis_agree_with_the_registry(name: str) -> None:
    definition = REGISTRY.FindConcretePrimDefinition(name)
    built_in = schema.expand_apis(schema.BUILT_IN_APIS.get(name, ()))
    assert tuple(definition.GetAppliedAPISchemas()) == built_in


def test_tables_agree_with_each_other() -> None:
    assert set(schema.BASE_APIS) == set(schema.API_PROVIDERS)
    assert set(schema.API_ATTRIBUTES) <= set(schema.API_INCLUDES)
    assert set(spelling.PRE_STANDARD_TYPES.values()) <= schema.CONCRETE_TYPES
    assert set(spelling.PRE_STANDARD_APIS.values()) <= set(schema.API_INCLUDES)
    assert not set(spelling.PRE_STANDARD_TYPES) & set(schema.TYPE_BASES)
    assert not set(spelling.PRE_STANDARD_APIS) & set(schema.API_INCLUDES)


@pytest.mark.parametrize("name", spelling.PRE_STANDARD_TYPES)
def test_no_old_type_name_is_registered(name: str) -> None:
    assert not is_registered(name)


@pytest.mark.parametrize("name", spelling.PRE_STANDARD_APIS)
def test_no_old_api_name_is_registered(name: str) -> None:
    assert not is_registered(name)


def registered_attributes(definition: Usd.PrimDefinition) -> dict[str, schema.Attribute]:
    """What the registry says of each attribute, in the words of the table."""
    found = {}
    for name in definition.GetPropertyNames():
        if definition.GetSpecType(name) == Sdf.SpecTypeAttribute:
            spec = definition.GetSchemaAttributeSpec(name)
            uniform = spec.variability == Sdf.VariabilityUniform
            tokens = tuple(spec.allowedTokens or ())
            found[name] = schema.Attribute(str(spec.typeName), uniform, tokens)
    return found


def assert_agrees(table: dict[str, schema.Attribute], found: dict[str, schema.Attribute]) -> None:
    """The same names, types and variability; every token that this USD allows is in the table."""
    of_geom = {name for kind in GEOM for name in schema.ATTRIBUTES[kind]}
    assert {name: attribute[:2] for name, attribute in table.items()} == {
        name: attribute[:2] for name, attribute in found.items()
    }
    for name in table.keys() - of_geom:
        assert set(found[name].tokens) <= set(table[name].tokens)
        if Usd.GetVersion() >= (0, 26, 5):
            assert found[name].tokens == table[name].tokens


GEOM = ("Imageable", "Xformable", "Boundable", "Gprim")


@pytest.mark.parametrize("name", sorted(name for name in schema.CONCRETE_TYPES if name in TYPES))
def test_attributes_of_a_type_agree_with_the_registry(name: str) -> None:
    definition = REGISTRY.FindConcretePrimDefinition(name)
    schemas = {name, *schema.TYPE_BASES[name], *schema.BUILT_IN_APIS.get(name, ())}
    assert_agrees(schema.attributes_of(schemas), registered_attributes(definition))


@needs_particle_fields
@pytest.mark.parametrize("api", schema.API_INCLUDES)
def test_attributes_of_an_api_agree_with_the_registry(api: str) -> None:
    definition = REGISTRY.FindAppliedAPIPrimDefinition(api)
    assert_agrees(schema.attributes_of((api,)), registered_attributes(definition))


def test_attribute_tables_agree_with_each_other() -> None:
    known = {*schema.TYPE_BASES, *schema.API_INCLUDES, *GEOM}
    assert set(schema.ATTRIBUTES) <= known
    order = list(schema.ATTRIBUTES)
    for name in schema.ATTRIBUTES.keys() & schema.TYPE_BASES.keys():
        bases = [base for base in schema.TYPE_BASES[name] if base in order]
        assert all(order.index(base) < order.index(name) for base in bases), "bases come first"
    attributes = schema.attributes_of(schema.ATTRIBUTES)
    assert set(spelling.GUESSED_ATTRIBUTES.values()) <= set(attributes)
    assert not set(spelling.GUESSED_ATTRIBUTES) & set(attributes)
    for name, guesses in spelling.GUESSED_TOKENS.items():
        allowed = {
            token
            for table in schema.ATTRIBUTES.values()
            if name in table
            for token in table[name].tokens
        }
        assert set(guesses.values()) <= allowed
        assert not set(guesses) & allowed
    vdb = set(schema.ATTRIBUTES["OpenVDBAsset"]["fieldDataType"].tokens)
    assert vdb > schema.SCALAR_DATA_TYPES


@pytest.mark.parametrize(
    ("one", "other", "alike"),
    [
        ("string", "asset", True),
        ("float", "int", True),
        ("color3f[]", "float3[]", True),
        ("float", "float[]", False),
        ("string", "int", False),
        ("token[]", "asset", False),
    ],
)
def test_types_that_may_hold_the_same(one: str, other: str, alike: bool) -> None:
    assert spelling.is_alike(one, other) is alike
