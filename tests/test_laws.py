"""What holds for every rule and every module, whoever writes the next one."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from statistics import median
from typing import Any

import pytest
from process import ROOT
from pxr import Sdf, Usd, Vt

from usdvol_lint import schema
from usdvol_lint.config import Config
from usdvol_lint.engine.engine import Engine
from usdvol_lint.facts.usd.kinds import is_registered
from usdvol_lint.model import Finding, Severity
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import ENGINE_RULES, Catalog
from usdvol_lint.rule import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE, Rule

ENGINE = ROOT / "usdvol_lint"
RULES = ROOT / "rules"

PACKAGES = (
    {"model", "nearest"},
    {"schema", "paths", "config"},
    {"spelling"},
    {"volumefile"},
    {"facts"},
    {"rule"},
    {"packs"},
    {"engine"},
    {"child"},
    {"run"},
    {"report"},
    {"command"},
    {"__main__"},
)
"""Who may import whom: a package or module of ours only what stands above it, or itself."""
WINGS = {
    "usd": set(),
    "prims": {"usd"},
    "files": {"usd", "prims"},
    "layers": {"usd", "prims", "files"},
    "grids": {"usd", "prims", "files", "layers"},
    "volumes": {"usd", "prims", "files", "layers", "grids"},
    "particles": {"usd", "prims"},
}
"""Which other parts of `facts` each part may import."""
LEVELS = {name: level for level, names in enumerate(PACKAGES) for name in names}
WITH_USD = ("facts/*/*.py", "engine/*.py", "run/worker.py")
WITHOUT_USD = (
    "facts/*/__init__.py",
    "facts/*/states.py",
    "engine/__init__.py",
    "engine/trouble.py",
    "engine/lines.py",
)
"""What the parent process may import: there neither pxr nor numpy may be named at module level."""

LONGEST_RULE = 49
LONGEST_HALF_OF_RULES = 21
"""How many lines a rule's module has at most, and how many the shorter half of them have."""

RULE_MODULES = sorted(path for path in RULES.rglob("*.py") if not path.name.startswith("_"))
ENGINE_MODULES = sorted(ENGINE.rglob("*.py"))


