"""Layers that are built to be hard: each function is a kind, and gives files by name.

The layer to open is `stage.usda`.
"""

from __future__ import annotations

from collections.abc import Callable
from random import Random

from .model import STAGE, volume
from .numbers import asset, number, quoted, text

Files = dict[str, bytes]
Builder = Callable[[Random], Files]
BUILDERS: dict[str, Builder] = {}
_HEAD = "#usda 1.0\n"
_ARCS = ("references", "payload", "inherits", "specializes")


def built(make: Callable[[Random], str | Files]) -> Builder:
    """Declares a kind, of one text or of several files."""

    def builder(rng: Random) -> Files:
        made = make(rng)
        return {STAGE: _bytes(_HEAD + made)} if isinstance(made, str) else made

    BUILDERS[make.__name__.strip("_").replace("_", " ")] = builder
    return builder


def _bytes(layer: str) -> bytes:
    return layer.encode("utf-8", "surrogateescape")


def _field(more: str, kind: str = "OpenVDBAsset") -> str:
    return volume("a.vdb", kind, more).decode().removeprefix(_HEAD)


@built
def _nesting(rng: Random) -> str:
    """Prims in prims; half of them with a field at the bottom."""
    depth = rng.choice((50, 330, 600))
    inner = _field("") if rng.random() < 0.5 else ""
    return 'def Xform "p" {\n' * depth + inner + "}\n" * depth


@built
def _instances_of_instances(rng: Random) -> str:
    levels, width = rng.choice(((3, 4), (6, 4), (10, 4), (40, 2)))
    layer = [f'class "L0" {{\n{_field("")}\n}}\n']
    for level in range(1, levels):
        copies = "".join(
            f'def "i{number}" (instanceable = true; references = </L{level - 1}>) {{}}\n'
            for number in range(width)
        )
        layer.append(f'class "L{level}" {{\n{copies}}}\n')
    return "".join(layer) + f'def "top" (references = </L{levels - 1}>) {{}}\n'


@built
def _forwarding(rng: Random) -> str:
    """A relationship that forwards to the next, and at the end to a field, nothing or the first."""
    length = rng.choice((3, 50, 400))
    last = rng.choice(("</v/d>", "</v.field:f0>", "</nowhere>", "</v.field:f1>"))
    chain = "".join(f"rel field:f{n} = </v.field:f{n + 1}>\n" for n in range(length))
    return f'def Volume "v" {{\n{chain}rel field:f{length} = {last}\ndef "d" {{}}\n}}\n'


@built
def _exponential_references(rng: Random) -> str:
    """Each level refers to the one below twice: USD composes two to the power of their number."""
    levels = rng.choice((3, 6, 8))
    layer = 'class "L0" {\ndef Volume "v" {}\n}\n'
    for level in range(1, levels):
        two = "".join(f'def "{name}" (references = </L{level - 1}>) {{}}\n' for name in "ab")
        layer += f'class "L{level}" {{\n{two}}}\n'
    return layer + f'def "top" (references = </L{levels - 1}>) {{}}\n'


@built
def _cycles(rng: Random) -> Files:
    arc = rng.choice((*_ARCS, "subLayers"))
    if arc == "subLayers":
        layer = f"{_HEAD}(subLayers = [@./b.usda@])\n"
        return {STAGE: _bytes(layer), "b.usda": _bytes(f"{_HEAD}(subLayers = [@./{STAGE}@])\n")}
    if arc in ("references", "payload") and rng.random() < 0.5:
        one, two = (
            f'{_HEAD}(defaultPrim = "a")\ndef Volume "a" ({arc} = @./{name}@) {{}}\n'
            for name in ("b.usda", STAGE)
        )
        return {STAGE: _bytes(one), "b.usda": _bytes(two)}
    other = rng.choice(_ARCS)
    text = f'def Volume "a" ({arc} = </b>) {{}}\ndef "b" ({other} = </a>) {{}}\n'
    return {STAGE: _bytes(_HEAD + text)}


@built
def _huge_tokens(rng: Random) -> str:
    size = rng.choice((70_000, 1_300_000))
    name = rng.choice(("fieldName", "fieldDataType", "fieldClass", "vectorDataRoleHint", "mine"))
    return _field(f'custom token {name}2 = "{"x" * size}"\n token {name} = "{"y" * size}"')


@built
def _long_names(rng: Random) -> str:
    name = rng.choice(("n" * 70_000, "v" + "9" * 5000, "smoke_" + "1" * 4500))
    return _field(f"custom int {name} = 3").replace('"cloud"', f'"{name}"')


@built
def _many_properties(rng: Random) -> str:
    count = rng.choice((300, 5000))
    return _field("\n".join(f"custom float p{n} = {n}" for n in range(count)))


