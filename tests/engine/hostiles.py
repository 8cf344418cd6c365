"""Small stages that show or hold more than can be walked, each kind by a function."""

from __future__ import annotations

HEADER = '#usda 1.0\n(\n metersPerUnit = 1\n upAxis = "Y"\n defaultPrim = "w"\n)\n'
VOLUME = 'def Volume "v"\n{\nrel field:density = </nowhere>\n}\n'
FIELD = 'def OpenVDBAsset "f"\n{\nasset filePath = @./gone.vdb@\ntoken fieldName = "d"\n}\n'


def instance(name: str, of: str, specifier: str = "def") -> str:
    return f'{specifier} Xform "{name}" (\ninstanceable = true\nreferences = <{of}>\n)\n{{\n}}\n'


TWO = instance("a", "/_tree/l0") + instance("b", "/_tree/l0")


def tree(levels: int, leaf: str) -> str:
    """Prims with two instances of the next each: `</_tree/l0>` shows the leaf 2 ** levels times."""
    prims = [
        f'def Xform "l{level}"\n{{\n'
        + instance("a", f"/_tree/l{level + 1}")
        + instance("b", f"/_tree/l{level + 1}")
        + "}\n"
        for level in range(levels)
    ]
    return f'class "_tree"\n{{\n{"".join(prims)}def Xform "l{levels}"\n{{\n{leaf}}}\n}}\n'


def chain(levels: int, leaf: str) -> str:
    """As `tree`, with one instance each."""
    prims = [
        f'def Xform "l{level}"\n{{\n' + instance("a", f"/_tree/l{level + 1}") + "}\n"
        for level in range(levels)
    ]
    return f'class "_tree"\n{{\n{"".join(prims)}def Xform "l{levels}"\n{{\n{leaf}}}\n}}\n'


def nested(levels: int, leaf: str, top: str = 'def Xform "w"\n{\n') -> str:
    """A leaf below so many prims."""
    return top + 'def Xform "p"\n{\n' * levels + leaf + "}\n" * (levels + 1)


def world(*inside: str, kind: str = "Xform") -> str:
    return f'def {kind} "w"\n{{\n{"".join(inside)}}}\n'


def forwarding(links: int) -> str:
    """A Volume whose relationships all lead into one chain of others, and that to its field."""
    chained = (f"rel r{link} = </w.r{link + 1}>\n" for link in range(links))
    bound = (f"rel field:n{link} = </w.r{link}>\n" for link in range(links))
    volume = f'def Volume "v"\n{{\n{"".join(bound)}{FIELD}}}\n'
    return world(*chained, f"rel r{links} = </w/v/f>\n", volume)
