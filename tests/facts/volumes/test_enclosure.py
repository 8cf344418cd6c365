"""Extents held against the grids of their Volume: what is too small, and what is said of it."""

from __future__ import annotations

import math
import shutil
from pathlib import Path

import pytest
import vdbwriter
from process import SAMPLES
from volumetexts import LARGE, OPS, SMALL, Lint, only, samples, volume


def animated(extents: dict[float, str]) -> str:
    return (
        "float3[] extent.timeSamples = {" + "".join(f"{t}: {e}," for t, e in extents.items()) + "}"
    )


UNIT = "[(0, 0, 0), (1, 1, 1)]"
POINT = "[(0, 0, 0), (0, 0, 0)]"
WHOLE = "float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]"
CENTRES = "float3[] extent = [(0.2, 0.2, 0.2), (0.6, 0.6, 0.6)]"

NAMED = 'token fieldName = "density"'


@pytest.mark.parametrize(
    ("extent", "level"),
    [
        (WHOLE, None),
        ("float3[] extent = [(0.150006, 0.15, 0.15), (0.65, 0.65, 0.649994)]", None),
        ("float3[] extent = [(0.15001, 0.15, 0.15), (0.65, 0.65, 0.65)]", "info"),
        (CENTRES, "info"),
        ("float3[] extent = [(0.200006, 0.2, 0.2), (0.6, 0.6, 0.6)]", "info"),
        ("float3[] extent = [(0.20001, 0.2, 0.2), (0.6, 0.6, 0.6)]", "error"),
        (f"float3[] extent = {POINT}", "error"),
        ("float3[] extent = [(-1e30, -1e30, -1e30), (1e30, 1e30, 1e30)]", None),
    ],
)
def test_how_much_may_be_missing(extent: str, level: str | None, lint: Lint) -> None:
    assert [finding.severity.label for finding in lint(volume(extent))] == [level][
        : level is not None
    ]


@pytest.mark.parametrize(
    "extent",
    [
        "",
        "float3[] extent",
        "float3[] extent = None",
        "float3[] extent = []",
        "float3[] extent = [(0, 0, 0)]",
        "float3[] extent = [(1, 1, 1), (0, 0, 0)]",
        "float3[] extent = [(0, 0, nan), (0, 0, 0)]",
        "float3[] extent = [(0, 0, 0), (0, inf, 0)]",
        'string extent = "large"',
    ],
)
def test_what_is_no_extent_is_another_rule_s(extent: str, lint: Lint) -> None:
    assert lint(volume(extent)) == []


def test_slack_is_an_option(lint: Lint) -> None:
    text = volume("float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.64)]")
    assert only(lint(text)).severity.label == "info"
    assert lint(text, relative_slack=0.1) == []


def test_words_of_a_static_extent(lint: Lint) -> None:
    found = only(lint(volume("float3[] extent = [(0.2, 0.15, 0.15), (0.5, 0.5, 0.65)]")))
    assert found.message == (
        "the grid 'density' of </cloud/density> may be cut off where it reaches out of the extent, "
        "by 0.1 on +x, +y"
    )
    assert found.suggestion == "write 'float3[] extent = [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]'"
    assert (found.site.property, found.site.line, found.site.frames) == ("extent", 4, None)


def test_words_of_half_a_voxel(lint: Lint) -> None:
    assert only(lint(volume(CENTRES))).message == (
        "the extent encloses the voxel centres of the grid 'density' of </cloud/density> and cuts "
        "voxels off by 0.05 on every side"
    )


@pytest.mark.parametrize(
    ("extent", "files", "frames"),
    [
        (WHOLE, {1: SMALL, 2: LARGE, 3: LARGE, 4: SMALL, 6: LARGE}, "2-3, 6"),
        # Interpolated between samples, held outside of them.
        (
            animated({1: UNIT, 5: POINT}),
            {1: LARGE, 2: LARGE, 3: LARGE, 4: LARGE, 9: LARGE},
            "3-5, 9",
        ),
        # A file is held too, and the sample of an extent is a time that matters.
        (
            animated({1: UNIT, 8: POINT}),
            {1: LARGE},
            "8",
        ),
        # The first file holds backwards.
        (animated({0: POINT, 4: UNIT, 6: UNIT}), {5: LARGE, 6: "./box_growing.0001.vdb"}, "0"),
        # What can not be read is not held to be what came before it.
        (
            animated({1: UNIT, 2: POINT, 3: POINT}),
            {1: LARGE, 2: "./gone.vdb", 3: "./pointer.vdb"},
            None,
        ),
        (f"float3[] extent = {POINT}", {1: "./box_growing.0001.vdb"}, None),
    ],
)
def test_frames(extent: str, files: dict[float, str], frames: str | None, lint: Lint) -> None:
    found = lint(volume(extent, samples(files)))
    assert [finding.site.frames for finding in found] == ([frames] if frames else [])


