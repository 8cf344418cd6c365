"""Lets USD load its plugins before any stage is opened, so that no stage is blamed for them."""

from __future__ import annotations

from pxr import Ar, Plug, Usd

from usdvol_lint.engine.messages import messages
from usdvol_lint.facts.usd.diagnostics import UNREADABLE


def load_plugins() -> tuple[str, ...]:
    """What USD says of its own plugins: it raises that once, wherever they are needed first."""
    said: list[str] = []
    for load in (Plug.Registry().GetAllPlugins, Usd.SchemaRegistry, Ar.GetResolver):
        try:
            load()
        except UNREADABLE as error:
            said += (" ".join(each.split()) for each in messages(error))
    return tuple(said)
