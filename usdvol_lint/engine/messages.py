"""What USD's errors say, with files named as findings name them."""

from __future__ import annotations

import os
import re

from usdvol_lint.facts.usd.diagnostics import Unreadable, sayings
from usdvol_lint.paths import display

# Few stages fail, so what takes their errors apart is compiled only then.
_SESSION = r", sessionLayer @anon:[^@]*@"
_MENTION = r"(?s)(?P<source> at '.*' in <)|[@<](?P<path>[^@<>]+)[@>]"
"""A path that USD names, or before that what a layer's text has where it breaks, as it stands."""


def messages(error: Unreadable) -> list[str]:
    """The message of each error that USD raised at once."""
    return [re.sub(_MENTION, _shown, re.sub(_SESSION, "", said)) for said in sayings(error)]


def _shown(mention: re.Match[str]) -> str:
    path = mention["path"]
    return display(path) if path and os.path.isfile(path) else mention[0]
