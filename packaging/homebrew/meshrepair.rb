# The programs, for Linux. Homebrew has no meshoptimizer, so that is built and linked in.
class Meshrepair < Formula
  desc "Turns any broken triangle mesh into the boundary of a solid"
  homepage "https://github.com/meshrepair/meshrepair"
  url "https://github.com/meshrepair/meshrepair/archive/refs/tags/v0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"
  head "https://github.com/meshrepair/meshrepair.git", branch: "main"

  depends_on "boost" => :build
  depends_on "cli11" => :build
  depends_on "cmake" => :build
  depends_on "eigen@3" => :build
  depends_on "nanoflann" => :build
  depends_on "ninja" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "draco"
  depends_on "expat"
  depends_on "fmt"
  depends_on "jpeg-turbo"
  depends_on "libpng"
  depends_on "libzip"
  depends_on :linux
  depends_on "open-mesh"
  depends_on "spdlog"
  depends_on "tbb"
  depends_on "zlib"
  depends_on "zstd"

  resource "meshoptimizer" do
    url "https://github.com/zeux/meshoptimizer.git", tag: "v0.22"
  end

  def install
    resource("meshoptimizer").stage do
      system "cmake", "-S", ".", "-B", "build", *std_cmake_args(install_prefix: buildpath/"meshoptimizer", install_libdir: "lib")
      system "cmake", "--build", "build"
      system "cmake", "--install", "build"
    end
    options = %W[
      -DCMAKE_PREFIX_PATH=#{buildpath}/meshoptimizer
      -DMESHREPAIR_BUILD_C=OFF
      -DMESHREPAIR_BUILD_TESTS=OFF
      -DMESHREPAIR_WARNINGS_AS_ERRORS=OFF
    ]
    system "cmake", "-S", ".", "-B", "build", "-G", "Ninja", *options, *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
    # The libraries would need meshoptimizer's.
    rm_r [include, lib]
  end

  test do
    (testpath/"corners.obj").write <<~OBJ
      v 0 0 0
      v 1 0 0
      v 0 1 0
      v 0 0 1
      f 1 3 2
      f 1 2 4
      f 1 4 3
    OBJ
    system bin/"meshrepair", "corners.obj", "solid.obj"
    system bin/"meshcheck", "solid.obj"
  end
end
