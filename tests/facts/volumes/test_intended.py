"""Which field is the one that a wrong path was probably intended to name."""

from __future__ import annotations

import pytest
from pxr import Sdf, Usd

from usdvol_lint.facts.volumes.intended import FieldIndex


@pytest.mark.parametrize(
    ("path", "fields", "closest"),
    [
        ("/v/densty", ["/v/density"], "/v/density"),
        ("/v/density_old", ["/v/density"], "/v/density"),
        ("/v/temp", ["/v/temperature"], None),  # too far
        ("/v/Heats", ["/v/Heat", "/v/heat"], "/v/Heat"),  # these are two names
        ("/v/HEAT", ["/v/heat"], None),
        ("/w/densty", ["/v/density"], None),  # no sibling, so the name must be the same
        ("/v/densty", ["/v/density", "/w/densty"], "/v/density"),
        ("/a/c/x", ["/a/b/x", "/z/x"], "/a/b/x"),
        ("/a/c/x", ["/a/b/x", "/q/x", "/z/x"], "/a/b/x"),
        ("/a/d/x", ["/a/b/x", "/a/c/x"], None),  # both as close
        ("/a/b/x", ["/a/c/x", "/a/d/x"], None),
        ("/a/c/x", ["/a/b/x", "/a/d/x"], None),
        ("/m/x", ["/v/x"], "/v/x"),
        ("/m/x", ["/v/deep/x"], "/v/deep/x"),
        ("/m/x", ["/other/x"], None),  # below another Volume
        ("/m/x", ["/other/deep/x"], None),
        ("/m/y", ["/v/x"], None),
    ],
)
def test_the_closest(path: str, fields: list[str], closest: str | None) -> None:
    stage = Usd.Stage.CreateInMemory()
    prims = [stage.DefinePrim(field, "OpenVDBAsset") for field in fields]
    volumes = [stage.DefinePrim(volume, "Volume") for volume in ("/v", "/other")]
    found = FieldIndex(prims, volumes).closest(Sdf.Path(path), Sdf.Path("/v"))
    assert found == (Sdf.Path(closest) if closest else None)
