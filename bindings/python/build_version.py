"""The version of the package, which is that of the Cargo workspace."""

import re

from build_root import ROOT

MANIFEST = (ROOT / "Cargo.toml").read_text(encoding="utf-8")
__version__ = re.search(r'\[workspace\.package\]\nversion = "(.*?)"', MANIFEST)[1]
