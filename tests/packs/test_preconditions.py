"""What `when` narrows a rule to, and what becomes of a precondition that fails."""

from __future__ import annotations

import gc
from contextlib import nullcontext
from pathlib import Path
from typing import Any

import pytest
from process import ROOT, run, volume, write
from pxr import Sdf

from usdvol_lint import lint
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts import Facts
from usdvol_lint.facts.found import Wing, summary
from usdvol_lint.facts.prims.tables import Table
from usdvol_lint.model import PackError, Severity, Source
from usdvol_lint.packs.activation import ActiveRules, activate
from usdvol_lint.packs.catalog import Catalog, load
from usdvol_lint.packs.examples import STAGE, cases, pages
from usdvol_lint.rule import AssetState, Problem, Problems, Rule, When, file_paths, rule
from usdvol_lint.run.testing import write_example

WORDS = (
    "from usdvol_lint.rule import ERROR, INFO, BindingMark, Grids, Prims, Problem, When, rule\n"
    "from usdvol_lint.rule import AssetState, authored, bindings, contents, file_paths\n"
)
FIELD = '#usda 1.0\ndef OpenVDBAsset "density"\n{\n    asset filePath = @./cloud.vdb@\n}\n'
EXTENT = "float3[] extent = [(0, 0, 0), (1, 1, 1)]"
NESTED = '#usda 1.0\ndef Volume "cloud"\n{\n    rel field:a:b = </cloud>\n}\n'


def pack(folder: Path, when: str, on: str = "Volume", options: str = "", more: str = "") -> Path:
    """A pack with one rule, which reports every prim that it is handed."""
    folder.mkdir()
    (folder / "seen.py").write_text(
        f"{WORDS}{more}\n"
        f"@rule('WHN001', on={on!r}, when={when}, severity=INFO, since='1')\n"
        f"def seen(prim, facts{options}):\n"
        "    yield Problem('seen', at=prim)\n",
        encoding="utf-8",
    )
    return folder


ATTRIBUTE_ERROR = {"when": "When(Prims.authored, lambda authored: authored.no_such_name)"}
NO_TRUTH = {
    "when": "When(Prims.authored, lambda authored: Odd())",
    "more": "class Odd:\n    def __bool__(self):\n        raise ValueError('either')\n",
}
KEY_OF_CONTENT = {
    "when": "contents(key)",
    "on": "FieldAsset",
    "more": "def key(content):\n    raise KeyError('lost')\n",
}


@pytest.mark.parametrize("jobs", [1, 3])
@pytest.mark.parametrize(
    ("rule", "stage", "prim", "error"),
    [
        pytest.param(
            ATTRIBUTE_ERROR,
            volume("cloud"),
            "/cloud",
            "AttributeError: 'Authored' object has no attribute 'no_such_name'",
            id="holds",
        ),
        pytest.param(NO_TRUTH, volume("cloud"), "/cloud", "ValueError: either", id="no-truth"),
        pytest.param(KEY_OF_CONTENT, FIELD, "/density", "KeyError: 'lost'", id="key-of-content"),
    ],
)
def test_a_precondition_that_fails_is_one_finding_in_a_run(
    rule: dict[str, str], stage: str, prim: str, error: str, jobs: int, tmp_path: Path
) -> None:
    """The rule looks at all prims, and every stage says so, whichever was done first."""
    folder = pack(tmp_path / "pack", **rule)
    stages = write(tmp_path / "stages", a=stage, b=stage, c=stage)
    (stages / "cloud.vdb").write_bytes((ROOT / "rules" / "assets" / "cloud.vdb").read_bytes())
    chosen = ("--isolated", "--pack", folder, "--select", "WHN", "--fail-on", "never")
    ran = run(*chosen, "--output-format", "json", "--root", ".", f"-j{jobs}", ".", cwd=stages)
    failed = (
        "the precondition of rule WHN001 (seen) failed, so the rule looked at every prim that it "
        f"asks for: {error}"
    )
    assert [
        (
            each["code"],
            each["message"],
            (each["source"]["layer"], each["source"]["subject"]),
            [(place["stage"], place["prim"]) for place in each["places"]],
        )
        for each in ran.json["causes"]
    ] == [
        ("LNT002", failed, (None, "WHN001"), [(0, None), (1, None), (2, None)]),
        *(("WHN001", "seen", (f"{name}.usda", ""), [(n, prim)]) for n, name in enumerate("abc")),
    ]
    assert (ran.code, ran.err) == (2, "")


def test_preconditions_of_two_rules_are_two_causes(tmp_path: Path) -> None:
    """Each with the stages that show it."""
    folder = pack(tmp_path / "pack", **ATTRIBUTE_ERROR)
    text = (folder / "seen.py").read_text()
    (folder / "other.py").write_text(
        text.replace("WHN001", "WHN002").replace("def seen", "def other").replace("Volume", "Xform")
    )
    both = volume("a") + 'def Xform "b"\n{\n}\n'
    stages = write(tmp_path / "stages", a=volume("a"), b=both, c=both)
    config = Config(select=("WHN",), packs=(str(folder),), jobs=1)
    report = lint([str(stages)], config)
    assert [
        (each.code, each.source.subject, [place.stage for place in each.places])
        for each in report.causes
    ] == [
        ("LNT002", "WHN001", [0, 1, 2]),
        ("WHN001", "", [0]),
        ("LNT002", "WHN002", [1, 2]),
        ("WHN001", "", [1]),
        ("WHN002", "", [1]),
        ("WHN001", "", [2]),
        ("WHN002", "", [2]),
    ]
    assert [stage.causes for stage in report.stages] == [(0, 1), (0, 2, 3, 4), (0, 2, 5, 6)]


