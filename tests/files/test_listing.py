"""Which stages arguments lead to: files, folders, patterns, links, and what is left out."""

from __future__ import annotations

import os
from collections.abc import Sequence
from pathlib import Path

import pytest

from usdvol_lint.config import Glob
from usdvol_lint.files import Listed
from usdvol_lint.files.listing import list_stages
from usdvol_lint.model import UsageError
from usdvol_lint.words import quoted

LINKS = pytest.mark.skipif(os.name == "nt", reason="needs symbolic links")


@pytest.fixture(autouse=True)
def _here(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)


def touch(*names: str) -> None:
    for name in names:
        Path(name).parent.mkdir(parents=True, exist_ok=True)
        Path(name).touch()


def found(*paths: str, exclude: Sequence[str] = (), stages: Sequence[str] = ()) -> list[str]:
    """The stages, with `/`, and a `part` after those that are parts."""
    globs = [Glob(".", pattern) for pattern in exclude]
    listing = list_stages(paths, globs, [Glob(".", pattern) for pattern in stages])
    return [_shown(stage) for stage in listing.stages]


def _shown(stage: Listed) -> str:
    return Path(stage.path).as_posix() + " part" * stage.is_part


def refused(*paths: str, **globs: Sequence[str]) -> str:
    with pytest.raises(UsageError) as caught:
        found(*paths, **globs)
    return str(caught.value)


@pytest.mark.parametrize(
    ("paths", "expected"),
    [
        ("shots", "shots/a/shot.usda shots/b/shot.usda"),
        ("shots/b shots", "shots/a/shot.usda shots/b/shot.usda"),
        ("shots a.usda", "a.usda shots/a/shot.usda shots/b/shot.usda"),
        ("a.usda shots/../a.usda ./a.usda", "a.usda"),
        (".", "a.USDZ a.usda shots/a/shot.usda shots/b/shot.usda"),
        ("shots/**/*.usda", "shots/a/shot.usda shots/b/shot.usda"),
        ("./shots/**/*.usda", "shots/a/shot.usda shots/b/shot.usda"),
        ("**/*.usda", "a.usda shots/a/shot.usda shots/b/shot.usda"),
        ("**", "a.USDZ a.usda shots/a/shot.usda shots/b/shot.usda"),
        ("shots/[b-z]", "shots/b/shot.usda"),
        ("s*s/?/shot.usd[ac]", "shots/a/shot.usda shots/b/shot.usda"),
        ("shots/*/shot.usda shots/a/*", "shots/a/shot.usda shots/b/shot.usda"),
        ("*", "a.USDZ a.usda shots/a/shot.usda shots/b/shot.usda"),
        (".hidden/*.usda", ".hidden/b.usda"),
        (".hid*/*", ".hidden/b.usda"),
    ],
)
def test_arguments(paths: str, expected: str) -> None:
    touch("a.usda", "a.USDZ", "notes.txt", "shots/a/shot.usda", "shots/b/shot.usda")
    touch(".hidden/b.usda", "shots/.c.usda")
    assert found(*paths.split()) == expected.split()


def test_a_file_that_looks_like_a_pattern_comes_first() -> None:
    touch("a[1].usda", "a1.usda")
    assert found("a[1].usda") == ["a[1].usda"]
    assert found("a[12].usda") == ["a1.usda"]


def test_what_leads_nowhere_is_told_at_once() -> None:
    touch("shots/a.usda", "empty/notes.txt")
    said = refused("shot", "", "shots/b.usd", "gone/*.usda", "empty", "shots", "xyzzy")
    assert said == (
        "no such file or folder: 'shot' (did you mean 'shots'?); an argument is empty; "
        f"no such file or folder: 'shots/b.usd' (did you mean 'shots{os.sep}a.usda'?)"
        "; 'gone/*.usda' matches no stage; "
        "'empty' holds no stage (.usd, .usda, .usdc, .usdz), hidden ones aside; "
        "no such file or folder: 'xyzzy'"
    )
    assert refused(*map(str, range(12))).endswith("; and 2 more")
    for name in ("x" * 5000, "shots/" * 1000):
        assert refused(f"{name}/a.usda").startswith("no such file or folder: ")


def test_the_nearest_folder_is_offered_with_what_is_in_it() -> None:
    touch("shots/deep/a.usda")
    meant = os.path.join("shots", "deep", "a.usda")
    assert refused("shts/deep/a.usda").endswith(f"(did you mean '{meant}'?)")


