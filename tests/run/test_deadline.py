"""The time limit of many stages, one after the other, in one thread."""

from __future__ import annotations

import threading

from usdvol_lint.run.deadline import Deadline


def test_it_expires_once_and_begins_anew() -> None:
    ended = threading.Semaphore(0)
    deadline = Deadline(ended.release)
    for _ in range(2):
        deadline.set(60)
        deadline.clear()
        assert not deadline.is_expired
        deadline.set(0.01)
        assert ended.acquire(timeout=30)
        deadline.clear()
        assert deadline.is_expired


def test_a_shorter_limit_does_not_wait_for_a_longer_one() -> None:
    ended = threading.Event()
    deadline = Deadline(ended.set)
    deadline.set(3600)
    deadline.set(0.01)
    assert ended.wait(30)


def test_a_limit_can_be_moved_until_it_is_over() -> None:
    ended = threading.Semaphore(0)
    deadline = Deadline(ended.release)
    deadline.set(3600)
    deadline.move(0.01)
    assert ended.acquire(timeout=30)
    deadline.move(0.01)
    assert not ended.acquire(timeout=0.1)
    assert deadline.is_expired
    deadline.clear()
    deadline.move(0.01)
    assert not ended.acquire(timeout=0.1)
