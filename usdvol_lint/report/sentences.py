"""What code hosts say of a cause: they show a file and a line, the rest has to be in the text."""

from __future__ import annotations

from collections.abc import Iterator

from usdvol_lint.model import Site
from usdvol_lint.report.addresses import Address
from usdvol_lint.report.numbers import count
from usdvol_lint.report.telling import variant_and_frames
from usdvol_lint.results import Cause
from usdvol_lint.words import printable

_LONGEST = 1000


def sentences(cause: Cause, address: Address) -> str:
    """The message, where it is on the stage, and what to do, on one line.

    The message comes first: where there is little room, hosts show the first sentence alone.
    """
    return " ".join(map(_sentence, statements(cause, address)))


def object_path(site: Site) -> str:
    """The prim, and the property if it is about one; empty where it is about neither."""
    prim = site.prim or ""
    return f"{prim}.{site.property}" if site.property else prim


def statements(cause: Cause, address: Address) -> Iterator[str]:
    """The same, each of them by itself and in full."""
    finding = cause.first
    yield printable(finding.message) or printable(finding.name) or "no message"
    if where := ", ".join(_where(cause)):
        yield f"At {where}"
    if address.outside:
        yield f"In the layer {printable(address.outside)}"
    if cause.was is not None and (more := _worse(cause)):
        yield f"Worse than in the baseline: {more}"
    if finding.suggestion:
        yield f"Help: {printable(finding.suggestion)}"


def _where(cause: Cause) -> Iterator[str]:
    site = cause.first.site
    if path := object_path(site):
        yield f"<{printable(path)}>"
    yield from variant_and_frames(site)
    if cause.count > 1:
        yield f"and {count(cause.count - 1, 'other place')}"


def _worse(cause: Cause) -> str | None:
    from usdvol_lint.baseline.cover import exceeds  # few runs have anything that is worse

    return exceeds(cause.was, cause.cover) if cause.was else None


def _sentence(text: str) -> str:
    """A text with a mark at its end, cut off between two of its items if it is long."""
    if len(text) > _LONGEST:
        start = text[:_LONGEST].rpartition(", ")[0] or text[:_LONGEST]
        text = f"{start}, …"
    return text if text.endswith((".", "?", "!")) else f"{text}."