def test_words_of_frames(lint: Lint) -> None:
    found = only(lint(volume(WHOLE, samples({1: SMALL, 2: LARGE, 3: LARGE}))))
    assert found.message.endswith("by 0.05 on every side (worst at frame 2, at 2 of 3 times)")


@pytest.mark.parametrize(
    ("files", "frames", "words"),
    [
        (f"asset filePath = @{LARGE}@\n{samples({1: SMALL})}", None, "1 of 2 times, the default"),
        (f"asset filePath = @{LARGE}@\n{samples({1: LARGE})}", "default, 1", "2 of 2 times, the"),
    ],
)
def test_the_default_time_counts_if_authored(
    files: str, frames: str | None, words: str, lint: Lint
) -> None:
    found = only(lint(volume(WHOLE, files)))
    assert (found.site.frames, found.site.at_default) == (frames, True)
    assert words in found.message


def test_half_a_voxel_is_not_worth_a_word_beside_more(lint: Lint) -> None:
    found = only(lint(volume(CENTRES, samples({1: SMALL, 2: LARGE}))))
    assert (found.severity.label, found.site.frames) == ("error", "2")


@pytest.mark.parametrize(
    ("extent", "suggestion"),
    [
        (f"float3[] extent = {POINT}", "float3[] extent = [(0.05,"),
        (
            animated({1: UNIT, 2: POINT}),
            "2: [(0.05, 0.05, 0.05), (0.75, 0.75, 0.75)]",
        ),
        (
            animated({1: POINT, 2: POINT}),
            "1: [(0.15, 0.15, 0.15), (0.65, 0.65, 0.65)]', '2: [(0.05,",
        ),
    ],
)
def test_what_is_suggested_fits(extent: str, suggestion: str, lint: Lint) -> None:
    files = samples({1: SMALL, 2: LARGE})
    written = only(lint(volume(extent, files))).suggestion
    assert written is not None
    assert written.startswith(f"write '{suggestion}")
    statement = written.removeprefix("write '").removesuffix("'").replace("', '", ", ")
    if not statement.startswith("float3"):
        first = "" if statement.startswith("1:") else f"1: {UNIT}, "
        statement = f"float3[] extent.timeSamples = {{ {first}{statement} }}"
    assert lint(volume(statement, files)) == []


@pytest.mark.parametrize(
    ("low", "high", "size"),
    [
        ((-(2**30), 0, 0), (2**30, 1, 1), 1.0),
        ((0, 0, 0), (3, 3, 3), 1e-20),
        ((7, 7, 7), (7, 7, 7), 1e12),
    ],
)
def test_suggestions_fit_at_every_scale(
    low: tuple[int, int, int], high: tuple[int, int, int], size: float, lint: Lint
) -> None:
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds(low, high)}
    grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.scale(size, size, size))
    Path("scaled.vdb").write_bytes(vdbwriter.vdb(grid))
    files = "asset filePath = @./scaled.vdb@"
    written = only(lint(volume(f"float3[] extent = {POINT}", files))).suggestion
    assert written is not None
    assert lint(volume(written.removeprefix("write '").removesuffix("'"), files)) == []


def test_numbers_at_the_ends_of_their_range(lint: Lint) -> None:
    for size in (5e-324, 1e-310, 1e300):
        said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
        grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.scale(size, size, size))
        Path("scaled.vdb").write_bytes(vdbwriter.vdb(grid))
        found = lint(volume(f"float3[] extent = {POINT}", "asset filePath = @./scaled.vdb@"))
        assert only(found).code == "VOL013"


def test_a_grid_further_away_than_an_extent_can_reach(lint: Lint) -> None:
    """No box can be advised, and it is not the extent that is empty."""
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
    moved = vdbwriter.affine(1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 1e300, 1e300, 1e300, 1)
    Path("far.vdb").write_bytes(vdbwriter.vdb(vdbwriter.Grid(metadata=said, transform=moved)))
    found = only(lint(volume(f"float3[] extent = {POINT}", "asset filePath = @./far.vdb@")))
    assert found.message == (
        "the grid 'density' of </cloud/density> may be cut off where it reaches out of the extent, "
        "by 1e+300 on +x, +y, +z"
    )
    assert found.suggestion == (
        "export the grid again: its transform takes it further than an extent can reach"
    )


