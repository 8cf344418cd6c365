"""A USD that knows no particle fields is said once, and only where there are some."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

from particlefields import bare, codes

from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.usd.kinds import PrimKinds
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog


def test_an_old_usd_is_said_once_a_stage(lint_text: Callable[[str], StageReport]) -> None:
    report = lint_text(bare("").replace('"Splats"', '"One"') + bare("").partition("\n")[2])
    said = [finding for finding in report.findings if finding.code == "LNT004"]
    assert codes(report.findings) == codes(tuple(said))
    assert len(said) == (0 if PrimKinds().knows_particle_fields else 1)
    for finding in said:
        assert (finding.severity.label, finding.site.prim) == ("warning", None)


def test_an_old_usd_does_not_matter_without_particles(
    lint_text: Callable[[str], StageReport],
) -> None:
    report = lint_text('#usda 1.0\ndef Xform "x"\n{\n}\n')
    assert report.findings == ()


def test_an_old_usd_can_be_ignored(catalog: Catalog, tmp_path: Path) -> None:
    engine = Engine(catalog.rules, activate(Config(ignore=("LNT004",)), catalog))
    (tmp_path / "stage.usda").write_text(bare(""))
    assert engine.lint(str(tmp_path / "stage.usda")).findings == ()
