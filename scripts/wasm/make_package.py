#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Puts the package of npm together in build/wasm/package, of web/package and the module in build/wasm. The same in, the same out.

Usage: make_package.py
"""

import json
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
MODULE = ROOT / "build/wasm/web/wasm"
TARGET = ROOT / "build/wasm/package"


# A command of the package for each program. npm makes what starts it on Windows.
COMMAND = """#!/usr/bin/env node
// SPDX-License-Identifier: MIT
import {{run}} from '../program.js';

run('{name}');
"""


def programs():
    return re.search(r"^set\(programs ([^)]+)\)", (ROOT / "apps/CMakeLists.txt").read_text(), re.MULTILINE)[1].split()


def version():
    return re.search(r"project\(meshrepair VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text())[1]


def main():
    if len(sys.argv) > 1:
        print(__doc__.strip(), file=sys.stderr)
        return 2
    if not (MODULE / "meshrepair.wasm").is_file():
        print("make_package.py: there is no module; run scripts/make_wasm.sh", file=sys.stderr)
        return 1
    shutil.rmtree(TARGET, ignore_errors=True)
    TARGET.mkdir(parents=True)
    for path in sorted((ROOT / "web/package/src").iterdir()):
        shutil.copyfile(path, TARGET / path.name)
    for name in ("meshrepair.mjs", "meshrepair.wasm"):
        shutil.copyfile(MODULE / name, TARGET / name)
    for name in ("README.md", "index.d.ts"):
        shutil.copyfile(ROOT / "web/package" / name, TARGET / name)
    shutil.copyfile(ROOT / "LICENSE", TARGET / "LICENSE")
    manifest = json.loads((ROOT / "web/package/package.json").read_text())
    manifest["version"] = version()
    manifest["bin"] = {name: f"bin/{name}.js" for name in programs()}
    (TARGET / "package.json").write_text(json.dumps(manifest, indent=2) + "\n")
    (TARGET / "bin").mkdir()
    for name, path in manifest["bin"].items():
        (TARGET / path).write_text(COMMAND.format(name=name))
        (TARGET / path).chmod(0o755)
    notice = subprocess.run([ROOT / "scripts/notice.py", "wasm"], check=True, capture_output=True, text=True)
    (TARGET / "NOTICE").write_text(notice.stdout)
    return 0


if __name__ == "__main__":
    sys.exit(main())
