"""The JSON Schema of a configuration knows every key, and takes what the tool takes."""

from __future__ import annotations

import json
import re
import tomllib
from datetime import date
from pathlib import Path
from typing import Any

import jsonschema
import pytest
from process import ROOT

from tools import configuration
from tools.keys import KEYS
from usdvol_lint.config.files import read_config
from usdvol_lint.config.values import CHECKS
from usdvol_lint.model import UsageError
from usdvol_lint.packs.activation import activate
from usdvol_lint.packs.catalog import Catalog
from usdvol_lint.run.layer_levels import verdicts
from usdvol_lint.run.suppressing import reasons

SCHEMA = json.loads(configuration.SCHEMA.read_text(encoding="utf-8"))
BLOCK = re.compile(r"^```toml\n(?P<text>.*?)^```$", re.MULTILINE | re.DOTALL)
BLOCKS = [
    block["text"]
    for path in sorted([ROOT / "README.md", *ROOT.glob("docs/*.md")])
    for block in BLOCK.finditer(path.read_text(encoding="utf-8"))
]
DATA = tomllib.loads((ROOT / "tools" / "words.toml").read_text(encoding="utf-8"))
# What a schema can't know: whether a file is there, which version this is, what is no pattern, what
# rules a pack has, which ones can't be ignored, and what no TOML of anybody's holds.
NOT_OF_THE_SCHEMA = (
    *("select = [\n", "'gone.toml'", "'.'", "'gone'", "'usdvol-lint.toml'", "'>=99'", "'!'"),
    *("LNT001", "'ASD'", "'aset'", "AST02'", "AST02 ", "file-mising", "\\u0000", "{digits}"),
)


def valid(data: Any) -> bool:
    return jsonschema.Draft7Validator(SCHEMA).is_valid(_of_json(data))


def _of_json(value: Any) -> Any:
    """What editors make of TOML: a date is a text."""
    if isinstance(value, dict):
        return {key: _of_json(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_of_json(item) for item in value]
    return value.isoformat() if isinstance(value, date) else value


def test_it_is_current_and_valid(catalog: Catalog) -> None:
    jsonschema.Draft7Validator.check_schema(SCHEMA)
    pages = {code: page for code in catalog.rules if (page := catalog.page(code))}
    assert configuration.schema(catalog, pages) == configuration.SCHEMA.read_text(encoding="utf-8")
    assert configuration.guide() == configuration.GUIDE.read_text(encoding="utf-8")


def test_every_key_is_in_it() -> None:
    assert list(KEYS) == list(SCHEMA["properties"]) == list(CHECKS)
    assert all(each["description"] for each in SCHEMA["properties"].values())
    assert not any("](" in each["description"] for each in SCHEMA["properties"].values())


@pytest.mark.parametrize("text", BLOCKS)
def test_what_the_guides_show_is_valid(text: str) -> None:
    data = tomllib.loads(text)
    if "project" not in data:
        assert valid(data.get("tool", {}).get("usdvol-lint", data))


@pytest.mark.parametrize("key", KEYS)
def test_examples_of_keys_are_valid(key: str) -> None:
    example = tomllib.loads(KEYS[key].example.strip("`"))
    assert example.keys() == {key}
    assert valid(example)


@pytest.mark.parametrize("text", DATA["configurations"])
def test_what_the_tool_refuses_is_not(text: str) -> None:
    if not any(part in f"{text}\n" for part in NOT_OF_THE_SCHEMA):
        assert not valid(tomllib.loads(text))


@pytest.mark.parametrize(
    "text",
    [
        "select = ['AST', 'asset', 'AST00', 'file-missing', 'ALL', 'XYZ123', 'house', 'all', 'as']",
        "ignore = ['GRID', 'Asset', 'House2', 'FILE-missing', 'Ast002', 'All']",
        "severity = { Asset = 'info', GRID = 'error' }",
        "suppress = [{ rules = 'Grid', reason = 'x' }]",
        "severity = { XYZ = 'info', volume-name = 'error', degenerate = 'info' }",
        "options.volume-name.allowed = ['fog']",
        "options.XYZ001.allowed = { a = 1 }",
        "options.sh-degree-unusual.largest = 4",
        "options.ARR006.largest = 4",
        "options.opacity-out-of-range.tolerance = 1",
        "required-version = '0.1'",
        "required-version = ' >= 0.1 , != 0.2 '",
        "times = '10'",
        "suppress = [{ rules = 'asset', reason = 'x', until = 2026-12-31 }]",
        "select = []",
    ],
)
def test_what_the_tool_takes_is_valid(text: str) -> None:
    assert valid(tomllib.loads(text))


@pytest.mark.parametrize(
    "text",
    [
        "select = ['AST02x']",
        "select = ['']",
        "fail_on = 'info'",
        "options.sh-degree-unusual.larges = 4",
        "options.sh-degree-unusual.largest = 4.5",
        "options.file-missing.strict = true",
        "per-path = [{ files = 'a' }]",
        "per-path = [{ files = 'a', severity = {} }]",
        "per-path = [{ severity = { AST = 'info' } }]",
        "per-path = [{ files = 'a', severity = { AST = 'off' } }]",
        "severity = { 'AST 2' = 'info' }",
        "show = 'info'",
        "timeout = 0",
        "times = '0'",
        "today = '31.12.2026'",
    ],
)
def test_what_it_refuses_the_tool_refuses(text: str, catalog: Catalog, tmp_path: Path) -> None:
    assert not valid(tomllib.loads(text))
    file = tmp_path / "usdvol-lint.toml"
    file.write_text(text, encoding="utf-8")
    with pytest.raises(UsageError):
        _use(file, catalog)


def _use(file: Path, catalog: Catalog) -> None:
    config = read_config(file)
    activate(config, catalog)
    reasons(config, catalog, None)
    verdicts(config, catalog)
