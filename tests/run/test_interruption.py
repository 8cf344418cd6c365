"""What the first signal does, and those after it."""

from __future__ import annotations

import signal
import time
from collections.abc import Iterator

import pytest

from usdvol_lint.run import interruption
from usdvol_lint.run.interruption import Interruption


@pytest.fixture(autouse=True)
def handlers() -> Iterator[None]:
    """Leaves those of the tests as they were."""
    names = [
        getattr(signal, name)
        for name in (*interruption._ENDING, "SIGALRM")
        if hasattr(signal, name)
    ]
    before = [signal.getsignal(name) for name in names]
    yield
    if hasattr(signal, "setitimer"):
        signal.setitimer(signal.ITIMER_REAL, 0)
    for name, handler in zip(names, before, strict=True):
        signal.signal(name, handler)


def heard(*numbers: int) -> int:
    """How many of these signals raised nothing, one after the other."""
    for count, number in enumerate(numbers):
        try:
            signal.raise_signal(number)
        except KeyboardInterrupt:
            return count
    return len(numbers)


def listening() -> Interruption:
    signals = Interruption()
    signals.listen()
    return signals


def test_what_is_held_is_not_disturbed_before_the_third_signal() -> None:
    signals = listening()
    assert heard(signal.SIGTERM, signal.SIGINT, signal.SIGINT) == 2
    assert signals.number == signal.SIGTERM


def test_a_late_second_signal_is_heard(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruption, "_PATIENCE", -1.0)
    listening()
    assert heard(signal.SIGINT, signal.SIGINT) == 1


def test_what_was_held_is_told_at_its_release() -> None:
    signals = listening()
    assert heard(signal.SIGTERM) == 1
    with pytest.raises(KeyboardInterrupt) as raised:
        signals.release()
    assert raised.value.args == (signal.SIGTERM,)


def test_a_run_is_stopped_once_and_then_what_it_has_is_written() -> None:
    signals, stops = listening(), []
    signals.release()
    signals.stops(lambda: stops.append(1))
    assert heard(signal.SIGINT, signal.SIGINT) == 2
    assert stops == [1]


def test_released_it_ends_at_once() -> None:
    signals = listening()
    signals.release()
    assert heard(signal.SIGTERM) == 0


def test_what_is_ignored_stays_so() -> None:
    signal.signal(signal.SIGTERM, signal.SIG_IGN)
    signals = listening()
    assert heard(signal.SIGTERM, signal.SIGTERM, signal.SIGTERM) == 3
    assert signals.number == 0


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="nothing wakes us there")
def test_what_nobody_reads_is_broken_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruption, "_STUCK", 0.1)
    listening()
    assert heard(signal.SIGTERM) == 1
    with pytest.raises(KeyboardInterrupt) as raised:
        time.sleep(10)
    assert raised.value.args == (signal.SIGTERM,)


@pytest.mark.skipif(not hasattr(signal, "setitimer"), reason="nothing wakes us there")
def test_what_makes_progress_is_finished(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(interruption, "_STUCK", 0.1)
    listening()
    assert heard(signal.SIGTERM) == 1
    until = time.process_time() + 0.5
    while time.process_time() < until:
        pass
