"""AST012: the samples should cover the time range of the stage."""

from usdvol_lint.rule import INFO, WARNING, Facts, PathMark, Prim, Problem, Problems, file_paths, format_time, rule


@rule("AST012", on="FieldAsset", when=file_paths(PathMark.SEVERAL), severity=WARNING, since="0.1")
def sequence_range_differs(field: Prim, facts: Facts) -> Problems:
    sequence = facts.files.sequence(field)
    if sequence is None or facts.layers.time_range is None or not sequence.is_animated:
        return
    wanted = facts.layers.time_range
    start, end = wanted
    far_off = sequence.far_off((start, end))
    samples = "the samples"
    if far_off:
        samples = f"all samples but {len(sequence.times) - len(far_off.times)}"
        sequence = far_off
    first, last = sequence.times[0], sequence.times[-1]
    if last < start or first > end:
        is_held = sequence.holds_last if last < start else sequence.holds_first
        effects = {"one file is held throughout" if is_held else "no file is shown": (start, end)}
        advice, severity = f"if they are to begin with the stage, {sequence.advice_on_shift(start - first)}", None
    else:
        effects, severity = {}, None if wanted.is_asked else INFO
        advice = "write the frames that are missing" + ", or correct the range of the stage" * (not wanted.is_asked)
        # A sample holds until the next would come, so every second frame covers the one after it.
        if first - start > sequence.step - 1e-6 and sequence.holds_first:
            effects[f"the first file is held until {format_time(first)}"] = start, first - 1e-6
        if end - last > sequence.step - 1e-6 and sequence.holds_last:
            effects[f"the last file is held from {format_time(last)} on"] = last + sequence.step, end

    def seen(each: Prim) -> list[str]:
        return [effect for effect, times in effects.items() if not facts.volumes.is_hidden(each, times, between=True)]

    attribute, alike, found = field.GetAttribute("filePath"), facts.files.alike(field), seen(field)
    if found and not (facts.tells("STG008") and facts.layers.rate_is_unsaid(attribute)):
        yield Problem(
            f"{samples} {wanted.beside(first, last)}: {' and '.join(found)}",
            at=attribute,
            spec=wanted.meeting_samples(attribute, first, last),
            fold=alike and f"{alike} {found}",
            suggestion=sequence.rate_at_fault((start, end)) or advice,
            severity=severity,
        )
