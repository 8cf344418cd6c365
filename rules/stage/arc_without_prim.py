"""STG004: a reference or payload must name a prim that is there."""

from typing import Any

from usdvol_lint.rule import ERROR, STAGE, WARNING, Facts, Prim, Problem, Problems, quoted, rule

_NAMED = 3


@rule("STG004", on=STAGE, severity=ERROR, since="0.1")
def arc_without_prim(root: Prim, facts: Facts) -> Problems:
    for empty in facts.layers.empty_arcs:
        where = f" (on {len(empty.prims)} prims)" if len(empty.prims) > 1 else ""
        names = (empty.asset, empty.target, str(empty.spec.path))
        yield Problem(
            f"{_said(empty)}; what it should hold was not checked{where}",
            at=empty.prim,
            spec=empty.spec,
            asset=empty.place,
            subject=f"{empty.asset or ''}<{empty.target or ''}>",
            severity=None if facts.layers.may_bring_ours(*names) else WARNING,
            suggestion=_advice(empty),
        )


def _said(empty: Any) -> str:
    layer = quoted(empty.asset) if empty.asset else "this layer"
    if empty.target:
        return f"the {empty.arc} brings nothing: there is no prim <{empty.target}> in {layer}"
    if empty.default:
        named = quoted(empty.default)
        return f"the {empty.arc} to {layer} brings nothing: its defaultPrim {named} names no prim in it"
    return f"the {empty.arc} names no prim and brings nothing: {layer} has no defaultPrim"


def _advice(empty: Any) -> str:
    if empty.target:
        return f"did you mean <{empty.similar}>?" if empty.similar else "name a prim that is there, or define this one"
    if empty.similar:
        name = empty.similar if empty.similar.count("/") > 1 else empty.similar[1:]
        return f"did you mean 'defaultPrim = \"{name}\"'?"
    if len(empty.roots) == 1:
        return f"write 'defaultPrim = \"{empty.roots[0]}\"' into the metadata of that layer"
    if not empty.roots:
        return "export that layer again: it has no prims"
    more = ", …" if len(empty.roots) > _NAMED else ""
    named = ", ".join(f"</{name}>" for name in empty.roots[:_NAMED])
    return f"name the prim, one of {named}{more}, or write a defaultPrim into that layer"
