"""How many processors a process may use, as Linux says it of control groups."""

from __future__ import annotations

import os
from pathlib import Path

import pytest

from usdvol_lint.run import processors


@pytest.mark.parametrize(
    ("own", "files", "quotas"),
    [
        ("0::/", {"cpu.max": "150000 100000"}, [1.5]),
        ("0::/", {"cpu.max": "max 100000"}, []),
        ("0::/a/b", {"a/b/cpu.max": "max 100000", "a/cpu.max": "300000 100000"}, [3.0]),
        ("0::/gone/here", {"cpu.max": "50000 100000"}, [0.5]),
        (
            "4:memory:/x\n3:cpu,cpuacct:/x",
            {
                "cpu,cpuacct/x/cpu.cfs_quota_us": "200000",
                "cpu,cpuacct/x/cpu.cfs_period_us": "100000",
            },
            [2.0],
        ),
        (
            "3:cpu:/",
            {"cpu/cpu.cfs_quota_us": "-1", "cpu/cpu.cfs_period_us": "100000"},
            [],
        ),
        ("", {}, []),
    ],
)
def test_limits(own: str, files: dict[str, str], quotas: list[float], tmp_path: Path) -> None:
    (tmp_path / "own").write_text(own)
    for name, text in files.items():
        (tmp_path / "root" / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / "root" / name).write_text(f"{text}\n")
    found = processors._quotas(str(tmp_path / "root"), str(tmp_path / "own"))
    assert list(found) == quotas


def test_the_least_counts(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(processors, "_quotas", lambda: [1.2])
    monkeypatch.setattr(os, "process_cpu_count", lambda: 8, raising=False)
    assert processors.owned() == 2
    monkeypatch.setattr(processors, "_quotas", lambda: [])
    assert processors.owned() == 8
    monkeypatch.setattr(processors, "_quotas", lambda: [0.2])
    assert processors.owned() == 1
