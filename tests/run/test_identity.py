"""A cause is known by what is to blame, wherever and however often it shows."""

from __future__ import annotations

import json
import os
import shutil
from pathlib import Path
from unicodedata import normalize
from zipfile import ZipFile

import pytest
from identities import HEAD, Find, refers
from process import ASSETS, run, write

from usdvol_lint.baseline.fingerprint import fingerprint
from usdvol_lint.model import Source
from usdvol_lint.paths import canonical
from usdvol_lint.results import Cause

ASSET = """#usda 1.0
(
    defaultPrim = "tank"
)
def Volume "tank"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </tank/density>
    def OpenVDBAsset "density"
    {
        asset filePath = @./gone.vdb@
        token fieldName = "density"
        token fieldDataType = "float"
    }
}
"""
GONE = Source("assets/tank.usda", "/tank/density", "filePath")
ONE = [(fingerprint("AST002", GONE), GONE)]


def named(causes: list[Cause]) -> list[tuple[str, Source]]:
    return [(cause.fingerprint, cause.source) for cause in causes]


def test_references_and_instances_show_one_cause(find: Find, tmp_path: Path) -> None:
    write(tmp_path / "assets", tank=ASSET)
    five = "".join(refers(f"t{number}") for number in range(5))
    instances = "".join(refers(f"i{number}", meta="instanceable = true") for number in range(3))
    write(tmp_path / "shots", five=HEAD + five, instances=HEAD + instances)
    [alone] = find("assets/tank.usda")
    [cause] = find("shots/five.usda", "shots/instances.usda", "assets/tank.usda")
    assert named([alone]) == named([cause]) == ONE
    assert [(place.stage, place.finding.site.prim) for place in cause.places] == [
        *((0, f"/t{number}/density") for number in range(5)),
        (1, "/i0/density"),
        (2, "/tank/density"),
    ]
    assert cause.places[5].finding.message == (
        f"no file at './gone.vdb' in '{tmp_path}/assets' (shown by 3 instances)"
    )


BROKEN = {
    "VOL013": ASSET.replace("./gone.vdb", "./cloud.vdb").replace("(1, 1, 1)", "(0.4, 1, 1)"),
    "VOL002": ASSET.replace("OpenVDBAsset", "Xform"),
    "VOL008": ASSET.replace('"density"\n    {', '"density" (\n active = false\n    )\n    {', 1),
    "SCH009": ASSET.replace("    def Open", '    def Mesh "proxy"\n    {\n    }\n    def Open'),
}


@pytest.mark.parametrize("code", BROKEN)
def test_instances_of_a_volume_itself_show_one_cause(code: str, find: Find, tmp_path: Path) -> None:
    """Each is composed by itself, and what is below it once."""
    write(tmp_path / "assets", tank=BROKEN[code])
    shutil.copy(ASSETS / "cloud.vdb", tmp_path / "assets")
    instances = "".join(refers(f"i{number}", meta="instanceable = true") for number in range(3))
    write(tmp_path / "shots", instances=HEAD + instances)
    [alone] = find("assets/tank.usda", rules=(code,))
    [cause] = find("shots/instances.usda", "assets/tank.usda", rules=(code,))
    assert named([cause]) == named([alone])
    assert (alone.code, cause.source.layer) == (code, "assets/tank.usda")


def test_a_circle_of_arcs_is_one_cause_whatever_leads_into_it(find: Find, tmp_path: Path) -> None:
    circle = 'def "tank" (\n    references = @./tank.usda@</tank>\n)\n{\n}\n'
    write(tmp_path / "assets", tank=f'#usda 1.0\n(\n    defaultPrim = "tank"\n)\n{circle}')
    write(tmp_path / "shots", one=HEAD + refers("a") + refers("b"), two=HEAD + refers("a"))
    causes = find("assets/tank.usda", "shots/one.usda", "shots/two.usda", rules=("STG002",))
    assert [(cause.source, len(cause.places)) for cause in causes] == [
        (Source("assets/tank.usda", "/tank"), 4)
    ]


def test_a_circle_in_a_sublayer_is_not_that_of_the_layer_above(find: Find, tmp_path: Path) -> None:
    arcs = "".join(
        f'def "{one}" (\n    references = </{other}>\n)\n{{\n}}\n' for one, other in ("ab", "ba")
    )
    top = '(\n    subLayers = [@./sub.usda@]\n)\ndef Xform "a"\n{\n}\ndef Xform "b"\n{\n}\n'
    write(tmp_path, sub=HEAD + arcs, top=HEAD + top)
    causes = find("sub.usda", "top.usda", rules=("STG002",))
    assert {cause.source.layer for cause in causes} == {"sub.usda"}


