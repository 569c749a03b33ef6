"""Puts the shared library and its declarations into the wheel.

cargo builds the library, unless ROUNDEL_LIBRARY names one that is already built. cffi in ABI mode reads
the declarations from roundel.h and writes them as a Python module. So the wheel is installed without a
compiler and without the header, for any Python 3.
"""

import os
import shutil
import subprocess
import sys
import sysconfig
from pathlib import Path

from hatchling.builders.hooks.plugin.interface import BuildHookInterface

sys.path.insert(0, str(Path(__file__).resolve().parent))

from build_header import declarations  # noqa: E402
from build_root import ROOT  # noqa: E402

NAMES = {"darwin": "libroundel.dylib", "win32": "roundel.dll"}


class LibraryHook(BuildHookInterface):
    """Makes `roundel/_declarations.py` and `roundel/libroundel.so`, and names the platform."""

    def initialize(self, version, build_data):
        if self.target_name != "wheel" or version == "editable":
            return
        name = NAMES.get(sys.platform, "libroundel.so")
        made = ROOT / "target" / "python"
        made.mkdir(parents=True, exist_ok=True)
        shutil.copyfile(self._library(name), made / name)
        self._declare(made / "_declarations.py")
        for file in (name, "_declarations.py"):
            build_data["force_include"][str(made / file)] = f"roundel/{file}"
        for licence in ("LICENSE-MIT", "LICENSE-APACHE", "THIRD-PARTY.md"):
            build_data["force_include"][str(ROOT / licence)] = f"roundel/{licence}"
        if shutil.which("cargo"):
            # The texts that go with the crates in the library, which cargo has.
            texts = made / "THIRD-PARTY-LICENCES.txt"
            subprocess.run([sys.executable, str(ROOT / "scripts/third-party"), "--texts", str(texts)], check=True)
            build_data["force_include"][str(texts)] = f"roundel/{texts.name}"
        platform = sysconfig.get_platform().replace("-", "_").replace(".", "_")
        build_data["tag"] = f"py3-none-{platform}"
        build_data["pure_python"] = False

    @staticmethod
    def _library(name):
        built = os.environ.get("ROUNDEL_LIBRARY")
        if built:
            return built
        # The features of both packages together: builds of the program then use the same library.
        packages = ["--package", "roundel", "--package", "roundel-cli", "--lib"]
        command = ["cargo", "build", "--locked", "--release", *packages]
        subprocess.run(command, cwd=ROOT, check=True)
        target = Path(os.environ.get("CARGO_TARGET_DIR", "target"))
        return ROOT / target / "release" / name

    @staticmethod
    def _declare(module):
        from cffi import FFI

        ffi = FFI()
        ffi.cdef(declarations())
        ffi.set_source("roundel._declarations", None)
        ffi.emit_python_code(str(module))
