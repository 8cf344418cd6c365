"""What a stage says is to be ignored: on prims, for all below them, and in layers."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from itertools import chain
from typing import Any, NamedTuple

from pxr import Usd

from usdvol_lint.engine.ignoring import (
    KEY,
    TAKEN_BACK,
    Fault,
    Keys,
    Said,
    matched_nothing,
    nothing_to_take_back,
    read,
)
from usdvol_lint.engine.shares import Share, Shares
from usdvol_lint.facts.usd.calls import COMPOSED, get_parent, get_path, get_stage, has_metadata
from usdvol_lint.facts.usd.diagnostics import UNREADABLE
from usdvol_lint.rule import Problem, Rule
from usdvol_lint.suppressions import InStages

_OF_LAYER, _OF_PRIM = "customLayerData", "customData"


class _Reason(NamedTuple):
    """Why a code is ignored, and the prim that says it."""

    text: str
    prim: Any


class Suppressions:
    """What the stage says is to be ignored; asked only for what is found, and what is above it."""

    def __init__(self, rules: Mapping[str, Rule], asked: InStages) -> None:
        self._rules = rules
        self._asked = asked
        self._faults: list[Problem] = []
        self._layers: dict[str, Said] = {}
        self._used: set[tuple[str, str, str]] = set()
        self.recomposed()

    def recomposed(self) -> None:
        """Forgets what prims say: the stage was composed in another way."""
        self._above: dict[str, Mapping[str, _Reason]] = {"/": {}}
        self._marked: set[tuple[Any, str]] = set()
        self._shares = Shares(self._reason_at, self._asked.prims)

    def reason(self, prim: Any, path: str, layer: Any | None, code: str) -> str | None:
        """Why a finding at a prim outside of prototypes is ignored; None if it is not.

        `path` is the prim's, `layer` the one to blame; None if there is none.
        """
        reason = self._reason_at(prim, code, path)
        if reason is not None:
            return reason or None
        said = self._said_by(layer, prim, code)
        if said:
            self._use_layer(layer, code)
        return said

    def shares(self, prim: Any, layer: Any | None, code: str) -> list[Share]:
        """The same for a prim of a prototype: what shows it, by the reason why it is ignored."""
        said = self._said_by(layer, prim, code)
        found = self._shares.of(prim, code, said)
        if said and any(share.reason == said for share in found):
            self._use_layer(layer, code)
        return found

    def ask(self, prim: Any, path: str | None = None) -> Mapping[str, _Reason]:
        """What a prim and those above it ignore; the root of a prototype has no data."""
        path = path or str(get_path(prim))
        waiting = []
        while (known := self._above.get(path)) is None:
            waiting.append((path, prim))
            path = path.rpartition("/")[0] or "/"
            prim = get_parent(prim)
        for path, each in reversed(waiting):
            known = self._above[path] = self._said(each, known)
        return known

    def faults(self) -> Iterator[Problem]:
        """What is wrong with what was asked, each once."""
        while self._faults:
            yield self._faults.pop(0)

    def unused(self, stage: Any, codes: Iterable[str]) -> Iterator[Problem]:
        """What the layers of the stage itself suppress of these codes, and nothing has matched.

        Asks every prim.
        """
        root, own = stage.GetPseudoRoot(), stage.GetLayerStack(False)
        for layer in own:
            said = self._of_layer(root, layer)
            for code in said.keys() & codes:
                fault = matched_nothing(code, said[code])
                yield self._unused(fault, root, layer.pseudoRoot, code)
        roots = [root, *stage.GetPrototypes()]
        for prim in (each for top in roots for each in Usd.PrimRange(top, COMPOSED)):
            for code, reason in self.ask(prim).items():
                if reason.prim == prim and reason.text != TAKEN_BACK and code in codes:
                    fault = matched_nothing(code, reason.text)
                    spec = _holder(prim, fault.keys)
                    if spec and spec.layer in own:
                        yield self._unused(fault, prim, spec, code)

    def _unused(self, fault: Fault, at: Any, spec: Any, code: str) -> Problem:
        key = (spec.layer.identifier, str(spec.path), code)
        problem = _problem(fault, at, spec)
        problem.holds = lambda: key not in self._used
        return problem

    def _reason_at(self, prim: Any, code: str, path: str | None = None) -> str | None:
        """Why a prim ignores a code, or TAKEN_BACK; None if nothing is said there."""
        reason = self.ask(prim, path).get(code)
        if reason is None:
            return None
        if self._asked.unused and (reason.prim, code) not in self._marked:
            self._marked.add((reason.prim, code))
            if spec := _holder(reason.prim, matched_nothing(code, "").keys):
                self._used.add((spec.layer.identifier, str(spec.path), code))
        return reason.text

    def _said(self, prim: Any, above: Mapping[str, _Reason]) -> Mapping[str, _Reason]:
        if not has_metadata(prim, _OF_PRIM):
            return above
        data = prim.GetCustomDataByKey(KEY)
        if data is None:
            return above
        said = read(data, self._rules, self._asked.today)
        faults = list(said.faults)
        reasons = {}
        for code, text in said.reasons.items():
            if text != TAKEN_BACK or self._is_said_elsewhere(prim, code, above):
                reasons[code] = _Reason(text, prim)
            else:
                faults.append(nothing_to_take_back(code))
        self._faults += (_problem(fault, prim, _holder(prim, fault.keys)) for fault in faults)
        return {**above, **reasons}

    def _is_said_elsewhere(self, prim: Any, code: str, above: Mapping[str, _Reason]) -> bool:
        """Whether a prim above, a weaker layer, or the data of a layer ignores a code."""
        if code in above and above[code].text != TAKEN_BACK:
            return True
        keys = nothing_to_take_back(code).keys
        if any(_has_text(spec, _OF_PRIM, keys) for spec in prim.GetPrimStack()):
            return True
        if prim.IsInPrototype():
            return True  # each instance may ignore it for a reason of its own
        layers = prim.GetStage().GetUsedLayers()
        return any(_has_text(layer.pseudoRoot, _OF_LAYER, keys) for layer in layers)

    def _said_by(self, layer: Any | None, prim: Any, code: str) -> str | None:
        """Why a layer ignores a code."""
        return None if layer is None else self._of_layer(prim, layer).get(code) or None

    def _use_layer(self, layer: Any, code: str) -> None:
        self._used.add((layer.identifier, "/", code))

    def _of_layer(self, prim: Any, layer: Any) -> Mapping[str, str]:
        key = layer.identifier
        if key not in self._layers:
            data = _value(layer.pseudoRoot, _OF_LAYER, (KEY,))
            said = Said({}, ()) if data is None else read(data, self._rules, self._asked.today)
            faults = list(said.faults)
            faults += (
                nothing_to_take_back(code)
                for code, text in said.reasons.items()
                if text == TAKEN_BACK
            )
            root = get_stage(prim).GetPseudoRoot()
            self._faults += (_problem(fault, root, layer.pseudoRoot) for fault in faults)
            self._layers[key] = said
        return self._layers[key].reasons


def _problem(fault: Fault, at: Any, spec: Any) -> Problem:
    subject = fault.keys[-1]
    return Problem(fault.message, at=at, spec=spec, suggestion=fault.suggestion, subject=subject)


def _holder(prim: Any, keys: Keys) -> Any:
    """The strongest spec of a prim that has something below the keys; None if none can be read."""
    specs = [spec for spec in prim.GetPrimStack() if spec.HasInfo(_OF_PRIM)]
    holders = (spec for spec in specs if _has(spec, keys))
    return next(chain(holders, specs), None)


def _has(spec: Any, keys: Keys) -> bool:
    """Whether a spec says something below the keys, which USD may be unable to read."""
    *above, last = keys
    data: Any = _value(spec, _OF_PRIM, tuple(above)) if above else spec.customData
    return not isinstance(data, str) and bool(data) and last in data


def _value(spec: Any, field: str, keys: Keys) -> Any | None:
    """The value below some keys, KEY the first, of a dictionary of a spec; None if it has none."""
    value = _entry(spec, field) if spec.HasInfo(field) else None
    for key in keys[1:]:
        value = value.get(key) if isinstance(value, dict) else None
    return value


def _entry(spec: Any, field: str) -> Any | None:
    """What a dictionary of a spec has as KEY, also where USD can't read all of it."""
    try:
        return spec.GetInfo(field).get(KEY)
    except UNREADABLE:
        if field == _OF_PRIM:
            return spec.customData.get(KEY)
        nothing = Usd.StagePopulationMask()
        stage = Usd.Stage.OpenMasked(spec.layer, nothing, Usd.Stage.LoadNone)
        return stage.GetMetadataByDictKey(field, KEY)


def _has_text(spec: Any, field: str, keys: Keys) -> bool:
    value = _value(spec, field, keys)
    return isinstance(value, str) and bool(value.strip())
