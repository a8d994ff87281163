#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Builds what the project links, for another system: Debian's sources with Debian's patches, in the versions that Debian has as
# libraries, so that a file has the same bytes. They come with apt from the same mirrors as packages do. What is there already is left
# as it is.
#
# Usage: scripts/make_dependencies.sh wasm|windows
#
# Needs what scripts/setup.sh installs for this system. The outcome is in build/SYSTEM-dependencies: headers, libraries, and in
# share/doc/NAME/copyright the licence of each.
set -euo pipefail

usage() { sed -n '3,11p' "$0" | sed 's/^# \{0,1\}//'; }
case "${1:-}" in
  wasm) system=wasm toolchain=WasmToolchain compiler=emcc archiver=emar indexer=emranlib ;;
  windows)
    system=windows toolchain=WindowsToolchain compiler=x86_64-w64-mingw32-gcc-posix
    archiver=x86_64-w64-mingw32-ar indexer=x86_64-w64-mingw32-ranlib
    ;;
  -h | --help) usage; exit 0 ;;
  *) usage >&2; exit 2 ;;
esac

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
prefix=$root/build/$system-dependencies
work=$prefix/work
export NODE_PATH=${NODE_PATH:-/usr/share/nodejs}
# Lists of sources, and where apt keeps them, apart from those of the machine: this needs no root.
export APT_CONFIG=$work/apt.conf

make_lists() {
  mkdir -p "$work"/{lists/partial,parts,cache}
  cat >"$APT_CONFIG" <<CONF
Dir::Etc::SourceList "/dev/null";
Dir::Etc::SourceParts "$work/parts";
Dir::State::Lists "$work/lists";
Dir::Cache "$work/cache";
APT::Sandbox::User "$(id -un)";
CONF
  # Each source of packages that is Debian's own, as one of sources.
  python3 "$root/scripts/source_lists.py" "$work/parts"
  apt-get update --quiet --quiet
}

