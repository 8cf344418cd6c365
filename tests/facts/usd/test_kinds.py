"""The kinds of prims, which are decided once for all stages that say no fallbacks of types."""

from __future__ import annotations

from pxr import Sdf, Usd

from usdvol_lint import schema
from usdvol_lint.facts.usd.kinds import kinds_on

FALLBACK = '(\nfallbackPrimTypes = {\ntoken[] StudioFog = ["Volume"]\n}\n)\n'


def stage(said: str = "") -> Usd.Stage:
    layer = Sdf.Layer.CreateAnonymous(".usda")
    layer.ImportFromString(f'#usda 1.0\n{said}def StudioFog "fog"\n{{\n}}\n')
    return Usd.Stage.Open(layer)


def test_a_stage_without_fallbacks_shares_its_kinds() -> None:
    first, second = stage(), stage()
    kinds = kinds_on(first)
    assert kinds_on(second) is kinds
    assert kinds.is_a(first.GetPrimAtPath("/fog"), schema.UNKNOWN_TYPE)


def test_fallbacks_hold_for_their_stage_alone() -> None:
    with_fallback, bare = stage(FALLBACK), stage()
    assert kinds_on(with_fallback).is_a(with_fallback.GetPrimAtPath("/fog"), "Volume")
    assert not kinds_on(bare).is_a(bare.GetPrimAtPath("/fog"), "Volume")
