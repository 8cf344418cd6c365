"""The published schema of the JSON report, and the same with every object closed."""

from __future__ import annotations

import json
from typing import Any

from process import ROOT

from usdvol_lint.report.json_report import SCHEMA_VERSION

SCHEMA: dict[str, Any] = json.loads(
    (ROOT / f"usdvol_lint/report/report-{SCHEMA_VERSION}.schema.json").read_text(encoding="utf-8")
)


def strict(schema: Any) -> Any:
    """The schema with every object closed: what is not described there fails."""
    if isinstance(schema, list):
        return list(map(strict, schema))
    if not isinstance(schema, dict):
        return schema
    closed = {"additionalProperties": False} if "required" in schema else {}
    return {**{key: strict(value) for key, value in schema.items()}, **closed}


STRICT: dict[str, Any] = strict(SCHEMA)
