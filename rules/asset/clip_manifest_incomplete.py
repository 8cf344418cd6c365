"""AST014: the manifest of value clips must declare what the clips hold."""

from usdvol_lint.rule import ERROR, STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import CLIPS


@rule("AST014", on=STAGE, severity=ERROR, since="0.1")
def clip_manifest_incomplete(root: Prim, facts: Facts) -> Problems:
    for found in facts.layers.clip_losses.unlisted:
        clips = lacks(found.prim, CLIPS)
        yield Problem(
            found.words,
            at=found.missed[0],
            spec=found.spec,
            of="clips",
            asset=found.manifest_path,
            severity=None if found.leaves_nothing else WARNING,
            suggestion="write the manifest again, or remove manifestAssetPath: USD then makes one",
            absent=[(*clips, *lacks(each.GetPrim(), each.GetName())) for each in found.attributes],
        )
