#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""pip makes wheels of a build, without a network, and what it installs works: for this machine, and with libraries inside.

Usage: wheel_test.py BUILD

BUILD is a build tree with the Python package.

Example: tests/python/wheel_test.py build/release
"""

import os
import pathlib
import subprocess
import sys
import tempfile
import unittest.mock
import zipfile

sys.dont_write_bytecode = True

ROOT = pathlib.Path(__file__).resolve().parents[2]
USE = """
import meshrepair, sys
assert meshrepair.__file__.startswith(sys.prefix), meshrepair.__file__
corners = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)]
assert meshrepair.repair(corners, [(0, 2, 1), (0, 1, 3), (0, 3, 2)]).certified
"""


def run(*command, **options):
    # None but the wheel's own package is to be found, and nothing is to be asked of a network.
    environment = {**os.environ, "PIP_NO_INDEX": "1", "PIP_DISABLE_PIP_VERSION_CHECK": "1"}
    environment.pop("PYTHONPATH", None)
    result = subprocess.run(command, env=environment, check=False, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                            **options)
    if result.returncode != 0:
        sys.exit(f"{command}: exit code {result.returncode}\n{result.stdout}")
    return result.stdout


def make_wheel(build, folder, *settings):
    words = [word for setting in (f"build-dir={build}", *settings) for word in ("--config-settings", setting)]
    run(sys.executable, "-m", "pip", "wheel", "--no-deps", *words, "-w", folder, ROOT)
    (wheel,) = folder.glob("*.whl")
    return wheel


def check_platform(wheel, names, settings):
    """A wheel with libraries inside runs on other machines; all others are for this one."""
    has_libraries = any(name.startswith("meshrepair.libs/") for name in names)
    is_for_others = "-manylinux_" in wheel.name
    if has_libraries != bool(settings) or is_for_others != bool(settings):
        sys.exit(f"{wheel.name} was made with the settings {settings}: libraries inside: {has_libraries}")


def check_wheel(build, *settings):
    with tempfile.TemporaryDirectory(prefix="wheel_") as name:
        folder = pathlib.Path(name)
        wheel = make_wheel(build, folder, *settings)
        with zipfile.ZipFile(wheel) as archive:
            names = archive.namelist()
        check_platform(wheel, names, settings)
        for needed in ("meshrepair/py.typed", "meshrepair/_core.pyi", "meshrepair/bin/meshrepair", "meshrepair/viewer.html",
                       "meshrepair/scripts/repair_folder.py", "meshrepair/scripts/folder_repair/worker.py",
                       "meshrepair/scripts/folder_repair/gallery/gallery.js"):
            if needed not in names:
                sys.exit(f"{needed} is not in the wheel")
        run(sys.executable, "-m", "venv", "--system-site-packages", folder / "venv")
        python = folder / "venv" / "bin" / "python"
        run(python, "-m", "pip", "install", "--no-deps", wheel)
        run(python, "-c", USE, cwd=folder)
        version = run(python, "-m", "meshrepair", "--version", cwd=folder)
        if not version.startswith("meshrepair "):
            sys.exit(f"the program says {version}")


def check_other_python(build):
    """A build tree of another Python gives no wheel that says it is for this one."""
    sys.path.insert(0, str(ROOT / "python"))
    import build_backend
    with unittest.mock.patch("sysconfig.get_config_var", return_value=".cpython-399-x86_64-linux-gnu.so"):
        try:
            build_backend._extension(pathlib.Path(build) / "python")
        except SystemExit as error:
            if str(error).startswith("build_backend.py: the build tree is not for Python"):
                return
    sys.exit("a build tree of another Python was taken")


def main():
    build = os.path.abspath(sys.argv[1])
    check_other_python(build)
    check_wheel(build)
    check_wheel(build, "libraries=inside")


if __name__ == "__main__":
    main()
