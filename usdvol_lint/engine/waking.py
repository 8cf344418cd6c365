"""A prim that is inactive in the layer by itself, and active on the stage: who wakes it."""

from __future__ import annotations

from itertools import pairwise
from typing import Any

from pxr import Sdf

from usdvol_lint.facts.usd.calls import get_parent, get_prim_stack, has_metadata, is_pseudo_root


def waking(prim: Any) -> Any | None:
    """The spec that makes a prim active, or the next one above it, that a weaker one deactivates.

    It is the weakest that does: others on top say it again, or take back what took it away.
    """
    while not is_pseudo_root(prim):
        if has_metadata(prim, Sdf.PrimSpec.ActiveKey):
            stack = reversed(get_prim_stack(prim))
            said = [spec for spec in stack if spec.HasInfo(Sdf.PrimSpec.ActiveKey)]
            for weaker, spec in pairwise(said):
                if spec.active and not weaker.active:
                    return spec
        prim = get_parent(prim)
    return None
