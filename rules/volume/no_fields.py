"""VOL010: a Volume without fields shows nothing, unless a renderer fills it by other means."""

from usdvol_lint.rule import INFO, WARNING, BindingMark, Facts, Prim, Problem, Problems, bindings, lacks, rule
from usdvol_lint.schema import FIELD_NAMESPACE

_OTHERWISE = "add a field, or leave it, if a renderer fills the Volume by other means"


@rule("VOL010", on="Volume", when=bindings(BindingMark.NONE), severity=WARNING, since="0.1")
def no_fields(volume: Prim, facts: Facts) -> Problems:
    fields, unbound, layers = facts.volumes.bindings(volume), facts.volumes.unbound_fields(volume), facts.layers
    if fields.bindings or fields.undeclared or layers.may_lack(volume) or layers.hides_ours(volume):
        return
    names = [str(field.GetPath().MakeRelativePath(volume.GetPath())) for field in unbound]
    yield Problem(
        "the Volume has no field" + (f", though there is {', '.join(map(repr, names))} below it" if names else ""),
        at=volume,
        severity=None if names else INFO,
        suggestion=f"add 'rel field:{unbound[0].GetName()} = <{names[0]}>'" if names else _OTHERWISE,
        absent=[lacks(volume, FIELD_NAMESPACE)],
    )
