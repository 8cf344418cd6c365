"""docs/words.txt: all that the tool says to its users, on one page, to be read aloud."""

from __future__ import annotations

import io
import re
import tomllib
from collections.abc import Iterable, Iterator, Mapping
from contextlib import chdir, redirect_stderr
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Any

from usdvol_lint.command import cli
from usdvol_lint.config import Config
from usdvol_lint.packs.catalog import NOT_CHECKED, Catalog
from usdvol_lint.packs.examples import words_of
from usdvol_lint.run.testing import findings_in, portable

ROOT = Path(__file__).parent.parent
DATA = ROOT / "tools" / "words.toml"
TARGET = ROOT / "docs" / "words.txt"

_HEAD = """\
All that usdvol-lint says: of the examples on the pages of rules, and of the bad input that
tools/words.toml lists. Made by `make generate`, to be read aloud: each message says what was found,
what was wanted, and what to do.
"""
_FINDING = re.compile(
    r"^  \S.*?: (?P<code>[A-Z]{3}\d{3}) (?P<level>error|warning|info)\b.*\n"
    r"    (?P<said>.*\n(?:    help: .*\n)?)",
    re.MULTILINE,
)
_RULE = """\
from usdvol_lint.rule import ERROR, rule


@rule("{code}", on={on}, severity=ERROR, since="1")
def {name}(prim, facts):
    yield from ()
"""
_FIRST = (
    '{"usdvol_lint_baseline":1,"fingerprint_version":1,"root":".","arguments":[],"settings":'
    '{"rules":{},"load":"all","content":"all","times":"all","variants":"selected"}}'
)
_SAID = {
    "{first}": _FIRST,
    "{other}": _FIRST.replace('"."', '".."'),
    "{nowhere}": _FIRST.replace('"."', '"a\\u0000b"'),
    "{digits}": "9" * 5000,
}
_ROUGH = ROOT / "tests" / "packs" / "rough"
_VOLUME = (
    '#usda 1.0\ndef Volume "{name}"\n{{\n    float3[] extent = [(0, 0, 0), (1, 1, 1)]\n'
    "    rel field:d = </{name}/d>\n"
    '    def OpenVDBAsset "d"\n    {{\n        token fieldName = "d"\n    }}\n}}\n'
)
_LIMIT = 5.0
"""Seconds after which a stage that hangs is given up, which others must not need."""


def all_on_one_page(catalog: Catalog, words: Iterable[str]) -> str:
    """The page, of what stands in the files of words beside the pages of rules."""
    data = tomllib.loads(DATA.read_text(encoding="utf-8"))
    return "\n".join([_HEAD, *by_code(catalog, words), *_of_bad_input(data)])


def by_code(catalog: Catalog, words: Iterable[str]) -> Iterator[str]:
    """A paragraph for each code, family by family: each thing that is said, once."""
    said: dict[str, dict[str, None]] = {}
    for text in words:
        for found in _FINDING.finditer(text):
            said.setdefault(found["code"], {})[f"  {found['level']}: {found['said']}"] = None
    for code in sorted(said):
        rule = catalog.rules[code]
        yield f"{code} {rule.name}\n{''.join(said[code])}"


def _of_bad_input(data: Mapping[str, Any]) -> Iterator[str]:
    with TemporaryDirectory() as temporary, chdir(temporary):
        here = Path.cwd()
        (here / "smoke.usda").write_text("#usda 1.0\n", encoding="utf-8")
        (here / "pyproject.toml").write_text("", encoding="utf-8")
        yield _paragraph("The command line", map(_said_to, data["commands"]))
        yield _paragraph("A configuration file", map(_said_of_settings, data["configurations"]))
        yield _paragraph("A configuration file that was found", map(_said_of_found, data["found"]))
        yield _paragraph("A pyproject.toml", map(_said_of_project, data["projects"]))
        yield _paragraph("A file by another name", map(_said_of_name, data["misnamed"]))
        yield _paragraph("A folder in its place", map(_said_of_folder, data["folders"]))
        yield _paragraph("A baseline", map(_said_of_baseline, data["baselines"]))
        packs = (_said_of_pack(name, modules) for name, modules in data["packs"].items())
        yield _paragraph("A pack of rules", packs)
        yield _paragraph("A stage", _said_of_stages(data["stages"], here))
        partly = (_said_of_part(name, made, here) for name, made in data["partly"].items())
        yield _paragraph("A stage that is checked in part", partly)


