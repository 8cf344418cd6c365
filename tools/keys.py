"""Every key of a configuration: what it says, what it may be, and an example."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

from usdvol_lint.config import (
    CONTENTS,
    FAIL_ON,
    LOADS,
    OUTPUT_FORMATS,
    SHOWABLE,
    SUPPRESSIONS,
    TIMES,
    VARIANTS,
)
from usdvol_lint.config.values import LONGEST_TIMEOUT


class Key(NamedTuple):
    """A key: what it says, its default and an example as a document has them, and its JSON Schema.

    Links in `words` are those of docs/configuration.md.
    """

    words: str
    default: str
    example: str
    schema: Mapping[str, Any]


def _one_of(values: tuple[str, ...]) -> dict[str, Any]:
    return {"enum": list(values)}


def _ref(name: str) -> dict[str, Any]:
    return {"$ref": f"#/definitions/{name}"}


def _list_of(item: Mapping[str, Any]) -> dict[str, Any]:
    return {"type": "array", "items": item}


_TEXT = {"type": "string", "minLength": 1}
_SELECTORS = _list_of(_ref("selector"))
_PATTERNS = {"anyOf": [_TEXT, {**_list_of(_TEXT), "minItems": 1}]}
_DATE = {"type": "string", "pattern": r"^\d{4}-\d{2}-\d{2}$"}

_SUPPRESS = {
    "type": "object",
    "properties": {
        "files": _PATTERNS,
        "stages": _PATTERNS,
        "prims": _PATTERNS,
        "rules": {"anyOf": [_ref("selector"), {**_SELECTORS, "minItems": 1}]},
        "reason": _TEXT,
        "until": _DATE,
    },
    "required": ["reason"],
    "anyOf": [{"required": [key]} for key in ("files", "stages", "prims", "rules")],
    "additionalProperties": False,
}
_PER_PATH = {
    "type": "object",
    "properties": {"files": _PATTERNS, "severity": _ref("severity"), "ignore": _SELECTORS},
    "required": ["files"],
    "anyOf": [
        {"required": ["severity"], "properties": {"severity": {"minProperties": 1}}},
        {"required": ["ignore"], "properties": {"ignore": {"minItems": 1}}},
    ],
    "additionalProperties": False,
}

KEYS: Mapping[str, Key] = {
    "extend": Key(
        "another configuration file, which this one [stands on](#a-studios-file), relative to this "
        "file",
        "none",
        '`extend = "../studio/usdvol-lint.toml"`',
        _TEXT,
    ),
    "select": Key(
        "[selectors](#selectors) of the rules that are on; `[]` is none",
        "every rule that is on by default",
        '`select = ["AST", "extent-too-small"]`',
        _SELECTORS,
    ),
    "ignore": Key(
        "selectors of rules that are off", "`[]`", '`ignore = ["VOL012", "grid"]`', _SELECTORS
    ),
    "severity": Key(
        'table of selector = `"error"`, `"warning"` or `"info"`',
        "each rule's own",
        '`severity = { AST002 = "warning" }`',
        _ref("severity"),
    ),
    "options": Key(
        "table of the code or name of a rule = table of its options, which its page names",
        "each rule's own",
        "`options.sh-degree-unusual.largest = 4`",
        _ref("options"),
    ),
    "packs": Key(
        "folders with [rules](getting-started.md#a-rule-pack-of-your-own), relative to this file, "
        "which `--config` has to name then; installed packs by their names",
        "`[]`",
        '`packs = ["pipeline/rules"]`',
        _list_of(_TEXT),
    ),
    "fail-on": Key(
        'the level from which on a run exits with 1: `"error"`, `"warning"`, `"info"` or `"never"`',
        '`"error"`',
        '`fail-on = "warning"`',
        _one_of(FAIL_ON),
    ),
    "fail-on-unchecked": Key(
        "true or false: exit with 1 if something could not be checked",
        "`false`",
        "`fail-on-unchecked = true`",
        {"type": "boolean"},
    ),
    "output-format": Key(
        "the format of the report: "
        + ", ".join(f'`"{name}"`' for name in OUTPUT_FORMATS[1:])
        + '; `"auto"` is `"full"`, and in GitHub Actions annotations and a summary too',
        '`"auto"`',
        '`output-format = "concise"`',
        _one_of(OUTPUT_FORMATS),
    ),
    "show": Key(
        'what reports for people show beside what counts: `"info"`, `"known"` (in the baseline), '
        '`"suppressed"`, `"unused"` (suppressions that match nothing)',
        "`[]`",
        '`show = ["info", "known"]`',
        _list_of(_one_of(SHOWABLE)),
    ),
    "jobs": Key(
        "the number of worker processes; 0 is one for each processor",
        "`0`",
        "`jobs = 4`",
        {"type": "integer", "minimum": 0},
    ),
    "timeout": Key(
        "seconds for one stage",
        "`300.0`",
        "`timeout = 60`",
        {"type": "number", "exclusiveMinimum": 0, "maximum": LONGEST_TIMEOUT},
    ),
    "memory-limit": Key(
        'memory that one worker process may keep for itself, such as `"4G"` or `"500M"`; '
        '`"none"` is any, `"auto"` four fifths of what there is, divided by `jobs`',
        '`"auto"`',
        '`memory-limit = "4G"`',
        {
            "anyOf": [
                {"enum": ["auto", "none"]},
                {"type": "integer", "minimum": 0},
                {
                    "type": "string",
                    "pattern": r"^\s*\d{1,15}(\.\d{1,6})?\s*[KMGTkmgt]?([Ii]?[Bb])?\s*$",
                },
            ]
        },
    ),
    "load": Key('payloads: `"all"` or `"none"`', '`"all"`', '`load = "none"`', _one_of(LOADS)),
    "content": Key(
        'the files of each field that are looked into: `"all"`, `"first"` or `"off"`',
        '`"all"`',
        '`content = "first"`',
        _one_of(CONTENTS),
    ),
    "variants": Key(
        'variants as `"selected"`, or `"all"`: each other one in turn too',
        '`"selected"`',
        '`variants = "all"`',
        _one_of(VARIANTS),
    ),
    "variant-limit": Key(
        "how many other selections of one stage are composed at most",
        "`100`",
        "`variant-limit = 500`",
        {"type": "integer", "minimum": 1},
    ),
    "times": Key(
        'the time samples of particles that are looked at: `"all"`, `"first"`, `"ends"`, or a '
        "number from 1, so many evenly spread",
        '`"all"`',
        "`times = 10`",
        {
            "anyOf": [
                _one_of(TIMES),
                {"type": "integer", "minimum": 1},
                {"type": "string", "pattern": "^0*[1-9][0-9]*$"},
            ]
        },
    ),
    "statistics": Key(
        "true or false: what particle fields hold, in the text report and as JSON",
        "`false`",
        "`statistics = true`",
        {"type": "boolean"},
    ),
    "max-places": Key(
        "how many places of a cause a report has in full",
        "`20`",
        "`max-places = 5`",
        {"type": "integer", "minimum": 1},
    ),
    "root": Key(
        "the folder that layers go by in patterns and fingerprints, relative to this file: see "
        "[Causes and fingerprints](getting-started.md#causes-and-fingerprints)",
        "none",
        '`root = "."`',
        _TEXT,
    ),
    "version-pattern": Key(
        "regular expression of a version in a path: all versions of a layer have one fingerprint",
        "none",
        '`version-pattern = "v[0-9]+"`',
        {**_TEXT, "format": "regex"},
    ),
    "baseline": Key(
        "the file that has what is known, relative to this one: see [Baselines](baseline.md)",
        "none",
        '`baseline = "usdvol-lint-baseline.jsonl"`',
        _TEXT,
    ),
    "required-version": Key(
        "versions of usdvol-lint that this file is for; another one exits with 2: see "
        "[Versions](versioning.md)",
        "none",
        '`required-version = ">=0.1,<0.2"`',
        {
            "type": "string",
            "pattern": r"^ *(([<>=!]=|<|>)? *\d+(\.\d+)* *)(, *([<>=!]=|<|>)? *\d+(\.\d+)* *)*$",
        },
    ),
    "rules-as-of": Key(
        "a release: built-in rules that are younger report infos, see [Versions](versioning.md)",
        "none",
        '`rules-as-of = "0.1"`',
        {"type": "string", "pattern": r"^ *\d+(\.\d+)* *$"},
    ),
    "suppressions": Key(
        'which suppressions are heeded: `"all"`, `"configuration"` (none of those in stages) or '
        '`"none"`: see [Suppressions](suppressions.md)',
        '`"all"`',
        '`suppressions = "configuration"`',
        _one_of(SUPPRESSIONS),
    ),
    "suppress": Key(
        "tables of what is suppressed, and why: see [Suppressions](suppressions.md)",
        "`[]`",
        '`suppress = [{ files = "old/**", reason = "an archive" }]`',
        _list_of(_SUPPRESS),
    ),
    "per-path": Key(
        "tables of what is otherwise for some layers: see [Some layers only](#some-layers-only)",
        "`[]`",
        '`per-path = [{ files = "lookdev/**", severity = { ALL = "info" } }]`',
        _list_of(_PER_PATH),
    ),
    "today": Key(
        "a date, in place of today's in UTC, by which suppressions expire",
        "none",
        "`today = 2026-12-31`",
        _DATE,
    ),
    "exclude": Key(
        "patterns as in a .gitignore of stages that are not checked, relative to this file: see "
        "[Which files are checked](files.md)",
        "`[]`",
        '`exclude = ["archive/"]`',
        _list_of({"type": "string", "minLength": 1}),
    ),
    "stages": Key(
        "patterns of the stages that are wholes; all others are parts, which lack nothing",
        "every stage",
        '`stages = ["shots/**/shot.usda"]`',
        _list_of({"type": "string", "minLength": 1}),
    ),
    "frames": Key(
        "the production's range, in place of that of each stage",
        "none",
        '`frames = "1001-1100"`',
        {"type": "string", "pattern": r"^\s*-?\d+(\.\d+)?\s*-\s*-?\d+(\.\d+)?\s*$"},
    ),
    "search-path": Key(
        "folders where USD's resolver looks, relative to this file",
        "`[]`",
        '`search-path = ["library"]`',
        _list_of({"type": "string", "minLength": 1}),
    ),
    "assume-present": Key(
        "patterns of the absolute paths of volume files that are taken to be there",
        "`[]`",
        '`assume-present = ["/mnt/show/**"]`',
        _list_of({"type": "string", "minLength": 1}),
    ),
    "path-map": Key(
        "table of beginnings of paths, and where volume files with them really are",
        "`{}`",
        '`path-map = { "P:/" = "/mnt/show/" }`',
        {
            "type": "object",
            "propertyNames": {"minLength": 1},
            "additionalProperties": {"type": "string", "minLength": 1},
        },
    ),
}
