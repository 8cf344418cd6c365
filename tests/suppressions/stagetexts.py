"""Stages with suppressions as text, and what is found on them in short."""

from __future__ import annotations

from collections.abc import Iterable

from usdvol_lint.model import Finding


def ignoring(**reasons: str | int) -> str:
    """The dictionary that ignores codes for reasons."""
    lines = "".join(
        f"string {code} = {reason!r}\n" if isinstance(reason, str) else f"int {code} = {reason}\n"
        for code, reason in reasons.items()
    )
    return f"dictionary usdvolLint = {{\ndictionary ignore = {{\n{lines}}}\n}}\n"


def on_prim(**reasons: str | int) -> str:
    return f"customData = {{\n{ignoring(**reasons)}}}\n"


def on_layer(*others: str, **reasons: str | int) -> str:
    """The metadata of a layer."""
    own = f"customLayerData = {{\n{ignoring(**reasons)}}}"
    return "\n".join(("(", *others, own, ")\n"))


def prim(name: str, *metadata: str, inside: str = "", kind: str = "def Xform") -> str:
    lines = "\n".join(metadata)
    return f'{kind} "{name}" (\n{lines}\n)\n{{\n{inside}}}\n'


def field(*metadata: str, name: str = "density", file: str = "gone") -> str:
    """A field whose file is missing: AST002."""
    inside = f'asset filePath = @./{file}.vdb@\ntoken fieldDataType = "float"\n'
    return prim(name, *metadata, inside=inside, kind="def OpenVDBAsset")


def smoke(*metadata: str, inside: str = "") -> str:
    """An asset with a field whose file is missing, below its default prim."""
    return prim("Smoke", *metadata, inside=inside or field())


DEFAULT = 'defaultPrim = "Smoke"'
ASSET = f"({DEFAULT})\n{smoke()}"
REFERENCE = "references = @./asset.usda@"
INSTANCE = f"{REFERENCE}\ninstanceable = true"
GONE = "no file at './gone.vdb'"


def inherited(inside: str) -> str:
    """Two instances of a class in the stage itself."""
    return prim("Rig", inside=inside, kind="class") + "".join(
        prim(name, "inherits = </Rig>\ninstanceable = true", kind="def") for name in "AB"
    )


def found(findings: Iterable[Finding]) -> list[tuple[str, str | None, str | None]]:
    """Code, prim and the reason why it is ignored."""
    return [(each.code, each.site.prim, each.ignored) for each in findings]


def told(findings: Iterable[Finding]) -> list[str]:
    """What is said of suppressions."""
    return [each.message for each in findings if each.code == "LNT003"]


def messages(findings: Iterable[Finding]) -> list[tuple[str | None, str | None, str]]:
    """Prim, the reason why it is ignored, and what is said."""
    return [(each.site.prim, each.ignored, each.message) for each in findings]
