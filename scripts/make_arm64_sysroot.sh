#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Unpacks Debian's packages for 64-bit ARM, and those they need, where compiler and qemu look for the root of that machine. They come with
# apt from the same mirrors as the packages of this machine, in the same versions, and nothing is installed here. What is there already is
# left as it is; remove the folder to get newer packages.
#
# Usage: scripts/make_arm64_sysroot.sh PACKAGE...
#
# scripts/setup.sh arm64 runs it with what the project links. The outcome is in build/arm64-sysroot.
set -euo pipefail

if [ $# -eq 0 ] || [[ $1 == -* ]]; then
  echo "Usage: scripts/make_arm64_sysroot.sh PACKAGE...; scripts/setup.sh arm64 runs it with what the project links" >&2
  exit 2
fi
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
sysroot=$root/build/arm64-sysroot
work=$sysroot/work
unpacked=$work/unpacked
if [ "$(cat "$unpacked" 2>/dev/null)" = "$*" ]; then
  echo "arm64: all packages are in $sysroot"
  exit
fi
rm -rf "$sysroot"
mkdir -p "$work"/{lists/partial,parts,cache/archives/partial} "$sysroot/usr/lib"
ln -s usr/lib "$sysroot/lib" # as on any Debian since 12

# The lists of that machine's packages, and where apt keeps them, apart from those of this one: this needs no root.
export APT_CONFIG=$work/apt.conf
cat >"$APT_CONFIG" <<CONF
APT::Architecture "arm64";
APT::Architectures { "arm64"; };
APT::Sandbox::User "$(id -un)";
Dir::Etc::SourceList "/dev/null";
Dir::Etc::SourceParts "$work/parts";
Dir::State::Lists "$work/lists";
Dir::State::status "$work/status";
Dir::Cache "$work/cache";
CONF
# Said to be there: OpenMesh's package asks for it and all it draws with, which is needed by its viewer alone.
cat >"$work/status" <<STATUS
Package: libopenscenegraph-dev
Status: install ok installed
Architecture: arm64
Version: 999
Maintainer: none
Description: none
STATUS
python3 "$root/scripts/source_lists.py" "$work/parts" deb
apt-get update --quiet --quiet
apt-get install --download-only --yes --no-install-recommends --quiet --quiet libc6-dev "$@"
for package in "$work"/cache/archives/*.deb; do
  dpkg-deb --fsys-tarfile "$package" | tar --extract --keep-directory-symlink --directory "$sysroot"
done

# Links from the root of the machine would lead into that of this one.
find "$sysroot" -path "$work" -prune -o -type l -lname '/*' -printf '%p\n' | while IFS= read -r link; do
  ln -sfnr "$sysroot$(readlink "$link")" "$link"
done
# Draco's package names its libraries by where they are on that machine.
sed -i "s|\"/usr/lib/|\"$sysroot/usr/lib/|" "$sysroot"/usr/lib/aarch64-linux-gnu/cmake/draco/draco-targets-*.cmake
rm -rf "$work/cache" "$work/lists"
echo "$*" >"$unpacked"
echo "arm64: all packages are in $sysroot"
