"""What resolvers answer, and where a path is searched for."""

from __future__ import annotations

import os
import shutil
from collections.abc import Callable
from pathlib import Path

import pytest
from pxr import Ar
from stages import CONTENT, package, said, volume, write

import usdvol_lint.facts.files.classify as classify
from usdvol_lint.engine.engine import Engine
from usdvol_lint.model import StageReport

Lint = Callable[..., StageReport]


@pytest.mark.skipif(os.name == "nt", reason="names have no colons here")
@pytest.mark.parametrize(
    ("path", "expected"),
    [
        ("op:/obj/pyro/OUT.vdb", []),
        ("op:/obj/pyro/OUT.vdb:SDF_FORMAT_ARGS:a=b", []),
        ("op:/obj/pyro/OUT", ["AST006"]),
        ("op:/obj/pyro/empty.vdb", ["AST005"]),
        ("op:/obj/pyro/GONE.vdb", ["AST010"]),
        ("asset:smoke.vdb", []),
        ("asset:gone.vdb", ["AST010"]),
    ],
)
def test_a_resolver_that_answers_for_what_looks_like_a_uri(
    path: str, expected: list[str], lint_text: Lint, assets: Path, tmp_path: Path
) -> None:
    """USD's own does, where its search path leads to such a file."""
    for name in ("op:/obj/pyro/OUT.vdb", "op:/obj/pyro/OUT", "asset:smoke.vdb"):
        (tmp_path / "search" / name).parent.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(assets / "cloud.vdb", tmp_path / "search" / name)
    (tmp_path / "search/op:/obj/pyro/empty.vdb").touch()
    Ar.DefaultResolver.SetDefaultSearchPath([str(tmp_path / "search")])
    try:
        found = lint_text(volume(f"asset filePath = @{path}@")).findings
    finally:
        Ar.DefaultResolver.SetDefaultSearchPath([])
    assert [each.code for each in found] == expected


def test_what_a_resolver_that_is_registered_does_not_find(
    lint_text: Lint, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It is missing, and nothing else is known of it; no wheel of USD has such a resolver."""
    monkeypatch.setattr(Ar, "GetRegisteredURISchemes", lambda: ["asset"])
    paths = ("asset://show/fx/smoke.vdb", "asset:smoke.vdb", "ASSET://show/fx/smoke.0001.vdb")
    one, *others = (volume(f"asset filePath = @{path}@") for path in paths)
    for number, other in enumerate(others):
        one += other.replace("cloud", f"cloud_{number}").replace("#usda 1.0", "")
    assert said(lint_text(one)) == [
        f"AST002 no file at {path!r} -> write or copy it there, or name a file that is there"
        for path in paths
    ]


@pytest.mark.parametrize(("resolved", "expected"), [("a.vdb", []), ("a", ["AST006"])])
@pytest.mark.parametrize("path", ["./a.vdb", "asset:a", "./a"])
def test_the_extension_that_counts_is_that_of_what_a_resolver_answers(
    path: str,
    resolved: str,
    expected: list[str],
    lint_text: Lint,
    assets: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    answer = str(shutil.copyfile(assets / "cloud.vdb", tmp_path / resolved))
    monkeypatch.setattr(classify, "_resolved_anew", lambda *asked: answer)
    report = lint_text(volume(f"asset filePath = @{path}:SDF_FORMAT_ARGS:a=b.vdb@"))
    assert [each.code for each in report.findings] == expected


def test_a_path_in_a_package_may_have_format_arguments(lint_text: Lint, tmp_path: Path) -> None:
    package(tmp_path / "shot.usdz", "#usda 1.0\n", {"a.vdb": CONTENT})
    path = "./shot.usdz[a.vdb]:SDF_FORMAT_ARGS:b=c"
    assert said(lint_text(volume(f"asset filePath = @{path}@"))) == []


@pytest.mark.parametrize("where", [".", "elsewhere"])
def test_the_search_path_begins_with_the_folder_of_the_stage(
    where: str, engine: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A path without `./` in a layer of another folder, from whatever working directory."""
    write(tmp_path, "shot/cloud.vdb")
    for name, text in {
        "shot/root.usda": "#usda 1.0\n(\n    subLayers = [@./fx/smoke.usda@]\n)\n",
        "shot/fx/smoke.usda": volume("asset filePath = @cloud.vdb@"),
    }.items():
        (tmp_path / name).parent.mkdir(exist_ok=True)
        (tmp_path / name).write_text(text, encoding="utf-8")
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / where)
    assert said(engine.lint(str(tmp_path / "shot" / "root.usda"))) == []
