"""What USD's errors say, with names as they are shown, and the text of a layer as it stands."""

from __future__ import annotations

from pathlib import Path

import pytest
from pxr import Usd

from usdvol_lint.engine.messages import messages
from usdvol_lint.facts.usd.diagnostics import UNREADABLE

BROKEN = '#usda 1.0\ndef "x"\n{\n    it\'s @%s@ in <x>\n}\n'


@pytest.mark.parametrize("name", ["../as/x.usda", "./sh.usda", "/x.usda"])
def test_what_is_quoted_of_a_layer_stays(
    name: str, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    folder = tmp_path / "sh"
    folder.mkdir()
    monkeypatch.chdir(folder)
    if name.startswith("/"):
        name = (tmp_path / "x.usda").as_posix()
    named = folder / name
    named.parent.mkdir(exist_ok=True)
    named.write_text("#usda 1.0\n", encoding="utf-8")
    Path("a.usda").write_text(BROKEN % name, encoding="utf-8")
    with pytest.raises(UNREADABLE) as caught:
        Usd.Stage.Open((folder / "a.usda").as_posix())
    said = messages(caught.value)
    assert any(f"@{name}@" in each for each in said)
    assert said[-1] == "Failed to open layer a.usda"