@built
def _numbers_in_names(rng: Random) -> Files:
    """Frame numbers of every length, in a sequence and on disk."""
    digits = rng.choice(
        ("9" * 5000, "0" * 5000 + "1", "9" * 200, "0001", "\u0661\u0662\u0663\u0664")
    )
    paths = (f"@./smoke.{digits[:-1]}{n}.vdb@" for n in range(6))
    samples = ", ".join(f"{n}: {path}" for n, path in enumerate(paths))
    files = {f"smoke.{n:04}.vdb": b"x" * 2000 for n in range(3)} | {f"smoke.{'9' * 200}.vdb": b"x"}
    layer = _field(f"asset filePath.timeSamples = {{ {samples} }}")
    return {STAGE: _bytes(_HEAD + layer.replace('"density"', f'"d{digits[:4400]}"')), **files}


@built
def _placeholders(rng: Random) -> Files:
    names = {f"smoke.{n:04}.vdb": b"x" * 2000 for n in (1, 2, 7)}
    path = asset(rng.choice(("", "./", "smoke.")) + text(rng) + rng.choice(("", ".vdb")))
    return {STAGE: _bytes(_HEAD + _field("").replace("@./a.vdb@", path)), **names}


@built
def _times(rng: Random) -> str:
    """Time samples, ranges and rates at numbers that no clock shows."""
    count = rng.choice((2, 6, 12))
    keys = [number(rng) if rng.random() < 0.4 else str(n) for n in range(count)]
    samples = ", ".join(f"{key}: @./a.{n:04}.vdb@" for n, key in enumerate(keys))
    said = ("startTimeCode", "endTimeCode", "timeCodesPerSecond", "framesPerSecond")
    head = "\n".join(f"{name} = {number(rng)}" for name in rng.sample(said, 2))
    extents = ", ".join(f"{number(rng)}: [({number(rng)}, 0, 0), (1, 1, 1)]" for _ in range(3))
    more = f"asset filePath.timeSamples = {{ {samples} }}\nfloat3[] extent2 = []"
    return f"({head})\n" + _field(more).replace(
        "float3[] extent = ", f"float3[] extent.timeSamples = {{ {extents} }}\n float3[] extent = "
    )


@built
def _offsets(rng: Random) -> Files:
    """Layer offsets and scales, in sublayers and references."""
    offset = f"(offset = {number(rng)}; scale = {number(rng)})"
    samples = "asset filePath.timeSamples = { 1: @./a.0001.vdb@, 2: @./a.0002.vdb@, 3: @./x@ }"
    below = {"b.usda": _bytes(f'{_HEAD}(defaultPrim = "cloud")\n' + _field(samples))}
    if rng.random() < 0.5:
        return {STAGE: _bytes(f"{_HEAD}(subLayers = [@./b.usda@ {offset}])\n"), **below}
    return {STAGE: _bytes(f'{_HEAD}def "x" (references = @./b.usda@ {offset}) {{}}\n'), **below}


@built
def _clips(rng: Random) -> Files:
    """Value clips with absurd templates, strides, times and numbers of clips."""
    if rng.random() < 0.5:
        said = f"""string templateAssetPath = {
            quoted(
                rng.choice(
                    ("./c.###.usda", "./c.#.##.usda", "c" + "#" * 300, "./c.usda", text(rng))
                )
            )
        }
        double templateStartTime = {number(rng)}
        double templateEndTime = {rng.choice(("3", number(rng)))}
        double templateStride = {rng.choice(("1", "0.001", number(rng)))}"""
    else:
        times = ", ".join(f"({number(rng)}, {number(rng)})" for _ in range(3))
        said = f"""asset[] assetPaths = [@./c.001.usda@, {asset(text(rng))}]
        double2[] active = [(0, 0), ({number(rng)}, {number(rng)})]
        double2[] times = [{times}]"""
    layer = f"""def Volume "cloud" (clips = {{ dictionary default = {{
        string primPath = {quoted(rng.choice(("/cloud", "/", "x", text(rng))))}
        {said}
    }} }}) {{
    rel field:d = </cloud/d>
    def OpenVDBAsset "d" {{
        asset filePath
    }}
}}
"""
    clip = _field("asset filePath.timeSamples = { 1: @./a.vdb@, 2: @./b.vdb@ }")
    return {STAGE: _bytes(_HEAD + layer), "c.001.usda": _bytes(_HEAD + clip)}


