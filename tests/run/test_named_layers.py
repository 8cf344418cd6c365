"""How layers are named in what a stage completes: as causes name them, whatever the folder."""

from __future__ import annotations

from pathlib import Path

import pytest

from usdvol_lint.model import Completed, Completion, StageReport, Status
from usdvol_lint.paths import canonical
from usdvol_lint.run.causes import Causes, versions_in


@pytest.mark.parametrize(
    ("root", "names"),
    [
        ("show", ["{here}/v2/lib.usda", "a.usda", "z.usdz[b.usda]"]),
        (".", ["show/a.usda", "show/z.usdz[b.usda]", "v2/lib.usda"]),
        (None, ["{here}/show/a.usda", "{here}/show/z.usdz[b.usda]", "{here}/v2/lib.usda"]),
    ],
)
def test_layers_that_are_completed(
    root: str | None, names: list[str], tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Versions stay apart: it is a file that is completed, and not what any version of it lacks."""
    (tmp_path / "show").mkdir()
    (tmp_path / "link").symlink_to(tmp_path / "show", target_is_directory=True)
    here = canonical(str(tmp_path))
    monkeypatch.chdir(tmp_path / "show")
    layers = (f"{here}/v2/lib.usda", f"{here}/link/a.usda", f"{here}/show/a.usda")
    package = f"{here}/link/z.usdz[b.usda]"
    specs = (Completed((package,), "/A", ("x",)), Completed(layers[1:2], "/B", ("x", "y")))
    stage = StageReport("s.usda", Status.CHECKED, completes=Completion((*layers, package), specs))
    folder = None if root is None else canonical(str(tmp_path / root))
    named = Causes(folder, versions_in("v[0-9]+")).stage(0, stage).completes
    expected = [name.format(here=here) for name in names]
    layer, inside = sorted(name for name in expected if "lib" not in name)
    assert named == Completion(
        tuple(expected),
        (Completed((layer,), "/B", ("x", "y")), Completed((inside,), "/A", ("x",))),
    )


def test_what_completes_nothing() -> None:
    assert Causes("/").stage(0, StageReport("s.usda", Status.CHECKED)).completes is None
