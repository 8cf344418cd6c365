"""AST016: value clips that hold what a volume or particle field needs must arrive there."""

from collections.abc import Sequence
from typing import Any

from usdvol_lint.rule import ERROR, STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, quoted, rule
from usdvol_lint.schema import CLIPS


@rule("AST016", on=STAGE, severity=ERROR, since="0.1")
def clips_unused(root: Prim, facts: Facts) -> Problems:
    for lost in facts.layers.lost_clips:
        bearer, them = (f"the clip set {quoted(lost.name)}", "it") if lost.name else ("clips", "them")
        what = f"{bearer} {lost.fault.what}: USD does not use {them}, and "
        yield _problem(lost, what, lost.prim, lost.advice, absent=_absent(lost))
    for left in facts.layers.clips_left_behind:
        what = f"an arc to a prim below leaves behind {_clips(left)}: "
        advice = f"bring in <{left.path}>, or author its clips here too"
        yield _problem(left, what, left.prim, advice, absent=_absent(left))
    for stopped in facts.layers.stopped_clips:
        what = f"{_clips(stopped.carrier)} do not reach into this instance: "
        advice = "remove instanceable, or carry the clips on a prim inside what is instanced"
        yield _problem(stopped, what, stopped.instance, advice)


def _problem(lost: Any, what: str, prim: Prim, advice: str | None, **more: Any) -> Problem:
    level = None if lost.without_value else WARNING
    return Problem(what + _effect(lost), at=prim, spec=lost.spec, suggestion=advice, severity=level, **more)


def _clips(carrier: Any) -> str:
    """The clips of a prim in a layer."""
    return f"the value clips of <{carrier.path}> in {quoted(carrier.layer.GetDisplayName())}"


def _effect(lost: Any) -> str:
    """What the attributes lack."""
    missed: Sequence[Any] = lost.without_value or lost.attributes
    names = missed[0].GetName() + (f" and {len(missed) - 1} more" if len(missed) > 1 else "")
    what = "no value" if lost.without_value else "only a default, the same at all times"
    return f"{names} {'has' if len(missed) == 1 else 'have'} {what}"


def _absent(lost: Any) -> list[tuple[tuple[Any, str], ...]]:
    """What each attribute lacks: what the clips need, or a value from elsewhere."""
    return [(*lacks(lost.prim, CLIPS), *lacks(each.GetPrim(), each.GetName())) for each in lost.attributes]
