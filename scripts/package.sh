#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Makes what users install without compiling: Debian packages, an archive that runs from any folder, and a wheel.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/package.sh [deb|archive|wheel|addon|check|container|all] [OUT_DIR]

  deb      Debian packages of what is committed: meshrepair, libmeshrepair0, libmeshrepair-dev,
           python3-meshrepair. lintian reads them.
  archive  meshrepair-VERSION-ARCH.tar.gz: the programs and the libraries that they need, but for those of
           the C and C++ compilers. Runs from any folder.
  wheel    the Python package, for pip: with those libraries inside. Its name says which Linux it needs.
  addon    meshrepair-blender-VERSION.zip: the add-on, for Blender's preferences.
  check    tries the packages of OUT_DIR in a bare Debian 12: scripts/check_packages.sh.
           Needs root and the packages of Debian.
  container
           builds and tries the image of packaging/container: scripts/check_container.sh.
           Needs root and the packages of Debian.
  all      all but the container in turn (default)

OUT_DIR: build/packages. scripts/setup.sh package installs what is needed.
TEXT
}

case "${1:-all}" in
  deb | archive | wheel | addon | check | container | all) what=${1:-all} ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
out=$(realpath -m "${2:-build/packages}")
version=$(sed -n 's/^project(meshrepair VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
work=build/package_work
mkdir -p "$out"

# What is committed, as a Debian source package.
make_source() {
  local source="$work/source/meshrepair-$version"
  rm -rf "$work/source"
  mkdir -p "$source"
  git archive HEAD | tar -x -C "$source"
  mv "$source/packaging/debian" "$source/debian"
  if [ "$(dpkg-parsechangelog -l "$source/debian/changelog" -S Version)" != "$version" ]; then
    echo "package.sh: packaging/debian/changelog has another version than CMakeLists.txt: $version" >&2
    exit 1
  fi
}

make_deb() {
  make_source
  (cd "$work/source/meshrepair-$version" && DEB_BUILD_OPTIONS="parallel=$(nproc) noautodbgsym" dpkg-buildpackage --build=binary --no-sign)
  rm -f "$out"/*.deb
  cp "$work"/source/*.deb "$out"
  lintian --fail-on error,warning "$work"/source/*.changes
}

# The wheel and the archive are of one build, as the wheel's backend makes it.
build() {
  cmake -S . -B "$work/build" -G Ninja -DCMAKE_BUILD_TYPE=Release -DMESHREPAIR_BUILD_TESTS=OFF -DMESHREPAIR_BUILD_PYTHON=ON
  cmake --build "$work/build" --parallel "$(nproc)"
}

make_archive() {
  local name
  name=meshrepair-$version-$(dpkg --print-architecture)
  local root="$work/archive/$name"
  build
  rm -rf "$work/archive"
  cmake --install "$work/build" --prefix "$PWD/$root" --strip
  rm -rf "${root:?}/include" "${root:?}/lib"
  mkdir -p "$root/share/doc/meshrepair"
  cp LICENSE README.md "$root/share/doc/meshrepair"
  python/bundled_libraries.py --into "$root/lib" --licences "$root/share/doc/meshrepair/licences" "$root"/bin/*
  rm -f "$out"/*.tar.gz
  tar -C "$work/archive" --sort=name --owner=0 --group=0 --mtime="@$(git log -1 --format=%ct)" -c "$name" |
    gzip -n9 > "$out/$name.tar.gz"
}

make_wheel() {
  build
  rm -f "$out"/*.whl
  PIP_NO_INDEX=1 PIP_DISABLE_PIP_VERSION_CHECK=1 /usr/bin/python3 -m pip wheel --no-deps --config-settings build-dir="$PWD/$work/build" \
    --config-settings libraries=inside --wheel-dir "$out" .
}

make_addon() { git archive --format=zip -o "$out/meshrepair-blender-$version.zip" HEAD:integrations/blender; }

case "$what" in
  deb) make_deb ;;
  archive) make_archive ;;
  wheel) make_wheel ;;
  addon) make_addon ;;
  check) scripts/check_packages.sh "$out" ;;
  container) scripts/check_container.sh ;;
  all)  # no && between: it would turn off that the first failure ends the script
    make_deb
    make_archive
    make_wheel
    make_addon
    scripts/check_packages.sh "$out"
    ;;
esac
ls -l "$out"
