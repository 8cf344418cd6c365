"""What the pages of rules/lint say of USD, asked of USD."""

from __future__ import annotations

import zipfile
from pathlib import Path

import pytest
from answers import stage, with_particles
from pxr import Sdf, Tf, Usd

TEXT = '#usda 1.0\ndef "a"\n{\n}\n'


def test_LNT001_a_byte_order_mark_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "a.usda").write_text(f"\ufeff{TEXT}", encoding="utf-8")
    with pytest.raises(Tf.ErrorException):
        Sdf.Layer.FindOrOpen(str(tmp_path / "a.usda"))


def test_LNT001_usd_may_be_text_or_crate_and_usda_may_not(tmp_path: Path) -> None:
    (tmp_path / "text.usd").write_text(TEXT, encoding="utf-8")
    text = Sdf.Layer.FindOrOpen(str(tmp_path / "text.usd"))
    text.Export(str(tmp_path / "crate.usdc"))
    crate = (tmp_path / "crate.usdc").read_bytes()
    for name in ("crate.usd", "crate.usda"):
        (tmp_path / name).write_bytes(crate)
    assert Sdf.Layer.FindOrOpen(str(tmp_path / "crate.usd")).GetPrimAtPath("/a")
    with pytest.raises(Tf.ErrorException):
        Sdf.Layer.FindOrOpen(str(tmp_path / "crate.usda"))


def test_LNT001_a_package_begins_with_a_layer_without_compression(tmp_path: Path) -> None:
    for name, compression in (("stored", zipfile.ZIP_STORED), ("small", zipfile.ZIP_DEFLATED)):
        with zipfile.ZipFile(tmp_path / f"{name}.usdz", "w", compression) as package:
            package.writestr("root.usda", TEXT)
    with zipfile.ZipFile(tmp_path / "late.usdz", "w") as package:
        package.writestr("notes.txt", "")
        package.writestr("root.usda", TEXT)
    assert Sdf.Layer.FindOrOpen(str(tmp_path / "stored.usdz"))
    assert not Sdf.Layer.FindOrOpen(str(tmp_path / "late.usdz"))
    with pytest.raises(Tf.ErrorException):
        Sdf.Layer.FindOrOpen(str(tmp_path / "small.usdz"))


def test_LNT001_a_missing_sublayer_leaves_the_rest() -> None:
    assert stage('(\n    subLayers = [@./gone.usda@]\n)\ndef "b"\n{\n}\n').GetPrimAtPath("/b")


SPLAT = """
def ParticleField3DGaussianSplat "s" (
    prepend apiSchemas = ["ParticleFieldPositionAttributeAPI"]
)
{
}
"""


@with_particles
def test_LNT004_particle_fields_came_with_26_3() -> None:
    assert "positions" in stage(SPLAT).GetPrimAtPath("/s").GetPrimDefinition().GetPropertyNames()


@pytest.mark.skipif(Usd.GetVersion() >= (0, 26, 3), reason="this USD has particle fields")
def test_LNT004_an_older_usd_drops_type_and_apis() -> None:
    prim = stage(SPLAT).GetPrimAtPath("/s")
    assert prim.GetAppliedSchemas() == []
    assert list(prim.GetPrimDefinition().GetPropertyNames()) == []


def test_LNT005_usd_does_not_know_what_an_undeclared_type_is() -> None:
    prim = stage('def StudioField "it"\n{\n}\n').GetPrimAtPath("/it")
    assert prim.GetTypeName() == "StudioField"
    assert prim.GetPrimTypeInfo().GetSchemaType() == Tf.Type.Unknown
