"""What is inside the files that fields name: read once, and as far as it is asked for."""

from __future__ import annotations

import os
import random
from collections import Counter
from pathlib import Path

import pytest
import vdbwriter as w
from gridtexts import DENSITY, Lint, density, field, grid, said, stage

from usdvol_lint.config import Config, Depth
from usdvol_lint.engine.engine import Engine
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.volumefile import window
from usdvol_lint.volumefile.cache import VolumeFiles


def engine(catalog: Catalog, content: str = "all") -> Engine:
    return Engine(catalog.rules, activate(Config(select=("ALL",)), catalog), Depth(content=content))


@pytest.fixture
def opened(monkeypatch: pytest.MonkeyPatch) -> Counter[str]:
    """How often each volume file was opened, and how often it was read from, by its name."""
    counts: Counter[str] = Counter()
    names: dict[int, str] = {}
    genuine_open, genuine_read = os.open, os.read

    def counting_open(path: str, flags: int) -> int:
        descriptor = genuine_open(path, flags)
        names[descriptor] = os.path.basename(path)
        counts[f"open {names[descriptor]}"] += 1
        return descriptor

    def counting_read(descriptor: int, count: int) -> bytes:
        counts[f"read {names[descriptor]}"] += 1
        return genuine_read(descriptor, count)

    monkeypatch.setattr(window.os, "open", counting_open)
    monkeypatch.setattr(window.os, "read", counting_read)
    return counts


def test_a_file_is_read_once(catalog: Catalog, tmp_path: Path, opened: Counter[str]) -> None:
    """However many fields, frames and stages name it, and by whatever path."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid(), grid("heat")))
    (tmp_path / "link.vdb").symlink_to("a.vdb")
    heat = field("heat", "asset filePath = @./a.vdb@", 'token fieldName = "heat"', *DENSITY[1:])
    text = stage(density("./a.vdb", "./link.vdb", "./a.vdb"), heat)
    linter = engine(catalog)
    for name in ("one.usda", "two.usda"):
        (tmp_path / name).write_text(text, encoding="utf-8")
        assert said(linter.lint(str(tmp_path / name))) == []
    assert opened["read a.vdb"] + opened["read link.vdb"] == 1
    assert opened == {"open a.vdb": 2, "open link.vdb": 2, "read a.vdb": 1}


def test_a_file_that_changed_is_read_again(tmp_path: Path) -> None:
    path = tmp_path / "a.vdb"
    files = VolumeFiles()
    path.write_bytes(w.vdb(grid()))
    first = files.read(str(path)).file
    path.write_bytes(w.vdb(grid("Density")))
    os.utime(path, ns=(1, 1))
    second = files.read(str(path)).file
    assert [file and file.grids[0].name for file in (first, second)] == ["density", "Density"]


def test_how_much_is_looked_into(catalog: Catalog, tmp_path: Path, opened: Counter[str]) -> None:
    for frame, name in enumerate(("Density", "density", "Density"), start=1):
        (tmp_path / f"{frame}.vdb").write_bytes(w.vdb(grid(name)))
    (tmp_path / "a.usda").write_text(stage(density("./gone.vdb", "./1.vdb", "./2.vdb", "./3.vdb")))
    found = {}
    for content in ("all", "first", "off"):
        found[content] = said(engine(catalog, content).lint(str(tmp_path / "a.usda")))
    message = "no grid 'density' in './1.vdb', which holds 'Density'"
    assert found == {
        "all": [
            ("GRD003", "2, 4", f"{message} (2 of 4 samples)"),
        ],
        "first": [("GRD003", "2", f"{message} (1 of 1 samples)")],
        "off": [],
    }
    assert opened["open 1.vdb"] == 2
    assert opened["open 2.vdb"] == 1


def test_without_a_look_nothing_is_known(catalog: Catalog, tmp_path: Path) -> None:
    """The only grid, which a field without a name misses, is named only where the file is read."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid()))
    unnamed = field("density", "asset filePath = @./a.vdb@", *DENSITY[1:])
    (tmp_path / "a.usda").write_text(stage(unnamed))
    for content, names_grid in (("all", True), ("first", True), ("off", False)):
        report = engine(catalog, content).lint(str(tmp_path / "a.usda"))
        [finding] = [each for each in report.findings if each.severity.label != "info"]
        assert (finding.code, "the only grid" in str(finding.suggestion)) == ("FLD001", names_grid)


