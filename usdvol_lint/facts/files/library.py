"""Files of a numbered library, which are not frames: what names them bears their number."""

from __future__ import annotations

import os
import re
from collections.abc import Iterator
from typing import Any

from usdvol_lint.facts.files.frame_names import LONGEST_NUMBER, FrameName, numbers_an_issue
from usdvol_lint.facts.usd.instances import on_stage

_SEPARATORS = re.compile(r"[/\\\[\]]")
_NUMBERED = re.compile(rf"(?s)(.*[^0-9]|)([0-9]{{1,{LONGEST_NUMBER}}})")


def is_library_item(field: Any, file: FrameName) -> bool:
    """Whether a prim, a layer or the folder of a layer that brings a field has a file's number.

    It ends in the same digits, or in another spelling of the number after the same word; not where
    these number versions or shots.
    """
    numbered = filter(None, map(_NUMBERED.fullmatch, _names(field)))
    return any(
        int(digits) == file.number
        and (digits == file.digits or _letters(before) == _letters(file.before) != "")
        and not numbers_an_issue(before)
        for before, digits in (found.groups() for found in numbered)
    )


def _letters(name: str) -> str:
    return "".join(filter(str.isalpha, name)).lower()


def _names(field: Any) -> Iterator[str]:
    """The names of a field and all above it in each layer, those of layers and of their folders.

    Those of layers are without their extensions.
    """
    prim = on_stage(field)
    while prim and not prim.IsPseudoRoot():
        for spec in prim.GetPrimStack():
            yield spec.name
            names = [*filter(None, _SEPARATORS.split(spec.layer.realPath))]
            yield from (os.path.splitext(name)[0] for name in names[-1:])
            yield from names[-2:-1]
        prim = prim.GetParent()
