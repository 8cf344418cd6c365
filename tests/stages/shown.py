"""What a JSON report says of each stage, put together from its causes and their places."""

from __future__ import annotations

from typing import Any


def by_stage(report: Any) -> list[dict[str, Any]]:
    """The stages, each with `findings` in place of the numbers of causes.

    A finding has what is said of its cause, of the source of that, and of the place.
    """
    stages = [{**stage, "findings": []} for stage in report["stages"]]
    for cause in report["causes"]:
        said = {key: value for key, value in cause.items() if key not in ("places", "source")}
        for place in cause["places"]:
            finding = {**said, **cause["source"], **place}
            stages[finding.pop("stage")]["findings"].append(finding)
    for stage in stages:
        del stage["causes"]
    return stages
