"""What holds for every rule and every module, whoever writes the next one."""

from __future__ import annotations

import ast
import inspect
import re
from collections.abc import Iterator
from pathlib import Path
from statistics import median

import pytest
from process import ROOT

from usdvol_lint import schema
from usdvol_lint.facts.usd.kinds import is_registered
from usdvol_lint.model import Severity
from usdvol_lint.packs.catalog import ENGINE_RULES, Catalog
from usdvol_lint.rule import ABSTRACT_TYPE, STAGE, UNKNOWN_TYPE, Rule

ENGINE = ROOT / "usdvol_lint"
RULES = ROOT / "rules"

PACKAGES = (
    {"words", "nearest", "replacing", "deferred", "cached", "gitignore"},
    {"model"},
    {"results", "releases"},
    {"suppressions"},
    {"schema", "paths", "config"},
    {"spelling", "files"},
    {"volumefile"},
    {"layertext"},
    {"facts"},
    {"precondition"},
    {"rule"},
    {"packs"},
    {"baseline"},
    {"engine"},
    {"child"},
    {"run"},
    {"report"},
    {"command"},
    {"asserting", "__main__"},
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
WITH_USD = ("facts/*/*.py", "layertext/source.py", "engine/*.py", "run/worker.py")
WITHOUT_USD = (
    "facts/*/__init__.py",
    "facts/*/states.py",
    "engine/__init__.py",
    "engine/trouble.py",
)
"""What the parent process may import: there neither pxr nor numpy may be named at module level."""

LONGEST_RULE = 49
LONGEST_HALF_OF_RULES = 21
"""How many lines a rule's module has at most, and how many the shorter half of them have."""

LONGEST_WING = 200
LONGEST_MODULE = 300
LONGEST_FUNCTION = 40
LONGEST_HALF_OF_FUNCTIONS = 6
"""How many lines a wing's class, a module and a function have at most."""

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


@pytest.mark.parametrize("module", ["model", "results"])
def test_the_data_of_a_run_knows_nothing_of_usd(module: str) -> None:
    for name, _ in imports(ENGINE / f"{module}.py"):
        root, _, rest = name.partition(".")
        assert root not in {"pxr", "numpy"}
        assert root != "usdvol_lint" or rest.partition(".")[0] in {"words", "model"}


@pytest.mark.parametrize("path", ENGINE_MODULES, ids=lambda path: str(path.relative_to(ENGINE)))
def test_modules_say_what_they_are(path: Path) -> None:
    words = ast.get_docstring(tree(path))
    assert words
    assert words.partition("\n")[0].endswith((".", "`."))


def test_every_part_is_short() -> None:
    """A longer wing lists what its modules should do, a longer function does two things."""
    modules = {path.relative_to(ENGINE).as_posix(): path for path in ENGINE_MODULES}
    lines = {name: len(path.read_text("utf-8").splitlines()) for name, path in modules.items()}
    assert {name for name, count in lines.items() if count > LONGEST_MODULE} == set()
    wings = {f"facts/{name}/__init__.py" for name in WINGS}
    assert {
        node.name: _length(node)
        for name in wings
        for node in tree(modules[name]).body
        if isinstance(node, ast.ClassDef) and _length(node) > LONGEST_WING
    } == {}
    functions = [
        node
        for path in ENGINE_MODULES
        for node in ast.walk(tree(path))
        if isinstance(node, ast.FunctionDef)
    ]
    assert {each.name for each in functions if _length(each) > LONGEST_FUNCTION} == set()
    assert median(map(_length, functions)) <= LONGEST_HALF_OF_FUNCTIONS


def _length(node: ast.ClassDef | ast.FunctionDef) -> int:
    assert node.end_lineno is not None
    return node.end_lineno - node.lineno + 1


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
    for node in ast.walk(module):
        if isinstance(node, ast.keyword) and node.arg == "since":
            assert re.fullmatch(r"\d+\.\d+", ast.literal_eval(node.value)), "read by rules-as-of"
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


# --- what pages claim -----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "path", sorted((ROOT / "tests" / "claims").glob("test_*.py")), ids=lambda path: path.stem
)
def test_claims_are_those_of_pages(path: Path, catalog: Catalog) -> None:
    """A test of a claim names the page that makes it, and stands with those of its family."""
    family = path.stem.removeprefix("test_").removesuffix("_claims")
    names = [node.name for node in tree(path).body if isinstance(node, ast.FunctionDef)]
    for name in (name for name in names if name.startswith("test")):
        code = name.split("_")[1]
        page = catalog.page(code) if code in catalog.rules else None
        assert page, f"{name} names no page"
        assert page.path.parent.name == family, f"{name} is in another family's module"
