"""STU001: a Volume has one of the names that the studio agreed on."""

from usdvol_lint.rule import ERROR, Facts, Prim, Problem, Problems, rule


@rule("STU001", on="Volume", severity=ERROR, since="1.0")
def volume_name(
    volume: Prim,
    facts: Facts,
    *,
    allowed: tuple[str, ...] = ("smoke", "fire"),
    prefix: str = "",
    longest: int = 12,
    share: float = 1.0,
    strict: bool = False,
) -> Problems:
    name = volume.GetName().removeprefix(prefix)
    if name not in allowed or len(name) > longest * share:
        yield Problem(f"name {name!r}, wanted {', '.join(allowed)}", at=volume)
