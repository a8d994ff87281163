#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs packages into a bare Debian 12, and tries them there.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/check_packages.sh PACKAGES

Installs what scripts/package.sh has made in the folder PACKAGES into a bare Debian 12, one after another: the archive, the wheel, the
Debian packages. A mesh is repaired with each; those with the same program have to give the same bytes. The Python package has to do
what README.md says, and programs have to find the C and C++ libraries.

Needs root, the packages of Debian, and what scripts/setup.sh package installs.
TEXT
}

case "${1:-}" in
  -h | --help) usage; exit 0 ;;
  "" | -*) usage >&2; exit 2 ;;
esac

packages=$(realpath "$1")
cd "$(dirname "${BASH_SOURCE[0]}")/.."
bare=$PWD/build/package_work/bare
log=$PWD/build/package_work/check.log

make_bare() {
  rm -rf "$bare"
  mkdir -p "$bare"
  debootstrap --variant=minbase bookworm "$bare" http://deb.debian.org/debian >"$log"
  mkdir "$bare/packages"
  cp "$packages"/*.deb "$packages"/*.tar.gz "$packages"/*.whl "$bare/packages"
  cp samples/meshes/broken_torus_box.stl samples/meshes/cube.stl README.md tests/package/try_python.py "$bare/packages"
  cp -r tests/package "$bare/packages/consumer"
}

# A command in the bare system, in its folder /packages.
in_bare() {
  # Programs find the libraries beside them through /proc.
  unshare --mount bash -c 'mount -t proc proc "$0/proc" &&
    exec chroot "$0" /usr/bin/env -i --chdir=/packages PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root DEBIAN_FRONTEND=noninteractive \
      bash -euc "$1"' "$bare" "$1"
}

install() { in_bare "apt-get -o Dpkg::Use-Pty=0 install -qy --no-install-recommends $*" >>"$log"; }

# Before any package is there: the archive needs nothing but the C++ library, which apt itself needs.
check_archive() {
  in_bare "tar -xzf meshrepair-*.tar.gz
    mv meshrepair-*/ /opt/meshrepair
    /opt/meshrepair/bin/meshrepair broken_torus_box.stl archive.obj
    /opt/meshrepair/bin/meshcheck archive.obj"
}

# In an environment of its own, with none of the libraries that the wheel has inside. numpy alone is lent by Debian, so that the check
# does not need PyPI; pip sees that it is there.
check_wheel() {
  install python3-numpy python3-venv
  in_bare "python3 -m venv /venv
    cp -r /usr/lib/python3/dist-packages/numpy* /venv/lib/python3*/site-packages
    /venv/bin/pip install --no-index --disable-pip-version-check meshrepair-*.whl
    /venv/bin/python try_python.py README.md broken_torus_box.stl archive.obj
    rm -r /venv"
}

check_debian() {
  install /packages/meshrepair_*.deb
  in_bare "meshrepair broken_torus_box.stl package.obj
    meshcheck package.obj
    cmp archive.obj package.obj"
  install /packages/python3-meshrepair_*.deb
  in_bare "python3 try_python.py README.md broken_torus_box.stl package.obj"
  install g++ cmake make /packages/libmeshrepair0_*.deb /packages/libmeshrepair-dev_*.deb
  in_bare "cd consumer
    cmake -B build
    cmake --build build
    build/consumer ../cube.stl
    build/c_consumer ../cube.stl"
}

make_bare
check_archive
in_bare "apt-get update -q" >>"$log"
check_wheel
check_debian
echo "check_packages.sh: archive, wheel and Debian packages work in a bare Debian 12"
