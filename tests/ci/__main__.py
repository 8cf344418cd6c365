"""`python -m tests.ci`: the steps of `action.yml` for real, with an installation from the network.

It takes a minute, so the tests run the same steps with what is installed already.
"""

from __future__ import annotations

import shutil
import sys
from pathlib import Path
from tempfile import TemporaryDirectory

sys.path[:0] = [str(Path(__file__).parent), str(Path(__file__).parent.parent)]


def main() -> int:
    """Installs the tool, and checks the two example shots: 1 if that does not end as it should."""
    from actionsteps import CHECK, INSTALL, Runner
    from process import ROOT

    with TemporaryDirectory(prefix="action-") as folder:
        runner = Runner(Path(folder).resolve())
        shutil.rmtree(runner.bin.parent)
        for name in ("shot", "broken"):
            shutil.copytree(ROOT / "docs" / "examples" / name, runner.workspace / name)
        codes = []
        for step, inputs in (
            (INSTALL, {}),
            (CHECK, {"paths": "shot", "args": "--quiet --fail-on info"}),
            (CHECK, {"paths": "broken", "summary": "false"}),
        ):
            done = runner.run(step, inputs)
            print(f"--- {step['name']} {inputs}: {done.code}\n{done.said}")
            codes.append(done.code)
    return int(codes != [0, 0, 1])


sys.exit(main())
