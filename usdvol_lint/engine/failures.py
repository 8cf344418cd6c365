"""Makes findings of what rules raised, so that a report says what was not checked."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from typing import Any

from usdvol_lint.engine.identity import Identity
from usdvol_lint.engine.messages import messages
from usdvol_lint.engine.site import Sites
from usdvol_lint.engine.stamp import Stamped
from usdvol_lint.engine.trouble import PACK_FAILURES, Trouble
from usdvol_lint.facts.usd.diagnostics import (
    BROKEN_TEXT,
    Unreadable,
    innermost,
    is_by_usd,
    without_parser_rule,
)
from usdvol_lint.model import Cover, Finding, Severity
from usdvol_lint.packs.catalog import NOT_CHECKED, RULE_FAILED, STAGE_UNREADABLE, help_for
from usdvol_lint.rule import NotChecked, Rule

_LONGEST_MESSAGE = 300
_OF_THE_STAGE = "the layer is probably corrupt: copy or export it again"
_OF_THE_RULE = "a bug of the rule, not of the stage; --verbose shows the traceback"
_OF_THE_PLACE = "a bug of usdvol-lint, and the findings stand; --verbose shows the traceback"


class _Failure:
    """One kind of failure: the rule and the prim that met it first, and how many prims met it."""

    def __init__(
        self,
        rule: Rule,
        prim: Any,
        error: BaseException,
        traceback: str,
        of_precondition: bool = False,
        sought: str = "",
    ) -> None:
        self.rule = rule
        self.prim = prim
        self.error = error
        self.traceback = traceback
        self.of_precondition = of_precondition
        self.sought = sought
        self.is_by_usd = is_by_usd(error) and not of_precondition
        self.count = 0

    @property
    def subject(self) -> str:
        return "" if self.is_by_usd or self.sought else self.rule.code

    @property
    def suggestion(self) -> str:
        if self.is_by_usd:
            return _OF_THE_STAGE
        return _OF_THE_PLACE if self.sought else _OF_THE_RULE

    @property
    def message(self) -> str:
        if self.is_by_usd:
            return _unreadable(self.error)
        rule, error = self.rule, self.error
        said = " ".join(f"{type(error).__name__}: {error}".split())
        if self.of_precondition:
            what = f"the precondition of rule {rule.code} ({rule.name})"
            return f"{what} failed, so the rule looked at every prim that it asks for: {said}"
        others = f", and on {self.count - 1} more prims" if self.count > 1 else ""
        if self.sought:
            return f"{self.sought} could not be found here{others}: {said}"
        return f"rule {rule.code} ({rule.name}) failed here{others}: {said}"


class Failures:
    """What rules raised on one stage; each kind of failure becomes one finding.

    What USD raises is reported for the stage and not for the rule: the stage holds something that
    USD can't read, whichever rule asks for it.
    """

    def __init__(self) -> None:
        self._failures: dict[Identity, _Failure] = {}

    def add(self, rule: Rule, prim: Any, error: BaseException) -> None:
        """Records what a rule raised on a prim."""
        key: Identity = (rule.code, type(error).__name__, str(_line(error)))
        if is_by_usd(error):
            key = _cause(prim, error)
        if key not in self._failures:
            self._failures[key] = _Failure(rule, prim, error, _traceback(error))
        self._failures[key].count += 1
        error.__traceback__ = None  # its frames hold the stage, and one of them holds this

    def add_place(self, prim: Any, what: str, error: Exception) -> None:
        """Records what was raised where something was looked for, such as the place of a finding.

        The finding itself, on that prim, stands all the same.
        """
        key: Identity = (what, type(error).__name__, str(_line(error)))
        if is_by_usd(error):
            key = _cause(prim, error)
        if key not in self._failures:
            text = _traceback(error)
            self._failures[key] = _Failure(NOT_CHECKED, prim, error, text, sought=what)
        self._failures[key].count += 1
        error.__traceback__ = None

    def add_precondition(self, rules: Iterable[Rule], root: Any, error: BaseException) -> None:
        """Records what the precondition of these rules raised: once for each rule."""
        new = {(rule.code, "when"): rule for rule in rules}
        new = {key: rule for key, rule in new.items() if key not in self._failures}
        text = _traceback(error) if new else ""
        for key, rule in new.items():
            self._failures[key] = _Failure(rule, root, error, text, of_precondition=True)
        error.__traceback__ = None

    @property
    def prims(self) -> list[Any]:
        """The prims at which failures are reported."""
        return [failure.prim for failure in self._failures.values()]

    def findings(self, sites: Sites) -> Iterator[Stamped]:
        """One finding for each kind of failure."""
        for key, failure in self._failures.items():
            code = STAGE_UNREADABLE if failure.is_by_usd else RULE_FAILED
            machine = failure.rule.code if failure.of_precondition else None
            located = sites.locate(NotChecked("", at=failure.prim, machine=machine))
            finding = Finding(
                code=code.code,
                name=code.name,
                severity=Severity.ERROR,
                message=failure.message[:_LONGEST_MESSAGE],
                site=located.site,
                source=located.source._replace(subject=failure.subject),
                cover=Cover(Severity.ERROR),
                suggestion=failure.suggestion,
                help=help_for(code),
                detail=failure.traceback,
            )
            yield Stamped(finding, key)


def unreadable(error: Unreadable) -> Trouble:
    """That USD raised for something on a stage where no rule was asked."""
    return Trouble(_unreadable(error)[:_LONGEST_MESSAGE], _OF_THE_STAGE, detail=_traceback(error))


def _unreadable(error: Any) -> str:
    said = "; ".join(map(without_parser_rule, messages(error)))
    return f"USD can't read what is here: {said}"


def still_holding(stamped: Stamped) -> Iterator[Finding]:
    """The finding, if its rule stands by it now; if the rule can't say, also that it failed."""
    try:
        if not stamped.holds or stamped.holds():
            yield stamped.finding
    except PACK_FAILURES as error:
        yield stamped.finding
        yield _beside(stamped.finding, error)


def _beside(found: Finding, error: BaseException) -> Finding:
    """What was raised when a rule was asked whether it stands by what it found."""
    by_usd = is_by_usd(error)
    code = STAGE_UNREADABLE if by_usd else RULE_FAILED
    said = " ".join(f"{type(error).__name__}: {error}".split())
    failed = f"rule {found.code} ({found.name}) failed here: {said}"
    return found._replace(
        code=code.code,
        name=code.name,
        severity=Severity.ERROR,
        message=(_unreadable(error) if by_usd else failed)[:_LONGEST_MESSAGE],
        suggestion=_OF_THE_STAGE if by_usd else _OF_THE_RULE,
        help=help_for(code),
        detail=_traceback(error),
        source=found.source._replace(subject="" if by_usd else found.code),
        cover=Cover(Severity.ERROR),
        ignored=None,
    )


def _cause(prim: Any, error: Unreadable) -> Identity:
    """What one finding is made of: all broken text of a stage, or what USD says of a prim."""
    said = messages(error)
    if any(BROKEN_TEXT in each for each in said):
        return (BROKEN_TEXT,)
    return (str(prim.GetPath()), *said)


def _line(error: BaseException) -> int:
    """The line that raised it; the message would not do, as it may name the prim."""
    entry = innermost(error)
    return entry.tb_lineno if entry else 0


def _traceback(error: BaseException) -> str:
    import traceback  # costs start-up time, and rules rarely fail

    return "".join(traceback.format_exception(error))
