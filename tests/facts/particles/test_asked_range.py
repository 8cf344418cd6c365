"""The samples of particles beside the production's range of frames, and beside a rate."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

Lint = Callable[..., list[tuple[str, str, str]]]


def splat(times: range, array: str = "point3f[] positions", header: str = "") -> str:
    samples = "".join(f"{time}: [(0.{time}, 0, 0)], " for time in times)
    default = "" if "positions" in array else "point3f[] positions = [(0, 0, 0)]"
    return (
        f'#usda 1.0\n{header}\ndef ParticleField3DGaussianSplat "splat"\n{{\n{default}\n'
        f"{array}.timeSamples = {{ {samples} }}\n}}\n"
    )


@pytest.fixture
def lint(catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Lint:
    monkeypatch.chdir(tmp_path)

    def call(
        text: str, frames: tuple[float, float] | None = None, *codes: str
    ) -> list[tuple[str, str, str]]:
        (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
        active = activate(Config(select=codes or ("ARR027",)), catalog)
        report = Engine(catalog.rules, active, Depth(frames=frames)).lint("stage.usda")
        return [(each.code, each.severity.label, each.message) for each in report.findings]

    return call


@pytest.mark.parametrize("header", ["", "(\n    startTimeCode = 1\n    endTimeCode = 3\n)"])
def test_positions_have_to_cover_it(header: str, lint: Lint) -> None:
    text = splat(range(1, 4), header=header)
    assert lint(text) == lint(text, (1.0, 3.0)) == []
    assert lint(text, (1.0, 5.0)) == [
        (
            "ARR027",
            "warning",
            "the samples of 'positions' are at 1-3, the production's range is 1-5: "
            "the last one is held from 3 on",
        )
    ]
    [(_, level, message)] = lint(text, (1001.0, 1100.0))
    assert level == "warning"
    assert message.endswith("the production's range is 1001-1100: the last one is held throughout")


def test_other_arrays_may_come_to_rest_before_it(lint: Lint) -> None:
    text = splat(range(1, 4), "float3[] scales")
    assert lint(text, (1.0, 5.0)) == []
    [(_, level, _)] = lint(text, (1001.0, 1100.0))
    assert level == "info"


def test_a_rate_that_no_layer_says_is_told_once(lint: Lint, tmp_path: Path) -> None:
    (tmp_path / "simulation.usda").write_text(splat(range(3, 6)), encoding="utf-8")
    header = "timeCodesPerSecond = 48\nstartTimeCode = 3\nendTimeCode = 5"
    text = f"#usda 1.0\n(\n{header}\nsubLayers = [@./simulation.usda@]\n)\n"
    assert [code for code, *_ in lint(text, None, "ARR027", "STG008")] == ["STG008"]
    assert [code for code, *_ in lint(text)] == ["ARR027"]