def test_it_is_the_same_from_every_folder_and_in_every_checkout(
    find: Find, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    write(tmp_path / "one" / "assets", tank=ASSET)
    write(tmp_path / "one" / "shots", shot=HEAD + refers("a"))
    shutil.copytree(tmp_path / "one", tmp_path / "two")
    (tmp_path / "link").symlink_to("one")
    (tmp_path / "one" / "shots" / "linked").symlink_to("../assets")
    linked = write(tmp_path / "one", linked=HEAD + refers("a", "./shots/linked/tank.usda"))
    for checkout in ("one", "two", "link"):
        folder = tmp_path / checkout
        for working in (tmp_path, folder, folder / "shots"):
            monkeypatch.chdir(working)
            assert named(find(folder / "shots" / "shot.usda", root=folder)) == ONE
            relative = os.path.relpath(folder / "shots" / "shot.usda")
            assert named(find(relative, root=folder)) == ONE
    assert named(find(linked / "linked.usda", root=tmp_path / "link")) == ONE


def test_what_lies_outside_of_the_root_goes_by_its_absolute_path(
    find: Find, tmp_path: Path
) -> None:
    write(tmp_path / "assets", tank=ASSET)
    write(tmp_path / "shots", shot=HEAD + refers("a"))
    source = GONE._replace(layer=canonical(str(tmp_path / "assets" / "tank.usda")))
    expected = [(fingerprint("AST002", source), source)]
    assert named(find("shots/shot.usda", root="shots")) == expected


@pytest.mark.parametrize(
    ("old", "new", "is_one"),
    [
        ("tank/v001/tank", "tank/v002/tank", True),
        ("tank_v001", "tank_v12", True),
        ("tank.v1", "tank.v2", True),
        ("v1/tank", "v2/tank", True),
        ("rev12", "rev13", False),
        ("v2ray", "v3ray", False),
        ("dev1", "dev2", False),
        ("v1_high", "v1_low", False),
    ],
)
def test_version_folders(old: str, new: str, is_one: bool, find: Find, tmp_path: Path) -> None:
    for name in (old, new):
        file = tmp_path / "assets" / f"{name}.usda"
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text(ASSET)
    stages = [f"assets/{name}.usda" for name in (old, new)]
    assert len(find(*stages, versions=r"v\d+")) == (1 if is_one else 2)
    assert len(find(*stages)) == 2


def test_the_name_of_a_folded_version(find: Find, tmp_path: Path) -> None:
    write(tmp_path / "assets" / "v001", tank_v01=ASSET)
    source = GONE._replace(layer="assets/*/tank_*.usda")
    expected = [(fingerprint("AST002", source), source)]
    assert named(find("assets/v001/tank_v01.usda", versions=r"v\d+")) == expected


LOOKS = """
def Xform "{0}" (
    variants = {{
        string look = "a"
    }}
    prepend variantSets = "look"
)
{{
    variantSet "look" = {{
        "a" {{
            def "t" ( references = @../assets/tank.usda@ ) {{}}
        }}
        "b" {{
            def "t" ( references = @../assets/tank.usda@ ) {{}}
            def "u" ( references = @../assets/tank.usda@ ) {{}}
        }}
    }}
}}
"""


def test_a_selection_that_is_composed_is_a_place(find: Find, tmp_path: Path) -> None:
    write(tmp_path / "assets", tank=ASSET)
    write(tmp_path / "shots", shot=HEAD + LOOKS.format("m"))
    [cause] = find("shots/shot.usda", selections=100)
    assert named([cause]) == ONE
    assert [(place.finding.site.prim, place.finding.site.variant) for place in cause.places] == [
        ("/m/t/density", None),
        ("/m/u/density", "/m{look=b}"),
    ]
    assert named(find("shots/shot.usda")) == ONE


def test_a_variant_in_which_the_spec_stands_is_part_of_it(find: Find, tmp_path: Path) -> None:
    """What is authored in two variants has to be mended in both."""
    field = 'def OpenVDBAsset "d"\n{\nasset filePath = @./gone.vdb@\n}\n'
    sets = f'variantSet "look" = {{\n"a" {{\n{field}}}\n"b" {{\n{field}}}\n}}'
    meta = '(\nvariants = {\nstring look = "a"\n}\nprepend variantSets = "look"\n)'
    write(tmp_path, asset=f'#usda 1.0\ndef Volume "v" {meta}\n{{\n{sets}\n}}\n')
    found = find("asset.usda", selections=9)
    assert [cause.source for cause in found] == [
        Source("asset.usda", f"/v{{look={look}}}d", "filePath") for look in "ab"
    ]
    write(tmp_path, user='#usda 1.0\ndef "u" (\nreferences = @./asset.usda@</v>\n)\n{\n}\n')
    [referred] = find("user.usda")
    assert referred.fingerprint == found[0].fingerprint


def test_jobs_share_causes(tmp_path: Path) -> None:
    write(tmp_path / "assets", tank=ASSET)
    shots = {f"s{number}": HEAD + refers("a") + refers("b") for number in range(4)}
    write(tmp_path / "shots", **shots)
    reports = []
    for jobs in ("1", "3"):
        chosen = ("--isolated", "--select", "AST002", "--root", ".", "--output-format", "json")
        ran = run(*chosen, "--jobs", jobs, "shots", cwd=tmp_path)
        assert (ran.code, ran.err) == (1, "")
        report = json.loads(ran.out)
        del report["run"]
        reports.append(report)
    assert reports[0] == reports[1]
    [cause] = reports[0]["causes"]
    assert (cause["fingerprint"], cause["count"]) == (ONE[0][0], 8)
    assert [stage["causes"] for stage in reports[0]["stages"]] == [[0]] * 4


def test_packages_with_a_layer_of_one_name_have_a_cause_each(find: Find, tmp_path: Path) -> None:
    """The package itself is its first layer."""
    first = '#usda 1.0\n(\ndefaultPrim = "in"\n)\n' + refers("in", "./tank.usda")
    for name in "ab":
        with ZipFile(tmp_path / f"{name}.usdz", "w") as package:
            package.writestr("scene.usda", first)
            package.writestr("tank.usda", ASSET)
        with ZipFile(tmp_path / f"{name}{name}.usdz", "w") as package:
            package.writestr("tank.usda", ASSET)
    for one, other, layers in (
        ("a.usdz", "b.usdz", ("a.usdz[tank.usda]", "b.usdz[tank.usda]")),
        ("a.usdz[tank.usda]", "b.usdz[tank.usda]", ("a.usdz[tank.usda]", "b.usdz[tank.usda]")),
        ("aa.usdz", "bb.usdz", ("aa.usdz", "bb.usdz")),
        ("aa.usdz[tank.usda]", "aa.usdz", ("aa.usdz",)),
    ):
        write(tmp_path, stage=HEAD + refers("a", f"./{one}") + refers("b", f"./{other}"))
        assert [cause.source for cause in find("stage.usda")] == [
            GONE._replace(layer=layer) for layer in layers
        ]
    sources = [cause.source.layer for cause in find("a.usdz", "b.usdz", "aa.usdz", "bb.usdz")]
    assert sources == ["a.usdz[tank.usda]", "b.usdz[tank.usda]", "aa.usdz", "bb.usdz"]


def test_the_form_of_unicode_in_a_name_is_none_of_it(find: Find, tmp_path: Path) -> None:
    for form in ("NFC", "NFD"):
        name = normalize(form, "tänk")
        (tmp_path / form).mkdir()
        (tmp_path / form / f"{name}.usda").write_text(ASSET)
        [cause] = find(f"{form}/{name}.usda", root=tmp_path / form)
        assert cause.source == GONE._replace(layer=normalize("NFC", "tänk.usda"))


def test_file_format_arguments_are_none_of_it(find: Find, tmp_path: Path) -> None:
    write(tmp_path / "assets", tank=ASSET)
    path = "../assets/tank.usda:SDF_FORMAT_ARGS:a=b"
    write(tmp_path / "shots", shot=HEAD + refers("a", path) + refers("b"))
    [cause] = find("shots/shot.usda")
    assert (named([cause]), cause.count) == (ONE, 2)


def test_a_link_in_another_folder_is_to_blame_for_where_its_paths_lead(
    find: Find, tmp_path: Path
) -> None:
    """What is wrong in the file itself is one cause, whatever leads to it."""
    shutil.copytree(ASSETS, tmp_path / "assets")
    wrong = ASSET.replace("gone", "cloud").replace('"float"', '"double3"')
    for name, text in (
        ("tank", ASSET),
        ("whole", ASSET.replace("gone", "cloud")),
        ("wrong", wrong),
    ):
        write(tmp_path / "assets", **{name: text})
        (tmp_path / "links").mkdir(exist_ok=True)
        (tmp_path / "links" / f"{name}.usda").symlink_to(f"../assets/{name}.usda")
    rules = ("AST002", "FLD004", "GRD005")
    assert named(find("links/tank.usda", "assets/tank.usda")) == ONE
    [lost] = find("links/whole.usda", "assets/whole.usda", rules=rules)
    assert (lost.source.layer, lost.count) == ("links/whole.usda", 1)
    (tmp_path / "links" / "cloud.vdb").symlink_to("../assets/cloud.vdb")
    assert find("links/whole.usda", rules=rules) == []
    [same] = find("links/wrong.usda", "assets/wrong.usda", rules=rules)
    assert (same.source.layer, same.count) == ("assets/wrong.usda", 2)
