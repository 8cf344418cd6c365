"""Stages with variants as text, and what is found under which selection."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from pathlib import Path

from usdvol_lint.model import StageReport

RULES = ("AST002", "VOL001", "VOL012", "STG", "LNT")
LIMIT = 100
Lint = Callable[..., StageReport]


def write(layers: Mapping[str, str]) -> None:
    """Layers by name, with files that are there."""
    for name, text in layers.items():
        Path(f"{name}.usda").write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    for file in ("1.vdb", "2.vdb"):
        Path(file).write_bytes(b"not empty")


def found(report: StageReport) -> list[tuple[str, str | None, str | None]]:
    """What a report says: code, prim and variant."""
    return [(each.code, each.site.prim, each.site.variant) for each in report.findings]


def field(path: str, name: str = "d") -> str:
    return f'def OpenVDBAsset "{name}"\n{{\n    asset filePath = @./{path}.vdb@\n}}\n'


def volume(path: str, name: str = "v") -> str:
    """A Volume above the field that it lacks a relationship to: relative paths end in variants."""
    return f'def Volume "{name}"\n{{\n{field(path)}}}\n'


def variant_set(name: str, **variants: str) -> str:
    """A variant set; what begins with `(` is metadata of the variant."""
    inside = "".join(
        f'"{variant}" {text}\n' if text.startswith("(") else f'"{variant}" {{\n{text}}}\n'
        for variant, text in variants.items()
    )
    return f'variantSet "{name}" = {{\n{inside}}}\n'


def prim(name: str, *sets: str, inside: str = "", meta: str = "", **selected: str) -> str:
    names = ", ".join(f'"{text.split(chr(34))[1]}"' for text in sets)
    chosen = "".join(f'    string {key} = "{value}"\n' for key, value in selected.items())
    return (
        f'def Xform "{name}" (\n{meta}\nvariants = {{\n{chosen}}}\n'
        f"prepend variantSets = [{names}]\n)\n{{\n{''.join(sets)}{inside}}}\n"
    )


LOOKS = prim("model", variant_set("look", thick=volume("1"), thin=volume("9")), look="thick")
