"""Files of a numbered library, which are not frames: what names them bears their number."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import Any

from usdvol_lint.facts.files.frame_names import numbers_an_issue
from usdvol_lint.facts.usd.instances import shown

_SEPARATORS = re.compile(r"[/\\\[\]]")


def is_library_item(field: Any, digits: str) -> bool:
    """Whether a prim, a layer or the folder of a layer that brings a field ends in this number.

    It may have other zeros before it; not where it numbers versions or shots.
    """
    ending = re.compile(f"(?s)(.*(?<![0-9]))0*{int(digits)}").fullmatch
    numbered = filter(None, map(ending, _names(field)))
    return any(not numbers_an_issue(found[1]) for found in numbered)


def _names(field: Any) -> Iterator[str]:
    """The names of a field and all above it in each layer, those of layers and of their folders.

    Those of layers are without their extensions.
    """
    prim = field.GetStage().GetPrimAtPath(shown(field).path)
    while prim and not prim.IsPseudoRoot():
        for spec in prim.GetPrimStack():
            yield spec.name
            *folders, name = filter(None, _SEPARATORS.split(spec.layer.realPath)) or [""]
            yield os.path.splitext(name)[0]
            yield from folders[-1:]
        prim = prim.GetParent()
