"""What a rule does wrong is a finding at its prim or an error at load, and nothing else is lost."""

from __future__ import annotations

from pathlib import Path

import pytest
from process import run, volume, write

from usdvol_lint.config.files import read_config
from usdvol_lint.model import PackError
from usdvol_lint.packs.catalog import load, load_for

RULE = """
from usdvol_lint.rule import INFO, Problem, rule

@rule("FLT001", on="Volume", severity=INFO, since="1")
def faulty(volume, facts):
    yield Problem({problem})
"""


def findings(
    folder: Path, problem: str
) -> tuple[int, list[tuple[str, str, str, tuple[float, ...]]]]:
    """The exit code, and the findings of two stages under a pack with one rule."""
    pack = folder / "pack"
    pack.mkdir()
    (pack / "faulty.py").write_text(RULE.format(problem=problem), encoding="utf-8")
    write(folder / "stages", one=volume("a"), two=volume("b"))
    ran = run(
        "--isolated",
        "--pack",
        pack,
        "--select",
        "FLT",
        "--output-format",
        "json",
        "stages",
        cwd=folder,
    )
    return ran.code, [
        (each["code"], each["prim"], each["message"], tuple(each["times"]))
        for stage in ran.stages
        for each in stage["findings"]
    ]


def test_times_may_be_any_sequence(tmp_path: Path) -> None:
    assert findings(tmp_path, "'seen', at=volume.GetAttribute('extent'), times=[1, 2]") == (
        0,
        [("FLT001", "/a", "seen", (1, 2)), ("FLT001", "/b", "seen", (1, 2))],
    )


@pytest.mark.parametrize(
    "problem",
    ["5, at=volume", "'seen', at=volume, suggestion=5", "'seen', at=volume, subject=5"],
)
def test_what_is_no_text_is_a_fault_of_the_rule(problem: str, tmp_path: Path) -> None:
    said = (
        "rule FLT001 (faulty) failed here: TypeError: message, suggestion and subject of a problem "
        "are text"
    )
    assert findings(tmp_path, problem) == (
        2,
        [("LNT002", "/a", said, ()), ("LNT002", "/b", said, ())],
    )


def test_what_no_finding_can_be_made_of_takes_no_other_along(tmp_path: Path) -> None:
    """Findings are made in batches: those beside it stand, and the rule failed on one prim."""
    pack = tmp_path / "pack"
    pack.mkdir()
    severity = "'high' if volume.GetName() == 'v90' else None"
    problem = f"'seen', at=volume, severity={severity}"
    (pack / "faulty.py").write_text(RULE.format(problem=problem), encoding="utf-8")
    volumes = "".join(f'def Volume "v{number}"\n{{\n}}\n' for number in range(100))
    (tmp_path / "many.usda").write_text(f"#usda 1.0\n{volumes}", encoding="utf-8")
    shown = ("--select", "FLT", "--output-format", "json", "many.usda")
    ran = run("--isolated", "--pack", pack, *shown, cwd=tmp_path)
    found = [(each["code"], each["prim"]) for each in ran.stages[0]["findings"]]
    seen = [("FLT001", f"/v{number}") for number in range(100) if number != 90]
    assert sorted(found) == sorted([*seen, ("LNT002", "/v90")])


@pytest.mark.parametrize(
    ("text", "encoding"),
    [
        ("Path(__file__).parents[1].joinpath('notes.txt').read_text('utf-8')", "utf-8"),
        ("b'\\xe4'.decode('ascii')", "ascii"),
    ],
)
def test_text_that_a_rule_fails_to_decode_is_its_own_fault(
    text: str, encoding: str, tmp_path: Path
) -> None:
    """That of a stage that USD fails to decode is the stage's: LNT001."""
    (tmp_path / "notes.txt").write_bytes(b"\xe4")
    code, found = findings(tmp_path, text.replace("Path", "__import__('pathlib').Path"))
    said = f"rule FLT001 (faulty) failed here: UnicodeDecodeError: '{encoding}' codec can't decode"
    assert (code, [each[0] for each in found]) == (2, ["LNT002", "LNT002"])
    assert all(each[2].startswith(said) for each in found)