def imports(path: Path) -> Iterator[tuple[str, ast.stmt]]:
    """Every module that is imported, `from a import b` as `a.b`, with the statement."""
    for node in ast.walk(tree(path)):
        if isinstance(node, ast.Import):
            yield from ((alias.name, node) for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            assert not node.level, f"{path}: a relative import"
            yield from ((f"{node.module}.{alias.name}", node) for alias in node.names)


def imports_at_once(path: Path) -> Iterator[str]:
    """What importing the module imports: not what functions import, nor what only types need."""
    deferred = {
        id(inner)
        for node in ast.walk(tree(path))
        if isinstance(node, ast.FunctionDef)
        or (isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING")
        for inner in ast.walk(node)
    }
    yield from (name for name, node in imports(path) if id(node) not in deferred)


def tree(path: Path) -> ast.Module:
    return ast.parse(path.read_text(encoding="utf-8"), str(path))


def part(path: Path) -> str:
    """The name of a module in PACKAGES: that of its package, if it is in one."""
    return path.relative_to(ENGINE).with_suffix("").parts[0]


def is_one_of(path: Path, patterns: tuple[str, ...]) -> bool:
    return any(path.relative_to(ENGINE).match(pattern) for pattern in patterns)


# --- the engine -----------------------------------------------------------------------------------


def test_every_module_has_its_place() -> None:
    assert {part(path) for path in ENGINE_MODULES} == LEVELS.keys() | {"__init__"}


@pytest.mark.parametrize("path", ENGINE_MODULES, ids=lambda path: str(path.relative_to(ENGINE)))
def test_imports_point_down(path: Path) -> None:
    own = part(path)
    for name, _ in imports(path):
        package, _, rest = name.partition(".")
        assert package != "rules", f"{name}: nothing imports the rules"
        if package != "usdvol_lint":
            continue
        imported = rest.partition(".")[0]
        if imported == "__version__" or own == "__init__":
            continue
        assert imported in LEVELS, f"{name}: the package itself"
        assert imported == own or LEVELS[imported] < LEVELS[own], f"{own} imports {name}"


FACT_MODULES = sorted(ENGINE.glob("facts/*/*.py"))


def test_every_wing_has_its_place() -> None:
    assert {path.parent.name for path in FACT_MODULES} == WINGS.keys()


@pytest.mark.parametrize("path", FACT_MODULES, ids=lambda path: str(path.relative_to(ENGINE)))
def test_wings_import_those_below_them(path: Path) -> None:
    own = path.parent.name
    for name, _ in imports(path):
        if name.startswith("usdvol_lint.facts."):
            other = name.split(".")[2]
            assert other == "found" or other == own or other in WINGS[own], f"{own} imports {name}"


@pytest.mark.parametrize("path", ENGINE_MODULES, ids=lambda path: str(path.relative_to(ENGINE)))
def test_the_parent_process_needs_no_usd(path: Path) -> None:
    if is_one_of(path, WITHOUT_USD) or not is_one_of(path, WITH_USD):
        roots = {name.partition(".")[0] for name in imports_at_once(path)}
        assert roots.isdisjoint({"pxr", "numpy"})


def test_the_model_knows_nothing_of_us_and_of_usd() -> None:
    for name, _ in imports(ENGINE / "model.py"):
        assert name.partition(".")[0] not in {"usdvol_lint", "pxr", "numpy"}


@pytest.mark.parametrize("path", ENGINE_MODULES, ids=lambda path: str(path.relative_to(ENGINE)))
def test_modules_say_what_they_are(path: Path) -> None:
    words = ast.get_docstring(tree(path))
    assert words
    assert words.partition("\n")[0].endswith((".", "`."))


# --- rule modules ---------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def built_in(catalog: Catalog) -> dict[str, Rule]:
    engines = {rule.code for rule in ENGINE_RULES}
    return {code: rule for code, rule in catalog.rules.items() if code not in engines}


def test_there_is_one_rule_in_each_module(built_in: dict[str, Rule]) -> None:
    homes = sorted(Path(inspect.getsourcefile(rule.check) or "") for rule in built_in.values())
    assert homes == RULE_MODULES


@pytest.mark.parametrize("path", RULE_MODULES, ids=lambda path: path.stem)
def test_a_rule_module(path: Path) -> None:
    """One shape for all: a name, a docstring, few imports, and a generator that only yields."""
    module = tree(path)
    (name, code) = next(
        (node.name, ast.literal_eval(node.decorator_list[0].args[0]))
        for node in module.body
        if isinstance(node, ast.FunctionDef)
        and node.decorator_list
        and isinstance(node.decorator_list[0], ast.Call)
    )
    assert path.stem == name
    assert re.fullmatch(r"[a-z][a-z0-9]*(_[a-z0-9]+)*", name)
    assert re.fullmatch(r"[A-Z]{3}\d{3}", code)
    words = ast.get_docstring(module) or ""
    assert words.startswith(f"{code}: ")
    assert words.partition("\n")[0].endswith(".")

    for imported, _ in imports(path):
        root = imported.partition(".")[0]
        assert root != "logging"
        if root == "usdvol_lint":
            home = imported.split(".")[1]
            assert home in {"rule", "schema", "spelling"}, f"a rule imports {imported}"
    roots = {imported.partition(".")[0] for imported in imports_at_once(path)}
    assert roots.isdisjoint({"pxr", "numpy"}), "the parent process loads rules too"

    called = {
        node.func.id
        for node in ast.walk(module)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name)
    }
    assert called.isdisjoint({"print", "open", "input", "exec", "eval", "breakpoint"})
    assert path.with_suffix(".md").is_file()


def test_rules_are_short() -> None:
    """A longer one says several things, or finds what a fact should find."""
    lengths = {path.stem: len(path.read_text("utf-8").splitlines()) for path in RULE_MODULES}
    assert {name: lines for name, lines in lengths.items() if lines > LONGEST_RULE} == {}
    assert median(lengths.values()) <= LONGEST_HALF_OF_RULES


def test_rules_say_what_they_are(built_in: dict[str, Rule]) -> None:
    levels = list(Severity)
    constants = {STAGE, UNKNOWN_TYPE, ABSTRACT_TYPE}
    ours = schema.TYPE_BASES.keys() | schema.API_INCLUDES.keys()
    for code, rule in built_in.items():
        where = f"{code} ({rule.name})"
        assert rule.code == code
        assert rule.severity in levels, where
        assert rule.on, where
        for name in rule.on:
            assert name in constants | ours or is_registered(name), f"{where} on {name!r}"
        assert re.fullmatch(r"\d+\.\d+", rule.since), where
        parameters = inspect.signature(rule.check).parameters.values()
        assert [p.kind for p in parameters][:2] == [inspect.Parameter.POSITIONAL_OR_KEYWORD] * 2
        options = [p for p in parameters if p.kind is inspect.Parameter.KEYWORD_ONLY]
        assert len(options) == len(parameters) - 2, where
        for option in options:
            assert isinstance(option.default, str | bool | int | float | tuple), where


def test_names_and_codes_are_taken_once(catalog: Catalog) -> None:
    rules = catalog.rules.values()
    assert len({rule.name for rule in rules}) == len(rules)


# --- rules at work --------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def everything(catalog: Catalog) -> Engine:
    return Engine(catalog.rules, activate(Config(select=("ALL",)), catalog))


def failures(findings: tuple[Finding, ...]) -> list[str]:
    """What the rules themselves did wrong: a stage that makes USD fail is no such thing."""
    return [
        f"{finding.site.prim}: {finding.message}\n{finding.detail}"
        for finding in findings
        if finding.code == "LNT002"
    ]


TYPES = sorted({*schema.TYPE_BASES, "Xform", "Points", "Nonsense", ""})


def bare(type_name: str) -> str:
    apis = ", ".join(f'"{api}"' for api in schema.API_INCLUDES)
    return (
        "#usda 1.0\n"
        f'def {type_name} "bare"\n{{\n}}\n'
        f'def {type_name} "applied" (\n    prepend apiSchemas = [{apis}]\n)\n{{\n}}\n'
    )


@pytest.mark.parametrize(
    "text",
    ["#usda 1.0\n", *map(bare, TYPES)],
    ids=["empty", *(name or "untyped" for name in TYPES)],
)
def test_no_rule_fails_on_next_to_nothing(
    text: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
    report = everything.lint("stage.usda")
    assert failures(report.findings) == []


GARBAGE: tuple[tuple[str, Any], ...] = (
    ("string", "text"),
    ("string", ""),
    ("token", "\N{SNOWMAN}"),
    ("token[]", Vt.TokenArray(["a", "b"])),
    ("bool", True),
    ("int", -7),
    ("int[]", Vt.IntArray()),
    ("int64", 2**62),
    ("double", float("nan")),
    ("float", float("inf")),
    ("half", -0.0),
    ("float[]", Vt.FloatArray([float("nan"), 1.0, float("-inf")])),
    ("float[]", Vt.FloatArray()),
    ("half[]", Vt.HalfArray(3)),
    ("float3", (float("nan"), 0, 1)),
    ("float3[]", Vt.Vec3fArray(3)),
    ("float3[]", Vt.Vec3fArray([(float("nan"), 0, 0)] * 2)),
    ("point3f[]", Vt.Vec3fArray(5)),
    ("point3d[]", Vt.Vec3dArray(2)),
    ("quatf[]", Vt.QuatfArray(2)),
    ("quath[]", Vt.QuathArray(1)),
    ("matrix4d", None),
    ("asset", Sdf.AssetPath("")),
    ("asset", Sdf.AssetPath("a.vdb")),
    ("asset", Sdf.AssetPath(".")),
    ("asset", Sdf.AssetPath("a.usdz[b.vdb]")),
    ("asset", Sdf.AssetPath("`${X`")),
    ("asset[]", Sdf.AssetPathArray([Sdf.AssetPath("a.vdb"), Sdf.AssetPath("")])),
    ("timecode", Sdf.TimeCode(3)),
)


def attributes(type_name: str) -> list[str]:
    """What rules may read of a prim of that type: what USD or we know of it, and a field."""
    known: set[str] = {name for names in schema.API_ATTRIBUTES.values() for name in names}
    known |= {"filePath", "fieldName", "fieldIndex", "fieldDataType", "fieldClass", "extent"}
    known |= {"vectorDataRoleHint", "projectionModeHint", "sortingModeHint", "field:density"}
    definition = Usd.SchemaRegistry().FindConcretePrimDefinition(type_name)
    if definition:
        known |= {
            name
            for name in definition.GetPropertyNames()
            if definition.GetSpecType(name) == Sdf.SpecTypeAttribute
        }
    return sorted(known)


@pytest.mark.parametrize("type_name", TYPES, ids=lambda name: name or "untyped")
def test_no_rule_fails_on_garbage(
    type_name: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Every kind of value in every attribute: as the default, at a time, blocked, and together."""
    monkeypatch.chdir(tmp_path)
    layer = Sdf.Layer.CreateNew("stage.usda")
    for number, (value_type, value) in enumerate(GARBAGE):
        prim = Sdf.PrimSpec(layer, f"p{number}", Sdf.SpecifierDef, type_name)
        if number % 2:
            apis = Sdf.TokenListOp.Create(prependedItems=list(schema.API_INCLUDES))
            prim.SetInfo("apiSchemas", apis)
        for index, name in enumerate(attributes(type_name), start=number):
            spec = Sdf.AttributeSpec(prim, name, Sdf.ValueTypeNames.Find(value_type))
            given = spec.typeName.defaultValue if value is None else value
            if index % 3 != 1:
                spec.default = given
            if index % 3 != 0:
                layer.SetTimeSample(spec.path, -1.0, given)
                layer.SetTimeSample(spec.path, 2.5, Sdf.ValueBlock())
                layer.SetTimeSample(spec.path, 1e300, given)
            if index % 7 == 0:
                spec.default = Sdf.ValueBlock()
    layer.Save()
    report = everything.lint("stage.usda")
    assert failures(report.findings) == []
    assert report.stats["prims"] == len(GARBAGE)


RELATIONSHIPS = """
    rel field
    rel field:empty
    rel field:blocked = None
    rel field:gone = </gone>
    rel field:itself = </{name}>
    rel field:round = </{name}.field:round>
    rel field:one = </{name}.field:two>
    rel field:two = </{name}.field:one>
    rel field:all = [</gone>, </{name}/inner>, </{name}/inner.filePath>, </{name}/inner/deep>]
    rel field:a:b = </{name}/inner>
    rel field:c:b = <inner>
    double field:number = 3
    custom rel density = </{name}/inner>
    rel proxyPrim = </{name}/inner>
    rel material:binding = </{name}/inner>
"""


@pytest.mark.parametrize("type_name", TYPES, ids=lambda name: name or "untyped")
def test_no_rule_fails_on_strange_relationships(
    type_name: str, everything: Engine, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    inner = "".join(f'    def {type_name} "inner{n}"\n    {{\n    }}\n' for n in ("", 1))
    text = "#usda 1.0\n" + "".join(
        f'def {outer} "{name}"\n{{{RELATIONSHIPS.format(name=name)}{inner}}}\n'
        for outer, name in (("Volume", "volume"), (type_name, "other"))
    )
    (tmp_path / "stage.usda").write_text(text, encoding="utf-8")
    report = everything.lint("stage.usda")
    assert (report.status, failures(report.findings)) == ("checked", [])
