"""Which settings exclude each other, wherever they are said."""

from __future__ import annotations

from collections.abc import Iterator

from usdvol_lint.config import Config
from usdvol_lint.model import UsageError


def check_depth(settings: Config) -> None:
    """Raises UsageError where little is looked at, and much is concluded from it.

    A suppression would seem unused, and what was left out checked.
    """
    if settings.fail_on_unchecked:
        asking = _said(settings, "fail-on-unchecked", "")
    elif "unused" in settings.show:
        asking = _said(settings, "show", "unused")
    else:
        return
    for lessening in _lessening(settings):
        needed = f"{asking} needs a run that looks at everything"
        raise UsageError(f"{needed}: leave out {lessening}")


def _lessening(settings: Config) -> Iterator[str]:
    """What is said that leaves something out."""
    for name in ("load", "content", "times"):
        value = getattr(settings, name)
        if value != "all":
            yield _said(settings, name, str(value))
    if settings.assume_present and settings.fail_on_unchecked:
        yield _said(settings, "assume-present", "")


def _said(settings: Config, key: str, value: str) -> str:
    """A value with where it is said: `--load none`, `usdvol-lint.toml: load = 'none'`."""
    origin = settings.origins.of(key, value if key == "show" else "")
    if not value:
        return origin.words
    return f"{origin.words} = {value!r}" if origin.file else f"{origin.words} {value}"