def _paragraph(title: str, entries: Iterable[str]) -> str:
    return "\n".join([f"{title}\n", *entries])


def _said_to(arguments: str, shown: str = "") -> str:
    """What the command line says before it looks at a stage."""
    said = io.StringIO()
    with redirect_stderr(said):
        cli.main(arguments.split())
    words = said.getvalue().replace(f"{Path.cwd()}/", "").rstrip("\n").splitlines()
    title = shown or f"usdvol-lint {arguments}".rstrip()
    return "".join(f"  {line}\n" for line in (title, *(f"  {word}" for word in words)))


def _said_of_settings(text: str) -> str:
    written = text.replace("{digits}", _SAID["{digits}"])
    Path("usdvol-lint.toml").write_text(f"{written}\n", encoding="utf-8")
    return _said_to("--show-settings --config usdvol-lint.toml", text)


def _said_of_found(text: str) -> str:
    own = Path("usdvol-lint.toml")
    own.write_text(f"{text}\n", encoding="utf-8")
    said = _said_to("--show-settings", text)
    own.unlink()
    return said


def _said_of_project(text: str) -> str:
    project = Path("pyproject.toml")
    project.write_text(f"{text}\n", encoding="utf-8")
    return _said_to("--show-settings --config pyproject.toml", " | ".join(text.splitlines()))


def _said_of_name(name: str) -> str:
    own = Path("usdvol-lint.toml")
    own.unlink(missing_ok=True)
    Path(name).touch()
    said = _said_to("--show-settings", name)
    Path(name).unlink()
    return said


def _said_of_folder(name: str) -> str:
    Path(name).mkdir()
    said = _said_to("--show-settings", name)
    Path(name).rmdir()
    return said


def _said_of_baseline(text: str) -> str:
    holds = text
    for name, said in _SAID.items():
        holds = holds.replace(name, said)
    Path("known.jsonl").write_text(holds, encoding="utf-8")
    shown = f"known.jsonl: {' | '.join(text.splitlines()).replace('{first}', '…')}".rstrip()
    return _said_to("--isolated --baseline known.jsonl smoke.usda", shown)


def _said_of_pack(name: str, modules: Mapping[str, str]) -> str:
    folder = Path(name)
    folder.mkdir()
    for module, text in modules.items():
        (folder / f"{module}.py").write_text(_module(text), encoding="utf-8")
    holds = "; ".join(modules.values())
    return _said_to(f"--isolated --pack {name} smoke.usda", f"--pack {name}: {holds}")


def _module(text: str) -> str:
    """The text of a module; of `{rule} CODE name types`, that of a rule which finds nothing."""
    if not text.startswith("{rule}"):
        return text
    _, code, name, *types = text.split()
    return _RULE.format(code=code, name=name, on=repr(tuple(types)))


def _said_of_stages(stages: Mapping[str, Mapping[str, Any]], here: Path) -> Iterator[str]:
    for name, made in stages.items():
        _write(Path(name), made)
    config = Config(packs=(str(_ROUGH),), select=("RGH",), timeout=_LIMIT)
    for found in findings_in(list(stages), config):
        yield words_of(portable(found, here))


def _said_of_part(name: str, made: Mapping[str, Any], here: Path) -> str:
    """What is said of a stage of which something is not checked."""
    asked = {key: value for key, value in made.items() if key not in ("text", "repeated")}
    text = f"#usda 1.0\n{made['text']}"
    if again := made.get("repeated"):
        for number in range(again["count"]):
            one = again["text"].replace("{n}", f"{number}")
            text += one.replace("{next}", f"{number + 1}")
    Path(name).write_text(text, encoding="utf-8")
    [found] = findings_in([name], Config(timeout=_LIMIT, **asked))
    return words_of(tuple(each for each in portable(found, here) if each.code == NOT_CHECKED.code))


def _write(path: Path, made: Mapping[str, Any]) -> None:
    """What stands for a stage; nothing, if it is to be missing."""
    if "link" in made:
        path.symlink_to(made["link"])
    elif "bytes" in made:
        path.write_bytes(bytes.fromhex(made["bytes"]).ljust(made.get("size", 0), b"\0"))
    elif "prim" in made:
        path.write_text(_VOLUME.format(name=made["prim"]), encoding="utf-8")
    elif "text" in made:
        path.write_text(made["text"], encoding="utf-8")
