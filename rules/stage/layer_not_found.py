"""STG001: every layer that the stage names must open."""

from usdvol_lint.rule import ERROR, STAGE, WARNING, Facts, NotChecked, Prim, Problem, Problems, quoted, rule

_NAMED = 3
_NOT_THERE = "write or copy it there, or name a layer that is there"
_UNREADABLE = "correct that layer, or export it again"


@rule("STG001", on=STAGE, severity=ERROR, since="0.1")
def layer_not_found(root: Prim, facts: Facts) -> Problems:
    for first, *others in facts.layers.composition.of_unread_formats:
        what = f"the {first.arc} {quoted(first.asset)}{f' and {len(others)} more' if others else ''}"
        said = f"no plugin here reads {first.extension!r} files: what {what} should bring was not checked"
        yield NotChecked(said, at=first.prim, spec=first.spec, asset=first.asset, machine=first.extension)
    for missing in (each for each in facts.layers.missing if not each.extension):
        layer = f"the {missing.arc} {quoted(missing.asset)}"
        where = f" (on {len(missing.prims)} prims)" if len(missing.prims) > 1 else ""
        scheme = missing.file_scheme
        is_assumed = facts.files.is_assumed(missing.asset, missing.path)
        if is_assumed or missing.is_schema or (missing.is_uri and not scheme):
            who = "resolver here answers for" if missing.is_uri else "search path here leads to"
            said = f"{layer} is assumed present" if is_assumed else f"no {who} {layer}"
            said += f"; what it holds was not checked{where}"
            yield NotChecked(said, at=missing.prim, spec=missing.spec, asset=missing.asset, subject=missing.asset)
            continue
        reason = f"can't be read: {missing.reason}" if missing.reason else "does not exist"
        if scheme:
            reason = "is not found: USD's own resolver does not know 'file:'"
        absence = None if missing.reason else facts.files.absence(missing.path, missing.asset, by=missing.spec.layer)
        advice = (absence.advice or _NOT_THERE) if absence else _UNREADABLE
        concerns_ours = facts.layers.may_bring_ours(missing.asset, str(missing.spec.path))
        yield Problem(
            f"{layer} {reason}; what it holds was not checked{where}",
            at=missing.prim,
            spec=missing.spec,
            asset=missing.asset,
            subject=missing.asset,
            severity=None if concerns_ours and not scheme else WARNING,
            suggestion=f"write the path without {quoted(scheme)}" if scheme else advice,
        )
    unloaded = [str(prim.GetPath()) for prim in facts.layers.composition.unloaded]
    if unloaded:
        more = ", …" if len(unloaded) > _NAMED else ""
        yield NotChecked(
            f"{len(unloaded)} payload{'s' * (len(unloaded) > 1)} not loaded; what is below was not "
            f"checked: {', '.join(unloaded[:_NAMED])}{more}",
            at=root,
        )
