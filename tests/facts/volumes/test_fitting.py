"""The extent that is offered to a Volume without one: only where all that it must hold is known."""

from __future__ import annotations

import shutil
from pathlib import Path

import pytest
import vdbwriter
from process import SAMPLES
from volumetexts import LARGE, OPS, SMALL, Lint, only, samples, volume

TODAY = "author extent, at every time at which the shape changes"
GROWING = samples({1: SMALL, 2: LARGE, 3: SMALL})
AROUND_LARGE = "float3[] extent = [(0.05, 0.05, 0.05), (0.75, 0.75, 0.75)]"
AROUND_CLOUD = "float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]"
EMPTY = "./box_growing.0001.vdb"


def offered(text: str, lint: Lint, content: str = "all") -> str | None:
    return only(lint(text, "SCH007", content)).suggestion


@pytest.mark.parametrize(
    "files",
    [
        GROWING,
        f"asset filePath.timeSamples = {{ 1: None, 2: @{LARGE}@, 3: None }}",
        f"asset filePath = @{SMALL}@\n{samples({1: LARGE})}",
        samples({1: EMPTY, 2: LARGE}),
    ],
    ids=["growing", "blocked", "default", "empty"],
)
def test_it_holds_all_grids_at_all_times(files: str, lint: Lint) -> None:
    assert offered(volume("", files), lint) == f"write '{AROUND_LARGE}'"
    assert lint(volume(AROUND_LARGE, files)) == []


def test_it_follows_the_transforms_of_a_field(lint: Lint) -> None:
    written = offered(volume("", more=OPS["wander"]), lint)
    assert written == "write 'float3[] extent = [(0.15, 0.15, 0.15), (4.65, 0.65, 0.65)]'"


@pytest.mark.parametrize(
    "files",
    [
        samples({1: SMALL, 2: "./gone.vdb"}),
        samples({1: SMALL, 2: "./grids/no_grids.vdb"}),
        samples({1: SMALL, 2: ""}),
        samples({1: EMPTY}),
        samples({1: SMALL, 2: "./nostats.vdb"}),
        samples({1: "./far.vdb"}),
        "asset filePath.timeSamples = { 1: None }",
        "",
    ],
    ids=["gone", "no grid", "no path", "empty", "unmeasured", "far", "blocked", "no file"],
)
def test_none_where_a_grid_is_not_known(files: str, lint: Lint) -> None:
    shutil.copy(SAMPLES / "nostats.vdb", ".")
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
    grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.scale(1e38, 1e38, 1e38))
    Path("far.vdb").write_bytes(vdbwriter.vdb(grid))
    assert offered(volume("", files), lint) == TODAY


@pytest.mark.parametrize("content", ["off", "first"])
def test_none_where_not_all_files_are_looked_into(content: str, lint: Lint) -> None:
    assert offered(volume("", GROWING), lint, content) == TODAY


@pytest.mark.parametrize(
    "more",
    [
        "rel field:heat = </cloud/gone>",
        "rel field:heat = [</cloud/density>, </cloud/gone>]",
        "rel field:heat",
        "rel field:heat = None",
        'rel field:heat = </cloud/heat>\n def OpenVDBAsset "heat" {\n}\n',
    ],
    ids=["no field", "several", "no target", "blocked", "no path"],
)
def test_none_where_a_field_is_not_known(more: str, lint: Lint) -> None:
    assert offered(volume(more), lint) == TODAY


@pytest.mark.parametrize(("op", "is_offered"), [("move", False), ("none", True)])
def test_none_where_a_field_does_not_move_with_the_volume(
    op: str, is_offered: bool, lint: Lint
) -> None:
    apart = volume(OPS[op]).replace("</cloud/density>", "</other/density>")
    field = volume("float3[] extent = [(0, 0, 0), (1, 1, 1)]").replace("cloud", "other", 1)
    text = apart + field.replace("</cloud/density>", "</other/density>")
    assert (offered(text, lint) != TODAY) == is_offered


@pytest.mark.parametrize(("count", "is_offered"), [(1, True), (3, True), (4, False)])
def test_each_of_a_few_volumes_has_one(count: int, is_offered: bool, lint: Lint) -> None:
    clouds = [volume("").replace("cloud", f"cloud{number}", 1) for number in range(count)]
    clouds = [text.replace("</cloud", f"</cloud{n}") for n, text in enumerate(clouds)]
    found = lint("".join(clouds), "SCH007")
    advice = f"write '{AROUND_CLOUD}'" if is_offered else TODAY
    assert [(each.site.prim, each.fold, each.suggestion) for each in found] == [
        (f"/cloud{number}", "extent", advice) for number in range(count)
    ]


def test_each_has_its_own(lint: Lint) -> None:
    """Particle fields, however many, and a Volume without files take none away."""
    scans = "".join(f'def ParticleField3DGaussianSplat "s{n}" {{\n}}\n' for n in range(3))
    found = lint(volume("") + scans + 'def Volume "bare" {\n}\n', "SCH007")
    assert {each.site.prim: each.suggestion for each in found} == {
        "/bare": TODAY,
        "/cloud": f"write '{AROUND_CLOUD}'",
        **{f"/s{n}": TODAY for n in range(3)},
    }
