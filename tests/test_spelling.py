"""Which names of types, APIs, attributes and tokens are misspelt, and which are none of ours."""

from __future__ import annotations

import pytest

from usdvol_lint import schema, spelling


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("OpenVdbAsset", "OpenVDBAsset"),
        ("OpenVDB_Asset", "OpenVDBAsset"),
        ("UsdVolOpenVDBAsset", "OpenVDBAsset"),
        ("Volumes", "Volume"),
        ("Feild3DAsset", "Field3DAsset"),
        ("ParticleFields", "ParticleField"),
        ("ParticleFieldGaussianSplat", "ParticleField3DGaussianSplat"),
        ("ParticleField_3DGaussianSplat", "ParticleField3DGaussianSplat"),
        ("GaussianSplats", "ParticleField3DGaussianSplat"),
    ],
)
def test_misspelt_type(name: str, meant: str) -> None:
    assert spelling.misspelt_type(name) == meant


@pytest.mark.parametrize(
    ("name", "is_slip"),
    [
        ("OpenVdbAsset", True),
        ("openVDBasset", True),
        ("Volumes", True),
        ("Volum", True),
        ("Volmue", False),
        ("Volumess", False),
        ("OpenVBDAsset", True),
        ("OpnVDBAset", True),
        ("OpnVDBAst", False),
        ("ParticleFieldGaussianSplat", False),
        ("UsdVolVolume", False),
    ],
)
def test_few_letters_are_a_slip(name: str, is_slip: bool) -> None:
    meant = spelling.misspelt_type(name) or "Volume"
    assert spelling.is_slip(name, meant) is is_slip


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("OpenVDBAsset2", "OpenVDBAsset"),
        ("OpenVDBAsset_v3", "OpenVDBAsset"),
        ("VolumeV10", "Volume"),
        ("ParticleField3DGaussianSplatV2", "ParticleField3DGaussianSplat"),
        ("OpenVDBAsset", None),
        ("Field3DAsset", None),
        ("Field3D2", None),
    ],
)
def test_a_number_behind_a_type_is_a_version(name: str, meant: str | None) -> None:
    assert spelling.versioned_type(name) == meant


@pytest.mark.parametrize(
    "name",
    [
        "ParticleField2DGaussianSplat",
        "HoudiniFieldAsset",
        "OmniNuRecFieldAsset",
        "NanoVDBAsset",
        "ParticleSystem",
        "ArnoldVolume",
        "VolumeLight",
        "Camera",
        "",
    ],
)
def test_a_type_of_its_own_is_no_misspelling(name: str) -> None:
    assert spelling.misspelt_type(name) is None


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("ParticleFieldPostionAtributeAPI", "ParticleFieldPositionAttributeAPI"),
        ("ParticleFieldScalesAttributeAPI", "ParticleFieldScaleAttributeAPI"),
        ("ParticleFieldSphericalHarmonicsAPI", "ParticleFieldSphericalHarmonicsAttributeAPI"),
        ("ParticleFieldKernelGaussianSurfaceletAPI", "ParticleFieldKernelGaussianSurfletAPI"),
        ("LightFieldKernelBaseAPI", "ParticleFieldKernelBaseAPI"),
        ("PositionAttributeAPI", "ParticleFieldPositionAttributeAPI"),
    ],
)
def test_misspelt_api(name: str, meant: str) -> None:
    assert spelling.misspelt_api(name) == meant


@pytest.mark.parametrize(
    "name",
    [
        "ParticleFieldVelocityAttributeAPI",
        "ParticleFieldColorAttributeAPI",
        "ParticleFieldPositionHalfAttributeAPI",
        "ParticleFieldKernelConstantEllipsoidAPI",
        "StudioParticleFieldPositionAttributeAPI",
        "LightFieldSphericalBetaAttributeAPI",
        "SemanticsAPI:Semantics_class",
    ],
)
def test_an_api_of_its_own_is_no_misspelling(name: str) -> None:
    assert spelling.misspelt_api(name) is None


