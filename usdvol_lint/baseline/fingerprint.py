"""x."""

from usdvol_lint.model import Source


def fingerprint(code: str, source: Source) -> str:
    from hashlib import sha256

    return sha256(
        "\0".join(part or "" for part in (code, *source)).encode("utf-8", "surrogatepass")
    ).hexdigest()[:16]
