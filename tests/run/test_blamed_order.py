"""Neither the order of prims nor a declaration without a value moves what is to blame."""

from __future__ import annotations

import shutil
from pathlib import Path

from identities import CLEAN, LAYER, META, STAGE, Find, refers
from process import write


def on_top(inside: str, path: str = "../assets/tank.usda") -> str:
    """A layer on top of another."""
    top = STAGE.replace(META, f"{META}subLayers = [@{path}@]\n")
    return f'{top}over "tank"\n{{\n{inside}\n}}\n'


def test_the_first_gprim_in_an_instance_is_that_by_path(find: Find, shots: Path) -> None:
    rocks = refers("rocks", "./rocks.usda", "instanceable = true\n")
    nested = CLEAN.replace("rel field", f"{rocks}rel field", 1)
    found = []
    for names in (("one", "two"), ("two", "one")):
        meshes = "".join(f'def Mesh "{name}"\n{{\n}}\n' for name in names)
        inside = LAYER.replace("tank", "rocks") + f'def Xform "rocks"\n{{\n{meshes}}}\n'
        write(shots.parent / "assets", tank=LAYER + nested, rocks=inside)
        [cause] = find("assets/tank.usda", rules=("SCH009",))
        found.append((cause.source, cause.first.message))
    assert found[0] == found[1]
    assert "/rocks/one>" in found[0][1]


def test_of_fields_that_share_a_sequence_the_first_is_that_by_path(find: Find, shots: Path) -> None:
    assets = shots.parent / "assets"
    for frame in range(1, 5):
        name = "two_grids" if frame == 2 else "cloud"
        shutil.copy(assets / f"{name}.vdb", assets / f"f.{frame}.vdb")
    samples = "".join(f"{frame}: @./f.{frame}.vdb@,\n" for frame in range(1, 5))
    said = f"asset filePath.timeSamples = {{\n{samples}}}"
    animated = CLEAN.replace("asset filePath = @./cloud.vdb@", said)
    field = animated[animated.index("    def OpenVDBAsset") : animated.rindex("}")]
    two = animated.replace(field, field + field.replace('"density"\n    {', '"again"\n    {'))
    write(assets, tank=LAYER + two)
    write(shots, one=on_top('reorder nameChildren = ["again", "density"]'))
    write(shots, two=on_top('reorder nameChildren = ["density", "again"]'))
    [cause] = find("assets/tank.usda", "shots/one.usda", "shots/two.usda", rules=("GRD013",))
    assert (cause.source.path, cause.count) == ("/tank/again", 3)


def test_a_declaration_without_a_value_is_no_slip(find: Find, shots: Path) -> None:
    """Neither on top of one, nor below."""
    write(shots.parent / "assets", tank=LAYER + CLEAN)
    slip = 'over "density"\n{\nasset filepath = @./x.vdb@\n}'
    bare = 'over "density"\n{\nasset filepath (doc = "late")\n}'
    write(shots, slip=on_top(slip), top=on_top(bare, "./slip.usda"), below=on_top(bare))
    write(shots, above=on_top(slip, "./below.usda"))
    rules = ("SCH004",)
    assert find("shots/below.usda", rules=rules) == []
    [cause] = find("shots/slip.usda", "shots/top.usda", rules=rules)
    assert (cause.source.layer, cause.count) == ("shots/slip.usda", 2)
    [above] = find("shots/above.usda", rules=rules)
    assert above.source.layer == "shots/above.usda"
