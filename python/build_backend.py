# SPDX-License-Identifier: MIT
"""Builds the wheel of the Python package: the PEP 517 backend that pyproject.toml names.

The package is a part of a project that CMake builds, so this drives CMake and packs what it installs. It is a page of
the standard library's Python: Debian 12 has no backend for CMake, and meson-python would need a second description of
the build. There is nothing to download, so that pip works without a network.

Settings of pip (--config-settings name=value):

- build-dir: the build tree to use and to keep (build/wheel unless given); one that is configured already is taken as it is.
- libraries=inside: the wheel has the shared libraries in it that not every Linux has, as bundled_libraries.py says, and says on which
  systems it runs. Without this it is for the machine on which it was made.
"""

import base64
import hashlib
import io
import os
import re
import shutil
import subprocess
import sys
import sysconfig
import tarfile
import tempfile
import tomllib
import zipfile
from pathlib import Path

import bundled_libraries

ROOT = Path(__file__).resolve().parent.parent
DATE = (1980, 1, 1, 0, 0, 0)  # of all files in the wheel: the same input gives the same bytes


def _project():
    with open(ROOT / "pyproject.toml", "rb") as file:
        project = tomllib.load(file)["project"]
    text = (ROOT / "CMakeLists.txt").read_text(encoding="utf-8")
    project["version"] = re.search(r"project\(meshrepair VERSION ([\d.]+)", text)[1]
    return project


def _name(project):
    return f"{project['name']}-{project['version']}"


def _tag(platform):
    python = f"cp{sys.version_info.major}{sys.version_info.minor}"
    return f"{python}-{python}-{platform}"


def _this_platform():
    return re.sub(r"[-.]", "_", sysconfig.get_platform())


def _puts_libraries_inside(settings):
    where = settings.get("libraries", "outside")
    if where not in ("inside", "outside"):
        sys.exit(f"build_backend.py: libraries={where}: can be inside or outside")
    return where == "inside"


def _metadata(project):
    head = ["Metadata-Version: 2.1", f"Name: {project['name']}", f"Version: {project['version']}",
            f"Summary: {project['description']}", f"License: {project['license']['text']}",
            f"Requires-Python: {project['requires-python']}", "Description-Content-Type: text/markdown"]
    head += [f"Requires-Dist: {dependency}" for dependency in project["dependencies"]]
    return "\n".join(head) + "\n\n" + (ROOT / "docs/python.md").read_text(encoding="utf-8")


def _run(*command):
    # pip reads what is printed here when the build fails.
    subprocess.run([str(word) for word in command], check=True, stdout=sys.stderr)


def _install(build, folder):
    """Builds the package, and puts its files below a folder."""
    if not (build / "CMakeCache.txt").exists():
        generator = ["-G", "Ninja"] if shutil.which("ninja") else []
        _run("cmake", "-S", ROOT, "-B", build, *generator, "-DCMAKE_BUILD_TYPE=Release", "-DMESHREPAIR_BUILD_PYTHON=ON",
             f"-DPython3_EXECUTABLE={sys.executable}", "-DMESHREPAIR_BUILD_TESTS=OFF",
             "-DMESHREPAIR_WARNINGS_AS_ERRORS=OFF", "-DCMAKE_UNITY_BUILD=ON")
    _run("cmake", "--build", build, "--parallel", os.cpu_count() or 1, "--target", "meshrepair_python", "app_meshrepair")
    for component in ("python", "python-program"):
        _run("cmake", "--install", build, "--prefix", folder, "--component", component, "--strip")


def _extension(folder):
    """The extension module, for the Python that this is; a build tree that was there may be another's."""
    extension = folder / "meshrepair" / f"_core{sysconfig.get_config_var('EXT_SUFFIX')}"
    if not extension.exists():
        sys.exit(f"build_backend.py: the build tree is not for Python {sys.version_info.major}.{sys.version_info.minor}")
    return extension


def _add_libraries(folder, info):
    """Puts the libraries inside, and returns the platforms on which the package runs then."""
    libraries = folder / "meshrepair.libs"
    files = [_extension(folder), folder / "meshrepair" / "bin" / "meshrepair"]
    try:
        bundled_libraries.bundle(files, libraries, folder / info / "licenses", rename=True)
        return bundled_libraries.platform_of([*files, *libraries.iterdir()])
    except bundled_libraries.Refused as error:
        sys.exit(f"build_backend.py: {error}")


def _record_line(name, data):
    digest = base64.urlsafe_b64encode(hashlib.sha256(data).digest()).rstrip(b"=").decode()
    return f"{name},sha256={digest},{len(data)}\n"


def _add(wheel, name, data, mode=0o644):
    entry = zipfile.ZipInfo(name, DATE)
    entry.external_attr = (0o100000 | mode) << 16
    entry.compress_type = zipfile.ZIP_DEFLATED
    wheel.writestr(entry, data)
    return _record_line(name, data)


def _info(project):
    return f"{_name(project)}.dist-info"


def _write_wheel(path, project, folder, platform):
    info = _info(project)
    with zipfile.ZipFile(path, "w") as wheel:
        record = "".join(_add(wheel, file.relative_to(folder).as_posix(), file.read_bytes(), file.stat().st_mode & 0o777)
                         for file in sorted(folder.rglob("*")) if file.is_file())
        for name, data in _facts(project, platform).items():
            record += _add(wheel, f"{info}/{name}", data)
        _add(wheel, f"{info}/RECORD", f"{record}{info}/RECORD,,\n".encode())


def _facts(project, platform):
    """The files of a wheel that say what it is."""
    tag = f"Wheel-Version: 1.0\nGenerator: meshrepair\nRoot-Is-Purelib: false\nTag: {_tag(platform)}\n"
    return {"METADATA": _metadata(project).encode(), "WHEEL": tag.encode(), "LICENSE": (ROOT / "LICENSE").read_bytes()}


def prepare_metadata_for_build_wheel(metadata_directory, config_settings=None):
    """Without this pip would build the wheel to see what it needs."""
    project = _project()
    folder = Path(metadata_directory) / _info(project)
    folder.mkdir()
    for name, data in _facts(project, _this_platform()).items():
        (folder / name).write_bytes(data)
    return folder.name


def build_wheel(wheel_directory, config_settings=None, metadata_directory=None):
    project, settings = _project(), config_settings or {}
    build = Path(settings.get("build-dir", ROOT / "build" / "wheel")).resolve()
    is_inside = _puts_libraries_inside(settings)
    with tempfile.TemporaryDirectory(prefix="meshrepair_wheel_") as name:
        folder = Path(name)
        _install(build, folder)
        _extension(folder)
        platform = _add_libraries(folder, _info(project)) if is_inside else _this_platform()
        name = f"{_name(project)}-{_tag(platform)}.whl"
        _write_wheel(Path(wheel_directory) / name, project, folder, platform)
    return name


def build_sdist(sdist_directory, config_settings=None):
    """All files that git knows."""
    project = _project()
    name = _name(project)
    listed = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, stdout=subprocess.PIPE).stdout
    with tarfile.open(Path(sdist_directory) / f"{name}.tar.gz", "w:gz") as archive:
        metadata = _metadata(project).encode()
        entry = tarfile.TarInfo(f"{name}/PKG-INFO")
        entry.size = len(metadata)
        archive.addfile(entry, io.BytesIO(metadata))
        for path in filter(None, os.fsdecode(listed).split("\0")):
            archive.add(ROOT / path, f"{name}/{path}", recursive=False)
    return f"{name}.tar.gz"
