"""What USD's errors say, with files named as findings name them."""

from __future__ import annotations

import os
import re
from typing import Any

from usdvol_lint.facts.usd.diagnostics import commentary
from usdvol_lint.paths import display

# Few stages fail, so what takes their errors apart is compiled only then.
_SESSION = r", sessionLayer @anon:[^@]*@"
_MENTION = r"[@<]([^@<>]+)[@>]"


def messages(error: Any) -> list[str]:
    """The message of each error in a `Tf.ErrorException`."""
    return [_message(each) for each in error.args]


def _message(error: Any) -> str:
    return re.sub(_MENTION, _shown, re.sub(_SESSION, "", commentary(error)))


def _shown(mention: re.Match[str]) -> str:
    return display(mention[1]) if os.path.isfile(mention[1]) else mention[0]
