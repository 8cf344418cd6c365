"""A studio's own rules are rules like any others, wherever their folder lies."""

from __future__ import annotations

import os
import shutil
from pathlib import Path

import pytest
from process import ROOT, STUDIO, Ran, environment, run, volume, write

from usdvol_lint import lint
from usdvol_lint.config import Config
from usdvol_lint.model import PackError, UsageError
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import load

WRONG = "fog.usda:2:1: STU001 error </fog> name 'fog', wanted smoke, fire\n"
CONCISE = ("--output-format", "concise", "--select", "STU001")
PAGE = (STUDIO / "house" / "volume_name.md").read_text(encoding="utf-8")


@pytest.fixture
def show(tmp_path: Path) -> Path:
    """A folder with one stage, which the studio's rules find something in."""
    return write(tmp_path / "show", fog=volume("fog"))


def configure(folder: Path, text: str) -> None:
    (folder / "usdvol-lint.toml").write_text(text, encoding="utf-8")


def test_a_folder_on_the_command_line(show: Path) -> None:
    assert run("--isolated", "--pack", STUDIO, *CONCISE, ".", cwd=show) == Ran(1, WRONG, "")
    relative = os.path.relpath(STUDIO, show)
    assert run("--isolated", "--pack", relative, *CONCISE, ".", cwd=show) == Ran(1, WRONG, "")


def test_a_folder_in_the_configuration_is_relative_to_it(show: Path) -> None:
    shutil.copytree(STUDIO, show.parent / "rules")
    configure(show.parent, 'packs = ["rules"]\n')
    named = ("--config", "../usdvol-lint.toml")
    assert run(*named, *CONCISE, ".", cwd=show) == Ran(1, WRONG, "")
    assert run(*named, "--explain", "volume-name", cwd=show) == Ran(0, PAGE, "")


def test_folders_add_up(show: Path, tmp_path: Path) -> None:
    other = write(tmp_path / "other")
    (other / "named.py").write_text(
        "from usdvol_lint.rule import INFO, Problem, rule\n"
        "@rule('OTH001', on='Volume', severity=INFO, since='1')\n"
        "def named(volume, facts):\n"
        "    yield Problem('named', at=volume)\n"
    )
    configure(show, f"packs = ['{STUDIO}']\nselect = ['STU001', 'OTH']\n")
    packs = ("--config", "usdvol-lint.toml", "--pack", other)
    ran = run(*packs, "--output-format", "concise", "--show", "info", ".", cwd=show)
    assert ran == Ran(1, "fog.usda:2:1: OTH001 info </fog> named\n" + WRONG, "")


def test_an_installed_pack(show: Path, tmp_path: Path) -> None:
    """A package that some distribution names by an entry point; nobody has to ask for it."""
    site = tmp_path / "site"
    shutil.copytree(STUDIO, site / "studio_rules")
    (site / "studio_rules" / "__init__.py").touch()
    info = site / "studio_rules-1.0.dist-info"
    info.mkdir()
    (info / "METADATA").write_text("Metadata-Version: 2.1\nName: studio-rules\nVersion: 1.0\n")
    (info / "entry_points.txt").write_text("[usdvol_lint.packs]\nstudio = studio_rules\n")
    env = environment(PYTHONPATH=os.pathsep.join([str(ROOT), str(site)]))
    isolated = ("--isolated", *CONCISE, ".")
    assert run(*isolated, cwd=show, env=env) == Ran(1, WRONG, "")
    assert run("--explain", "STU001", cwd=show, env=env) == Ran(0, PAGE, "")
    again = ("--isolated", "--pack", site / "studio_rules", *CONCISE, ".")
    assert run(*again, cwd=show, env=env) == Ran(1, WRONG, "")
    listed = run("--list-rules", cwd=show, env=env).out
    assert "STU001  error        volume-name" in listed

    (info / "entry_points.txt").write_text("[usdvol_lint.packs]\nstudio = gone.rules\n")
    said = "usdvol-lint: error: rule pack 'studio': there is no package 'gone.rules'\n"
    assert run(*isolated, cwd=show, env=env) == Ran(2, "", said)


@pytest.mark.parametrize(
    ("options", "found"),
    [
        ("", "name 'fog', wanted smoke, fire"),
        ('allowed = ["fog"]', None),
        ('allowed = ["fog"]\nlongest = 2', "name 'fog', wanted fog"),
        ('allowed = ["fog"]\nlongest = 2\nshare = 1.5', None),
        ('allowed = ["fog"]\nlongest = 3\nshare = 1', None),
        ('allowed = ["g"]\nprefix = "fo"', None),
        ("strict = true", "name 'fog', wanted smoke, fire"),
    ],
)
def test_options_reach_the_rule(options: str, found: str | None, show: Path) -> None:
    configure(show, f"packs = ['{STUDIO}']\nselect = ['STU001']\n[options.volume-name]\n{options}")
    ran = run("--config", "usdvol-lint.toml", "--output-format", "json", ".", cwd=show)
    messages = [f["message"] for stage in ran.stages for f in stage["findings"]]
    assert messages == ([found] if found else [])