@built
def _variants(rng: Random) -> str:
    """Variant sets in variants, or many beside each other."""
    depth, width = rng.choice(((1, 60), (12, 2), (40, 1)))
    sets = [f"s{n}" for n in range(depth)]
    body = _field("")
    for name in sets:
        inner = "\n".join(f'"v{n}" {{\n{body}\n}}' for n in range(width if depth == 1 else 1))
        body = f'def "x" (variants = {{ string {name} = "v0" }}; prepend variantSets = "{name}") {{'
        body += f'\nvariantSet "{name}" = {{\n{inner}\n"other" {{}}\n}}\n}}\n'
    return body


@built
def _expressions(rng: Random) -> Files:
    """Expression variables: missing, of wrong types, that name each other, and deep."""
    deep = "`" + "if(True, " * 40 + "'a'" + ", 'b')" * 40 + "`"
    value = rng.choice(('"./a.vdb"', '"`${B}`"', '"`${A}`"', "3", '"`${"', '["a"]', '""'))
    path = rng.choice(('`"${A}.vdb"`', "`${A}`", "`${`", '`join("a")`', deep, '`"${B}/${A}"`'))
    head = f'(expressionVariables = {{ string A = {value}; string B = "`${{A}}`" }})\n'
    return {STAGE: _bytes(_HEAD + head + _field("").replace("@./a.vdb@", f"@{path}@"))}


@built
def _broken_text(rng: Random) -> Files:
    """NUL, lone surrogates and bytes that are no UTF-8, where a text may stand."""
    odd = rng.choice((b"\0", b"\xed\xa0\x80", b"\xff\xfe", b"\xc3", b"\\xff", b"\xf4\x90\x80\x80"))
    where = rng.choice((b'"density"', b"a.vdb", b'"float"', b"cloud", b"#usda 1.0\n", b"extent"))
    return {STAGE: volume("a.vdb").replace(where, where[:-1] + odd + where[-1:], 2)}


@built
def _particles(rng: Random) -> str:
    """A particle field whose arrays hold anything, and differ in length."""
    counts = [rng.choice((0, 1, 3, 4, 500)) for _ in range(4)]
    points, scales, turns = (
        ", ".join(
            f"({', '.join(number(rng) if rng.random() < 0.1 else '1' for _ in range(width))})"
            for _ in range(count)
        )
        for count, width in zip(counts[:3], (3, 3, 4), strict=True)
    )
    opacities = ", ".join(number(rng) if rng.random() < 0.1 else "0.5" for _ in range(counts[3]))
    return f"""def ParticleField3DGaussianSplat "p" {{
    point3f[] positions = [{points}]
    float3[] scales = [{scales}]
    quatf[] orientations = [{turns}]
    float[] opacities = [{opacities}]
    int radiance:sphericalHarmonicsDegree = {rng.choice((0, 3, -1, 2147483647, -2147483648))}
    float3[] radiance:sphericalHarmonicsCoefficients = [{points}]
    float3[] extent = [(0, 0, 0), ({rng.choice(("1", "inf", "nan", "-1e38"))}, 1, 1)]
}}
"""


@built
def _metadata(rng: Random) -> str:
    """Metadata of the layer and of prims, nested and of the wrong types."""
    deep = rng.choice((3, 60))
    nested = "dictionary d = {" * deep + "}" * deep
    words = {"defaultPrim": quoted(text(rng)), "upAxis": quoted(text(rng))}
    words |= {"metersPerUnit": number(rng), "doc": quoted("x" * rng.choice((3, 200_000)))}
    lines = "\n".join(f"{key} = {value}" for key, value in words.items())
    ignoring = f"dictionary usdvol_lint = {{ string[] ignore = [{quoted(text(rng))}] }}"
    return f"({lines}\n customLayerData = {{ {nested}; {ignoring} }})\n" + _field("")


@built
def _transforms(rng: Random) -> str:
    numbers = ", ".join(number(rng) for _ in range(3))
    moved = f"double3 xformOp:translate = ({numbers})\n"
    moved += 'uniform token[] xformOpOrder = ["xformOp:translate", "!invert!xformOp:translate2"]'
    return f'def Xform "x" {{ {moved}\n {_field(moved)} }}\n'


@built
def _deep_folders(rng: Random) -> str:
    path = "/".join(["d"] * rng.choice((100, 3000)))
    return _field("").replace("./a.vdb", rng.choice(("./", "/", "../")) + path + "/a.vdb")


@built
def _comments(rng: Random) -> str:
    """Text that the scanner for lines has to pass: quotes, brackets and comments by thousands."""
    noise = rng.choice(("/* ", "# \"'@<[{(\n", "'''\n", '"""', "((((", "@@@"))
    some = noise * rng.choice((1, 2, 2000))
    comment = "".join(f"# {line}\n" for line in some.splitlines())
    return comment + _field(f"custom string s = {quoted(some)}\n /* {some.replace('/*', '')} */")
