"""The text of a layer is scanned once for all stages that name it, and anew where it changed."""

from __future__ import annotations

from pathlib import Path

from pxr import Sdf

from usdvol_lint.layertext.source import LayerTexts, SharedTexts

FIRST, SECOND = ('#usda 1.0\ndef "a"\n{\n}\n', '#usda 1.0\n\n\n\ndef "a"\n{\n}\n')


def test_a_layer_of_several_stages_is_read_once(tmp_path: Path) -> None:
    file = tmp_path / "asset.usda"
    file.write_text(FIRST, encoding="utf-8")
    layer = Sdf.Layer.FindOrOpen(str(file))
    shared = SharedTexts()
    text = LayerTexts(shared).of(layer)
    assert text
    assert LayerTexts(shared).of(layer) is text
    file.write_text(SECOND, encoding="utf-8")
    changed = LayerTexts(shared).of(layer)
    assert changed
    positions = [each.find("/a") for each in (text, changed)]
    assert [position.line for position in positions if position] == [2, 5]


def test_few_are_kept(tmp_path: Path) -> None:
    shared = SharedTexts()
    layers = []
    for number in range(40):
        file = tmp_path / f"{number}.usda"
        file.write_text(FIRST, encoding="utf-8")
        layers.append(Sdf.Layer.FindOrOpen(str(file)))
    texts = [shared.of(layer) for layer in layers]
    assert shared.of(layers[-1]) is texts[-1]
    assert shared.of(layers[0]) is not texts[0]


def test_a_layer_without_a_file_has_no_text() -> None:
    assert SharedTexts().of(Sdf.Layer.CreateAnonymous()) is None