@pytest.mark.parametrize(
    ("rule", "option", "value", "said"),
    [
        (
            "volum-name",
            "strict",
            True,
            "options.volum-name: no rule 'volum-name'; did you mean 'volume-name'?",
        ),
        (
            "volume-name",
            "alowed",
            ["fog"],
            "options.volume-name.alowed: volume-name has no option 'alowed'; "
            "did you mean 'allowed'?",
        ),
        (
            "STU001",
            "allowed",
            "fog",
            "options.STU001.allowed must be a list of strings, not 'fog'",
        ),
        (
            "STU001",
            "allowed",
            [1],
            "options.STU001.allowed must be a list of strings, not [1]",
        ),
        ("STU001", "prefix", 1, "options.STU001.prefix must be a string, not 1"),
        ("STU001", "longest", 1.5, "options.STU001.longest must be a whole number, not 1.5"),
        (
            "STU001",
            "longest",
            True,
            "options.STU001.longest must be a whole number, not True",
        ),
        ("STU001", "share", "1", "options.STU001.share must be a number, not '1'"),
        ("STU001", "share", False, "options.STU001.share must be a number, not False"),
        ("STU001", "strict", 1, "options.STU001.strict must be true or false, not 1"),
        ("STU002", "strict", True, "options.STU002.strict: volume-seen has no option 'strict'"),
    ],
)
def test_options_are_checked(rule: str, option: str, value: object, said: str) -> None:
    with pytest.raises(UsageError) as raised:
        activate(Config(options={rule: {option: value}}), load([str(STUDIO)]))
    assert str(raised.value) == said


def test_options_by_code_and_by_name_add_up() -> None:
    options = {"volume-name": {"prefix": "x", "longest": 3}, "STU001": {"strict": True}}
    active = activate(Config(options=options), load([str(STUDIO)]))
    assert active.options == {"STU001": {"prefix": "x", "longest": 3, "strict": True}}


def test_packs_with_modules_of_the_same_name(tmp_path: Path) -> None:
    """Also one after the other in one process, as a library is used."""
    for number in (1, 2):
        folder = write(tmp_path / str(number) / "family")
        (folder / "_words.py").write_text(f"WORD = 'word {number}'\n")
        (folder / "checks.py").write_text(
            "from usdvol_lint.rule import INFO, Problem, rule\n"
            "from ._words import WORD\n"
            f"@rule('TWO00{number}', on='Volume', severity=INFO, since=WORD)\n"
            f"def checks_{number}(volume, facts):\n"
            "    yield Problem(WORD, at=volume)\n"
        )
    one, two = (str(tmp_path / number) for number in "12")
    for packs in ([one], [two], [one, two], [two, one, two]):
        rules = [rule for code, rule in load(packs).rules.items() if code.startswith("TWO")]
        expected = [f"word {number}" for number in (1, 2) if str(tmp_path / str(number)) in packs]
        assert [rule.since for rule in rules] == expected


def test_an_edited_pack_is_read_anew(show: Path, tmp_path: Path) -> None:
    """By the process that calls `lint` too, which says severities and knows options."""
    module = write(tmp_path / "pack") / "edited.py"
    found = []
    for level, option in (("INFO", "one"), ("ERROR", "second")):
        module.write_text(
            f"from usdvol_lint.rule import {level}, Problem, rule\n"
            f"@rule('EDT001', on='Volume', severity={level}, since='1')\n"
            f"def edited(volume, facts, *, {option}: int = 3):\n"
            f"    yield Problem(f'{option} is {{{option}}}', at=volume)\n"
        )
        options = {"EDT001": {option: 4}}
        config = Config(select=("EDT",), packs=(str(module.parent),), jobs=1, options=options)
        causes = lint([str(show)], config).causes
        found += [(cause.severity.label, cause.first.message) for cause in causes]
    assert found == [("info", "one is 4"), ("error", "second is 4")]


def test_a_page_that_can_not_be_read(tmp_path: Path) -> None:
    shutil.copytree(STUDIO, tmp_path / "pack")
    page = tmp_path / "pack" / "house" / "volume_name.md"
    page.write_text("no title\n")
    catalog = load([str(tmp_path / "pack")])
    with pytest.raises(PackError, match=r"volume_name\.md: the page must begin with '# name \(C"):
        catalog.page("STU001")
    page.write_bytes(b"# \xff")
    with pytest.raises(PackError, match=r"volume_name\.md: 'utf-8' codec can't decode"):
        catalog.page("STU001")
