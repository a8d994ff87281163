#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Installs the packages that the project needs, Debian's and npm's. This is the only place that names Debian's; those
# of npm stand in tests/node/package.json and web/viewer/package.json.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/setup.sh [build|python|all|bench|package|wasm|windows|arm64|cluster]

  build   what is needed to build the programs and to run the tests
  python  the same, and what the Python package needs; "pip install ." uses no
          network then
  all     the same, and what the checks need: clang-format, clang-tidy, the
          runtime of clang's fuzzer, abidiff, man, the shells whose completions
          are tested, Blender, OpenSCAD, mypy, Chromium, GNU parallel, what makes the manual's
          site, and of npm the validator of glTF, playwright, the SDK of
          the Model Context Protocol, esbuild and three.js (default)
  bench   what is needed to build, the libraries that the benchmarks compare
          this project with, and the meshers and the solver of one long test
  wasm    what is needed to build for browsers and node: emscripten, and what
          builds Debian's sources of the libraries that are linked; of npm
          esbuild
  windows what is needed to build for Windows and to run that: mingw-w64, wine,
          and what builds Debian's sources of the libraries that are linked
  arm64   what is needed to build for 64-bit ARM and to run that: a compiler and
          qemu; the libraries that are linked are unpacked in build/arm64-sysroot
  package
          the same as python, and what is needed to make and to check packages
  cluster
          what is needed to build, and Slurm and Snakemake, to try job scripts on this machine

Asks for nothing, and does nothing if all is there. Without npm's registry its packages are left out, with a
warning; tests that need them are skipped. Needs Debian 12 or a relative of it, and root or sudo
if something is missing.
TEXT
}

# What programs and tests are linked with.
linked_packages=(
  lib3mf-dev
  libboost-dev
  libcli11-dev
  libdraco-dev
  libeigen3-dev
  libexpat1-dev
  libgmock-dev
  libgtest-dev
  libjpeg-dev
  libmeshoptimizer-dev
  libnanoflann-dev
  libopenmesh-dev
  libpng-dev
  libspdlog-dev
  libtbb-dev
  libzip-dev
  libzstd-dev
  nlohmann-json3-dev
  zlib1g-dev
)
build_packages=(
  "${linked_packages[@]}"
  ca-certificates
  ccache
  cmake
  g++
  git
  libbenchmark-dev
  ninja-build
  pkg-config
  python3
  python3-jsonschema
  python3-yaml
)
python_packages=(
  patchelf
  pybind11-dev
  python3-dev
  python3-numpy
  python3-pip
  python3-venv
)
check_packages=(
  abigail-tools
  bash-completion
  blender
  chromium
  clang
  clang-format-14
  clang-tidy
  doxygen
  fish
  libclang-rt-dev
  lld
  locales
  man-db
  mkdocs
  mkdocs-material
  mypy
  openscad
  parallel
  zsh
)
# From wherever they are: others than Debian's have npm in the package of node.
command -v node >/dev/null || check_packages+=(nodejs)
command -v npm >/dev/null || check_packages+=(npm)

bench_packages=(
  calculix-ccx
  gmsh
  libcgal-dev
  libgmp-dev
  libmpfr-dev
  libopenvdb-dev
  tetgen
)

package_packages=(
  buildah
  debhelper
  debootstrap
  dh-python
  dpkg-dev
  fakeroot
  lintian
)

cluster_packages=(
  munge
  slurm-client
  slurmctld
  slurmd
  snakemake
)

wasm_packages=(
  ca-certificates
  cmake
  dpkg-dev
  emscripten
  libboost-dev
  libfast-float-dev
  libnanoflann-dev
  make
  ninja-build
  pkg-config
  python3
  xz-utils
)
command -v npm >/dev/null || wasm_packages+=(npm)

windows_packages=(
  ca-certificates
  ccache
  cmake
  dpkg-dev
  g++-mingw-w64-x86-64-posix
  libboost-dev
  libnanoflann-dev
  make
  ninja-build
  pkg-config
  python3
  wine64
  xz-utils
  zip
)

# The libraries of the other machine are not installed on this one: scripts/make_arm64_sysroot.sh.
arm64_packages=(
  ca-certificates
  ccache
  cmake
  g++-aarch64-linux-gnu
  ninja-build
  pkg-config
  python3
  python3-jsonschema
  python3-yaml
  qemu-user
)

case "${1:-all}" in
  build) packages=("${build_packages[@]}") ;;
  python) packages=("${build_packages[@]}" "${python_packages[@]}") ;;
  all) packages=("${build_packages[@]}" "${python_packages[@]}" "${check_packages[@]}") ;;
  bench) packages=("${build_packages[@]}" "${bench_packages[@]}") ;;
  wasm) packages=("${wasm_packages[@]}") ;;
  windows) packages=("${windows_packages[@]}") ;;
  arm64) packages=("${arm64_packages[@]}") ;;
  package) packages=("${build_packages[@]}" "${python_packages[@]}" "${package_packages[@]}") ;;
  cluster) packages=("${build_packages[@]}" "${cluster_packages[@]}") ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
  echo "setup.sh: this is no Debian; install the counterparts of: ${packages[*]}" >&2
  exit 1
fi

is_installed() {
  [ "$(dpkg-query --show --showformat='${db:Status-Status}' "$1" 2>/dev/null)" = installed ]
}

install_packages() {
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "setup.sh: not root, and there is no sudo; as root, run: apt-get install $*" >&2
      exit 1
    fi
    as_root=(sudo)
  fi
  echo "setup: installing $*"
  apt() {
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -o DPkg::Lock::Timeout=300 --quiet "$@"
  }
  apt update
  apt install --yes --no-install-recommends "$@"
}

# What the lock file of a folder names, unless just that is there. Only tests need it, and the making of the viewer: a
# registry that cannot be reached is no failure, all else is.
install_node_packages() {
  local folder installed said
  folder=$(dirname "${BASH_SOURCE[0]}")/../$1
  installed=$folder/node_modules/.installed-lock.json
  if cmp --silent "$folder/package-lock.json" "$installed"; then return; fi
  echo "setup: installing the packages of $1"
  if said=$(npm ci --prefix "$folder" --no-audit --no-fund --ignore-scripts --loglevel=error \
    --fetch-retries=1 --fetch-timeout=60000 2>&1); then
    cp "$folder/package-lock.json" "$installed"
  elif [[ $said =~ (ENOTFOUND|EAI_AGAIN|ECONNREFUSED|ECONNRESET|ETIMEDOUT|ERR_SOCKET_TIMEOUT|ENETUNREACH|EHOSTUNREACH|E[45][0-9][0-9]) ]]; then
    echo "setup.sh: warning: the registry of npm cannot be reached (${BASH_REMATCH[0]}); tests with the packages of" \
      "$1 will be skipped, all else is installed" >&2
  else
    echo "$said" >&2
    echo "setup.sh: npm cannot install the packages of $1" >&2
    exit 1
  fi
}

missing=()
for package in "${packages[@]}"; do
  is_installed "$package" || missing+=("$package")
done
if [ "${#missing[@]}" -gt 0 ]; then
  install_packages "${missing[@]}"
else
  echo "setup: all ${#packages[@]} packages are installed"
fi
if [ "${1:-all}" = arm64 ]; then
  "$(dirname "${BASH_SOURCE[0]}")/make_arm64_sysroot.sh" "${linked_packages[@]}"
fi
if [ "${1:-all}" = wasm ]; then
  install_node_packages web/viewer
fi
if [ "${1:-all}" = all ]; then
  install_node_packages tests/node
  install_node_packages web/viewer
fi
