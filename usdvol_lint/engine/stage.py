"""A path becomes a Usd.Stage, or a plain reason why it can't."""

from __future__ import annotations

import os
import re
from contextlib import nullcontext
from typing import Any

from pxr import Ar, Sdf, Usd

from usdvol_lint.engine.diagnosis import (
    CRATE_SIGNATURE,
    EXPORT_AGAIN,
    ZIP_SIGNATURE,
    look_at,
    read_head,
)
from usdvol_lint.engine.messages import messages
from usdvol_lint.engine.opening import Watch
from usdvol_lint.engine.trouble import Trouble, UnreadableStageError
from usdvol_lint.facts.usd.clips import concerns_only_clips
from usdvol_lint.facts.usd.diagnostics import UNREADABLE, without_parser_rule
from usdvol_lint.paths import display

# Few stages fail, so this is compiled only then.
_LOCATED = r"(?s)(?P<path>.+?):(?P<line>\d+)(?::(?P<column>\d+))?:\s*(?P<what>.*)"
_OTHER_VERSION = r"obsolete version|file version mismatch"
_VERSION = r"\d+\.\d+\.\d+"
_LONGEST_MESSAGE = 300


def open_stage(path: str, load: str, session: Any | None = None, watch: Watch | None = None) -> Any:
    """Opens a stage; `load` is `all` or `none`, and says whether payloads are loaded.

    Without `session` the stage has no session layer.  Where that takes long, `watch` may end it.
    Raises UnreadableStageError with the reason.
    """
    head = look_at(path)
    policy = Usd.Stage.LoadNone if load == "none" else Usd.Stage.LoadAll
    try:
        layer = Sdf.Layer.FindOrOpen(os.path.abspath(path))
        with watch.opening(path, layer, session, load != "none") if watch else nullcontext():
            stage = _open(layer, session, policy) if layer else None
    except UNREADABLE as error:
        head = head or read_head(path)
        raise UnreadableStageError(_explain(path, messages(error), head)) from error
    if stage is None:
        head = head or read_head(path)
        raise UnreadableStageError(
            Trouble("a package in which USD finds no layer to open", "package it again")
            if head.startswith(ZIP_SIGNATURE)
            else Trouble("USD can't open this layer and does not say why", EXPORT_AGAIN)
        )
    return stage


def _open(layer: Any, session: Any | None, policy: Any) -> Any:
    """The stage of a root layer, also where USD raises for value clips that do not open.

    For clips without a manifest USD makes one, and so opens them with the stage.  Where that
    raises, the stage is whole, but only to be had from a cache.
    """
    # Without the context, USD would take a session of None for one that searches nowhere.
    context = Ar.GetResolver().CreateDefaultContextForAsset(layer.identifier)
    try:
        return Usd.Stage.Open(layer, session, context, policy)
    except UNREADABLE:
        cache = Usd.StageCache()
    try:
        with Usd.StageCacheContext(cache):
            return Usd.Stage.Open(layer, session, context, policy)
    except UNREADABLE as error:
        stage = next(iter(cache.GetAllStages()), None)
        if stage is None or not concerns_only_clips(error, stage):
            raise
        return stage


def _explain(path: str, errors: list[str], head: bytes) -> Trouble:
    """One of USD's errors in one line: the first that names a line in a text, or the first."""
    located = next(filter(None, (re.match(_LOCATED, error) for error in errors)), None)
    if located:
        layer = located["path"]
        return Trouble(
            f"parse error: {_in_one_line(path, located['what'])}"[:_LONGEST_MESSAGE],
            "correct the text there, or export the layer again",
            layer=None if os.path.abspath(path) == layer else layer,
            line=int(located["line"]),
            column=int(located["column"]) if located["column"] else None,
        )
    first = _in_one_line(path, errors[0]) if errors else "no reason given"
    if head.startswith(CRATE_SIGNATURE):
        if re.search(_OTHER_VERSION, first):
            return _other_version(head, first)
        message = f"a truncated or corrupt crate file: {first}"
        return Trouble(message[:_LONGEST_MESSAGE], EXPORT_AGAIN)
    return Trouble(f"USD can't open it: {first}"[:_LONGEST_MESSAGE])


def _other_version(head: bytes, error: str) -> Trouble:
    """That USD does not read the version of a crate file, as its error says."""
    *_, limit = re.findall(_VERSION, error)
    is_older = "obsolete" in error
    reads = f"{limit} and newer" if is_older else f"none newer than {limit}"
    return Trouble(
        f"a crate file of version {'.'.join(map(str, head[8:11]))}; this USD reads {reads}",
        f"convert it to .usda with {'an older' if is_older else 'a newer'} USD"
        + ("" if is_older else ", or lint with that"),
    )


def _in_one_line(path: str, error: str) -> str:
    """An error of USD's without the path that the finding names anyway, and without C++."""
    for mention in (f", while reading {display(path)}", "Encountered: "):
        error = error.replace(mention, "")
    return without_parser_rule(error)
