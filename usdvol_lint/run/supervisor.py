"""A worker process as its parent sees it: a stage goes in, a report comes out, even if it dies."""

from __future__ import annotations

import pickle
import signal
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from typing import IO, TYPE_CHECKING, Any

from usdvol_lint.child import start_child
from usdvol_lint.engine.trouble import Trouble, report_trouble
from usdvol_lint.model import Finding, StageReport, Status, UsageError
from usdvol_lint.run.deadline import Deadline
from usdvol_lint.run.protocol import Advance, Done, NewFindings, Ready, Refusal, Setup

if TYPE_CHECKING:
    import subprocess

_FROM_OUTSIDE = frozenset({"SIGHUP", "SIGKILL", "SIGTERM"})


class Worker:
    """One child process, replaced by a new one when it died or was ended.

    It is `child` or a new one, and imports USD until it is asked something.
    """

    def __init__(self, child: subprocess.Popen[bytes] | None = None) -> None:
        self.usd_version = ""
        self._deadline = Deadline(self.kill)
        self._adopt(child or start_child())

    def _adopt(self, child: subprocess.Popen[bytes]) -> None:
        self._process = child
        self._is_gone = False
        self._stderr: deque[bytes] = deque(maxlen=20)
        self._listener = threading.Thread(
            target=_drain, args=(child.stderr, self._stderr), daemon=True
        )
        self._listener.start()

    def prepare(self, setup: Setup, limit: float) -> None:
        """Hands over the rules; raises UsageError if the child is not ready within `limit` seconds.

        It is a UsageError too if the child can't load the rules, or can't import USD.
        """
        self._setup, self._ready_limit = setup, limit
        reply, expired = self._ask(setup, limit, lambda message: None)
        if isinstance(reply, Refusal):
            raise UsageError(" ".join(reply.reason.split()))
        if not isinstance(reply, Ready):
            how = f"not ready after {limit:g} s" if expired else _cause(self._process.wait())
            words = self._last_words().splitlines() or ["it said nothing"]
            raise UsageError(f"the process that loads USD does not start ({how}): {words[-1]}")
        self.usd_version = reply.usd_version

    def lint(self, path: str, limit: float, advance: Callable[[int], None]) -> StageReport:
        """The report on a stage, also where the child crashes or takes more than `limit` seconds.

        `advance` is called with numbers of samples, as those of a long sequence are read.
        """
        if self._is_gone:
            self.stop()
            self._adopt(start_child())
            self.prepare(self._setup, self._ready_limit)
        began = time.perf_counter()
        found: list[Finding] = []

        def hear(message: Advance | NewFindings) -> None:
            if isinstance(message, NewFindings):
                found.extend(message.findings)
            else:
                advance(message.samples)

        reply, timed_out = self._ask(path, limit, hear)
        self._is_gone = timed_out or not isinstance(reply, Done)
        if isinstance(reply, Done):
            return reply.with_findings(found)
        seconds = {"total": time.perf_counter() - began}
        trouble = self._timed_out(limit) if timed_out else self._crashed()
        status = Status.TIMED_OUT if timed_out else Status.CRASHED
        return report_trouble(path, trouble, status, seconds, found)

    def kill(self) -> None:
        """Ends the child at once, without waiting until it has gone."""
        self._process.kill()

    def stop(self) -> None:
        """Ends the child, and waits until it has gone."""
        self.kill()
        self._process.wait()
        for stream in (self._stdin, self._stdout):
            with suppress(OSError):
                stream.close()

    def _ask(
        self, message: Setup | str, limit: float, hear: Callable[[Advance | NewFindings], None]
    ) -> tuple[Any, bool]:
        """The child's reply, or None if it died or was ended; and whether the limit ended it.

        `hear` is called with each message that comes before the reply.
        """
        self._deadline.set(limit)
        try:
            with suppress(OSError):  # a child that has gone may have said why
                pickle.dump(message, self._stdin, pickle.HIGHEST_PROTOCOL)
                self._stdin.flush()
            while isinstance(reply := pickle.load(self._stdout), Advance | NewFindings):
                hear(reply)
        except (EOFError, OSError, ValueError, pickle.UnpicklingError):
            reply = None
        finally:
            self._deadline.clear()
        # Only now: a limit that passed while the reply came has ended the child all the same.
        return reply, self._deadline.is_expired

    @property
    def _stdin(self) -> IO[bytes]:
        assert self._process.stdin
        return self._process.stdin

    @property
    def _stdout(self) -> IO[bytes]:
        assert self._process.stdout
        return self._process.stdout

    def _timed_out(self, limit: float) -> Trouble:
        return Trouble(
            f"stopped after {limit:g} s, the limit for one stage",
            "a large stage or a slow disk needs more: raise --timeout, or look at less with "
            "--content first --times ends; a pipe or a corrupt layer never ends",
        )

    def _crashed(self) -> Trouble:
        code = self._process.wait()
        cause = _cause(code)
        if 0 <= code < 256 or cause == "SIGINT":  # which is how Python ends by KeyboardInterrupt
            what = "the process that checked it ended early"
            advice = (
                "a bug of usdvol-lint, a rule pack or a USD plugin; --verbose shows what it said"
            )
        elif cause in _FROM_OUTSIDE:
            what = "the process that checked it was ended from outside"
            advice = "give the machine more memory, or let fewer work at once with --jobs"
        else:
            what = "the USD library crashed while reading it"
            advice = (
                "the file or a layer it names is probably corrupt: open it with usdcat to see which"
            )
        return Trouble(f"{what} ({cause})", advice, detail=self._last_words())

    def _last_words(self) -> str:
        self._process.wait()
        self._listener.join(timeout=1)
        return b"".join(self._stderr).decode("utf-8", "replace").strip()


def _drain(stream: IO[bytes], lines: deque[bytes]) -> None:
    with stream:
        lines.extend(stream)


def _cause(code: int) -> str:
    if code >= 0:
        return f"exit code {code if code < 256 else hex(code)}"
    try:
        return signal.Signals(-code).name
    except ValueError:
        return f"signal {-code}"
