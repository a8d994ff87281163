#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds the image of packaging/container, and tries it.
set -euo pipefail

usage() {
  cat <<TEXT
Usage: scripts/check_container.sh

Builds the image of packaging/container of what is committed, and repairs a mesh in a mounted folder with it. In place of the image
debian:12-slim it takes a bare Debian 12 that debootstrap makes, so that no registry of images is asked. All is below
build/package_work/container.

Needs root, the packages of Debian, and what scripts/setup.sh package installs.
TEXT
}

case "${1:-}" in
  "") ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

cd "$(dirname "${BASH_SOURCE[0]}")/.."
work=$PWD/build/package_work/container
version=$(sed -n 's/^project(meshrepair VERSION \([0-9.]*\).*/\1/p' CMakeLists.txt)
image=localhost/meshrepair:$version
base=localhost/debian-bare:12

build_ah() { buildah --root "$work/storage" --runroot "$work/run" --storage-driver vfs "$@"; }

make_base() {
  local container
  debootstrap --variant=minbase bookworm "$work/base" http://deb.debian.org/debian >"$work/debootstrap.log"
  container=$(build_ah from scratch)
  build_ah add --quiet "$container" "$work/base" / >/dev/null
  build_ah commit --quiet --rm "$container" "$base" >/dev/null
}

make_image() {
  mkdir "$work/source"
  git archive HEAD | tar -x -C "$work/source"
  build_ah build --isolation chroot --build-arg BASE="$base" --file packaging/container/Containerfile --tag "$image" "$work/source"
}

# As podman run --volume DATA:/data IMAGE broken.stl repaired.obj does, for which buildah alone is enough.
try_image() {
  local container entry
  container=$(build_ah from --pull-never "$image")
  entry=$(build_ah inspect --format '{{index .OCIv1.Config.Entrypoint 0}}' "$container")
  mkdir "$work/data"
  cp samples/meshes/broken_torus_box.stl "$work/data/broken.stl"
  chown -R 1000:1000 "$work/data"
  build_ah run --isolation chroot --volume "$work/data:/data" "$container" -- "$entry" broken.stl repaired.obj
  build_ah run --isolation chroot --volume "$work/data:/data" "$container" -- meshcheck repaired.obj
  if [ "$(stat --format=%u "$work/data/repaired.obj")" != 1000 ]; then
    echo "check_container.sh: the image does not work as its own user" >&2
    exit 1
  fi
}

rm -rf "$work"
mkdir -p "$work"
make_base
make_image
try_image
build_ah push --quiet "$image" "docker-archive:$work/image.tar:$image"
echo "check_container.sh: the image works; as an archive it has $(stat --format=%s "$work/image.tar") bytes: $work/image.tar"
