"""`python -m tests.mutants`: breaks one condition after the other, and says which no test sees."""

from __future__ import annotations

import argparse
import os
import shutil
import subprocess
import sys
from collections import defaultdict
from collections.abc import Mapping, Sequence
from compileall import compile_dir
from importlib.metadata import version
from pathlib import Path
from py_compile import PycInvalidationMode
from tempfile import TemporaryDirectory

from .mutations import ROOT, DoesNotApplyError, Mutation, module_of_tests, read_mutations

_NOT_COPIED = shutil.ignore_patterns(".*", "__pycache__", "bench", "dist")
_PASSED, _FAILED, _NO_TESTS = 0, 1, 5
_WORDS = {_PASSED: "SURVIVED", _FAILED: "killed", _NO_TESTS: "NO SUCH TEST"}


def main() -> int:
    """Tries the mutations that the command line names, or all; 1 if one is not killed."""
    chosen = _chosen(_arguments(), read_mutations())
    with TemporaryDirectory(prefix="mutants-") as folder:
        copy = Path(folder).resolve() / "checkout"
        shutil.copytree(ROOT, copy, ignore=_NOT_COPIED)
        # A mutation may change neither the size of a file nor the second of its time stamp.
        compile_dir(copy, quiet=2, invalidation_mode=PycInvalidationMode.CHECKED_HASH)
        if _run(copy, _all_tests(chosen)) != _PASSED:
            print("the tests do not pass as the code is")
            return 1
        outcomes = [_try(copy, mutation) for mutation in chosen]
    print(f"{outcomes.count(True)} of {len(outcomes)} mutations were killed")
    return 0 if all(outcomes) else 1


def _arguments() -> Sequence[str]:
    parser = argparse.ArgumentParser(prog="python -m tests.mutants", description=__doc__)
    parser.add_argument("ids", nargs="*", help="the mutations to try, all by default")
    ids: Sequence[str] = parser.parse_args().ids
    return ids


def _chosen(ids: Sequence[str], mutations: Sequence[Mutation]) -> list[Mutation]:
    unknown = set(ids) - {mutation.id for mutation in mutations}
    if unknown:
        sys.exit(f"no mutation is called {', '.join(sorted(unknown))}")
    named = [mutation for mutation in mutations if not ids or mutation.id in ids]
    hidden = [mutation for mutation in named if mutation.usd not in ("", version("usd-core"))]
    for mutation in hidden:
        print(f"{mutation.id}: left out, for it shows with usd-core {mutation.usd} alone")
    return [mutation for mutation in named if mutation not in hidden]


def _all_tests(mutations: Sequence[Mutation]) -> dict[str, str]:
    """What all of the mutations are seen by, for one run."""
    wanted: defaultdict[str, list[str]] = defaultdict(list)
    for mutation in mutations:
        for module, keywords in mutation.seen_by.items():
            wanted[module].append(f"({keywords})" if keywords else "test")
    return {module: " or ".join(dict.fromkeys(each)) for module, each in wanted.items()}


def _try(copy: Path, mutation: Mutation) -> bool:
    """Whether every test module that is to see the mutation does."""
    try:
        path, text = mutation.applied(copy)
    except DoesNotApplyError as reason:
        print(f"{mutation.id}: DOES NOT APPLY: {reason}", flush=True)
        return False
    before = path.read_bytes()
    path.write_text(text, encoding="utf-8")
    outcomes = {name: _run(copy, {name: words}) for name, words in mutation.seen_by.items()}
    path.write_bytes(before)
    said = ", ".join(
        f"{_WORDS.get(code, f'pytest ended with {code}')} by {name}"
        for name, code in outcomes.items()
    )
    print(f"{mutation.id}: {said}", flush=True)
    return all(code == _FAILED for code in outcomes.values())


def _run(copy: Path, tests: Mapping[str, str]) -> int:
    """The exit code of pytest in the copy, the first that is not 0."""
    paths = os.pathsep.join(filter(None, (str(copy), os.environ.get("PYTHONPATH"))))
    environment = {**os.environ, "PYTHONPATH": paths, "PYTHONDONTWRITEBYTECODE": "1"}
    for name, keywords in tests.items():
        arguments = [str(module_of_tests(copy, name)), "-k", keywords, "-x", "-q", "--tb=no"]
        arguments += ["-p", "no:cacheprovider", f"--rootdir={copy}", f"-c{copy / 'pyproject.toml'}"]
        program = [sys.executable, "-P", "-m", "pytest", *arguments]
        ran = subprocess.run(
            program, cwd=copy, env=environment, stdout=subprocess.DEVNULL, check=False
        )
        if ran.returncode:
            return ran.returncode
    return 0


if __name__ == "__main__":
    sys.exit(main())