def test_a_problem_that_can_not_say_whether_it_holds_is_reported_and_so_is_that(
    tmp_path: Path,
) -> None:
    said = "rule FLT001 (faulty) failed here: ZeroDivisionError: division by zero"
    code, found = findings(tmp_path, "'seen', at=volume, holds=lambda: 1 / 0")
    assert (code, sorted(found)) == (
        2,
        [
            ("FLT001", "/a", "seen", ()),
            ("FLT001", "/b", "seen", ()),
            ("LNT002", "/a", said, ()),
            ("LNT002", "/b", said, ()),
        ],
    )


INTERRUPT = """
def interrupt(*ignored):
    raise KeyboardInterrupt("stop")

"""


@pytest.mark.parametrize(
    ("rule", "said"),
    [
        (RULE.format(problem="'seen', at=interrupt()"), "rule FLT001 (faulty) failed here: "),
        (
            RULE.format(problem="'seen', at=volume, holds=interrupt"),
            "rule FLT001 (faulty) failed here: ",
        ),
        (
            RULE.format(problem="'seen', at=volume").replace(
                "severity=", "when=When(Prims.authored, interrupt), severity="
            ),
            "the precondition of rule FLT001 (faulty) failed, so the rule looked at every prim "
            "that it asks for: ",
        ),
    ],
    ids=["check", "holds", "when"],
)
def test_an_interrupt_that_a_rule_raises_is_its_own(rule: str, said: str, tmp_path: Path) -> None:
    """Neither the user nor USD is to blame, and what else there is stands."""
    (tmp_path / "faulty.py").write_text(
        f"from usdvol_lint.rule import Prims, When\n{INTERRUPT}{rule}", encoding="utf-8"
    )
    stages = write(tmp_path / "stages", one=volume("a"))
    ran = run("--isolated", "--pack", tmp_path, "--output-format", "json", stages, cwd=tmp_path)
    [stage] = ran.stages
    assert (ran.code, stage["status"]) == (2, "checked")
    assert f"{said}KeyboardInterrupt: stop" in [each["message"] for each in stage["findings"]]


@pytest.mark.parametrize("on", ["5", "['Volume']", "('Volume', 5)", "('Volume', '')"])
def test_types_that_are_none(on: str, tmp_path: Path) -> None:
    rule = RULE.format(problem="'seen', at=volume").replace('on="Volume"', f"on={on}")
    (tmp_path / "faulty.py").write_text(rule, encoding="utf-8")
    with pytest.raises(PackError, match="FLT001: `on` is the name of a type or a tuple of such, "):
        load([str(tmp_path)])


def test_a_precondition_that_is_none(tmp_path: Path) -> None:
    rule = RULE.format(problem="'seen', at=volume").replace(
        'on="Volume"', 'on="Volume", when="authored"'
    )
    (tmp_path / "faulty.py").write_text(rule, encoding="utf-8")
    with pytest.raises(PackError, match="FLT001: `when` takes a When, not 'authored'"):
        load([str(tmp_path)])


def on(folder: Path, *types: str) -> Path:
    """A pack with a rule for these types, or for one."""
    pack = folder / "pack"
    pack.mkdir()
    text = RULE.format(problem="'seen', at=volume").replace('"Volume"', repr(types))
    (pack / "faulty.py").write_text(text, encoding="utf-8")
    return pack


@pytest.mark.parametrize(
    ("types", "meant"),
    [
        (("Volumee",), "Volume"),
        (("volume",), "Volume"),
        (("Volume", "OpenVDBAset"), "OpenVDBAsset"),
        (("UsdVolVolume",), "Volume"),
        (("UsdGeomXform",), "Xform"),
        (("MaterialBindngAPI",), "MaterialBindingAPI"),
    ],
)
def test_a_type_by_a_misspelt_name(types: tuple[str, ...], meant: str, tmp_path: Path) -> None:
    """It is an error, also with `--test`, which the USD that is installed finds."""
    stages = write(tmp_path / "stages", one=volume("a"))
    ran = run("--isolated", "--pack", on(tmp_path, *types), stages, cwd=tmp_path)
    assert (ran.code, ran.out) == (2, "")
    assert ran.err == (
        f"usdvol-lint: error: rule FLT001 (faulty) is on {types[-1]!r}, which no schema is called; "
        f"did you mean {meant!r}?\n"
    )


