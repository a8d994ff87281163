# SPDX-License-Identifier: MIT
"""meshrepair for Conan 2: the programs and the static libraries."""

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.cmake import CMake, CMakeDeps, CMakeToolchain, cmake_layout
from conan.tools.files import copy, get
from conan.tools.gnu import PkgConfigDeps

required_conan_version = ">=2.0"

# What the project's CMakeLists.txt calls them.
CMAKE_FILES = {"draco": "draco", "eigen": "Eigen3", "meshoptimizer": "meshoptimizer", "nanoflann": "nanoflann", "onetbb": "TBB",
               "openmesh": "OpenMesh"}
CMAKE_TARGETS = {"draco": "draco::draco", "openmesh::openmeshcore": "OpenMeshCore"}
LIBRARIES = ("hollow", "boolean", "repair", "extract", "simplify", "points", "picture", "check", "bsp", "mesh", "exact", "base")


class MeshrepairConan(ConanFile):
    name = "meshrepair"
    version = "0.1.0"
    description = "Turns any broken triangle mesh into the boundary of a solid"
    license = "MIT"
    homepage = "https://github.com/meshrepair/meshrepair"
    url = "https://github.com/meshrepair/meshrepair"
    topics = ("mesh", "repair", "geometry", "3d-printing")
    package_type = "static-library"
    settings = "os", "arch", "compiler", "build_type"

    def validate(self):
        if self.settings.os != "Linux":
            raise ConanInvalidConfiguration("meshrepair is for Linux")
        check_min_cppstd(self, 20)

    def layout(self):
        cmake_layout(self, src_folder="src")

    def requirements(self):
        for reference in ("boost/[>=1.74 <2]", "cli11/[>=2.1 <3]", "draco/[>=1.5 <2]", "eigen/3.4.0", "expat/[>=2.5 <3]",
                          "libjpeg-turbo/[>=2.1 <4]", "libpng/[>=1.6 <2]", "libzip/[>=1.7 <2]", "meshoptimizer/[>=0.18 <1]",
                          "nanoflann/[>=1.4 <2]", "nlohmann_json/[>=3.11 <4]", "onetbb/[>=2021.8 <2022]", "openmesh/[>=9 <12]",
                          "spdlog/[>=1.10 <2]", "zlib/[>=1.2 <2]", "zstd/[>=1.5 <2]"):
            # Headers of these are in headers of meshrepair.
            self.requires(reference, transitive_headers=reference.startswith(("eigen/", "openmesh/")))

    def build_requirements(self):
        self.tool_requires("cmake/[>=3.25 <5]")
        self.tool_requires("pkgconf/[>=2 <3]")

    def source(self):
        get(self, **self.conan_data["sources"][self.version], strip_root=True)

    def generate(self):
        dependencies = CMakeDeps(self)
        for name, file in CMAKE_FILES.items():
            dependencies.set_property(name, "cmake_file_name", file)
        for name, target in CMAKE_TARGETS.items():
            dependencies.set_property(name, "cmake_target_name", target)
        dependencies.generate()
        PkgConfigDeps(self).generate()
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["MESHREPAIR_BUILD_C"] = False
        toolchain.cache_variables["MESHREPAIR_BUILD_TESTS"] = False
        toolchain.cache_variables["MESHREPAIR_WARNINGS_AS_ERRORS"] = False
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", src=self.source_folder, dst=f"{self.package_folder}/licenses")

    def package_info(self):
        # The package's own CMake files say what each library needs.
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/meshrepair"]
        self.cpp_info.includedirs = ["include/meshrepair"]
        self.cpp_info.libs = [f"meshrepair_{name}" for name in LIBRARIES]
        self.cpp_info.system_libs = ["m", "pthread"]