def test_the_turned_box_of_the_voxels_not_the_box_of_the_turned_box(lint: Lint) -> None:
    """A grid that is turned back by its field stands straight again."""
    root = math.sqrt(0.5)
    turned = (root, root, 0, 0, -root, root, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
    said = {"name": vdbwriter.string("density"), **vdbwriter.bounds((0, 0, 0), (9, 9, 9))}
    grid = vdbwriter.Grid(metadata=said, transform=vdbwriter.affine(*turned))
    Path("turned.vdb").write_bytes(vdbwriter.vdb(grid))
    back = 'float xformOp:rotateZ = -45\n uniform token[] xformOpOrder = ["xformOp:rotateZ"]'
    extent = "float3[] extent = [(-0.5, -0.5, -0.5), (9.5, 9.5, 9.5)]"
    files = "asset filePath = @./turned.vdb@"
    assert lint(volume(extent, files, back)) == []
    assert only(lint(volume(extent, files))).severity.label == "error"


def test_a_field_that_moves_out_of_a_static_extent(lint: Lint) -> None:
    text = volume("float3[] extent = [(0, 0, 0), (3, 1, 1)]", more=OPS["wander"])
    assert only(lint(text)).site.frames == "3"


def test_a_scaled_field_is_named_with_its_transform(lint: Lint) -> None:
    size = 'double3 xformOp:scale = (2, 2, 2)\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    found = only(lint(volume(WHOLE, more=size)))
    assert found.message.startswith(
        "the grid 'density' of </cloud/density>, moved as its field is, may be cut off where it "
        "reaches out of the extent, by"
    )


def test_no_transform_that_is_not_a_number(lint: Lint) -> None:
    size = 'double3 xformOp:scale = (nan, 2, 2)\n uniform token[] xformOpOrder = ["xformOp:scale"]'
    assert lint(volume(f"float3[] extent = {POINT}", more=size)) == []


def test_one_finding_for_several_fields(lint: Lint) -> None:
    fields = "".join(
        f'def OpenVDBAsset "{name}" {{\n asset filePath = @{file}@\n {NAMED}\n}}\n'
        for name, file in (("a", SMALL), ("b", LARGE), ("c", SMALL))
    )
    rels = "".join(f"rel field:{name} = </v/{name}>\n" for name in "abc") + "rel field:d = </v/b>\n"
    found = only(
        lint(f'def Volume "v" {{\n float3[] extent = [(0, 0, 0), (0.6, 1, 1)]\n{rels}{fields}}}')
    )
    assert found.message == (
        "the grid 'density' of </v/b> may be cut off where it reaches out of the extent, "
        "by 0.1 on +x"
    )
    found = only(
        lint(f'def Volume "v" {{\n float3[] extent = [(0, 0, 0), (0.5, 1, 1)]\n{rels}{fields}}}')
    )
    assert found.message.endswith("by 0.2 on +x (in 3 fields)")


def test_content_that_is_not_read_is_not_compared(lint: Lint) -> None:
    text = volume(WHOLE, samples({1: SMALL, 2: LARGE}))
    assert lint(text, content="off") == []
    assert lint(text, content="first") == []
    assert (
        only(lint(volume(CENTRES, samples({1: LARGE, 2: LARGE})), content="first")).site.frames
        == "1"
    )


def test_a_grid_that_the_file_does_not_hold(lint: Lint) -> None:
    text = volume(f"float3[] extent = {POINT}").replace('"density"\n', '"heat"\n')
    assert lint(text.replace("</cloud/density>", "</cloud/heat>")) == []


def test_nanovdb_and_field3d(lint: Lint) -> None:
    for name in ("type_all_z.nvdb", "f3d_ogawa.f3d"):
        shutil.copy(SAMPLES / name, name)
    nano = volume(CENTRES, "asset filePath = @./type_all_z.nvdb@").replace('"density"\n', '"f"\n')
    assert "[(-4.5, 1.5, -0.5), (7.5, 4.5, 24.5)]" in str(only(lint(nano)).suggestion)
    f3d = volume(CENTRES, "asset filePath = @./f3d_ogawa.f3d@", 'token fieldPurpose = "cloud"')
    found = only(lint(f3d.replace("OpenVDBAsset", "Field3DAsset")))
    assert "[(0.33333, 0.375, 0.33333), (1.33334, 2.625, 2.33334)]" in str(found.suggestion)


def test_each_instance_is_no_finding_of_its_own(lint: Lint) -> None:
    small = volume(f"float3[] extent = {POINT}").replace("</cloud", "</_asset/cloud")
    instances = "".join(
        f'def "{name}" (\n instanceable = true\n inherits = </_asset>\n) {{\n}}\n'
        for name in ("a", "b")
    )
    found = only(lint(f'class "_asset" {{\n{small}\n}}\n{instances}'))
    assert "</a/cloud/density>" in found.message
    assert found.message.endswith("(shown by 2 instances)")