@pytest.mark.parametrize("jobs", [1, 2])
@pytest.mark.parametrize(
    ("types", "message", "advice"),
    [
        (("StudioFlame",), "is called 'StudioFlame'", ""),
        (("MyVolume", "FX2"), "is called 'MyVolume' or 'FX2'", "; did you mean 'Volume'?"),
        (("Volume2",), "is called 'Volume2'", "; did you mean 'Volume'?"),
    ],
)
def test_types_that_only_a_plugin_has(
    types: tuple[str, ...], message: str, advice: str, jobs: int, tmp_path: Path
) -> None:
    """Where it is not installed that is one cause in a run, for the rule finds nothing."""
    stages = write(tmp_path / "stages", one=volume("a"), two=volume("b"))
    pack = on(tmp_path, *types)
    ran = run(
        *("--isolated", "--pack", pack, "--select", "FLT,LNT", "--output-format", "json"),
        *(f"-j{jobs}", stages),
        cwd=tmp_path,
    )
    [found] = ran.json["causes"]
    assert (ran.code, found["code"], found["severity"]) == (0, "LNT005", "info")
    assert found["source"]["layer"] is None
    assert found["source"]["subject"] == "FLT001"
    assert [place["stage"] for place in found["places"]] == [0, 1]
    assert found["message"] == (
        f"rule FLT001 (faulty) looked at nothing: no schema that is installed here {message}"
    )
    assert found["suggestion"] == f"install the plugin that has it, or correct the rule{advice}"


def test_a_type_beside_others_that_only_a_plugin_has(tmp_path: Path) -> None:
    """The rule finds less than it should, which is no less silent."""
    stages = write(tmp_path / "stages", one=volume("a"))
    pack = on(tmp_path, "Volume", "StudioFlame")
    chosen = ("--select", "FLT,LNT", "--output-format", "json")
    ran = run("--isolated", "--pack", pack, *chosen, stages, cwd=tmp_path)
    assert {cause["code"]: cause["message"] for cause in ran.json["causes"]} == {
        "FLT001": "seen",
        "LNT005": "rule FLT001 (faulty) looked at less than it asks for: no schema that is "
        "installed here is called 'StudioFlame'",
    }


@pytest.mark.parametrize("types", [("Volume", "OpenVDBAsset"), ("Xform",), ("ParticleField",)])
def test_a_rule_that_has_something_to_look_at_says_nothing_of_it(
    types: tuple[str, ...], tmp_path: Path
) -> None:
    stages = write(tmp_path / "stages", one=volume("a"))
    chosen = ("--select", "FLT,LNT", "--show", "info")
    ran = run("--isolated", "--pack", on(tmp_path, *types), *chosen, stages, cwd=tmp_path)
    assert ran.code == 0
    assert "looked at nothing" not in ran.out


@pytest.mark.parametrize(
    ("old", "new", "said"),
    [
        (
            "severity=INFO",
            "severity='warning'",
            "FLT001: `severity` is ERROR, WARNING or INFO, not 'w",
        ),
        ('since="1"', "since=1", "FLT001: `since` is a text such as '0.1', not 1"),
        ('"FLT001"', "1", "the code of a rule is a text such as 'STU001', not 1"),
        ("def faulty", "def", "SyntaxError: "),
        ('"FLT001"', '"FL1"', "a code is three capitals and three digits, not 'FL1'"),
        ('"FLT001"', '"AST002"', "AST002 (faulty) takes the code or name of another rule"),
        ("@rule", "# rule", "holds no rule: "),
    ],
)
def test_a_pack_that_can_not_be_loaded_is_named_with_who_names_it(
    old: str, new: str, said: str, tmp_path: Path
) -> None:
    text = RULE.format(problem="'seen', at=volume").replace(old, new)
    if new == "# rule":
        text = text.replace("rule(", "(")
    (tmp_path / "pack").mkdir()
    (tmp_path / "pack" / "faulty.py").write_text(text, encoding="utf-8")
    (tmp_path / "own.toml").write_text("packs = ['pack']", encoding="utf-8")
    with pytest.raises(PackError) as caught:
        load_for(read_config(tmp_path / "own.toml"))
    assert str(caught.value).startswith(f"{tmp_path / 'own.toml'}: packs: ")
    assert said in str(caught.value)
    assert "faulty" in str(caught.value) or "pack'" in str(caught.value)
