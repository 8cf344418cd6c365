"""Walks over stages that are given as text."""

from __future__ import annotations

from pathlib import Path

from usdvol_lint.model import Severity
from usdvol_lint.rule import Rule


def asks(code: str, *on: str) -> Rule:
    return Rule(code, code.lower(), on, Severity.INFO, "1", lambda prim, facts: iter(()), {})


def write_stage(folder: Path, text: str, **layers: str) -> str:
    for name, layer in layers.items():
        (folder / f"{name}.usda").write_text(f"#usda 1.0\n{layer}", encoding="utf-8")
    path = folder / "stage.usda"
    path.write_text(f"#usda 1.0\n{text}", encoding="utf-8")
    return str(path)


def instancer(name: str, *prototypes: str, below: str = "") -> str:
    targets = ", ".join(f"<{path}>" for path in prototypes)
    return f'def PointInstancer "{name}"\n{{\nrel prototypes = [{targets}]\n{below}}}\n'


LIVE = 'def Volume "live"\n{\n}\n'
CLOUD = 'def Xform "cloud"\n{\n    def Volume "thick"\n    {\n    }\n}\n'
INSTANCE = 'def "{}" (\n    instanceable = true\n    references = @./lib.usda@</{}>\n)\n{{\n}}\n'
