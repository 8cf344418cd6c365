"""The JSON Schema of a configuration, for editors, and the table of keys for people."""

from __future__ import annotations

import json
import re
from collections.abc import Iterator, Mapping
from pathlib import Path
from typing import Any

from tools.keys import KEYS
from usdvol_lint.config import LEVELS
from usdvol_lint.packs.catalog import NOT_IGNORABLE, Catalog
from usdvol_lint.packs.page import Page
from usdvol_lint.rule import Rule

ROOT = Path(__file__).parent.parent
SCHEMA = ROOT / "usdvol_lint" / "config" / "usdvol-lint.schema.json"
GUIDE = ROOT / "docs" / "configuration.md"

_LINK = re.compile(r"\[([^\]]+)\]\([^)]*\)")
_TABLE = re.compile(r"(?s)(?<=<!-- keys: made by `make generate` of tools/keys.py -->\n).*?(?=\n#)")
_SELECTOR = (
    "^(ALL|all|[A-Za-z]{1,3}|[A-Za-z]{3}[0-9]{1,3}|[a-z][a-z0-9]*|[A-Za-z]{4}[A-Za-z0-9]*|"
    "[A-Za-z][A-Za-z0-9]*(-[A-Za-z0-9]+)+)$"
)
"""A code or its beginning, a family, or the name of a rule: packs bring others than the known."""
_KINDS = {bool: "boolean", int: "integer", float: "number", str: "string"}


def guide() -> str:
    """docs/configuration.md with its table of keys."""
    rows = [
        f"| `{key}` | {each.words} | {each.default} | {each.example} |"
        for key, each in KEYS.items()
    ]
    table = "\n".join(
        ["", "| key | what it says | default | example |", "|---|---|---|---|", *rows]
    )
    return _TABLE.sub(lambda _: f"{table}\n", GUIDE.read_text(encoding="utf-8"), count=1)


def schema(catalog: Catalog, pages: Mapping[str, Page]) -> str:
    """The text of the JSON Schema; it is of the draft that editors read TOML with."""
    built_in = {code: rule for code, rule in catalog.rules.items() if code not in NOT_IGNORABLE}
    properties = {
        key: {"description": _plain(each.words), **_inline(each.schema)}
        for key, each in KEYS.items()
    }
    whole = {
        "$schema": "http://json-schema.org/draft-07/schema#",
        "title": "usdvol-lint.toml",
        "description": "The configuration of usdvol-lint; what is not here is an error.",
        "type": "object",
        "additionalProperties": False,
        "properties": properties,
        "definitions": {
            "level": {"enum": list(LEVELS)},
            "selector": _selector(catalog),
            "severity": _severity(built_in, pages),
            "options": _options(built_in, pages),
        },
    }
    return json.dumps(whole, indent=2, ensure_ascii=False) + "\n"


def _inline(schema: Mapping[str, Any]) -> Mapping[str, Any]:
    """A reference with nothing beside it, since this draft ignores what is."""
    return {"allOf": [schema]} if "$ref" in schema else schema


def _plain(words: str) -> str:
    """Words without links and marks."""
    return _LINK.sub(r"\1", words).replace("`", "")


def _selector(catalog: Catalog) -> dict[str, Any]:
    names = [rule.name for rule in catalog.rules.values()]
    letters = sorted({code[:3] for code in catalog.rules})
    known = ["ALL", *letters, *sorted(catalog.families), *catalog.rules, *names]
    return {
        "description": "A code or its beginning, the name of a rule or a family, or ALL.",
        "anyOf": [{"enum": known}, {"type": "string", "pattern": _SELECTOR}],
    }


def _severity(rules: Mapping[str, Rule], pages: Mapping[str, Page]) -> dict[str, Any]:
    level = {"$ref": "#/definitions/level"}
    return {
        "type": "object",
        "properties": {
            name: {"description": _summary(pages, code), "allOf": [level]}
            for code, rule in rules.items()
            for name in (code, rule.name)
        },
        "propertyNames": {"pattern": _SELECTOR},
        "additionalProperties": level,
    }


def _options(rules: Mapping[str, Rule], pages: Mapping[str, Page]) -> dict[str, Any]:
    return {
        "type": "object",
        "properties": {
            name: {"description": _summary(pages, code), **_of_rule(rule)}
            for code, rule in rules.items()
            for name in (code, rule.name)
        },
        "propertyNames": {"pattern": _SELECTOR},
        "additionalProperties": {"type": "object"},
    }


def _of_rule(rule: Rule) -> dict[str, Any]:
    if not rule.options:
        return {"type": "object", "maxProperties": 0}
    properties = dict(_of_options(rule))
    return {"type": "object", "properties": properties, "additionalProperties": False}


def _of_options(rule: Rule) -> Iterator[tuple[str, dict[str, Any]]]:
    for name, default in rule.options.items():
        if isinstance(default, tuple):
            yield name, {"type": "array", "items": {"type": "string"}, "default": list(default)}
        else:
            yield name, {"type": _KINDS[type(default)], "default": default}


def _summary(pages: Mapping[str, Page], code: str) -> str:
    return _plain(pages[code].summary) if code in pages else code
