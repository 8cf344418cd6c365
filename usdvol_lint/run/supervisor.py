"""A worker process as its parent sees it: a stage goes in, a report comes out, even if it dies."""

from __future__ import annotations

import errno
import pickle
import time
from collections import deque
from collections.abc import Callable, Sequence
from contextlib import suppress
from typing import IO, TYPE_CHECKING, Any

from usdvol_lint.child import kill_child, start_child
from usdvol_lint.engine.trouble import Trouble, report_trouble
from usdvol_lint.model import StageReport, Status, UsageError
from usdvol_lint.run.deadline import Deadline
from usdvol_lint.run.endings import MORE_MEMORY, cause_of, crashed, timed_out, too_large
from usdvol_lint.run.group import Group
from usdvol_lint.run.heard import Heard
from usdvol_lint.run.last_words import LastWords
from usdvol_lint.run.limits import narrow_limits
from usdvol_lint.run.memory import Memory
from usdvol_lint.run.protocol import (
    Advance,
    Done,
    GivenUp,
    NewFindings,
    Ready,
    Refusal,
    Reply,
    Setup,
    Together,
)
from usdvol_lint.run.replies import replies_of, wait_for_end
from usdvol_lint.words import format_size

if TYPE_CHECKING:
    import subprocess

_PAUSES = (0.2, 0.6, 1.8)
"""Seconds before a process that did not start is tried again."""
_PATIENCE = 5.0
"""Seconds that a process has to go once it was ended; one that waits for a disk goes later."""
_START_AHEAD = 1.0
"""Seconds that a process has to import USD before it takes the place of one that has grown."""
_ON_THE_WAY = Together, Advance, NewFindings
_PASSING = frozenset({errno.EAGAIN, errno.ENOMEM})


class NoProcessError(UsageError):
    """That a process can't be started; where `is_passing`, it may be possible a little later."""

    def __init__(self, reason: str, is_passing: bool) -> None:
        super().__init__(reason)
        self.is_passing = is_passing