FIELD_ATTRIBUTES = schema.attributes_of(("OpenVDBAsset", *schema.TYPE_BASES["OpenVDBAsset"]))
SPLAT_ATTRIBUTES = schema.attributes_of(
    (
        "ParticleField3DGaussianSplat",
        *schema.TYPE_BASES["ParticleField3DGaussianSplat"],
        *schema.API_ATTRIBUTES,
    )
)


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("filepath", "filePath"),
        ("file_path", "filePath"),
        ("filename", "filePath"),
        ("feildName", "fieldName"),
        ("FieldClass", "fieldClass"),
        ("fieldType", "fieldDataType"),
        ("vectorRoleHint", "vectorDataRoleHint"),
        ("fieldIdx", "fieldIndex"),
    ],
)
def test_misspelt_attribute_of_a_field(name: str, meant: str) -> None:
    assert spelling.misspelt_attribute(name, FIELD_ATTRIBUTES) == meant


@pytest.mark.parametrize(
    ("name", "meant"),
    [
        ("opacitys", "opacities"),
        ("opacity", "opacities"),
        ("position", "positions"),
        ("positionh", "positionsh"),
        ("extents", "extent"),
        ("shCoeffs", "radiance:sphericalHarmonicsCoefficients"),
        ("radianceSphericalHarmonicsCoefficients", "radiance:sphericalHarmonicsCoefficients"),
        ("radiance:sphericalHarmonicCoefficientsh", "radiance:sphericalHarmonicsCoefficientsh"),
        ("sphericalHarmonicsDegree", "radiance:sphericalHarmonicsDegree"),
        ("particleField:positionAttr", "positions"),
    ],
)
def test_misspelt_attribute_of_a_splat(name: str, meant: str) -> None:
    assert spelling.misspelt_attribute(name, SPLAT_ATTRIBUTES) == meant


@pytest.mark.parametrize(
    "name",
    [
        "textureMemory",
        "userProperties:filePath",
        "arnold:filePath",
        "karma:scales",
        "primvars:displayColour",
        "primvars:radiance:sphericalHarmonicsCoefficients",
        "xformOp:scale",
        "scales2",
        "opacitiesMax",
        "velocities",
        "widths",
        "visible",
        "path",
        "",
    ],
)
def test_an_attribute_of_its_own_is_no_misspelling(name: str) -> None:
    known = FIELD_ATTRIBUTES | SPLAT_ATTRIBUTES
    assert spelling.misspelt_attribute(name, known) is None


def test_a_guess_counts_only_where_the_attribute_exists() -> None:
    assert spelling.misspelt_attribute("points", FIELD_ATTRIBUTES) is None


@pytest.mark.parametrize(
    ("name", "token", "meant"),
    [
        ("fieldClass", "GRID_FOG_VOLUME", "fogVolume"),
        ("fieldClass", "level set", "levelSet"),
        ("fieldClass", "GRID_UNKNOWN", "unknown"),
        ("fieldClass", "density", None),
        ("fieldDataType", "Float", "float"),
        ("fieldDataType", "float32", "float"),
        ("fieldDataType", "vec3f", "float3"),
        ("fieldDataType", "Tree_vec3s_5_4_3", "float3"),
        ("fieldDataType", "Tree_float_5_4_3", "float"),
        ("fieldDataType", "doubl", "double"),
        ("fieldDataType", "float4", None),
        ("fieldDataType", "vector", None),
        ("vectorDataRoleHint", "none", "None"),
        ("vectorDataRoleHint", "velocity", None),
    ],
)
def test_misspelt_token(name: str, token: str, meant: str | None) -> None:
    assert spelling.misspelt_token(name, token, FIELD_ATTRIBUTES[name].tokens) == meant


def test_a_token_is_not_taken_for_one_that_is_not_allowed() -> None:
    allowed = schema.ATTRIBUTES["Field3DAsset"]["fieldDataType"].tokens
    assert spelling.misspelt_token("fieldDataType", "int32", allowed) is None
