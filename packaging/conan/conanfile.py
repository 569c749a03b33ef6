"""The Conan 2 recipe of Roundel, beside its sources: `conan create packaging/conan`.

cargo builds the library, so Rust 1.88 or later must be there; users of the package need none."""
import os
import re

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy, load, rm, rmdir

required_conan_version = ">=2.0"

#: What cargo and CMake build from.
SOURCES = ("Cargo.toml", "Cargo.lock", "build.rs", "cbindgen.toml", "CMakeLists.txt", "LICENSE-*", "THIRD-PARTY.md",
           "src/*", "include/*", "benches/*", "cli/*", "cmake/*", "compat/*", "scripts/third-party")


class Roundel(ConanFile):
    name = "roundel"
    description = "Mixed-integer quadratic problems of geometry processing: orientation fields, seamless maps, quads"
    license = "MIT OR Apache-2.0"
    topics = ("geometry", "mesh", "quad-mesh", "mixed-integer", "quadratic", "optimization")
    package_type = "library"
    settings = "os", "arch", "compiler", "build_type"
    options = {"shared": [True, False]}
    default_options = {"shared": True}

    @property
    def _repository(self):
        return os.path.join(self.recipe_folder, os.pardir, os.pardir)

    def set_version(self):
        manifest = load(self, os.path.join(self._repository, "Cargo.toml"))
        self.version = re.search(r'\[workspace\.package\]\nversion = "(.*?)"', manifest)[1]

    def export_sources(self):
        for pattern in SOURCES:
            copy(self, pattern, self._repository, self.export_sources_folder)

    def layout(self):
        cmake_layout(self)

    def package_id(self):
        # cargo builds the library, always with optimisation; its interface is C, and that of C++ is in headers.
        del self.info.settings.compiler
        del self.info.settings.build_type

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables["ROUNDEL_BUILD_PROGRAM"] = False
        # Packages of several kinds can share what cargo builds.
        target = self.conf.get("user.roundel:cargo_target_dir", default=os.path.join(self.build_folder, "cargo"))
        toolchain.cache_variables["ROUNDEL_CARGO_TARGET_DIR"] = target
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "*", os.path.join(self.package_folder, "share", "doc", "Roundel"),
             os.path.join(self.package_folder, "licenses"))
        rmdir(self, os.path.join(self.package_folder, "share"))
        # Conan writes these files for each program that uses the package.
        rmdir(self, os.path.join(self.package_folder, "lib", "cmake"))
        rmdir(self, os.path.join(self.package_folder, "lib", "pkgconfig"))
        others = ("*.a",) if self.options.shared else ("*.so*", "*.dylib")
        for pattern in others:
            rm(self, pattern, os.path.join(self.package_folder, "lib"))

    def package_info(self):
        self.cpp_info.set_property("cmake_file_name", "Roundel")
        self.cpp_info.set_property("pkg_config_name", "roundel")
        target = "Roundel::roundel" if self.options.shared else "Roundel::roundel_static"
        self.cpp_info.set_property("cmake_target_name", target)
        self.cpp_info.libs = ["roundel"]
        if not self.options.shared and self.settings.os == "Linux":
            self.cpp_info.system_libs = ["gcc_s", "util", "rt", "pthread", "m", "dl", "c"]
        elif not self.options.shared and self.settings.os == "Macos":
            self.cpp_info.system_libs = ["System", "iconv", "m"]
