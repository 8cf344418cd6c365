"""The law that one cause is one finding sees two that have one.

It is held over all examples in `test_pages`, and over random defects in `stages/test_stages`.
"""

from __future__ import annotations

import pytest
from causes import ABSENT, OF_ONE_FILE, OF_ONE_PRIM, OF_ONE_PROPERTY, told_twice

from usdvol_lint.model import Cover, Finding, Severity, Site, Source
from usdvol_lint.packs.catalog import load


def found(
    code: str,
    place: str = "/cloud/density.filePath",
    message: str = "",
    advice: str | None = None,
    times: tuple[float, ...] = (),
    fold: str | None = None,
) -> Finding:
    prim, _, name = place.partition(".")
    site = Site("a.usda", prim, name or None, times=times)
    source, cover = Source("a.usda"), Cover(Severity.ERROR)
    return Finding(
        code, "", Severity.ERROR, message or code, site, source, cover, advice, fold=fold
    )


MISSPELT = found("SCH004", "/cloud/density.filepath", advice="did you mean 'filePath'?")
HALF = found("SCH004", "/Splat.positionh", advice="did you mean 'positionsh'?")
NO_API = found(
    "PRT006", "/Splat", "USD knows no API 'A', so nothing gives these splats positions or a kernel"
)


@pytest.mark.parametrize(
    "findings",
    [
        (found("AST002"), found("AST009")),
        (found("AST002", times=(1, 2)), found("AST008", times=(2, 3))),
        (found("AST002", times=(1, 2)), found("AST007")),
        (found("AST002"), found("AST002", message="the same again")),
        (found("AST011", message="twice"), found("AST011", message="twice")),
        (found("AST006"), found("FLD007", "/cloud/density")),
        (MISSPELT, found("AST001")),
        (found("AST001", "/cloud/density"), MISSPELT),
        (found("SCH003"), found("AST001")),
        (HALF, found("ARR001", "/Splat")),
        (NO_API, found("PRT001", "/Splat")),
        (found("PRT002", "/Splat"), NO_API),
        (found("PRT001", "/Splat"), found("PRT007", "/Splat.positionsh")),
        (found("PRT007", "/Splat.radiance:sphericalHarmonicsDegree"), found("PRT003", "/Splat")),
        (
            found("ARR007", "/Splat.opacities", advice="these look like logits: the sigmoid"),
            found("ARR008", "/Splat.opacities", advice="these look like the logits of a PLY file"),
        ),
        (
            found("SCH004", "/Splat.extents", advice="did you mean 'extent'?"),
            found("SCH007", "/Splat", "ParticleField without an extent"),
        ),
        (
            found("AST002", message="no file at 'a.vdb'"),
            found("AST002", "/cloud/heat.filePath", "no file at 'a.vdb'"),
        ),
        (found("ARR007", "/Splat.positions"), found("SCH008", "/Splat.extent", "is not finite")),
        (
            found("SCH008", "/Splat.extent", "is not finite", times=(2,)),
            found("ARR007", "/Splat.positionsh", times=(1, 2)),
        ),
    ],
)
def test_one_cause_is_seen(findings: tuple[Finding, Finding]) -> None:
    assert len(told_twice(findings)) == 1


@pytest.mark.parametrize(
    "findings",
    [
        (found("AST002", times=(1, 2)), found("AST009", times=(3,))),
        (found("AST002"), found("GRD003")),
        (found("AST002"), found("AST009", "/cloud/heat.filePath")),
        (
            found("AST002", message="gone", fold="/cloud/density"),
            found("AST002", "/cloud/heat.filePath", "gone", fold="/cloud/density"),
        ),
        (found("AST002", "/cloud/a.filePath", "gone"), found("AST002", "/fog/a.filePath", "gone")),
        (MISSPELT, found("FLD001", "/cloud/density")),
        (MISSPELT, found("AST001", "/cloud/heat")),
        (NO_API, found("PRT003", "/Splat")),
        (found("PRT001", "/Splat"), found("PRT007", "/Splat.scales")),
        (
            found("ARR007", "/Splat.opacities", advice="author 1 for inf"),
            found("ARR008", "/Splat.opacities", advice="these look like the logits of a PLY file"),
        ),
        (found("ARR002", "/Splat.scales"), found("ARR003", "/Splat.opacities")),
        (
            found("ARR007", "/Splat.positions", times=(1,)),
            found("SCH008", "/Splat.extent", "is not finite", times=(2,)),
        ),
        (found("ARR007", "/Splat.positions"), found("SCH008", "/Splat.extent", "is inverted")),
        (found("ARR007", "/Splat.scales"), found("SCH008", "/Splat.extent", "is not finite")),
    ],
)
def test_two_causes_are_two_findings(findings: tuple[Finding, Finding]) -> None:
    assert told_twice(findings) == []


def test_only_findings_of_one_rule_and_one_key_are_told_in_one_line() -> None:
    one = found("AST002", message="gone", fold="/cloud/density")
    for other in (one._replace(fold="/cloud/heat"), one._replace(code="AST009")):
        assert len(told_twice((one, other))) == 1


def test_tables_name_codes_that_rules_have() -> None:
    named = set().union(*OF_ONE_PROPERTY, *OF_ONE_PRIM, OF_ONE_FILE, ABSENT)
    assert named <= load().rules.keys()
