"""STG003: a stage must hold something."""

from usdvol_lint.rule import STAGE, WARNING, Facts, Prim, Problem, Problems, lacks, rule
from usdvol_lint.schema import PRIMS


@rule("STG003", on=STAGE, severity=WARNING, since="0.1")
def empty_stage(root: Prim, facts: Facts) -> Problems:
    layers = facts.stage.GetLayerStack(False)
    if not any(layer.rootPrims for layer in layers) and not facts.layers.missing:
        sublayers = ", nor in its sublayers" if len(layers) > 1 else ""
        yield Problem(
            f"no prims at all in this layer{sublayers}",
            at=root,
            spec=layers[-1].pseudoRoot,
            suggestion="export it again: this is what an export that died leaves behind",
            absent=[lacks(root, PRIMS)],
        )