def test_what_the_field_says_may_change_between_files(lint_text: Lint, tmp_path: Path) -> None:
    """A file holds until the next, and what the field says of it is held against it meanwhile."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid("a"), grid("b", "vec3s")))
    report = lint_text(
        stage(
            field(
                "density",
                "asset filePath = @./a.vdb@",
                'token fieldName.timeSamples = {\n1: "a",\n5: "b",\n9: "c",\n}',
                'token fieldDataType = "float"',
            )
        )
    )
    assert said(report) == [
        ("GRD003", "9", "no grid 'c' in './a.vdb', which holds 'a', 'b' (1 of 3 samples)"),
        (
            "GRD005",
            "5",
            "fieldDataType is 'float', but grid 'b' in './a.vdb' holds vec3s (1 of 3 samples)",
        ),
    ]


def test_one_fault_is_one_finding(lint_text: Lint, tmp_path: Path) -> None:
    """Numbers in what is wrong may differ from frame to frame."""
    whole = w.vdb(grid())
    for number in range(1, 101):
        (tmp_path / f"{number}.vdb").write_bytes(whole[: -number - 1] if number % 2 else whole)
    report = lint_text(stage(density(*(f"./{number}.vdb" for number in range(1, 101)))))
    [(code, frames, message)] = said(report)
    assert (code, frames) == ("GRD002", "1-99x2")
    assert message.endswith("(50 of 100 samples)")


def test_hostile_files_cost_neither_time_nor_memory(lint_text: Lint, tmp_path: Path) -> None:
    choose = random.Random(11)
    whole = w.vdb(grid(), grid("heat"))
    for number in range(300):
        content = bytearray(whole)
        content[choose.randrange(12, len(content) - 200)] = choose.randrange(256)
        (tmp_path / f"{number}.vdb").write_bytes(content)
    report = lint_text(stage(density(*(f"./{number}.vdb" for number in range(300)))))
    assert "LNT002" not in {finding.code for finding in report.findings}
    assert len(report.findings) < 60
    assert max(len(finding.message) for finding in report.findings) < 600


@pytest.mark.parametrize("index", ["bool fieldIndex = true", "double fieldIndex = 1"])
def test_an_index_that_is_no_integer_is_none(index: str, lint_text: Lint, tmp_path: Path) -> None:
    """Its type is a finding, and nobody looks for a second grid."""
    (tmp_path / "a.vdb").write_bytes(w.vdb(grid("density")))
    text = stage(density("./a.vdb").replace("token fieldName", f"{index}\n token fieldName"))
    assert index in text
    assert said(lint_text(text), "GRD", "SCH003", "FLD003", "FLD007") == [
        (
            "SCH003",
            None,
            f"'{index.partition(' =')[0]}' where the schema declares 'int fieldIndex'",
        )
    ]


def test_names_of_any_bytes(lint_text: Lint, tmp_path: Path) -> None:
    """They are quoted, and the report can be written."""
    odd = w.Grid(b"d\xe9nsit\xe9", metadata={"name": w.string(b"d\xe9nsit\xe9")})
    (tmp_path / "a.vdb").write_bytes(w.vdb(odd, *(grid(f"g{n}" + "x" * 300) for n in range(20))))
    [(_, _, message)] = said(lint_text(stage(density("./a.vdb"))), "GRD003")
    assert "'d\\xe9nsit\\xe9'" in message
    assert message.encode()
    assert message.endswith("…', 14 more (1 of 1 samples)")


def test_third_party_fields_are_left_alone(lint_text: Lint, tmp_path: Path) -> None:
    """Nobody knows what files their types want."""
    (tmp_path / "a.nurec").write_bytes(b"nothing we know")
    report = lint_text(
        stage(field("density", "asset filePath = @./a.nurec@", kind="OmniNuRecFieldAsset"))
    )
    assert said(report, "GRD") == []
