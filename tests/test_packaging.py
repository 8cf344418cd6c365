"""What is installed is whole: the wheel is built, installed and run away from the checkout."""

from __future__ import annotations

import subprocess
import sys
import zipfile
from pathlib import Path, PurePosixPath

import pytest
from process import ROOT, Ran, environment, run

from usdvol_lint import __version__

PIP = [sys.executable, "-m", "pip", "--disable-pip-version-check", "--quiet"]
STAGE = """\
#usda 1.0
def Volume "smoke"
{
    float3[] extent = [(0, 0, 0), (1, 1, 1)]
    rel field:density = </smoke/density>
    def OpenVDBAsset "density"
    {
        asset filePath = @./gone.vdb@
        token fieldDataType = "float"
        token fieldName = "density"
    }
}
"""
FOUND = "stage.usda:8:26: AST002 error </smoke/density.filePath> no file at './gone.vdb'\n"


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    arguments = [
        "wheel",
        "--no-deps",
        "--no-build-isolation",
        "--wheel-dir",
        str(folder),
        str(ROOT),
    ]
    subprocess.run([*PIP, *arguments], check=True, timeout=300)
    (built,) = folder.glob("*.whl")
    return built


@pytest.fixture(scope="module")
def installed(wheel: Path, tmp_path_factory: pytest.TempPathFactory) -> Path:
    target = tmp_path_factory.mktemp("installed")
    arguments = ["install", "--no-deps", "--no-index", "--target", str(target), str(wheel)]
    subprocess.run([*PIP, *arguments], check=True, timeout=300)
    return target


def sources(folder: Path) -> set[str]:
    """What git would take of a folder, as far as that shows in the names."""
    return {
        path.relative_to(folder).as_posix()
        for path in folder.rglob("*")
        if path.is_file() and "__pycache__" not in path.parts
    }


def test_the_wheel_holds_all_of_it_and_nothing_else(wheel: Path) -> None:
    with zipfile.ZipFile(wheel) as archive:
        names = {name for name in archive.namelist() if not name.endswith("/")}
    information = f"usdvol_lint-{__version__}.dist-info"
    engine = {f"usdvol_lint/{name}" for name in sources(ROOT / "usdvol_lint")}
    rules = {f"usdvol_lint/rules/{name}" for name in sources(ROOT / "rules")}
    assert {name for name in names if PurePosixPath(name).parts[0] != information} == engine | rules
    assert {
        "usdvol_lint/py.typed",
        "usdvol_lint/help.txt",
        "usdvol_lint/report/report-2.0.schema.json",
        "usdvol_lint/report/report-line-2.0.schema.json",
        "usdvol_lint/rules/asset/file_missing.py",
        "usdvol_lint/rules/asset/file_missing.md",
        "usdvol_lint/rules/lint/stage_unreadable.md",
        f"{information}/METADATA",
        f"{information}/entry_points.txt",
        f"{information}/licenses/LICENSE",
    } <= names


@pytest.mark.parametrize("in_checkout", [False, True], ids=["elsewhere", "in-the-checkout"])
def test_the_wheel_works(in_checkout: bool, installed: Path, tmp_path: Path) -> None:
    """Also where the checkout is the working directory: then still the wheel's rules are run."""
    (tmp_path / "stage.usda").write_text(STAGE, encoding="utf-8")
    env = environment(PYTHONPATH=str(installed))
    cwd = ROOT if in_checkout else tmp_path
    where = "import usdvol_lint.packs.catalog as c; print(*c.load().folders, sep='\\n')"
    done = subprocess.run(
        [sys.executable, "-P", "-c", where],
        cwd=cwd,
        env=env,
        check=True,
        capture_output=True,
        text=True,
    )
    assert done.stdout.splitlines()[0] == str(installed / "usdvol_lint" / "rules")
    select = ("--isolated", "--select", "AST002", "--output-format", "concise")
    stage = tmp_path / "stage.usda"
    place = stage.as_posix() if in_checkout else stage.name
    ran = run(*select, stage, cwd=cwd, env=env)
    assert ran == Ran(1, FOUND.replace("stage.usda", place), "")
    page = (ROOT / "rules" / "asset" / "file_missing.md").read_text(encoding="utf-8")
    assert run("--explain", "AST002", cwd=cwd, env=env) == Ran(0, page, "")
    assert run("--version", cwd=cwd, env=env) == Ran(0, f"usdvol-lint {__version__}\n", "")


def test_every_rule_is_in_the_wheel(installed: Path, tmp_path: Path) -> None:
    here = run("--list-rules", "--isolated", cwd=tmp_path)
    there = run(
        "--list-rules", "--isolated", cwd=tmp_path, env=environment(PYTHONPATH=str(installed))
    )
    assert there == here


def test_the_command_is_installed_under_its_name(installed: Path, tmp_path: Path) -> None:
    scripts = list((installed / "bin").glob("usdvol-lint*"))
    scripts += (installed / "Scripts").glob("usdvol-lint*")
    (script,) = scripts
    (tmp_path / "stage.usda").write_text(STAGE, encoding="utf-8")
    done = subprocess.run(
        [str(script), "--isolated", "--select", "AST002", "--output-format", "concise", "."],
        cwd=tmp_path,
        env=environment(PYTHONPATH=str(installed)),
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout, done.stderr) == (1, FOUND, "")


def test_the_public_names(installed: Path, tmp_path: Path) -> None:
    """What the package promises to programs: everything in __all__, and lint() with defaults."""
    (tmp_path / "stage.usda").write_text(STAGE, encoding="utf-8")
    program = (
        "import usdvol_lint, sys\n"
        "assert not {'pxr', 'numpy'} & sys.modules.keys()\n"
        "for name in usdvol_lint.__all__: getattr(usdvol_lint, name)\n"
        "config = usdvol_lint.Config(select=('AST002',))\n"
        "for run in range(2):\n"
        "    report = usdvol_lint.lint(['stage.usda'], config)\n"
        "    print(*[(c.code, c.first.site.line) for c in report.causes])\n"
        "assert 'pxr' not in sys.modules\n"
        "try: usdvol_lint.lint(['.'], usdvol_lint.Config(select=('NO',)))\n"
        "except usdvol_lint.UsageError as error: print(error)\n"
    )
    done = subprocess.run(
        [sys.executable, "-P", "-W", "error", "-c", program],
        cwd=tmp_path,
        env=environment(PYTHONPATH=str(installed)),
        capture_output=True,
        text=True,
        check=False,
    )
    said = "('AST002', 8)\n" * 2
    said += "select: 'NO' is no rule, no family and no beginning of a code\n"
    assert (done.returncode, done.stdout, done.stderr) == (0, said, "")