# fetch SOURCE: its unpacked and patched sources are in $work/SOURCE.
fetch() {
  if [ -d "$work/$1" ]; then return; fi
  if [ ! -f "$APT_CONFIG" ]; then make_lists; fi
  local download=$work/download/$1
  rm -rf "$download"
  mkdir -p "$download"
  # The newest; a mirror may lack what its lists name, and have the one before.
  local version
  for version in $(apt-cache showsrc --only-source "$1" | sed -n 's/^Version: //p' | sort --reverse --version-sort --unique); do
    if (cd "$download" && apt-get source --download-only "$1=$version" >"$work/$1.log" 2>&1); then break; fi
    rm -f "$download"/*
  done
  if [ -z "$(ls "$download")" ]; then
    tail -n 5 "$work/$1.log" >&2
    echo "make_dependencies.sh: the sources of $1 cannot be fetched" >&2
    exit 1
  fi
  dpkg-source --no-check --extract "$download"/*.dsc "$work/$1.part" >/dev/null
  mv "$work/$1.part" "$work/$1"
}

# build SOURCE FOLDER OPTION...: with CMake, from a folder of the sources.
build() {
  local name=$1 folder=$2
  shift 2
  if [ -f "$prefix/share/doc/$name/copyright" ]; then return; fi
  fetch "$name"
  echo "$system: $name"
  local tree=$work/$name-build
  rm -rf "$tree"
  cmake -S "$work/$name/$folder" -B "$tree" -G Ninja -Wno-dev --toolchain "$root/cmake/$toolchain.cmake" \
    -DCMAKE_BUILD_TYPE=Release -DCMAKE_INSTALL_PREFIX="$prefix" -DCMAKE_INSTALL_LIBDIR:STRING=lib -DBUILD_SHARED_LIBS=OFF \
    -DBUILD_TESTING=OFF "$@" >"$work/$name.log" 2>&1 &&
    cmake --build "$tree" >>"$work/$name.log" 2>&1 &&
    cmake --install "$tree" >>"$work/$name.log" 2>&1 || {
    tail -n 30 "$work/$name.log" >&2
    echo "make_dependencies.sh: $name cannot be built: see $work/$name.log" >&2
    exit 1
  }
  mkdir -p "$prefix/share/doc/$name"
  cp "$work/$name/debian/copyright" "$prefix/share/doc/$name/copyright"
}

# Its build by CMake needs a file that Debian leaves out. Neither exceptions nor vectors are in it.
make_zlib() {
  ./configure --static --prefix="$prefix" && make install
}

build_zlib() {
  if [ -f "$prefix/share/doc/zlib/copyright" ]; then return; fi
  fetch zlib
  echo "$system: zlib"
  (cd "$work/zlib" && CC=$compiler AR=$archiver RANLIB=$indexer CHOST=$system CFLAGS=-O3 make_zlib) >"$work/zlib.log" 2>&1 || {
    tail -n 30 "$work/zlib.log" >&2
    echo "make_dependencies.sh: zlib cannot be built: see $work/zlib.log" >&2
    exit 1
  }
  mkdir -p "$prefix/share/doc/zlib"
  cp "$work/zlib/debian/copyright" "$prefix/share/doc/zlib/copyright"
}

command -v "$compiler" >/dev/null || {
  echo "make_dependencies.sh: there is no $compiler; run scripts/setup.sh $system" >&2
  exit 1
}

# Headers alone, which are the same for all machines; as links, since those of the C library beside them are not.
# link_headers NAME PACKAGE
link_headers() {
  mkdir -p "$prefix/include" "$prefix/share/doc/${1%.hpp}"
  ln -sfn "/usr/include/$1" "$prefix/include/$1"
  cp "/usr/share/doc/$2/copyright" "$prefix/share/doc/${1%.hpp}/copyright"
}

# For find_package(nanoflann), as the one of the package leads to all headers of the machine.
describe_nanoflann() {
  local folder=$prefix/lib/cmake/nanoflann
  mkdir -p "$folder"
  cat >"$folder/nanoflannConfig.cmake" <<CMAKE
if(NOT TARGET nanoflann::nanoflann)
  add_library(nanoflann::nanoflann INTERFACE IMPORTED)
  target_include_directories(nanoflann::nanoflann INTERFACE "$prefix/include")
endif()
CMAKE
  cp /usr/share/nanoflann/cmake/nanoflannConfigVersion.cmake "$folder"
}

link_headers boost libboost-dev
if [ "$system" = wasm ]; then link_headers fast_float libfast-float-dev; fi
link_headers nanoflann.hpp libnanoflann-dev
describe_nanoflann

# For what takes no time in the end, and is loaded over networks all the same.
small=()
if [ "$system" = wasm ]; then small=("-DCMAKE_C_FLAGS_RELEASE=-Os -DNDEBUG" "-DCMAKE_CXX_FLAGS_RELEASE=-Os -DNDEBUG"); fi

# Its vectors are used as on x86, without the assembler of that.
fetch eigen3
sed -i 's/^#if EIGEN_COMP_GNUC && EIGEN_COMP_GNUC < 63$/& \&\& !defined(__EMSCRIPTEN__)/' "$work/eigen3/Eigen/src/Core/arch/SSE/PacketMath.h"
build eigen3 . -DEIGEN_BUILD_DOC=OFF -DEIGEN_BUILD_PKGCONFIG=OFF
build fmtlib . "${small[@]}" -DFMT_DOC=OFF -DFMT_TEST=OFF
build spdlog . "${small[@]}" -DSPDLOG_FMT_EXTERNAL=ON -DSPDLOG_BUILD_EXAMPLE=OFF
build cli11 . -DCLI11_BUILD_DOCS=OFF -DCLI11_BUILD_TESTS=OFF -DCLI11_BUILD_EXAMPLES=OFF
build nlohmann-json3 . -DJSON_BuildTests=OFF
build_zlib
build libzstd build/cmake -DZSTD_BUILD_PROGRAMS=OFF -DZSTD_BUILD_SHARED=OFF -DZSTD_MULTITHREAD_SUPPORT=OFF
# As its build by autoconf has it, which Debian uses: patches ask for the value.
fetch expat
sed -i -E 's/^(#cmakedefine XML_(DTD|NS))$/\1 1/' "$work/expat/expat/expat_config.h.cmake"
build expat expat -DEXPAT_BUILD_TOOLS=OFF -DEXPAT_BUILD_EXAMPLES=OFF -DEXPAT_BUILD_TESTS=OFF -DEXPAT_BUILD_DOCS=OFF \
  -DEXPAT_SHARED_LIBS=OFF
build libpng1.6 . -DPNG_SHARED=OFF -DPNG_TESTS=OFF
build libjpeg-turbo . -DENABLE_SHARED=OFF -DWITH_TURBOJPEG=OFF -DWITH_SIMD=OFF
build libzip . "${small[@]}" -DENABLE_COMMONCRYPTO=OFF -DENABLE_GNUTLS=OFF -DENABLE_MBEDTLS=OFF -DENABLE_OPENSSL=OFF \
  -DENABLE_WINDOWS_CRYPTO=OFF -DENABLE_BZIP2=OFF -DENABLE_LZMA=OFF -DBUILD_TOOLS=OFF -DBUILD_REGRESS=OFF \
  -DBUILD_EXAMPLES=OFF -DBUILD_DOC=OFF
# Vectors leave variables unused in it.
fetch meshoptimizer
sed -i 's/ -Werror)/)/' "$work/meshoptimizer/CMakeLists.txt"
build meshoptimizer .
draco_options=()
if [ "$system" = wasm ]; then
  export EMSCRIPTEN=/usr/share/emscripten
  draco_options=(-DDRACO_JS_GLUE=OFF -DDRACO_WASM=ON)
fi
build draco . "${draco_options[@]}" -DDRACO_TESTS=OFF -DDRACO_TRANSCODER_SUPPORTED=OFF
build openmesh . "${small[@]}" -DBUILD_APPS=OFF -DOPENMESH_DOCS=OFF
if [ "$system" = windows ]; then
  build onetbb . -DTBB_TEST=OFF -DTBB_STRICT=OFF
  build googletest . -DBUILD_GMOCK=ON
fi
echo "$system: all dependencies are in $prefix"