def test_keys_that_can_not_be_computed_fail_every_rule_that_looks_at_them(tmp_path: Path) -> None:
    """Each with the whole traceback; and no frame of it keeps the stage."""

    class Broken(Wing):
        def __init__(self, facts: Facts) -> None:
            super().__init__(facts.tables)
            self.stage = facts.stage

        @summary
        def keys(self, table: Table) -> list[str]:
            raise KeyError("lost")

    def seen(prim: Any, facts: Facts) -> Problems:
        yield Problem("seen", at=prim)

    when = When(Broken.keys, bool)
    rules = {
        code: Rule(code, "seen", ("Volume",), Severity.INFO, "1", seen, {}, when=when)
        for code in ("WHN001", "WHN002")
    }
    stage = write(tmp_path.resolve(), stage=volume("a")) / "stage.usda"
    engine = Engine(rules, ActiveRules(dict.fromkeys(rules, Severity.INFO), {}))
    gc.disable()
    try:
        with pytest.MonkeyPatch.context() as patch:
            patch.setattr(Facts, "wing", lambda facts, wing: wing(facts))
            report = engine.lint(str(stage))
        assert Sdf.Layer.Find(str(stage)) is None
    finally:
        gc.enable()
    failed = [each for each in report.findings if each.code == "LNT002"]
    assert {each.source for each in failed} == {Source(None, subject=code) for code in rules}
    details = {each.source.subject: each.detail for each in failed}
    for detail in details.values():
        assert 'raise KeyError("lost")' in str(detail)


@pytest.mark.parametrize("options", ["", ", *, longest: int = 3"])
def test_a_rule_with_options_is_narrowed_too(options: str, tmp_path: Path) -> None:
    folder = pack(tmp_path / "pack", "bindings(BindingMark.NESTED)", options=options)
    stages = write(tmp_path / "stages", nested=NESTED, plain=volume("cloud"))
    config = Config(select=("WHN",), packs=(str(folder),), jobs=1)
    report = lint([str(stages)], config)
    assert [cause.code for cause in report.causes] == ["WHN001"]
    assert [stage.causes for stage in report.stages] == [(0,), ()]


def test_a_precondition_is_given_the_options_that_it_names(tmp_path: Path) -> None:
    when = "When(Prims.authored, lambda authored, longest: len(authored.declared) > longest)"
    folder = pack(tmp_path / "pack", when, options=", *, longest: int = 0, other: int = 1")
    stages = write(tmp_path / "stages", nested=NESTED.replace("rel field:a:b = </cloud>", EXTENT))
    for longest, seen in (({}, 1), ({"longest": 1}, 0)):
        config = Config(
            select=("WHN",), packs=(str(folder),), jobs=1, options={"WHN001": dict(longest)}
        )
        assert len(lint([str(stages)], config).causes) == seen


@pytest.mark.parametrize(
    ("when", "said"),
    [
        (
            "When(Prims.authored, lambda authored, longset: True)",
            r"WHN001: `when` asks for 'longset', no option of the rule",
        ),
        ("When('authored', bool)", r"WHN001: `when` names no column or summary of a wing, but 'au"),
        ("bindings('NESTED')", r"bindings: takes members of BindingMark or .*, not \('NESTED',\)"),
        ("bindings()", r"bindings: takes members of BindingMark or .*, not \(\)"),
        ("file_paths(BindingMark.NESTED)", r"file_paths: takes members of AssetState or PathMark"),
        (
            "file_paths(AssetState.MISSING)",
            r"`when` is about a FieldAsset, and `on` names none: 'V",
        ),
        ("contents('key')", r"contents: takes functions, not \('key',\)"),
        ("contents()", r"contents: takes functions, not \(\)"),
        ("authored('extnt')", r"authored: no attribute 'extnt' of UsdVol; did you mean 'extent'"),
        ("authored()", r"authored: no attribute of UsdVol"),
    ],
)
def test_a_precondition_that_can_not_work_is_refused(when: str, said: str, tmp_path: Path) -> None:
    folder = pack(tmp_path / "pack", when, options=", *, longest: int = 3")
    with pytest.raises(PackError, match=rf"seen\.py: .*{said}"):
        load([str(folder)])


@pytest.mark.parametrize(
    ("on", "said"),
    [
        ("FieldAsset", None),
        ("OpenVDBAsset", None),
        ("VolumeFieldBase", None),
        ("StudioAsset", None),
        ("Imageable", None),
        (("Volume", "FieldAsset"), None),
        (("Volume", "ParticleField"), "`on` names none"),
        ((), "`on` names no type"),
    ],
)
def test_the_types_that_a_precondition_is_about(
    on: str | tuple[str, ...], said: str | None
) -> None:
    when = file_paths(AssetState.FILE)
    with pytest.raises(ValueError, match=said) if said else nullcontext():
        rule("WHN001", on=on, when=when, severity=Severity.INFO, since="1")


CASES = [case for page in pages(ROOT / "rules") for case in cases(page)]


def test_rules_find_the_same_without_their_preconditions(
    catalog: Catalog, assets: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """On every example of a page: `when` saves time, and takes away no finding."""
    active = activate(Config(select=("ALL",)), catalog)
    rules = {code: rule._replace(when=None) for code, rule in catalog.rules.items()}
    assert [rule for rule in catalog.rules.values() if rule.when]
    narrowed, handed_all = Engine(catalog.rules, active), Engine(rules, active)
    monkeypatch.chdir(tmp_path)
    for number, case in enumerate(CASES):
        folder = tmp_path / str(number)
        write_example(case, folder, assets)
        path = f"{number}/{STAGE}"
        place = f"{case.page.path}:{case.example.line}"
        assert narrowed.lint(path).findings == handed_all.lint(path).findings, place