class Worker:
    """One child process, replaced by a new one when it died, was ended or has grown.

    It is `child` or a new one, and imports USD until it is asked something.
    """

    def __init__(self, child: subprocess.Popen[bytes] | None = None) -> None:
        self.usd_version = ""
        self.said: tuple[str, ...] = ()
        self._process: subprocess.Popen[bytes] | None = None
        self._successor: subprocess.Popen[bytes] | None = None
        self._successor_is_ready_at = 0.0
        self._unanswered: deque[str] = deque()
        self._came: deque[Reply] = deque()
        self._group = Group()
        self._is_gone = False
        self._is_over = False
        self._memory = Memory()
        self._deadline = Deadline(self._end, self._is_too_large)
        with suppress(NoProcessError):  # it is tried again once it is needed
            self._begin(child)

    def _begin(self, child: subprocess.Popen[bytes] | None = None) -> None:
        """Starts a child, or takes this one; raises NoProcessError."""
        try:
            child = child or start_child()
        except OSError as error:
            reason = f"no process can be started: {error.strerror}{narrow_limits()}"
            raise NoProcessError(reason, error.errno in _PASSING) from error
        try:
            self._deadline.start()
            assert child.stderr
            self._last_words = LastWords(child.stderr)
        except RuntimeError as error:
            kill_child(child)
            reason = f"no thread can be started{narrow_limits()}"
            raise NoProcessError(reason, is_passing=True) from error
        self._process = child
        self._replies = replies_of(child)
        self._unanswered.clear()
        self._came.clear()
        self._group.of = 0
        self._is_gone = False
        self._memory.begin()

    def prepare(self, setup: Setup, limit: float, memory: Memory | None = None) -> None:
        """Hands over the rules; raises UsageError if the child is not ready within `limit` seconds.

        It is a UsageError too if the child can't load the rules, or can't import USD.  One that is
        ended from outside while it does is replaced a few times.
        """
        self._setup, self._ready_limit = setup, limit
        self._memory = memory or self._memory
        self._get_ready()

    def _get_ready(self) -> None:
        for pause in _PAUSES:
            try:
                return self._greet()
            except NoProcessError as error:
                if not error.is_passing or self._is_over:
                    raise
            self._let_go()
            time.sleep(pause)
        self._greet()

    def _greet(self) -> None:
        """Hands the rules to a child; raises UsageError if it refuses or does not get ready."""
        if self._process is None:
            self._begin()
        # What a process takes to get ready is looked at then; most runs don't take long enough.
        reply, expired = self._ask((self._setup,), self._ready_limit, lambda message: None, False)
        if isinstance(reply, Refusal):
            raise UsageError(" ".join(reply.reason.split()))
        if self._memory.is_chosen and isinstance(reply, Ready) and self._is_too_large():
            own, most = format_size(self._memory.own), format_size(self._memory.limit)
            raise UsageError(
                f"a memory limit of {most} is too low: a process takes {own} before it opens a "
                "stage; raise --memory-limit (memory-limit in a configuration)"
            )
        if not isinstance(reply, Ready):
            raise self._not_ready(expired)
        self.usd_version, self.said = reply.usd_version, reply.said

    def _not_ready(self, expired: bool) -> NoProcessError:
        code = self._code()
        how = f"not ready after {self._ready_limit:g} s" if expired else cause_of(code)
        words = self._last_words.text().splitlines() or ["it said nothing"]
        advice = narrow_limits() or (f"; {MORE_MEMORY}" if how == "SIGKILL" else "")
        reason = f"the process that loads USD does not start ({how}): {words[-1]}{advice}"
        return NoProcessError(reason, is_passing=code < 0 and not expired)

    def lint(
        self,
        path: str,
        limit: float,
        advance: Callable[[int], None],
        following: Sequence[str] = (),
    ) -> StageReport:
        """The report on a stage, also where the child crashes or takes more than `limit` seconds.

        `advance` is called with numbers of samples, as those of a long sequence are read.
        The paths `following` are asked for next: the child has them before it is done.
        If it goes while it looks at several stages, each of them is looked at alone.
        Raises UsageError if no child can be started any more to check it.
        """
        self._renew()
        began = time.perf_counter()
        heard = Heard(advance, lambda stages: self._begin_group(stages, limit))
        new = self._group.asked(path, *following)[len(self._unanswered) :]
        self._unanswered += new
        reply, timed_out = self._ask(new, self._group.limit(limit), heard, looks=True)
        self._unanswered.popleft()
        self._is_gone = timed_out or self._deadline.is_over or not isinstance(reply, Done)
        if self._is_gone and not self._is_over and self._group.take_apart():
            return self.lint(path, limit, advance)
        self._group.answered()
        if isinstance(reply, Done):
            return reply.with_findings(heard.findings)
        if isinstance(reply, GivenUp):
            return reply.report
        seconds = {"total": time.perf_counter() - began}
        status = Status.TIMED_OUT if timed_out else Status.CRASHED
        return report_trouble(
            path, self._trouble(timed_out, limit), status, seconds, heard.findings
        )

    def _begin_group(self, stages: int, limit: float) -> None:
        """Hears that so many stages are looked at together from now on."""
        self._group.of = stages
        self._deadline.move(self._group.limit(limit))

    def _renew(self) -> None:
        """Puts a new child in the place of one that has gone, or has grown: that starts ahead."""
        if self._is_gone or self._process is None:
            self._let_go()
            self._get_ready()
        elif self._successor:
            if time.monotonic() >= self._successor_is_ready_at:
                successor, self._successor = self._successor, None
                self._let_go()
                with suppress(NoProcessError):
                    self._begin(successor)
                self._get_ready()
        elif self._memory.has_grown(self._process.pid):
            with suppress(OSError):  # the one that has grown goes on
                self._successor = start_child()
                self._successor_is_ready_at = time.monotonic() + _START_AHEAD

    def kill(self) -> None:
        """Ends the child at once, without waiting until it has gone; no other takes its place."""
        self._is_over = True
        self._end()
        if self._successor:
            kill_child(self._successor)

    def stop(self) -> None:
        """Ends the child, and waits until it has gone."""
        self.kill()
        self._deadline.close()
        self._let_go()

    def _end(self) -> None:
        if self._process:
            kill_child(self._process)

    def _is_too_large(self) -> bool:
        return self._process is not None and self._memory.is_too_large(self._process.pid)

    def _let_go(self) -> None:
        """Ends the child, waits until it has gone, and closes its pipes."""
        if self._process:
            self._end()
            wait_for_end(self._process, _PATIENCE)
            for stream in (self._stdin, self._replies):
                with suppress(OSError):
                    stream.close()
        self._process = None

    def _code(self) -> int:
        """The exit code of the child, which is about to go or has gone."""
        assert self._process
        code = wait_for_end(self._process, _PATIENCE)
        if code is None:
            self._end()
            code = wait_for_end(self._process, _PATIENCE)
        return 1 if code is None else code

    def _ask(
        self,
        messages: Sequence[Setup | str],
        limit: float,
        hear: Callable[[Together | Advance | NewFindings], None],
        looks: bool,
    ) -> tuple[Any, bool]:
        """The child's next reply, or None if it died or was ended; and whether the limit ended it.

        `hear` is called with each message that comes before the reply; unless it `looks`, nobody
        asks meanwhile what memory the child has.
        """
        if self._came and not messages and not isinstance(self._came[0], _ON_THE_WAY):
            return self._came.popleft(), False
        self._deadline.set(limit, looks)
        try:
            if messages:
                self._send(messages)
            while isinstance(reply := self._next(), _ON_THE_WAY):
                hear(reply)
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            reply = None
        finally:
            self._deadline.clear()
        # Only now: a limit that passed while the reply came has ended the child all the same.
        return reply, self._deadline.is_expired

    def _next(self) -> Reply:
        """What the child says next, of which it sends some at a time."""
        if not self._came:
            self._came.extend(pickle.load(self._replies))
        return self._came.popleft()

    def _send(self, messages: Sequence[Setup | str]) -> None:
        with suppress(OSError):  # a child that has gone may have said why
            pickle.dump(messages, self._stdin, pickle.HIGHEST_PROTOCOL)
            self._stdin.flush()

    @property
    def _stdin(self) -> IO[bytes]:
        assert self._process
        assert self._process.stdin
        return self._process.stdin

    def _trouble(self, is_late: bool, limit: float) -> Trouble:
        if is_late:
            return timed_out(limit)
        if self._deadline.is_over:
            return too_large(self._memory.own, self._memory.limit)
        return crashed(self._code(), self._last_words.text())
