"""The layers that stages name: each that is missing is said once, where it is named."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path

import pytest
from stages import findings, said, volume

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.layers.words import speak_of_ours
from usdvol_lint.model import StageReport
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog

Lint = Callable[..., StageReport]


def test_payloads_that_were_not_loaded(
    catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lib.usda").write_text(volume("asset filePath = @./gone.vdb@"))
    payload = 'def "p{}" (\n    payload = @./lib.usda@</cloud>\n)\n{{\n}}\n'
    (tmp_path / "stage.usda").write_text("#usda 1.0\n" + "".join(map(payload.format, range(5))))
    engine = Engine(catalog.rules, activate(Config(select=("ALL",)), catalog), Depth(load="none"))
    assert said(engine.lint("stage.usda")) == [
        "LNT005 5 payloads not loaded; what is below was not checked: /p0, /p1, /p2, …"
    ]


def test_missing_layers_are_known_by_their_place(lint_text: Lint, tmp_path: Path) -> None:
    """No absolute paths and no addresses: the report is the same on every machine."""
    (tmp_path / "lib.usda").write_text(
        "#usda 1.0\n(\n    subLayers = [@./sub.usda@]\n)\n"
        'def "a" (\n    references = @./other.usda@\n)\n{\n'
        '    def "c" (\n        references = </nope>\n    )\n    {\n    }\n}\n'
    )
    reference = 'def "p{}" (\n    references = @./lib.usda@</a>\n)\n{{\n}}\n'
    report = lint_text("#usda 1.0\n" + "".join(map(reference.format, range(3))))
    assert said(report) == [
        "STG001 the sublayer './sub.usda' does not exist; what it holds was not checked"
        + NOT_THERE,
        "STG001 the reference './other.usda' does not exist; what it holds was not checked "
        "(on 3 prims)" + NOT_THERE,
    ]
    assert [(f.site.layer, f.site.line) for f in findings(report)] == [
        ("lib.usda", 3),
        ("lib.usda", 6),
    ]


def test_prims_that_are_not_there_are_known_by_their_place(lint_text: Lint, tmp_path: Path) -> None:
    (tmp_path / "lib.usda").write_text(
        '#usda 1.0\ndef "a"\n{\n    def "c" (\n        references = </nope>\n    ) {\n    }\n}\n'
    )
    reference = 'def "p{}" (\n    references = @./lib.usda@</a>\n)\n{{\n}}\n'
    report = lint_text("#usda 1.0\n" + "".join(map(reference.format, range(3))))
    assert said(report) == [
        "STG004 the reference brings nothing: there is no prim </nope> in this layer; what it "
        "should hold was not checked (on 3 prims) -> " + NAMED,
    ]
    assert [(f.site.layer, f.site.line) for f in findings(report)] == [("lib.usda", 5)]


def test_what_hides_the_target_of_an_arc_is_the_finding(lint_text: Lint, tmp_path: Path) -> None:
    """At the prim with the arc, though USD knows it only of prims that are not on the stage."""
    (tmp_path / "lib.usda").write_text(
        '#usda 1.0\ndef "set" (\n    references = @./gone.usda@\n)\n{\n}\n'
    )
    report = lint_text(
        '#usda 1.0\ndef "tree" (\n    references = @./lib.usda@</set/tree>\n)\n{\n}\n'
    )
    assert said(report) == [
        "STG001 the reference './gone.usda' does not exist; what it holds was not checked"
        + NOT_THERE
    ]
    [finding] = findings(report)
    assert (finding.site.prim, finding.site.layer, finding.site.line) == ("/tree", "lib.usda", 3)


@pytest.mark.parametrize("load", ["all", "none"])
def test_a_payload_that_is_not_loaded_hides_no_prim(
    load: str, catalog: Catalog, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "lib.usda").write_text('#usda 1.0\ndef "a"\n{\n    def "b"\n    {\n    }\n}\n')
    (tmp_path / "stage.usda").write_text(
        '#usda 1.0\ndef "p" (\n    payload = @./lib.usda@</a>\n)\n{\n}\n'
        'def "q" (\n    references = </p/b>\n)\n{\n}\n'
    )
    engine = Engine(catalog.rules, activate(Config(), catalog), Depth(load=load))
    codes = [finding.code for finding in findings(engine.lint("stage.usda"))]
    assert "STG004" not in codes


def test_two_arcs_to_nothing_are_two_findings(lint_text: Lint) -> None:
    report = lint_text('#usda 1.0\ndef "a" (\n    references = [</b/x>, </c>]\n)\n{\n}\n')
    assert [(f.site.line, f.code) for f in findings(report)] == [(3, "STG004")] * 2


def rates(
    lint_text: Lint, tmp_path: Path, header: str, times: list[float], scale: float = 1
) -> list[str]:
    """What is said of a stage with this header and a layer that says no rate."""
    samples = ", ".join(f"{time}: [(0, 0, 0), (1, 1, 1)]" for time in times)
    (tmp_path / "lib.usda").write_text(
        f'#usda 1.0\ndef Volume "v"\n{{\n    float3[] extent.timeSamples = {{ {samples} }}\n}}\n'
    )
    arc = f"references = @./lib.usda@</v> (scale = {scale})"
    report = lint_text(f'#usda 1.0\n({header})\ndef "v" (\n    {arc}\n)\n{{\n}}\n')
    return [finding.message for finding in findings(report) if finding.code == "STG008"]


def rated(rate: int, start: int = 0, end: int = 1000) -> str:
    return f"timeCodesPerSecond = {rate}\nstartTimeCode = {start}\nendTimeCode = {end}"


def test_a_scale_that_comes_of_the_rate_of_the_stage_alone(lint_text: Lint, tmp_path: Path) -> None:
    """At 48 USD scales by 2, which nobody wrote."""
    assert rates(lint_text, tmp_path, rated(48, end=4), [1, 2, 3, 4])


def test_a_scale_that_undoes_it(lint_text: Lint, tmp_path: Path) -> None:
    """On top of it may come a slow motion, which the range cuts off."""
    times: list[float] = list(range(41, 61))
    assert rates(lint_text, tmp_path, rated(48, end=50), times)
    assert not rates(lint_text, tmp_path, rated(48, end=50), times, scale=0.5)
    assert not rates(lint_text, tmp_path, rated(30, end=100), times, scale=1.6)


def test_subframes_are_between_frames_all_the_same(lint_text: Lint, tmp_path: Path) -> None:
    assert not rates(lint_text, tmp_path, rated(30), [0.5, 1.5])
    assert rates(lint_text, tmp_path, rated(30), [0.5, 1])


def test_an_overhang_at_the_end_of_the_range(lint_text: Lint, tmp_path: Path) -> None:
    times: list[float] = list(range(1, 11))
    assert not rates(lint_text, tmp_path, rated(48, end=19), times)
    assert not rates(lint_text, tmp_path, rated(48, end=17), times)
    assert rates(lint_text, tmp_path, rated(48, end=15), times)


def test_samples_out_of_the_range_all_the_same(lint_text: Lint, tmp_path: Path) -> None:
    assert not rates(lint_text, tmp_path, rated(48, 1, 5), [101, 102, 103])


def test_one_sample_has_no_rate(lint_text: Lint, tmp_path: Path) -> None:
    assert not rates(lint_text, tmp_path, rated(30), [1])


NOT_THERE = " -> write or copy it there, or name a layer that is there"
NAMED = "name a prim that is there, or define this one"


def advice(lint_text: Lint, tmp_path: Path, library: str, *arcs: str) -> list[str | None]:
    """What is said to mend each arc, on a prim called `/fog`."""
    (tmp_path / "lib.usda").write_text(f"#usda 1.0\n{library}")
    report = lint_text(f'#usda 1.0\ndef "fog" (\n    references = [{", ".join(arcs)}]\n)\n{{\n}}\n')
    return [finding.suggestion for finding in findings(report)]


def test_an_arc_to_nothing_in_its_own_prim_is_not_corrected(
    lint_text: Lint, tmp_path: Path
) -> None:
    assert advice(lint_text, tmp_path, "", "</fogg>") == [NAMED]


def test_only_a_corrected_path_that_leads_to_a_prim_is_offered(
    lint_text: Lint, tmp_path: Path
) -> None:
    library = 'def "cloud"\n{\n    def "part"\n    {\n    }\n}\n'
    arcs = "@./lib.usda@</clouds/part>", "@./lib.usda@</clouds/rain>"
    assert advice(lint_text, tmp_path, library, *arcs) == ["did you mean </cloud/part>?", NAMED]


def test_only_what_is_defined_is_offered_for_a_default_prim(
    lint_text: Lint, tmp_path: Path
) -> None:
    library = 'class "_c"\n{\n}\nover "o"\n{\n}\ndef "d"\n{\n}\n'
    assert advice(lint_text, tmp_path, library, "@./lib.usda@") == [
        "write 'defaultPrim = \"d\"' into the metadata of that layer"
    ]


@pytest.mark.parametrize(
    ("default", "meant"),
    [("/cloud/parts", "did you mean 'defaultPrim = \"/cloud/part\"'?"), ("my cloud", None)],
)
def test_a_default_prim_that_leads_nowhere(
    default: str, meant: str | None, lint_text: Lint, tmp_path: Path
) -> None:
    library = (
        f'(\n    defaultPrim = "{default}"\n)\n'
        'def "cloud"\n{\n    def "part"\n    {\n    }\n}\ndef "b"\n{\n}\n'
    )
    (tmp_path / "lib.usda").write_text(f"#usda 1.0\n{library}")
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @./lib.usda@\n)\n{\n}\n')
    [finding] = findings(report)
    assert f"brings nothing: its defaultPrim '{default}' names no prim in it" in finding.message
    assert finding.suggestion == (
        meant or "name the prim, one of </cloud>, </b>, or write a defaultPrim into that layer"
    )


def test_beside_a_volume_any_arc_counts(lint_text: Lint) -> None:
    report = lint_text(volume("") + 'def "tree" (\n    references = </three>\n)\n{\n}\n')
    levels = {f.code: f.severity.label for f in findings(report)}
    assert levels["STG004"] == "error"


@pytest.mark.parametrize(
    ("names", "speak"),
    [
        (("./set.usda", "/World/tree"), False),
        (("./set.usda", "/World/tree", "/World/fx/tree"), True),
        (("./revolver.usda",), False),
        (("./vol.usda",), True),
        (("./GroundFog_v2.usda",), True),
        (("./groundfogger.usda",), False),
        (("./bigCLOUDS.usda",), True),
        (("./scan.3DGS.usda",), True),
        (("", ""), False),
    ],
)
def test_names_that_speak_of_volumes(names: tuple[str, ...], speak: bool) -> None:
    assert speak_of_ours(names) == speak


def test_misspelt_layers(lint_text: Lint, tmp_path: Path) -> None:
    (tmp_path / "library.usda").write_text("#usda 1.0\n")
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @./libary.usda@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference './libary.usda' does not exist; what it holds was not checked -> did "
        "you mean './library.usda'?"
    ]


def test_layers_that_are_there_and_do_not_open(lint_text: Lint, tmp_path: Path) -> None:
    """What is wrong with the file is said; where it lies on this machine is not."""
    (tmp_path / "empty.usda").touch()
    (tmp_path / "folder.usda").mkdir()
    (tmp_path / "broken.usda").write_text('#usda 1.0\ndef "a" (\n')
    names = ("empty", "folder", "broken")
    arcs = (f'def "{name}" (\n    references = @./{name}.usda@\n)\n{{\n}}\n' for name in names)
    broken, empty, folder = said(lint_text("#usda 1.0\n" + "".join(arcs)))
    unchecked = "; what it holds was not checked -> correct that layer, or export it again"
    assert (
        empty
        == f"STG001 the reference './empty.usda' can't be read: it is a file of 0 bytes{unchecked}"
    )
    assert (
        folder == f"STG001 the reference './folder.usda' can't be read: it is a folder{unchecked}"
    )
    assert broken.startswith("STG001 the reference './broken.usda' can't be read: ")
    assert str(tmp_path) not in broken


def test_unset_variables_in_arcs(lint_text: Lint) -> None:
    report = lint_text('#usda 1.0\ndef "a" (\n    references = @`"./${SET}.usda"`@\n)\n{\n}\n')
    assert said(report) == [
        "STG001 the reference '`\"./${SET}.usda\"`' does not exist; what it holds was not checked"
        + NOT_THERE
    ]