@LINKS
def test_links_are_followed_by_what_they_are() -> None:
    touch("v001/a.usda", "v002/a.usda", "v002/inner/b.usda")
    Path("current").symlink_to("v002")
    Path("v002/up").symlink_to("..")
    Path("v002/loop").symlink_to("loop")
    Path("alias.usda").symlink_to("v001/a.usda")
    Path("v001/0.usda").symlink_to("a.usda")
    everything = ["alias.usda", "v001/a.usda", "v002/a.usda", "v002/inner/b.usda"]
    assert found(".") == everything
    assert found("current") == ["current/a.usda", "current/inner/b.usda"]
    assert found("current/a.usda", "v002") == ["v002/a.usda", "v002/inner/b.usda"]
    assert found("**/a.usda") == ["v001/a.usda", "v002/a.usda"]
    Path("v002/out.usda").symlink_to("../v001/a.usda")
    Path("v002/outside").symlink_to("../v001")
    everything = ["a.usda", "inner/b.usda", "out.usda", "outside/a.usda"]
    assert found("current", "v002") == [f"v002/{name}" for name in everything]
    assert found("current/out.usda", "v002/out.usda") == ["v002/out.usda"]


@LINKS
def test_a_folder_elsewhere_is_found_through_its_link(tmp_path: Path) -> None:
    touch(".versions/v2/a.usda", "shots/b.usda")
    Path("shots/current").symlink_to(tmp_path / ".versions/v2")
    assert found("shots") == ["shots/b.usda", "shots/current/a.usda"]


@LINKS
def test_a_link_that_leads_nowhere_stays_on_the_list() -> None:
    Path("broken.usda").symlink_to("gone.usda")
    assert found("broken.usda") == ["broken.usda"]


@pytest.mark.parametrize(
    ("exclude", "left"),
    [
        ("*.usdz", "a.usda old/b.usda shots/old/c.usda"),
        ("old", "a.usda"),
        ("/old", "a.usda shots/old/c.usda"),
        ("old/ !shots/old/c.usda", "a.usda"),
        ("old/** !old/b.usda", "a.usda old/b.usda shots/old/c.usda"),
        ("*.usda !a.usda", "a.usda"),
    ],
)
def test_excluded(exclude: str, left: str) -> None:
    """Found or named makes no difference: pre-commit names all."""
    touch("a.usda", "old/b.usda", "shots/old/c.usda")
    patterns = exclude.split()
    if "!shots/old/c.usda" in patterns:
        left = "a.usda shots/old/c.usda"
    assert found(".", exclude=patterns) == left.split()
    assert found("a.usda", "old/b.usda", "shots/old/c.usda", exclude=patterns) == left.split()


def test_excluded_by_absolute_path_and_through_links(tmp_path: Path) -> None:
    touch("here/a.usda", "there/b.usda")
    outside = (tmp_path / "there").as_posix()
    globs = [Glob("here", f"{outside}/**")]
    assert [each.path for each in list_stages(["here", "there"], globs).stages] == [
        os.path.join("here", "a.usda")
    ]


def test_nothing_is_left() -> None:
    touch("a.usda", "old/b.usda")
    for paths in (["."], ["old"], ["a.usda"], ["*.usda"]):
        listing = list_stages(paths, [Glob(".", "*.usda"), Glob(".", "old")])
        assert listing == ((), "every stage is excluded")
    assert list_stages([]) == ((), "the list of files is empty")


def test_wholes_and_parts() -> None:
    touch("shots/a/shot.usda", "shots/a/fx.usda", "assets/b.usda")
    stages = ["shots/**/shot.usda"]
    expected = ["assets/b.usda part", "shots/a/fx.usda part", "shots/a/shot.usda"]
    assert found(".", stages=stages) == expected
    assert found("assets/b.usda", stages=stages) == ["assets/b.usda part"]
    said = refused("assets", stages=stages)
    assert said.startswith("no stage of this run matches 'stages' ('shots/**/shot.usda'), ")
    assert refused("assets/*.usda", stages=stages) == said


@pytest.mark.parametrize("pattern", ["shots/", "shot.usda"])
def test_wholes_that_are_excluded(pattern: str) -> None:
    touch("shots/a/shot.usda", "assets/b.usda")
    said = refused(".", exclude=[pattern], stages=["shots/**/shot.usda"])
    whole = quoted(os.path.join(".", "shots", "a", "shot.usda"))
    assert said.startswith(
        "'exclude' leaves out every stage that matches 'stages' ('shots/**/shot.usda'), such as "
        f"{whole}: correct one of them, "
    )
